"""Derivatives of the period matrix by lengths and vertices."""

import pickle

import numpy as np
import pytest
from support.random_surfaces import L_SHAPE, noisy_torus

import igl_periods as ip
from igl_periods.complexes import (
    Barycentres,
    DeltaComplex,
    delaunay_flips,
    edge_lengths,
    with_edge_lengths,
    with_positions,
)
from igl_periods.errors import ComplexError
from igl_periods.harmonic import length_gradient, moments
from igl_periods.surfaces import (
    flat_torus,
    glued_rectangles,
    torus_of_revolution,
    torus_of_revolution_modulus,
)

MESHES = ("eight.off", "3holes.obj", "bob_small.ply")
ESTIMATES = ("matrix", "primal", "dual", "mean")


def kept(K, **options):
    return ip.period_matrix(K, keep_forms=True, **options)


@pytest.fixture(scope="module", params=MESHES)
def surface(request, mesh):
    return DeltaComplex.from_mesh(*mesh(request.param))


def difference(value, h=2e-5):
    """The derivative at 0, of fourth order."""
    near, far = (value(t) - value(-t) for t in (h, 2 * h))
    return (8 * near - far) / (12 * h)


def relative(found, expected):
    return np.abs(found - expected).max() / np.abs(expected).max()


# --- identities ---------------------------------------------------------------------------------


def test_scaling_moves_nothing(surface):
    """Σ l_e ∂Π/∂l_e = 0."""
    pm, lengths = kept(surface), edge_lengths(surface)
    assert np.abs(pm.derivative(lengths=lengths)).max() < 1e-12
    W = np.ones((pm.genus, pm.genus)) + 1j
    by_length = pm.gradient(W).lengths * lengths
    assert abs(by_length.sum()) < 1e-12 * np.abs(by_length).sum()


def test_motions_and_similarities_move_nothing(surface):
    pm, V = kept(surface), surface.positions
    turn = np.array([[0.0, 1.0, -0.3], [-1.0, 0.0, 0.7], [0.3, -0.7, 0.0]])
    moved = pm.derivative(vertices=np.stack([V @ turn, V, np.ones_like(V)]))
    assert np.abs(moved).max() < 1e-12


def test_gradients_add_up_over_the_two_sides_of_an_edge(surface):
    """Each face has a share of its own; without flips an edge gets those of its two half-edges."""
    pm = kept(surface, delaunay=False)
    S = np.random.default_rng(1).normal(size=(1, 2 * pm.genus, 2 * pm.genus))
    S = S + S.transpose(0, 2, 1)
    T = pm.forms.basis.astype(float)
    moment = moments(pm.forms.gradients, T.T @ S @ T, surface.n_faces)
    by_side = (length_gradient(surface.lengths, moment)[0] / surface.lengths).ravel()
    twin = surface.twin.ravel()
    found = pm.forms.length_gradients(surface, S)[0]
    scale = np.abs(found).max()
    assert np.abs(found[surface.edge.ravel()] - by_side - by_side[twin]).max() < 1e-12 * scale


@pytest.mark.parametrize("estimate", ESTIMATES)
def test_backward_is_the_transpose_of_forward(surface, estimate):
    pm, rng = kept(surface), np.random.default_rng(0)
    g, V = pm.genus, surface.positions
    W = rng.normal(size=(3, g, g)) + 1j * rng.normal(size=(3, g, g))
    dl, dV = rng.normal(size=(2, surface.n_edges)), rng.normal(size=(2, *V.shape))
    gradient = pm.gradient(W, estimate=estimate)
    for back, there in (
        (
            np.einsum("ce,de->cd", gradient.lengths, dl),
            pm.derivative(lengths=dl, estimate=estimate),
        ),
        (
            np.einsum("cvi,dvi->cd", gradient.vertices, dV),
            pm.derivative(vertices=dV, estimate=estimate),
        ),
    ):
        expected = np.einsum("ckl,dkl->cd", W.conj(), there).real
        assert np.abs(back - expected).max() < 1e-11 * np.abs(expected).max()


def test_several_directions_are_each_for_itself(surface):
    pm, rng = kept(surface), np.random.default_rng(1)
    dl = rng.normal(size=(2, 3, surface.n_edges))
    together = pm.derivative(lengths=dl)
    assert together.shape == (2, 3, pm.genus, pm.genus)
    assert np.allclose(together[1, 2], pm.derivative(lengths=dl[1, 2]), rtol=1e-12)


@pytest.mark.parametrize("seed", range(3))
def test_gradients_of_a_conformal_field_vanish_with_order_two(seed):
    """V ↦ 2 (b·V) V − |V|² b generates inversions, which are conformal."""
    b = np.random.default_rng(seed).normal(size=3)
    moved = []
    for n in (12, 24, 48):
        V, F = torus_of_revolution(2.0, 0.8, 2 * n, n)
        V = V + 0.05 * np.sin(V[:, [1, 2, 0]])
        pm = kept(DeltaComplex.from_mesh(V, F))
        dV = 2 * (V @ b)[:, None] * V - np.sum(V**2, axis=1)[:, None] * b
        moved.append(np.abs(pm.derivative(vertices=dV)).max())
    assert moved[0] / moved[1] > 3.0 and moved[1] / moved[2] > 3.5


# --- against differences ------------------------------------------------------------------------


@pytest.mark.parametrize("estimate", ESTIMATES)
def test_differences_on_meshes(surface, estimate):
    rng = np.random.default_rng(2)
    dV = edge_lengths(surface).mean() * rng.normal(size=surface.positions.shape)
    found = kept(surface).derivative(vertices=dV, estimate=estimate)

    def value(t):
        moved = with_positions(surface, surface.positions + t * dV)
        return getattr(ip.period_matrix(moved), estimate)

    assert relative(difference(value), found) < 1e-7


def test_differences_without_flips():
    K = DeltaComplex.from_mesh(*noisy_torus(9, 7, 0.2, 3))
    dl = np.random.default_rng(3).normal(size=K.n_edges) * edge_lengths(K)
    pm = kept(K, delaunay=False)

    def value(t):
        return ip.period_matrix(
            with_edge_lengths(K, edge_lengths(K) + t * dl), delaunay=False
        ).matrix

    assert relative(difference(value, 1e-5), pm.derivative(lengths=dl)) < 1e-7


def flipped_edges(K):
    return [sorted(flips.edge.tolist()) for flips in delaunay_flips(K)[1]]


@pytest.fixture(scope="module")
def crossing():
    """A path of surfaces on which exactly one flip comes in: where, and the whole path."""
    K = DeltaComplex.from_mesh(*noisy_torus(9, 7, 0.2, 3))
    dl = np.random.default_rng(4).normal(size=K.n_edges) * edge_lengths(K)

    def at(t):
        return with_edge_lengths(K, edge_lengths(K) + t * dl)

    low, high = 0.0, 1e-3
    while flipped_edges(at(low)) == flipped_edges(at(high)):
        high *= 2.0
    while high - low > 1e-15:
        middle = 0.5 * (low + high)
        same = flipped_edges(at(low)) == flipped_edges(at(middle))
        low, high = (middle, high) if same else (low, middle)
    return at, dl, low, high


def test_the_derivative_is_that_of_each_side_of_a_flip(crossing):
    """Π goes on without a jump; both one-sided derivatives are right, and differ by a kink."""
    at, dl, before, after = crossing
    there = [ip.period_matrix(at(t)).matrix for t in (before, after)]
    assert relative(*there) < 1e-12
    slopes = [kept(at(t)).derivative(lengths=dl) for t in (before, after)]
    h = 1e-5
    for t, sign, slope in ((before, -1, slopes[0]), (after, 1, slopes[1])):
        values = [ip.period_matrix(at(t + sign * k * h)).matrix for k in range(5)]
        one_sided = np.tensordot([-25 / 12, 4, -3, 4 / 3, -1 / 4], values, axes=1) / (sign * h)
        assert relative(one_sided, slope) < 1e-7
    assert relative(*slopes) > 1e-9


def test_kinks_are_concave(crossing):
    """Energies are least for the Delaunay triangulation: at a flip they are the minimum of two.

    So their derivative falls, on one form at most: by ∂ρ (Σ a_i u_i)².
    """
    at, dl, before, after = crossing
    slopes = [kept(at(t)).forms.energy_derivatives(at(t), dl[None])[0] for t in (before, after)]
    jump = np.linalg.eigvalsh(slopes[1] - slopes[0])
    assert jump[0] < 0
    assert np.abs(jump[1:]).max() < 1e-9 * abs(jump[0])


def test_the_integral_across_a_flip(crossing):
    at, dl, before, after = crossing
    x, w = np.polynomial.legendre.leggauss(8)
    ends, total = (0.0, before, after, after + 1e-4), 0.0
    for low, high in ((ends[0], ends[1]), (ends[2], ends[3])):
        for node, weight in zip(x, w):
            t = 0.5 * (low + high + (high - low) * node)
            total = total + 0.5 * (high - low) * weight * kept(at(t)).derivative(lengths=dl)
    expected = ip.period_matrix(at(ends[3])).matrix - ip.period_matrix(at(ends[0])).matrix
    assert relative(total, expected) < 1e-8


# --- exact values -------------------------------------------------------------------------------


def test_flat_tori():
    """An edge with the class m + nτ moves by Re(conj(v) n dτ)/|v|; j tells τ in any marking."""
    tau, dtau = 0.3 + 0.8j, 0.7 - 0.4j
    K, there = flat_torus(tau, 3, 2), flat_torus(tau + 1e-7 * dtau, 3, 2)
    back = flat_torus(tau - 1e-7 * dtau, 3, 2)
    dl = (edge_lengths(there) - edge_lengths(back)) / 2e-7
    sides = [(1 / 3, 0.0), (tau / 2, 0.5), (tau / 2 - 1 / 3, 0.5)]
    exact = {round(abs(v), 9): (np.conj(v) * n * dtau).real / abs(v) for v, n in sides}
    exact_dl = np.array([exact[round(length, 9)] for length in edge_lengths(K)])
    assert np.allclose(dl, exact_dl, atol=1e-7)
    pm = kept(K)
    moved = ip.j_derivative(pm) * pm.derivative(lengths=exact_dl)[0, 0]
    assert moved == pytest.approx(ip.j_derivative([[tau]]) * dtau, rel=1e-11)


def l_shape(size):
    return glued_rectangles([(1, 1), (size - 1, 1), (1, size - 1)], L_SHAPE)


def l_shape_matrix(size):
    a, b = 2 * size**2 - 2 * size + 1, -2 * size * (size - 1)
    return 1j / (2 * size - 1) * np.array([[a, b], [b, a]])


@pytest.mark.parametrize("size", [1.7, 2.0, 2.6])
def test_l_shapes(size):
    """Π = i/(2λ−1) [[2λ²−2λ+1, −2λ(λ−1)], …] for every λ."""
    K = l_shape(size)
    dl = difference(lambda t: edge_lengths(l_shape(size + t)), 1e-3)
    pm = kept(K, degree=12)
    gamma = ip.symplectic_isomorphisms(pm, l_shape_matrix(size), 1e-6)[0]
    moved = pm.change_basis(gamma).derivative(lengths=dl)
    exact = difference(lambda t: l_shape_matrix(size + t), 1e-3)
    assert relative(moved, exact) < 1e-7


def test_tori_of_revolution_with_order_two():
    """The smooth torus has τ = i r / √(R² − r²), so ∂τ/∂r = i R² / (R² − r²)^{3/2}."""
    R, r, errors = 2.0, 0.8, []
    exact = 1j * R**2 / (R**2 - r**2) ** 1.5
    for n in (12, 24, 48):
        V, F = torus_of_revolution(R, r, 2 * n, n)
        wider, _ = torus_of_revolution(R, r + 1e-6, 2 * n, n)
        pm = kept(DeltaComplex.from_mesh(V, F))
        near = ip.nearest_marking(pm, [[torus_of_revolution_modulus(R, r)]])
        moved = pm.change_basis(near.gamma).derivative(vertices=(wider - V) / 1e-6)
        errors.append(abs(moved[0, 0] - exact))
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (rates > 1.8).all() and (rates < 2.3).all()


@pytest.mark.parametrize(
    "name", [pytest.param("eight.off", marks=pytest.mark.slow), "bob_small.ply"]
)
def test_rauch_is_as_accurate_as_the_matrix(name, mesh):
    """The error of the derivative from degree 2 on falls with the bound, exponentially."""
    V, F = mesh(name)
    K = DeltaComplex.from_mesh(V, F)
    dV = V @ np.random.default_rng(0).normal(size=(3, 3))

    def value(t):
        return ip.period_matrix(with_positions(K, V + t * dV), degree=8).matrix

    exact = difference(value, 2e-3)
    errors, bounds = [], []
    for degree in (2, 3, 4):
        pm = kept(K, degree=degree)
        errors.append(relative(pm.derivative(vertices=dV), exact))
        bounds.append(pm.bound)
    assert (np.array(errors) < 10 * np.array(bounds)).all()
    assert errors[0] > 5 * errors[1] > 25 * errors[2]


# --- markings, estimates, what is kept ----------------------------------------------------------


def test_reduced_matrices_move_in_their_marking(surface):
    pm, dl = kept(surface), np.random.default_rng(5).normal(size=surface.n_edges)
    gamma = ip.siegel_reduce(pm).gamma
    g = pm.genus
    Q = np.linalg.inv(gamma[g:, :g] @ pm.matrix + gamma[g:, g:])
    expected = Q.T @ pm.derivative(lengths=dl) @ Q
    found = pm.change_basis(gamma).derivative(lengths=dl)
    assert relative(found, expected) < 1e-9


def test_invariants_by_the_chain_rule(mesh):
    """Klein's j of a mesh, forward and backward, against differences."""
    K = DeltaComplex.from_mesh(*mesh("bob_small.ply"))
    dV = np.random.default_rng(6).normal(size=K.positions.shape) * edge_lengths(K).mean()
    pm = kept(K)
    slope = ip.j_derivative(pm)

    def value(t):
        return ip.j_invariant(ip.period_matrix(with_positions(K, K.positions + t * dV)).matrix)

    expected = difference(value)
    assert slope * pm.derivative(vertices=dV)[0, 0] == pytest.approx(expected, rel=1e-7)
    back = pm.gradient([[np.conj(slope)]]).vertices
    assert np.sum(back * dV) == pytest.approx(expected.real, rel=1e-6)


def test_forms_are_computed_again_where_they_were_not_kept(surface):
    W = np.eye((2 - surface.euler_characteristic) // 2) + 0.3j
    for options in ({}, {"delaunay": False}):
        again = ip.period_matrix(surface, **options)
        assert again.forms is None
        at_once = kept(surface, **options)
        assert relative(again.gradient(W).lengths, at_once.gradient(W).lengths) < 1e-9


def test_kept_forms_change_nothing_else(surface):
    one, two = ip.period_matrix(surface), kept(surface)
    assert np.array_equal(one.dirichlet, two.dirichlet) and one.bound == two.bound


def test_kept_forms_pickle(surface):
    pm = kept(surface)
    again = pickle.loads(pickle.dumps(pm))
    W = np.ones((pm.genus, pm.genus))
    assert np.array_equal(again.gradient(W).lengths, pm.gradient(W).lengths)


@pytest.mark.parametrize(
    "options",
    [
        {"tolerance": 1e-3},
        {"tolerance": 1e-9},
        {"rigorous": True},
        {"rigorous": True, "degree": 3},
        {"rigorous": True, "tolerance": 1e-4},
    ],
)
def test_forms_are_kept_with_a_tolerance_and_with_a_proof(options, mesh):
    """The matrix is the same as without; derivatives are as accurate, in every marking."""
    K = DeltaComplex.from_mesh(*mesh("bob_small.ply"))
    dV = K.positions @ np.random.default_rng(0).normal(size=(3, 3))
    pm, plain = kept(K, **options), ip.period_matrix(K, **options)
    assert np.array_equal(pm.dirichlet, plain.dirichlet) and pm.bound == plain.bound
    assert pm.rigorous == options.get("rigorous", False)
    exact = kept(K, degree=9).derivative(vertices=dV)
    assert relative(pm.derivative(vertices=dV), exact) < 30 * pm.bound
    back = np.sum(pm.gradient([[1.0]]).vertices * dV)
    assert back == pytest.approx(pm.derivative(vertices=dV)[0, 0].real, rel=1e-9)
    gamma = np.array([[2, 1], [3, 2]])
    Q = 1 / (3 * pm.matrix[0, 0] + 2)
    moved = pm.change_basis(gamma).derivative(vertices=dV)
    assert relative(moved, Q**2 * pm.derivative(vertices=dV)) < 1e-8


def test_derivatives_go_back_through_divided_faces(mesh, monkeypatch):
    """Rounds of barycentres, each with flips after it; scaling moves nothing."""
    K = DeltaComplex.from_mesh(*mesh("bob_small.ply"))
    monkeypatch.setattr("igl_periods.periods.adaptive_degree.HIGHEST_DEGREE", 5)
    pm = kept(K, tolerance=1e-9)
    assert any(isinstance(move, Barycentres) for move in pm.forms.moves)
    by_length = pm.gradient([[1.0 + 1j]]).lengths
    assert by_length.shape == (K.n_edges,)
    assert abs(by_length @ edge_lengths(K)) < 1e-10 * np.abs(by_length * edge_lengths(K)).sum()


def test_surfaces_without_positions_have_gradients_by_lengths():
    pm = kept(DeltaComplex.from_squares(L_SHAPE, 2))
    assert pm.gradient(np.eye(2)).vertices is None
    with pytest.raises(ComplexError, match="no positions, only lengths"):
        pm.derivative(vertices=np.zeros((3, 3)))
    with pytest.raises(ComplexError, match="no vertex has noise"):
        pm.covariance(0.1)


# --- noise --------------------------------------------------------------------------------------


def test_covariance_against_many_samples():
    K = DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 0))
    sigma = 1e-3 * edge_lengths(K).mean()
    rng, samples = np.random.default_rng(7), []
    for _ in range(400):
        moved = with_positions(K, K.positions + sigma * rng.normal(size=K.positions.shape))
        samples.append(ip.period_matrix(moved).matrix[0, 0])
    z = np.stack([np.real(samples), np.imag(samples)])
    expected = kept(K).covariance(sigma)
    # A standard deviation of 400 samples is off by 1/√800 on average.
    assert np.allclose(
        z.std(axis=1), np.sqrt(np.diag(expected.covariance.reshape(2, 2))), rtol=0.15
    )
    correlation = expected.covariance.reshape(2, 2)[0, 1] / z.std(axis=1).prod()
    assert np.corrcoef(z)[0, 1] == pytest.approx(correlation, abs=0.15)


def test_all_ways_to_state_noise_agree(surface):
    pm, n = kept(surface), surface.n_vertices
    plain = pm.covariance(0.1).covariance
    for noise in (
        np.full(n, 0.1),
        np.tile(0.01 * np.eye(3), (n, 1, 1)),
        *([0.01 * np.eye(3 * n)] if n < 300 else []),
    ):
        assert relative(pm.covariance(noise).covariance, plain) < 1e-12
    deviations = pm.covariance(0.1).standard_deviations
    assert deviations[0, 0].real == pytest.approx(np.sqrt(plain[0, 0, 0, 0, 0, 0]))


# --- bad input ----------------------------------------------------------------------------------


def test_bad_directions():
    pm = kept(DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 0)))
    n = pm.complex.n_edges
    with pytest.raises(ValueError, match="either lengths=dl or vertices=dV"):
        pm.derivative()
    with pytest.raises(ValueError, match="either lengths=dl or vertices=dV"):
        pm.derivative(lengths=np.zeros(n), vertices=np.zeros((30, 3)))
    with pytest.raises(ValueError, match=rf"lengths move by real numbers of the shape \({n},\)"):
        pm.derivative(lengths=np.zeros(n + 1))
    with pytest.raises(ValueError, match="directions of the lengths are not finite"):
        pm.derivative(lengths=np.full(n, np.nan))
    with pytest.raises(ValueError, match=r"vertices move by real numbers of the shape \(30, 3\)"):
        pm.derivative(vertices=np.zeros((30, 2)))
    with pytest.raises(ValueError, match=r"W has the shape of the period matrix, \(1, 1\)"):
        pm.gradient(np.eye(2))
    with pytest.raises(ValueError, match="W has entries that are not finite"):
        pm.gradient([[np.inf]])
    with pytest.raises(ValueError, match="estimate must be"):
        pm.gradient([[1.0]], estimate="exact")


def test_bad_noise():
    pm = kept(DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 0)))
    with pytest.raises(ValueError, match="standard deviations are not negative"):
        pm.covariance(-1.0)
    with pytest.raises(ValueError, match=r"noise of 30 vertices in R\^3"):
        pm.covariance(np.ones(7))
    with pytest.raises(ValueError, match="not finite"):
        pm.covariance(np.nan)
    with pytest.raises(ValueError, match="covariances are symmetric"):
        pm.covariance(np.tile(np.triu(np.ones((3, 3))), (30, 1, 1)))


def test_matrices_whose_forms_are_lost():
    K = DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 0))
    for pm in (ip.period_matrix(K, degree=3), ip.period_matrix(K, weights="extrinsic")):
        with pytest.raises(ComplexError, match="compute it with keep_forms=True"):
            pm.gradient([[1.0]])


def test_extrinsic_weights_keep_no_forms():
    K = DeltaComplex.from_mesh(*noisy_torus(6, 5, 0.1, 0))
    with pytest.raises(ValueError, match="keep_forms=True goes with intrinsic weights"):
        ip.period_matrix(K, keep_forms=True, weights="extrinsic")


def test_genus_zero(meshes):
    pm = ip.period_matrix(*ip.load_mesh(meshes / "spot_triangulated.obj")[:2], keep_forms=True)
    assert pm.derivative(lengths=np.ones(pm.complex.n_edges)).shape == (0, 0)
    assert not pm.gradient(np.zeros((0, 0))).lengths.any()
