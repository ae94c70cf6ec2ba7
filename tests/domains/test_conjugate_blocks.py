"""Both blocks: inverse to each other, capacities among them, tori with holes."""

import numpy as np
import pytest
from support.flat_surfaces import flat_strip
from support.random_domains import random_domain
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.domains import capacity_matrix
from igl_periods.domains.conjugate_blocks import energy_blocks
from igl_periods.surfaces import planar_domain
from igl_periods.symplectic import standard_form


def between(lower, upper):
    return np.linalg.eigvalsh(upper - lower)[0] >= -1e-13 * np.abs(upper).max()


def torus_with_holes(n_holes):
    V, F = noisy_torus(9, 8, 0.1, 1)
    return ip.DeltaComplex.from_mesh(V, np.delete(F, [0, 60, 100][:n_holes], axis=0))


SURFACES = {
    "domain": lambda: ip.DeltaComplex.from_mesh(
        *planar_domain(*random_domain(np.random.default_rng(2)))
    ),
    "torus, one hole": lambda: torus_with_holes(1),
    "torus, three holes": lambda: torus_with_holes(3),
    "cylinder": lambda: flat_strip(1.7, 0.9, 6, 5, glue_x="straight", seed=2),
}


@pytest.mark.parametrize("name", SURFACES)
def test_blocks_are_inverse_and_between_their_bounds(name):
    K = SURFACES[name]()
    blocks = energy_blocks(K, degree=3)
    pm, G = blocks.period_matrix, blocks.period_matrix.genus
    alpha, beta = blocks.insulated_classes, blocks.conducting_classes
    J = standard_form(G)
    assert len(alpha) == len(beta) == G
    assert np.array_equal(alpha @ J @ beta.T, 2 * np.eye(G, dtype=int))
    # Each half is isotropic: they are even and odd.
    assert not (alpha @ J @ alpha.T).any()
    assert not (beta @ J @ beta.T).any()
    product = blocks.insulated @ blocks.conducting
    assert np.abs(product - np.eye(G)).max() < 10 * pm.bound * np.linalg.cond(blocks.insulated)
    for mean, (lower, upper) in (
        (blocks.insulated, blocks.insulated_bounds),
        (blocks.conducting, blocks.conducting_bounds),
    ):
        assert between(lower, mean)
        assert between(mean, upper)
    # The upper bound of one and the lower one of the other are inverse; computed for themselves
    # they still enclose the inverse.
    assert between(blocks.conducting_bounds.lower, np.linalg.inv(blocks.insulated_bounds.lower))
    assert between(np.linalg.inv(blocks.insulated_bounds.upper), blocks.conducting_bounds.upper)
    coarse = energy_blocks(K, degree=1)
    if np.array_equal(coarse.insulated_classes, alpha):
        assert between(coarse.insulated_bounds.lower, blocks.insulated)
        assert between(blocks.insulated, coarse.insulated_bounds.upper)


def test_capacities_are_the_conducting_block():
    K = SURFACES["domain"]()
    C, blocks = capacity_matrix(K, degree=3), energy_blocks(K, degree=3)
    # The same lattice in two bases: the same determinant, and equal forms after a change of basis.
    assert np.linalg.det(blocks.conducting) == pytest.approx(np.linalg.det(C.grounded), rel=1e-10)
    U = 2 * C.coefficients[1:] @ np.linalg.pinv(blocks.conducting_classes)
    assert np.abs(U - np.rint(U)).max() < 1e-9
    U = np.rint(U)
    assert np.allclose(U @ blocks.conducting @ U.T, C.grounded, rtol=1e-10)
    assert np.allclose(C.conjugate @ C.grounded, np.eye(len(C.grounded)), atol=1e-12)
    lower, upper = C.conjugate_bounds
    assert between(lower, C.conjugate)
    assert between(C.conjugate, upper)


def test_flat_cylinder():
    blocks = energy_blocks(SURFACES["cylinder"](), degree=1)
    assert blocks.conducting[0, 0] == pytest.approx(1.7 / 0.9, rel=1e-12)
    assert blocks.insulated[0, 0] == pytest.approx(0.9 / 1.7, rel=1e-12)
    assert repr(blocks) == "EnergyBlocks of genus 0 with 2 loops, two of 1 x 1"


def test_a_torus_with_a_small_hole_is_almost_a_torus():
    V, F = noisy_torus(9, 8, 0.1, 1)
    closed = ip.period_matrix(V, F, degree=3)
    tiny = []
    for n in (1, 2):
        # A hole in the middle of a face, smaller and smaller.
        t = 0.5**n
        a, b, c = F[0]
        centre = V[F[0]].mean(axis=0)
        inner = centre + 0.3 * t * (V[F[0]] - centre)
        p, q, r = len(V) + np.arange(3)
        ring = [[a, b, p], [b, q, p], [b, c, q], [c, r, q], [c, a, r], [a, p, r]]
        blocks = energy_blocks(np.vstack([V, inner]), np.vstack([F[1:], ring]), degree=3)
        assert len(blocks.insulated) == 2
        tiny.append(np.linalg.det(blocks.insulated))
    # Insulating holes lower the energies; of a torus the determinant is 1.
    assert tiny[0] < tiny[1] < 1
    assert np.linalg.det(closed.dirichlet) == pytest.approx(1, abs=1e-2)
    # By the area of the hole: a fourth of the side, a fourth of the effect... in both directions.
    assert (1 - tiny[0]) / (1 - tiny[1]) == pytest.approx(4, rel=0.15)


def test_refusals():
    with pytest.raises(ip.ComplexError, match="has no boundary"):
        energy_blocks(*noisy_torus(5, 5, 0.1, 1))
    disc = energy_blocks([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    assert disc.insulated.shape == disc.conducting.shape == (0, 0)
