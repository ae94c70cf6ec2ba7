"""Parts: every cell has one owner, and sums over parts are those of the whole."""

import numpy as np
import pytest
from support.distributed_runs import SURFACES
from support.random_surfaces import torus_grid, torus_of_revolution

import igl_periods as ip
from igl_periods.complexes.weights import cotan_weights
from igl_periods.distributed.partition import Part, Partition
from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.laplace_matrix import laplacian
from igl_periods.topology.cohomology import cochains_and_basis


def divided(K, n_ranks):
    cochains, _ = cochains_and_basis(K)
    partition = Partition.of(K, cochains, n_ranks)
    return (
        cochains,
        partition,
        [Part.of(partition.piece(rank), *partition.owned(rank)) for rank in range(n_ranks)],
    )


@pytest.mark.parametrize("n_ranks", [1, 2, 5, 40])
@pytest.mark.parametrize("name", SURFACES)
def test_every_vertex_and_every_face_has_one_owner(name, n_ranks):
    K = SURFACES[name]
    _, partition, parts = divided(K, n_ranks)
    assert np.array_equal(np.sort(partition.place), np.arange(K.n_vertices))
    assert np.array_equal(np.sort(partition.faces), np.arange(K.n_faces))
    owned = np.concatenate([part.complex.labels[: part.n_owned] for part in parts])
    assert np.array_equal(owned, np.arange(K.n_vertices))
    assert sum(part.complex.n_faces for part in parts) == K.n_faces
    for part in parts:
        ghosts = np.arange(part.n_owned, part.complex.n_vertices)
        assert np.isin(ghosts, part.complex.corner_vertex).all()
        assert not np.isin(part.complex.labels[ghosts], part.complex.labels[: part.n_owned]).any()


@pytest.mark.parametrize("n_ranks", [1, 2, 5, 40])
@pytest.mark.parametrize("name", SURFACES)
def test_parts_are_complexes_with_closed_cochains(name, n_ranks):
    for part in divided(SURFACES[name], n_ranks)[2]:
        K = part.complex
        along = K.sign * part.cochains.toarray()[:, K.edge]
        assert not along.sum(axis=-1).any()
        inside = np.flatnonzero(K.twin.ravel() >= 0)
        other = K.twin.ravel()[inside]
        assert np.array_equal(K.twin.ravel()[other], inside)
        assert np.array_equal(K.edge.ravel()[other], K.edge.ravel()[inside])
        assert np.array_equal(K.lengths.ravel()[other], K.lengths.ravel()[inside])
        assert np.array_equal(K.sign.ravel()[other], -K.sign.ravel()[inside])
        assert np.count_nonzero(K.sign > 0) == K.n_edges


@pytest.mark.parametrize("n_ranks", [1, 2, 5, 40])
@pytest.mark.parametrize("name", SURFACES)
def test_laplacians_and_energies_of_the_parts_add_up(name, n_ranks):
    K = SURFACES[name]
    cochains, partition, parts = divided(K, n_ranks)
    place = partition.place
    whole = laplacian(K, cotan_weights(K)).toarray()
    summed = np.zeros_like(whole)
    f = np.random.default_rng(0).normal(size=(K.n_vertices, cochains.shape[0]))
    by_place = np.empty_like(f)
    by_place[place] = f
    D = np.zeros((cochains.shape[0],) * 2)
    for part in parts:
        labels = part.complex.labels
        local = laplacian(part.complex, cotan_weights(part.complex)).toarray()
        summed[np.ix_(labels, labels)] += local
        D += dirichlet_matrix(part.complex, part.cochains, by_place[labels])
    np.testing.assert_allclose(summed[np.ix_(place, place)], whole, atol=1e-12 * whole.max())
    np.testing.assert_allclose(D, dirichlet_matrix(K, cochains, f), rtol=1e-12, atol=1e-10)


def test_parts_have_short_boundaries():
    # 64 parts of 10,000 vertices: strips across the torus would have 200 ghosts, squares 25.
    V, _ = torus_of_revolution(2.0, 0.8, 100, 100)
    K = ip.DeltaComplex.from_mesh(V, torus_grid(100, 100))
    _, _, parts = divided(K, 64)
    ghosts = [part.complex.n_vertices - part.n_owned for part in parts]
    assert np.mean(ghosts) < 50
    assert max(part.n_owned for part in parts) - min(part.n_owned for part in parts) <= 1
    assert max(part.complex.n_faces for part in parts) < 1.5 * K.n_faces / 64
