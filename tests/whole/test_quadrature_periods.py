"""The reference quadrature of the tests, on curves whose period matrices are known."""

import numpy as np
import pytest
from support import quadrature_periods
from support.brute_force_equivalence import isomorphisms

from igl_periods.surfaces import regular_map_period_matrix, square_tiled_period_matrix


def unity(n):
    return np.exp(2j * np.pi * np.arange(n) / n)


C5, S5 = np.cos(2 * np.pi / 5), np.sin(2 * np.pi / 5)


# y² = x⁵ − 1; entries in Q(ζ₅), after abelfunctions' y³ + 2x³y − x⁷ = 0, an isomorphic curve.
X5 = np.array([[2 * np.sin(np.pi / 5) * 1j, C5 - 0.5 - np.sin(np.pi / 5) * 1j],
               [C5 - 0.5 - np.sin(np.pi / 5) * 1j, -C5 + S5 * 1j]])  # fmt: skip


# y² = x⁵ + x⁴ + x³ − x + 4, from the tests of Hecke (RieSrf).
HECKE_OFF_DIAGONAL = 0.37968242378136137666 + 0.01931936639996602903j


HECKE = np.array([
    [0.5113438425838405028 + 0.3793845307485294315j, HECKE_OFF_DIAGONAL],
    [HECKE_OFF_DIAGONAL, 0.5515666804208422259 + 0.7989131245853492630j],
])  # fmt: skip


# y² = x⁸ − 1, Lawson's ξ_{3,1}; isomorphic to the matrix in FLINT's issue 2017.
S = np.sqrt(2)


X8 = 0.5j * np.array([[1 + S, -1, 1 - S], [-1, 1 + S, -1], [1 - S, -1, 1 + S]])


@pytest.mark.parametrize(
    ("n", "e", "m", "exact", "n_isomorphisms"),
    [
        pytest.param(2, -unity(3), None, [[0.5 + np.sqrt(0.75) * 1j]], 6, id="x^3+1"),
        pytest.param(2, unity(6), None, square_tiled_period_matrix("omega_3"), 24, id="x^6-1"),
        pytest.param(
            2, [0, *unity(4)], None, square_tiled_period_matrix("omega_2"), 48, id="x^5-x"
        ),
        pytest.param(2, unity(5), None, X5, 10, id="x^5-1"),
        pytest.param(2, np.roots([1, 1, 1, 0, -1, 4]), None, HECKE, 2, id="Hecke"),
        pytest.param(2, unity(8), None, X8, 32, id="x^8-1"),
        pytest.param(
            2,
            np.roots([1, 0, 0, 0, 14, 0, 0, 0, 1]),
            None,
            regular_map_period_matrix("schwarz_p"),
            48,
            id="Schwarz P",
        ),
    ],
)
def test_quadrature_gives_known_period_matrices(n, e, m, exact, n_isomorphisms):
    Pi = quadrature_periods.period_matrix(n, e, m)
    assert len(isomorphisms(Pi, np.asarray(exact), 1e-11)) == n_isomorphisms


def test_quadrature_does_not_depend_on_the_number_of_nodes(monkeypatch):
    e = np.array([0.3 - 0.2j, 1.1 + 0.7j, -0.8 + 0.1j, 0.2 - 1.3j, -0.4 + 1.2j])
    matrices = []
    for nodes in (100, 140):
        monkeypatch.setattr(quadrature_periods, "NODES", nodes)
        quadrature_periods.gauss_jacobi.cache_clear()
        matrices.append(quadrature_periods.period_matrix(3, e, [1, 2, 1, 1, 2]))
    quadrature_periods.gauss_jacobi.cache_clear()
    assert np.abs(matrices[0] - matrices[1]).max() < 1e-12


def test_affine_maps_of_the_curve_do_not_matter():
    e = np.array([0.3 - 0.2j, 1.1 + 0.7j, -0.8 + 0.1j, 0.2 - 1.3j, -0.4 + 1.2j])
    Pi = quadrature_periods.period_matrix(2, e)
    moved = quadrature_periods.period_matrix(2, (2 - 3j) * e + 0.4)
    assert len(isomorphisms(moved, Pi, 1e-11)) == 2
    # A Möbius transformation that takes a branch point to ∞.
    inverted = quadrature_periods.period_matrix(2, [0, *(1 / (e[1:] - e[0]))])
    assert len(isomorphisms(inverted, Pi, 1e-11)) == 2
    assert not isomorphisms(-Pi.conj(), Pi, 1e-3)
