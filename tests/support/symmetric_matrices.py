"""Period matrices of symmetric surfaces with the orders of their groups."""

import numpy as np

from igl_periods.surfaces import (
    lawson_period_matrix,
    regular_map_period_matrix,
    square_tiled_period_matrix,
)
from igl_periods.surfaces.named_surfaces import binomial_period_matrix

# |Aut X| of the surface and whether Π decides that it is hyperelliptic.
SYMMETRIC = {
    "Omega_1": (square_tiled_period_matrix("omega_1"), 8, (8,)),
    "Bolza": (square_tiled_period_matrix("omega_2"), 48, (48,)),
    "Omega_3": (square_tiled_period_matrix("omega_3"), 24, (24,)),
    "y^2 = x^5 - 1": (binomial_period_matrix(5), 10, (10,)),
    "Klein": (regular_map_period_matrix("klein"), 336, (168,)),
    "Fermat": (regular_map_period_matrix("fermat"), 192, (96,)),
    "Schwarz P": (regular_map_period_matrix("schwarz_p"), 48, (48,)),
    "Lawson 3,1": (lawson_period_matrix(3, 1), 32, (32,)),
    "Lawson 4,1": (lawson_period_matrix(4, 1), 40, (20, 40)),
    "Bring": (regular_map_period_matrix("bring"), 240, (120, 240)),
}


def keys(matrices) -> set:
    return {gamma.tobytes() for gamma in matrices}


def reflected(gamma: np.ndarray, Pi: np.ndarray) -> np.ndarray:
    """(aΠ̄ + b)(cΠ̄ + d)⁻¹."""
    (a, b), (c, d) = (np.hsplit(half, 2) for half in np.vsplit(gamma, 2))
    return (a @ Pi.conj() + b) @ np.linalg.inv(c @ Pi.conj() + d)
