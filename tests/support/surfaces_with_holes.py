"""Squares with holes, and whether a modulus is within a certificate."""

import numpy as np
from support.flat_surfaces import grid

import igl_periods as ip
from igl_periods.moduli.equivalence import symplectic_isomorphisms


def tau_inside_certificate(pm, tau):
    """Whether (τ), in some marking, is within the certificate of pm."""
    return bool(symplectic_isomorphisms([[tau]], pm, tolerance=2 * pm.bound + 1e-12))


def square_with_holes(n, holes):
    """[0, 7]² divided into 7n × 7n squares, without the unit squares at the given corners."""
    size = 7 * n
    F = grid(size, size).reshape(size, size, 2, 3)
    keep = np.ones((size, size), dtype=bool)
    for x, y in holes:
        keep[x * n : (x + 1) * n, y * n : (y + 1) * n] = False
    x, y = np.meshgrid(np.arange(size + 1), np.arange(size + 1), indexing="ij")
    V = np.stack([x, y], axis=-1).reshape(-1, 2) / n
    return ip.DeltaComplex.from_mesh(V, F[keep].reshape(-1, 3))


def annulus_pair():
    """A square with two holes whose corner is displaced: nothing is symmetric."""
    K = square_with_holes(1, ((1, 2), (4, 3)))
    V, F = K.positions.copy(), K.corner_vertex
    V += 0.2 * np.random.default_rng(3).uniform(-1, 1, V.shape)
    return ip.DeltaComplex.from_mesh(V, F)
