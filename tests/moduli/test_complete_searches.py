"""Nothing follows from a search that did not come to its end."""

import pickle

import numpy as np
import pytest

import igl_periods as ip
from igl_periods import moduli
from igl_periods.errors import EnumerationLimitError
from igl_periods.moduli import automorphisms, equivalence, lattice_isometries
from igl_periods.moduli.theta import is_hyperelliptic
from igl_periods.periods import extrapolation
from igl_periods.surfaces import identification

TORUS = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], 2)
WIDE = ip.DeltaComplex.from_squares(
    [((0, 0), (0, 2)), ((1, 0), (1, 2)), ((0, 1), (1, 3)), ((1, 1), (0, 3))]
)


def test_a_surface_and_itself_with_a_limit_of_zero():
    pm = ip.period_matrix(TORUS)
    found = ip.symplectic_isomorphisms(pm, pm, limit=0)
    assert list(found) == []
    assert found.certified
    assert not found.complete
    assert found.verdict == "undecided: the search was stopped before it found a transformation"
    copy = pickle.loads(pickle.dumps(found))
    assert (copy.complete, copy.verdict) == (False, found.verdict)


def test_a_limit_that_is_not_reached_leaves_the_proof_as_it_is():
    # The square torus and that of two squares are not equivalent: no limit stops that search.
    one, two = ip.period_matrix(TORUS), ip.period_matrix(WIDE)
    for limit in (0, 1, None):
        found = ip.symplectic_isomorphisms(one, two, limit=limit)
        assert found.complete
        assert found.verdict == "proved: the two polyhedral surfaces are not conformally equivalent"


def test_the_plane_has_one_transformation_of_genus_zero():
    sphere = np.zeros((0, 0))
    assert ip.symplectic_isomorphisms(sphere, sphere).complete


def test_a_list_that_nobody_has_searched_proves_nothing():
    assert moduli.Isomorphisms(1e-9, True).verdict.startswith("undecided")


@pytest.fixture
def impatient(monkeypatch):
    """Searches are given up after the first image."""
    monkeypatch.setattr(lattice_isometries, "SEARCH_LIMIT", 1)


def test_distances_and_groups_of_searches_that_were_given_up(impatient):
    with pytest.raises(RuntimeError, match="more than 1 images tried"):
        ip.moduli_distance([[1j]], [[1j]], 0.1)
    with pytest.raises(RuntimeError, match="more than 1 images tried"):
        ip.symplectic_automorphism_group([[1j]])


def test_identification_after_searches_that_were_given_up(impatient):
    found = ip.identify([[1j]])
    assert len(found) == 0
    assert "square torus" in found.undecided
    assert "square torus: undecided, the search was given up" in str(found)
    n_decided = len(found.compared) - len(found.undecided)
    assert f"none of {n_decided} named" in str(found) or n_decided == 0


def test_markings_in_common_after_a_search_that_was_given_up(impatient):
    with pytest.raises(ValueError, match=r"given up \(more than 1 images tried\)"):
        ip.richardson(lambda n: TORUS, (1, 2, 3))


def test_a_group_asks_for_complete_lists():
    everything = ip.symplectic_isomorphisms([[1j]], [[1j]])
    some = ip.symplectic_isomorphisms([[1j]], [[1j]], limit=2)
    for pair in ((some, everything), (everything, some)):
        with pytest.raises(EnumerationLimitError, match="stopped at its limit"):
            ip.SymplecticGroup(*pair, True)


def test_no_other_place_concludes_from_lists():
    # Whoever searches is listed here, and tested above.
    users = {equivalence, automorphisms, identification, extrapolation}
    assert all(hasattr(module, "symplectic_isomorphisms") for module in users)


def test_several_theta_constants_that_may_vanish_decide_nothing():
    # A product of tori is not a curve at all; nine of its even constants vanish.
    assert is_hyperelliptic(np.diag([1j, 2j, 0.2 + 1.7j])) is None


def test_limits_that_are_none():
    with pytest.raises(ValueError, match="limit = -1: a number of transformations is not negative"):
        ip.symplectic_isomorphisms([[1j]], [[1j]], limit=-1)
    with pytest.raises(ValueError, match="limit must be an integer, not the string '2'"):
        ip.symplectic_isomorphisms([[1j]], [[1j]], limit="2")
