from fractions import Fraction

import flint
import numpy as np
import pytest
from flint import acb, acb_mat, arb
from support.enclosed_surfaces import (
    exact_matrix,
    generic_genus_two,
    l_shape,
    l_shape_matrix,
    matches,
)

import igl_periods as ip
from igl_periods.enclosures import enclose
from igl_periods.surfaces import flat_torus, regular_map_surface, square_tiled_surface


def surface_named(name):
    return square_tiled_surface(name) if "omega" in name else regular_map_surface(name)


@pytest.mark.parametrize(
    ("name", "digits"),
    [
        ("omega_1", 50),
        ("omega_2", 30),
        ("omega_3", 30),
        ("bolza", 30),
        pytest.param("klein", 30, marks=pytest.mark.slow),
        pytest.param("fermat", 30, marks=pytest.mark.slow),
        pytest.param("omega_2", 50, marks=pytest.mark.slow),
        pytest.param("omega_3", 50, marks=pytest.mark.slow),
        pytest.param("omega_1", 100, marks=pytest.mark.slow),
        pytest.param("omega_1", 200, marks=pytest.mark.slow),
    ],
)
def test_balls_contain_exact_values(name, digits):
    e = enclose(surface_named(name), digits=digits)
    with flint.ctx.workprec(4 * digits + 200):
        exact = exact_matrix(name)
    assert e.digits >= digits
    assert matches(e, exact)


@pytest.mark.parametrize("arm", [1.25, 2.0, 1.03125])
def test_l_shapes_in_closed_form(arm):
    e = enclose(l_shape(arm), digits=20)
    with flint.ctx.workprec(400):
        exact = l_shape_matrix(arb(arm))
    assert e.digits >= 20
    assert matches(e, exact)


@pytest.mark.parametrize("tau", [0.25 + 1.5j, 0.375 + 0.875j, -0.46875 + 3j])
def test_flat_tori(tau):
    e = enclose(flat_torus(tau, 1, 2), digits=30)
    assert e.digits >= 30
    assert matches(e, acb_mat([[acb(tau)]]))


def test_two_triangulations_of_a_generic_surface_overlap():
    K = generic_genus_two()
    with_vertex = enclose(_with_centre(K), digits=20)
    other = enclose(K, digits=20)
    found = ip.symplectic_isomorphisms(
        *(e.to_period_matrix().matrix for e in (with_vertex, other)), 1e-9
    )
    assert len(found) == 2
    assert any(with_vertex.change_basis(gamma).overlaps(other) for gamma in found)


def _with_centre(K):
    """The same surface with more vertices: every length is halved exactly."""
    from igl_periods.complexes import split
    from igl_periods.topology import cochains_and_basis

    return split(K, cochains_and_basis(K)[0])[0]


def test_few_digits_agree_with_many():
    K = generic_genus_two()
    few, many = enclose(K, digits=8), enclose(K, digits=20)
    assert 8 <= few.digits < 16
    assert few.contains(many.matrix)


def test_integers_and_fractions_are_exact():
    # A torus of revolution would not close with fractions; a box with a hole does.
    V, F = ip.surfaces.voxel_surface(_ring())
    e = enclose(V.astype(int), F, digits=8)
    third = [[Fraction(int(x)) / 3 for x in row] for row in V]
    f = enclose(third, F, digits=8)
    assert e.overlaps(f)


def _ring():
    ring = np.ones((3, 3, 1), dtype=bool)
    ring[1, 1, 0] = False
    return ring


def test_limits_give_the_best_result_and_a_warning():
    with pytest.warns(ip.ToleranceWarning, match="digits are proved, 60 were asked for"):
        e = enclose(square_tiled_surface("omega_1"), digits=60, max_seconds=0.2)
    with flint.ctx.workprec(600):
        exact = acb_mat([[acb(0, 1.5), acb(-0.5)], [acb(-0.5), acb(0, 1.5)]])
    assert e.digits < 60
    assert e.reduced().contains(exact)


def test_no_memory_is_an_error():
    with pytest.raises(ip.MemoryLimitError, match="stars and faces take about"):
        enclose(square_tiled_surface("omega_1"), max_memory=1e3)


@pytest.mark.parametrize("digits", [0, -3, 2.5, 10**6, "30"])
def test_absurd_digits_are_refused(digits):
    with pytest.raises(ValueError, match="a whole number from 1 to 1000"):
        enclose(square_tiled_surface("omega_1"), digits=digits)


def test_limits_are_positive():
    with pytest.raises(ValueError, match="max_seconds = -1"):
        enclose(square_tiled_surface("omega_1"), max_seconds=-1)


def test_open_surfaces_are_refused():
    with pytest.raises(ip.ComplexError, match="not closed"):
        enclose([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


def test_precision_of_the_caller_is_left_alone():
    before = flint.ctx.prec
    enclose(flat_torus(1j, 1, 1), digits=20)
    assert flint.ctx.prec == before
