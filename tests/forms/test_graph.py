"""The double graph: cell decompositions, diagonals that are not edges, refused weights."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.delaunay_surfaces import distorted
from support.random_surfaces import BOLZA, L_SHAPE, torus_grid

import igl_periods as ip
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.complexes.weights import cotan_weights
from igl_periods.forms.graph import double_graph


# The double graph and the quad-graph.
def test_lambda_and_the_quad_graph_are_cell_decompositions(graph):
    chi = graph.complex.euler_characteristic
    n_primal = graph.complex.n_vertices
    n_dual = graph.n_vertices - n_primal
    assert n_primal - graph.n_edges + n_dual == chi
    assert graph.n_vertices - 2 * graph.n_edges + graph.n_edges == chi
    for row, vertices in enumerate((range(n_primal), range(n_primal, graph.n_vertices))):
        assert np.array_equal(np.union1d(graph.tail[row], graph.head[row]), vertices)


@pytest.mark.parametrize("n", [1, 2, 3])
def test_diagonals_of_squares_are_no_edges(n):
    graph = double_graph(ip.DeltaComplex.from_squares(L_SHAPE, n))
    np.testing.assert_allclose(graph.rho, 1.0, rtol=1e-14)
    n_squares = graph.n_vertices - graph.complex.n_vertices
    assert (graph.n_edges, n_squares) == (6 * n * n, 3 * n * n)
    degree = np.bincount(np.concatenate([graph.tail[1], graph.head[1]]))
    assert np.array_equal(degree[graph.complex.n_vertices :], np.full(n_squares, 4))


def test_diagonals_of_rectangles_are_no_edges():
    # Their cotangents add up to 0 by Pythagoras, in floating point to something of either sign.
    rng = np.random.default_rng(0)
    signs = set()
    for a, b in rng.uniform(0.1, 1.0, (40, 2)):
        F = torus_grid(3, 4)
        lengths = np.empty((24, 3))
        lengths[:12], lengths[12:] = (b, np.hypot(a, b), a), (a, b, np.hypot(a, b))
        K = ip.DeltaComplex.from_lengths(lengths, F)
        diagonals = np.setdiff1d(np.arange(K.n_edges), (graph := double_graph(K)).edges)
        assert (graph.n_edges, diagonals.size) == (24, 12)
        signs |= set(np.sign(cotan_weights(K)[diagonals]))
    assert signs >= {-1.0, 1.0}


def test_squares_by_explicit_weights_are_the_same_graph():
    K = ip.DeltaComplex.from_squares(BOLZA, 2)
    one, two = double_graph(K), double_graph(K, np.rint(cotan_weights(K)))
    for name in ("edges", "tail", "head", "polygon", "sides"):
        assert np.array_equal(getattr(one, name), getattr(two, name))


def test_negative_weights_are_refused():
    K = distorted(L_SHAPE, 3, 0.15, 0)
    negative = np.count_nonzero(cotan_weights(K) < 0)
    with pytest.raises(ip.ComplexError, match=f"{negative} of 81 weights .* Run Delaunay first"):
        double_graph(K)
    double_graph(intrinsic_delaunay(K, csr_array((0, K.n_edges)))[0])


def test_weights_that_leave_no_discs_are_refused():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 2)
    with pytest.raises(ip.ComplexError, match=r"36 edges of weight 0 .* not to discs"):
        double_graph(K, np.zeros(K.n_edges))
    around_a_vertex = np.ones(K.n_edges)
    around_a_vertex[np.any(np.stack(edge_ends(K)) == 0, axis=0)] = 0.0
    with pytest.raises(ip.ComplexError, match="not to discs"):
        double_graph(K, around_a_vertex)


@pytest.mark.parametrize(
    ("weights", "message"),
    [
        (np.ones(7), r"shape \(9,\), one per edge, not \(7,\)"),
        (np.ones(9, dtype=complex), "real array .* of complex128"),
        (np.full(9, np.nan), "NaN or infinite"),
    ],
)
def test_malformed_weights_are_refused(weights, message):
    with pytest.raises(ip.ComplexError, match=message):
        double_graph(ip.DeltaComplex.from_squares(L_SHAPE, 1), weights)


def test_a_surface_with_boundary_is_refused():
    K = ip.DeltaComplex.from_lengths(np.ones((1, 3)), [[0, 1, 2]])
    with pytest.raises(ip.ComplexError, match="not closed"):
        double_graph(K)
