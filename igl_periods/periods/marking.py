r"""Which faces are divided: those that hold most of the bound.

The fewest faces that hold a given part of the excess are marked
(:mod:`igl_periods.harmonic.excess`): then every round divides the bound by a constant factor.  But
a face can be too thin for floating-point numbers to describe its parts.  In its place the faces
next to it are divided: the Delaunay flips that follow shorten its long sides.

References
----------
Dörfler, "A convergent adaptive algorithm for Poisson's equation" (1996).
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, is_divisible
from igl_periods.harmonic import most_of


def marked_faces(K: DeltaComplex, excess: Floats, part: float) -> Ints:
    """The fewest faces that hold a part of the excess, or neighbours of those that are too thin.

    Parameters
    ----------
    K : DeltaComplex
    excess : (m,) float
        The shares of the faces, none negative.
    part : float
        Between 0 and 1.

    Returns
    -------
    (r,) int
        The worst first, neighbours last; empty where all of them are too thin.
    """
    worst = most_of(excess, part)
    good = is_divisible(K.lengths[worst])
    if good.all():
        return worst
    near = np.setdiff1d(K.twin[worst[~good]] // 3, worst)
    near = near[np.argsort(-excess[near], kind="stable")]
    return np.concatenate([worst[good], near[is_divisible(K.lengths[near])]])
