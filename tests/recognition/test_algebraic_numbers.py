"""Minimal polynomials and the evidence for them."""

import math
import random

import flint
import pytest

from igl_periods.recognition import AlgebraicNumber, recognise_number, reduced_relations, root_near

KNOWN = {
    "golden": (lambda: flint.acb((1 + flint.arb(5).sqrt()) / 2), (-1, -1, 1)),
    "cube root": (lambda: flint.acb(1 + flint.arb(2).root(3)), (-3, 3, -3, 1)),
    "biquadratic": (
        lambda: flint.acb(flint.arb(2).sqrt() + flint.arb(3).sqrt()),
        (1, 0, -10, 0, 1),
    ),
    "fifth root of unity": (lambda: flint.acb.exp_pi_i(flint.acb(2) / 5), (1, 1, 1, 1, 1)),
    "complex": (lambda: (1 + flint.acb(-7).sqrt()) / 4, (1, -1, 2)),
    "imaginary": (lambda: flint.acb(0, flint.arb(2).root(3)), (4, 0, 0, 0, 0, 0, 1)),
    "tenth root": (lambda: flint.acb(flint.arb(2).root(10)), (-2, *[0] * 9, 1)),
    "large": (lambda: flint.acb(10**6 * flint.arb(5).sqrt()), (-5 * 10**12, 0, 1)),
    "small": (lambda: flint.acb(flint.arb(5).sqrt() / 10**6), (-1, 0, 2 * 10**11)),
    "degree 9, far from 1": (
        lambda: root_near([53, 66, -91, -7, -6, 77, -70, -42, 96, 4], -24.3996, 180),
        (53, 66, -91, -7, -6, 77, -70, -42, 96, 4),
    ),
    "fraction": (lambda: flint.acb(-(29**3) * 5) / 32, (29**3 * 5, 32)),
}


@pytest.mark.parametrize("name", KNOWN)
def test_the_minimal_polynomial_is_found_and_its_root_contains_the_number(name):
    make, polynomial = KNOWN[name]
    with flint.ctx.workdps(50):
        x = recognise_number(make())
        assert x.polynomial == polynomial
        assert x.evidence.left_over > 20
        with flint.ctx.workdps(200):
            assert x.ball(650).overlaps(make())


@pytest.mark.parametrize("digits", [15, 30, 50])
@pytest.mark.parametrize("name", ["pi", "e", "log 2", "gamma(1/4)"])
def test_transcendental_numbers_stay_unrecognised(name, digits):
    with flint.ctx.workdps(digits):
        z = {
            "pi": flint.arb.pi(),
            "e": flint.arb(1).exp(),
            "log 2": flint.arb(2).log(),
            "gamma(1/4)": (flint.arb(1) / 4).gamma(),
        }[name]
        assert recognise_number(flint.acb(z), degree=10) is None
        assert recognise_number(flint.acb(0, z), degree=10) is None
        assert recognise_number(flint.acb(z.sqrt(), z), degree=10) is None


@pytest.mark.parametrize("digits", [30, 50])
def test_random_numbers_stay_unrecognised(digits):
    generator = random.Random(digits)
    with flint.ctx.workdps(digits + 5):
        radius = flint.arb(10) ** -digits
        for _ in range(20):
            parts = [flint.arb(generator.getrandbits(300)) / 2**300 for _ in range(2)]
            real = flint.acb(flint.arb(parts[0].mid(), radius))
            assert recognise_number(real, degree=10) is None
            both = flint.acb(*(flint.arb(part.mid(), radius) for part in parts))
            assert recognise_number(both, degree=10) is None


@pytest.mark.parametrize("parts", [(1, 0), (0, 1), (1, 1), (1, 1e-6)])
def test_random_numbers_of_any_size_stay_unrecognised(parts):
    """Where z is large or small the values of polynomials fill a narrow strip, not a disc."""
    generator = random.Random(1)
    flint.ctx.dps = 30
    for _ in range(500):
        size = 10.0 ** generator.uniform(-14, 14)
        x, y = (generator.uniform(-1, 1) * size * part for part in parts)
        assert recognise_number(flint.acb(x, y) * flint.arb(2).log(), degree=3) is None


def test_a_random_number_gets_the_height_that_is_foretold():
    """The shortest polynomial of degree 3 of π to 40 digits is as high as the evidence says."""
    radius = flint.arb(10) ** -40
    with flint.ctx.workdps(60):
        known = recognise_number(flint.acb(flint.arb(flint.arb(2).root(3).mid(), radius)))
        powers = [[flint.arb.pi() ** k] for k in range(4)]
        height = max(map(abs, reduced_relations(powers, 133)[0]))
    assert known.degree == 3
    assert abs(math.log10(height) - known.evidence.random_height) < 1.5


def test_evidence_counts_both_parts_of_a_complex_number():
    with flint.ctx.workdps(40):
        real = recognise_number(flint.acb(flint.arb(7).sqrt()))
        both = recognise_number((1 + flint.acb(-7).sqrt()) / 2)
    assert 38 < real.evidence.digits < 43
    assert 76 < both.evidence.digits < 86


def test_what_the_ball_excludes_is_dropped():
    """√2 moved by 10⁻³⁰: no polynomial of √2 vanishes in a ball of 10⁻³⁵ about it."""
    with flint.ctx.workdps(60):
        moved = flint.arb(2).sqrt() + flint.arb(10) ** -30
        z = flint.acb(flint.arb(moved.mid(), flint.arb(10) ** -35))
        found = recognise_number(z)
        assert found is None or found.polynomial != (-2, 0, 1)
        wide = flint.acb(flint.arb(moved.mid(), flint.arb(10) ** -29))
        assert recognise_number(wide).polynomial == (-2, 0, 1)


def test_an_exact_number_is_that_number():
    tenth = flint.acb(0.1)
    assert recognise_number(tenth) is None
    assert recognise_number(flint.acb(0.5)).polynomial == (-1, 2)


def test_zero():
    with flint.ctx.workdps(30):
        ball = flint.arb(0, flint.arb(10) ** -25)
        zero = recognise_number(flint.acb(ball, ball))
        assert zero.polynomial == (0, 1)
        assert zero.evidence.left_over > 20
    assert recognise_number(flint.acb(flint.arb(0, 0.1))) is None


def test_equal_numbers():
    plus, minus = (AlgebraicNumber((-2, 0, 1), sign * 1.4142 + 0j) for sign in (1, -1))
    assert plus.same_number(AlgebraicNumber((-2, 0, 1), 1.41421 + 0j))
    assert not plus.same_number(minus)
    assert plus.is_real
    assert not AlgebraicNumber((1, 0, 1), 1j).is_real


def test_words():
    with flint.ctx.workdps(30):
        x = recognise_number(flint.acb(flint.arb(5).sqrt()))
    assert "digits used" in str(x.evidence)
    quintic = AlgebraicNumber((-1, -1, 0, 0, 0, 1), 1.1673 + 0j)
    assert str(quintic) == "root of x^5 - x - 1 near 1.1673"


def test_refusals():
    with pytest.raises(ValueError, match="finite"):
        recognise_number(flint.acb("nan"))
    with pytest.raises(ValueError, match="degree must be at least 1"):
        recognise_number(flint.acb(1), degree=0)
