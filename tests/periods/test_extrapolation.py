"""Extrapolation to smooth surfaces: the order, the limit, and an error estimate that is honest."""

import numpy as np
import pytest
from scipy.sparse import csr_array

import igl_periods as ip
from igl_periods.periods.extrapolation import richardson, sampled_torus
from igl_periods.surfaces.lawson.surface import lawson_surface
from igl_periods.surfaces.square_tiled import square_tiled_surface
from igl_periods.surfaces.tori import flat_torus, torus_of_revolution, torus_of_revolution_modulus
from igl_periods.surfaces.wente import wente_modulus, wente_torus


def distance(Pi, exact):
    """‖Y^{-1/2} (Π − γ · exact) Y^{-1/2}‖₂ for the best γ."""
    metric = np.linalg.inv(np.linalg.cholesky(Pi.imag))
    found = ip.symplectic_isomorphisms(exact, Pi, tolerance=0.1)
    moved = (ip.siegel_transform(gamma, exact) for gamma in found)
    return min(np.linalg.norm(metric @ (Pi - other) @ metric.T, 2) for other in moved)


def ring(n):
    return torus_of_revolution(2.0, 1.0, n, n)


RING = np.array([[torus_of_revolution_modulus(2.0, 1.0)]])


WENTE = np.array([[wente_modulus()]])


def bumpy(u, v):
    """A torus of revolution in the angles of its circles, which are not conformal."""
    u, v = 2 * np.pi * u, 2 * np.pi * v
    rho = 2.0 + np.cos(v)
    return np.stack([rho * np.cos(u), rho * np.sin(u), np.sin(v)], axis=1)


@pytest.mark.parametrize(
    ("family", "exact", "sizes"),
    [
        (ring, RING, (12, 24, 48)),
        (ring, RING, (10, 15, 20, 30)),
        (wente_torus, WENTE, (10, 20, 40)),
        (wente_torus, WENTE, (12, 18, 24, 36, 48)),
        (sampled_torus(bumpy), RING, (10, 20, 40, 80)),
        (sampled_torus(bumpy, 0.7), RING, (20, 30, 40, 60)),
    ],
)
def test_limit_is_better_than_the_finest_mesh_and_the_estimate_holds(family, exact, sizes):
    limit = richardson(family, sizes)
    finest = limit.period_matrices[-1]
    error = distance(limit.matrix, exact)
    assert error < 0.12 * distance(finest.matrix, exact)
    assert error < limit.error_estimate < distance(finest.matrix, exact) * 1.6
    assert abs(limit.order - 2.0) < 0.3
    assert limit.sizes == sizes
    # The certificate is about the meshes: it says nothing about the limit.
    assert all(pm.certified for pm in limit.period_matrices)


def test_all_matrices_are_in_one_marking():
    # Another marking on every mesh: the order of faces decides about it.  The limits differ only
    # in that the expansion in powers of n is cut off in different charts.
    rng = np.random.default_rng(0)

    def shuffled(n):
        V, F = ring(n)
        order = rng.permutation(len(V))
        return V[np.argsort(order)], rng.permutation(order[F])

    limit = richardson(shuffled, (12, 24, 48))
    expected = richardson(ring, (12, 24, 48))
    assert abs(limit.order - expected.order) < 0.02
    assert np.isclose(limit.error_estimate, expected.error_estimate, rtol=0.02)
    assert distance(limit.matrix, expected.matrix) < 0.1 * limit.error_estimate
    for pm in limit.period_matrices:
        assert abs(pm.matrix - limit.matrix)[0, 0] < 0.2
        assert isinstance(pm.cocycles, csr_array)


def test_options_reach_the_period_matrix():
    limit = richardson(ring, (12, 24, 48), weights="extrinsic")
    assert not any(pm.certified for pm in limit.period_matrices)
    assert distance(limit.matrix, RING) < limit.error_estimate


def test_lawson_surface_is_exact_by_symmetry():
    limit = richardson(lambda n: lawson_surface(2, 1, n), (2, 3, 4))
    omega_3 = np.array([[2, -1], [-1, 2]]) * 1j / np.sqrt(3)
    # All meshes have the exact matrix: there is nothing to extrapolate.
    assert limit.order is None
    assert distance(limit.matrix, omega_3) < 1e-13
    assert limit.error_estimate == 1e-13


def test_no_order_where_there_is_no_convergence():
    moduli = {4: 1.0j, 5: 1.02j, 6: 0.99j}
    limit = richardson(lambda n: flat_torus(moduli[n], n), (4, 5, 6))
    assert limit.order is None
    assert limit.matrix is limit.period_matrices[-1].matrix
    assert limit.error_estimate > 0.019


@pytest.mark.parametrize("sizes", [(10, 20), (10, 10, 20), (20, 10, 40), (0, 1, 2)])
def test_sizes_are_checked(sizes):
    with pytest.raises(ValueError, match="needs three or more ascending sizes, not"):
        richardson(ring, sizes)


def test_genus_must_not_change():
    def family(n):
        return square_tiled_surface("omega_1") if n == 2 else flat_torus(1j)

    with pytest.raises(ValueError, match="the genus of the meshes changes, from 2 to 1"):
        richardson(family, (1, 2, 3))


def test_different_surfaces_are_no_family():
    with pytest.raises(ValueError, match="differ too much to be compared"):
        richardson(lambda n: flat_torus(n * 1j), (1, 2, 4))
