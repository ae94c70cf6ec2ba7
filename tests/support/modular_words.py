"""Random points of the Siegel upper half-space, and random words in the modular group."""

import numpy as np


def random_point(g: int, rng: np.random.Generator) -> np.ndarray:
    """A generic Π, of condition up to about 100."""
    A = rng.standard_normal((g, g))
    X = rng.uniform(-1, 1, (g, g))
    return X + X.T + 1j * (A @ A.T / g + 0.2 * np.eye(g))


def random_word(g: int, length: int, rng: np.random.Generator, largest: int = 10**5) -> np.ndarray:
    """A product of elementary elements of Sp(2g, Z), cut off before entries get too large."""
    gamma = np.eye(2 * g, dtype=np.int64)
    for _ in range(length):
        longer = _letter(g, rng) @ gamma
        if np.abs(longer).max() > largest:
            break
        gamma = longer
    return gamma


def _letter(g: int, rng: np.random.Generator) -> np.ndarray:
    one, zero = np.eye(g, dtype=np.int64), np.zeros((g, g), dtype=np.int64)
    i, j = rng.integers(g, size=2)
    match rng.integers(4):
        case 0:  # a transvection of the lattice
            U, V = one.copy(), one.copy()
            if i != j:
                U[i, j], V[j, i] = 1, -1
            return np.block([[U, zero], [zero, V]])
        case 1:  # a shift
            S = zero.copy()
            S[i, j] = S[j, i] = rng.choice([-1, 1])
            return np.block([[one, S], [zero, one]])
        case 2:  # an inversion at one index
            E = zero.copy()
            E[i, i] = 1
            return np.block([[one - E, -E], [E, one - E]])
        case _:  # a change of sign
            U = one.copy()
            U[i, i] = -1
            return np.block([[U, zero], [zero, U]])
