r"""Cyclic covers of the sphere, yⁿ = ∏ (x − e_i)^{m_i}, as glued triangles.

The curve is an n-sheeted cover of the x-sphere: round e_i the sheets change as y ↦ e^{2πi m_i/n} y,
round ∞ as for the multiplicity m_∞ = −Σ m_i.  So ∞ is a branch point iff n does not divide Σ m_i, a
branch point has gcd(n, m_i) preimages, each of total angle 2πν with ν = n / gcd(n, m_i), and the
cover is connected iff gcd(n, m_1, m_2, …) = 1.  Riemann–Hurwitz gives the genus,

.. math:: 2g - 2 = -2n + \sum_i (n - \gcd(n, m_i)),

∞ included.  Hyperelliptic curves are the case n = 2, m_i = 1.

*The mesh.*  A Möbius transformation, which changes nothing, moves the branch points on the unit
sphere until their centre of gravity is the origin.  With them among its vertices the sphere is
triangulated (:mod:`.spheres`), and n copies of each triangle are glued as a cocycle with values in
Z/n on the dual edges tells: it is supported on paths in a tree of edges that join the branch points
to a root, and sheets move by m_i across the path to e_i.

The polyhedral sphere is inscribed in the round one, so the surface converges to the curve like h².
At the branch points of angle 2πν harmonic functions behave like r^{1/ν}, and the error of piecewise
linear ones like h^{2/ν}.  Triangles graded towards the branch points, of size h r^{1−μ} at the
distance r with μ = 3/(4ν), restore h².

References
----------
Farkas, Kra, "Riemann surfaces", chapter III.7.
Apel, "Anisotropic finite elements" (1999), for graded meshes.
"""

from __future__ import annotations

from collections.abc import Callable
from math import gcd

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex
from igl_periods.errors import ComplexError
from igl_periods.topology import tree_cotree

from .sphere_meshes import refined_sphere

_GRADING = 0.75
_NEAREST_BRANCH_POINTS = 1e-4
_SMALLEST_TRIANGLE = 1e-5


def cyclic_cover(
    n: int,
    branch_points: ArrayLike,
    multiplicities: ArrayLike | None = None,
    size: float = 0.2,
    *,
    graded: bool = False,
) -> DeltaComplex:
    """Glue a polyhedral surface that approximates the curve yⁿ = ∏ (x − e_i)^{m_i}.

    Parameters
    ----------
    n : int
        Number of sheets, at least 2.
    branch_points : (k,) array-like of complex
        The finite branch points e_i.
    multiplicities : (k,) array-like of int, optional
        The m_i, not multiples of n; all 1 if not given.
    size : float
        Largest circumradius of a triangle on the unit sphere, 0 < size ≤ 1.
    graded : bool
        Make triangles smaller towards the branch points.

    Returns
    -------
    DeltaComplex
        Its period matrix is that of the curve up to O(size²), and up to the action of Sp(2g, Z).

    Raises
    ------
    ComplexError
        If n < 2, branch points coincide or are not finite, multiplicities are multiples of n, the
        cover is not connected or has less than three branch points, or the size is out of range.

    Examples
    --------
    >>> cyclic_cover(2, [0, 1, -1, 1j, -1j]).genus
    2
    >>> cyclic_cover(3, [0, 1, 2, 3], [1, 1, 2, 2]).genus
    2
    """
    points, orders = _checked_branching(n, branch_points, multiplicities)
    if not 0 < size <= 1:
        raise ComplexError(f"size = {size}: take a circumradius on the unit sphere, 0 < size <= 1.")
    branching = centred(points)
    _check_apart(branching)
    sheets = np.array([n // gcd(n, int(m)) for m in orders])
    wanted = _graded_size(branching, sheets, size) if graded else _uniform_size(size)
    V, F = refined_sphere(_with_corners(branching), wanted)
    base = DeltaComplex.from_mesh(V, F)
    return _lifted(base, _sheet_changes(base, orders, n), n)


def centred(points: Floats) -> Floats:
    """Move points on the unit sphere by a Möbius transformation to have their mean at the origin.

    Parameters
    ----------
    points : (k, 3) float
        At least three distinct unit vectors.

    Notes
    -----
    The transformations x ↦ (1 − c²)(x − c)/|x − c|² − c of the ball take c to the origin; applied
    to the mean again and again, they bring it there (Springborn 2005 on uniqueness).
    """
    for _ in range(10_000):
        c = points.mean(axis=0)
        if np.linalg.norm(c) < 1e-13:
            break
        away = points - c
        points = (1 - c @ c) * away / np.sum(away**2, axis=1, keepdims=True) - c
        points /= np.linalg.norm(points, axis=1, keepdims=True)
    return points


def on_sphere(x: Complexes) -> Floats:
    """Points of the unit sphere over complex numbers, orientation preserved; ∞ is (0, 0, −1)."""
    square = np.abs(x) ** 2
    return np.stack([2 * x.real, 2 * x.imag, 1 - square], axis=-1) / (1 + square)[..., None]


def _checked_branching(
    n: int, branch_points: ArrayLike, multiplicities: ArrayLike | None
) -> tuple[Floats, Ints]:
    """Branch points on the sphere, with ∞ if it is one, and their multiplicities mod n."""
    if n < 2 or n != int(n):
        raise ComplexError(f"n = {n} sheets: a branched cover has at least 2.")
    e = np.asarray(branch_points, dtype=np.complex128).ravel()
    m = np.ones(e.size, dtype=np.int64) if multiplicities is None else np.asarray(multiplicities)
    if m.shape != e.shape or m.dtype.kind not in "iu":
        raise ComplexError(f"{e.size} branch points need {e.size} integer multiplicities, not {m}.")
    if not np.isfinite(e).all():
        raise ComplexError("branch points must be finite; ∞ is one iff n does not divide Σ m_i.")
    if np.any(m % n == 0):
        raise ComplexError(
            f"multiplicity {m[np.argmax(m % n == 0)]} is a multiple of n = {n}: leave out that "
            "point, it is not a branch point."
        )
    if (common := gcd(n, *m.tolist())) > 1:
        raise ComplexError(
            f"the cover is not connected: n = {n} and all multiplicities are divisible by "
            f"{common}, so that it falls into {common} covers of {n // common} sheets."
        )
    points, orders = on_sphere(e), m % n
    if (total := int(m.sum())) % n:
        points = np.concatenate([points, [[0.0, 0.0, -1.0]]])
        orders = np.append(orders, -total % n)
    if len(points) < 3:
        raise ComplexError(
            f"a cover with {len(points)} branch points is a sphere; at least three are needed."
        )
    _check_distinct(e)
    return points, orders


def _check_distinct(e: Complexes) -> None:
    values, count = np.unique(e, return_counts=True)
    if np.any(count > 1):
        raise ComplexError(
            f"branch points coincide: {values[np.argmax(count > 1)]} occurs {count.max()} times. "
            "Add up the multiplicities of equal points."
        )


def _check_apart(points: Floats) -> None:
    """Raise if branch points nearly coincide, however the sphere is moved."""
    distance = np.linalg.norm(points[:, None] - points, axis=2) + 2 * np.eye(len(points))
    if distance.min() < _NEAREST_BRANCH_POINTS:
        raise ComplexError(
            f"branch points nearly coincide: spread over the unit sphere as well as a Möbius "
            f"transformation can, two are {distance.min():.3g} apart, and a mesh needs "
            f"{_NEAREST_BRANCH_POINTS:g}."
        )


def _uniform_size(size: float) -> Callable[[Floats], Floats]:
    return lambda x: np.full(len(x), size)


def _graded_size(points: Floats, sheets: Ints, size: float) -> Callable[[Floats], Floats]:
    """Sizes h (r/R)^{1−μ} within R of a branch point, R half the distance to the next one."""
    distance = np.linalg.norm(points[:, None] - points, axis=2) + 4 * np.eye(len(points))
    R = 0.5 * distance.min(axis=1)
    mu = _GRADING / sheets
    innermost = np.maximum(np.minimum(size / R, 1.0) ** (1 / mu), _SMALLEST_TRIANGLE)

    def wanted(x: Floats) -> Floats:
        r = np.linalg.norm(x[:, None] - points, axis=2) / R
        return np.asarray(size * np.min(np.clip(r, innermost, 1.0) ** (1 - mu), axis=1))

    return wanted


def _with_corners(points: Floats) -> Floats:
    """The points, and those vertices of an octahedron that are not near them."""
    octahedron = np.concatenate([np.eye(3), -np.eye(3)])
    distance = np.linalg.norm(octahedron[:, None] - points, axis=2).min(axis=1)
    return np.concatenate([points, octahedron[distance > 0.5]])


def _sheet_changes(base: DeltaComplex, orders: Ints, n: int) -> Ints:
    """By how many sheets one moves across each half-edge; (m, 3).  Vertex i has holonomy m_i."""
    parent = tree_cotree(base).vertex_parent
    twin, ahead = base.twin.ravel(), np.zeros(base.twin.size, dtype=np.int64)
    for branch_vertex, m in enumerate(orders):
        vertex = branch_vertex
        # Counterclockwise round the vertex, the edge from its parent is crossed from the face on
        # its left, that of the half-edge.
        while (half_edge := int(parent[vertex])) >= 0:
            ahead[half_edge] += m
            ahead[twin[half_edge]] -= m
            vertex = int(base.corner_vertex[half_edge // 3, (half_edge + 1) % 3])
    return (ahead % n).reshape(-1, 3)


def _lifted(base: DeltaComplex, changes: Ints, n: int) -> DeltaComplex:
    """Glue n copies of every face with changes of sheets; copy s of face f is s m + f."""
    sheet = np.arange(n)[:, None, None]
    shift = 3 * base.n_faces * ((sheet + changes) % n)
    twin = (base.twin + shift).reshape(-1, 3)
    return DeltaComplex.from_gluing(np.tile(base.lengths, (n, 1)), twin)
