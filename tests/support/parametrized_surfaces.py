"""Surfaces without symmetry that are parametrized, and what is measured of that."""

import numpy as np
from support.random_surfaces import BOLZA, noisy_torus

import igl_periods as ip
from igl_periods.complexes.doubling import double


def genus_three():
    """A square with two holes has a double of genus 2; with three holes, of genus 3: bent."""
    n = 9
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a = i * (n + 1) + j
    F = np.stack([a, a + n + 1, a + n + 2, a, a + n + 2, a + 1], axis=-1).reshape(n, n, 2, 3)
    keep = np.ones((n, n), dtype=bool)
    for x, y in ((1, 2), (4, 6), (7, 1)):
        keep[x, y] = False
    x, y = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    V = np.stack([x, y, 0.3 * np.sin(x + 0.5 * y)], axis=-1).reshape(-1, 3)
    V = V + 0.2 * np.random.default_rng(5).uniform(-1, 1, V.shape)
    return double(ip.DeltaComplex.from_mesh(V, F[keep].reshape(-1, 3)))


def genus_two():
    """Two tori of different shapes, a triangle of each cut out and joined by a tube."""
    (V, F), (W, G) = noisy_torus(9, 7, 0.15, 3), noisy_torus(7, 8, 0.2, 4)
    W = W * [0.7, -0.8, 0.9] + [4.5, 0.3, 0.2]
    face = int(np.argmax(V[F].mean(axis=1)[:, 0]))
    other = int(np.argmin(W[G].mean(axis=1)[:, 0]))
    a, b, c = F[face]
    # Mirrored, the second torus is turned inside out: its faces are read backwards.
    G = G[:, ::-1] + len(V)
    p, r, q = G[other]
    tube = [[a, b, p], [b, q, p], [b, c, q], [c, r, q], [c, a, r], [a, p, r]]
    F = np.concatenate([np.delete(F, face, 0), np.delete(G, other, 0), tube])
    return ip.DeltaComplex.from_mesh(np.concatenate([V, W]), F)


EMPTY = ip.cohomology_basis(ip.DeltaComplex.from_squares(BOLZA, 1))[:0]


NAMES = ["noisy torus", "torus of revolution", "genus 2", "genus 3", "squares"]


def random_coefficients(g, seed):
    rng = np.random.default_rng(seed)
    return rng.normal(size=g) + 1j * rng.normal(size=g)


def check_seams(P):
    here, there = P.seams, P.complex.twin.ravel()[P.seams]
    tail, head = (np.roll(P.corner_uv, shift, axis=1).ravel() for shift in (-1, 1))
    np.testing.assert_allclose(tail[here] - head[there], P.seam_jumps, rtol=0, atol=1e-9)
    np.testing.assert_allclose(head[here] - tail[there], P.seam_jumps, rtol=0, atol=1e-9)


def distortion(P):
    """Median and 99th percentile of the dilatation, and the part of vertices of negative index."""
    return [*(np.percentile(P.dilatation, [50, 99]) - 1), np.mean(P.index < 0)]
