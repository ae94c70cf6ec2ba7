r"""Finer triangulations of the same surface, where the certificate asks for them.

A face gets a new vertex at its barycentre, which divides it into three.  The surface is flat
there, and no point of it moves: so a refined triangulation has the same period matrix, and a
closed cochain passes to it without a choice but for its values on the new edges: here the edge
from the new vertex to corner 0 gets the value 0, and closedness gives the others.

Delaunay flips are to follow.  On a region of equilateral triangles the two together are
√3-subdivision (Kobbelt 2000).

.. code-block:: text

            2
           /|\                  Child s has the corners of its parent, but for corner s, which is
          / | \                 the new vertex; so its side s is that of the parent.  Child 0 keeps
         /  |  \                the index of the parent.
        / 1 * 0 \
       / .     . \
      0-----------1
            2
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, hstack

from .delaunay import intrinsic_delaunay
from .delta_complex import DeltaComplex, cotan_weights
from .energy_excess import energy_excess
from .harmonic import dirichlet_matrix, harmonic_potentials
from .homology import check_cochains, cohomology_basis
from .periods import PeriodMatrix
from .refinement import split
from .rounding import LEAST_ALLOWANCE, geometric_allowance
from .stages import stage
from .triangles import length_sensitivity

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# The faces that are refined hold this part of the excess of energy (Dörfler's marking).
_MARKED_PART = 0.5

_SIDE = np.arange(3)
_AFTER, _BEFORE = (_SIDE + 1) % 3, (_SIDE + 2) % 3


@dataclass(frozen=True, eq=False)
class Refined:
    """A refined triangulation and the period matrix it gives.

    Attributes
    ----------
    period_matrix : PeriodMatrix
        In the marking of the surface as it was given, which is its ``complex``.
    complex : DeltaComplex
        The refined intrinsic Delaunay triangulation.
    cochains : (2g, n_edges) sparse int
        The marking on it.
    steps : tuple of (int, float)
        Number of faces and bound, before and after every step.
    """

    period_matrix: PeriodMatrix
    complex: DeltaComplex
    cochains: csr_array
    steps: tuple[tuple[int, float], ...]


def insert_barycentres(
    K: DeltaComplex, cochains: csr_array, faces: Ints
) -> tuple[DeltaComplex, csr_array]:
    """Divide faces into three at their barycentres.

    Parameters
    ----------
    K : DeltaComplex
        Any complex.
    cochains : (k, n_edges) sparse int
        Closed.
    faces : (r,) int
        Without repetition.

    Returns
    -------
    K : DeltaComplex
        The same surface.  Old vertices and edges keep their index; the barycentre of ``faces[i]``
        is vertex ``n_vertices + i``, with label -1, and the edges from it to the corners 0, 1, 2
        are ``n_edges + 3 i`` … ``n_edges + 3 i + 2``.  It has no positions.
    cochains : (k, n_edges + 3 r) sparse int
        The same cohomology classes.

    Raises
    ------
    ComplexError
        If ``cochains`` does not have one column an edge.
    """
    check_cochains(K, cochains)
    r, m = len(faces), K.n_faces
    child = np.stack([faces, m + np.arange(r), m + r + np.arange(r)], axis=1)
    moved = np.arange(K.twin.size)
    moved.reshape(-1, 3)[faces] = 3 * child + _SIDE
    twin = np.where(K.twin >= 0, moved[K.twin], -1)
    distance = _barycentre_distances(K.lengths[faces])
    new_edge = K.n_edges + np.arange(3 * r).reshape(-1, 3)
    new_vertex = np.broadcast_to(K.n_vertices + np.arange(r)[:, None], (r, 3))
    own = K.corner_vertex[faces]

    # Side s + 1 of child s runs from corner s + 2 to the new vertex, and is glued to side s of
    # child s + 1; side s + 2 runs from the new vertex to corner s + 1.
    def replaced(array: NDArray[Any], at: Any, after: Any, before: Any) -> NDArray[Any]:
        values = np.empty((r, 3, 3), dtype=array.dtype)
        values[:, _SIDE, _SIDE], values[:, _SIDE, _AFTER], values[:, _SIDE, _BEFORE] = (
            at,
            after,
            before,
        )
        whole = np.concatenate([array, values[:, 1], values[:, 2]])
        whole[faces] = values[:, 0]
        return whole

    finer = replace(
        K,
        lengths=replaced(K.lengths, K.lengths[faces], distance[:, _BEFORE], distance[:, _AFTER]),
        twin=replaced(
            twin, twin[faces], 3 * child[:, _AFTER] + _SIDE, 3 * child[:, _BEFORE] + _SIDE
        ),
        edge=replaced(K.edge, K.edge[faces], new_edge[:, _BEFORE], new_edge[:, _AFTER]),
        sign=replaced(K.sign, K.sign[faces], -1, 1),
        corner_vertex=replaced(K.corner_vertex, new_vertex, own[:, _AFTER], own[:, _BEFORE]),
        n_vertices=K.n_vertices + r,
        n_edges=K.n_edges + 3 * r,
        labels=np.concatenate([K.labels, np.full(r, -1)]),
        positions=None,
    )
    before = np.zeros(m) if K.distortion is None else K.distortion
    distortion = np.concatenate([before, before[faces], before[faces]])
    distortion[child] += length_sensitivity(finer.lengths[child.ravel()]).reshape(-1, 3)
    finer = replace(finer, distortion=distortion)
    return finer, csr_array(hstack([cochains, _on_new_edges(K, cochains, faces)], format="csr"))


def _barycentre_distances(lengths: Floats) -> Floats:
    """Distances of the barycentre from the corners; (r, 3).

    Two thirds of the medians, 9 d² = 2 b² + 2 c² − a² = (b − c)² + (b + c − a)(b + c + a) for the
    corner opposite side a; differences of lengths are taken first.
    """
    distance = np.empty_like(lengths)
    for s in range(3):
        a, one, other = lengths[:, s], lengths[:, s - 2], lengths[:, s - 1]
        b, c = np.maximum(one, other), np.minimum(one, other)
        distance[:, s] = np.sqrt((b - c) ** 2 + (c - (a - b)) * (a + b + c)) / 3.0
    return distance


def _on_new_edges(K: DeltaComplex, cochains: csr_array, faces: Ints) -> csr_array:
    """Values from the barycentres to the corners 0, 1, 2, the first of them 0; (k, 3 r)."""
    r = len(faces)
    columns = 3 * np.arange(r)
    values = np.concatenate([K.sign[faces, 2], -K.sign[faces, 1]]).astype(np.int64)
    rows = np.concatenate([K.edge[faces, 2], K.edge[faces, 1]])
    step = csr_array(
        (values, (rows, np.concatenate([columns + 1, columns + 2]))), shape=(K.n_edges, 3 * r)
    )
    return csr_array(cochains @ step)


def refined_period_matrix(
    K: DeltaComplex, bound: float, *, largest: int = 200_000, local: bool = True
) -> Refined:
    """Refine intrinsically until the period matrix has a wanted bound.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.
    bound : float
        The wanted bound, > 0.
    largest : int
        No triangulation with more faces is made; where the bound is not reached by then, the last
        result is returned.
    local : bool
        Refine where the bound comes from (:mod:`igl_periods.energy_excess`), or divide every face
        into four each time.

    Raises
    ------
    ValueError
        If ``bound`` is not positive.
    ComplexError
        If the surface is not closed, oriented and connected.
    """
    if not bound > 0:
        raise ValueError(f"the wanted bound must be positive, not {bound}.")
    cocycles = cohomology_basis(K)
    L, cochains = intrinsic_delaunay(K, cocycles)
    steps: list[tuple[int, float]] = []
    while True:
        potentials = harmonic_potentials(L, cotan_weights(L), cochains)
        pm = _period_matrix(K, cocycles, L, cochains, potentials)
        steps.append((L.n_faces, float(pm.bound or 0.0)))
        room = largest - L.n_faces
        if steps[-1][1] <= bound or room < (2 if local else 3 * L.n_faces):
            return Refined(pm, L, cochains, tuple(steps))
        with stage(f"refining {L.n_faces} faces"):
            if local:
                excess = energy_excess(L, cochains, potentials, pm.dirichlet).sum(axis=0)
                finer = insert_barycentres(L, cochains, _marked(excess)[: room // 2])
            else:
                finer = split(L, cochains)
            L, cochains = intrinsic_delaunay(*finer)


def _period_matrix(
    K: DeltaComplex,
    cocycles: csr_array,
    L: DeltaComplex,
    cochains: csr_array,
    potentials: Floats,
) -> PeriodMatrix:
    """The period matrix of K, by forms on its refinement L."""
    D = dirichlet_matrix(L, cochains, potentials)
    rounding = geometric_allowance(L, D, partial(dirichlet_matrix, L, cochains, potentials))
    return PeriodMatrix(D, True, cocycles, K, max(LEAST_ALLOWANCE, rounding))


def _marked(excess: Floats) -> Ints:
    """The fewest faces that hold half of the excess, the worst first."""
    order = np.argsort(-excess, kind="stable")
    held = np.cumsum(excess[order])
    return order[: 1 + int(np.searchsorted(held, _MARKED_PART * held[-1]))]
