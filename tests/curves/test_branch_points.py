"""Branch points from theta constants against those of equations."""

import flint
import pytest
from support.curve_periods import l_shape_matrix, real_branch_points_matrix

from igl_periods import siegel_reduce, surfaces
from igl_periods.curves.binary_forms import form_of_points, transvectant
from igl_periods.curves.branch_points import branch_points, number_vanishing, vanishing_even
from igl_periods.curves.weighted_points import same_point
from igl_periods.errors import CurveError
from igl_periods.surfaces import exact_matrices


def theta_table(Pi):
    reduced = siegel_reduce(Pi).matrix
    size = 2 ** reduced.nrows()
    return flint.acb_mat(size, size, reduced.theta(flint.acb_mat(reduced.nrows(), 1)).entries())


def invariants(f):
    """Of degrees 2, 4, 6: (f, f)_n, and those of the covariants (f, f)_{n−4} and (f, f)_{n−2}."""
    n = len(f) - 1
    i, j = transvectant(f, f, n - 2), transvectant(f, f, n - 4 if n % 4 == 0 else n - 2)
    h = transvectant(i, i, 2)
    return [
        transvectant(f, f, n)[0],
        transvectant(i, i, 4)[0],
        transvectant(i, h, 4)[0],
        transvectant(j, j, len(j) - 1)[0],
    ]


@pytest.mark.parametrize(
    "points",
    [
        (-3, -1, 0, 2, 5),
        (-4, -2, -1, 1, 3, 4, 7),
        (0, 1, 3, 4, 6, 9, 10, 12, 15),
    ],
)
def test_those_of_an_equation_come_back_up_to_moebius_transformations(points):
    flint.ctx.dps = 50
    found = form_of_points(branch_points(theta_table(real_branch_points_matrix(points))))
    exact = [(flint.acb(p), flint.acb(1)) for p in points] + [(flint.acb(1), flint.acb(0))]
    assert same_point(invariants(found), invariants(form_of_points(exact)), (2, 4, 6, 4))


@pytest.mark.slow
def test_genus_five():
    flint.ctx.dps = 30
    points = (0, 1, 2, 4, 5, 7, 9, 10, 13, 14, 16)
    found = form_of_points(branch_points(theta_table(real_branch_points_matrix(points))))
    exact = [(flint.acb(p), flint.acb(1)) for p in points] + [(flint.acb(1), flint.acb(0))]
    assert same_point(invariants(found), invariants(form_of_points(exact)), (2, 4, 6, 4))


def test_the_first_three_are_one_zero_and_infinity():
    flint.ctx.dps = 40
    points = branch_points(theta_table(l_shape_matrix(flint.arb(2))))
    assert [(complex(x), complex(z)) for x, z in points[:3]] == [(1, 1), (0, 1), (1, 0)]
    assert len(points) == 6


@pytest.mark.parametrize(("genus", "number"), [(2, 0), (3, 1), (4, 10), (5, 66)])
def test_numbers_of_vanishing_theta_constants(genus, number):
    assert number_vanishing(genus) == number


def test_a_plane_quartic_has_none_and_is_refused():
    flint.ctx.dps = 40
    table = theta_table(exact_matrices.klein())
    assert vanishing_even(table) == []
    with pytest.raises(CurveError, match="0 even theta constants vanish, and 1 do"):
        branch_points(table)


def test_named_surfaces_of_genus_four():
    flint.ctx.dps = 40
    bring, *_ = (s for s in surfaces.catalogue(4) if s.name == "Bring curve")
    with pytest.raises(CurveError, match="10 do on a hyperelliptic"):
        branch_points(theta_table(bring.matrix_in_balls(40)))
