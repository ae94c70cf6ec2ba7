"""The quadrilateral graph: sides, products on sides and diagonals, the flat torus."""

import numpy as np
from support.discrete_forms import close, complex_normal, flat, random_forms, random_functions

from igl_periods.forms.calculus import (
    area,
    d0,
    d1,
    wedge,
)
from igl_periods.forms.quad_graph import (
    on_diagonals,
    quad_product,
    side_d0,
    side_d1,
    side_ends,
    side_product,
    side_wedge,
)


def test_every_side_has_a_quadrilateral_on_either_hand(graph):
    for along in (graph.sides[[0, 2]], graph.sides[[1, 3]]):
        assert np.array_equal(np.sort(along.ravel()), np.arange(2 * graph.n_edges))


def test_sides_join_the_ends_of_the_diagonals(graph):
    start, end = side_ends(graph)
    (x, y), (x2, y2) = graph.tail, graph.head
    assert np.array_equal(start[graph.sides], [x, x2, x2, x])
    assert np.array_equal(end[graph.sides], [y, y, y2, y2])


def test_stokes_on_a_closed_surface(graph, rng):
    n = graph.complex.n_vertices
    sums = d1(graph, random_forms(graph, rng))
    assert close(sums[:n].sum(), 0)
    assert close(sums[n:].sum(), 0)
    assert close(side_d1(graph, complex_normal(rng, 2 * graph.n_edges)).sum(), 0)


def test_area_is_an_integral_along_the_boundary(graph, rng):
    # Equation 8, second form, on a random part of the surface.
    f = random_functions(graph, rng)
    df = d0(graph, f)
    chosen = rng.random(graph.n_edges) < 0.4
    boundary = np.zeros(2 * graph.n_edges)
    np.add.at(boundary, graph.sides[:, chosen], np.array([[1.0], [-1], [1], [-1]]))
    inner = np.bincount(graph.sides[:, chosen].ravel(), minlength=boundary.size) == 2
    assert not boundary[inner].any()
    form = side_product(graph, f, side_d0(graph, f.conj()))
    form -= side_product(graph, f.conj(), side_d0(graph, f))
    assert close(0.5j * wedge(df, df.conj())[chosen].sum(), 0.25j * (boundary * form).sum())


# The quad-graph.
def test_wedge_product_on_sides_is_that_of_the_averages_on_diagonals(graph, rng):
    alpha, beta = complex_normal(rng, 2, 3, 2 * graph.n_edges)
    assert close(
        side_wedge(graph, alpha, beta),
        wedge(on_diagonals(graph, alpha), on_diagonals(graph, beta)),
    )
    assert close(side_wedge(graph, alpha, beta), -side_wedge(graph, beta, alpha))


def test_wedge_product_on_sides_is_the_sum_over_corners(graph, rng):
    # The formula as it stands, corner by corner of one quadrilateral after the other.
    alpha, beta = complex_normal(rng, 2, 2 * graph.n_edges)
    product = side_wedge(graph, alpha, beta)
    for q in range(graph.n_edges):
        # Values along x_k x_{k+1}, with x_1 x_2 x_3 x_4 = x y x' y'.
        a = [alpha[s] * sign for s, sign in zip(graph.sides[:, q], (1, -1, 1, -1))]
        b = [beta[s] * sign for s, sign in zip(graph.sides[:, q], (1, -1, 1, -1))]
        total = sum(a[k - 1] * b[k] - (-a[k]) * (-b[k - 1]) for k in range(4))
        assert close(product[q], total / 4)


def test_averages_of_exact_forms_are_exact(graph, rng):
    f = random_functions(graph, rng)
    assert close(on_diagonals(graph, side_d0(graph, f)), d0(graph, f))


def test_d_is_a_derivation(graph, rng):
    f, h = random_functions(graph, rng, 2)
    product = side_product(graph, f, side_d0(graph, h)) + side_product(graph, h, side_d0(graph, f))
    assert close(side_d0(graph, f * h), product)
    mean_f, mean_h = (0.5 * (u[graph.tail] + u[graph.head]) for u in (f, h))
    assert close(d0(graph, f * h), mean_f * d0(graph, h) + mean_h * d0(graph, f))
    alpha = complex_normal(rng, 2 * graph.n_edges)
    assert close(
        side_d1(graph, side_product(graph, f, alpha)),
        side_wedge(graph, side_d0(graph, f), alpha) + quad_product(graph, f, side_d1(graph, alpha)),
    )


def test_quadrilaterals_of_a_flat_torus_are_kites_and_tile_it():
    # e* has the length ρ |e| and crosses e at a right angle from right to left, and the areas of
    # the quadrilaterals, all counterclockwise, add up to that of the torus.
    graph, sides = flat()
    dz = on_diagonals(graph, sides)
    assert close(dz[1], 1j * graph.rho * dz[0])
    assert close(side_d1(graph, sides), 0)
    assert close(area(dz), 1.1)
    assert (wedge(dz, dz.conj()).imag < 0).all()
