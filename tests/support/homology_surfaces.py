"""Closed surfaces of many genera, some with one vertex, for exact topology."""

import numpy as np
from support.random_surfaces import (
    BOLZA,
    HEXAGON,
    L_SHAPE,
    noisy_torus,
    random_gluing,
    random_lengths,
)

import igl_periods as ip


def _surfaces():
    for gluing in (L_SHAPE, BOLZA, HEXAGON):
        for n in (1, 2, 3):
            yield ip.DeltaComplex.from_squares(gluing, n)
    yield ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 0))
    rng = np.random.default_rng(1)
    for n_faces in (2, 4, 6, 8, 10, 20, 60, 200):
        twin = random_gluing(n_faces, rng)
        yield from ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()


SURFACES = list(_surfaces())
