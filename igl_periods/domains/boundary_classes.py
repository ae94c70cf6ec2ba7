r"""The boundary loops of a surface, and the classes of cohomology that they make on its double.

The boundary of an oriented surface K is a set of closed curves C_1 … C_n, each run with K on its
left.  Let χ_i be 1 on the vertices of C_i and 0 on all others.  The differential dχ_i vanishes
along the boundary, so that it is closed on the double L if it is continued by 0 to the second
sheet.  That is the class β_i, with the value 1 on a path that enters C_i in the first sheet and
leaves it in the second one, and 0 on C_1 … C_n themselves.

The function that is 1 on the whole boundary and on the second sheet has the differential
Σ β_i: it is exact, and any n − 1 of the β_i are independent.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import (
    DeltaComplex,
    check_connected,
    double,
    forward_half_edges,
    half_edge_ends,
    is_orientable,
    lift,
)
from igl_periods.display import counted
from igl_periods.errors import ComplexError


@dataclass(frozen=True, eq=False, repr=False)
class BoundaryLoop:
    """A closed curve of the boundary, with the surface on its left.

    Attributes
    ----------
    half_edges : (k,) int
        Sides ``3 f + s`` without a neighbour, in their order along the loop.
    vertices : (k,) int
        The vertices of the complex at which they start.
    length : float
    point : (d,) float or None
        The place of the first vertex, where the surface has one.
    """

    half_edges: Ints
    vertices: Ints
    length: float
    point: Floats | None

    def __repr__(self) -> str:
        where = (
            "" if self.point is None else f" through ({', '.join(f'{x:.6g}' for x in self.point)})"
        )
        return f"BoundaryLoop({counted(len(self.vertices), 'edge', 'edges')}{where})"


def boundary_loops(K: DeltaComplex) -> list[BoundaryLoop]:
    """The boundary loops of an oriented surface, that with the first vertex first.

    A loop starts at its first vertex.  So the loops of a
    :func:`~igl_periods.surfaces.planar_domain` are the outer boundary and then the holes.

    Raises
    ------
    ComplexError
        If orientations of faces disagree.
    """
    check_oriented(K)
    tail, _ = half_edge_ends(K)
    free = np.flatnonzero(K.twin.ravel() < 0)
    # The faces at a vertex are one fan, so that at most one free side starts there.
    leaving = dict(zip(tail[free].tolist(), free.tolist()))
    _, head = half_edge_ends(K)
    loops = []
    for first in sorted(leaving):
        walk, vertex = [], first
        while vertex in leaving:
            walk.append(leaving.pop(vertex))
            vertex = int(head[walk[-1]])
        if walk:
            loops.append(_loop(K, np.array(walk, dtype=np.int64), tail))
    return loops


def check_oriented(K: DeltaComplex) -> None:
    """Raise unless the surface is oriented and connected; it may have a boundary.

    Raises
    ------
    ComplexError
    """
    if K.n_reversing_edges:
        way = (
            "Turn faces over until they agree (load_mesh(…, repair=True), --repair)."
            if is_orientable(K)
            else "The surface is not orientable: its boundary loops have no capacities here."
        )
        raise ComplexError(
            f"orientations of faces disagree across {K.n_reversing_edges} edges. {way}"
        )
    check_connected(K)


def doubled_with_classes(
    K: DeltaComplex, loops: list[BoundaryLoop]
) -> tuple[DeltaComplex, csr_array]:
    """The double of a surface, and the cochains β_i of its boundary loops.

    Parameters
    ----------
    K : DeltaComplex
        Oriented and connected.
    loops : list of BoundaryLoop
        Some of its loops.

    Returns
    -------
    double : DeltaComplex
    classes : (len(loops), double.n_edges) sparse int
        The closed cochains β_i.
    """
    L = double(K)
    chi = np.zeros((len(loops), K.n_vertices), dtype=np.int64)
    for row, loop in zip(chi, loops):
        row[loop.vertices] = 1
    tail, head = half_edge_ends(K)
    forward = forward_half_edges(K)
    differentials = csr_array(chi[:, head[forward]] - chi[:, tail[forward]])
    # Edges of the second sheet alone lie above no side of the first one.
    lifted = lift(K, L, differentials)
    first = np.zeros(L.n_edges, dtype=np.int64)
    first[L.edge[: K.n_faces].ravel()] = 1
    return L, csr_array(lifted * first[None, :])


def _loop(K: DeltaComplex, walk: Ints, tail: Ints) -> BoundaryLoop:
    vertices = tail[walk]
    point = None if K.positions is None else np.asarray(K.positions[vertices[0]])
    return BoundaryLoop(walk, vertices, float(K.lengths.ravel()[walk].sum()), point)
