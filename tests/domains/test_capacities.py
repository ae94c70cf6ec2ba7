"""Capacities: known values between the bounds, monotonicity, and every domain lower ≤ upper."""

from itertools import pairwise, product

import numpy as np
import pytest
from scipy.special import beta, gamma
from support.flat_surfaces import flat_strip
from support.random_domains import AITCH, ELL, circle, frame, random_domain, square
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.domains.capacities import capacity_matrix
from igl_periods.surfaces import planar_domain
from igl_periods.symplectic import energy_matrix, siegel_point, standard_form


def between(lower, upper, slack=0.0):
    """Whether lower ≤ upper in the Loewner order, up to rounding."""
    scale = np.abs(upper).max()
    return np.linalg.eigvalsh(upper - lower)[0] >= -slack - 1e-14 * scale


def check_consistent(C):
    lower, upper = C.bounds
    low, high = C.entry_bounds
    assert between(lower, C.matrix)
    assert between(C.matrix, upper)
    assert np.all(low <= C.matrix)
    assert np.all(C.matrix <= high)
    for matrix in (C.matrix, lower, upper):
        assert np.array_equal(matrix, matrix.T)
        assert np.abs(matrix.sum(axis=1)).max() < 1e-13 * np.abs(matrix).max()


# By elliptic integrals: a quarter of the frame is a quadrilateral with a known modulus.
@pytest.mark.parametrize(
    ("outer", "inner", "capacity"), [(4, 2, 10.2340925693681), (3, 1, 6.215547284859)]
)
def test_square_frames(outer, inner, capacity):
    C = capacity_matrix(frame(outer, inner), tolerance=4e-13)
    check_consistent(C)
    low, high = C.entry_bounds
    assert low[1, 1] < capacity + 1e-12
    assert capacity - 1e-12 < high[1, 1]
    assert high[1, 1] - low[1, 1] < 2e-11
    assert C.matrix[1, 1] == pytest.approx(capacity, rel=3e-13)
    assert C.matrix[0, 1] == pytest.approx(-capacity, rel=3e-13)


@pytest.mark.parametrize(("around", "height"), [(1.7, 0.9), (0.4, 1.3)])
def test_flat_cylinders_are_exact_at_degree_one(around, height):
    K = flat_strip(around, height, 6, 5, glue_x="straight", seed=2)
    C = capacity_matrix(K, degree=1)
    check_consistent(C)
    assert C.matrix[1, 1] == pytest.approx(around / height, rel=1e-12)
    assert C.moduli[0, 1] == pytest.approx(2 * np.pi * height / around, rel=1e-12)
    low, high = C.resistance_bounds
    assert low[0, 1] <= height / around <= high[0, 1]


def ring(n, radius, centre=0.0):
    return planar_domain(circle(n), [circle(n, radius, centre)])


def polygonal_capacity(n, radius):
    """Capacity between regular n-gons, up to a part of the order radius^n.

    Conformal radii of the inside of the outer one and the outside of the inner one (Pólya, Szegő).
    """
    inside = n / beta(1 / n, 1 - 2 / n)
    outside = gamma(1 / n) / (2 ** (1 + 2 / n) * np.sqrt(np.pi) * gamma(0.5 + 1 / n))
    return 2 * np.pi / np.log(inside / (radius * outside * 2 * np.sin(np.pi / n)))


def test_round_annuli_are_approached_by_polygons_with_order_three():
    # Either polygon is off by n^-2; where both are inscribed, these errors cancel.
    matrices = [capacity_matrix(ring(n, 0.4), tolerance=1e-7) for n in (12, 24, 48)]
    computed = np.array([C.matrix[1, 1] for C in matrices])
    assert computed[1:] == pytest.approx([polygonal_capacity(n, 0.4) for n in (24, 48)], rel=2e-8)
    errors = computed - 2 * np.pi / np.log(1 / 0.4)
    assert np.all(np.abs(np.log2(errors[:-1] / errors[1:]) - 3) < 0.05)


def test_eccentric_annulus():
    # Circles of radii 1 and r with centres at distance c: 2π / arcosh((1 + r² − c²) / 2r).
    r, c = 0.3, 0.45
    exact = 2 * np.pi / np.arccosh((1 + r**2 - c**2) / (2 * r))
    one, two = (capacity_matrix(ring(n, r, c), tolerance=1e-6).matrix[1, 1] for n in (24, 48))
    assert (4 * two - one) / 3 == pytest.approx(exact, rel=2e-4)


def check_domain(seed, degree):
    outer, holes = random_domain(np.random.default_rng(seed))
    V, F = planar_domain(outer, holes)
    coarse = capacity_matrix(V, F, degree=1)
    check_consistent(coarse)
    assert between(*coarse.bounds)
    fine = capacity_matrix(V, F, degree=degree)
    # Both contain the exact matrix, and functions of degree 1 are among those of higher degree
    # only up to flips: the bounds overlap.
    assert between(coarse.bounds.lower, fine.bounds.upper)
    assert between(fine.bounds.lower, coarse.bounds.upper)
    assert between(coarse.bounds.lower, fine.matrix)
    assert between(fine.matrix, coarse.bounds.upper)
    low, high = coarse.entry_bounds
    assert np.all((low <= fine.matrix) & (fine.matrix <= high))
    assert np.all(fine.matrix[~np.eye(len(fine.matrix), dtype=bool)] < 0)
    return coarse, fine


@pytest.mark.parametrize("seed", range(12))
def test_random_domains(seed):
    check_domain(seed, 4)


@pytest.mark.slow
def test_a_thousand_random_domains():
    for seed in range(1000):
        check_domain(seed, 3)


def test_larger_holes_have_larger_capacities():
    outer = square(-3, -3, 6)
    matrices = []
    for scale in (0.5, 0.7, 0.9):
        holes = [scale * (ELL - 1 - 1j) - 1.2, 0.5 * scale * (AITCH - 1.5 - 1.5j) + 1.5 + 1.2j]
        matrices.append(capacity_matrix(planar_domain(outer, holes), tolerance=1e-4))
    for small, large in pairwise(matrices):
        # The Dirichlet problem on the smaller domain has fewer trial functions.
        assert between(small.bounds.upper[1:, 1:], large.bounds.lower[1:, 1:])


def test_holes_far_apart_are_in_parallel():
    # Resistances are a metric, and capacities do not depend on the scale.
    outer, holes = random_domain(np.random.default_rng(2))
    V, F = planar_domain(outer, holes)
    C, D = (capacity_matrix(scale * V, F, degree=2) for scale in (1.0, 1e6))
    assert np.allclose(C.matrix, D.matrix, rtol=1e-12)
    R = C.resistances
    n = len(R)
    assert n > 2
    for i in range(n):
        assert np.all(R[i] <= R[i][:, None] + R + 1e-12)


def row_meeting(N, k):
    """An integer row a with N a = e_k, by trying small ones."""
    for a in product((-1, 0, 1), repeat=N.shape[1]):
        if np.array_equal(N @ a, np.eye(len(N), dtype=int)[k]):
            return np.array(a)
    raise AssertionError


def test_planar_domains_are_the_inverse_of_the_period_matrix():
    outer, holes = random_domain(np.random.default_rng(4))
    C = capacity_matrix(planar_domain(outer, holes), degree=4)
    B = C.coefficients[1:]
    g = C.period_matrix.genus
    assert len(B) == g
    J = standard_form(g)
    # Complete the classes of the loops to a canonical basis: of integers A with A J Bᵀ = 1, the
    # ones that do not pair with each other.
    N = B @ J.T
    A = np.array([row_meeting(N, k) for k in range(g)])
    A = A + np.tril(A @ J @ A.T, -1) @ B
    assert np.array_equal(A @ J @ B.T, np.eye(g, dtype=int))
    assert not (A @ J @ A.T).any()
    U = np.vstack([A, B])
    Pi = siegel_point(U @ energy_matrix(C.period_matrix.matrix) @ U.T)
    assert np.abs(Pi.real - np.rint(2 * Pi.real) / 2).max() < 1e-3
    assert np.allclose(C.grounded, 2 * np.linalg.inv(Pi.imag), rtol=1e-10)


def test_handles_change_nothing_of_the_theorem():
    V, F = noisy_torus(9, 8, 0.1, 1)
    kept = np.delete(F, [0, 60], axis=0)
    coarse, fine = (capacity_matrix(V, kept, degree=p) for p in (1, 4))
    check_consistent(coarse)
    assert between(coarse.bounds.lower, fine.matrix)
    assert between(fine.matrix, coarse.bounds.upper)
    assert fine.matrix[0, 1] < 0


def test_one_loop_has_no_capacity():
    C = capacity_matrix([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    assert C.matrix.tolist() == [[0.0]]
    assert C.resistances.tolist() == [[0.0]]
    assert C.bounds.upper.tolist() == [[0.0]]


def test_closed_surfaces_are_refused():
    with pytest.raises(ip.ComplexError, match="has no boundary"):
        ip.capacity_matrix(*noisy_torus(5, 5, 0.1, 1))


def test_unmet_tolerances_are_said():
    with pytest.warns(ip.ToleranceWarning, match="20 are the limit"):
        capacity_matrix(frame(4, 2), tolerance=1e-10, max_unknowns=20)


def test_shown_with_the_digits_that_are_known():
    C = capacity_matrix(frame(4, 2), tolerance=1e-8)
    assert repr(C).splitlines()[0].startswith("CapacityMatrix of 2 loops, bound ")
    assert "10.23409" in repr(C)
    assert np.asarray(C) is C.matrix
