"""The same triangulation with other lengths, and lengths as functions of positions.

Triangulations are not touched here: gluing, edges and vertices keep their numbers, so that cochains
and markings stay what they are while the metric moves.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import ComplexError

from .delta_complex import DeltaComplex
from .half_edges import edge_ends
from .triangles import is_strict, slacks

_AGREEMENT = 1e-9


def edge_lengths(K: DeltaComplex) -> Floats:
    """Length of each edge; (n_edges,)."""
    lengths = np.empty(K.n_edges)
    lengths[K.edge.ravel()] = K.lengths.ravel()
    return lengths


def with_edge_lengths(K: DeltaComplex, lengths: ArrayLike) -> DeltaComplex:
    """The same triangulation with other lengths of its edges; it has no positions any more.

    Parameters
    ----------
    lengths : (n_edges,) array-like
        In the order of the edges of ``K``; see :func:`edge_ends`.

    Raises
    ------
    ComplexError
        If the shape is wrong, lengths are not positive and finite, or a triangle inequality fails.
    """
    given = np.array(lengths, dtype=np.float64)
    if given.shape != (K.n_edges,):
        raise ComplexError(f"a length for each of {K.n_edges} edges is needed, not {given.shape}.")
    if not (np.isfinite(given).all() and (given > 0.0).all()):
        raise ComplexError("lengths of edges are positive and finite; these are not.")
    sides = given[K.edge]
    broken = np.flatnonzero(~is_strict(sides))
    if broken.size:
        slack = float(slacks(sides)[broken[0]])
        raise ComplexError(
            f"these lengths break the triangle inequality of {broken.size} faces; of face "
            f"{broken[0]}, with the sides {sides[broken[0]].tolist()}, by {-slack:.3g}. Take a "
            "smaller step."
        )
    return replace(
        K,
        lengths=sides,
        positions=None,
        mollification=0.0,
        distortion=None,
        exact_lengths=None,
        polygons=None,
        cell=None,
    )


def with_positions(K: DeltaComplex, positions: ArrayLike) -> DeltaComplex:
    """The same triangulation with its vertices elsewhere; lengths follow.

    Parameters
    ----------
    positions : (n_vertices, d) array-like

    Raises
    ------
    ComplexError
        If the shape is wrong, or a triangle degenerates.
    """
    given = np.array(positions, dtype=np.float64)
    if K.positions is None or given.shape != K.positions.shape:
        has = "no positions" if K.positions is None else f"positions {K.positions.shape}"
        raise ComplexError(f"positions of shape {given.shape} for a surface with {has}.")
    tail, head = edge_ends(K)
    moved = with_edge_lengths(K, np.linalg.norm(given[head] - given[tail], axis=1))
    return replace(moved, positions=given)


def edge_directions(K: DeltaComplex) -> tuple[Ints, Ints, Floats]:
    """Ends of the edges, and the unit vectors (n_edges, d) from the first to the second.

    Raises
    ------
    ComplexError
        If the complex has no positions, or its lengths are not the distances between them.
    """
    if K.positions is None:
        raise ComplexError(
            "the surface has no positions, only lengths: take derivatives by lengths. A surface "
            "made of V and F has positions."
        )
    tail, head = edge_ends(K)
    vectors = K.positions[head] - K.positions[tail]
    distance = np.linalg.norm(vectors, axis=1)
    lengths = edge_lengths(K)
    if np.any(np.abs(distance - lengths) > _AGREEMENT * lengths + 2.0 * K.mollification):
        raise ComplexError(
            "the lengths of this surface are not the distances of its vertices, so its positions "
            "say nothing of how lengths move: take derivatives by lengths."
        )
    return tail, head, vectors / distance[:, None]
