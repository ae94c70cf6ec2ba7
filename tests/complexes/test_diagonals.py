"""Feet of heights and diagonals are as right as is claimed, however long the sides are."""

import numpy as np
import pytest
from flint import arb, ctx

from igl_periods.complexes.diagonals import foot, other_diagonal


@pytest.fixture(autouse=True)
def precise():
    ctx.prec = 300


U = 2.0**-53


def triangles(n, seed):
    """Sides base, near, far of strict triangles, with ratios up to 1e8 and all angles."""
    rng = np.random.default_rng(seed)
    base = 10.0 ** rng.uniform(-4, 4, n)
    near = base * 10.0 ** rng.uniform(-8, 8, n)
    # |base − near| < far < base + near, often close to the ends.
    t = 10.0 ** -rng.uniform(0, 6, n)
    t = np.where(rng.random(n) < 0.5, t, 1 - t)
    far = np.abs(base - near) + t * (base + near - np.abs(base - near))
    keep = (np.abs(base - near) < far) & (far < base + near)
    return base[keep], near[keep], far[keep]


def exact_foot(base, near, far):
    b, n, f = (arb(float(x)) for x in (base, near, far))
    return (b * b + n * n - f * f) / (2 * b)


@pytest.mark.parametrize("seed", range(5))
def test_feet_are_right_to_eight_ulps_of_the_near_side(seed):
    base, near, far = triangles(1000, seed)
    found = foot(base, near, far)
    exact = [exact_foot(*sides) for sides in zip(base, near, far, strict=True)]
    error = [abs(float((arb(float(x)) - y).mid())) for x, y in zip(found, exact, strict=True)]
    assert np.all(np.array(error) <= 8 * U * near)


@pytest.mark.parametrize("ratio", [1e2, 1e4, 1e6, 1e8])
def test_feet_of_short_and_of_long_sides_keep_their_digits(ratio):
    # Each of the two formulas loses the ratio of the sides in the other's case.
    long, short = np.array([1.0]), np.array([0.7 / ratio])
    for sides in ((long, short, long), (short, long, long)):
        error = foot(*sides)[0] - float(exact_foot(*(s[0] for s in sides)).mid())
        assert abs(error) <= 8 * U * sides[1][0]


def quadrilaterals(n, seed):
    """base, pa, pb, qa, qb, in all shapes, from points on either side of the base."""
    rng = np.random.default_rng(seed)
    base = 10.0 ** rng.uniform(-3, 3, n)
    sides = [base]
    for _ in range(2):
        x = base * (rng.integers(0, 2, n) + rng.normal(size=n) * 10.0 ** rng.uniform(-7, 1, n))
        y = base * 10.0 ** rng.uniform(-7, 1, n)
        sides.append(np.hypot(x, y))
        sides.append(np.hypot(x - base, y))
    slack = [a + b - c for a, b, c in ((sides[1], sides[2], base), (sides[3], sides[4], base))]
    slack += [base + sides[i] - sides[i + 1] for i in (1, 3)]
    slack += [base + sides[i + 1] - sides[i] for i in (1, 3)]
    keep = np.min(slack / np.maximum.reduce(sides), axis=0) > 5e-15
    return [side[keep] for side in sides]


def exact_diagonal(base, pa, pb, qa, qb):
    def height(a, b, c):
        s = (a + b + c) / 2
        return 2 * (s * (s - a) * (s - b) * (s - c)).sqrt() / a

    c, p1, p2, q1, q2 = (arb(float(x)) for x in (base, pa, pb, qa, qb))
    along = (p1**2 - p2**2 - q1**2 + q2**2) / (2 * c)
    return (along**2 + (height(c, p1, p2) + height(c, q1, q2)) ** 2).sqrt()


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("kind", [np.float64, np.longdouble])
def test_diagonals_are_within_their_error(kind, seed):
    sides = quadrilaterals(500, seed)
    found, claimed = other_diagonal(*(side.astype(kind) for side in sides))
    unit = 8 * float(np.finfo(kind).eps) / 2
    n_tight = 0
    for k, length in enumerate(found):
        exact = exact_diagonal(*(side[k] for side in sides))
        high = float(length)
        computed = arb(high) + arb(float(length - kind(high)))
        error = abs(float(((computed - exact) / exact).mid()))
        assert error <= unit * float(claimed[k])
        n_tight += error > 0.01 * unit * float(claimed[k])
    assert n_tight > 10
