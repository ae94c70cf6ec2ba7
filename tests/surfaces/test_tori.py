"""Tori: flat ones are exact on any grid, tori of revolution converge with order 2."""

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from support.brute_force_equivalence import mobius

import igl_periods as ip
from igl_periods.complexes.triangles import length_sensitivity
from igl_periods.complexes.weights import cone_angles
from igl_periods.periods.quality import mesh_quality
from igl_periods.surfaces import flat_torus, torus_of_revolution, torus_of_revolution_modulus

REAL, IMAGINARY = st.floats(-3, 3), st.floats(0.05, 5)


def in_fundamental_domain(tau):
    while True:
        tau = tau - np.round(tau.real)
        if abs(tau) >= 1 - 1e-12:
            return tau
        tau = -1 / tau


def same_modulus(tau, sigma, tolerance):
    """Equality in the fundamental domain, whose boundary is glued, relative to Im τ."""
    tau, sigma = in_fundamental_domain(complex(tau)), in_fundamental_domain(complex(sigma))
    copies = [sigma, sigma + 1, sigma - 1, -1 / sigma, -1 / sigma + 1, -1 / sigma - 1]
    return min(abs(tau - copy) for copy in copies) < tolerance * tau.imag


@given(x=REAL, y=IMAGINARY, n=st.integers(1, 5), m=st.integers(1, 5))
@example(x=3.0, y=0.05078125, n=3, m=1)
@settings(max_examples=40, deadline=None)
def test_flat_torus_has_its_modulus_on_any_grid(x, y, n, m):
    K = flat_torus(complex(x, y), n, m)
    assert (K.n_vertices, K.n_edges, K.n_faces) == (n * m, 3 * n * m, 2 * n * m)
    assert np.allclose(cone_angles(K), 2 * np.pi)
    pm = ip.period_matrix(K)
    tau = pm.matrix[0, 0]
    assert pm.bound < rounding_of_a_flat_torus(K, tau)
    assert same_modulus(tau, complex(x, y), pm.bound)


def rounding_of_a_flat_torus(K, tau):
    """What rounding can do to the modulus where linear forms are exact, at most.

    Lengths that are off by ε change the metric of a triangle by εs.  The grid is one source of
    it.  All its cells are flipped alike, and each flip, which lessens s, adds a diagonal that a
    handful of operations has rounded.  In the algebra, entries of D count relative to √(D_ii D_jj),
    and tᵀ|D⁻¹|t ≤ 4 |τ|² / (Im τ)² for t = √(D_ii): in a change of basis, in a factorisation
    and in an inversion.
    """
    geometry = 4 * (1 + mesh_quality(K).flips / K.n_vertices) * length_sensitivity(K.lengths).max()
    algebra = 3 * 4 * abs(tau / tau.imag) ** 2
    return 8 * 2.0**-53 * (100 + geometry + algebra)


def test_flat_torus_keeps_orientation():
    # τ and −conj τ are mirror images, and for this τ not equivalent.
    tau = 0.3 + 1.2j
    modulus = ip.period_matrix(flat_torus(tau, 3, 4)).matrix[0, 0]
    assert same_modulus(modulus, tau, 1e-12)
    assert not same_modulus(modulus, -np.conj(tau), 1e-2)


def test_flat_torus_is_invariant_under_the_modular_group():
    tau = np.array([[0.23 + 0.71j]])
    gamma = np.array([[2, 1], [5, 3]])
    moved = mobius(gamma, tau)[0, 0]
    moduli = [ip.period_matrix(flat_torus(t, 2)).matrix[0, 0] for t in (tau[0, 0], moved)]
    assert same_modulus(*moduli, 1e-11)


def test_torus_of_revolution_converges_with_order_two():
    tau, errors = in_fundamental_domain(torus_of_revolution_modulus(2.0, 0.8)), []
    for n in (24, 48, 96):
        pm = ip.period_matrix(*torus_of_revolution(2.0, 0.8, n, n // 2))
        errors.append(abs(in_fundamental_domain(pm.matrix[0, 0]) - tau))
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx([2, 2], abs=0.1)
    assert errors[-1] < 2e-3


def test_torus_of_revolution_is_oriented_outward():
    V, F = torus_of_revolution(2.0, 0.5, 40, 20)
    volume = np.einsum("fd,fd->", V[F[:, 0]], np.cross(V[F[:, 1]], V[F[:, 2]])) / 6
    assert volume == pytest.approx(2 * np.pi**2 * 2.0 * 0.5**2, rel=0.05)


@pytest.mark.parametrize("tau", [1.0, 1 - 1j, complex("nan"), complex(0, np.inf)])
def test_wrong_moduli_are_refused(tau):
    with pytest.raises(ip.ComplexError, match="not in the upper half-plane"):
        flat_torus(tau)


def test_wrong_grids_and_radii_are_refused():
    with pytest.raises(ip.ComplexError, match="both numbers must be >= 1"):
        flat_torus(1j, 0)
    with pytest.raises(ip.MeshError, match="take at least 3 x 3"):
        torus_of_revolution(2, 1, 2, 5)
    for R, r in [(1, 1), (1, 2), (1, 0), (np.inf, 1)]:
        with pytest.raises(ip.MeshError, match="R > r > 0"):
            torus_of_revolution(R, r)
        with pytest.raises(ip.MeshError, match="R > r > 0"):
            torus_of_revolution_modulus(R, r)
