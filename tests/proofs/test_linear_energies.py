"""Energies of linear forms in balls: recomputed in 300 bits, on the worst of surfaces."""

import numpy as np
import pytest
from support import energies_in_300_bits
from support.delaunay_surfaces import distorted
from support.enclosed_forms import enclosed
from support.extreme_surfaces import capped_torus, spiked_torus
from support.random_surfaces import (
    BOLZA,
    L_SHAPE,
    needle_gluing,
    noisy_torus,
    random_gluing,
    random_lengths,
)

import igl_periods as ip
from igl_periods.harmonic import factored, harmonic_problem
from igl_periods.proofs.linear_energies import enclosed_energies
from igl_periods.proofs.midpoint_radius import Balls
from igl_periods.proofs.surface_proofs import EnclosedTriangulation, nearly_orthonormal
from igl_periods.topology import mark


def surfaces():
    rng = np.random.default_rng(3)
    yield "L", ip.DeltaComplex.from_squares(L_SHAPE, 2)
    yield "distorted Bolza", distorted(BOLZA, 2, 0.15, 1)
    for height in (1e3, 1e5, 1e7, 3e8):
        yield f"spike {height:g}", spiked_torus(height, 2)
    for height in (1e-2, 1e-4, 1e-6):
        yield f"caps {height:g}", capped_torus(height, 4)
    for exponent in (3, 6, 8):
        yield f"needles {exponent}", ip.DeltaComplex.from_gluing(*needle_gluing(8, exponent, rng))
    V, F = noisy_torus(6, 5, 0.3, 5)
    for scale in (1e-50, 1e-8, 1e8, 1e50):
        yield f"scale {scale:g}", ip.DeltaComplex.from_mesh(scale * V, F)
    twin = random_gluing(14, rng)
    yield "gluing", ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin)


CASES = [
    pytest.param(part, id=name) for name, K in surfaces() for part in K.components() if part.genus
]


@pytest.mark.parametrize("K", CASES)
@pytest.mark.parametrize("flips", [True, False])
def test_energies_contain_those_in_300_bits(K, flips):
    try:
        _, energies, exact = enclosed(K, flips)
    except ip.ComplexError:
        # Refused, and no wrong ball: floating point does not solve the equation.
        with pytest.raises(ip.ComplexError, match="positive definite"):
            enclosed(K, flips)
        pytest.skip("too extreme for the solver")
    assert energies_in_300_bits.contains(energies, exact)
    assert np.abs(energies.mid - np.eye(len(energies.mid))).max() < 1e-6


def test_energies_of_ordinary_surfaces_are_known_to_14_digits():
    for K in (CASES[0].values[0], distorted(BOLZA, 3, 0.1, 0)):
        _, energies, _ = enclosed(K)
        assert energies.rad.max() < 2e-14


def test_energies_of_two_families_are_those_of_one_in_blocks():
    forms, energies, exact = enclosed(distorted(BOLZA, 2, 0.15, 1))
    mutual = enclosed_energies(forms, forms)
    assert energies_in_300_bits.contains(mutual, exact)
    assert np.allclose(mutual.mid, energies.mid, rtol=0, atol=1e-14)


def test_lengths_that_are_not_known_leave_energies_unknown():
    forms, _, _ = enclosed(distorted(L_SHAPE, 1, 0.1, 0))
    blurred = Balls(forms.lengths.mid, 0.3 * forms.lengths.mid)
    with pytest.raises(ip.ComplexError, match="nothing can be proved about"):
        enclosed_energies(type(forms)(blurred, forms.corner_vertex, forms.jumps, forms.potentials))


@pytest.mark.parametrize("seed", range(5))
def test_bad_solutions_stay_enclosed(seed):
    # Noise of any size in the potentials: a worse form, of a larger energy, in the same class.
    rng = np.random.default_rng(seed)
    K = distorted(L_SHAPE, 2, 0.15, seed)
    given = mark(K)
    where = EnclosedTriangulation.of(given)
    laplacian, problem = harmonic_problem(K, given.cochains)
    forms, _ = problem.forms(slice(0, given.rank), factored(laplacian))
    noise = 10.0 ** rng.uniform(-12, 3) * rng.normal(size=forms.potentials.shape)
    worse = type(forms)(forms.faces, forms.jumps, forms.potentials + noise)
    enclosed_forms, W = nearly_orthonormal(worse, given.cochains, where.lengths[K.edge])
    energies = enclosed_energies(enclosed_forms)
    surface = energies_in_300_bits.flipped_surface(K, given.cochains, [])
    exact = energies_in_300_bits.linear_energies(surface, enclosed_forms.potentials, W)
    assert energies_in_300_bits.contains(energies, exact)
