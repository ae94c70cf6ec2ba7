r"""Lawson's minimal surfaces ξ_{m,k} in the 3-sphere, as meshes.

With e(t) = exp(2π√−1 t), take the points

.. math:: P_i = \big(e(\tfrac{i}{2k+2}), 0\big), \qquad Q_j = \big(0, e(\tfrac{j}{2m+2})\big)

on two polar great circles of S³ ⊂ C², i modulo 2k + 2 and j modulo 2m + 2.
For i + j even, the geodesic quadrilateral P_i Q_j P_{i+1} Q_{j+1} bounds a unique minimal disc,
with angles π/(m+1) at the P and π/(k+1) at the Q.  Half-turns about the geodesics P_i Q_j continue
it: 2(k+1)(m+1) discs, with 4(k+1)(m+1) sides, make the closed embedded minimal surface ξ_{m,k} of
genus mk.

The disc is symmetric under both reflections that exchange its opposite corners.  A quarter of it is
a disc with three marked points, of which there is one conformal class; so any surface made of
quadrilaterals with these symmetries, glued in the same way, is conformal to ξ_{m,k}.  Glued from
equilateral triangles it is the domain of a harmonic map that is conformal (:mod:`.plateau`), and
its period matrix is known (:mod:`.lawson_periods`).

The numbers of vertices are 2 − 2mk + (k+1)(m+1) T n², T the number of triangles in the
pattern of a disc (:mod:`.lawson_disc`).
Angles shrink as the corners do, like π/(m+1) and π/(k+1): meshes of ξ_{m,1} with m ≥ 6 have angles
below 26°.

References
----------
Lawson, "Complete minimal surfaces in S³" (1970).
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 4.3.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError

from .disc import SIDES, check_orders, minimal_disc
from .plateau import Patch


def lawson_surface(m: int, k: int, n: int, pattern: str | None = None) -> tuple[Floats, Ints]:
    """Triangulate Lawson's surface ξ_{m,k} in S³ with all its symmetries.

    Parameters
    ----------
    m, k : int
        At least 1; the genus is mk.
    n : int
        Every triangle of the pattern is divided into n², n ≥ 2.
    pattern : {"diagonal_q", "diagonal_p", "corner", "cross"}, optional
        The best one for m and k if not given.

    Returns
    -------
    V : (n_vertices, 4) float
        Unit vectors (Re z, Im z, Re w, Im w): the P_i, the Q_j, the inner vertices of the sides
        P_i Q_j from P to Q (:func:`lawson_sides`), the inner vertices of the discs.
    F : (n_faces, 3) int

    Raises
    ------
    MeshError
        If m, k or n are too small, the pattern does not exist, or the minimal disc is not found.

    Examples
    --------
    >>> V, F = lawson_surface(2, 1, 5)
    >>> len(V)
    298
    """
    patch = minimal_disc(m, k, n, pattern)
    return glued(m, k, [patch] * (2 * (k + 1) * (m + 1)))


def glued(m: int, k: int, patches: Sequence[Patch]) -> tuple[Floats, Ints]:
    """Glue discs to the closed surface.

    Parameters
    ----------
    patches : sequence of Patch
        One for each disc of :func:`discs`, all in the place of the first one, P_0 Q_0 P_1 Q_1, and
        with the same number of vertices on each side.  Vertices on a side are taken from the first
        disc there.
    """
    places = discs(m, k)
    per_side = patches[0].angles.shape[1]
    n_corners = 2 * (k + 1) + 2 * (m + 1)
    n_boundary = n_corners + 4 * (k + 1) * (m + 1) * per_side
    inner = [len(patch.x) - patch.n_boundary for patch in patches]
    first = n_boundary + np.concatenate([[0], np.cumsum(inner)])
    V = np.full((first[-1], 4), np.nan)
    F = []
    for patch, (i, j), start in zip(patches, places, first[:-1], strict=True):
        number = np.concatenate(
            [
                boundary_numbers(m, k, i, j, per_side),
                start + np.arange(len(patch.x) - patch.n_boundary),
            ]
        )
        new = np.isnan(V[number, 0])
        V[number[new]] = patch.x[new] @ isometry(m, k, i, j).T
        # A half-turn about a line in the surface exchanges its two sides in S³.
        faces = patch.faces if i % 2 == 0 else patch.faces[:, ::-1]
        F.append(number[faces])
    return V, np.concatenate(F)


def discs(m: int, k: int) -> list[tuple[int, int]]:
    """The pairs (i, j), i + j even, of the quadrilaterals P_i Q_j P_{i+1} Q_{j+1}."""
    return [(i, j) for i in range(2 * (k + 1)) for j in range(i % 2, 2 * (m + 1), 2)]


def isometry(m: int, k: int, i: int, j: int) -> Floats:
    """The orthogonal map of R⁴ that takes the disc (0, 0) to the disc (i, j); shape (4, 4)."""
    result = np.zeros((4, 4))
    for block, position, order in ((slice(0, 2), i, k + 1), (slice(2, 4), j, m + 1)):
        if i % 2 == 0:
            result[block, block] = _rotation(np.pi * position / order)
        else:
            result[block, block] = _rotation(np.pi * (position + 1) / order) @ np.diag([1, -1])
    return result


def boundary_numbers(m: int, k: int, i: int, j: int, per_side: int) -> Ints:
    """Global numbers of the corners and side vertices of the disc (i, j), in the patch's order."""
    P = [(i + a if i % 2 == 0 else i + 1 - a) % (2 * (k + 1)) for a in (0, 1)]
    Q = [(j + b if i % 2 == 0 else j + 1 - b) % (2 * (m + 1)) for b in (0, 1)]
    sides = np.concatenate([lawson_sides(m, k, per_side + 1)[P[a], Q[b], 1:-1] for a, b in SIDES])
    corners = np.array([P[0], P[1], 2 * (k + 1) + Q[0], 2 * (k + 1) + Q[1]])
    return np.concatenate([corners, sides])


def lawson_sides(m: int, k: int, segments: int) -> Ints:
    """Vertices along the sides P_i Q_j of a mesh; shape (2(k+1), 2(m+1), segments + 1).

    ``segments`` is the number of edges of a side: n for :func:`lawson_surface`, 2n with the
    pattern ``"corner"``.
    """
    n_p, n_q = 2 * (k + 1), 2 * (m + 1)
    walks = np.empty((n_p, n_q, segments + 1), dtype=np.int64)
    walks[:, :, 0] = np.arange(n_p)[:, None]
    walks[:, :, -1] = n_p + np.arange(n_q)
    inner = np.arange(n_p * n_q * (segments - 1)).reshape(n_p, n_q, segments - 1)
    walks[:, :, 1:-1] = n_p + n_q + inner
    return walks


def stereographic(V: NDArray[np.float64], m: int, k: int) -> Floats:
    """Project a mesh of ξ_{m,k} from S³ to R³, conformally, faces outward.

    The pole is (cos t, sin t, 0, 0), t = π/(2(k+1)), half-way between P_0 and P_1; for ξ_{2,1} it
    is the point of S³ farthest from the surface.

    Parameters
    ----------
    V : (n, 4) float
        Unit vectors.

    Returns
    -------
    (n, 3) float

    Raises
    ------
    MeshError
        If ``V`` has another shape or m, k < 1.
    """
    check_orders(m, k)
    x = np.asarray(V, dtype=np.float64)
    if x.ndim != 2 or x.shape[1] != 4:
        raise MeshError(f"V must hold points of the 3-sphere, shape (n, 4), not {x.shape}.")
    t = np.pi / (2 * (k + 1))
    height = x[:, 0] * np.cos(t) + x[:, 1] * np.sin(t)
    # The rows of B complete the pole N to a basis with det [B; N] > 0.
    B = np.array([[np.sin(t), -np.cos(t), 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    return np.asarray(x @ B.T / (1 - height)[:, None])


def _rotation(angle: float) -> Floats:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])
