import json
import pickle
import re

import flint
import numpy as np
import pytest
from support.enclosed_surfaces import generic_genus_two, in_floats

import igl_periods as ip
from igl_periods.enclosures import PeriodEnclosure, enclose
from igl_periods.symplectic import form_action


@pytest.fixture(scope="module")
def enclosed():
    return enclose(generic_genus_two(), digits=18)


def some_gamma():
    a = np.array([[1, 1], [0, 1]])
    turn = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.eye(2), np.zeros((2, 2))]])
    shear = np.block([[np.eye(2), np.array([[1, 2], [2, -1]])], [np.zeros((2, 2)), np.eye(2)]])
    change = np.block([[a, np.zeros((2, 2))], [np.zeros((2, 2)), np.linalg.inv(a).T]])
    return (turn @ shear @ change).round().astype(np.int64)


def test_same_marking_as_the_period_matrix(enclosed):
    pm = ip.period_matrix(enclosed.complex, degree=8)
    assert (enclosed.cocycles != pm.cocycles).nnz == 0
    error = np.abs(in_floats(enclosed.matrix) - pm.matrix)
    assert (error <= pm.entry_bounds).all()
    assert np.abs(in_floats(enclosed.matrix) - enclosed.to_period_matrix().matrix).max() < 1e-12
    assert enclosed.to_period_matrix().bound < 1e-11


def test_change_of_basis_is_the_moebius_map(enclosed):
    gamma = some_gamma()
    changed = enclosed.change_basis(gamma)
    assert changed.digits >= enclosed.digits - 1
    assert np.allclose(
        in_floats(changed.matrix), ip.siegel_transform(gamma, in_floats(enclosed.matrix))
    )
    assert np.array_equal(
        changed.cocycles.toarray(), form_action(gamma) @ enclosed.cocycles.toarray()
    )
    back = changed.change_basis(np.linalg.inv(gamma).round().astype(int))
    assert back.overlaps(enclosed)
    assert not changed.overlaps(enclosed)


def test_reduced_is_the_same_surface(enclosed):
    reduced = enclosed.change_basis(some_gamma()).reduced()
    matrix = in_floats(reduced.matrix)
    assert np.abs(matrix.real).max() <= 0.5 + 1e-9
    assert ip.siegel_distance(matrix, ip.siegel_reduce(matrix).matrix) < 1e-9


def test_contains_and_overlaps(enclosed):
    assert enclosed.contains(enclosed.matrix)
    assert enclosed.contains(enclosed.matrix.mid())
    assert not enclosed.contains(in_floats(enclosed.matrix) + 1e-9)
    assert enclosed.overlaps(enclosed)
    with pytest.raises(ValueError, match="has shape"):
        enclosed.contains([[1j]])


def test_documents_contain_what_was_written(enclosed):
    text = json.dumps(enclosed.to_json())
    for again in (PeriodEnclosure.from_json(text), PeriodEnclosure.from_json(enclosed.to_json())):
        with flint.ctx.workprec(enclosed.bits):
            assert again.dirichlet.contains(enclosed.dirichlet)
        assert again.digits == enclosed.digits
        assert (again.cocycles != enclosed.cocycles).nnz == 0
    for part in ("real", "imag"):
        for texts, row in zip(json.loads(text)["matrix"][part], enclosed.matrix.tolist()):
            for x, z in zip(texts, row):
                with flint.ctx.workprec(enclosed.bits):
                    assert flint.arb(x).contains(getattr(z, part))


def test_other_documents_are_refused():
    with pytest.raises(ValueError, match="no period enclosure"):
        PeriodEnclosure.from_json("{}")


def test_pickles(enclosed):
    again = pickle.loads(pickle.dumps(enclosed))
    assert again.dirichlet.contains(enclosed.dirichlet)
    assert again.digits == enclosed.digits
    assert again.overlaps(enclosed)


def test_text_shows_proved_digits_only(enclosed):
    assert f"{enclosed.digits} digits proved" in repr(enclosed)
    latex = enclosed._repr_latex_()
    assert latex.startswith("$\\Pi = \\begin{pmatrix}")
    entries = [x for z in enclosed.matrix.entries() for x in (z.real, z.imag)]
    numbers = re.findall(r"-?\d+\.\d+", latex)
    assert len(numbers) == len(entries)
    for text, ball in zip(numbers, entries):
        decimals = len(text.partition(".")[2])
        assert decimals <= enclosed.digits + 1
        with flint.ctx.workprec(enclosed.bits):
            assert abs(flint.arb(text) - ball) <= flint.arb(10) ** -decimals


def test_genus_zero():
    V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    e = enclose(V, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
    assert (e.genus, e.matrix.nrows()) == (0, 0)
    assert e.bound == 0
    assert PeriodEnclosure.from_json(json.dumps(e.to_json())).genus == 0
    assert pickle.loads(pickle.dumps(e)).genus == 0


def test_entries_are_recognised():
    """The L-shaped origami: Π = i/3 [[5, −4], [−4, 5]] up to Sp(4, Z)."""
    found = enclose(ip.surfaces.square_tiled_surface("omega_1"), digits=20).reduced().recognize()
    assert found.complete
    assert str(found.field) == "Q(i)"
    assert found.left_over > 12
