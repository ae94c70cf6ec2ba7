"""The allowance for rounding of D: it covers the true errors, found in ball arithmetic."""

from fractions import Fraction

import flint
import numpy as np
import pytest
from support import ball_arithmetic
from support.extreme_surfaces import sheared_strips
from support.random_surfaces import L_SHAPE, noisy_torus, random_gluing, random_lengths

import igl_periods as ip
from igl_periods.complexes.delaunay import delaunay_flips
from igl_periods.harmonic.rounding import allowance_for_loss


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
