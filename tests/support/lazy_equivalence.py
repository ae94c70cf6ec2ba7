"""Lazy search for modular transformations in genus 3 and 4, where one is enough.

Both matrices are Siegel-reduced first; then small integer vectors suffice.
"""

from collections.abc import Iterator
from itertools import product

import numpy as np
from support.brute_force_equivalence import energy, mobius

from igl_periods.siegel.reduction import siegel_reduce


def in_basis_of(exact: np.ndarray, Pi: np.ndarray, tolerance: float, size: int = 1) -> np.ndarray:
    """Π in a marking where it is near an exact matrix; StopIteration if there is none."""
    reduced, gamma = siegel_reduce(exact)
    back = np.rint(np.linalg.inv(gamma.astype(float)))
    near = siegel_reduce(Pi).matrix
    return mobius(back @ next(isomorphisms(near, reduced, tolerance, size)), near)


def isomorphisms(
    Pi1: np.ndarray, Pi2: np.ndarray, tolerance: float, size: int
) -> Iterator[np.ndarray]:
    """All γ with γ·Π₁ near Π₂, entries at most ``size``, one after the other."""
    g = len(Pi1)
    J = np.block([[np.zeros((g, g)), np.eye(g)], [-np.eye(g), np.zeros((g, g))]])
    D1, D2 = energy(np.asarray(Pi1)), energy(np.asarray(Pi2))
    vectors = np.array(list(product(range(-size, size + 1), repeat=2 * g)))
    energies = np.einsum("ni,ij,nj->n", vectors, D1, vectors)
    of_energy = [vectors[np.abs(energies - e) < tolerance * e] for e in np.diag(D2)]
    K = np.diag([1] * g + [-1] * g)

    def extended(rows: list[np.ndarray]) -> Iterator[np.ndarray]:
        i = len(rows)
        if i == 2 * g:
            yield K @ np.array(rows) @ K
            return
        fitting = of_energy[i]
        for k, row in enumerate(rows):
            off = np.abs(fitting @ (D1 @ row) - D2[i, k])
            fitting = fitting[(fitting @ (J @ row) == J[i, k]) & (off < tolerance * D2[i, i])]
        for vector in fitting:
            yield from extended([*rows, vector])

    yield from extended([])
