"""From energies in balls to a period matrix in floating point, which can have derivatives.

The balls tell where the exact matrix is, and nothing of how it moves.  Its derivative is Rauch's
formula with the exact harmonic forms; forms of high degree in double precision stand for them
(:mod:`igl_periods.periods.derivative`), so that derivatives have an error of the order of the bound
of their degree, and are not proved.
"""

from __future__ import annotations

import flint
import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex, MarkedComplex
from igl_periods.periods import (
    LEAST_ALLOWANCE,
    PeriodMatrix,
    checked_options,
    combined,
    congruence,
    solve_forms,
)


def in_floating_point(
    energies: flint.arb_mat, cocycles: csr_array, K: DeltaComplex, degree: int | None
) -> PeriodMatrix:
    """The period matrix of energies in balls, with forms of some degree if it is not None.

    Parameters
    ----------
    energies : (2g, 2g) arb_mat
        In the classes of ``cocycles``, none of them below the exact one.
    cocycles : (2g, n_edges) sparse int
    K : DeltaComplex
    degree : int or None

    Raises
    ------
    ValueError
        If the degree is no whole number from 1 to 1000.
    """
    n = int(energies.nrows())
    D = np.array([float(x.mid()) for x in energies.entries()]).reshape(n, n)
    D, loss = congruence(np.eye(n, dtype=np.int8), D)
    forms = None
    if degree is not None:
        degree, _ = checked_options("intrinsic", degree, None)
        marked = MarkedComplex(K, cocycles, np.eye(n, dtype=np.int64))
        forms, _, _ = solve_forms(marked, degree=degree)
    return PeriodMatrix(
        dirichlet=D,
        certified=True,
        cocycles=cocycles.copy(),
        complex=K,
        rounding=combined(LEAST_ALLOWANCE, loss + _relative_radius(energies, D)),
        forms=forms,
    )


def _relative_radius(energies: flint.arb_mat, midpoint: Floats) -> float:
    """How much of the energies, relative to them, their radii may be."""
    if len(midpoint) == 0:
        return 0.0
    radius = max(float(x.rad()) for x in energies.entries())
    return float(len(midpoint) * radius / np.linalg.eigvalsh(midpoint)[0])
