"""Surfaces without symmetry, and their harmonic forms after flips."""

import numpy as np
from support.random_surfaces import (
    BOLZA,
    noisy_torus,
    random_gluing,
    random_lengths,
)

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.weights import cotan_weights
from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.potentials import harmonic_potentials


def random_genus_two(seed):
    """A random gluing of 12 triangles of genus 2 with random lengths."""
    rng = np.random.default_rng(seed)
    while True:
        twin = random_gluing(12, rng)
        K = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin)
        if len(K.components()) == 1 and K.genus == 2:
            return K


def harmonic(K):
    L, cochains = intrinsic_delaunay(K, ip.cohomology_basis(K))
    potentials = harmonic_potentials(L, cotan_weights(L), cochains)
    return L, cochains, potentials, dirichlet_matrix(L, cochains, potentials)


SURFACES = [
    lambda: ip.DeltaComplex.from_mesh(*noisy_torus(8, 6, 0.15, 2)),
    lambda: ip.DeltaComplex.from_squares(BOLZA, 2),
    lambda: random_genus_two(1),
    lambda: random_genus_two(2),
]
