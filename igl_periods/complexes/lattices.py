r"""Quotients of periodic surfaces: a cell of a surface, glued by a lattice of translations.

A surface that a lattice Λ of one to three translations maps onto itself has the quotient M/Λ.  A
mesh of one cell has a boundary, and two of its corners are the same point of the quotient iff their
difference is in Λ, up to a tolerance for what the coordinates were rounded to.  A side from a to b
is known in the quotient by the points A, B and the translation n_b − n_a between their copies: two
straight sides with the same of these are translates of each other.  So sides are glued by what they
are in space, and a cell may have a single vertex.

Sides have the lengths that they have in the cell.  A mesh may also be closed already, its faces
joining vertices across the cell ("wrapped").  Then the vector of a side is the shortest one among
those that differ by Λ, and the three of a face have to add up to 0.

A vertex of the quotient has no position, but a corner of a face has one: the quotient keeps its
``cell``, which is what pictures show.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Bools, Floats, Ints
from igl_periods.errors import MeshError

from .checked_arrays import checked_array
from .gluings import components_of, twins_of_faces

# Independent translations span a parallelepiped of at least this part of the product of lengths.
_LEAST_VOLUME = 1e-9


@dataclass(frozen=True, eq=False, repr=False)
class Cell:
    """Where the faces of the quotient of a periodic surface lie in space.

    Attributes
    ----------
    corners : (m, 3, d) float
        The corners of each face; of the two sides of an edge, one is a translate of the other.
    lattice : (k, d) float
        One to three independent translations.
    """

    corners: Floats
    lattice: Floats

    def __repr__(self) -> str:
        return f"Cell({len(self.corners)} faces, {len(self.lattice)} translations)"

    def of_faces(self, face: Ints) -> Cell:
        """Some of the faces, in the order they are given in."""
        return Cell(self.corners[face], self.lattice)

    def doubled(self) -> Cell:
        """With the copy of each face, whose corners are those with the numbers 0, 2, 1."""
        return Cell(np.concatenate([self.corners, self.corners[:, [0, 2, 1]]]), self.lattice)

    def divided(self) -> Cell:
        """With each face divided into four, the last one in the middle."""
        middle = 0.5 * (np.roll(self.corners, -1, axis=1) + np.roll(self.corners, 1, axis=1))
        children = np.stack([middle] * 4, axis=1)
        for i in range(3):
            # At corner i the child has the corner itself, and the middles of both sides there.
            j, k = (i + 1) % 3, (i + 2) % 3
            children[:, i, i] = self.corners[:, i]
            children[:, i, j], children[:, i, k] = middle[:, k], middle[:, j]
        return Cell(children.reshape(-1, *self.corners.shape[1:]), self.lattice)


@dataclass(frozen=True, eq=False, repr=False)
class LatticeGluing:
    """The sides of a cell glued by a lattice, and what that took.

    Attributes
    ----------
    lengths : (m, 3) float
        Means of those of glued sides.
    twin, same : (m, 3) int, (m, 3) bool
        As for :meth:`DeltaComplex.from_gluing`.
    cell : Cell
    n_glued : int
        Edges that the lattice glued from two sides of the boundary, or wrapped.
    gap : float
        The largest distance of two corners from being translates, among those that were glued.
    """

    lengths: Floats
    twin: Ints
    same: Bools
    cell: Cell
    n_glued: int
    gap: float

    def __repr__(self) -> str:
        return f"LatticeGluing({len(self.twin)} faces, {self.n_glued} pairs of sides glued)"


def lattice_gluing(
    V: Floats, F: Ints, lattice: ArrayLike, tolerance: float = 1e-6
) -> LatticeGluing:
    """Glue the sides of a cell that differ by a translation of a lattice.

    Parameters
    ----------
    V : (n, d) float
    F : (m, 3) int
    lattice : (k, d) array-like
        One to three independent translations.
    tolerance : float
        How far corners may be from being translates, in parts of the shortest of them.

    Raises
    ------
    MeshError
        If the lattice is none, no side is glued by it, an edge gets more than two faces, or a
        wrapped face does not close up.
    """
    L = checked_lattice(lattice, V.shape[1])
    if not 0.0 < tolerance < 0.1:
        raise MeshError(f"tolerance = {tolerance}: a part of the shortest translation, below 0.1.")
    reach = tolerance * float(np.linalg.norm(L, axis=1).min())
    twin, same = twins_of_faces(F, np.arange(len(V)))
    if twin.min() >= 0:
        sides, lengths, n_wrapped = _wrapped_sides(V, F, L, reach)
        if n_wrapped == 0:
            raise MeshError(
                "the lattice glues nothing: the mesh is closed, and no side of it reaches across "
                f"the cell. Look at the translations {np.array2string(L, precision=6)}."
            )
        # Corner 1 is where side 2 leads from corner 0; side 1 leads from corner 2 to corner 0.
        steps = np.stack([np.zeros_like(sides[:, 0]), sides[:, 2], -sides[:, 1]], axis=1)
        cell = Cell(V[F[:, :1]] + steps, L)
        return LatticeGluing(lengths, twin, same, cell, n_wrapped, 0.0)
    point, place, gap = _points(V, F, twin, L, reach)
    n_glued = _glue(twin, same, F, point, place)
    if n_glued == 0:
        raise MeshError(
            "the lattice glues nothing: no two sides of the boundary are translates of each other "
            f"within {reach:.3g}. Look at the translations {np.array2string(L, precision=6)}."
        )
    sides = V[np.roll(F, 1, axis=1)] - V[np.roll(F, -1, axis=1)]
    lengths = np.linalg.norm(sides, axis=2)
    other = np.where(twin >= 0, lengths.ravel()[twin], lengths)
    return LatticeGluing(0.5 * (lengths + other), twin, same, Cell(V[F], L), n_glued, gap)


def checked_lattice(lattice: ArrayLike, d: int) -> Floats:
    """Translations as a (k, d) array.

    Raises
    ------
    MeshError
        If they are not one to three independent vectors of R^d.
    """
    array = checked_array(lattice, "lattice", MeshError)
    if array.ndim == 1 and array.size == d:
        array = array[None]
    if array.ndim != 2 or array.shape[1] != d or not 1 <= len(array) <= min(3, d):
        raise MeshError(
            f"a lattice is one to three translations of R^{d}, an array (k, {d}), not of shape "
            f"{array.shape}."
        )
    if array.dtype.kind not in "iuf" or not np.isfinite(array).all():
        raise MeshError("the translations of a lattice are finite real numbers.")
    L = array.astype(np.float64)
    norms = np.linalg.norm(L, axis=1)
    singular = np.linalg.svd(L / np.maximum(norms, 1e-300)[:, None], compute_uv=False)
    if norms.min() == 0.0 or singular.prod() < _LEAST_VOLUME:
        raise MeshError("the translations of a lattice are independent; these are not.")
    return L


def _points(V: Floats, F: Ints, twin: Ints, L: Floats, reach: float) -> tuple[Ints, Ints, float]:
    """The point of the quotient that each boundary vertex is, the cell it is in, and the gap.

    Returns
    -------
    point : (n,) int
        −1 for vertices that are not on the boundary.
    cell : (n, k) int
        V − cell · L agrees for all copies of a point.
    """
    from scipy.spatial import cKDTree  # slow to import

    side = np.flatnonzero(twin.ravel() < 0)
    tail, head = np.roll(F, -1, axis=1).ravel()[side], np.roll(F, 1, axis=1).ravel()[side]
    rim = np.union1d(tail, head)
    shift = np.floor(V[rim] @ np.linalg.pinv(L)).astype(np.int64)
    reduced = V[rim] - shift @ L
    steps = np.array(list(product((-1, 0, 1), repeat=len(L))))
    copies = (reduced[None] + (steps @ L)[:, None]).reshape(-1, V.shape[1])
    pairs = cKDTree(reduced).query_ball_tree(cKDTree(copies), reach)
    one = np.repeat(np.arange(rim.size), [len(near) for near in pairs])
    step, other = np.divmod(np.array([c for near in pairs for c in near], np.int64), rim.size)
    n, label = components_of(one, other, rim.size)
    first = np.full(n, rim.size, dtype=np.int64)
    np.minimum.at(first, label, np.arange(rim.size))
    # The step from the first vertex of a point to each of its copies.
    to_first = np.zeros((rim.size, len(L)), dtype=np.int64)
    seen = one == first[label[other]]
    to_first[other[seen]] = steps[step[seen]]
    # reduced[first] ≈ reduced[v] + to_first[v] L
    place = reduced + to_first @ L
    distance = np.linalg.norm(place - reduced[first[label]], axis=1)
    if distance.max() > reach:
        k = int(np.argmax(distance))
        raise MeshError(
            f"vertex {rim[k]} is a translate of others only through a chain of vertices closer "
            f"than {reach:.3g} to each other: the tolerance is larger than the triangles."
        )
    point = np.full(len(V), -1, dtype=np.int64)
    cell = np.zeros((len(V), len(L)), dtype=np.int64)
    point[rim], cell[rim] = label, shift - to_first
    return point, cell, float(distance.max())


def _glue(twin: Ints, same: Bools, F: Ints, point: Ints, cell: Ints) -> int:
    """Glue free sides with the same ends and translation, in place; returns how many edges."""
    tail, head = np.roll(F, -1, axis=1).ravel(), np.roll(F, 1, axis=1).ravel()
    # Inner edges between boundary vertices are there to be noticed where a third face meets them.
    side = np.flatnonzero((point[tail] >= 0) & (point[head] >= 0))
    ends = np.stack([point[tail[side]], point[head[side]]], axis=1)
    step = cell[head[side]] - cell[tail[side]]
    forward = np.column_stack([ends, step])
    backward = np.column_stack([ends[:, ::-1], -step])
    turned = _is_less(backward, forward)
    keys = np.where(turned[:, None], backward, forward)
    _, edge, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    edge = edge.ravel()
    if count.max() > 2:
        k = int(np.argmax(count[edge] > 2))
        raise MeshError(
            f"the edge from vertex {tail[side[k]]} to {head[side[k]]} would border "
            f"{count[edge[k]]} faces: the cell has two sheets there, or is more than one cell."
        )
    order = np.argsort(edge, kind="stable")
    paired = np.flatnonzero((np.diff(edge[order]) == 0) & (twin.ravel()[side[order]][:-1] < 0))
    one, other = order[paired], order[paired + 1]
    a, b = side[one], side[other]
    twin.ravel()[a], twin.ravel()[b] = b, a
    same.ravel()[a] = same.ravel()[b] = turned[one] == turned[other]
    return int(a.size)


def _is_less(A: Ints, B: Ints) -> Bools:
    """Whether rows of A come before those of B in lexicographic order."""
    differ = A != B
    first = np.argmax(differ, axis=1)
    row = np.arange(len(A))
    return np.asarray(differ.any(axis=1) & (A[row, first] < B[row, first]))


def _wrapped_sides(V: Floats, F: Ints, L: Floats, reach: float) -> tuple[Floats, Floats, int]:
    """Minimal images of the sides of a closed mesh, their lengths, how many edges are wrapped."""
    sides = V[np.roll(F, 1, axis=1)] - V[np.roll(F, -1, axis=1)]
    rounded = np.rint(sides @ np.linalg.pinv(L))
    best, shortest = sides - rounded @ L, np.full(F.shape, np.inf)
    start = best
    # Where translations are oblique, the rounded one may be a neighbour of the best one.
    for step in product((-1, 0, 1), repeat=len(L)):
        image = start + np.array(step) @ L
        length = np.linalg.norm(image, axis=2)
        closer = length < shortest - reach
        best = np.where(closer[..., None], image, best)
        shortest = np.where(closer, length, shortest)
    open_faces = np.linalg.norm(best.sum(axis=1), axis=1) > 3 * reach
    if open_faces.any():
        raise MeshError(
            f"{np.count_nonzero(open_faces)} faces do not close up by the shortest images of their "
            f"sides; the first is face {int(np.argmax(open_faces))}. Sides of a wrapped mesh are "
            "shorter than half of every translation: refine it, or hand over a cell with its "
            "boundary."
        )
    wrapped = np.linalg.norm(best - sides, axis=2) > reach
    return best, shortest, int(np.count_nonzero(wrapped)) // 2
