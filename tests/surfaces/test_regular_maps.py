"""Regular maps: combinatorics, exact period matrices by two routes, convergence."""

import numpy as np
import pytest
from flint import acb
from support import quadrature_periods
from support.lazy_equivalence import in_basis_of, isomorphisms

import igl_periods as ip
from igl_periods.complexes.weights import cone_angles
from igl_periods.siegel.reduction import siegel_reduce
from igl_periods.surfaces import regular_map, regular_map_period_matrix, regular_map_surface

# Faces enumerated on cosets of vertex stabilisers in PSL(2, 7) and in the group of order 96,
# independently of the permutations in the library: closed, simple, oriented, χ = −4.
KLEIN_FACES = """
0,1,2 1,0,7 2,1,11 0,2,3 3,2,14 0,3,4 4,3,17 0,4,5 5,4,19 0,5,6 6,5,20 0,6,7 7,6,21 1,7,8 8,7,15
1,8,9 9,8,20 1,9,10 10,9,22 1,10,11 11,10,17 2,11,12 12,11,21 2,12,13 13,12,22 2,13,14 14,13,19
3,14,15 15,14,8 3,15,16 16,15,22 3,16,17 17,16,20 4,17,10 4,10,18 18,10,22 4,18,19 19,18,21 5,19,13
5,13,9 9,13,22 5,9,20 6,20,16 6,16,12 12,16,22 6,12,21 7,21,18 7,18,15 15,18,22 19,21,23 23,21,11
19,23,14 14,23,8 8,23,20 20,23,17 17,23,11"""


DYCK_FACES = """
0,1,2 1,0,8 2,1,11 0,2,3 3,2,9 0,3,4 4,3,11 0,4,5 5,4,9 0,5,6 6,5,11 0,6,7 7,6,9 0,7,8 8,7,11
1,8,9 9,8,3 1,9,6 1,6,10 10,6,3 1,10,4 4,10,7 1,4,11 2,11,7 2,7,10 2,10,5 5,10,8 2,5,9 8,10,3
5,8,11 6,11,3 4,7,9"""


# Klein: z ↦ 1 − 1/z and z ↦ −1/z on P¹(F₇); Bolza: [[0, 1], [2, 2]] and diag(1, 2) on F₃² ∖ 0.
GENERATORS = {
    "klein": ([7, 0, 4, 3, 6, 5, 2, 1], [7, 6, 3, 2, 5, 4, 1, 0]),
    "bolza": ([4, 6, 1, 3, 5, 0, 2, 7], [1, 0, 2, 4, 3, 5, 7, 6]),
}


def faces(text):
    return np.array([[int(v) for v in face.split(",")] for face in text.split()])


@pytest.mark.parametrize(
    ("name", "genus", "sides", "valence", "vertices"),
    [
        ("klein", 3, 3, 7, {1: 24, 2: 108, 4: 444, 8: 1788}),
        ("fermat", 3, 3, 8, {1: 12, 2: 60, 4: 252, 8: 1020}),
        ("bolza", 2, 3, 8, {1: 6, 2: 30, 4: 126, 8: 510, 16: 2046}),
        ("bring", 4, 4, 5, {1: 24, 2: 114, 4: 474}),
        ("schwarz_p", 3, 4, 6, {1: 8, 2: 44, 4: 188, 8: 764}),
    ],
)
def test_combinatorics(name, genus, sides, valence, vertices):
    for n, expected in vertices.items():
        K = regular_map_surface(name, n)
        assert (K.n_vertices, K.genus) == (expected, genus)
    angle = valence * np.pi * (1 - 2 / sides)
    assert cone_angles(regular_map_surface(name)) == pytest.approx(angle)
    assert np.abs(regular_map_surface(name).lengths.min() - 1) < 1e-15


@pytest.mark.parametrize(("name", "text"), [("klein", KLEIN_FACES), ("fermat", DYCK_FACES)])
def test_permutations_and_face_lists_describe_the_same_map(name, text):
    by_group = regular_map_surface(name)
    by_list = ip.DeltaComplex.from_lengths(np.ones((by_group.n_faces, 3)), faces(text))
    assert extends_to_isomorphism(by_group.twin.ravel(), by_list.twin.ravel())


def extends_to_isomorphism(twin, other):
    """Whether half-edge 0 to half-edge 0, carried along sides and gluings, is an isomorphism."""
    image, found = {0: 0}, [0]
    for h in found:
        k = image[h]
        for there, here in ((3 * (h // 3) + (h + 1) % 3, 3 * (k // 3) + (k + 1) % 3),
                            (int(twin[h]), int(other[k]))):  # fmt: skip
            if image.setdefault(there, here) != here:
                return False
            if len(image) > len(found):
                found.append(there)
    return len(set(image.values())) == len(twin) == len(other)


@pytest.mark.parametrize("name", ["klein", "fermat", "bolza"])
@pytest.mark.parametrize("n", [1, 2, 4])
def test_symplectic_mean_is_exact_where_symmetries_determine_the_surface(name, n):
    pm, exact = ip.period_matrix(regular_map_surface(name, n)), regular_map_period_matrix(name)
    assert pm.bound > 5e-3
    size = 2 if name == "bolza" else 1
    assert np.abs(in_basis_of(exact, pm.matrix, 1e-9, size) - exact).max() < 1e-13


@pytest.mark.parametrize(
    ("name", "errors"),
    [
        ("schwarz_p", {2: "1.15e-02", 4: "2.65e-03", 8: "6.43e-04"}),
        ("bring", {2: "9.22e-03", 4: "2.13e-03"}),
    ],
)
def test_symplectic_mean_converges_with_order_two_where_they_do_not(name, errors):
    exact, computed = regular_map_period_matrix(name), {}
    for n in errors:
        pm = ip.period_matrix(regular_map_surface(name, n))
        Pi = in_basis_of(exact, pm.matrix, 0.15)
        computed[n] = f"{np.abs(Pi - exact).max():.2e}"
        root = np.linalg.cholesky(np.linalg.inv(Pi.imag))
        assert np.linalg.norm(root.T @ (Pi - exact) @ root, 2) <= pm.bound
    assert computed == errors


@pytest.mark.parametrize(
    ("name", "n", "points", "multiplicities"),
    [
        ("klein", 7, [0, 1], [1, 2]),  # y⁷ = x (x − 1)²
        ("fermat", 4, [1, 1j, -1, -1j], None),  # y⁴ = x⁴ − 1
        ("bolza", 2, [0, 1, 1j, -1, -1j], None),
        ("schwarz_p", 2, np.roots([1, 0, 0, 0, 14, 0, 0, 0, 1]), None),
    ],
)
def test_exact_matrices_are_the_periods_of_the_curves(name, n, points, multiplicities):
    exact = regular_map_period_matrix(name)
    by_quadrature = quadrature_periods.period_matrix(n, points, multiplicities)
    size = 2 if len(exact) < 3 else 1
    assert np.abs(in_basis_of(exact, by_quadrature, 1e-9, size) - exact).max() < 2e-13


@pytest.mark.parametrize(
    ("name", "order", "size"),
    [("klein", 336, 1), ("fermat", 192, 2), ("bolza", 48, 2), ("schwarz_p", 48, 1)],
)
def test_numbers_of_automorphisms(name, order, size):
    # |Aut| if the curve is hyperelliptic, else 2 |Aut|: −1 is not one of the curve then.
    reduced = siegel_reduce(regular_map_period_matrix(name)).matrix
    assert sum(1 for _ in isomorphisms(reduced, reduced, 1e-9, size)) == order


def test_bring_has_the_moduli_of_its_elliptic_quotients():
    # The entries are multiples of τ₀ with j(τ₀) = −29³ 5 / 2⁵ and j(5 τ₀) = −25 / 2 (Riera,
    # Rodríguez 1992; Braden, Northover 2012).
    tau = regular_map_period_matrix("bring")[0, 1]
    j, j5 = (complex(acb(t.real, t.imag).modular_j()) for t in (tau, 5 * tau))
    assert j == pytest.approx(-(29**3) * 5 / 2**5, rel=1e-12)
    assert j5 == pytest.approx(-25 / 2, rel=1e-12)


def test_pentagons_are_divided_about_their_centres():
    # The dodecahedron {5, 3}: A₅ with r = (0 1 2 3 4) and t = (0 1)(2 3).
    dodecahedron = regular_map([1, 2, 3, 4, 0], [1, 0, 3, 2, 4])
    assert (dodecahedron.n_faces, dodecahedron.genus) == (60, 0)
    counts = np.unique(np.round(cone_angles(dodecahedron) / np.pi, 9), return_counts=True)
    assert counts[0] == pytest.approx([1.8, 2.0])
    assert counts[1].tolist() == [20, 12]


@pytest.mark.parametrize(("name", "faces", "sides"), [("klein", 24, 7), ("bolza", 6, 8)])
@pytest.mark.parametrize("n", [1, 3])
def test_dual_maps_have_the_same_period_matrix(name, faces, sides, n):
    # Vertices become faces; the group and the conformal structure are the same.  Heptagons and
    # octagons are divided about their centres.
    r, t = (np.array(p) for p in GENERATORS[name])
    dual, exact = regular_map(r[t], t, n), regular_map_period_matrix(name)
    assert dual.n_faces == faces * sides * n * n
    Pi = ip.period_matrix(dual).matrix
    size = 2 if name == "bolza" else 1
    assert np.abs(in_basis_of(exact, Pi, 1e-9, size) - exact).max() < 1e-13


def test_wrong_maps_are_refused():
    with pytest.raises(ip.ComplexError, match="there is no regular map 'macbeath'"):
        regular_map_surface("macbeath")
    with pytest.raises(ip.ComplexError, match="there is no regular map"):
        regular_map_period_matrix("")
    with pytest.raises(ip.ComplexError, match="rotation is not a permutation"):
        regular_map([1, 2, 2], [1, 0, 2])
    with pytest.raises(ip.ComplexError, match="rotation permutes 3 points and flip permutes 4"):
        regular_map([1, 2, 0], [1, 0, 2, 3])
    with pytest.raises(ip.ComplexError, match="is not an involution"):
        regular_map([1, 2, 0, 3], [1, 2, 3, 0])
    with pytest.raises(ip.ComplexError, match="is not an involution"):
        regular_map([1, 2, 0], [0, 1, 2])
    with pytest.raises(ip.ComplexError, match="has order 2: a face has at least 3 sides"):
        regular_map([1, 0, 2], [0, 2, 1])
    with pytest.raises(ip.ComplexError, match="n >= 1"):
        regular_map_surface("klein", 0)
    with pytest.raises(ip.ComplexError, match="n >= 1"):
        regular_map_surface("bring", 0)
