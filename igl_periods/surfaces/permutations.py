"""Permutations as arrays or tuples of images, as gluings are given by them."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Ints
from igl_periods.errors import ComplexError

Permutation = tuple[int, ...]


def composed(a: Permutation, b: Permutation) -> Permutation:
    """(ab)(i) = a(b(i))."""
    return tuple(a[i] for i in b)


def checked_permutation(images: ArrayLike, what: str) -> Ints:
    """The images as an array, if they are a permutation of 0..n−1."""
    array = np.asarray(images)
    if array.ndim != 1 or array.size == 0 or array.dtype.kind not in "iu":
        raise ComplexError(f"{what} must be a list of integers, not an array {array.shape}.")
    if not np.array_equal(np.sort(array), np.arange(array.size)):
        raise ComplexError(
            f"{what} is no permutation of 0, …, {array.size - 1}: {array.tolist()[:12]}."
        )
    return array.astype(np.int64)
