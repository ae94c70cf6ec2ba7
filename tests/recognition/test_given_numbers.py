"""What is handed over for recognition."""

from fractions import Fraction

import flint
import numpy as np
import pytest

import igl_periods as ip

GOLDEN = (-1, -1, 1)


class Number:
    """What recognition sees of a number of mpmath: 1.6180… to 53 bits, as an integer times 2ⁿ."""

    class context:  # noqa: N801
        prec = 53

    _mpf_ = (0, int(1.618033988749895 * 2**52), -52, 53)


@pytest.mark.parametrize(
    "x",
    [
        1.618033988749895,
        1.618033988749895 + 0j,
        np.float64(1.618033988749895),
        "1.618033988749895 +/- 1e-15",
        Number(),
    ],
)
def test_numbers_of_every_kind(x):
    assert ip.recognize(x).polynomial == GOLDEN


def test_balls():
    with flint.ctx.workdps(30):
        x = (1 + flint.arb(5).sqrt()) / 2
    # The balls keep their digits, whatever the working precision is.
    assert ip.recognize(x).polynomial == GOLDEN
    assert ip.recognize(x).evidence.left_over > 25
    assert ip.recognize(flint.acb(x)).polynomial == GOLDEN


def test_fractions_are_exact():
    assert ip.recognize(Fraction(22, 7)).polynomial == (-22, 7)
    assert ip.recognize(3).polynomial == (-3, 1)


def test_digits_say_how_many_are_right():
    x = 1.6180340  # right to seven digits
    assert ip.recognize(x) is None or ip.recognize(x).polynomial != GOLDEN
    assert ip.recognize(x, digits=7.3, left_over=4).polynomial == GOLDEN


def test_transcendental_floats():
    assert ip.recognize(np.pi) is None
    assert ip.recognize(np.e * 1j) is None


def test_matrices():
    found = ip.recognize(np.array([[0.5j, 2**0.5]]))
    assert str(found).split() == ["i/2", "√2"]
    assert ip.recognize(flint.arb_mat([[1, 2]])).complete
    assert ip.recognize(flint.acb_mat(0, 0)).complete


def test_period_matrices_with_their_bounds():
    pm = ip.period_matrix(ip.surfaces.square_tiled_surface("omega_2", 2), tolerance=1e-10)
    found = ip.recognize(pm.reduced())
    assert found.complete
    assert str(found.field) == "Q(i√2)"


def test_refusals():
    with pytest.raises(ValueError, match="digits must be positive"):
        ip.recognize(1.0, digits=0)
    with pytest.raises(ValueError, match="a number or a matrix is needed"):
        ip.recognize([1.0, 2.0])
    with pytest.raises(ValueError, match="finite"):
        ip.recognize(np.inf)
