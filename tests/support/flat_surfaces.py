"""Flat strips, tori, Möbius bands and Klein bottles with irregular triangles."""

import numpy as np

import igl_periods as ip


def grid(n, m):
    """Faces of an n × m grid of vertices i (m + 1) + j, 0 ≤ i ≤ n, 0 ≤ j ≤ m."""
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    a, b, c, d = ((i + di) * (m + 1) + j + dj for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1)))
    return np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)


def flat_strip(width, height, n, m, glue_x="", glue_y="", seed=0):
    """A triangulated rectangle, its interior vertices displaced, with glued sides.

    ``glue_x``: the sides x = 0 and x = width are glued "straight" or "turned"; ``glue_y``: the
    sides y = 0 and y = height are glued "straight".
    """
    rng = np.random.default_rng(seed)
    i, j = np.meshgrid(np.arange(n + 1), np.arange(m + 1), indexing="ij")
    x, y = i * width / n, j * height / m
    inner = (i > 0) & (i < n) & (j > 0) & (j < m)
    x = x + inner * rng.uniform(-0.3, 0.3, x.shape) * width / n
    y = y + inner * rng.uniform(-0.3, 0.3, y.shape) * height / m
    F = grid(n, m)
    V = np.stack([x, y], axis=-1).reshape(-1, 2)
    sides = [np.linalg.norm(V[F[:, s - 1]] - V[F[:, s - 2]], axis=1) for s in range(3)]
    turned = glue_x == "turned"
    if glue_x:
        j = np.where(turned & (i == n), m - j, j)
        i = i % n
    if glue_y:
        j = j % m
    name = (i * (m + 1) + j).ravel()
    return ip.DeltaComplex.from_lengths(np.stack(sides, axis=1), name[F])
