"""Exact period matrices of named surfaces, by second routes."""

from itertools import combinations

import numpy as np
import pytest
from support.quadrature_periods import period_matrix as curve_period_matrix

from igl_periods.moduli.equivalence import moduli_distance, symplectic_isomorphisms
from igl_periods.surfaces import lawson_period_matrix
from igl_periods.surfaces.named_surfaces import (
    binomial_period_matrix,
    catalogue,
    polygon_period_matrix,
)

ROOT2, ROOT7 = 2**0.5, 7**0.5


def surface(name: str, genus: int):
    return next(s for s in catalogue(genus) if name in (s.name, *s.aliases))


def symmetric(*rows: list) -> np.ndarray:
    """The symmetric matrix with these rows of its upper triangle."""
    Pi = np.zeros((len(rows), len(rows)), dtype=complex)
    for i, row in enumerate(rows):
        Pi[i, i:] = Pi[i:, i] = row
    return Pi


def test_without_a_genus_all_are_listed():
    assert [s.name for s in catalogue()] == [s.name for g in range(1, 5) for s in catalogue(g)]
    families = ("Lawson", "y^2 = x^")
    assert all(s.name.startswith(families) for g in range(5, 13) for s in catalogue(g))


@pytest.mark.parametrize("genus", range(1, 7))
def test_no_two_entries_are_the_same_surface(genus):
    entries = catalogue(genus)
    assert all(entry.genus == genus == len(entry.matrix) for entry in entries)
    names = [name for entry in entries for name in (entry.name, *entry.aliases)]
    assert len(set(names)) == len(names)
    assert all(entry.source for entry in entries)
    for one, two in combinations(entries, 2):
        found = symplectic_isomorphisms(one.matrix, two.matrix, 1e-3)
        assert found == [], f"{one.name} and {two.name} are the same surface"
        assert found.complete


@pytest.mark.parametrize("genus", range(1, 6))
def test_regular_polygons_by_quadrature(genus):
    """y² = x^{2g+1} − x: branch points 0, ∞ and the roots of unity."""
    points = [0, *np.exp(2j * np.pi * np.arange(2 * genus) / (2 * genus))]
    exact = curve_period_matrix(2, np.array(points))
    assert symplectic_isomorphisms(polygon_period_matrix(genus), exact, 1e-8)


def test_polygons_refused():
    with pytest.raises(ValueError, match="a 4g-gon"):
        polygon_period_matrix(0)


@pytest.mark.parametrize("name", ["golden L", "L(3/2)", "L(3)"])
def test_l_shapes_are_equations(name):
    """Their aliases are equations whose period matrices by quadrature are the same."""
    coefficients = {
        "golden L": [1, 0, 5, 0, 5, 0],
        "L(3/2)": [1, 0, 33 * (4 + 3 * ROOT2) / 8, 0, 33 * (4 + 3 * ROOT2) / 8, 0, 1],
        "L(3)": [135, 0, 161, 0, 48, 0],
    }[name]
    exact = curve_period_matrix(2, np.roots(coefficients))
    assert symplectic_isomorphisms(surface(name, 2).matrix, exact, 1e-8)


@pytest.mark.parametrize("n", range(3, 13))
def test_binomial_curves_by_quadrature(n):
    points = np.exp(2j * np.pi * np.arange(n) / n)
    exact = curve_period_matrix(2, points)
    assert len(exact) == (n - 1) // 2
    assert symplectic_isomorphisms(binomial_period_matrix(n), exact, 1e-8)


@pytest.mark.parametrize(
    ("name", "n", "points", "multiplicities"),
    [
        ("Omega_1", 2, [0, 1, 8 - 4 * 3**0.5, 0.5 + 3**-0.5, 2 * 3**-0.5], None),
        ("Omega_2", 2, [0, 1, -1, 1j, -1j], None),
        ("Omega_3", 2, np.exp(2j * np.pi * np.arange(6) / 6), None),
        ("Fermat quartic", 4, np.exp(2j * np.pi * np.arange(4) / 4), None),
        ("Klein quartic", 7, [0, 1], [1, 2]),
        ("gyroid", 2, np.roots([1, 0, 0, 0, 14, 0, 0, 0, 1]), None),
        ("Lawson xi_{2,2}", 3, np.exp(1j * np.pi * np.arange(6) / 3), [1, 2] * 3),
        ("Lawson xi_{3,2}", 3, np.exp(1j * np.pi * np.arange(8) / 4), [1, 2] * 4),
    ],
)
def test_curves_by_quadrature(name, n, points, multiplicities):
    exact = curve_period_matrix(n, points, multiplicities)
    found = symplectic_isomorphisms(surface(name, len(exact)).matrix, exact, 1e-8)
    assert found, found.verdict


@pytest.mark.parametrize("m", range(1, 6))
def test_lawson_surfaces_are_hyperelliptic_for_k_1(m):
    exact = lawson_period_matrix(m, 1)
    assert symplectic_isomorphisms(binomial_period_matrix(2 * m + 2), exact)
    assert surface(f"Lawson xi_{{{m},1}}", m).matrix.shape == (m, m)


@pytest.mark.parametrize(
    ("name", "published"),
    [
        # abelfunctions, test_homology.py: periods of the Klein and Fermat quartics, recognised.
        (
            "Klein quartic",
            symmetric(
                [(9 + 3j * ROOT7) / 8, (3 + 1j * ROOT7) / 4, (-3 - 1j * ROOT7) / 8],
                [(1 + 1j * ROOT7) / 2, (1 - 1j * ROOT7) / 4],
                [(1 + 3j * ROOT7) / 8],
            ),
        ),
        ("Fermat quartic", symmetric([1 + 1j, -0.5 - 0.5j, 0], [0.5 + 1j, 0.5 - 0.5j], [1j])),
        # flint issue #2017, five digits, recognised.
        (
            "Lawson xi_{3,1}",
            symmetric(
                [(2 + ROOT2) / 4 * 1j, 0.5, (2 - ROOT2) / 4 * 1j], [ROOT2 / 2 * 1j, -0.5], [0]
            )
            + np.diag([0, 0, (2 + ROOT2) / 4 * 1j]),
        ),
        # README of abelfunctions, the curve y³ + 2x³y − x⁷, nine digits.
        (
            "y^2 = x^5 - 1",
            symmetric([-1.30901699 + 0.95105652j, -0.80901699 + 0.58778525j], [-1 + 1.1755705j]),
        ),
    ],
)
def test_published_matrices(name, published):
    entry = surface(name, len(published))
    assert moduli_distance(published, entry.matrix, 1e-7) < 1e-7


def test_tori():
    assert surface("Clifford torus", 1).matrix == [[1j]]
    rho = surface("Fermat cubic", 1).matrix
    assert abs(rho[0, 0] ** 3 + 1) < 1e-15
    # Bobenko, Mercat, Schmies, section 4.2.
    assert abs(surface("Wente torus", 1).matrix[0, 0] - (0.41300 + 0.91073j)) < 1e-4


def test_binomial_curves_start_at_genus_one():
    with pytest.raises(ValueError, match="take n >= 3"):
        binomial_period_matrix(2)
