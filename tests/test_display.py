"""What is shown of a number is true: its last digit is off by one at most."""

import math
from html.parser import HTMLParser

import numpy as np
import pytest

from igl_periods.display import (
    Shown,
    arrays_repr,
    known_decimals,
    known_digits,
    matrix_html,
    matrix_latex,
    matrix_lines,
    rounded_up,
)


def unit(text):
    """The unit of the last digit of a decimal number."""
    return 10.0 ** -len(text.partition(".")[2])


def test_the_last_digit_is_off_by_one_at_most():
    rng = np.random.default_rng(1)
    for _ in range(3_000):
        bound = 10.0 ** rng.uniform(-13.0, 0.0)
        exact = rng.normal() * 10.0 ** rng.uniform(-4.0, 1.0)
        x = exact + bound * rng.uniform(-1.0, 1.0)
        text = known_digits(x, bound)
        if text == "0":
            assert abs(exact) <= 2.0 * bound + 0.5 * 10.0 ** -known_decimals(bound)
        else:
            rounded = float(f"{exact:.{known_decimals(bound)}f}")
            assert abs(float(text) - rounded) <= unit(text) * (1.0 + 1e-3)
            assert abs(float(text) - exact) <= 1.5 * unit(text) * (1.0 + 1e-3)


def test_every_supported_digit_is_there_and_no_other():
    rng = np.random.default_rng(2)
    for bound in 10.0 ** rng.uniform(-13.0, 2.0, 1_000):
        d = known_decimals(bound)
        assert bound <= 10.0**-d
        assert bound > 10.0 ** -(d + 1)
    assert [known_decimals(b) for b in (1.0, 0.1, 0.1000001, 1e-8)] == [0, 1, 0, 8]


@pytest.mark.parametrize(
    ("x", "bound", "text"),
    [
        (1.23456789, 4e-5, "1.2346"),
        (-1.23456789, 1.1e-4, "-1.235"),
        (1e-17, 1e-12, "0"),
        (-1e-17, None, "0"),
        (0.5, None, "0.500000"),
        (-0.3, 0.2, "0"),  # not within the bound of 0, but no digit is known
        (7.2, 2.0, "7 ± 3"),
        (0.2, 2.0, "0"),
        (1.0, 0.0, "1.000000000000000"),  # what a float holds
        (1.5, math.inf, "1.5 ± ∞"),
        (math.nan, 0.1, "nan"),
    ],
)
def test_numbers(x, bound, text):
    assert known_digits(x, bound) == text


def test_bounds_are_rounded_upwards():
    rng = np.random.default_rng(3)
    for bound in 10.0 ** rng.uniform(-14.0, 3.0, 2_000):
        for digits in (2, 3):
            shown = float(rounded_up(bound, digits))
            assert bound <= shown <= bound * (1.0 + 1.01 * 10.0 ** (1 - digits))
    assert [rounded_up(b) for b in (0.0099, 0.00991, 0.0999, 9.99)] == [
        "0.0099",
        "0.01",
        "0.1",
        "10",
    ]


def test_columns_are_aligned():
    matrix = np.array([[0.5 + 1.25j, -10.0 + 2.0j], [1.0, 0.5 - 0.001j]])
    bounds = np.array([[0.004, 0.04], [1e-5, 1e-4]])
    assert matrix_lines(matrix, bounds) == [
        "0.50    + 1.25 i   -10.0    + 2.0 i",
        "1.00000              0.5000 - 0.0010 i",
    ]
    assert matrix_lines(np.array([[1j, -0.5j], [-0.5j, 1.0]]), None) == [
        " 1.000000 i   -0.500000 i",
        "-0.500000 i    1.000000",
    ]


class _Cells(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.rows, self.open = [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        if tag == "tr":
            self.rows.append([])

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if "td" in self.open:
            self.rows[-1].append(data)


@pytest.mark.parametrize(("size", "shown"), [(1, 1), (8, 8), (9, 4), (300, 4)])
def test_large_matrices_are_abbreviated(size, shown):
    matrix = 1j * np.eye(size) + 0.25
    lines = matrix_lines(matrix, None)
    assert len(lines) == shown + (size > shown)
    cells = _Cells(matrix_html(matrix, None))
    assert cells.open == []
    assert len(cells.rows[0]) == shown + (size > shown)
    assert cells.rows[0][0] == "0.250000 + 1.000000 i"
    assert matrix_latex(matrix, None).count(r"\\") == shown - 1 + (size > shown)


def test_latex():
    matrix = np.array([[0.5 + 1.25j, -1j], [-1j, 2.0]])
    assert matrix_latex(matrix, np.full((2, 2), 1e-2)) == (
        r"\begin{pmatrix} 0.50 + 1.25\,i & -1.00\,i \\ -1.00\,i & 2.00 \end{pmatrix}"
    )


def test_arrays_are_shown_by_their_shapes():
    from igl_periods.complexes import DeltaComplex, double, involution

    sphere = double(DeltaComplex.from_lengths([[1, 1, 1]], [[0, 1, 2]]))
    assert arrays_repr(involution(sphere)) == (
        "Involution(face=<2 int64>, vertex=<3 int64>, half_edge=<6 int64>, edge=<3 int64>, "
        "sign=<3 int8>)"
    )


def test_pages_are_made_by_whoever_knows_how():
    class Thing(Shown):
        pass

    class Other(Thing):
        pass

    with pytest.raises(RuntimeError, match="nothing makes pages"):
        Thing().show()
    Thing.shown_by(lambda thing, title: (type(thing), title))
    assert Other().show(title="t") == (Other, "t")
    # Others are not touched.
    with pytest.raises(RuntimeError, match="nothing makes pages"):
        Shown().show()
