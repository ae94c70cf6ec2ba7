"""Options of the wrong kind get a sentence; numbers of all libraries are numbers."""

import warnings

import numpy as np
import pytest

import igl_periods as ip

SQUARE = [((0, 0), (0, 2)), ((0, 1), (0, 3))]
K = ip.DeltaComplex.from_squares(SQUARE, 2)
PM = ip.period_matrix(K)
POINT = [[0.2 + 1.3j]]
# Neither a number nor a switch nor a sequence of numbers.
WRONG = ["2", b"2", [1], {}, object(), 1j, np.array([2, 2]), "1e-3"]

CALLS = {
    "degree": lambda v: ip.period_matrix(K, degree=v),
    "tolerance": lambda v: ip.period_matrix(K, tolerance=v),
    "weights": lambda v: ip.period_matrix(K, weights=v),
    "delaunay": lambda v: ip.period_matrix(K, delaunay=v),
    "max_unknowns": lambda v: ip.period_matrix(K, tolerance=1.0, max_unknowns=v),
    "max_memory": lambda v: ip.period_matrix(K, max_memory=v),
    "faces": lambda v: ip.period_matrix(np.eye(4), v),
    "n": lambda v: ip.DeltaComplex.from_squares(SQUARE, v),
    "max_genus of a matrix": lambda v: ip.siegel_reduce(POINT, max_genus=v),
    "max_genus": lambda v: PM.reduced(max_genus=v),
    "gamma": lambda v: PM.change_basis(v),
    "gamma of a point": lambda v: ip.siegel_transform(v, POINT),
    "Pi": lambda v: ip.siegel_reduce(v if not isinstance(v, complex) else object()),
    "tolerance of isomorphisms": lambda v: ip.symplectic_isomorphisms(POINT, POINT, v),
    "reversing": lambda v: ip.symplectic_isomorphisms(POINT, POINT, reversing=v),
    "limit": lambda v: ip.symplectic_isomorphisms(POINT, POINT, limit=v),
    "tolerance of distances": lambda v: ip.moduli_distance(POINT, POINT, v),
    "tolerance of groups": lambda v: ip.symplectic_automorphism_group(POINT, v),
    "mesh error": lambda v: ip.identify(POINT, v),
    "genus": lambda v: ip.catalogue(v),
    "cocycles": lambda v: ip.harmonic_forms(K, v),
    "rows": lambda v: list(ip.harmonic_form_blocks(K, rows=v)),
    "bound": lambda v: ip.refined_period_matrix(K, v),
    "largest": lambda v: ip.refined_period_matrix(K, 1.0, largest=v),
    "local": lambda v: ip.refined_period_matrix(K, 1.0, local=v),
    "sizes": lambda v: ip.richardson(lambda n: K, v),
    "a period matrix": lambda v: ip.abel_jacobi(v),
    "a matrix to parametrize": lambda v: ip.parametrize(v, [1]),
    "a matrix with an even form": lambda v: ip.most_even_form(v),
    "a matrix of a double": lambda v: ip.real_structure(v),
    "path": lambda v: ip.load_mesh({} if isinstance(v, str) else v),
    "family": lambda v: ip.richardson(v, (2, 3, 4)),
    "root": lambda v: ip.shortest_loops(K, v),
    "edge lengths": lambda v: ip.shortest_loops(K, 0, v),
    "base": lambda v: ip.abel_jacobi(PM, v),
    "coefficients": lambda v: ip.parametrize(
        PM, {} if isinstance(v, (list, complex, np.ndarray)) else v
    ),
}


@pytest.mark.parametrize("wrong", WRONG, ids=lambda v: f"{type(v).__name__}")
@pytest.mark.parametrize("name", CALLS)
def test_whatever_is_no_such_value_gets_a_sentence(name, wrong):
    # A ValueError of the library's own, never a TypeError or AttributeError from within.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ValueError) as caught:
            CALLS[name](wrong)
    assert "ambiguous" not in str(caught.value)
    assert len(str(caught.value)) > 20


@pytest.mark.parametrize("two", [2, 2.0, np.int8(2), np.uint16(2), np.float32(2), np.array(2)])
def test_numbers_of_all_libraries(two):
    pm = ip.period_matrix(K, degree=two)
    assert pm.bound == ip.period_matrix(K, degree=2).bound
    assert ip.period_matrix(K, tolerance=two).bound < 1
    assert len(ip.symplectic_isomorphisms(POINT, POINT, limit=two)) == 2


@pytest.mark.parametrize(
    ("degree", "message"),
    [
        ("2", "degree = '2': trial functions have degree 1 at least, and it must be an integer, "
              "not the string '2'"),
        (True, "degree = True: .* must be an integer, not True"),
        (2.5, "degree = 2.5: trial functions"),
        (0, "degree = 0: trial functions have degree 1 at least"),
        (10**30, "trial functions have degree 1 at least, 1000 at most"),
    ],
)  # fmt: skip
def test_degrees(degree, message):
    with pytest.raises(ValueError, match=message):
        ip.period_matrix(K, degree=degree)


def test_tolerances():
    with pytest.raises(ValueError, match="tolerance must be a number, not the string '1e-3'"):
        ip.period_matrix(K, tolerance="1e-3")
    with pytest.raises(ValueError, match="tolerance = nan: a bound is always positive"):
        ip.period_matrix(K, tolerance=float("nan"))
    with pytest.raises(ValueError, match="max_unknowns = -1: a limit is not negative"):
        ip.period_matrix(K, tolerance=1.0, max_unknowns=-1)


@pytest.mark.parametrize("big", [2**63, 10**30, -(10**30)])
def test_transformations_beyond_64_bits(big):
    for gamma in ([[1, big], [0, 1]], np.array([[1, big], [0, 1]], dtype=object)):
        for action in (PM.change_basis, lambda g: ip.siegel_transform(g, POINT)):
            with pytest.raises(ValueError, match=f"has entries up to 2\\^63 - 1 .* {abs(big)}"):
                action(gamma)


def test_transformations_of_other_kinds():
    for gamma in ([["1", "0"], ["0", "1"]], [[1.5, 0], [0, 1]], [[1j, 0], [0, 1]]):
        with pytest.raises(ValueError, match="a modular transformation has integer entries"):
            PM.change_basis(gamma)
    assert ip.siegel_transform(np.eye(2), POINT)[0, 0] == POINT[0][0]
    assert ip.siegel_transform(np.eye(2, dtype=np.uint64), POINT)[0, 0] == POINT[0][0]


def test_a_tolerance_that_is_just_too_large_is_shown_with_all_its_digits():
    t = float(np.log(2.0))
    with pytest.raises(ValueError, match=f"a tolerance of {t!r} is too .* log 2 = {t!r}"):
        ip.symplectic_isomorphisms(POINT, POINT, t)
    with pytest.raises(ValueError, match=f"a tolerance of 0.6931472 .* log 2 = {t!r}"):
        ip.symplectic_isomorphisms(POINT, POINT, 0.6931472)


def test_catalogues_without_end():
    with pytest.raises(ValueError, match="genus = 1000000000000000000000000000000: surfaces of"):
        ip.catalogue(10**30)
