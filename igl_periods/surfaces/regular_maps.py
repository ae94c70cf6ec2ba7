r"""Regular maps: surfaces glued from regular polygons with all the symmetry there can be.

A regular map of type {k, v} is glued from regular k-gons, v at each vertex, and its group of
orientation-preserving symmetries acts simply transitively on the pairs (face, side).  So it is
given by a group G with two generators, the rotation r of a face by one side and the flip t about
the midpoint of a side: faces are the orbits x⟨r⟩, side i of the face of x is x rⁱ, and it is glued
to x rⁱ t.  Made of *unit* regular polygons it carries the conformal structure of the curve that
the corresponding triangle group uniformises, for any subdivision.

A permutation is written as the tuple of its images, and the product acts from the right to the
left, (ab)(i) = a(b(i)).

A triangle is divided into n² triangles, a square into n × n squares of two right triangles, any
other polygon into k triangles about its centre, each divided into n².

======================  =======  =======  =====================================================
name                    type     genus    curve
======================  =======  =======  =====================================================
``"klein"``             {3, 7}   3        x³y + y³z + z³x = 0, 168 symmetries
``"fermat"``            {3, 8}   3        x⁴ + y⁴ + z⁴ = 0, 96 symmetries (Dyck's map)
``"bolza"``             {3, 8}   2        y² = x⁵ − x, 48 symmetries
``"bring"``             {4, 5}   4        Σ x_i = Σ x_i² = Σ x_i³ = 0 in P⁴, 120 symmetries
``"schwarz_p"``         {4, 6}   3        y² = x⁸ + 14x⁴ + 1, Schwarz's P surface, 48 symmetries
======================  =======  =======  =====================================================

For the first three, the symmetries determine the period matrix.  Bring's and Schwarz's matrices
lie in one-parameter families with the same symmetries, so that discretisations only converge.

References
----------
Coxeter, Moser, "Generators and relations for discrete groups", chapter 8.
Braden, Northover, "Bring's curve: its period matrix and the vector of Riemann constants" (2012);
"Klein's curve" (2010), for the period matrices.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex, by_kind, circumradius, root_of
from igl_periods.errors import ComplexError

from .permutations import Permutation, checked_permutation, composed
from .square_tiled import square_tiled_period_matrix
from .subdivision import subdivide

# Rotation and flip, as permutations of
#   klein: the projective line over F_7 (7 is ∞), z -> 1 - 1/z and z -> -1/z;
#   fermat: the 12 hyperflexes, 4 on each of the lines x_j = 0, a cyclic exchange of coordinates
#     and an exchange of two coordinates with x_0 -> i x_0, x_1 -> -i x_1;
#   bolza: the 8 nonzero vectors (a, b) over F_3, numbered 3 a + b - 1, under the matrices
#     [[0, 1], [2, 2]] and diag(1, 2);
#   bring: 5 coordinates, (0 1 2 3) and (3 4);
#   schwarz_p: S_4 x Z_2 on 4 + 2 points, (0 1 2 3) and (0 3)(4 5).
_GENERATORS: dict[str, tuple[Permutation, Permutation]] = {
    "klein": ((7, 0, 4, 3, 6, 5, 2, 1), (7, 6, 3, 2, 5, 4, 1, 0)),
    "fermat": ((4, 5, 6, 7, 8, 9, 10, 11, 0, 1, 2, 3), (6, 5, 4, 7, 2, 1, 0, 3, 9, 8, 11, 10)),
    "bolza": ((4, 6, 1, 3, 5, 0, 2, 7), (1, 0, 2, 4, 3, 5, 7, 6)),
    "bring": ((1, 2, 3, 0, 4), (0, 1, 2, 4, 3)),
    "schwarz_p": ((1, 2, 3, 0, 4, 5), (3, 1, 2, 0, 5, 4)),
}
# Imaginary part of Braden and Northover's τ_0 = 1/2 + i y, where j(τ_0) = -29³ 5 / 2⁵ and
# j(5 τ_0) = -25 / 2.
_BRING = 0.5 + 0.18667646246280991j
_SCHWARZ = (
    0.269166028177015 + 0.798253480608103j,
    0.489412499102278 + 0.172166878055794j,
    0.510587500897723 - 0.172166878055794j,
)


def _klein() -> Complexes:
    return 0.5 * (np.ones((3, 3)) + ((-1 + 1j * np.sqrt(7)) / 2 - 1) * np.eye(3))


def _fermat() -> Complexes:
    u = (1 + 1j) / 2
    return np.array([[2 * u, -u, 0], [-u, 0.5 + 1j, u.conjugate()], [0, u.conjugate(), 1j]])


def _bring() -> Complexes:
    return _BRING * np.array([[4, 1, -1, 1], [1, 4, 1, -1], [-1, 1, 4, 1], [1, -1, 1, 4]])


def _schwarz_p() -> Complexes:
    a, b, c = _SCHWARZ
    return np.array([[a, b, c], [b, a, b], [c, b, a]])


_PERIOD_MATRICES: dict[str, Complexes] = {
    "klein": _klein(),
    "fermat": _fermat(),
    "bolza": square_tiled_period_matrix("omega_2"),
    "bring": _bring(),
    "schwarz_p": _schwarz_p(),
}


def regular_map_surface(name: str, n: int = 1) -> DeltaComplex:
    """Glue one of the named regular maps from unit polygons, each divided n-fold.

    Parameters
    ----------
    name : {"klein", "fermat", "bolza", "bring", "schwarz_p"}
    n : int

    Raises
    ------
    ComplexError
        If there is no map of that name, or ``n < 1``.

    Examples
    --------
    >>> [regular_map_surface("klein", n).n_vertices for n in (1, 2, 4, 8)]
    [24, 108, 444, 1788]
    """
    return regular_map(*_GENERATORS[_known(name)], n)


def regular_map_period_matrix(name: str) -> Complexes:
    """Return the exact period matrix of a named regular map; shape (g, g).

    Equal to the period matrix of :func:`regular_map_surface` up to the action of Sp(2g, Z).

    Raises
    ------
    ComplexError
        If there is no map of that name.
    """
    return _PERIOD_MATRICES[_known(name)].copy()


def regular_map(rotation: ArrayLike, flip: ArrayLike, n: int = 1) -> DeltaComplex:
    """Glue unit regular polygons as a rotation and a flip tell.

    Parameters
    ----------
    rotation : (N,) array-like of int
        The permutation r, as the tuple of its images.  Its order k ≥ 3 is the number of sides of
        each polygon.
    flip : (N,) array-like of int
        The permutation t, an involution.
    n : int
        Triangles are divided into n², squares into 2 n², k-gons into k n² triangles.

    Raises
    ------
    ComplexError
        If the generators are not permutations of the same points, r has order less than 3, t is no
        involution, or ``n < 1``.

    Examples
    --------
    >>> cube = regular_map([1, 2, 3, 0], [1, 0, 2, 3])  # S_4, faces of {4, 3}
    >>> cube.n_vertices, cube.genus
    (8, 0)
    """
    given = ((rotation, "rotation"), (flip, "flip"))
    r, t = (tuple(checked_permutation(x, name).tolist()) for x, name in given)
    if len(r) != len(t):
        raise ComplexError(f"rotation permutes {len(r)} points and flip permutes {len(t)}.")
    identity = tuple(range(len(t)))
    if t == identity or composed(t, t) != identity:
        raise ComplexError(
            f"the flip {t} is not an involution: gluing a side to another one twice must lead back."
        )
    polygon, side, glued = _darts(r, t)
    k = int(side.max()) + 1
    if k < 3:
        raise ComplexError(f"the rotation {r} has order {k}: a face has at least 3 sides.")
    if k == 4:
        darts = np.stack([polygon, side], axis=1).tolist()
        return DeltaComplex.from_squares(
            [(darts[x], darts[y]) for x, y in enumerate(glued) if x < y], n
        )
    twin = np.empty(polygon.size, dtype=np.int64)
    twin[k * polygon + side] = k * polygon[glued] + side[glued]
    lengths, gluing = _triangles(twin.reshape(-1, 3)) if k == 3 else _fans(twin, k)
    K = DeltaComplex.from_gluing(*subdivide(lengths, gluing, n))
    spoke = (np.abs(K.lengths * n - 1.0) > 1e-9).astype(np.int64)
    formulas = (root_of(Fraction(1, n * n)), partial(circumradius, k, n))
    return replace(K, exact_lengths=by_kind(K.edge, spoke, formulas))


def _darts(r: Permutation, t: Permutation) -> tuple[Ints, Ints, Ints]:
    """The pairs (face, side) of the elements x of the group, and the numbers of the x t."""
    number: dict[Permutation, int] = {}
    elements: list[Permutation] = []
    places: list[tuple[int, int]] = []
    faces = [tuple(range(len(r)))]
    n_faces = 0
    for start in faces:
        if start in number:
            continue
        x, side = start, 0
        while x not in number:
            number[x] = len(elements)
            elements.append(x)
            places.append((n_faces, side))
            faces.append(composed(x, t))
            x, side = composed(x, r), side + 1
        n_faces += 1
    glued = np.array([number[composed(x, t)] for x in elements])
    polygon, side_of = np.array(places).T
    return polygon, side_of, glued


def _triangles(twin: Ints) -> tuple[Floats, Ints]:
    return np.ones(twin.shape), twin


def _fans(twin: Ints, k: int) -> tuple[Floats, Ints]:
    """Cut every k-gon into k triangles with corners centre, start and end of a side."""
    side = np.arange(twin.size)
    following = np.where(side % k == k - 1, side - k + 1, side + 1)
    gluing = np.empty((twin.size, 3), dtype=np.int64)
    gluing[:, 0] = 3 * twin
    gluing[:, 1] = 3 * following + 2
    gluing[following, 2] = 3 * side + 1
    circumradius = 0.5 / np.sin(np.pi / k)
    lengths = np.empty((twin.size, 3))
    lengths[:] = 1.0, circumradius, circumradius
    return lengths, gluing


def _known(name: str) -> str:
    if name not in _GENERATORS:
        raise ComplexError(
            f"there is no regular map {name!r}; the names are {', '.join(_GENERATORS)}. "
            "Others: regular_map(rotation, flip)."
        )
    return name
