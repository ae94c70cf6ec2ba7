"""An irregular surface of high genus."""

import numpy as np

import igl_periods as ip
from igl_periods.surfaces import thickened_lattice


def lattice(shape):
    """An irregular surface of high genus, with thin triangles: one vertex in six is moved far."""
    V, F = thickened_lattice(shape, 1, aspect=2, jitter=0.15)
    moved = np.random.default_rng(1).uniform(size=len(V)) < 1 / 6
    V[moved] *= 1 + 1e-3
    return ip.DeltaComplex.from_mesh(V, F)
