"""Matrices whose entries are recognised algebraic numbers, and the field that these generate."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import flint

from igl_periods.display import facts_html, lines_html

from .algebraic_numbers import LARGEST_DEGREE, LEAST_LEFT_OVER, AlgebraicNumber, recognise_number
from .number_fields import NumberField, generated_field
from .radicals import in_radicals


@dataclass(frozen=True)
class RecognisedMatrix:
    """A matrix of algebraic numbers, recognised and not proved.

    Attributes
    ----------
    entries : tuple of rows
        Each entry an :class:`AlgebraicNumber`, or None where nothing was recognised.

    Examples
    --------
    >>> import igl_periods as ip
    >>> print(ip.recognize([[0.5, 0.7071067811865476]]))
    1/2   √2/2
    """

    entries: tuple[tuple[AlgebraicNumber | None, ...], ...]

    @property
    def shape(self) -> tuple[int, int]:
        """Numbers of rows and columns."""
        return len(self.entries), len(self.entries[0]) if self.entries else 0

    def __getitem__(self, place: tuple[int, int]) -> AlgebraicNumber | None:
        return self.entries[place[0]][place[1]]

    def _recognised(self) -> Iterator[AlgebraicNumber]:
        return (x for row in self.entries for x in row if x is not None)

    @property
    def complete(self) -> bool:
        """Whether every entry was recognised."""
        return all(x is not None for row in self.entries for x in row)

    @property
    def left_over(self) -> float:
        """The least number of digits left over among the recognised entries."""
        found = [x.evidence.left_over for x in self._recognised() if x.evidence is not None]
        return min(found, default=0.0)

    @property
    def degree(self) -> int:
        """The largest degree of a recognised entry."""
        return max((x.degree for x in self._recognised()), default=0)

    @property
    def height(self) -> int:
        """The largest height of a recognised entry."""
        return max((x.height for x in self._recognised()), default=0)

    @cached_property
    def field(self) -> NumberField | None:
        """The field that the entries generate; None if one is missing or the degree too large."""
        return generated_field(self._recognised()) if self.complete else None

    def ball(self, bits: int) -> flint.acb_mat:
        """The exact matrix in balls, with about so many bits.

        Raises
        ------
        ValueError
            If an entry was not recognised.
        """
        if not self.complete:
            raise ValueError("an entry was not recognised: the matrix is not known exactly")
        return flint.acb_mat([[x.ball(bits) for x in row if x is not None] for row in self.entries])

    def latex(self) -> str:
        r"""The matrix as a ``pmatrix``; what has no roots to write it with as its digits."""
        rows = (" & ".join(_in_latex(x) for x in row) for row in self.entries)
        return r"\begin{pmatrix} " + r" \\ ".join(rows) + r" \end{pmatrix}"

    def __str__(self) -> str:
        cells = [["?" if x is None else str(x) for x in row] for row in self.entries]
        widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
        return "\n".join(
            "   ".join(text.rjust(w) for text, w in zip(row, widths, strict=True)) for row in cells
        )

    def _repr_html_(self) -> str:
        facts = [
            ("field", self.field or "not found"),
            ("digits left over", f"{self.left_over:.0f}"),
        ]
        return facts_html(
            "Recognised, not proved", facts, lines_html("entries", str(self).split("\n"))
        )


def recognise_matrix(
    matrix: flint.acb_mat, *, degree: int = LARGEST_DEGREE, left_over: float = LEAST_LEFT_OVER
) -> RecognisedMatrix:
    """Recognise the entries of a matrix of balls, one by one; equal balls only once.

    Raises
    ------
    ValueError
        If an entry is not finite, or the degree not positive.

    Examples
    --------
    >>> with flint.ctx.workdps(30):
    ...     found = recognise_matrix(flint.acb_mat([[flint.acb(0, flint.arb(3).sqrt() / 2)]]))
    >>> print(found, found.field, sep=", ")
    i√3/2, Q(i√3)
    """
    known: dict[str, AlgebraicNumber | None] = {}

    def recognised(z: flint.acb) -> AlgebraicNumber | None:
        key = z.repr()
        if key not in known:
            known[key] = recognise_number(z, degree=degree, left_over=left_over)
        return known[key]

    rows = matrix.tolist() if matrix.nrows() else []
    return RecognisedMatrix(tuple(tuple(recognised(z) for z in row) for row in rows))


def _in_latex(x: AlgebraicNumber | None) -> str:
    if x is None:
        return "?"
    surd = in_radicals(x)
    if surd is not None:
        return surd.latex()
    z = x.near
    return f"{z.real:.6g}{z.imag:+.6g}\\,\\mathrm{{i}}" if z.imag else f"{z.real:.6g}"
