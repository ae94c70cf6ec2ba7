"""Pieces: what was cut goes together again."""

import numpy as np
import pytest
from support.distributed_runs import SURFACES

from igl_periods.distributed.partition import Partition
from igl_periods.distributed.pieces import Piece
from igl_periods.topology.cohomology import cochains_and_basis


def whole_piece(K):
    cochains, _ = cochains_and_basis(K)
    return Partition.of(K, cochains, 1).piece(0), cochains


@pytest.mark.parametrize("name", SURFACES)
def test_the_gluing_is_in_the_edges(name):
    K = SURFACES[name]
    piece, cochains = whole_piece(K)
    opened, along, turned = piece.opened()
    assert np.array_equal(opened.twin, K.twin)
    assert np.array_equal(opened.edge, K.edge)
    assert np.array_equal(opened.sign * turned[opened.edge], K.sign)
    assert (along != cochains.multiply(turned)).nnz == 0


@pytest.mark.parametrize("name", SURFACES)
def test_some_and_the_others_make_the_whole(name):
    K = SURFACES[name]
    piece, _ = whole_piece(K)
    chosen = np.random.default_rng(0).permutation(K.n_faces)
    pieces = [piece.some(chosen[: K.n_faces // 2]), piece.some(chosen[K.n_faces // 2 :])]
    joint = Piece.union(pieces)
    assert np.array_equal(joint.edge, K.edge[chosen])
    assert np.array_equal(joint.edges, piece.edges)
    assert (joint.by_edge != piece.by_edge).nnz == 0


def test_replaced_faces_bring_their_values():
    piece, _ = whole_piece(SURFACES["torus"])
    faces = np.array([4, 7])
    other = piece.some(faces)
    doubled = Piece(**{**vars(other), "by_edge": 2 * other.by_edge})
    after = piece.replaced(faces, doubled)
    near = np.isin(piece.edges, other.edges)
    assert (after.by_edge[near] != 2 * piece.by_edge[near]).nnz == 0
    assert (after.by_edge[~near] != piece.by_edge[~near]).nnz == 0


def test_seams_and_their_rings():
    K = SURFACES["torus"]
    cochains, _ = cochains_and_basis(K)
    piece = Partition.of(K, cochains, 2).piece(0)
    assert whole_piece(K)[0].along_the_seams(3).size == 0
    opened, _, _ = piece.opened()
    assert np.array_equal(piece.along_the_seams(0), np.flatnonzero((opened.twin < 0).any(axis=1)))
    sizes = [piece.along_the_seams(width).size for width in range(30)]
    assert sizes == sorted(sizes) and sizes[-1] == piece.n_faces
