"""Panels of right-hand sides take no more memory than they may."""

import tracemalloc

import igl_periods as ip
from igl_periods.harmonic import energies as harmonic_energies
from igl_periods.harmonic.energies import harmonic_problem
from igl_periods.harmonic.potentials import factored
from igl_periods.surfaces import thickened_lattice
from igl_periods.topology.cohomology import cochains_and_basis


def test_panels_hold_no_more_than_they_may():
    K = ip.DeltaComplex.from_mesh(*thickened_lattice((4, 4, 4), 4, jitter=0.1))
    cochains, _ = cochains_and_basis(K)
    laplacian, problem = harmonic_problem(K, cochains)
    factor = factored(laplacian)

    def peak(memory):
        tracemalloc.start()
        harmonic_energies.harmonic_energies(problem, factor, memory)
        _, most = tracemalloc.get_traced_memory()
        tracemalloc.stop()
        return most

    n, k = problem.sources.shape
    functions = 8 * n * k
    saved = peak(None) - peak(functions / 3)
    # All functions against two panels that together take a third.
    assert 0.55 * functions < saved < 0.75 * functions
