"""The calculus of Section 2 of Bobenko, Mercat, Schmies: every identity, on Λ."""

import numpy as np
import scipy.linalg
from support.discrete_forms import close, flat, random_forms, random_functions, side_differential

import igl_periods as ip
from igl_periods.forms.calculus import (
    adjoint_d0,
    adjoint_d1,
    area,
    conformal_energy,
    d0,
    d1,
    derivatives,
    dirichlet_energy,
    hodge_star,
    is_holomorphic,
    is_holomorphic_form,
    laplacian_0,
    laplacian_1,
    scalar_product,
    type_01,
    type_10,
    wedge,
)
from igl_periods.forms.graph import double_graph
from igl_periods.forms.quad_graph import (
    on_diagonals,
    side_d0,
    side_d1,
    side_ends,
)
from igl_periods.harmonic.laplace_matrix import laplacian


# The exterior derivative, the star, the scalar product, the adjoint.
def test_d_is_the_sum_around_triangles_and_around_vertices(graph, rng):
    # Second route: from the arrays of the triangulation, side by side and corner by corner.
    K = graph.complex
    alpha = random_forms(graph, rng)
    on_all_edges = np.zeros((2, K.n_edges), dtype=complex)
    on_all_edges[:, graph.edges] = alpha
    sums = np.zeros(graph.n_vertices, dtype=complex)
    np.add.at(sums, graph.polygon, (K.sign * on_all_edges[0][K.edge]).sum(axis=1))
    # e* leads from the right of e to its left: counterclockwise around the vertex e starts at.
    np.add.at(sums, np.roll(K.corner_vertex, -1, 1), K.sign * on_all_edges[1][K.edge])
    assert close(d1(graph, alpha), sums)


def test_d_after_d_is_zero(graph, rng):
    f = random_functions(graph, rng, 3)
    assert close(d1(graph, d0(graph, f)), 0)
    assert close(side_d1(graph, side_d0(graph, f)), 0)
    assert close(adjoint_d0(graph, adjoint_d1(graph, f)), 0)


def test_star(graph, rng):
    alpha, beta = random_forms(graph, rng), random_forms(graph, rng)
    star = hodge_star(graph, alpha)
    # Equation 1, on e and on e*, whose dual is −e and whose weight is 1/ρ.
    assert close(star[1], graph.rho * alpha[0])
    assert close(-star[0], 1 / graph.rho * alpha[1])
    assert close(hodge_star(graph, star), -alpha)
    assert close(wedge(star, hodge_star(graph, beta)), wedge(alpha, beta))


def test_scalar_product_is_hermitian_positive_and_star_an_isometry(graph, rng):
    alpha, beta = random_forms(graph, rng, 4), random_forms(graph, rng, 4)
    product = scalar_product(graph, alpha, beta)
    assert product.shape == (4,)
    assert close(product, wedge(alpha, hodge_star(graph, beta.conj())).sum(axis=-1))
    assert close(
        product,
        0.5 * (graph.rho * alpha[:, 0] * beta[:, 0].conj()).sum(axis=-1)
        + 0.5 * (alpha[:, 1] * beta[:, 1].conj() / graph.rho).sum(axis=-1),
    )
    assert close(product, scalar_product(graph, beta, alpha).conj())
    assert close(product, scalar_product(graph, hodge_star(graph, alpha), hodge_star(graph, beta)))
    assert (scalar_product(graph, alpha, alpha).real > 0).all()


def test_adjoints(graph, rng):
    alpha, f = random_forms(graph, rng), random_functions(graph, rng)
    assert close(
        scalar_product(graph, d0(graph, f), alpha), 0.5 * np.vdot(adjoint_d0(graph, alpha), f)
    )
    assert close(
        scalar_product(graph, alpha, adjoint_d1(graph, f)), 0.5 * np.vdot(f, d1(graph, alpha))
    )
    # d* = −*d*, the stars between functions and 2-forms being identities of arrays.
    assert close(adjoint_d0(graph, alpha), -d1(graph, hodge_star(graph, alpha)))
    assert close(adjoint_d1(graph, f), -hodge_star(graph, d0(graph, f)))


def dense_dual_laplacian(graph):
    """Σ_{y' ~ y} (f(y) − f(y')) / ρ on the faces of Γ, as a matrix."""
    n = graph.n_vertices - graph.complex.n_vertices
    d = np.zeros((graph.n_edges, n))
    rows = np.arange(graph.n_edges)
    np.add.at(d, (rows, graph.head[1] - graph.complex.n_vertices), 1.0)
    np.add.at(d, (rows, graph.tail[1] - graph.complex.n_vertices), -1.0)
    return d.T @ (d / graph.rho[:, None])


def test_laplacian_of_functions(graph, rng):
    f = random_functions(graph, rng)
    n = graph.complex.n_vertices
    on_gamma = laplacian(graph.complex, graph.weights) @ f[:n]
    assert close(laplacian_0(graph, f), np.r_[on_gamma, dense_dual_laplacian(graph) @ f[n:]])


def as_matrix(operator, graph, *shape):
    """An operator on forms or functions as a matrix, columns the images of a basis."""
    basis = np.eye(int(np.prod(shape))).reshape(-1, *shape)
    return operator(graph, basis).reshape(len(basis), -1).T


def nullity(matrix):
    return scipy.linalg.null_space(matrix, rcond=1e-11).shape[1]


def test_harmonic_functions_are_constant_on_each_graph(graph):
    matrix = as_matrix(laplacian_0, graph, graph.n_vertices)
    kernel = scipy.linalg.null_space(matrix, rcond=1e-10)
    assert kernel.shape[1] == 2
    n = graph.complex.n_vertices
    assert close(kernel[:n], kernel[0])
    assert close(kernel[n:], kernel[n])


def test_dimensions_of_harmonic_and_holomorphic_forms(graph):
    # Twice those of the continuous theory, since Γ and Γ* are independent: 4g and 2g.
    g = graph.complex.genus
    assert nullity(as_matrix(laplacian_1, graph, 2, graph.n_edges)) == 4 * g
    holomorphic = np.concatenate(
        [
            as_matrix(d1, graph, 2, graph.n_edges),
            as_matrix(type_01, graph, 2, graph.n_edges),
        ]
    )
    assert nullity(holomorphic) == 2 * g


def test_laplacian_of_forms(graph, rng):
    alpha, beta = random_forms(graph, rng), random_forms(graph, rng)
    image = laplacian_1(graph, alpha)
    energy = 0.5 * np.linalg.norm(d1(graph, alpha)) ** 2
    energy += 0.5 * np.linalg.norm(adjoint_d0(graph, alpha)) ** 2
    assert close(scalar_product(graph, image, alpha), energy)
    assert close(
        scalar_product(graph, image, beta),
        scalar_product(graph, alpha, laplacian_1(graph, beta)),
    )
    assert close(laplacian_1(graph, hodge_star(graph, alpha)), hodge_star(graph, image))
    f = random_functions(graph, rng)
    assert close(laplacian_1(graph, d0(graph, f)), d0(graph, laplacian_0(graph, f)))


# Types.
def test_types_are_eigenspaces_of_the_star(graph, rng):
    alpha, beta = random_forms(graph, rng), random_forms(graph, rng)
    holomorphic, antiholomorphic = type_10(graph, alpha), type_01(graph, alpha)
    assert close(holomorphic + antiholomorphic, alpha)
    assert close(hodge_star(graph, holomorphic), -1j * holomorphic)
    assert close(hodge_star(graph, antiholomorphic), 1j * antiholomorphic)
    assert close(type_10(graph, holomorphic), holomorphic)
    assert close(type_01(graph, antiholomorphic), antiholomorphic)
    assert close(type_10(graph, alpha.conj()), antiholomorphic.conj())
    assert close(scalar_product(graph, holomorphic, type_01(graph, beta)), 0)
    assert close(
        scalar_product(graph, alpha, beta),
        scalar_product(graph, holomorphic, type_10(graph, beta))
        + scalar_product(graph, antiholomorphic, type_01(graph, beta)),
    )
    # The Cauchy–Riemann equation on every quadrilateral.
    assert close(holomorphic[1], 1j * graph.rho * holomorphic[0])
    assert close(antiholomorphic[1], -1j * graph.rho * antiholomorphic[0])


def test_wedge_products_and_types(graph, rng):
    # Forms of one type have no wedge product; i α ∧ ᾱ is positive on (1,0), negative on (0,1).
    alpha, beta = random_forms(graph, rng), random_forms(graph, rng)
    assert close(wedge(type_10(graph, alpha), type_10(graph, beta)), 0)
    for part, sign in ((type_10(graph, alpha), 1), (type_01(graph, alpha), -1)):
        assert close(1j * wedge(part, part.conj()).sum(), sign * scalar_product(graph, part, part))


# Energies and areas.
def test_dirichlet_energy_is_the_mean_of_those_of_both_graphs(graph, rng):
    f = random_functions(graph, rng)
    n = graph.complex.n_vertices
    on_gamma = np.vdot(f[:n], laplacian(graph.complex, graph.weights) @ f[:n]).real
    on_dual = np.vdot(f[n:], dense_dual_laplacian(graph) @ f[n:]).real
    assert close(dirichlet_energy(graph, d0(graph, f)), 0.5 * (on_gamma + on_dual))


def test_conformal_energy_is_dirichlet_energy_minus_twice_the_area(graph, rng):
    # Equations 6 and 7, for differentials of multivalued functions.
    df = random_forms(graph, rng, 5)
    defect = df - 1j * hodge_star(graph, df)
    energy = conformal_energy(graph, df)
    assert close(energy, 0.5 * scalar_product(graph, defect, defect).real)
    assert close(energy, dirichlet_energy(graph, df) - 2 * area(df))
    assert close(energy, dirichlet_energy(graph, df) + wedge(df, df.conj()).sum(axis=-1).imag)
    assert close(area(df), -area(df.conj()))


def test_conformal_energy_vanishes_on_conformal_maps_only(graph, rng):
    df = random_forms(graph, rng)
    scale = dirichlet_energy(graph, df)
    assert conformal_energy(graph, type_10(graph, df)) < 1e-28 * scale
    assert close(
        conformal_energy(graph, type_01(graph, df)), 2 * dirichlet_energy(graph, type_01(graph, df))
    )


def shoelace(*corners):
    """Algebraic area of a polygon in the plane, counterclockwise positive."""
    after = np.roll(np.stack(corners), -1, axis=0)
    return 0.5 * (np.conj(np.stack(corners)) * after).imag.sum(axis=0)


def test_area_is_that_of_the_image_quadrilaterals(graph, rng):
    f = random_functions(graph, rng)
    df = d0(graph, f)
    (x, y), (x2, y2) = graph.tail, graph.head
    image = shoelace(f[x], f[y], f[x2], f[y2])
    assert close(wedge(df, df.conj()), -2j * image)
    assert close(wedge(df, df.conj()), 1j * (df[0] * df[1].conj()).imag)
    # The printed order f(x), f(x'), f(y), f(y') is that of a quadrilateral that crosses itself.
    assert not close(shoelace(f[x], f[x2], f[y], f[y2]), image)
    # A function without periods maps the closed surface to area 0.
    assert close(area(df), 0)


def test_derivatives(graph, rng):
    df = random_forms(graph, rng)
    dz = type_10(graph, random_forms(graph, rng))
    f_z, f_zbar = derivatives(graph, df, dz)
    assert close(df, f_z * dz + f_zbar * dz.conj())
    size = np.abs(f_z) ** 2 - np.abs(f_zbar) ** 2
    assert close(wedge(df, df.conj()), size * wedge(dz, dz.conj()))


def lattice(n):
    """The square torus of n × n squares, and dz on the sides of ◊."""
    K = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n)
    dz = np.zeros(K.n_edges, dtype=complex)
    # In a lower triangle side 2 is horizontal, side 0 vertical, and side 1 their sum, backwards.
    for side, step in ((2, 1.0), (0, 1j), (1, -1 - 1j)):
        dz[K.edge[0::2, side]] = K.sign[0::2, side] * step
    return (graph := double_graph(K)), side_differential(graph, dz)


def integrated(graph, dz):
    """A function z on Λ, and the quadrilaterals on which dz is its differential: not all."""
    x, y = side_ends(graph)
    z = np.full(graph.n_vertices, np.nan, dtype=complex)
    z[0] = 0.0
    while np.isnan(z).any():
        for here, there, step in ((x, y, dz), (y, x, -dz)):
            new = np.isnan(z[there]) & ~np.isnan(z[here])
            z[there[new]] = (z[here] + step)[new]
    there = np.abs(side_d0(graph, z) - dz) < 1e-12
    return z, there[graph.sides].all(axis=0)


def test_z_is_holomorphic_and_its_conjugate_is_not():
    graph, sides = flat()
    z, there = integrated(graph, sides)
    assert 0.4 < there.mean() < 1
    assert is_holomorphic(graph, 2j * z + 3)[there].all()
    assert not is_holomorphic(graph, z.conj())[there].any()
    dz = on_diagonals(graph, sides)
    assert is_holomorphic_form(graph, dz)
    assert not is_holomorphic_form(graph, dz.conj())
    # Of type (1,0), but not closed.
    assert not is_holomorphic_form(graph, dz * np.random.default_rng(0).normal(size=graph.n_edges))


def test_z_squared_is_holomorphic_on_rhombi():
    # f(x') − f(x) = (x' − x)(x' + x), and x + x' = y + y' in a rhombus; not so in other kites.
    graph, sides = lattice(6)
    z, there = integrated(graph, sides)
    assert 0.4 < there.mean() < 1
    assert is_holomorphic(graph, z**2)[there].all()
    constant = np.abs(d0(graph, z**2)[0]) < 1e-12
    assert np.array_equal(is_holomorphic(graph, (z**2).conj())[there], constant[there])
    graph, sides = flat()
    z, there = integrated(graph, sides)
    assert not is_holomorphic(graph, z**2)[there].any()


def test_holomorphic_functions_on_a_closed_surface_are_constant(graph, rng):
    f = np.zeros(graph.n_vertices)
    f[: graph.complex.n_vertices] = 2.0
    assert is_holomorphic(graph, f).all()
    # Where both diagonals are loops there is nothing that could fail.
    loops = (graph.tail == graph.head).all(axis=0)
    assert np.array_equal(is_holomorphic(graph, random_functions(graph, rng)), loops)
    cauchy_riemann = as_matrix(lambda _, u: type_01(graph, d0(graph, u)), graph, graph.n_vertices)
    assert nullity(cauchy_riemann) == 2


def test_operations_take_leading_axes(graph, rng):
    alpha, f = random_forms(graph, rng, 2, 3), random_functions(graph, rng, 2, 3)
    for operation in (d1, adjoint_d0, laplacian_1, hodge_star, type_10, type_01):
        assert close(operation(graph, alpha)[1, 2], operation(graph, alpha[1, 2]))
    for operation in (d0, adjoint_d1, laplacian_0, side_d0):
        assert close(operation(graph, f)[1, 2], operation(graph, f[1, 2]))
    assert wedge(alpha, alpha[0]).shape == (2, 3, graph.n_edges)
