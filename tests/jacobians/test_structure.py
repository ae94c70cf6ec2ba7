"""The type of the algebra of endomorphisms."""

import flint
import pytest
from support.enclosed_surfaces import l_shape_matrix
from support.jacobian_points import fifth_roots, quaternionic, random_point, silhol

import igl_periods as ip
from igl_periods.surfaces.exact_matrices import bolza, bring, fermat, klein

TYPES = {
    "Q": (lambda: random_point(2, 1), 1, False),
    "M₂(Q)": (lambda: l_shape_matrix(flint.arb(2).root(3)), 4, False),
    "M₂(Q(i√5))": (lambda: l_shape_matrix((1 + flint.arb(5).sqrt()) / 2), 8, True),
    "M₂(Q(i√2))": (bolza, 8, True),
    "M₃(Q(i√7))": (klein, 18, True),
    "M₃(Q(i))": (fermat, 18, True),
    "M₄(Q)": (bring, 16, False),
    "quaternion algebra of discriminant 6": (
        lambda: quaternionic(flint.acb(0.3, flint.arb.pi())), 4, False,
    ),
    "Q(i) × Q": (
        lambda: flint.acb_mat([[flint.acb(0, 1), 0], [0, flint.acb(0, flint.arb.pi())]]), 3, False,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", TYPES)
def test_types(name):
    make, rank, multiplication = TYPES[name]
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(make())
    assert ring.name == name
    assert ring.rank == ring.algebra.rank == rank
    assert ring.has_complex_multiplication == multiplication


def test_the_fifth_roots_of_unity():
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(fifth_roots())
    (component,) = ring.algebra.components
    assert component.division.kind == "CM field"
    assert component.division.has_complex_multiplication
    assert (component.size, component.dimension) == (1, 2)


def test_fermat_and_silhol_have_the_same_algebra():
    assert ip.endomorphisms(silhol()).name == "M₃(Q(i))"
