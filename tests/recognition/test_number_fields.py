"""The field that some numbers generate, and the numbers in it."""

from fractions import Fraction

import flint
import pytest

from igl_periods.recognition import RATIONALS, AlgebraicNumber, generated_field

ROOT2, ROOT3, ROOT6, I = (  # noqa: E741
    AlgebraicNumber((-d, 0, 1), complex(d) ** 0.5) for d in (2, 3, 6, -1)
)
CUBE = AlgebraicNumber((-2, 0, 0, 1), 2 ** (1 / 3) + 0j)
QUARTER = AlgebraicNumber((-1, 4), 0.25 + 0j)


def value(field, coordinates, bits=300):
    with flint.ctx.workprec(bits):
        theta = field.generator.ball(bits)
        exact = [flint.fmpq(q.numerator, q.denominator) for q in coordinates]
        return sum((q * theta**k for k, q in enumerate(exact)), flint.acb(0))


def test_rational_numbers_generate_the_rational_field():
    assert generated_field([QUARTER]) == RATIONALS
    assert str(RATIONALS) == "Q"
    assert RATIONALS.coordinates(QUARTER) == (Fraction(1, 4),)


@pytest.mark.parametrize(
    ("numbers", "degree"),
    [
        ([ROOT2, ROOT3], 4),
        ([ROOT2, ROOT3, ROOT6], 4),
        ([ROOT2, I], 4),
        ([CUBE], 3),
        ([CUBE, ROOT3, QUARTER], 6),
        ([ROOT2, ROOT3, I], 8),
        ([ROOT2, CUBE, ROOT6], 12),
    ],
)
def test_the_field_has_the_degree_of_the_compositum_and_contains_all(numbers, degree):
    field = generated_field(numbers)
    assert field.degree == degree
    for x in numbers:
        assert value(field, field.coordinates(x)).overlaps(x.ball(300))


def test_two_conjugates_generate_the_splitting_field():
    other = AlgebraicNumber((-2, 0, 0, 1), CUBE.near * (-0.5 + 0.75**0.5 * 1j))
    assert generated_field([CUBE, other]).degree == 6
    assert generated_field([ROOT2, AlgebraicNumber((-2, 0, 1), -1.414 + 0j)]).degree == 2


def test_quadratic_fields_have_the_root_of_a_square_free_number():
    x = AlgebraicNumber((-4, -4, 4), 1.618 + 0j)  # (1 + √5)/2
    field = generated_field([AlgebraicNumber((-1, -1, 1), 1.618 + 0j)])
    assert field.polynomial == (-5, 0, 1)
    assert str(field) == "Q(√5)"
    assert field.is_real
    assert x.degree == 2


def test_generators_are_simplified():
    with_big = AlgebraicNumber((-2 * 50**3, 0, 0, 1), 50 * 2 ** (1 / 3) + 0j)
    assert generated_field([with_big]).generator.height <= 50**3 * 2
    field = generated_field([ROOT2, ROOT3])
    assert field.generator.height <= 10
    assert "Q(a), a^6" in str(generated_field([CUBE, ROOT3]))


def test_what_is_not_in_the_field_is_refused():
    field = generated_field([ROOT2])
    with pytest.raises(ValueError, match="not in"):
        field.coordinates(CUBE)
    with pytest.raises(ValueError, match="not in"):
        field.coordinates(ROOT3)


def test_large_fields_are_not_computed():
    assert generated_field([ROOT2, ROOT3, I], largest_degree=4) is None
