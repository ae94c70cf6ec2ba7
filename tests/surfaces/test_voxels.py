"""Voxels bound a surface or are refused."""

import itertools

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.surfaces import voxel_surface


def volume(V, F):
    a, b, c = V[F].transpose(1, 0, 2)
    return np.einsum("fd,fd->", a, np.cross(b, c)) / 6


def squares_of(cells):
    """Faces of the boundary, square by square; V holds all corners of the grid."""
    V = np.array(list(itertools.product(*(range(n + 1) for n in cells.shape))), dtype=float)
    row = {tuple(corner): i for i, corner in enumerate(V.astype(int).tolist())}
    F = []
    for cell, axis, side in itertools.product(np.argwhere(cells), range(3), (0, 1)):
        neighbour = cell + (2 * side - 1) * np.eye(3, dtype=int)[axis]
        if (neighbour >= 0).all() and (neighbour < cells.shape).all() and cells[tuple(neighbour)]:
            continue
        e, f = np.eye(3, dtype=int)[[axis - 2, axis - 1]]
        low = cell + side * np.eye(3, dtype=int)[axis]
        loop = [row[tuple(low + d)] for d in (0 * e, e, e + f, f)][:: 2 * side - 1]
        F += [[loop[0], loop[1], loop[2]], [loop[0], loop[2], loop[3]]]
    return V, np.array(F)


def test_voxels_bound_a_surface_or_are_refused():
    # All ways to fill the eight cells at a corner.
    refused = 0
    for way in itertools.islice(itertools.product((False, True), repeat=8), 1, None):
        cells = np.reshape(way, (2, 2, 2))
        try:
            expected = ip.DeltaComplex.from_mesh(*squares_of(cells))
        except ip.MeshError:
            refused += 1
            with pytest.raises(ip.MeshError, match="pinched"):
                voxel_surface(cells)
            continue
        V, F = voxel_surface(cells)
        K = ip.DeltaComplex.from_mesh(V, F)
        assert K.n_boundary_edges == K.n_reversing_edges == 0
        assert (K.n_vertices, K.n_faces) == (expected.n_vertices, expected.n_faces)
        assert volume(V, F) == cells.sum()
    assert 0 < refused < 255


def test_voxels_may_bound_several_components():
    cells = np.ones((3, 3, 7), dtype=bool)
    cells[1, 1, 1] = False
    cells[:, :, 4] = False
    V, F = voxel_surface(cells)
    assert len(ip.DeltaComplex.from_mesh(V, F).components()) == 3
    assert volume(V, F) == cells.sum()
