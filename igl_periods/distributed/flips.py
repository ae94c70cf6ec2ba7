r"""Delaunay flips on all ranks: inside the parts, then along the seams between them.

An edge can be flipped by whoever holds both of its triangles.  So each rank flips inside its own
part until only *seams*, the edges between parts, may be left; then the ranks send the triangles
along the seams to rank 0, which flips there with the rim of this strip held fast; and again, until
nothing is left to flip along the seams.  A triangle stays on its rank, with other corners and sides
after a flip: the seams move, the parts keep their size.

It ends for the same reason as flips in any order do: each makes the Dirichlet energy smaller, and
there are finitely many triangulations below a given energy.  Every edge is inside a part or along
a seam; so at the end all of them are Delaunay, and the triangulation is the one that a single
machine finds, up to diagonals of cocircular vertices, whose weight is 0.

**Boundaries.**  A side that is free must stay where it is.  Each is closed by a cone: a triangle on
that base whose long sides, glued to each other, are :math:`10^{30}` times as long.  The angle at
its apex has the cotangent :math:`10^{30}`, so that the base is Delaunay whatever the triangle
inside becomes; and an edge with the same triangle on both sides always is.

The strips have about :math:`16 \sqrt{n N}` triangles for n vertices on N ranks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from igl_periods.complexes import DeltaComplex, delaunay_flips, transport
from igl_periods.run_log import logger

from .collective import gathered_on_root, on_every_rank, on_root, scatter
from .pieces import Piece

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm

_CONE = 1e30
# Rings of triangles on either side of a seam; fewer take more rounds, more take more memory.
_RINGS = 2
# Should rounding flip an edge for ever, it stays as it is: the bound is true for any triangulation.
_MOST_ROUNDS = 100


def delaunay_on_all_ranks(comm: Intracomm, piece: Piece) -> Piece:
    """The piece of each rank of the intrinsic Delaunay triangulation.

    Collective.

    Parameters
    ----------
    piece : Piece
        The faces of this rank; those of all ranks make a closed surface.
    """
    for n in range(_MOST_ROUNDS):
        piece = on_every_rank(comm, lambda: flipped_inside(piece)[0])  # noqa: B023
        faces = piece.along_the_seams(_RINGS)
        after = _on_root(comm, piece.some(faces))
        if after is None:
            break
        logger.info("round %d along the seams", n + 1, extra={"seam_round": n + 1})
        piece = piece.replaced(faces, after)
    return piece


def _on_root(comm: Intracomm, strip: Piece) -> Piece | None:
    """The strip of each rank after flips along the seams; None if there was nothing to flip."""
    if comm.size == 1:
        return None
    strips = gathered_on_root(comm, strip)
    after = on_root(comm, lambda: flipped_along_seams(strips or []))
    return scatter(comm, lambda rank: (after[rank] if after else None,))[0]


def flipped_along_seams(strips: Sequence[Piece]) -> list[Piece] | None:
    """Flip in the union of some pieces; the same faces of each after that, None if none flipped."""
    joint, n_flips = flipped_inside(Piece.union(strips))
    if n_flips == 0:
        return None
    ends = np.cumsum([0, *(strip.n_faces for strip in strips)])
    return [joint.some(np.arange(a, b)) for a, b in pairwise(ends)]


def flipped_inside(piece: Piece) -> tuple[Piece, int]:
    """The piece with all edges Delaunay but those at its free sides; and the number of flips."""
    if piece.n_faces == 0:
        return piece, 0
    K, cochains, turned = piece.opened()
    flipped, rounds = delaunay_flips(_closed_by_cones(K))
    n_flips = sum(flips.edge.size for flips in rounds)
    if n_flips == 0:
        return piece, 0
    m = piece.n_faces
    edge = flipped.edge[:m]
    assert flipped.distortion is not None, "flips give account of their rounding"
    by_edge = transport(cochains, rounds).T.tocsr().multiply(turned[:, None])
    return Piece(
        lengths=flipped.lengths[:m],
        edge=piece.edges[edge],
        sign=flipped.sign[:m] * turned[edge],
        vertex=flipped.corner_vertex[:m],
        distortion=flipped.distortion[:m],
        edges=piece.edges,
        by_edge=by_edge.tocsr(),
    ), n_flips


def _closed_by_cones(K: DeltaComplex) -> DeltaComplex:
    """The complex with a cone on each free side; faces and edges keep their numbers."""
    free = np.flatnonzero(K.twin.ravel() < 0)
    if free.size == 0:
        return K
    cone = 3 * K.n_faces + 3 * np.arange(free.size)
    twin = np.concatenate([K.twin.ravel(), np.stack([free, cone + 2, cone + 1], axis=1).ravel()])
    twin[free] = cone
    base = K.lengths.ravel()[free]
    long = _CONE * base
    legs = K.n_edges + np.arange(free.size)
    edge = np.stack([K.edge.ravel()[free], legs, legs], axis=1)
    sign = np.stack([-K.sign.ravel()[free], *np.ones((1, free.size)), -np.ones(free.size)], axis=1)
    distortion = np.zeros(K.n_faces) if K.distortion is None else K.distortion
    return replace(
        K,
        lengths=np.concatenate([K.lengths, np.stack([base, long, long], axis=1)]),
        twin=twin.reshape(-1, 3),
        edge=np.concatenate([K.edge, edge]),
        sign=np.concatenate([K.sign, sign.astype(np.int8)]),
        corner_vertex=np.concatenate([K.corner_vertex, np.zeros((free.size, 3), dtype=np.int64)]),
        n_edges=K.n_edges + free.size,
        distortion=np.concatenate([distortion, np.zeros(free.size)]),
    )
