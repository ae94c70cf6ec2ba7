"""Harmonic forms with their energies in balls, and the same energies in 300 bits."""

from support import energies_in_300_bits

from igl_periods.complexes.delaunay import delaunay_flips
from igl_periods.harmonic import factored, harmonic_problem
from igl_periods.proofs.linear_energies import enclosed_energies
from igl_periods.proofs.surface_proofs import EnclosedTriangulation, nearly_orthonormal
from igl_periods.topology import mark


def enclosed(K, flips=True):
    """Forms on K near orthonormal, their energies in balls, and in 300 bits."""
    given = mark(K)
    where = EnclosedTriangulation.of(given)
    where = where.flipped() if flips else where
    laplacian, problem = harmonic_problem(where.complex, where.cochains)
    forms, _ = problem.forms(slice(0, given.rank), factored(laplacian))
    sides = where.lengths[where.complex.edge]
    orthonormal, W = nearly_orthonormal(forms, where.cochains, sides)
    rounds = delaunay_flips(K)[1] if flips else []
    surface = energies_in_300_bits.flipped_surface(K, given.cochains, rounds)
    exact = energies_in_300_bits.linear_energies(surface, orthonormal.potentials, W)
    return orthonormal, enclosed_energies(orthonormal), exact
