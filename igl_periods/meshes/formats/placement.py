"""Parts of a scene, moved to their places by affine maps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Floats, Ints


@dataclass(frozen=True, eq=False)
class Part:
    """Positions (n, 3) and triangles (m, 3) of one mesh."""

    V: Floats
    F: Ints


def placed(part: Part, matrix: Floats) -> Part:
    """The part moved by x ↦ A x + t, (A, t) the rows of ``matrix``; turned if det A < 0.

    A reflection shows the inside of an oriented surface outside; turning the faces undoes that.
    """
    A, t = matrix[:3, :3], matrix[:3, 3]
    with np.errstate(invalid="ignore", over="ignore"):
        V = part.V if (matrix == np.eye(4)).all() else part.V @ A.T + t
    return Part(V, part.F[:, ::-1] if np.linalg.det(A) < 0.0 else part.F)


def assembled(parts: list[Part]) -> tuple[Floats, Ints]:
    """Positions and triangles of all parts, each with its own vertices."""
    first = np.cumsum([0, *(len(part.V) for part in parts)])
    F = [part.F + n for part, n in zip(parts, first)]
    return np.concatenate([part.V for part in parts]), np.concatenate(F)
