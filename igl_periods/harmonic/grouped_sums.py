"""Sums of many matrices, with little rounding.

The rounding of a sum grows with the number of terms that are added one after the other: with N
terms in groups of √N there are 2 √N of them.

References
----------
Higham, "The accuracy of floating point summation" (1993).
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from igl_periods.arrays import Floats


def sum_in_groups(terms: Iterable[Floats], n_terms: int, shape: tuple[int, ...]) -> Floats:
    """The sum of the terms, in their order and in groups of about the root of their number.

    Parameters
    ----------
    terms : iterable of array
        Made one by one, and not kept.
    n_terms : int
        How many there are.
    shape : tuple of int
        That of each.
    """
    group = math.isqrt(n_terms) + 1
    total, part = np.zeros(shape), np.zeros(shape)
    for number, term in enumerate(terms, start=1):
        part += term
        if number % group == 0:
            total += part
            part[...] = 0.0
    return total + part
