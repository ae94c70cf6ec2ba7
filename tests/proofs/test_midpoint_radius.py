"""Midpoint–radius arithmetic contains the exact results, which are rational numbers."""

from fractions import Fraction

import numpy as np
import pytest

from igl_periods.proofs import midpoint_radius
from igl_periods.proofs.midpoint_radius import (
    Balls,
    check_arithmetic,
    gamma,
    inner_products,
    norms,
    total,
)

SCALES = (1e-300, 1e-160, 1e-8, 1.0, 1e8, 1e150)


def random_balls(n, seed, scale=1.0, exact=False):
    rng = np.random.default_rng(seed)
    mid = scale * rng.normal(size=n) * 10.0 ** rng.uniform(-3, 3, n)
    rad = np.abs(mid) * 10.0 ** rng.uniform(-16, -0.5, n)
    return Balls.exact(mid) if exact else Balls(mid, rad)


def points(balls, seed):
    """Rational points of the balls: ends and inner ones."""
    where = np.random.default_rng(seed).choice([-1, 0, 1, Fraction(1, 3)], balls.mid.size)
    return [
        Fraction(m) + t * Fraction(r)
        for m, r, t in zip(balls.mid.tolist(), balls.rad.tolist(), where, strict=True)
    ]


def contains(balls, exact):
    return all(
        not np.isfinite(r) or abs(x - Fraction(m)) <= Fraction(r)
        for m, r, x in zip(balls.mid.tolist(), balls.rad.tolist(), exact, strict=True)
    )


OPERATIONS = {
    "sum": lambda x, y: x + y,
    "difference": lambda x, y: x - y,
    "product": lambda x, y: x * y,
    "quotient": lambda x, y: x / y,
}


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("exact", [False, True])
@pytest.mark.parametrize("name", OPERATIONS)
def test_operations_contain_the_exact_results(name, exact, scale):
    operation = OPERATIONS[name]
    for seed in range(4):
        x = random_balls(200, seed, scale, exact)
        y = random_balls(200, seed + 100, scale if name in ("sum", "difference") else 1.0)
        values = [operation(*pair) for pair in zip(points(x, 1), points(y, 2), strict=True)]
        assert contains(operation(x, y), values)


@pytest.mark.parametrize("name", OPERATIONS)
def test_radii_are_those_of_one_rounding(name):
    x, y = random_balls(500, 1, exact=True), random_balls(500, 2, exact=True)
    result = OPERATIONS[name](x, y)
    assert np.all(result.rad <= 2.0**-53 * np.abs(result.mid) * (1 + 1e-12))


@pytest.mark.parametrize("scale", SCALES)
@pytest.mark.parametrize("exact", [False, True])
def test_roots_contain_the_exact_results(exact, scale):
    x = random_balls(500, 3, scale, exact)
    x = Balls(np.abs(x.mid), x.rad)
    root = x.sqrt()
    for value, m, r in zip(points(x, 4), root.mid.tolist(), root.rad.tolist(), strict=True):
        low, high = Fraction(m) - Fraction(r), Fraction(m) + Fraction(r)
        assert max(low, 0) ** 2 <= value <= high**2


def test_what_is_not_determined_has_no_bound():
    zero, unit = Balls(np.array([0.0, 0.1]), np.array([0.0, 0.2])), Balls.exact(np.ones(2))
    assert np.isinf((unit / zero).rad).all()
    assert np.isinf(zero.sqrt().rad).all()
    # And it stays so.
    assert not np.isfinite(((unit / zero) * unit + unit).rad).any()
    assert not (unit / zero).is_positive().any()
    assert not np.isfinite(inner_products((unit / zero)[:, None], unit[:, None]).rad).any()


def test_scaling_by_powers_of_two_is_exact():
    x = random_balls(100, 5)
    assert contains(x.scaled(0.5), [value / 2 for value in points(x, 1)])
    assert np.array_equal(x.scaled(0.5).mid, 0.5 * x.mid)
    tiny = Balls.exact(np.array([2.0**-1074]))
    assert contains(tiny.scaled(0.5), [Fraction(2) ** -1075])


@pytest.mark.parametrize(("n", "k", "m"), [(1, 1, 1), (31, 2, 3), (700, 4, 4), (1200, 40, 3)])
@pytest.mark.parametrize("exact", [False, True])
def test_inner_products_contain_the_exact_ones(n, k, m, exact):
    X, Y = random_balls(n * k, 6, exact=exact), random_balls(n * m, 7, 1e3)
    x = np.array(points(X, 1), dtype=object).reshape(n, k)
    y = np.array(points(Y, 2), dtype=object).reshape(n, m)
    products = inner_products(X.reshape(n, k), Y.reshape(n, m))
    assert contains(products.reshape(k * m), (x.T @ y).ravel().tolist())


def test_inner_products_of_exact_numbers_are_sharp():
    # Long columns: rounding is that of short sums, added in pairs.
    x = np.random.default_rng(8).normal(size=(100_003, 3))
    gram = inner_products(Balls.exact(x), Balls.exact(x))
    scale = np.sqrt(np.outer(np.diag(gram.mid), np.diag(gram.mid)))
    assert np.all(gram.rad < 60 * 2.0**-53 * scale)
    assert inner_products(Balls.exact(x[:0]), Balls.exact(x[:0])).mid.tolist() == [[0.0] * 3] * 3


def test_sums_in_pairs_contain_the_exact_sum_and_are_sharp():
    parts = [random_balls(10, seed, exact=True) for seed in range(1001)]
    whole = total(iter(parts))
    exact = [sum(values) for values in zip(*(points(part, 0) for part in parts), strict=True)]
    assert contains(whole, exact)
    sizes = np.sum([np.abs(part.mid) for part in parts], axis=0)
    assert np.all(whole.rad < 12 * 2.0**-53 * sizes)


def test_gamma_is_an_upper_bound():
    for n in (1, 7, 1000, 2**20):
        exact = n * Fraction(1, 2**53) / (1 - n * Fraction(1, 2**53))
        assert exact <= Fraction(gamma(n)) <= exact * (1 + Fraction(1, 10**6))
    assert gamma(2**40) == np.inf


@pytest.mark.parametrize("scale", [1e-200, 1.0, 1e150])
def test_norms_are_upper_bounds(scale):
    x = scale * np.random.default_rng(9).normal(size=(1000, 3))
    exact = [sum(Fraction(v) ** 2 for v in column) for column in x.T.tolist()]
    for value, square in zip(norms(x).tolist(), exact, strict=True):
        assert square <= Fraction(value) ** 2 <= square * (1 + Fraction(1, 10**8)) + 10**-290
    with pytest.raises(ValueError, match="columns of 1048577 numbers are too long"):
        norms(np.zeros((2**20 + 1, 1)))


def test_arithmetic_is_tested_before_anything_is_proved(monkeypatch):
    check_arithmetic()
    # As if numbers had one bit less.
    monkeypatch.setattr(midpoint_radius, "UNIT", 2.0**-52)
    with pytest.raises(ArithmeticError, match="not rounded to nearest here"):
        check_arithmetic()
