"""Period matrices: exact values, invariance, convergence."""

import numpy as np
import pytest
from scipy.sparse import csr_array
from support.brute_force_equivalence import energy, isomorphisms, mobius
from support.random_surfaces import (
    BOLZA,
    HEXAGON,
    L_SHAPE,
    OMEGA_1,
    OMEGA_2,
    OMEGA_3,
    noisy_torus,
    random_gluing,
    random_lengths,
    torus_grid,
    torus_of_revolution,
)

import igl_periods as ip
from igl_periods.complexes.weights import cotan_weights, extrinsic_weights
from igl_periods.harmonic.energies import dirichlet_matrix
from igl_periods.harmonic.potentials import harmonic_potentials
from igl_periods.symplectic.canonical_basis import form_action, is_symplectic, standard_form
from igl_periods.topology.cohomology import pairing

SQUARE_TILED = [(L_SHAPE, OMEGA_1), (BOLZA, OMEGA_2), (HEXAGON, OMEGA_3)]


# Face lists of the maps {3,7} of Klein's quartic and {3,8} of Fermat's (Dyck's map), from
# PSL(2,7) and the group of order 96; simple, oriented, of Euler characteristic −4.
KLEIN = """0,1,2 1,0,7 2,1,11 0,2,3 3,2,14 0,3,4 4,3,17 0,4,5 5,4,19 0,5,6 6,5,20 0,6,7 7,6,21 1,7,8
8,7,15 1,8,9 9,8,20 1,9,10 10,9,22 1,10,11 11,10,17 2,11,12 12,11,21 2,12,13 13,12,22 2,13,14
14,13,19 3,14,15 15,14,8 3,15,16 16,15,22 3,16,17 17,16,20 4,17,10 4,10,18 18,10,22 4,18,19
19,18,21 5,19,13 5,13,9 9,13,22 5,9,20 6,20,16 6,16,12 12,16,22 6,12,21 7,21,18 7,18,15 15,18,22
19,21,23 23,21,11 19,23,14 14,23,8 8,23,20 20,23,17 17,23,11"""


FERMAT = """0,1,2 1,0,8 2,1,11 0,2,3 3,2,9 0,3,4 4,3,11 0,4,5 5,4,9 0,5,6 6,5,11 0,6,7 7,6,9 0,7,8
8,7,11 1,8,9 9,8,3 1,9,6 1,6,10 10,6,3 1,10,4 4,10,7 1,4,11 2,11,7 2,7,10 2,10,5 5,10,8 2,5,9
8,10,3 5,8,11 6,11,3 4,7,9"""


_E = (-1 + 1j * np.sqrt(7)) / 2


KLEIN_PI = 0.5 * np.array([[_E, 1, 1], [1, _E, 1], [1, 1, _E]])


FERMAT_PI = np.array([[1 + 1j, -(1 + 1j) / 2, 0], [-(1 + 1j) / 2, 0.5 + 1j, (1 - 1j) / 2],
                      [0, (1 - 1j) / 2, 1j]])  # fmt: skip


def faces_of(text):
    return np.array([[int(v) for v in face.split(",")] for face in text.split()])


def matched(pm, exact, size=2):
    """The matrix, reduced, and the exact one in its marking."""
    reduced, target = pm.reduced(), ip.siegel_reduce(exact).matrix
    found = isomorphisms(target, reduced.matrix, tolerance=1e-9, size=size, limit=1)
    assert found, "no modular transformation matches"
    return reduced, mobius(found[0], target)


def in_marking_of(pm, reference):
    """The matrix in the marking of another one on the same edges: γ is read off the pairing."""
    J = standard_form(pm.genus)
    U = pairing(pm.complex, reference.cocycles, pm.cocycles) @ -J
    assert is_symplectic(U)
    return pm.change_basis(form_action(U))


def check_bracket(pm, exact, allowance=1e-12):
    """J D⁻¹ Jᵀ ≤ D_exact ≤ D, and what follows from it for Π."""
    J = standard_form(pm.genus)
    D, D_exact = pm.dirichlet, energy(exact)
    scale = np.abs(D).max()
    assert np.linalg.eigvalsh(D - D_exact)[0] > -allowance * scale
    assert np.linalg.eigvalsh(D_exact - J @ np.linalg.inv(D) @ J.T)[0] > -allowance * scale
    assert np.linalg.eigvalsh(pm.dual.imag - exact.imag)[0] > -allowance * scale
    assert np.linalg.eigvalsh(exact.imag - pm.primal.imag)[0] > -allowance * scale
    root = np.linalg.inv(np.linalg.cholesky(pm.matrix.imag))
    assert np.linalg.norm(root @ (exact - pm.matrix) @ root.T, 2) <= pm.bound
    assert np.all(np.abs(exact - pm.matrix) <= pm.entry_bounds)


@pytest.mark.parametrize("n", [1, 2, 3, 6])
@pytest.mark.parametrize(("gluing", "omega"), SQUARE_TILED)
def test_square_tiled_surfaces_of_the_paper(gluing, omega, n):
    # Their symmetries determine them, so the symplectic mean is exact at every resolution.
    pm = ip.period_matrix(ip.DeltaComplex.from_squares(gluing, n))
    reduced, exact = matched(pm, omega)
    np.testing.assert_allclose(reduced.matrix, exact, rtol=0, atol=1e-12)
    check_bracket(reduced, exact)


@pytest.mark.parametrize(("text", "exact"), [(KLEIN, KLEIN_PI), (FERMAT, FERMAT_PI)])
def test_quartics_from_their_face_lists(text, exact):
    F = faces_of(text)
    pm = ip.period_matrix(ip.DeltaComplex.from_lengths(np.ones((len(F), 3)), F))
    assert pm.genus == 3
    reduced, match = matched(pm, exact, size=1)
    np.testing.assert_allclose(reduced.matrix, match, rtol=0, atol=1e-12)
    check_bracket(reduced, match)


@pytest.mark.parametrize("tau", [0.3 + 1.1j, -0.42 + 0.97j, 0.1 + 2.5j])
def test_flat_tori_are_exact_with_the_right_sign(tau):
    # A linear form is piecewise linear on any triangulation: D is exact.  In the basis of the
    # lattice 1, τ the marking is known, which pins the sign of the real part.
    n, m = 5, 4
    F = torus_grid(n, m)
    steps = np.array([1 / n, 1 / n + tau / m, tau / m])
    lower, upper = np.abs(steps[[2, 1, 0]]), np.abs(steps[[0, 2, 1]])
    lengths = np.concatenate([np.tile(lower, (n * m, 1)), np.tile(upper, (n * m, 1))])
    K = ip.DeltaComplex.from_lengths(lengths, F)
    pm = ip.period_matrix(K)
    assert pm.bound < 1e-12
    # The classes with periods (1, 0) and (0, 1) along the sides 1 and τ of the lattice, one step
    # each: integer cochains that jump where the grid closes up.
    along = np.zeros((2, K.n_edges), dtype=np.int64)
    tail = np.roll(K.corner_vertex, -1, 1).ravel()
    head = np.roll(K.corner_vertex, 1, 1).ravel()
    forward = np.flatnonzero(K.sign.ravel() > 0)
    for k, position in enumerate([lambda v: v // m, lambda v: v % m]):
        jump = position(head[forward]) - position(tail[forward])
        along[k, K.edge.ravel()[forward]] = (jump < -1).astype(int) - (jump > 1).astype(int)
    marking = csr_array(along)
    assert np.array_equal(pairing(K, marking, marking), [[0, 1], [-1, 0]])
    U = pairing(K, marking, pm.cocycles) @ -standard_form(1)
    assert is_symplectic(U)
    moved = pm.change_basis(form_action(U))
    assert abs(moved.matrix[0, 0] - tau) < 1e-12
    assert abs(moved.matrix[0, 0] - tau) <= moved.bound * tau.imag


def test_torus_of_revolution_converges_at_second_order():
    R, r = 2.0, 0.8
    tau = 1j * r / np.sqrt(R * R - r * r)
    exact = ip.siegel_reduce([[tau]]).matrix[0, 0]
    errors, bounds = [], []
    for n in (16, 32, 64, 128):
        pm = ip.period_matrix(*torus_of_revolution(R, r, n, n // 2)).reduced()
        errors.append(abs(pm.primal[0, 0] - exact))
        bounds.append(pm.bound)
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    np.testing.assert_allclose(rates[1:], 2.0, atol=0.1)
    np.testing.assert_allclose(np.log2(np.array(bounds[:-1]) / bounds[1:])[1:], 2.0, atol=0.1)


@pytest.mark.parametrize(
    ("name", "genus"),
    [("wente_torus02.obj", 1), ("botijo.obj", 5), ("scaffolding.ply", 28), ("buckyball.obj", 31),
     ("Csaszar.ply", 1), ("spot_triangulated.obj", 0), ("kq_surface.obj", 3)],
)  # fmt: skip
def test_real_meshes_give_reduced_symmetric_matrices(computed, name, genus):
    pm = computed(name)
    assert pm.genus == genus
    assert np.array_equal(pm.matrix, pm.matrix.T)
    assert np.abs(pm.reduced().matrix.real).max(initial=0) <= 0.5 + 1e-9
    assert np.all(pm.symplectic_eigenvalues >= 1 - 1e-12)


@pytest.mark.parametrize("name", ["eight.off", "fertility.off", "rocker-arm.obj"])
def test_flips_keep_the_marking(mesh, computed, name):
    with_flips = computed(name)
    without = ip.period_matrix(*mesh(name), delaunay=False)
    assert (with_flips.cocycles != without.cocycles).nnz == 0
    assert without.bound > with_flips.bound
    difference = np.abs(with_flips.matrix - without.matrix)
    assert np.all(difference <= with_flips.entry_bounds + without.entry_bounds)
    assert difference.max() > 1e-6


def _moved(V, F, kind, rng):
    if kind == "scaling":
        return 1e-3 * V, F
    if kind == "motion":
        Q, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        Q *= np.linalg.det(Q)
        return V @ Q.T + rng.normal(size=3), F
    if kind == "vertices":
        order = rng.permutation(len(V))
        return V[order], np.argsort(order)[F]
    if kind == "faces":
        turned = np.take_along_axis(F, (np.arange(3) + rng.integers(0, 3, (len(F), 1))) % 3, axis=1)
        return V, rng.permutation(turned)
    return V, F[:, ::-1]


@pytest.mark.parametrize("kind", ["scaling", "motion", "vertices", "faces"])
def test_invariance(mesh, kind):
    V, F = mesh("eight.off")
    pm = ip.period_matrix(V, F)
    other = ip.period_matrix(*_moved(V, F, kind, np.random.default_rng(3)))
    np.testing.assert_allclose(
        other.symplectic_eigenvalues, pm.symplectic_eigenvalues, rtol=0, atol=1e-10
    )
    assert isomorphisms(pm.reduced().matrix, other.reduced().matrix, tolerance=1e-9)


def test_orientation_reversal_gives_minus_the_conjugate(mesh):
    V, F = mesh("eight.off")
    pm = ip.period_matrix(V, F).reduced().matrix
    reversed_pm = ip.period_matrix(V, F[:, ::-1]).reduced().matrix
    assert isomorphisms(-pm.conj(), reversed_pm, tolerance=1e-9)


def test_orientation_reversal_of_a_chiral_torus():
    # τ = 0.3 + 1.1i is not equivalent to its mirror image: the sign of Re is not free.
    V, F = noisy_torus(9, 7, 0.3, 11)
    pm = ip.period_matrix(V, F).reduced().matrix
    mirrored = ip.period_matrix(V, F[:, ::-1]).reduced().matrix
    assert not isomorphisms(pm, mirrored, tolerance=1e-6)
    assert isomorphisms(-pm.conj(), mirrored, tolerance=1e-9)


@pytest.mark.parametrize("seed", range(4))
def test_another_root_gives_an_equivalent_matrix(seed):
    K = ip.DeltaComplex.from_mesh(*noisy_torus(8, 5, 0.2, seed))
    L = ip.DeltaComplex.from_squares(L_SHAPE, 3 + seed)
    for surface in (K, L):
        reference = ip.period_matrix(surface, delaunay=False)
        basis = ip.cohomology_basis(surface, root=surface.n_vertices // 2)
        potentials = harmonic_potentials(surface, cotan_weights(surface), basis)
        D = dirichlet_matrix(surface, basis, potentials)
        other = in_marking_of(ip.PeriodMatrix(D, True, basis, surface), reference)
        np.testing.assert_allclose(other.matrix, reference.matrix, rtol=0, atol=1e-10)
        np.testing.assert_allclose(
            other.symplectic_eigenvalues, reference.symplectic_eigenvalues, rtol=0, atol=1e-10
        )


def test_two_runs_give_the_same_bits(mesh):
    one, two = (ip.period_matrix(*mesh("fertility.off")) for _ in range(2))
    assert one.dirichlet.tobytes() == two.dirichlet.tobytes()
    assert one.matrix.tobytes() == two.matrix.tobytes()


@pytest.mark.parametrize("seed", range(30))
def test_random_gluings(seed):
    rng = np.random.default_rng(seed)
    twin = random_gluing(int(2 * rng.integers(1, 12)), rng)
    for K in ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components():
        pm = ip.period_matrix(K)
        Pi = pm.matrix
        assert np.all(np.isfinite(Pi))
        assert np.array_equal(Pi, Pi.T)
        if pm.genus:
            assert np.linalg.eigvalsh(Pi.imag)[0] > 0
            assert pm.symplectic_eigenvalues[-1] > 1 - 1e-12


# Weights
def test_weights_of_a_mesh_handed_over_as_numbers(mesh):
    K = ip.DeltaComplex.from_mesh(*mesh("3holes.obj"))
    rho = cotan_weights(K)[K.edge]
    pm, abstract = ip.period_matrix(K), ip.period_matrix_from_weights(rho, K.twin)
    np.testing.assert_allclose(in_marking_of(abstract, pm).matrix, pm.matrix, rtol=0, atol=1e-11)
    assert abstract.bound is None
    assert abstract.entry_bounds is None


def test_extrinsic_weights_have_no_bound_and_are_close(mesh):
    V, F = mesh("3holes.obj")
    pm, naive = ip.period_matrix(V, F), ip.period_matrix(V, F, weights="extrinsic")
    assert naive.bound is None
    difference = np.abs(naive.matrix - pm.matrix).max()
    assert 1e-6 < difference < 0.05
    K = ip.DeltaComplex.from_mesh(V, F)
    by_hand = ip.period_matrix_from_weights(extrinsic_weights(K)[K.edge], K.twin)
    np.testing.assert_allclose(
        in_marking_of(by_hand, naive).matrix, naive.matrix, rtol=0, atol=1e-11
    )


def test_abstract_weights_of_square_lattices():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 2)
    pm = ip.period_matrix_from_weights(cotan_weights(K)[K.edge], K.twin)
    reduced, exact = matched(pm, OMEGA_1)
    np.testing.assert_allclose(reduced.matrix, exact, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda rho: rho.__setitem__((0, 0), np.nan), "NaN or infinite"),
        (lambda rho: rho.__setitem__((0, 0), 7.0), "different weights"),
        (lambda rho: rho.__imul__(1e101), "rho reaches 1e.101: energies up to 1e.100"),
        (lambda rho: rho.__imul__(-1.0), "no positive definite energy: .* negative, the least is"),
    ],
)
def test_abstract_weights_that_are_refused(change, message):
    K = ip.DeltaComplex.from_squares(L_SHAPE, 3)
    rho = cotan_weights(K)[K.edge]
    change(rho)
    with pytest.raises(ip.ComplexError, match=message):
        ip.period_matrix_from_weights(rho, K.twin)
    with pytest.raises(ip.ComplexError, match="rho must be a real array"):
        ip.period_matrix_from_weights(rho[:2], K.twin)
    with pytest.raises(ip.ComplexError, match="rho is not a rectangular array"):
        ip.period_matrix_from_weights([[1.0, 1.0, 1.0], [1.0]], K.twin)


def test_one_vertex_and_negative_weights():
    # Nothing to solve with one vertex; the energy itself is refused.
    K = ip.DeltaComplex.from_squares(L_SHAPE, 1)
    with pytest.raises(ip.ComplexError, match="not positive definite"):
        ip.period_matrix_from_weights(-np.ones(K.twin.shape), K.twin)


# The result
def test_genus_zero_is_no_error(mesh):
    pm = ip.period_matrix(*mesh("spot_triangulated.obj"))
    assert (pm.genus, pm.matrix.shape, pm.bound) == (0, (0, 0), 0.0)
    assert pm.reduced().matrix.shape == pm.primal.shape == pm.entry_bounds.shape == (0, 0)


def test_degrees_and_tolerances_are_in_one_marking(mesh, computed):
    V, F = mesh("eight.off")
    linear, fourth = computed("eight.off"), ip.period_matrix(V, F, degree=4)
    sharp = ip.period_matrix(V, F, tolerance=1e-7)
    assert fourth.bound < 1e-8 < 1e-7 < linear.bound
    assert sharp.bound <= 1e-7
    for pm in (linear, sharp):
        assert (pm.cocycles != fourth.cocycles).nnz == 0
        assert np.all(np.abs(pm.matrix - fourth.matrix) <= pm.entry_bounds + fourth.entry_bounds)


def test_a_tolerance_that_cannot_be_met():
    K = ip.DeltaComplex.from_squares(L_SHAPE, 2)
    with pytest.warns(ip.ToleranceWarning, match="not 1e-17 as wanted: rounding"):
        pm = ip.period_matrix(K, tolerance=1e-17)
    assert pm.bound < 1e-11
    with pytest.warns(ip.ToleranceWarning, match="unknowns"):
        few = ip.period_matrix(K, tolerance=1e-11, max_unknowns=200)
    assert 1e-11 < few.bound < 0.1
