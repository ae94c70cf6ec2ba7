"""Cyclic covers of the sphere: topology, and convergence to periods computed by quadrature."""

from math import gcd

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support import quadrature_periods
from support.brute_force_equivalence import energy, isomorphisms, mobius

import igl_periods as ip
from igl_periods.complexes.weights import cone_angles
from igl_periods.siegel.reduction import siegel_reduce
from igl_periods.surfaces import cyclic_cover, square_tiled_period_matrix
from igl_periods.surfaces.cyclic_covers import centred, on_sphere


def random_points(n, seed):
    rng = np.random.default_rng(seed)
    return rng.normal(size=n) + 1j * rng.normal(size=n)


# Three generic hyperelliptic curves of genus 2, two of genus 3, one trigonal curve of genus 3.
CURVES = {
    "genus 2, infinity not branched": (2, random_points(6, 11)),
    "genus 2, infinity branched": (2, random_points(5, 12)),
    "genus 2, real branch points": (2, np.array([-2.1, -0.9, -0.3, 0.4, 1.3, 1.9])),
    "genus 3, infinity branched": (2, random_points(7, 13)),
    "genus 3, infinity not branched": (2, random_points(8, 14)),
    "trigonal": (3, random_points(4, 15)),
}


def reduced_periods(n, e, m=None):
    return siegel_reduce(quadrature_periods.period_matrix(n, e, m)).matrix


def distance(pm, exact, tolerance):
    """Largest difference of entries, over all markings in which there is agreement."""
    Pi = pm.reduced().matrix
    matches = isomorphisms(Pi, exact, tolerance)
    assert matches
    return min(np.abs(mobius(gamma, Pi) - exact).max() for gamma in matches)


@pytest.mark.parametrize("name", CURVES)
def test_quasi_uniform_meshes_have_the_order_of_the_largest_cone_angle(name):
    n, e = CURVES[name]
    exact, bounds, errors = reduced_periods(n, e), [], []
    for size, tolerance in ((0.2, 0.25), (0.1, 0.1), (0.05, 0.05)):
        K = cyclic_cover(n, e, size=size)
        pm = ip.period_matrix(K)
        bounds.append(pm.bound)
        errors.append(distance(pm, exact, tolerance))
    assert cone_angles(K).max() == pytest.approx(2 * np.pi * n, rel=2e-3)
    order = np.log2(bounds[0] / bounds[-1]) / 2
    assert order == pytest.approx(2 / n, abs=0.1)  # 4π / θ_max
    assert errors[-1] < min(errors[0], 5e-3)


@pytest.mark.parametrize("name", CURVES)
def test_graded_meshes_have_order_two(name):
    n, e = CURVES[name]
    exact, bounds, errors = reduced_periods(n, e), [], []
    for size, tolerance in ((0.2, 0.25), (0.1, 0.05)):
        pm = ip.period_matrix(cyclic_cover(n, e, size=size, graded=True))
        bounds.append(pm.bound)
        errors.append(distance(pm, exact, tolerance))
    assert np.log2(bounds[0] / bounds[1]) > 1.8
    assert errors[1] < min(errors[0] / 2, 3e-3)


@pytest.mark.slow
@pytest.mark.parametrize("name", CURVES)
def test_graded_meshes_reach_four_digits(name):
    n, e = CURVES[name]
    pm = ip.period_matrix(cyclic_cover(n, e, size=0.03, graded=True))
    assert distance(pm, reduced_periods(n, e), 0.02) < 1e-4


def test_orientation_is_that_of_the_curve():
    n, e = CURVES["genus 2, infinity branched"]
    exact = reduced_periods(n, e)
    Pi = ip.period_matrix(cyclic_cover(n, e, size=0.1, graded=True)).reduced().matrix
    assert len(isomorphisms(Pi, exact, 0.02)) == 2
    assert not isomorphisms(Pi, siegel_reduce(-exact.conj()).matrix, 0.02)


def test_multiplicities_matter():
    # Three sheets over the same six points: (1,1,1,2,2,2) and (1,1,1,1,1,1) have genus 4, and
    # (1,2,1,2,1,2) permutes the first.
    e = np.array([1.2, 0.3 + 0.8j, -0.7 + 0.6j, -1.1 - 0.4j, -0.2 - 0.9j, 0.8 - 0.7j])
    spectra = {}
    for m in ([1, 1, 1, 2, 2, 2], [1, 1, 1, 1, 1, 1], [2, 2, 2, 1, 1, 1]):
        pm = ip.period_matrix(cyclic_cover(3, e, m, 0.1, graded=True))
        exact = quadrature_periods.period_matrix(3, e, m)
        assert pm.genus == len(exact) == 4
        spectra[tuple(m)] = invariants(pm.matrix)
        assert spectra[tuple(m)] == pytest.approx(invariants(exact), rel=0.02)
    one, other, conjugate = spectra.values()
    assert one == pytest.approx(conjugate, rel=1e-9)
    assert one != pytest.approx(other, rel=0.1)


def invariants(Pi):
    """Smallest energies of integer classes, found by enumeration after reduction."""
    D = energy(siegel_reduce(Pi).matrix)
    vectors = np.array(np.meshgrid(*[[-1, 0, 1]] * len(D))).reshape(len(D), -1).T
    return np.sort(np.einsum("ni,ij,nj->n", vectors, D, vectors))[1:13:2]


@pytest.mark.parametrize(
    ("n", "e", "m", "name"),
    [
        (2, np.exp(1j * np.pi * np.arange(6) / 3), None, "omega_3"),
        (2, [0, 1, -1, 1j, -1j], None, "omega_2"),
        # y⁸ = x (x − 1)³: Bolza's curve with its automorphism of order 8.
        (8, [0, 1], [1, 3], "omega_2"),
    ],
)
def test_symmetric_curves(n, e, m, name):
    pm = ip.period_matrix(cyclic_cover(n, e, m, 0.1, graded=True))
    exact = siegel_reduce(square_tiled_period_matrix(name)).matrix
    assert distance(pm, exact, 0.1) < 2e-2


@given(
    n=st.integers(2, 6),
    multiplicities=st.lists(st.integers(1, 11), min_size=3, max_size=6),
    seed=st.integers(0, 10**6),
)
@settings(max_examples=40, deadline=None)
def test_genus_is_that_of_riemann_hurwitz(n, multiplicities, seed):
    m = np.array([k if k % n else k + 1 for k in multiplicities])
    e = random_points(m.size, seed)
    if gcd(n, *m.tolist()) > 1:
        with pytest.raises(ip.ComplexError, match="not connected"):
            cyclic_cover(n, e, m, 0.8)
        return
    K = cyclic_cover(n, e, m, 0.3)
    sheets = [gcd(n, int(k)) for k in (*m, -m.sum())]
    assert 2 * K.genus - 2 == -2 * n + sum(n - s for s in sheets)
    # Branch points have total angles near 2πν, all other points near 2π.
    turns = np.sort(np.rint(cone_angles(K) / (2 * np.pi)))[::-1]
    expected = sorted((n // s for s in sheets for _ in range(s) if s < n), reverse=True)
    assert turns[: len(expected)].tolist() == expected
    assert set(turns[len(expected) :]) == {1}


def test_the_mesh_does_not_depend_on_the_coordinate_of_the_sphere():
    # A Möbius transformation of the branch points leaves the curve; here it takes one to ∞.
    e = random_points(6, 3)
    bounds = [
        ip.period_matrix(cyclic_cover(2, points, size=0.1, graded=True)).reduced().matrix
        for points in (e, 1 / (e[1:] - e[0]), 5 - (2 + 1j) * e)
    ]
    for other in bounds[1:]:
        matches = isomorphisms(other, bounds[0], 0.02)
        assert min(np.abs(mobius(g, other) - bounds[0]).max() for g in matches) < 1e-3


def test_centring_is_a_mobius_transformation():
    x = random_points(7, 8)
    before, after = on_sphere(x), centred(on_sphere(x))
    assert np.abs(after.mean(axis=0)).max() < 1e-12
    assert np.abs(np.linalg.norm(after, axis=1) - 1).max() < 1e-14

    def coordinate(p):
        return (p[:, 0] + 1j * p[:, 1]) / (1 + p[:, 2])

    def cross_ratio(z):
        return (z[0] - z[2]) * (z[1] - z[3]) / ((z[0] - z[3]) * (z[1] - z[2]))

    assert np.abs(coordinate(before) - x).max() < 1e-12
    for k in range(4):
        same = cross_ratio(coordinate(after)[k : k + 4])
        assert same == pytest.approx(cross_ratio(x[k : k + 4]), rel=1e-11)


def test_wrong_covers_are_refused():
    e = [0, 1, 2, 1j]
    with pytest.raises(ip.ComplexError, match="n = 1 sheets: a branched cover has at least 2"):
        cyclic_cover(1, e)
    with pytest.raises(ip.ComplexError, match=r"branch points coincide: .* occurs 2 times"):
        cyclic_cover(2, [0, 1, 1, 2, 3])
    with pytest.raises(ip.ComplexError, match="branch points nearly coincide"):
        cyclic_cover(2, [0, 1, 1 + 1e-12, 2, 3])
    with pytest.raises(ip.ComplexError, match="branch points must be finite"):
        cyclic_cover(2, [0, 1, np.inf])
    with pytest.raises(ip.ComplexError, match="4 branch points need 4 integer multiplicities"):
        cyclic_cover(2, e, [1, 1, 1])
    with pytest.raises(ip.ComplexError, match="integer multiplicities"):
        cyclic_cover(2, e, [1.0, 1.0, 1.0, 1.5])
    with pytest.raises(ip.ComplexError, match="multiplicity 3 is a multiple of n = 3"):
        cyclic_cover(3, e, [1, 3, 2, 1])
    with pytest.raises(ip.ComplexError, match=r"not connected: n = 4 .* divisible by 2"):
        cyclic_cover(4, e, [2, 2, 2, 2])
    with pytest.raises(ip.ComplexError, match="with 2 branch points is a sphere"):
        cyclic_cover(2, [0, 1])
    for size in (0.0, -1.0, 2.0, float("nan")):
        with pytest.raises(ip.ComplexError, match="0 < size <= 1"):
            cyclic_cover(2, e, size=size)
