"""The fundamental polygon and the shortest loops: combinatorics, and brute force."""

import heapq
from dataclasses import replace

import numpy as np
import pytest
from support.delaunay_surfaces import flat_torus
from support.random_surfaces import L_SHAPE
from support.walked_surfaces import SURFACES, edge_lengths, free_reduction
from support.words_of_polygons import word_pairing

import igl_periods as ip
from igl_periods.complexes.cochains import walk_cochain
from igl_periods.complexes.half_edges import half_edge_ends, walk_vertices
from igl_periods.topology.cohomology import cotree_cochains, pairing
from igl_periods.topology.cycles import rooted_loops
from igl_periods.topology.dual_cycles import dual_homology_basis
from igl_periods.topology.fundamental_group import fundamental_polygon, shortest_loops
from igl_periods.topology.spanning_trees import tree_cotree


def canonical_rotation(cycle):
    """A cyclic sequence from its least element on, the first of them that gives the least."""
    return min((cycle[k:] + cycle[:k] for k in range(len(cycle))), default=[])


# The fundamental polygon.
def test_boundary_of_the_polygon(K, trees):
    polygon = fundamental_polygon(K, trees)
    tail, head = half_edge_ends(K)
    assert polygon.boundary.size == 2 * (K.n_vertices - 1) + 4 * K.genus
    assert np.array_equal(head[polygon.boundary], tail[np.roll(polygon.boundary, -1)])
    crossed = trees.face_parent[trees.face_parent >= 0]
    glued = np.concatenate([crossed, K.twin.ravel()[crossed]])
    both = np.sort(np.concatenate([polygon.boundary, glued]))
    assert np.array_equal(both, np.arange(3 * K.n_faces))


def test_every_letter_occurs_once_in_either_direction(K, trees):
    word = fundamental_polygon(K, trees).word
    letters = np.arange(1, 2 * K.genus + 1)
    assert np.array_equal(np.sort(word), np.concatenate([-letters[::-1], letters]))


def test_the_glued_polygon_has_one_vertex(K, trees):
    # χ = 1 − 2g + 1.  The corner before a letter is glued to the corner after its inverse.
    word = fundamental_polygon(K, trees).word
    place = {int(letter): k for k, letter in enumerate(word)}
    seen, corner = 0, 0
    while word.size:
        corner = (place[-int(word[corner])] + 1) % word.size
        seen += 1
        if corner == 0:
            break
    assert seen == 4 * K.genus


def test_the_word_is_a_product_of_g_commutators(K, trees):
    # w = A a B b C a⁻¹ D b⁻¹ is [.,.] times A D C B, up to automorphisms of the free group.
    word = fundamental_polygon(K, trees).word.tolist()
    handles = 0
    while word:
        a = word[0]
        end = word.index(-a)
        b = next(letter for letter in word[1:end] if word.index(-letter) > end)
        B, rest = word[1 : word.index(b)], word[word.index(b) + 1 :]
        C, rest = rest[: rest.index(-a)], rest[rest.index(-a) + 1 :]
        D, A = rest[: rest.index(-b)], rest[rest.index(-b) + 1 :]
        word = A + D + C + B
        handles += 1
    assert handles == K.genus


def test_pairing_from_the_word(K, trees):
    cochains = cotree_cochains(K, trees)
    expected = pairing(K, cochains, cochains)
    assert np.array_equal(word_pairing(fundamental_polygon(K, trees).word), expected)


def test_the_word_is_the_relation_between_the_rooted_loops(K, trees):
    # Run through as the word says, the loops are the boundary of the polygon, which is a disc.
    polygon = fundamental_polygon(K, trees)
    twin = K.twin.ravel()
    loops = rooted_loops(K, trees)
    product = []
    for letter in polygon.word:
        loop = loops[abs(letter) - 1]
        product.extend(loop if letter > 0 else twin[loop[::-1]])
    expected = canonical_rotation(free_reduction(K, polygon.boundary))
    assert canonical_rotation(free_reduction(K, product)) == expected


def test_trees_that_do_not_leave_a_disc_are_refused(K):
    trees = tree_cotree(K)
    cut = trees.face_parent.copy()
    cut[np.flatnonzero(cut >= 0)[0]] = -1
    with pytest.raises(ip.ComplexError, match="do not cut the surface open to one disc"):
        fundamental_polygon(K, replace(trees, face_parent=cut))


def lengths_of(K, loops, lengths=None):
    lengths = edge_lengths(K) if lengths is None else lengths
    return np.array([lengths[K.edge.ravel()[loop]].sum() for loop in loops])


def test_loops_are_rooted_closed_and_generate_homology(K):
    tail, head = half_edge_ends(K)
    for root in (0, K.n_vertices - 1):
        loops = shortest_loops(K, root)
        assert len(loops) == 2 * K.genus
        for loop in loops:
            vertices = walk_vertices(K, loop)
            assert vertices[0] == root == head[loop[-1]]
            assert np.array_equal(vertices, tail[loop])
            assert np.array_equal(head[loop[:-1]], vertices[1:])
        assert np.all(np.diff(lengths_of(K, loops)) >= 0)
        passed = np.array([walk_cochain(K, loop) for loop in loops]).reshape(-1, K.n_edges)
        classes = ip.cohomology_basis(K) @ passed.T
        assert round(abs(np.linalg.det(classes.astype(float)))) == 1


def shortest_independent_loops(K, root, lengths):
    """Lengths of the shortest loops at a vertex that are independent in homology; brute force.

    Paths in order of their length, with the values of a cohomology basis along them, that is,
    shortest paths in the maximal abelian cover.
    """
    basis = ip.cohomology_basis(K).toarray().T
    tail, head = half_edge_ends(K)
    edge, sign = K.edge.ravel(), K.sign.ravel()
    leaving = [np.flatnonzero(tail == v) for v in range(K.n_vertices)]
    start = (root, (0,) * (2 * K.genus))
    heap, settled = [(0.0, *start)], set()
    found, result = np.zeros((0, 2 * K.genus)), []
    while len(result) < 2 * K.genus:
        length, vertex, period = heapq.heappop(heap)
        if (vertex, period) in settled:
            continue
        settled.add((vertex, period))
        if vertex == root and np.linalg.matrix_rank(np.vstack([found, period])) > len(found):
            found = np.vstack([found, period])
            result.append(length)
        for h in leaving[vertex]:
            values = tuple(int(p + sign[h] * c) for p, c in zip(period, basis[edge[h]]))
            if (int(head[h]), values) not in settled:
                heapq.heappush(heap, (length + lengths[edge[h]], int(head[h]), values))
    return np.array(result)


SMALL = ["one vertex", "distorted L", "distorted Bolza", "noisy torus",
         "random gluing 4", "random gluing 8", "random gluing 16"]  # fmt: skip


@pytest.mark.parametrize("name", SMALL)
def test_the_loops_are_as_short_as_any_loops_independent_in_homology(name):
    # The k-th shortest is no longer than the k-th shortest of any others: here, of the best.
    K = SURFACES[name]
    for root in {0, K.n_vertices // 2, K.n_vertices - 1}:
        best = shortest_independent_loops(K, root, edge_lengths(K))
        np.testing.assert_allclose(lengths_of(K, shortest_loops(K, root)), best, rtol=1e-13)


@pytest.mark.parametrize("name", SMALL)
def test_the_loops_with_the_fewest_edges(name):
    K = SURFACES[name]
    ones = np.ones(K.n_edges)
    loops = shortest_loops(K, 0, ones)
    assert np.array_equal([loop.size for loop in loops], shortest_independent_loops(K, 0, ones))


def test_other_trees_give_no_shorter_loops(K):
    ours = lengths_of(K, shortest_loops(K, 0))
    others = np.sort(lengths_of(K, rooted_loops(K, tree_cotree(K, 0))))
    assert np.all(ours <= others * (1 + 1e-13))


def test_loops_on_a_flat_torus_are_near_the_lattice_periods():
    # On a fine flat torus of periods 1 and 0.3 + 1.1i, along edges in six directions.
    K, _ = flat_torus(12, 12, 0.0, 0)
    one, two = lengths_of(K, shortest_loops(K, 5))
    np.testing.assert_allclose([one, two], [1.0, abs(0.3 + 1.1j)], rtol=1e-12)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((1,), "no vertex 1: vertices are 0 … 0"),
        ((-1,), "no vertex -1"),
        ((0, np.ones(8)), r"shape \(9,\), one per edge, not \(8,\)"),
        ((0, np.zeros(9)), "positive and finite"),
        ((0, np.full(9, np.inf)), "positive and finite"),
    ],
)
def test_bad_arguments_are_refused(arguments, message):
    with pytest.raises(ip.ComplexError, match=message):
        shortest_loops(ip.DeltaComplex.from_squares(L_SHAPE, 1), *arguments)


def test_surfaces_that_are_not_closed_are_refused():
    K = ip.DeltaComplex.from_lengths(np.ones((1, 3)), [[0, 1, 2]])
    for function in (fundamental_polygon, shortest_loops, dual_homology_basis):
        with pytest.raises(ip.ComplexError, match="not closed"):
            function(K)
