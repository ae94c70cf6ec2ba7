"""Closed surfaces small enough for dense linear algebra."""

import numpy as np
from support.random_surfaces import BOLZA, L_SHAPE, noisy_torus, random_gluing, random_lengths

import igl_periods as ip


def random_surface(seed):
    rng = np.random.default_rng(seed)
    twin = random_gluing(int(2 * rng.integers(2, 20)), rng)
    parts = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()
    return max(parts, key=lambda part: part.n_faces)


SURFACES = [
    ip.DeltaComplex.from_squares(L_SHAPE, 1),
    ip.DeltaComplex.from_squares(BOLZA, 3),
    ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.2, 4)),
    *(random_surface(seed) for seed in range(8)),
]
