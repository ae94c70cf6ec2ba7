"""The surfaces of the benchmarks, of any size."""

import itertools

import igl
import numpy as np

from igl_periods.surfaces import lawson_surface


def delaunay_surface(n_vertices):
    """Lawson's surface, cut into four until it has about ``n_vertices`` vertices."""
    n_splits = max(round(np.log(n_vertices / 2_000) / np.log(4)), 1)
    coarse = next(
        mesh
        for n in itertools.count(4, 2)
        if 4**n_splits * len((mesh := lawson_surface(2, 1, n))[0]) > 0.95 * n_vertices
    )
    V, F = (np.ascontiguousarray(array) for array in coarse)
    for _ in range(n_splits):
        V, F = split(V, F)
    return V, F


def split(V, F):
    """Every triangle into four; the surface stays the same."""
    sides = np.sort(np.stack([np.roll(F, -1, 1), np.roll(F, 1, 1)], -1).reshape(-1, 2), axis=1)
    key = sides[:, 0] * len(V) + sides[:, 1]
    _, first, index = np.unique(key, return_index=True, return_inverse=True)
    mid = len(V) + index.reshape(-1, 3)
    faces = [np.stack([F[:, s], mid[:, s - 1], mid[:, s - 2]], axis=1) for s in range(3)]
    return np.concatenate([V, V[sides[first]].mean(axis=1)]), np.concatenate([*faces, mid])


def marching_cubes_surface(n_vertices):
    """A smooth surface of genus 2 by marching cubes: about ``n_vertices`` vertices."""
    n = int(np.sqrt(n_vertices / 2.6))
    x, y, z = (np.linspace(-a, a, int(a * n)) for a in (1.6, 1.1, 0.45))
    grid = np.stack(np.meshgrid(x, y, z, indexing="ij"), axis=-1).reshape(-1, 3, order="F")
    X, Y, Z = grid.T
    lemniscate = (X**2 + Y**2) ** 2 - 2.0 * (X**2 - 0.75 * Y**2)
    field = lemniscate**2 + 1.6 * Z**2 - 0.045 * (1.0 + X**2 + Y**2)
    V, F, _ = igl.marching_cubes(
        np.ascontiguousarray(field), np.ascontiguousarray(grid), len(x), len(y), len(z), 0.0
    )
    return V, F
