r"""A period matrix in balls that provably contain the exact one.

All that is proved is in the energies D of explicit closed forms on the surface
(:mod:`igl_periods.enclosures.conforming_forms`); the period matrix, its error bound and every other
marking follow from them (:mod:`igl_periods.enclosures.siegel_point`).  With X + iY the midpoint of
``matrix`` and η = ``bound``,

.. math:: \| Y^{-1/2} (\Pi_{exact} - X - iY) Y^{-1/2} \|_2 \le \eta .

The surface is the one whose edges have the lengths that ``enclose`` was given: exact ones, square
roots of sums of squares of the coordinates, or the stored doubles.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import flint
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from igl_periods.complexes import DeltaComplex
from igl_periods.display import (
    ball_digits,
    ball_matrix_lines,
    facts_html,
    lines_html,
    readable_digits,
)
from igl_periods.recognition import (
    LARGEST_DEGREE,
    LEAST_LEFT_OVER,
    RecognisedMatrix,
    recognise_matrix,
)
from igl_periods.siegel import SIEGEL_GENUS_LIMIT, check_symplectic, siegel_reduce
from igl_periods.symplectic import form_action, product

from .exact_arithmetic import (
    ball_from_text,
    ball_in_text,
    from_integers,
    to_integers,
)
from .float_matrix import InFloatingPoint
from .siegel_point import SiegelBall, siegel_ball

SCHEMA = 1

_DIGITS_PER_BIT = 0.30102999566
_MOST_REDUCTIONS = 8


@dataclass(frozen=True, eq=False, repr=False)
class PeriodEnclosure(InFloatingPoint):
    """A period matrix in balls, with its marking.

    Attributes
    ----------
    dirichlet : (2g, 2g) arb_mat
        Energies of closed forms in the classes of ``cocycles``, in balls, or upper bounds of them
        in the sense of Loewner; neither is below the exact energies.
    cocycles : (2g, n_edges) sparse int
        The marking: closed cochains α_1..α_g, β_1..β_g on the edges of ``complex``, the same as
        those of ``period_matrix(complex)``.
    complex : DeltaComplex
        The surface as it was given, with ``exact_lengths`` if these are not the stored ones.
    bits : int
        The precision that ``dirichlet`` was computed with.

    Examples
    --------
    >>> import igl_periods as ip
    >>> proved = ip.enclose(ip.surfaces.flat_torus(1j), digits=20)
    >>> proved.digits >= 20
    True
    """

    dirichlet: flint.arb_mat
    cocycles: csr_array
    complex: DeltaComplex
    bits: int

    @property
    def genus(self) -> int:
        """The genus g."""
        return int(self.dirichlet.nrows()) // 2

    @cached_property
    def _ball(self) -> SiegelBall:
        with flint.ctx.workprec(self.bits):
            return siegel_ball(self.dirichlet)

    @cached_property
    def matrix(self) -> flint.acb_mat:
        """The period matrix Π; (g, g), every entry contains the exact one."""
        with flint.ctx.workprec(self.bits):
            return self._ball.matrix()

    @property
    def bound(self) -> flint.arb:
        """η, exact: ‖Y^{-1/2} (Π_exact − X − iY) Y^{-1/2}‖₂ ≤ η for the midpoint X + iY."""
        return self._ball.bound

    @cached_property
    def digits(self) -> int:
        """Proved decimal digits of all entries, relative to √(Y_ii Y_jj)."""
        known = int(_DIGITS_PER_BIT * self.bits)
        if self.bound == 0:
            return known
        with flint.ctx.workprec(64):
            proved = -self.bound.log() / flint.arb(10).log()
            return max(0, min(known, int(float(proved.floor().mid()))))

    def reduced(self, *, max_genus: int = SIEGEL_GENUS_LIMIT) -> PeriodEnclosure:
        """The same surface with a Siegel-reduced matrix; see :func:`siegel_reduce`.

        Raises
        ------
        ValueError
            If the genus is larger than ``max_genus``.
        """
        result, total = self, np.eye(2 * self.genus, dtype=np.int64)
        for _ in range(_MOST_REDUCTIONS):
            gamma = siegel_reduce(_midpoint(result.matrix), max_genus=max_genus).gamma
            if np.array_equal(gamma, np.eye(2 * self.genus)):
                break
            total = product(gamma, total)
            result = self.change_basis(total)
        return result

    def change_basis(self, gamma: ArrayLike) -> PeriodEnclosure:
        """The same surface in another canonical basis: Π ↦ (aΠ + b)(cΠ + d)⁻¹.

        Parameters
        ----------
        gamma : (2g, 2g) int
            [[a, b], [c, d]] in Sp(2g, Z).

        Raises
        ------
        ValueError
            If gamma is not an integer symplectic matrix of this size.
        ComplexError
            If its entries are so large that no digits are left.
        """
        U = form_action(check_symplectic(gamma, self.genus))
        with flint.ctx.workprec(self.bits):
            change = flint.arb_mat(2 * self.genus, 2 * self.genus, U.ravel().tolist())
            D = change * self.dirichlet * change.transpose()
        cocycles = csr_array(csr_array(U) @ self.cocycles)
        changed = PeriodEnclosure(D, cocycles, self.complex, self.bits)
        _ = changed.bound
        return changed

    def to_flint(self) -> flint.acb_mat:
        """The same as ``matrix``, under the name that it has of a :class:`PeriodMatrix`."""
        return self.matrix

    def contains(self, Pi: ArrayLike | flint.acb_mat) -> bool:
        """Whether all entries of a matrix lie in the balls of ``matrix``, in the same marking.

        Parameters
        ----------
        Pi : (g, g) array-like or acb_mat
            Numbers are taken as they are stored; of balls the whole must lie inside.

        Raises
        ------
        ValueError
            If it has another shape.
        """
        return bool(self.matrix.contains(_as_balls(Pi, self.genus)))

    def overlaps(self, other: PeriodEnclosure | ArrayLike | flint.acb_mat) -> bool:
        """Whether a matrix in the same marking has entries in common with ``matrix``.

        False proves that the two surfaces, with these markings, have different period matrices.

        Raises
        ------
        ValueError
            If it has another shape.
        """
        Pi = other.matrix if isinstance(other, PeriodEnclosure) else other
        return bool(self.matrix.overlaps(_as_balls(Pi, self.genus)))

    def recognize(
        self, *, degree: int = LARGEST_DEGREE, left_over: float = LEAST_LEFT_OVER
    ) -> RecognisedMatrix:
        """Recognise the entries as algebraic numbers; they are simplest in a reduced marking.

        See :func:`~igl_periods.recognize`.  What is recognised is not proved.
        """
        with flint.ctx.workprec(self.bits):
            return recognise_matrix(self.matrix, degree=degree, left_over=left_over)

    def to_json(self) -> dict[str, Any]:
        """A document of decimal strings, each of which is a proved enclosure.

        ``surface["meant"]`` says which surface the proof is about: the one whose lengths are the
        doubles in ``lengths``, or one whose exact lengths lie in the balls of ``exact_lengths``.
        """
        cocycles = self.cocycles.tocoo()
        digits = int(_DIGITS_PER_BIT * self.bits) + 1
        return {
            "schema": SCHEMA,
            "kind": "period enclosure",
            "genus": self.genus,
            "digits": self.digits,
            "bits": self.bits,
            "bound": ball_in_text(self.bound, 6),
            "matrix": {
                "real": _texts(self.matrix.real, self.digits + 3),
                "imag": _texts(self.matrix.imag, self.digits + 3),
            },
            "dirichlet": _texts(self.dirichlet, digits),
            "surface": self._surface(),
            "cocycles": {
                "row": cocycles.row.tolist(),
                "edge": cocycles.col.tolist(),
                "value": cocycles.data.tolist(),
            },
        }

    def _surface(self) -> dict[str, Any]:
        """The gluing, and which lengths are meant."""
        K = self.complex
        surface = {"twin": K.twin.tolist(), "lengths": K.lengths.tolist()}
        if K.exact_lengths is None or K.mollification > 0.0:
            return {**surface, "meant": "the lengths, exactly as these doubles are"}
        with flint.ctx.workprec(self.bits):
            balls = list(K.exact_lengths(self.bits))
        digits = int(_DIGITS_PER_BIT * self.bits) + 1
        return {
            **surface,
            "meant": "the exact lengths, one in each ball; the doubles are those rounded",
            "edge": K.edge.tolist(),
            "exact_lengths": [ball_in_text(x, digits) for x in balls],
        }

    @classmethod
    def from_json(cls, document: Mapping[str, Any] | str) -> PeriodEnclosure:
        """Read such a document, or its text; its balls contain those that were written.

        Exact lengths are no longer functions of the precision then, and are left in the document.

        Raises
        ------
        ValueError
            If it is none.
        """
        try:
            data = json.loads(document) if isinstance(document, str) else document
            if data["kind"] != "period enclosure" or data["schema"] != SCHEMA:
                raise KeyError("kind or schema")
            K = DeltaComplex.from_gluing(data["surface"]["lengths"], data["surface"]["twin"])
            n, bits = 2 * int(data["genus"]), int(data["bits"])
            with flint.ctx.workprec(bits):
                entries = [ball_from_text(x) for row in data["dirichlet"] for x in row]
            sparse = data["cocycles"]
            cocycles = csr_array(
                (
                    np.array(sparse["value"], dtype=np.int64),
                    (np.array(sparse["row"], np.int64), np.array(sparse["edge"], np.int64)),
                ),
                shape=(n, K.n_edges),
            )
            return cls(flint.arb_mat(n, n, entries), cocycles, K, bits)
        except (KeyError, TypeError, IndexError) as error:
            raise ValueError(f"this document holds no period enclosure ({error}).") from error

    def __reduce__(self) -> tuple[Any, ...]:
        # python-flint's matrices do not pickle; as integers they do.
        exact = [to_integers(x) for x in self.dirichlet.entries()]
        return _unpickled, (exact, self.cocycles, self.complex, self.bits)

    def __repr__(self) -> str:
        text = f"PeriodEnclosure of genus {self.genus}, {self.digits} digits proved"
        return "\n".join([text, *(f"  {row}" for row in self._rows())])

    def _repr_html_(self) -> str:
        facts = [("genus", self.genus), ("proved digits", self.digits)]
        matrix = [lines_html("the matrix", self._rows())] if self.genus else []
        return facts_html("Period matrix in balls", facts, *matrix)

    def _rows(self) -> list[str]:
        return ball_matrix_lines(self.matrix, min(self.digits, readable_digits(self.genus)))

    def _repr_latex_(self) -> str:
        rows = [
            " & ".join(_in_latex(self.matrix[i, j], self.digits) for j in range(self.genus))
            for i in range(self.genus)
        ]
        body = " \\\\ ".join(rows)
        return f"$\\Pi = \\begin{{pmatrix}} {body} \\end{{pmatrix}}$"


def _unpickled(
    exact: list[tuple[int, int, int, int]], cocycles: csr_array, K: DeltaComplex, bits: int
) -> PeriodEnclosure:
    n = int(cocycles.shape[0])
    D = flint.arb_mat(n, n, [from_integers(*x) for x in exact])
    return PeriodEnclosure(D, cocycles, K, bits)


def _midpoint(Pi: flint.acb_mat) -> NDArray[np.complex128]:
    g = Pi.nrows()
    entries = [complex(z.mid()) for z in Pi.entries()]
    return np.array(entries, dtype=np.complex128).reshape(g, g)


def _as_balls(Pi: ArrayLike | flint.acb_mat, g: int) -> flint.acb_mat:
    shape = (Pi.nrows(), Pi.ncols()) if isinstance(Pi, flint.acb_mat) else np.shape(Pi)
    if shape != (g, g):
        raise ValueError(f"a period matrix of genus {g} has shape {(g, g)}, not {shape}.")
    if isinstance(Pi, flint.acb_mat):
        return Pi
    return flint.acb_mat(g, g, [flint.acb(complex(z)) for z in np.asarray(Pi).ravel().tolist()])


def _texts(A: flint.arb_mat, digits: int) -> list[list[str]]:
    return [[ball_in_text(x, digits) for x in row] for row in A.tolist()] if A.nrows() else []


def _in_latex(z: flint.acb, digits: int) -> str:
    """A complex number with the digits that are known."""
    real, imag = (_known_digits(x, digits) for x in (z.real, z.imag))
    if real == "0":
        return f"{imag}\\,i"
    if imag == "0":
        return real
    return f"{real}{'' if imag.startswith('-') else '+'}{imag}\\,i"


def _known_digits(x: flint.arb, digits: int) -> str:
    mantissa, _, exponent = ball_digits(x, digits + 20).partition("e")
    return f"{mantissa} \\cdot 10^{{{int(exponent)}}}" if exponent else mantissa
