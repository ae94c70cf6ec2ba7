"""Flips in parts and along their seams: the triangulation that one machine finds."""

import numpy as np
import pytest
from support.distributed_runs import SURFACES
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import cotan_weights, edge_ends, intrinsic_delaunay
from igl_periods.distributed.flips import flipped_along_seams, flipped_inside
from igl_periods.distributed.partition import Part, Partition
from igl_periods.distributed.pieces import Piece
from igl_periods.harmonic import dirichlet_matrix, laplacian, linear_energies
from igl_periods.topology.cohomology import cochains_and_basis

BAD_TORUS = ip.DeltaComplex.from_mesh(*noisy_torus(24, 18, 0.45, 3))
FLIPPED = {**SURFACES, "bad torus": BAD_TORUS}


def divided(K, n_ranks, rings=2):
    """What the ranks do, one after the other; also the number of rounds along the seams."""
    cochains, _ = cochains_and_basis(K)
    partition = Partition.of(K, cochains, n_ranks)
    pieces = [partition.piece(rank) for rank in range(n_ranks)]
    for rounds in range(100):
        pieces = [flipped_inside(piece)[0] for piece in pieces]
        seams = [piece.along_the_seams(rings) for piece in pieces]
        after = flipped_along_seams([p.some(faces) for p, faces in zip(pieces, seams)])
        if after is None:
            return cochains, partition, pieces, rounds
        pieces = [p.replaced(*change) for p, *change in zip(pieces, seams, after)]
    raise AssertionError("the flips do not end")


@pytest.mark.parametrize("n_ranks", [1, 2, 5, 40])
@pytest.mark.parametrize("name", FLIPPED)
def test_the_triangulation_of_one_machine(name, n_ranks):
    K = FLIPPED[name]
    cochains, partition, pieces, _ = divided(K, n_ranks)
    flipped, moved = intrinsic_delaunay(K, cochains)
    whole, joint, _ = Piece.union(pieces).opened()
    assert (whole.twin >= 0).all()
    assert np.array_equal(whole.edge.ravel()[whole.twin.ravel()], whole.edge.ravel())
    assert cotan_weights(whole).min() > -1e-9 * np.abs(cotan_weights(whole)).max()
    expected = laplacian(flipped, cotan_weights(flipped)).toarray()
    found = laplacian(whole, cotan_weights(whole)).toarray()
    place = partition.place
    scale = np.sqrt(np.maximum(np.diag(expected), 1e-3))
    error = (found[np.ix_(place, place)] - expected) / np.outer(scale, scale)
    assert np.abs(error).max() < 1e-9
    D, _ = linear_energies(flipped, moved)
    D_parts, _ = linear_energies(whole, joint)
    np.testing.assert_allclose(D_parts, D, rtol=1e-10, atol=1e-10)


@pytest.mark.parametrize("n_ranks", [2, 5])
@pytest.mark.parametrize("name", FLIPPED)
def test_pieces_stay_closed_and_keep_their_size(name, n_ranks):
    cochains, partition, pieces, _ = divided(FLIPPED[name], n_ranks)
    for rank, piece in enumerate(pieces):
        assert piece.n_faces == partition.piece(rank).n_faces
        part = Part.of(piece, *partition.owned(rank))
        K = part.complex
        assert not (K.sign * part.cochains.toarray()[:, K.edge]).sum(axis=-1).any()
        assert np.count_nonzero(K.sign > 0) == K.n_edges
    k = cochains.shape[0]
    # Energies of the same functions, part by part and as a whole.
    f = np.random.default_rng(1).normal(size=(FLIPPED[name].n_vertices, k))
    whole, joint, _ = Piece.union(pieces).opened()
    parts = [Part.of(piece, *partition.owned(rank)) for rank, piece in enumerate(pieces)]
    summed = sum(dirichlet_matrix(p.complex, p.cochains, f[p.complex.labels]) for p in parts)
    np.testing.assert_allclose(summed, dirichlet_matrix(whole, joint, f), rtol=1e-11, atol=1e-9)


def test_seams_move_and_rings_save_rounds():
    _, partition, pieces, rounds = divided(BAD_TORUS, 5)
    assert 1 <= rounds <= 5
    assert rounds <= divided(BAD_TORUS, 5, rings=0)[3]
    moved = [
        np.setdiff1d(piece.vertex, partition.piece(rank).vertex).size
        for rank, piece in enumerate(pieces)
    ]
    assert any(moved), "a flip across a seam hands a vertex to the other side"


def test_free_sides_stay_where_they_are():
    """A thin kite: its long diagonal is flipped, and no side of its rim, however obtuse."""
    V = np.array([[0, 0, 0], [1, 0, 0], [0.5, 1e-3, 0], [0.5, -1e-3, 0.0]])
    K = ip.DeltaComplex.from_mesh(V, [[0, 1, 2], [1, 0, 3]])
    piece = Piece(
        lengths=K.lengths,
        edge=K.edge,
        sign=K.sign,
        vertex=K.corner_vertex,
        distortion=np.zeros(2),
        edges=np.arange(K.n_edges),
        by_edge=cochain_of(K),
    )
    flipped, n_flips = flipped_inside(piece)
    assert n_flips == 1
    assert sorted(map(sorted, flipped.vertex.tolist())) == [[0, 2, 3], [1, 2, 3]]
    rim = sorted(K.edge.ravel()[K.twin.ravel() < 0])
    after = flipped.opened()[0]
    assert sorted(flipped.edges[after.edge.ravel()[after.twin.ravel() < 0]]) == rim
    assert flipped_inside(flipped) == (flipped, 0)


def cochain_of(K):
    """The differential of a function, as (n_edges, 1)."""
    from scipy.sparse import csr_array

    tail, head = edge_ends(K)
    values = np.array([3, -1, 4, 1])
    return csr_array((values[head] - values[tail])[:, None])
