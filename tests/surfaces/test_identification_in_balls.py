"""Named surfaces and period matrices that are known in balls."""

import flint
import pytest
from support.points_in_balls import with_radius

import igl_periods as ip


@pytest.mark.parametrize(
    ("genus", "index"), [(1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (2, 3), (3, 0), (3, 1), (4, 0)]
)
def test_exact_matrices_are_consistent_with_themselves_alone(genus, index):
    surface = ip.catalogue(genus)[index]
    found = ip.identify(surface.matrix_in_balls(40))
    assert found[0].surface.name == surface.name
    assert found[0].digits >= 25
    assert f"consistent to {found[0].digits} digits, in balls" in found[0].claim
    assert "does not prove it" in found[0].claim
    assert all("proved to be another one" in match.claim for match in found[1:])


def test_a_difference_in_the_thirtieth_digit_is_a_proof():
    with flint.ctx.workprec(300):
        near = flint.acb_mat([[flint.acb(flint.arb(10) ** -30, 1)]])
    (match,) = ip.identify(near)
    assert match.surface.name == "square torus"
    assert match.digits is None
    assert match.distance == pytest.approx(1e-30)
    assert match.claim.endswith("in balls, the polyhedral surface is proved to be another one")
    stated = ip.identify(near, tolerance=0.01)[0].claim
    assert "consistent with the stated error of the mesh (0.01)" in stated
    assert stated.endswith("in balls, the polyhedral surface is proved to be another one")


def test_surfaces_without_a_formula_are_compared_in_floats():
    wente = ip.catalogue(1)[2]
    (match,) = [
        m for m in ip.identify(with_radius(wente.matrix, 20)) if m.surface.name == wente.name
    ]
    assert match.digits is None
    assert "consistent with the certificate" in match.claim
