"""Surfaces for walks along their edges; lengths of edges; walks without returns."""

import numpy as np
from support.delaunay_surfaces import distorted, random_surface
from support.random_surfaces import BOLZA, HEXAGON, L_SHAPE, noisy_torus

import igl_periods as ip

SURFACES = {
    "one vertex": ip.DeltaComplex.from_squares(L_SHAPE, 1),
    "hexagon squares": ip.DeltaComplex.from_squares(HEXAGON, 2),
    "distorted L": distorted(L_SHAPE, 3, 0.15, 0),
    "distorted Bolza": distorted(BOLZA, 2, 0.15, 1),
    "noisy torus": ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.2, 4)),
    "sphere": ip.DeltaComplex.from_lengths(
        np.ones((4, 3)), [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    ),
    **{f"random gluing {n}": random_surface(n, n) for n in (2, 4, 8, 16, 40, 100)},
}


def free_reduction(K, walk, cyclic=True):
    """A walk without passages to and fro."""
    twin, reduced = K.twin.ravel(), []
    for half_edge in walk:
        if reduced and reduced[-1] == twin[half_edge]:
            reduced.pop()
        else:
            reduced.append(int(half_edge))
    while cyclic and len(reduced) > 1 and reduced[0] == twin[reduced[-1]]:
        reduced = reduced[1:-1]
    return reduced


def edge_lengths(K):
    lengths = np.empty(K.n_edges)
    lengths[K.edge] = K.lengths
    return lengths
