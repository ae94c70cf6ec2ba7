r"""Some faces divided into three, by a vertex at the barycentre.

The surface is flat there, and no point of it moves.  A closed cochain passes to the new
triangulation without a choice but for its values on the new edges: the edge from the new vertex to
corner 0 gets the value 0, and closedness gives the others.

The children of a needle of angle θ are caps, with angles of about π − θ; their lengths say
something about them only while θ² is well above rounding.  :func:`is_divisible` tells.  What lies
next to a needle can be divided all the same, and the flips that follow shorten its long sides.

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
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array, hstack

from igl_periods.arrays import Floats, Ints
from igl_periods.display import arrays_repr
from igl_periods.errors import ComplexError

from .cochains import check_cochains
from .delta_complex import DeltaComplex
from .triangles import is_strict, length_sensitivity

_SIDE = np.arange(3)
_AFTER, _BEFORE = (_SIDE + 1) % 3, (_SIDE + 2) % 3
# Children whose metric rounding changes by more than this times an ulp are too thin: 4/θ² = 1e8.
_LARGEST_SENSITIVITY = 1e8


@dataclass(frozen=True, eq=False)
class Barycentres:
    """Which faces were divided at their barycentres.

    Attributes
    ----------
    edge : (3 r,) int
        The new edges, those from each barycentre to the corners 0, 1, 2 of its face.
    sides : (r, 3) int
        The edges of the divided faces.
    """

    edge: Ints
    sides: Ints

    __repr__ = arrays_repr

    @classmethod
    def of(cls, K: DeltaComplex, faces: Ints) -> Barycentres:
        """As :func:`insert_barycentres` makes them."""
        return cls(K.n_edges + np.arange(3 * len(faces)), K.edge[faces])


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
        If ``cochains`` does not have one column an edge, or the sides of a child would not fulfil
        the strict triangle inequality in floating-point numbers (:func:`is_divisible`).
    """
    check_cochains(K, cochains)
    _check_children(K, faces)
    r, m = len(faces), K.n_faces
    child = np.stack([faces, m + np.arange(r), m + r + np.arange(r)], axis=1)
    moved = np.arange(K.twin.size)
    moved.reshape(-1, 3)[faces] = 3 * child + _SIDE
    twin = np.where(K.twin >= 0, moved[K.twin], -1)
    distance = barycentre_distances(K.lengths[faces])
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
        exact_lengths=None,
        polygons=None,
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
        cell=None,
    )
    before = np.zeros(m) if K.distortion is None else K.distortion
    distortion = np.concatenate([before, before[faces], before[faces]])
    distortion[child] += length_sensitivity(finer.lengths[child.ravel()]).reshape(-1, 3)
    finer = replace(finer, distortion=distortion)
    return finer, csr_array(hstack([cochains, _on_new_edges(K, cochains, faces)], format="csr"))


def is_divisible(lengths: Floats) -> NDArray[np.bool_]:
    """Whether floating-point lengths describe the three children of each triangle well; (r,).

    Parameters
    ----------
    lengths : (r, 3) float
    """
    children = _children(lengths)
    strict = is_strict(children)
    good = strict.copy()
    good[strict] = length_sensitivity(children[strict]) < _LARGEST_SENSITIVITY
    return np.asarray(good.reshape(-1, 3).all(axis=1))


def _check_children(K: DeltaComplex, faces: Ints) -> None:
    degenerate = ~is_strict(_children(K.lengths[faces])).reshape(-1, 3).all(axis=1)
    if degenerate.any():
        face = int(faces[np.argmax(degenerate)])
        raise ComplexError(
            f"{np.count_nonzero(degenerate)} faces are too thin to be divided at their barycentres "
            f"in double precision; the first is face {face}, with the sides "
            f"{K.lengths[face].tolist()}. Leave such faces whole."
        )


def _children(lengths: Floats) -> Floats:
    """Sides of the children of triangles, three rows for each; (3 r, 3)."""
    distance = barycentre_distances(lengths)
    child = np.stack([lengths, distance[:, _BEFORE], distance[:, _AFTER]], axis=2)
    return child.reshape(-1, 3)


def barycentre_distances(lengths: Floats) -> Floats:
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
