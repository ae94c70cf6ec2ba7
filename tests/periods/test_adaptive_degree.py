"""The driver: tolerances are met with certificates, or there is a warning that says why not."""

import logging
import re

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.marked_complex import MarkedComplex
from igl_periods.elements.least_energy import high_order_forms
from igl_periods.periods import adaptive_degree as adaptive
from igl_periods.periods.adaptive_degree import (
    Attempt,
    ToleranceWarning,
    period_matrix_within,
)
from igl_periods.periods.certificate import WithAllowance
from igl_periods.surfaces.square_tiled import glued_rectangles, origami, square_tiled_surface
from igl_periods.topology.cohomology import cochains_and_basis

L_GLUING = [((0, 1), (1, 3)), ((1, 1), (0, 3)), ((0, 2), (2, 0)),
            ((2, 2), (0, 0)), ((1, 2), (1, 0)), ((2, 1), (2, 3))]  # fmt: skip


def thin_L(width):
    return glued_rectangles([(1.0, width), (1.3, width), (1.0, 2 * width)], L_GLUING)


def within(K, tolerance, **limits):
    cochains, T = cochains_and_basis(K)
    flipped, carried = intrinsic_delaunay(K, cochains)
    method = WithAllowance(MarkedComplex(K, cochains, T))
    return period_matrix_within(MarkedComplex(flipped, carried, T), method, tolerance, **limits)


ASYMMETRIC = origami([1, 2, 0, 4, 3], [3, 1, 4, 0, 2])


@pytest.mark.parametrize("K", [square_tiled_surface("omega_2"), ASYMMETRIC, thin_L(0.1)])
def test_results_of_different_tolerances_agree_within_their_bounds(K):
    tolerances = (1e-2, 1e-5, 1e-8, 2e-11)
    results = [within(K, tolerance) for tolerance in tolerances]
    finest = results[-1]
    for tolerance, pm in zip(tolerances, results, strict=True):
        assert pm.bound <= tolerance
        assert np.all(np.abs(pm.matrix - finest.matrix) <= pm.entry_bounds + finest.entry_bounds)
    assert results[0].bound > 10 * finest.bound


def test_mild_tolerance_is_met_by_linear_forms(caplog):
    K = square_tiled_surface("omega_2", 8)
    with caplog.at_level(logging.INFO, logger="igl_periods"):
        pm = within(K, 0.1)
    assert pm.bound <= 0.1
    assert len(_table(caplog)) == 1


def _table(caplog):
    """Degree, faces, unknowns, bound and seconds of each attempt."""
    pattern = r"degree +(\d+) +(\d+) faces +(\d+) unknowns +bound (\S+) +(\S+) s"
    rows = (re.fullmatch(pattern, record.getMessage()) for record in caplog.records)
    return [tuple(float(x) for x in row.groups()) for row in rows if row]


def test_attempts_are_logged_as_a_table(caplog):
    with caplog.at_level(logging.INFO, logger="igl_periods"):
        pm = within(ASYMMETRIC, 1e-9)
    table = _table(caplog)
    degrees, faces, unknowns, bounds, _ = np.array(table).T
    assert degrees[0] == 1
    assert degrees[1] == 2
    assert np.all(np.diff(degrees) >= 0)
    assert faces[0] == ASYMMETRIC.n_faces
    assert unknowns[1] == len(high_order_forms(ASYMMETRIC, _basis(ASYMMETRIC), 2).traces)
    assert np.isclose(bounds[-1], pm.bound, rtol=0.1)
    # The degrees in between are skipped: fewer attempts than degrees.
    assert len(table) < degrees[-1]


def _basis(K):
    return ip.cohomology_basis(K)


def test_thin_faces_are_divided(caplog):
    # Degrees converge slowly where triangles are thin: dividing those is cheaper.
    K = thin_L(0.01)
    with caplog.at_level(logging.INFO, logger="igl_periods"):
        pm = within(K, 1e-8)
    assert pm.bound <= 1e-8
    faces = [row[1] for row in _table(caplog)]
    assert faces[-1] > faces[0]
    assert faces[-1] < 40 * faces[0]
    # The surface and the marking are still those that were given.
    assert pm.complex is K
    assert pm.cocycles.shape == (4, K.n_edges)


def test_tolerance_below_rounding():
    with pytest.warns(
        ToleranceWarning, match=r"not 1e-15 as wanted: rounding accounts for [\d.]+e-13"
    ):
        pm = within(square_tiled_surface("omega_3"), 1e-15)
    assert pm.bound < 5e-13


def test_too_few_unknowns():
    K = square_tiled_surface("omega_1")
    with pytest.warns(ToleranceWarning, match=r"on \d+ faces takes \d+ unknowns, and 200 are the"):
        pm = within(K, 1e-12, max_unknowns=200)
    assert 1e-12 < pm.bound < 1e-3


def test_too_little_memory(monkeypatch):
    K = square_tiled_surface("omega_1")
    message = r"takes about 0.00\d+ GB of memory, and there are 0.0024"
    with pytest.warns(ToleranceWarning, match=message):
        pm = within(K, 1e-12, max_memory=2.4e6)
    assert 1e-12 < pm.bound < 1e-3
    monkeypatch.setattr(adaptive, "available_memory", lambda: 2.4e6)
    with pytest.warns(ToleranceWarning, match=message):
        assert within(K, 1e-12).bound == pm.bound


def test_highest_degree(monkeypatch):
    # Where the degree is limited, smaller faces do the rest.
    monkeypatch.setattr(adaptive, "HIGHEST_DEGREE", 3)
    pm = within(square_tiled_surface("omega_1"), 1e-4)
    assert pm.bound <= 1e-4


def test_failing_attempt_keeps_the_best(monkeypatch):
    def fail(K, cochains, degree):
        raise ip.ComplexError("the matrix is singular")

    monkeypatch.setattr(adaptive, "high_order_forms", fail)
    with pytest.warns(ToleranceWarning, match="degree 2 fails, the matrix is singular"):
        pm = within(square_tiled_surface("omega_1", 2), 1e-3)
    assert pm.bound > 1e-3


def test_stagnation_is_recognised(monkeypatch):
    honest, done = adaptive._carried_out, []

    def useless(plan, method, tolerance):
        done.append(plan)
        first = honest(adaptive.Plan(done[0].triangulation, 2, 0.0), method, tolerance)
        even = np.ones(plan.triangulation.complex.n_faces)
        return Attempt(plan.triangulation, plan.degree, first.unknowns, 0.0, first.result, even)

    monkeypatch.setattr(adaptive, "_carried_out", useless)
    with pytest.warns(ToleranceWarning, match="neither a higher degree nor smaller faces lower it"):
        within(square_tiled_surface("omega_1"), 1e-9)
    assert len(done) == 3


def test_tolerance_must_be_positive():
    for tolerance in (0.0, -1e-3, float("nan")):
        with pytest.raises(ValueError, match="a bound is always positive"):
            within(ASYMMETRIC, tolerance)
