r"""The minimal disc P_0 Q_0 P_1 Q_1 of Lawson's surface ξ_{m,k}, triangulated.

Patterns for the triangulation, in which every triangle is then divided into n²:

* ``"diagonal_q"``: two triangles, along Q_0 Q_1; best for k = 1;
* ``"diagonal_p"``: two triangles, along P_0 P_1; best for m = 1;
* ``"corner"``: the midpoints of the sides and the centre, eight triangles; best otherwise;
* ``"cross"``: the centre, four triangles; angles as small as 30°.

Sides start divided into equal arcs, the inside from barycentric averages; then come the two Newton
iterations of :mod:`.plateau`.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError

from .plateau import Patch, harmonic, minimal, on_sides

# Points of a disc: its corners P0 P1 Q0 Q1, the midpoints of its sides P0Q0 P0Q1 P1Q0 P1Q1, its
# centre.  The boundary runs P0 Q0 P1 Q1.
_P0, _P1, _Q0, _Q1, _E00, _E01, _E10, _E11, _O = range(9)
_PATTERNS: dict[str, list[tuple[int, int, int]]] = {
    "diagonal_q": [(_P0, _Q0, _Q1), (_P1, _Q1, _Q0)],
    "diagonal_p": [(_Q0, _P1, _P0), (_Q1, _P0, _P1)],
    "corner": [
        (_P0, _E00, _E01), (_Q0, _E10, _E00), (_P1, _E11, _E10), (_Q1, _E01, _E11),
        (_O, _E01, _E00), (_O, _E00, _E10), (_O, _E10, _E11), (_O, _E11, _E01),
    ],
    "cross": [(_O, _P0, _Q0), (_O, _Q0, _P1), (_O, _P1, _Q1), (_O, _Q1, _P0)],
}  # fmt: skip
# Side s of the disc joins P_a and Q_b.
SIDES = ((0, 0), (0, 1), (1, 0), (1, 1))


def minimal_disc(m: int, k: int, n: int, pattern: str | None = None) -> Patch:
    """Solve for the disc P_0 Q_0 P_1 Q_1, triangulated.

    Parameters
    ----------
    m, k : int
        At least 1.
    n : int
        Every triangle of the pattern is divided into n², n ≥ 2.
    pattern : {"diagonal_q", "diagonal_p", "corner", "cross"}, optional
        The best one for m and k if not given.

    Raises
    ------
    MeshError
        If m, k or n are too small, the pattern does not exist, or the minimal disc is not found.
    """
    check_orders(m, k)
    if n < 2:
        raise MeshError(f"n = {n}: every triangle of the disc is divided into n x n, n >= 2.")
    return minimal(harmonic(_start(m, k, n, _checked_pattern(m, k, pattern))))


def check_orders(m: int, k: int) -> None:
    """Raise a MeshError unless m, k ≥ 1."""
    if m < 1 or k < 1 or m != int(m) or k != int(k):
        raise MeshError(f"Lawson's surface needs integers m, k >= 1, not m = {m}, k = {k}.")


def disc_ends(m: int, k: int) -> Floats:
    """The ends P_a, Q_b of the four sides of the first disc; (4, 2, 4)."""
    P = np.zeros((2, 4))
    Q = np.zeros((2, 4))
    for a in (0, 1):
        P[a, :2] = np.cos(np.pi * a / (k + 1)), np.sin(np.pi * a / (k + 1))
        Q[a, 2:] = np.cos(np.pi * a / (m + 1)), np.sin(np.pi * a / (m + 1))
    return np.array([(P[a], Q[b]) for a, b in SIDES])


def _start(m: int, k: int, n: int, pattern: str) -> Patch:
    """The disc before it is solved: sides in equal parts, the inside by barycentric averages."""
    weights, faces, per_side = divided(pattern, n)
    ends = disc_ends(m, k)
    angles = np.tile(np.pi / 2 * np.arange(1, per_side + 1) / (per_side + 1), (4, 1))
    corners = np.array([ends[0, 0], ends[2, 0], ends[0, 1], ends[1, 1]])
    points = np.zeros((9, 4))
    points[:4] = corners
    points[_E00:_O] = on_sides(ends, np.full((4, 1), np.pi / 4))
    points[_O] = corners.sum(axis=0)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    x = weights @ points
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    x[4 : 4 + angles.size] = on_sides(ends, angles)
    x[:4] = corners
    return Patch(x, faces, ends, angles, n_corners=4)


def divided(pattern: str, n: int) -> tuple[Ints, Ints, int]:
    """Divide every triangle of a pattern into n².

    Returns
    -------
    weights : (n_vertices, 9) int
        Barycentric coordinates, times n, of each vertex over the points of the pattern; vertices
        in the order of :class:`Patch`.
    faces : (m, 3) int
    per_side : int
        Number of vertices inside each side.
    """
    coarse = np.array(_PATTERNS[pattern])
    i, j = np.divmod(np.arange((n + 1) ** 2), n + 1)
    i, j = i[i + j <= n], j[i + j <= n]
    local = np.full((n + 1, n + 1), -1)
    local[i, j] = np.arange(i.size)
    weights = np.zeros((len(coarse), i.size, 9), dtype=np.int64)
    for c, w in enumerate((n - i - j, i, j)):
        weights[np.arange(len(coarse))[:, None], np.arange(i.size), coarse[:, c, None]] = w
    distinct, inverse = np.unique(weights.reshape(-1, 9), axis=0, return_inverse=True)
    up = i + j < n
    down = i + j < n - 1
    iu, ju, iv, jv = i[up], j[up], i[down], j[down]
    small = np.concatenate([
        np.stack([local[iu, ju], local[iu + 1, ju], local[iu, ju + 1]], axis=1),
        np.stack([local[iv + 1, jv + 1], local[iv, jv + 1], local[iv + 1, jv]], axis=1),
    ])  # fmt: skip
    numbered = inverse.reshape(len(coarse), -1)[:, small].reshape(-1, 3)
    order, per_side = _patch_order(distinct, n)
    rank = np.empty_like(order)
    rank[order] = np.arange(order.size)
    return distinct[order], rank[numbered], per_side


def _patch_order(weights: Ints, n: int) -> tuple[Ints, int]:
    """Corners, then the vertices of the sides from P to Q, then the others."""
    order = [int(np.flatnonzero(weights[:, c] == n)[0]) for c in range(4)]
    per_side = 0
    for s, (a, b) in enumerate(SIDES):
        on_side = weights[:, [a, 2 + b, _E00 + s]].sum(axis=1) == n
        on_side[order[:4]] = False
        members = np.flatnonzero(on_side)
        towards_q = 2 * weights[members, 2 + b] + weights[members, _E00 + s]
        order += members[np.argsort(towards_q)].tolist()
        per_side = members.size
    inner = np.setdiff1d(np.arange(len(weights)), order)
    return np.concatenate([np.array(order), inner]), per_side


def _checked_pattern(m: int, k: int, pattern: str | None) -> str:
    if pattern is None:
        return "corner" if min(m, k) > 1 else "diagonal_q" if k == 1 else "diagonal_p"
    if pattern not in _PATTERNS:
        raise MeshError(
            f"there is no pattern {pattern!r}; the patterns are {', '.join(_PATTERNS)}."
        )
    return pattern
