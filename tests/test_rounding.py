"""The allowance for rounding: it covers the true errors, found in ball arithmetic."""

from fractions import Fraction

import ball_arithmetic
import flint
import numpy as np
import pytest
from modular_words import random_point, random_word
from random_surfaces import L_SHAPE, noisy_torus, random_gluing, random_lengths

import igl_periods as ip
from igl_periods.complexes.delaunay import delaunay_flips
from igl_periods.complexes.triangles import length_sensitivity
from igl_periods.harmonic.rounding import allowance_for_loss
from igl_periods.periods.rounding import algebraic_allowance, congruence
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.symplectic.williamson_form import energy_matrix, siegel_point, williamson


def needle_gluing(n_faces, size, rng):
    """Isosceles needles: their short sides are glued to each other, and their long sides."""
    short = rng.permutation(3 * np.arange(n_faces))
    long = rng.permutation(np.setdiff1d(np.arange(3 * n_faces), short))
    twin = np.empty(3 * n_faces, dtype=np.int64)
    for sides in (short, long):
        twin[sides[0::2]], twin[sides[1::2]] = sides[1::2], sides[0::2]
    lengths = np.ones(3 * n_faces)
    lengths[short] = size * np.repeat(rng.uniform(0.5, 1.0, n_faces // 2), 2)
    return ip.DeltaComplex.from_gluing(lengths.reshape(-1, 3), twin.reshape(-1, 3))


def flattened_torus(height, seed):
    """Many vertices nearly on the edges opposite to them: caps."""
    rng = np.random.default_rng(seed)
    V, F = noisy_torus(5, 4, 0.1, seed)
    for f in rng.choice(len(F), 4, replace=False):
        a, b, c = F[f]
        V[a] = 0.5 * (V[b] + V[c]) + height * rng.normal(size=3)
    return ip.DeltaComplex.from_mesh(V, F)


def surfaces():
    rng = np.random.default_rng(5)
    yield "L", ip.DeltaComplex.from_squares(L_SHAPE, 2)
    for seed in range(3):
        yield f"noisy torus {seed}", ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.3, seed))
    for size in (1e-1, 1e-3, 1e-5):
        yield f"needles {size}", needle_gluing(6, size, rng)
    for height in (1e-2, 1e-4, 1e-6):
        yield f"caps {height}", flattened_torus(height, 3)
    twin = random_gluing(12, rng)
    yield "gluing", ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin)


CASES = [(name, part) for name, K in surfaces() for part in K.components()]


@pytest.mark.parametrize(("name", "K"), CASES, ids=[name for name, _ in CASES])
def test_allowance_covers_the_error_of_D(name, K):
    # Relative to D: |ξᵀ(D_computed − D)ξ| ≤ r ξᵀDξ, with D in ball arithmetic.
    try:
        pm = ip.period_matrix(K)
    except ip.ComplexError:
        pytest.skip("too extreme for double precision")
    if pm.genus == 0:
        pytest.skip("a sphere")
    _, rounds = delaunay_flips(K)
    exact = ball_arithmetic.dirichlet_matrix(K, pm.cocycles, rounds)
    computed = flint.arb_mat([[flint.arb(x) for x in row] for row in pm.dirichlet.tolist()])
    n = 2 * pm.genus
    difference = np.array([float(x.mid()) for x in (computed - exact).entries()]).reshape(n, n)
    whiten = np.linalg.inv(np.linalg.cholesky(pm.dirichlet))
    error = np.linalg.norm(whiten @ difference @ whiten.T, 2)
    assert error <= pm.rounding
    assert pm.rounding < 1e-3


def sheared_strips(n, m, k, h):
    """A flat torus of congruent triangles (1, b, c) in strips that are sheared to and fro."""
    b, c = float(np.hypot(k, h)), float(np.hypot(k - 1, h))

    def vertex(i, j):
        return i % n * m + j % m

    F, lengths = [], []
    for j in range(m):
        s, t = (k, k - 1) if j % 2 == 0 else (1 - k, -k)
        for i in range(n):
            a = vertex(i + s, j + 1)
            F += [(vertex(i, j), vertex(i + 1, j), a), (vertex(i, j), a, vertex(i + t, j + 1))]
            lengths += [(c, b, 1), (1, c, b)] if j % 2 == 0 else [(b, c, 1), (1, b, c)]
    return ip.DeltaComplex.from_lengths(lengths, F), b, c


@pytest.mark.parametrize(("n", "m", "k", "h"), [(40, 4, 18, 0.9), (200, 4, 90, 0.7)])
def test_rounding_of_many_flips_stays_within_the_bound(n, m, k, h):
    # The modulus follows from the lengths as they are stored, exactly: i n / (m height).
    K, b, c = sheared_strips(n, m, k, h)
    _, rounds = delaunay_flips(K)
    assert len(rounds) > k / 2
    b, c = Fraction(b), Fraction(c)
    foot = (1 + b * b - c * c) / 2
    exact = 1j * n / (m * float(b * b - foot * foot) ** 0.5)
    pm = ip.period_matrix(K).reduced()
    error = abs(pm.matrix[0, 0] - exact) / exact.imag
    assert error <= pm.bound < 1e-6
    # Lengths are extended numbers between flips, so that little adds up.
    assert error < 1e-7 * np.finfo(np.longdouble).eps / np.finfo(float).eps


def test_sensitivity_of_simple_triangles():
    c = 1e-3
    cap = np.array([[1.0, 0.5 * np.sqrt(1 + 4 * c * c), 0.5 * np.sqrt(1 + 4 * c * c)]])
    assert length_sensitivity(np.ones((1, 3)))[0] == pytest.approx(8.0)
    assert length_sensitivity(np.array([[c, 1.0, 1.0]]))[0] == pytest.approx(4 / c, rel=1e-2)
    assert length_sensitivity(cap)[0] == pytest.approx(1 / c**2, rel=1e-2)


@pytest.mark.parametrize("seed", range(10))
def test_sensitivity_bounds_the_change_of_metric(seed):
    # The generalised eigenvalues of the two metrics on the plane of the triangle.
    rng = np.random.default_rng(seed)
    lengths = np.array([1.0, *(0.5 + rng.uniform(1e-3, 0.4, 2))])

    def metric(sides):
        a, b, c = sides**2
        return np.array([[c, (b + c - a) / 2], [(b + c - a) / 2, b]])

    g, sensitivity, epsilon = metric(lengths), length_sensitivity(lengths[None])[0], 1e-9
    for signs in rng.choice([-1.0, 1.0], (8, 3)):
        changed = metric(lengths * (1 + epsilon * signs))
        change = np.abs(np.linalg.eigvals(np.linalg.solve(g, changed)) - 1).max()
        assert change <= sensitivity * epsilon * 1.01 + 1e-14 * sensitivity


def test_congruence_reports_lost_digits():
    # Two nearly parallel forms: their difference loses what they have in common.
    D = np.array([[1.0, 1.0 - 1e-8], [1.0 - 1e-8, 1.0]])
    changed, loss = congruence(np.array([[1, -1], [0, 1]]), D)
    assert changed[0, 0] == pytest.approx(2e-8, rel=1e-6)
    assert 1e-9 < loss < 1e-6
    _, kept = congruence(np.eye(2, dtype=int), np.eye(2))
    assert kept < 1e-14


def inverse_positive(n, seed):
    """D with D⁻¹ ≥ 0 entry by entry: the inverse of a positive definite positive matrix."""
    B = np.random.default_rng(seed).uniform(0, 1, (n, n))
    D = np.linalg.inv(B @ B.T + np.eye(n))
    return 0.5 * (D + D.T)


@pytest.mark.parametrize("seed", range(5))
def test_congruence_bounds_the_worst_error_of_entries_and_is_sharp(seed):
    # Errors of 8 ulps of √(D_ii D_jj), all upwards: the worst there are if D⁻¹ is positive.
    D = inverse_positive(8, seed)
    _, loss = congruence(np.eye(8, dtype=int), D)
    ulp = np.finfo(float).eps / 2
    t = np.sqrt(np.diag(D))
    worst = 8 * ulp * float(np.abs(np.linalg.eigvals(np.linalg.solve(D, np.outer(t, t)))).max())
    assert worst < loss < 1.5 * worst
    # No other signs do more, in any basis.
    rng = np.random.default_rng(seed)
    for _ in range(20):
        E = (
            8
            * ulp
            * np.outer(t, t)
            * (lambda S: np.triu(S) + np.triu(S, 1).T)(rng.choice([-1.0, 1.0], (8, 8)))
        )
        assert np.abs(np.linalg.eigvals(np.linalg.solve(D, E))).max() <= worst * (1 + 1e-9)


@pytest.mark.parametrize("largest", [1, 10, 100])
@pytest.mark.parametrize("seed", range(3))
def test_products_are_right_in_their_leading_digits(seed, largest):
    # Against rational arithmetic: half an ulp of each entry, whatever cancels in the sums.
    rng = np.random.default_rng(seed)
    n = 10
    U = np.eye(n, dtype=int)
    U[1:, 0] = rng.integers(-largest, largest + 1, n - 1)
    A = rng.normal(size=(n, n))
    D = A @ A.T + np.eye(n)
    D = 0.5 * (D + D.T)
    changed, loss = congruence(U, D)
    rational = flint.fmpz_mat(U.tolist()) * _rational(D) * flint.fmpz_mat(U.T.tolist())
    error = rational - _rational(changed)
    E = np.array([float(v.p) / float(v.q) for v in error.entries()]).reshape(n, n)
    scale = np.sqrt(np.diag(changed))
    assert np.all(np.abs(E) <= 2.0**-52 * np.outer(scale, scale))
    relative = np.abs(np.linalg.eigvals(np.linalg.solve(changed, E))).max()
    assert relative < loss


def _rational(M):
    return flint.fmpq_mat([[flint.fmpq(*v.as_integer_ratio()) for v in row] for row in M.tolist()])


def test_the_loss_is_the_same_in_every_basis():
    # What rounding did to D counts as in the basis of D, however unlike the new one is.
    rng = np.random.default_rng(2)
    A = rng.normal(size=(30, 30))
    D = A @ A.T / 30 + np.eye(30)
    shear = np.eye(30, dtype=int) + np.diag(np.ones(29, dtype=int), -1)
    _, kept = congruence(np.eye(30, dtype=int), D)
    sheared, loss = congruence(shear, D)
    t = np.abs(shear) @ np.sqrt(np.diag(D))
    in_the_new_basis = t @ np.abs(np.linalg.inv(sheared)) @ t
    # There only the product counts, which is rounded twice: two of the eight ulps of entries of D.
    assert kept < loss <= kept + 2 * np.finfo(float).eps / 2 * in_the_new_basis


@pytest.mark.parametrize("n", [2, 8, 60])
def test_allowance_of_the_algebra_contains_its_norms(n):
    # The skew product Rᵀ J R, in norm, and what inverting D amplifies.
    rng = np.random.default_rng(n)
    R = np.tril(rng.normal(size=(n, n))) + 3 * np.eye(n)
    R[0, 0] *= 1e3
    J = np.abs(standard_form(n // 2))
    skew = np.linalg.norm(np.abs(R).T @ J @ np.abs(R), 2)
    D = R @ R.T
    t = np.sqrt(np.diag(D))
    unit = 4 * n * np.finfo(float).eps / 2
    exact = unit * (skew + t @ np.abs(np.linalg.inv(D)) @ t)
    assert exact * (1 - 1e-9) <= algebraic_allowance(np.linalg.cholesky(D)) <= 1.2 * exact
    assert algebraic_allowance(np.zeros((0, 0))) == 0.0


def extreme_energies(g, seed):
    """A Dirichlet matrix with lengths of cycles from 1e-4 to 1e4, in a far marking."""
    rng = np.random.default_rng(seed)
    scale = np.diag(10.0 ** rng.uniform(-4, 4, g))
    D = energy_matrix(scale @ random_point(g, rng) @ scale)
    R = np.linalg.cholesky(D)
    D = R @ np.diag(np.tile(1 + 10.0 ** -rng.uniform(0, 12, g), 2)) @ R.T
    for length in range(12, 0, -1):
        U = random_word(g, length, rng)
        moved = U @ D @ U.T
        if np.linalg.eigvalsh(moved)[0] > 1e-14 * np.trace(moved):
            return 0.5 * (moved + moved.T)
    return 0.5 * (D + D.T)


@pytest.mark.parametrize("seed", range(40))
def test_allowance_covers_the_error_of_the_symplectic_mean(seed):
    D = extreme_energies(1 + seed % 5, seed)
    Pi = siegel_point(williamson(D)[1])
    assert np.linalg.eigvalsh(Pi.imag)[0] > 0
    assert ball_arithmetic.distance_from_the_mean(D, Pi) <= algebraic_allowance(
        np.linalg.cholesky(D)
    )


@pytest.mark.parametrize("n", [1, 2, 30])
@pytest.mark.parametrize("seed", range(4))
def test_the_loss_counts_with_its_largest_eigenvalue_relative_to_the_energies(n, seed):
    # Generalised eigenvalues by another route; a single direction, and many equal ones.
    rng = np.random.default_rng(seed)
    A, B = rng.normal(size=(2, n, n))
    D = A @ A.T + np.eye(n)
    for loss in (1e6 * B @ B.T, 1e9 * np.outer(B[0], B[0]), 1e7 * D):
        largest = np.abs(np.linalg.eigvals(np.linalg.solve(D, loss))).max()
        allowance = allowance_for_loss(D, loss) - allowance_for_loss(D, np.zeros((n, n)))
        unit = 4 * np.finfo(float).eps
        assert unit * largest * (1 - 1e-9) <= allowance <= 1.6 * unit * largest
