"""A small search for the modular transformations between two period matrices.

Independent of the library's own search: it tries all small integer vectors.
"""

from itertools import product

import numpy as np


def energy(Pi: np.ndarray) -> np.ndarray:
    X, Y = Pi.real, Pi.imag
    inverse = np.linalg.inv(Y)
    return np.block([[Y + X @ inverse @ X, -X @ inverse], [-inverse @ X, inverse]])


def isomorphisms(
    Pi1: np.ndarray, Pi2: np.ndarray, tolerance: float, size: int = 2, limit: int = 10_000
) -> list:
    """The γ in Sp(2g, Z) with γ·Π₁ = Π₂ and entries up to ``size``, at most ``limit`` of them."""
    g = len(Pi1)
    J = np.block([[np.zeros((g, g)), np.eye(g)], [-np.eye(g), np.zeros((g, g))]])
    D1, D2 = energy(np.asarray(Pi1)), energy(np.asarray(Pi2))
    vectors = np.array(list(product(range(-size, size + 1), repeat=2 * g)))
    energies = np.einsum("ni,ij,nj->n", vectors, D1, vectors)
    rows: list[np.ndarray] = []
    found: list[np.ndarray] = []

    def extend() -> None:
        i = len(rows)
        if i == 2 * g:
            K = np.diag([1] * g + [-1] * g)
            found.append(K @ np.array(rows) @ K)
            return
        fits = np.abs(energies - D2[i, i]) < tolerance * D2[i, i]
        for k, row in enumerate(rows):
            fits &= vectors @ J @ row == J[i, k]
            fits &= np.abs(vectors @ D1 @ row - D2[i, k]) < tolerance * D2[i, i]
        for vector in vectors[fits]:
            if len(found) >= limit:
                return
            rows.append(vector)
            extend()
            rows.pop()

    extend()
    return found


def mobius(gamma: np.ndarray, Pi: np.ndarray) -> np.ndarray:
    g = len(Pi)
    a, b, c, d = gamma[:g, :g], gamma[:g, g:], gamma[g:, :g], gamma[g:, g:]
    return (a @ Pi + b) @ np.linalg.inv(c @ Pi + d)
