"""Delaunay triangulations for the discrete theory: without symmetry, with loops, with squares."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from support.random_surfaces import (
    BOLZA,
    L_SHAPE,
    noisy_torus,
    random_gluing,
    random_lengths,
    torus_grid,
)

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.forms.graph import DoubleGraph, double_graph


@dataclass(frozen=True)
class Marked:
    """A double graph, a canonical basis of cohomology on it, and the period matrix in it."""

    graph: DoubleGraph
    cocycles: csr_array
    pm: ip.PeriodMatrix


def marked(K):
    pm = ip.period_matrix(K)
    flipped, cocycles = intrinsic_delaunay(K, pm.cocycles)
    return Marked(double_graph(flipped), cocycles, pm)


def distorted(gluing, n, noise, seed):
    """A square-tiled surface with all lengths changed at random: no symmetry is left."""
    K = ip.DeltaComplex.from_squares(gluing, n)
    factor = np.random.default_rng(seed).uniform(1 - noise, 1 + noise, K.n_edges)
    return ip.DeltaComplex.from_gluing(K.lengths * factor[K.edge], K.twin)


def random_surface(n_faces, seed):
    rng = np.random.default_rng(seed)
    twin = random_gluing(n_faces, rng)
    parts = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()
    return max(parts, key=lambda part: part.n_faces)


def flat_torus(n, m, noise, seed, periods=(1.0, 0.3 + 1.1j)):
    """A flat torus with n × m displaced vertices: the complex, and vertex positions in C."""
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    z = (i / n * periods[0] + j / m * periods[1]).ravel()
    rng = np.random.default_rng(seed)
    z = z + noise * (rng.normal(size=z.size) + 1j * rng.normal(size=z.size)) / max(n, m)
    F = torus_grid(n, m)
    sides = np.stack([wrapped(z[F[:, s - 1]] - z[F[:, s - 2]], periods) for s in range(3)], axis=1)
    return ip.DeltaComplex.from_lengths(np.abs(sides), F), z


def wrapped(displacement, periods):
    """The shortest displacement on the torus of the given periods, up to half a period."""
    a, b = periods
    t = (np.conj(a) * displacement).imag / (np.conj(a) * b).imag
    displacement = displacement - np.rint(t) * b
    return displacement - np.rint((displacement / a).real) * a


SURFACES = {
    "one vertex, squares": marked(ip.DeltaComplex.from_squares(L_SHAPE, 1)),
    "Bolza squares": marked(ip.DeltaComplex.from_squares(BOLZA, 3)),
    "noisy torus": marked(ip.DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.2, 4))),
    "distorted L": marked(distorted(L_SHAPE, 3, 0.15, 0)),
    "distorted Bolza": marked(distorted(BOLZA, 2, 0.15, 1)),
    "random gluing, genus 3": marked(random_surface(16, 5)),
    "random gluing, high genus": marked(random_surface(40, 2)),
}
