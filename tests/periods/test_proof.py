"""Period matrices whose bound is proved: exact values, bad markings, extreme triangles, errors."""

import json
import pickle
from fractions import Fraction

import numpy as np
import pytest
from support.delaunay_surfaces import distorted
from support.extreme_surfaces import capped_torus, sheared_strips, spiked_torus
from support.modular_words import random_word
from support.random_surfaces import (
    BOLZA,
    HEXAGON,
    L_SHAPE,
    OMEGA_1,
    OMEGA_2,
    OMEGA_3,
    needle_gluing,
    noisy_torus,
)

import igl_periods as ip
from igl_periods.proofs import midpoint_radius
from igl_periods.reports import summary
from igl_periods.reports.json_document import period_matrix_to_json
from igl_periods.reports.words import rounded_up


def proved(surface, F=None, **options):
    return ip.period_matrix(surface, F, rigorous=True, **options)


@pytest.mark.parametrize("degree", [1, 2, 5])
@pytest.mark.parametrize(("a", "b", "c"), [(3, 4, 5), (5, 12, 13), (20, 21, 29), (9, 40, 41)])
def test_tori_of_exact_rectangles_are_within_the_bound(a, b, c, degree):
    # Linear functions are exact there: the bound is nothing but rounding, and covers it.
    # Two triangles glued to a rectangle, and opposite sides of that to each other.
    lengths = np.array([[c, a, b], [c, a, b]], dtype=float)
    K = ip.DeltaComplex.from_gluing(lengths, [[3, 4, 5], [0, 1, 2]])
    pm = proved(K, degree=degree)
    assert pm.rigorous
    assert pm.genus == 1
    z = pm.reduced().matrix[0, 0]
    X, Y = Fraction(float(z.real)), Fraction(float(z.imag))
    exact = Fraction(b, a)
    bound = Fraction(pm.reduced().bound)
    assert X**2 + (Y - exact) ** 2 <= (bound * Y) ** 2
    assert pm.reduced().bound < 1e-13


@pytest.mark.parametrize(("n", "m", "k", "h"), [(40, 4, 18, 0.9), (200, 4, 90, 0.7)])
def test_rounding_of_many_flips_is_covered(n, m, k, h):
    # The modulus follows from the lengths as they are stored, exactly: i n / (m height).
    K, b, c = sheared_strips(n, m, k, h)
    b, c = Fraction(b), Fraction(c)
    foot = (1 + b * b - c * c) / 2
    exact = 1j * n / (m * float(b * b - foot * foot) ** 0.5)
    pm = proved(K).reduced()
    assert abs(pm.matrix[0, 0] - exact) <= pm.bound * pm.matrix[0, 0].imag + 1e-15 * exact.imag
    # The lengths of flipped edges are not rounded over and over.
    assert pm.bound < 1e-11


SQUARES = [(L_SHAPE, OMEGA_1), (BOLZA, OMEGA_2), (HEXAGON, OMEGA_3)]


@pytest.mark.parametrize("degree", [1, 2, 6, 10])
@pytest.mark.parametrize(("gluing", "named"), SQUARES, ids=["1", "2", "3"])
def test_square_tiled_surfaces_are_within_the_bound(gluing, named, degree):
    pm = proved(ip.DeltaComplex.from_squares(gluing, 2), degree=degree)
    (gamma, *_) = ip.symplectic_isomorphisms(named, pm.matrix, tolerance=0.3, limit=1)
    exact = ip.siegel_transform(gamma, named)
    L = np.linalg.cholesky(pm.matrix.imag)
    half = np.linalg.solve(L, exact - pm.matrix)
    assert np.linalg.norm(np.linalg.solve(L, half.T), 2) <= pm.bound + 1e-13


ORDINARY = {
    "torus": ip.DeltaComplex.from_mesh(*noisy_torus(8, 6, 0.1, 0)),
    "L": distorted(L_SHAPE, 2, 0.1, 0),
    "Bolza": distorted(BOLZA, 2, 0.1, 1),
}


@pytest.mark.parametrize("delaunay", [True, False])
@pytest.mark.parametrize("degree", [1, 2, 4, 7])
@pytest.mark.parametrize("name", ORDINARY)
def test_bounds_of_ordinary_surfaces_are_those_with_an_allowance(name, degree, delaunay):
    options = {"degree": degree, "delaunay": delaunay}
    one, other = proved(ORDINARY[name], **options), ip.period_matrix(ORDINARY[name], **options)
    assert one.bound == pytest.approx(other.bound, rel=1e-2)
    assert np.allclose(one.matrix, other.matrix, rtol=0, atol=1e-11)
    assert not other.rigorous
    assert one.dirichlet == pytest.approx(other.dirichlet, rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("name", ORDINARY)
def test_degrees_agree_within_their_bounds(name):
    results = [proved(ORDINARY[name], degree=p) for p in (1, 2, 4, 8)]
    for pm in results:
        assert np.all(np.abs(pm.matrix - results[-1].matrix) <= pm.entry_bounds)


def extreme_surfaces():
    rng = np.random.default_rng(6)
    for height in (1e3, 1e5, 1e7, 3e8):
        yield f"spike {height:g}", spiked_torus(height, 2)
    for height in (1e-3, 1e-5, 1e-7):
        yield f"caps {height:g}", capped_torus(height, 4)
    for exponent in (3, 6, 8):
        yield f"needles {exponent}", ip.DeltaComplex.from_gluing(*needle_gluing(8, exponent, rng))


EXTREME = [
    pytest.param(part, id=name)
    for name, K in extreme_surfaces()
    for part in K.components()
    if part.genus
]


@pytest.mark.parametrize("degree", [1, 3])
@pytest.mark.parametrize("K", EXTREME)
def test_extreme_triangles_have_true_bounds_or_clear_errors(K, degree):
    try:
        pm = proved(K, degree=degree)
    except ip.ComplexError as error:
        words = "nothing can be proved|rounding hides|positive definite"
        with pytest.raises(ip.ComplexError, match=words):
            raise error
        return
    assert np.isfinite(pm.bound)
    # Another degree and triangulation, within both bounds.
    other = ip.period_matrix(K, degree=5 - degree, delaunay=degree == 1)
    assert np.all(np.abs(pm.matrix - other.matrix) <= pm.entry_bounds + other.entry_bounds)


@pytest.mark.parametrize("scale", [1e-50, 1e-8, 1e8, 1e50])
def test_scale_does_not_matter(scale):
    V, F = noisy_torus(6, 5, 0.3, 5)
    one, other = proved(V, F), proved(scale * V, F)
    assert other.bound == pytest.approx(one.bound, rel=1e-11)


@pytest.mark.parametrize("length", [1, 5, 20])
def test_the_proof_passes_to_every_marking(length):
    pm = proved(ORDINARY["Bolza"], degree=3)
    U = random_word(pm.genus, length, np.random.default_rng(length))
    moved = pm.change_basis(U)
    assert moved.rigorous
    # Energies in balls lose nothing; what is left is the rounding of the matrix itself.
    assert moved.bound >= pm.bound * (1 - 1e-9)
    back = moved.reduced()
    assert back.rigorous
    assert back.bound == pytest.approx(pm.reduced().bound, rel=1e-6)
    exact = ip.siegel_transform(U, pm.matrix)
    assert np.all(np.abs(moved.matrix - exact) <= 2.1 * moved.entry_bounds)


@pytest.mark.parametrize(("shift", "shear"), [(3, 3), (4, 4), (6, 6), (8, 6), (12, 6)])
def test_markings_without_digits_are_refused(shift, shear):
    pm = proved(ORDINARY["torus"])
    far = np.array([[1, 10**shift], [0, 1]]) @ np.array([[1, 0], [10**shear, 1]])
    with pytest.raises(ip.ComplexError, match="too extreme for double precision"):
        pm.change_basis(far)


def test_tolerances_are_met_with_proofs():
    for tolerance in (1e-2, 1e-6, 1e-10):
        pm = proved(ORDINARY["L"], tolerance=tolerance)
        assert pm.rigorous
        assert pm.bound <= tolerance


def test_tolerances_that_rounding_forbids_are_not_met():
    with pytest.warns(ip.ToleranceWarning, match="not 1e-16 as wanted"):
        pm = proved(ORDINARY["L"], tolerance=1e-16)
    assert pm.rigorous
    assert pm.bound < 1e-11


def test_spheres_have_nothing_to_prove():
    V = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1], [-1, -1, -1]])
    F = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]
    for degree in (1, 3):
        pm = proved(V, F, degree=degree)
        assert (pm.genus, pm.bound, pm.rigorous) == (0, 0.0, True)
        assert pm.matrix.shape == (0, 0)


def test_results_are_pickled_with_their_proof():
    pm = proved(ORDINARY["L"], degree=2)
    copy = pickle.loads(pickle.dumps(pm))
    assert copy.rigorous
    assert copy.bound == pm.bound
    assert copy.reduced().bound == pm.reduced().bound
    assert not copy.entry_bounds.flags.writeable


def test_entry_bounds_are_rounded_upwards():
    pm = proved(ORDINARY["Bolza"])
    Y = [Fraction(float(y)) for y in np.diag(pm.matrix.imag)]
    for (i, j), bound in np.ndenumerate(pm.entry_bounds):
        assert Fraction(float(bound)) ** 2 >= Fraction(pm.bound) ** 2 * Y[i] * Y[j]


def test_words_and_documents_say_so():
    one, other = proved(ORDINARY["L"]), ip.period_matrix(ORDINARY["L"])
    assert "This is proved." in summary(one, None, None)
    assert "allowance" not in summary(one, None, None)
    assert "This is a theorem, with an allowance for rounding." in summary(other, None, None)
    assert "proved" in repr(one)
    assert "proved" not in repr(other)
    document = json.loads(json.dumps(period_matrix_to_json(one)))
    assert document["rigorous"] is True
    assert document["rounding_allowance"] < 1e-12
    assert period_matrix_to_json(other)["rigorous"] is False


@pytest.mark.parametrize("seed", range(20))
def test_bounds_in_words_are_never_too_small(seed):
    bound = 10.0 ** np.random.default_rng(seed).uniform(-15, 3)
    assert bound <= float(rounded_up(bound)) <= 1.12 * bound
    assert rounded_up(0.0) == "0"
    assert rounded_up(0.0025) == "0.0025"


def test_proofs_need_a_bound():
    with pytest.raises(ValueError, match="extrinsic weights have no bound that could be proved"):
        proved(*noisy_torus(6, 5, 0.1, 0), weights="extrinsic")


def test_energies_without_digits_are_refused(monkeypatch):
    # As if sums were not known at all.
    monkeypatch.setattr(midpoint_radius, "gamma", lambda n: np.inf)
    with pytest.raises(ip.ComplexError, match="nothing can be proved about the period matrix"):
        proved(ORDINARY["L"])


CLOSED = ("3holes.obj", "Csaszar.ply", "bob_small.ply", "eight.off", "fertility.off",
          "kq_surface.obj", "scaffolding.ply", "rocker-arm.obj", "wente_torus02.obj",
          "buckyball.obj", "two-tori.obj", "spot_triangulated.obj", "botijo.obj")  # fmt: skip


@pytest.mark.parametrize("name", CLOSED)
def test_bounds_of_meshes_are_those_with_an_allowance(mesh, name):
    for K in ip.DeltaComplex.from_mesh(*mesh(name)).components():
        one, other = proved(K), ip.period_matrix(K)
        assert one.bound == pytest.approx(other.bound, rel=1e-7)
        assert one.rigorous


@pytest.mark.parametrize("name", ["punctured-torus.obj", "moebius.obj"])
def test_doubles_of_meshes_are_proved_as_well(mesh, name):
    K = ip.double(ip.DeltaComplex.from_mesh(*mesh(name)))
    assert proved(K).bound == pytest.approx(ip.period_matrix(K).bound, rel=1e-7)
