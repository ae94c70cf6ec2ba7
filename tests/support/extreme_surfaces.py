"""Surfaces with needles and caps, for which floating point barely suffices."""

import numpy as np
from support.random_surfaces import noisy_torus

import igl_periods as ip


def spiked_torus(height, seed):
    """One vertex far outside: its triangles are needles."""
    V, F = noisy_torus(6, 5, 0.2, seed)
    V[7] *= height / np.linalg.norm(V[7])
    return ip.DeltaComplex.from_mesh(V, F)


def capped_torus(height, seed):
    """Vertices nearly on the edges opposite to them."""
    rng = np.random.default_rng(seed)
    V, F = noisy_torus(6, 5, 0.1, seed)
    for f in rng.choice(len(F), 5, replace=False):
        a, b, c = F[f]
        V[a] = 0.5 * (V[b] + V[c]) + height * rng.normal(size=3)
    return ip.DeltaComplex.from_mesh(V, F)


def sheared_strips(n, m, k, h):
    """A flat torus of congruent triangles (1, b, c) in strips that are sheared to and fro."""
    b, c = float(np.hypot(k, h)), float(np.hypot(k - 1, h))

    def vertex(i, j):
        return i % n * m + j % m

    F, lengths = [], []
    for j in range(m):
        s, t = (k, k - 1) if j % 2 == 0 else (1 - k, -k)
        for i in range(n):
            a = vertex(i + s, j + 1)
            F += [(vertex(i, j), vertex(i + 1, j), a), (vertex(i, j), a, vertex(i + t, j + 1))]
            lengths += [(c, b, 1), (1, c, b)] if j % 2 == 0 else [(b, c, 1), (1, b, c)]
    return ip.DeltaComplex.from_lengths(lengths, F), b, c
