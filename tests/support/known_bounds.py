"""Certified period matrices with a bound that was prescribed."""

from dataclasses import replace

import numpy as np
from scipy.sparse import csr_array

import igl_periods as ip
from igl_periods.surfaces import (
    square_tiled_surface,
)
from igl_periods.symplectic.williamson_form import energy_matrix


def known_within(bound: float, Pi: np.ndarray) -> ip.PeriodMatrix:
    """A certified period matrix: all energies too large by the same factor."""
    any_surface = ip.period_matrix(square_tiled_surface("omega_1"))
    energies = (1 + bound) * energy_matrix(Pi)
    no_marking = csr_array((2 * len(Pi), any_surface.complex.n_edges))
    pm = replace(any_surface, dirichlet=energies, cocycles=no_marking)
    assert bound <= pm.bound < 2 * bound + 1e-12
    return pm
