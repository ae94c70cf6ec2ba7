"""Errors and orders of convergence on Lawson's surfaces."""

import numpy as np

import igl_periods as ip
from igl_periods.surfaces import lawson_period_matrix_in


def segments_of(m, k, n):
    return 2 * n if min(m, k) > 1 else n


def errors(V, F, m, k, segments, **options):
    """Largest errors of primal, symplectic mean, and the bound, in the marking of the mesh."""
    pm = ip.period_matrix(V, F, **options)
    exact = lawson_period_matrix_in(pm.complex, pm.cocycles, m, k, segments)
    return np.array([np.abs(pm.primal - exact).max(), np.abs(pm.matrix - exact).max(), pm.bound])


def orders(values, vertices):
    """Orders in the mesh size h ~ V^(-1/2)."""
    return -2 * np.diff(np.log(values)) / np.diff(np.log(vertices))
