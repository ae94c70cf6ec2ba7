"""Quartics in coordinates with few terms."""

import flint
import pytest
from support.curve_periods import silhol_matrix

from igl_periods import siegel_reduce, symplectic_automorphism_group, symplectic_isomorphisms
from igl_periods.curves.plane_quartics import bitangents, plane_quartic
from igl_periods.curves.quartic_models import in_bitangents, model_of_quartic
from igl_periods.curves.ternary_forms import applied, transformed
from igl_periods.surfaces import exact_matrices


def found(matrix):
    Pi = siegel_reduce(matrix).matrix
    F = plane_quartic(Pi)
    return F, model_of_quartic(F, Pi, list(symplectic_automorphism_group(Pi)), 2)


def test_klein_quartic():
    flint.ctx.dps = 40
    F, model = found(exact_matrices.klein())
    assert sorted(model.numbers) in (
        [(0, 3, 1), (1, 0, 3), (3, 1, 0)],
        [(0, 1, 3), (1, 3, 0), (3, 0, 1)],
    )
    assert {str(x) for x in model.numbers.values()} == {"1"}
    # The change of coordinates does what it says.
    moved = transformed(F, model.change.tolist())
    scale = moved[max(model.numbers)]
    for e, c in moved.items():
        assert (c / scale - (1 if e in model.numbers else 0)).contains(0)


@pytest.mark.parametrize("matrix", [exact_matrices.fermat, silhol_matrix])
def test_fermat_quartic_and_silhols_surface_are_the_same(matrix):
    flint.ctx.dps = 40
    _, model = found(matrix())
    assert sorted(model.numbers) == [(0, 0, 4), (0, 4, 0), (4, 0, 0)]
    assert {str(x) for x in model.numbers.values()} == {"1"}
    assert len(symplectic_isomorphisms(matrix(), exact_matrices.fermat())) == 192


def test_bitangents_as_coordinates():
    """On x = 0, y = 0, z = 0 the quartic is a square."""
    flint.ctx.dps = 30
    Pi = siegel_reduce(exact_matrices.klein()).matrix
    G = in_bitangents(plane_quartic(Pi), bitangents(Pi))
    for variable in range(3):
        a, b, c, d, e = _without(G, variable)
        assert (b**3 - 4 * a * b * c + 8 * a**2 * d).contains(0)
        assert ((4 * a * c - b**2) ** 2 - 64 * a**3 * e).contains(0)
    assert applied({(4, 0, 0): 1}, G)


def test_bitangents_that_are_not_known():
    wide = flint.acb(flint.arb(0, 1), flint.arb(0, 1))
    lines = [
        [flint.acb(i + 1) + wide, flint.acb(i * i) + wide, flint.acb(1) + wide] for i in range(5)
    ]
    assert in_bitangents({(4, 0, 0): flint.acb(1)}, lines) is None


def _without(G, variable):
    kept = [i for i in range(3) if i != variable]
    coefficients = [flint.acb(0)] * 5
    for e, c in G.items():
        if e[variable] == 0:
            coefficients[e[kept[1]]] = c
    return coefficients
