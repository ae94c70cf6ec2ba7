"""The factors of a Jacobian."""

import pickle

import flint
import numpy as np
import pytest
from flint import acb, arb
from support.enclosed_surfaces import l_shape_matrix
from support.jacobian_points import fifth_roots, random_point, silhol

import igl_periods as ip
from igl_periods.siegel import siegel_reduce
from igl_periods.surfaces.exact_matrices import bolza, bring, fermat, klein

ARMS = {
    "5/4": lambda: arb(5) / 4,
    "3/2": lambda: arb(3) / 2,
    "√2": lambda: arb(2).sqrt(),
    "golden": lambda: (1 + arb(5).sqrt()) / 2,
    "2": lambda: arb(2),
    "3": lambda: arb(3),
    "∛2": lambda: arb(2).root(3),
    "π": lambda: arb.pi(),
}


@pytest.mark.parametrize("name", ARMS)
def test_every_l_splits_into_two_curves_with_the_tau_that_is_foretold(name):
    """J(L(λ)) ~ E², τ(E) = i(2λ − 1): isogenous to both factors, by an isogeny of degree 1 or 2."""
    with flint.ctx.workdps(50):
        arm = ARMS[name]()
        factors = ip.jacobian_factors(l_shape_matrix(arm))
        assert str(factors) == "E²"
        assert factors.ring.rank in (4, 8)
        foretold = acb(0, 2 * arm - 1)
        isogenous = [foretold, 2 * foretold, foretold / 2, (1 + foretold) / 2]
        values = [
            siegel_reduce(flint.acb_mat([[tau]])).matrix[0, 0].modular_j() for tau in isogenous
        ]
        for factor in factors.elliptic_curves:
            assert any(factor.j.overlaps(value) for value in values)
        multiplication = factors.elliptic_curves[0].cm_discriminant
    assert (multiplication is not None) == (factors.ring.rank == 8)
    assert (factors.ring.rank == 8) == (name not in ("√2", "∛2", "π"))


CURVES = {
    "Bolza": (bolza, "E²", ["8000"] * 2, -8),
    "Klein": (klein, "E³", ["-3375"] * 3, -7),
    "Fermat": (fermat, "E³", ["1728"] * 3, -4),
    "Silhol": (silhol, "E³", ["1728"] * 3, -4),
    "Bring": (bring, "E⁴", ["-121945/32", "-25/2", "-25/2", "-25/2"], None),
}


@pytest.mark.parametrize("name", CURVES)
def test_elliptic_factors_of_named_curves(name):
    make, text, values, discriminant = CURVES[name]
    with flint.ctx.workdps(50):
        factors = ip.jacobian_factors(make())
    assert str(factors) == text
    assert sorted(str(factor.exact_j) for factor in factors.elliptic_curves) == sorted(values)
    assert {factor.cm_discriminant for factor in factors.elliptic_curves} == {discriminant}
    for factor in factors.elliptic_curves:
        assert factor.j.overlaps(factor.exact_j.ball(200))


def test_the_polarisations_multiply_up():
    """The product of the factors is mapped to the Jacobian by an isogeny of degree ∏ d."""
    with flint.ctx.workdps(50):
        factors = ip.jacobian_factors(klein()).elliptic_curves
    lattice = np.hstack([factor.subvariety.lattice for factor in factors])
    degree = abs(int(flint.fmpz_mat(lattice.tolist()).det()))
    assert degree == np.prod([factor.polarisation[0] for factor in factors])


def test_a_class_polynomial():
    """λ = 3: τ = (1 + 5i)/2 has discriminant −100, of class number 2."""
    with flint.ctx.workdps(50):
        factor = ip.jacobian_factors(l_shape_matrix(arb(3))).elliptic_curves[0]
    assert factor.cm_discriminant == -100
    assert str(factor.exact_j) == "22015749613248 - 9845745509376√5"
    assert "CM -100" in repr(factor)


def test_products_of_different_factors():
    tau = acb(0, arb.pi())
    with flint.ctx.workdps(40):
        factors = ip.jacobian_factors(flint.acb_mat([[acb(0, 1), 0], [0, tau]]))
    assert str(factors) == "E1 × E2"
    assert len(factors) == 2
    assert [part.multiplicity for part in factors] == [1, 1]
    assert factors[1][0].exact_j is None
    assert factors[:1][0].is_simple
    assert repr(factors[0]).endswith("Q(i))")
    assert "recognised, not proved" in factors._repr_html_()


def test_abelian_surfaces():
    """A simple one is its own factor, with the invariants of y² = x⁵ − 1: all 0."""
    with flint.ctx.workdps(50):
        factors = ip.jacobian_factors(fifth_roots())
    (part,) = factors
    assert str(factors) == "A"
    assert part.is_simple
    factor = part[0]
    assert factor.polarisation == (1, 1)
    assert factor.is_principal
    assert np.abs(factor.igusa_invariants).max() < 1e-8
    assert "abelian surface" in repr(factor)
    with pytest.raises(ValueError, match="j is of elliptic curves"):
        _ = factor.j
    with pytest.raises(ValueError, match="τ is of elliptic curves"):
        _ = factor.tau


def test_a_curve_times_a_surface():
    """In a product of genus 3 in another marking both factors are found, with their types."""
    surface, curve = fifth_roots(), acb(0, arb(2).root(3))
    Pi = flint.acb_mat(3, 3)
    for i in range(2):
        for j in range(2):
            Pi[i, j] = surface[i, j]
    Pi[2, 2] = curve
    with flint.ctx.workdps(50):
        factors = ip.jacobian_factors(Pi)
    assert sorted(part.dimension for part in factors) == [1, 2]
    assert sorted(part[0].polarisation for part in factors) == [(1,), (1, 1)]
    assert sorted(str(factors).split(" × ")) == ["A", "E"]


def test_a_generic_surface_is_simple():
    with flint.ctx.workdps(50):
        factors = ip.jacobian_factors(random_point(3, 4))
    assert str(factors) == "B"
    assert factors.ring.name == "Q"
    assert factors[0][0].igusa_invariants is None
    assert "dimension 3" in repr(factors)


def test_a_ring_that_is_known_is_used():
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(bolza())
    assert ip.jacobian_factors(ring).ring is ring


def test_results_pickle():
    with flint.ctx.workdps(50):
        factors = ip.jacobian_factors(bolza())
    assert str(factors.elliptic_curves[0].exact_j) == "8000"
    again = pickle.loads(pickle.dumps(factors))
    assert str(again) == "E²"
    assert again.elliptic_curves[0].j.overlaps(factors.elliptic_curves[0].j)
