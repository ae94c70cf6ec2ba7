r"""Numbers and facts as a terminal and a notebook show them.

A number x that is known to within b gets the decimals that b supports, and no other: the largest d
with :math:`b \le 10^{-d}`.  Numbers that are no further apart than one unit of the last digit are
rounded to numbers that are no further apart, so that

.. math:: |\text{round}_d(x) - \text{round}_d(x_{exact})| \le 10^{-d}:

the last digit is off by one at most.  What is within b of 0, or has no digit but zeros, is shown as
0.  Bounds are rounded upwards, so that they stay bounds.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import fields
from html import escape
from typing import Any, ClassVar

import flint
import numpy as np
from numpy.typing import NDArray

from .arrays import Floats

# Matrices up to this size are shown whole, of larger ones a corner.
LARGEST_SHOWN = 8
_CORNER = 4
# Where nothing is known about the error.
_PLAIN_DECIMALS = 6
_EPS = 2.0**-52
# Characters in a line that numbers may take.
_LINE = 140


class Shown:
    """What has a page with a surface to turn.

    How such a page is made is known further up: whoever knows it says so to :meth:`shown_by`.
    """

    _viewer: ClassVar[Callable[..., Any] | None] = None

    @classmethod
    def shown_by(cls, viewer: Callable[..., Any]) -> None:
        """Have a function of the object and of ``title`` make its page."""
        cls._viewer = staticmethod(viewer)

    def show(self, *, title: str = "") -> Any:
        """The surface on a page where it can be turned.

        Parameters
        ----------
        title : str
            What the page is called.

        Returns
        -------
        Viewer
            A notebook displays it; ``save(path)`` writes one HTML file, which needs no network.
            Without positions the surface is drawn in the plane: by the polygons that it was
            glued from, or developed by a holomorphic form.

        Raises
        ------
        MissingExtraError
            If the packages of the extra ``pictures`` are not installed.
        ComplexError
            If the surface is a sphere without positions, or lies in more than 3 dimensions.
        """
        if self._viewer is None:
            raise RuntimeError("nothing makes pages: import igl_periods itself.")
        return self._viewer(self, title=title)


def counted(count: int, one: str, many: str) -> str:
    """``1 edge``, ``3 edges``."""
    return f"{count} {one if count == 1 else many}"


def known_decimals(bound: float) -> int:
    """The largest d with bound ≤ 10^−d; negative where not even the units are known."""
    d = math.floor(-math.log10(bound))
    return d if bound <= 10.0**-d else d - 1


def known_digits(x: float, bound: float | None) -> str:
    """A number with the digits that a bound of its error supports.

    Parameters
    ----------
    x : float
    bound : float or None
        Of the error of x; None where there is none, and x gets 6 decimals.

    Examples
    --------
    >>> known_digits(1.23456789, 8e-4), known_digits(-3e-9, 1e-8), known_digits(7.2, 2.0)
    ('1.235', '0', '7 ± 3')
    """
    if not math.isfinite(x) or (bound is not None and not math.isfinite(bound)):
        return f"{x:.3g} ± ∞" if math.isfinite(x) else str(x)
    if bound is None:
        return _unsigned_zero(f"{x:.{_PLAIN_DECIMALS}f}")
    error = max(bound, _EPS * abs(x))
    if abs(x) <= error:
        return "0"
    d = known_decimals(error)
    if d < 0:
        return f"{x:.0f} ± {math.ceil(error + 0.5):.0f}"
    return _unsigned_zero(f"{x:.{d}f}")


def _unsigned_zero(text: str) -> str:
    return text if float(text) else "0"


def rounded_up(bound: float, digits: int = 2) -> str:
    """A bound with some significant digits, not smaller than it is.

    Examples
    --------
    >>> rounded_up(0.006401), rounded_up(1e-13), rounded_up(0.0)
    ('0.0065', '1e-13', '0')
    """
    text = f"{bound:.{digits}g}"
    if float(text) >= bound or not math.isfinite(bound):
        return text
    unit = 10.0 ** (math.floor(math.log10(bound)) - digits + 1)
    return f"{float(text) + unit:.{digits}g}"


def complex_parts(z: complex, bound: float | None) -> tuple[str, str, str]:
    """Real part, sign and imaginary part with its i; what is 0 is empty unless both are."""
    re, im = known_digits(z.real, bound), known_digits(z.imag, bound)
    if im == "0":
        return re, "", ""
    if "±" in im:
        im = f"({im})"
    if re == "0":
        return "", "", f"{im} i"
    return re, "-" if im.startswith("-") else "+", f"{im.removeprefix('-')} i"


def ball_digits(x: flint.arb, digits: int) -> str:
    """The digits of a real number that its ball determines, at most so many; 0 if there are none.

    The last one is off by 1 at most.

    Examples
    --------
    >>> ball_digits(flint.arb(3).sqrt() / 2, 10), ball_digits(flint.arb(0, 1e-30), 10)
    ('0.8660254038', '0')
    """
    text = str(x.str(max(digits, 1), radius=False))
    return text if text.partition("e")[0].strip("-0.") else "0"


def ball_matrix_lines(matrix: flint.acb_mat, digits: int) -> list[str]:
    """Rows of a complex matrix with at most so many digits, and none that is not known."""
    g = matrix.nrows()
    if g > LARGEST_SHOWN:
        return [f"{g} × {g} entries, in balls"]
    rows = [[_ball_entry(z, digits) for z in row] for row in matrix.tolist()] if g else []
    width = max((len(text) for row in rows for text in row), default=0)
    return ["   ".join(text.rjust(width) for text in row) for row in rows]


def readable_digits(g: int) -> int:
    """How many digits of the entries of a (g, g) matrix a line has room for."""
    return max(3, min(20, _LINE // (2 * max(g, 1)) - 6))


def _ball_entry(z: flint.acb, digits: int) -> str:
    real, imag = ball_digits(z.real, digits), ball_digits(z.imag, digits)
    if imag == "0":
        return real
    if real == "0":
        return f"{imag} i"
    return f"{real} {'-' if imag.startswith('-') else '+'} {imag.removeprefix('-')} i"


def matrix_lines(matrix: NDArray[Any], bounds: Floats | None) -> list[str]:
    """A complex matrix as lines of text, its columns aligned; of a large one the first corner.

    Parameters
    ----------
    matrix : (g, g) complex
    bounds : (g, g) float or None
        Bounds of the errors of its entries.
    """
    cells = _cells(matrix, bounds)
    columns = [_aligned(column) for column in zip(*cells)]
    rows = ["   ".join(row).rstrip() for row in zip(*columns)]
    if len(cells) < len(matrix):
        rows = [f"{row}   …" for row in rows] + [f"… {len(matrix)} × {len(matrix)} entries"]
    return rows


def matrix_html(matrix: NDArray[Any], bounds: Floats | None) -> str:
    """A complex matrix as an HTML table between brackets; of a large one the first corner."""
    cells = [[_joined(cell).replace("-", "−") for cell in row] for row in _cells(matrix, bounds)]
    if len(cells) < len(matrix):
        cells = [[*row, "…"] for row in cells] + [["⋮"] * (len(cells) + 1)]
    style = "text-align:right;white-space:nowrap;padding:0.15em 0.8em;border:none"
    rows = ("".join(f'<td style="{style}">{escape(cell)}</td>' for cell in row) for row in cells)
    body = "\n".join(f"<tr>{row}</tr>" for row in rows)
    border = "border-left:1.5px solid;border-right:1.5px solid;border-radius:0.5em"
    return (
        f'<table class="matrix" style="{border};border-collapse:separate;'
        f'font-variant-numeric:tabular-nums">\n{body}\n</table>'
    )


def matrix_latex(matrix: NDArray[Any], bounds: Floats | None) -> str:
    r"""A complex matrix as a LaTeX ``pmatrix``; of a large one the first corner."""
    cells = [[_joined(c).replace(" i", r"\,i").replace("±", r"\pm") for c in row]
             for row in _cells(matrix, bounds)]  # fmt: skip
    if len(cells) < len(matrix):
        cells = [[*row, r"\cdots"] for row in cells] + [[r"\vdots"] * (len(cells) + 1)]
    body = r" \\ ".join(" & ".join(row) for row in cells)
    # A matrix of LaTeX has ten columns at most, which is more than are shown.
    return rf"\begin{{pmatrix}} {body} \end{{pmatrix}}"


def integer_lines(matrix: NDArray[np.integer[Any]]) -> list[str]:
    """An integer matrix as aligned lines of text."""
    width = max((len(str(entry)) for entry in matrix.ravel()), default=0)
    return [" ".join(f"{entry:{width}d}" for entry in row) for row in matrix]


def facts_html(title: str, facts: Iterable[tuple[str, object]], *below: str) -> str:
    """A title over a table of names and values, and pieces of HTML below."""
    cell = "text-align:left;padding:0.1em 0.8em"
    rows = "".join(
        f'<tr><th style="{cell}">{escape(name)}</th>'
        f'<td style="{cell}">{escape(str(value))}</td></tr>'
        for name, value in facts
    )
    return "\n".join([f"<div><b>{escape(title)}</b>", f"<table>{rows}</table>", *below, "</div>"])


def paragraph_html(text: str) -> str:
    """A paragraph of plain text."""
    return f"<p>{escape(text)}</p>"


def lines_html(title: str, lines: Iterable[str]) -> str:
    """A title over lines of text in the type of a terminal."""
    text = escape("\n".join(lines))
    return f'<div><b>{escape(title)}</b><pre style="font-family:monospace">{text}</pre></div>'


def arrays_repr(self: Any) -> str:
    """The ``__repr__`` of a dataclass of arrays: their shapes, never their numbers."""
    shown = (f"{field.name}={_shape(getattr(self, field.name))}" for field in fields(self))
    return f"{type(self).__name__}({', '.join(shown)})"


def shape_in_words(array: NDArray[Any]) -> str:
    """``2 × 3``."""
    return " × ".join(map(str, array.shape))


def _shape(value: Any) -> str:
    if not hasattr(value, "shape"):
        return repr(value)
    return f"<{shape_in_words(value) or 'scalar'} {value.dtype}>"


def _cells(matrix: NDArray[Any], bounds: Floats | None) -> list[list[tuple[str, str, str]]]:
    """The parts of the entries that are shown."""
    shown = range(len(matrix) if len(matrix) <= LARGEST_SHOWN else _CORNER)
    return [
        [
            complex_parts(complex(matrix[i, j]), None if bounds is None else float(bounds[i, j]))
            for j in shown
        ]
        for i in shown
    ]


def _joined(cell: tuple[str, str, str]) -> str:
    re, sign, im = cell
    return f"{re} {sign} {im}" if re and im else f"{re}{sign}{im}"


def _aligned(column: Sequence[tuple[str, str, str]]) -> list[str]:
    """The entries of a column with their decimal points and signs in line."""
    im = _on_points([cell[2] for cell in column])
    if not any(cell[1] for cell in column):  # real or imaginary: one number each
        return _on_points([cell[0] or cell[2] for cell in column])
    re = _on_points([cell[0] for cell in column])
    return [f"{a} {cell[1] or ' '} {b}" for a, cell, b in zip(re, column, im)]


def _on_points(numbers: Sequence[str]) -> list[str]:
    """Numbers padded so that their decimal points are in one column."""
    split = [number.partition(".") for number in numbers]
    before, after = (max(len(part[k]) for part in split) for k in (0, 2))
    point = any(part[1] for part in split)
    return [
        f"{whole:>{before}}{dot or ' ' * point}{digits:<{after}}" for whole, dot, digits in split
    ]
