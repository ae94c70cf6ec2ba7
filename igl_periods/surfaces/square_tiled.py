r"""Surfaces tiled by squares, and by rectangles.

A surface glued from unit squares is flat except at the corners of squares, where its total angle
is a multiple of π/2.  Divided into n × n smaller squares, each cut into two right triangles, it
has the weights of the square lattice (1 on sides, 0 on diagonals), and it is the same polyhedral
surface for every n: its period matrix is known where that of the algebraic curve is.

The three surfaces of Bobenko, Mercat and Schmies (section 4.1) come from R. Silhol.  The pictures
of the gluings being lost, the gluings used here were found from the vertex counts and the period
matrices:

* ``"omega_1"``, three squares, one vertex: the L-shaped origami, a translation surface with one
  point of total angle 6π.  Its curve is y² = x(x − 1)(x − λ)(x − μ)(x − ν) with λ = 8 − 4√3,
  μ = ½ + 1/√3, ν = 2/√3.
* ``"omega_2"``, four squares, two vertices of total angle 4π: Bolza's curve y² = x⁵ − x.
* ``"omega_3"``, six squares, four vertices of total angle 3π: y² = x⁶ − 1, the conformal type of
  Lawson's minimal surface ξ_{2,1}.

An *origami* is a translation surface: square k has the right neighbour ``right[k]`` and the upper
neighbour ``up[k]``, and two permutations say everything.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 4.1.
Silhol, "Genus 2 translation surfaces with an order 4 automorphism" (2006).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Ints
from igl_periods.complexes import DeltaComplex, by_kind, components_of, root_of, squares
from igl_periods.errors import ComplexError

from .permutations import read_permutations

# More squares than this are glued without their places in the plane.
_MOST_POLYGONS = 500
Gluing = list[tuple[tuple[int, int], tuple[int, int]]]
_GLUINGS: dict[str, Gluing] = {
    "omega_1": [
        ((0, 1), (1, 3)), ((1, 1), (0, 3)), ((0, 2), (2, 0)),
        ((2, 2), (0, 0)), ((1, 2), (1, 0)), ((2, 1), (2, 3)),
    ],
    "omega_2": [
        ((0, 0), (1, 0)), ((0, 2), (1, 2)), ((2, 0), (3, 0)), ((2, 2), (3, 2)),
        ((0, 1), (2, 1)), ((0, 3), (2, 3)), ((1, 1), (3, 3)), ((1, 3), (3, 1)),
    ],
    "omega_3": [((k, side), ((k + 1) % 6, side - 1)) for k in range(6) for side in (1, 3)],
}  # fmt: skip
_PERIOD_MATRICES: dict[str, Complexes] = {
    "omega_1": np.array([[5, -4], [-4, 5]]) * 1j / 3,
    "omega_2": (np.array([[-2, 1], [1, -2]]) + 1j * np.sqrt(2) * np.array([[2, -1], [-1, 2]])) / 3,
    "omega_3": np.array([[2, -1], [-1, 2]]) * 1j / np.sqrt(3),
}


def square_tiled_surface(name: str, n: int = 1) -> DeltaComplex:
    """Glue one of the paper's three square-tiled surfaces, each square divided into n × n.

    Parameters
    ----------
    name : {"omega_1", "omega_2", "omega_3"}
    n : int

    Raises
    ------
    ComplexError
        If there is no surface of that name, or ``n < 1``.

    Examples
    --------
    >>> [square_tiled_surface("omega_2", n).n_vertices for n in (2, 4, 8, 16, 32)]
    [14, 62, 254, 1022, 4094]
    """
    return DeltaComplex.from_squares(_GLUINGS[_known(name)], n)


def square_tiled_period_matrix(name: str) -> Complexes:
    """Return the exact period matrix of one of the paper's three surfaces; shape (2, 2).

    Equal to the period matrix of :func:`square_tiled_surface` up to the action of Sp(4, Z).

    Raises
    ------
    ComplexError
        If there is no surface of that name.
    """
    return _PERIOD_MATRICES[_known(name)].copy()


def origami(right: str | ArrayLike, up: str | ArrayLike, n: int = 1) -> DeltaComplex:
    """Glue unit squares by translations, as two permutations say.

    Parameters
    ----------
    right, up : str or (N,) array-like of int
        The square to the right of square k, and the one above it: cycles counted from 1, as
        ``"(1,2,3)(4,5)"``, or images counted from 0.
    n : int
        Each square is divided into n × n.

    Raises
    ------
    ComplexError
        If ``right`` and ``up`` are not permutations of the same squares, or leave the surface
        disconnected, or ``n < 1``.

    Examples
    --------
    >>> origami("(1,2)", "(1,3)").genus, origami([1, 0, 2], [2, 1, 0]).genus
    (2, 2)
    """
    to_right, above = read_permutations({"right": right, "up": up})
    here = np.arange(above.size)
    n_parts, _ = components_of(np.tile(here, 2), np.concatenate([to_right, above]), here.size)
    if n_parts > 1:
        raise ComplexError(
            f"the origami is not connected: its squares fall into {n_parts} parts. The group "
            "that right and up generate must be transitive."
        )
    pairs = [((k, 1), (r, 3)) for k, r in enumerate(to_right.tolist())]
    pairs += [((k, 2), (u, 0)) for k, u in enumerate(above.tolist())]
    return placed_squares(_in_rows(to_right), pairs, n)


def placed_squares(places: list[tuple[int, int]], gluing: Gluing, n: int) -> DeltaComplex:
    """Unit squares with these lower left corners, as polygons where they are few and whole."""
    if n != 1 or len(places) > _MOST_POLYGONS:
        return DeltaComplex.from_squares(gluing, n)
    squares = [[(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)] for x, y in places]
    return DeltaComplex.from_polygons(squares, gluing)


def _in_rows(right: Ints) -> list[tuple[int, int]]:
    """Places of the squares of an origami in the plane: a row for each horizontal cylinder."""
    place: dict[int, tuple[int, int]] = {}
    row = 0
    for start in range(right.size):
        k, column = start, 0
        while k not in place:
            place[k] = column, row
            k, column = int(right[k]), column + 1
        row += column > 0
    return [place[k] for k in range(right.size)]


def quaternion_origami(n: int = 1) -> DeltaComplex:
    """Glue the origami of the quaternion group, the *eierlegende Wollmilchsau*; genus 3.

    Its eight squares are the elements q of the group {±1, ±i, ±j, ±k}; to the right of q lies q i,
    above it q j.  Four zeros of order 1; its curve is the Fermat quartic.

    Parameters
    ----------
    n : int
        Each square is divided into n × n.

    References
    ----------
    Herrlich, Schmithüsen, "An extraordinary origami curve" (2008).

    Examples
    --------
    >>> quaternion_origami().genus
    3
    """
    # 1, i, −1, −i, k, j, −k, −j: i·i = −1, k·i = j; i·j = k, j·j = −1.
    return origami("(1,2,3,4)(5,6,7,8)", "(1,6,3,8)(2,5,4,7)", n)


def glued_rectangles(
    sizes: ArrayLike, gluing: Iterable[Sequence[Sequence[int]]], n: int = 1
) -> DeltaComplex:
    """Glue rectangles, each divided into n × n rectangles of two right triangles.

    Parameters
    ----------
    sizes : (N, 2) array-like
        Width (length of sides 0 and 2) and height (length of sides 1 and 3) of each rectangle.
    gluing : iterable of ((rectangle, side), (rectangle, side))
        Sides are 0 bottom, 1 right, 2 top, 3 left; glued sides run in opposite directions.
    n : int

    Raises
    ------
    ComplexError
        If a side does not exist or is not glued exactly once, to another side, if sides of
        different length are glued, if ``sizes`` are not N pairs of positive numbers, or ``n < 1``.
    """
    _, twin = squares(gluing, n)
    size = np.asarray(sizes, dtype=np.float64)
    n_rectangles = len(twin) // (2 * n * n)
    if size.shape != (n_rectangles, 2):
        raise ComplexError(
            f"sizes must have shape ({n_rectangles}, 2), a width and a height for each rectangle "
            f"of the gluing, not {size.shape}."
        )
    width, height = np.repeat(size / n, n * n, axis=0).T
    diagonal = np.hypot(width, height)
    lengths = np.empty((len(twin), 3))
    lengths[0::2] = np.stack([height, diagonal, width], axis=1)
    lengths[1::2] = np.stack([width, height, diagonal], axis=1)
    K = DeltaComplex.from_gluing(lengths, twin)
    first = 3 * np.repeat(np.arange(n_rectangles), n * n)[:, None]
    kind = np.empty(lengths.shape, dtype=np.int64)
    kind[0::2], kind[1::2] = first + np.array([1, 2, 0]), first + np.array([0, 1, 2])
    formulas = [
        root_of(square / (n * n))
        for w, h in ((Fraction(w), Fraction(h)) for w, h in size.tolist())
        for square in (w * w, h * h, w * w + h * h)
    ]
    return replace(K, exact_lengths=by_kind(K.edge, kind, formulas))


def _known(name: str) -> str:
    if name not in _GLUINGS:
        raise ComplexError(
            f"there is no square-tiled surface {name!r}; the names are {', '.join(_GLUINGS)}. "
            "Other gluings of squares: origami, DeltaComplex.from_squares."
        )
    return name
