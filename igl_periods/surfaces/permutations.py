"""Permutations as images or as cycles, as gluings are given by them.

Images are counted from 0: [1, 2, 0] sends 0 to 1.  Cycles are texts and counted from 1, as in the
literature: "(1,2,3)" sends 1 to 2.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Ints
from igl_periods.errors import ComplexError

Permutation = tuple[int, ...]
MOST_NAMED = 10**6


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
            f"{what} is not a permutation of 0, …, {array.size - 1}: {array.tolist()[:12]}."
        )
    return array.astype(np.int64)


def read_permutations(given: Mapping[str, str | ArrayLike]) -> list[Ints]:
    """Permutations of the same things, as images counted from 0.

    Parameters
    ----------
    given : mapping of names to texts or lists
        Texts are products of disjoint cycles, counted from 1; what they do not name stays.

    Raises
    ------
    ComplexError
        If one is not a permutation, or they permute different numbers of things.

    Examples
    --------
    >>> [p.tolist() for p in read_permutations({"right": "(1,2,3)", "up": "(1,4)"})]
    [[1, 2, 0, 3], [3, 1, 2, 0]]
    """
    cycles = {what: _cycles(x, what) for what, x in given.items() if isinstance(x, str)}
    images = {what: checked_permutation(x, what) for what, x in given.items() if what not in cycles}
    named = [i + 1 for text in cycles.values() for cycle in text for i in cycle]
    size = max([*named, *(x.size for x in images.values()), 1])
    for what, array in images.items():
        if array.size != size:
            least = next((other for other, x in images.items() if x.size == size), "a cycle")
            raise ComplexError(
                f"{what} permutes {array.size} things and {least} permutes {size}: they must "
                "permute the same ones."
            )
    for what, text in cycles.items():
        images[what] = np.arange(size)
        for cycle in text:
            images[what][cycle] = cycle[1:] + cycle[:1]
    return [images[what] for what in given]


def _cycles(text: str, what: str) -> list[list[int]]:
    """The cycles of a text, counted from 0."""
    if not re.fullmatch(r"(\s*\((\s*\d+\s*([,\s]\s*\d+\s*)*)?\))*\s*", text):
        raise ComplexError(f'{what} is not a product of cycles like "(1,2,3)(4,5)": {text!r}.')
    cycles = [[int(x) - 1 for x in re.findall(r"\d+", c)] for c in re.findall(r"\(([^)]*)\)", text)]
    named = [i for cycle in cycles for i in cycle]
    if named and min(named) < 0:
        raise ComplexError(f"{what} names 0, and cycles are counted from 1: {text!r}.")
    if len(set(named)) < len(named):
        twice = next(i for i in named if named.count(i) > 1)
        raise ComplexError(f"{what} names {twice + 1} twice: cycles are disjoint. {text!r}.")
    if named and max(named) >= MOST_NAMED:
        raise ComplexError(f"{what} names {max(named) + 1}; up to {MOST_NAMED} are taken.")
    return cycles
