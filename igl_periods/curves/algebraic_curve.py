r"""An algebraic curve as it is found from a period matrix: balls, and what is recognised in them.

========================  ==================================  ====================================
model                     equation                            invariants
========================  ==================================  ====================================
``elliptic``              y² = x³ + A x + B                   j
``hyperelliptic``         y² = f(x)                           Igusa–Clebsch, Shioda
``plane quartic``         F(x, y, z) = 0                      Dixmier–Ohno
``unknown``               none is computed                    none
========================  ==================================  ====================================

Invariants are balls that contain those of the exact curve, up to the common scale of their degrees;
two curves with different ones are proved to be different.  Coefficients are recognised and not
proved.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeAlias

import flint

from igl_periods.display import ball_digits, facts_html
from igl_periods.recognition import (
    AlgebraicNumber,
    Evidence,
    NumberField,
    generated_field,
    recognise_number,
)

from .stored_balls import restored, stored
from .weighted_points import absolute_invariants, same_point, vanishes

Exponents: TypeAlias = tuple[int, ...]

_SHOWN_DIGITS = 12
_INVARIANT_DEGREE = 10


@dataclass(frozen=True, eq=False)
class AlgebraicCurve:
    """A curve whose period matrix lies in given balls.

    Attributes
    ----------
    genus : int
    model : {"elliptic", "hyperelliptic", "plane quartic", "unknown"}
    coefficients : dict
        From exponents, (k,) of x^k or (i, j, k) of x^i y^j z^k, to balls.  Of a recognised equation
        the balls of its coefficients; otherwise those of the curve in the coordinates that
        ``remarks`` tell.
    recognised : dict
        From the same exponents to an ``AlgebraicNumber``, or None.
    invariants : dict
        From names to balls.
    weights : tuple of int
        The degrees of the invariants; 0 of j.
    branch_points : tuple of (x, z)
        Of a hyperelliptic curve, in balls; the first three are 1, 0, ∞.
    vanishing_theta_constants : int or None
        How many even theta constants vanish within their balls; None if they are not computed.
    digits : int
        Decimal digits to which the period matrix is known.
    proved : bool
        Whether the balls contain the exact period matrix, not only what an array is taken to be.
    remarks : tuple of str
    """

    genus: int
    model: str
    coefficients: Mapping[Any, flint.acb]
    recognised: Mapping[Any, AlgebraicNumber | None]
    invariants: Mapping[str, flint.acb]
    weights: tuple[int, ...]
    branch_points: tuple[tuple[flint.acb, flint.acb], ...] = ()
    vanishing_theta_constants: int | None = None
    digits: int = 0
    proved: bool = True
    remarks: tuple[str, ...] = field(default=())

    @property
    def is_hyperelliptic(self) -> bool | None:
        """Whether the curve is a double cover of the line; None if that is not found out.

        False is proved; True means that the theta constants that have to vanish may.
        """
        return (
            None
            if self.model == "unknown" and self.genus > LARGEST_DECIDED
            else (self.model in ("elliptic", "hyperelliptic"))
        )

    @property
    def is_recognised(self) -> bool:
        """Whether all coefficients of the equation are recognised; not proved."""
        return bool(self.recognised) and None not in self.recognised.values()

    @cached_property
    def field(self) -> NumberField | None:
        """The field of the recognised coefficients."""
        return generated_field(self._numbers()) if self.is_recognised else None

    @cached_property
    def absolute_invariants(self) -> dict[str, flint.acb]:
        """Invariants of degree 0, in balls: rational functions on the moduli space."""
        if not self.invariants or self.weights == (0,):
            return dict(self.invariants)
        with flint.ctx.workprec(self._bits):
            values = absolute_invariants(list(self.invariants.values()), self.weights)
        return dict(zip(self.invariants, values, strict=True))

    @cached_property
    def recognised_invariants(self) -> dict[str, AlgebraicNumber | None]:
        """The absolute invariants as algebraic numbers, where they are recognised."""
        with flint.ctx.workprec(self._bits):
            return {
                name: _ZERO if vanishes(z) else recognise_number(z, degree=_INVARIANT_DEGREE)
                for name, z in self.absolute_invariants.items()
            }

    @cached_property
    def field_of_moduli(self) -> NumberField | None:
        """The field of the absolute invariants, if they or an equation over Q are recognised."""
        if self.field is not None and self.field.degree == 1:
            return self.field
        numbers = list(self.recognised_invariants.values())
        known = [x for x in numbers if x is not None]
        return generated_field(known) if numbers and len(known) == len(numbers) else None

    @property
    def _bits(self) -> int:
        """The precision of the balls, which the precision of the moment must not lower."""
        return max((z.bits() for z in self.invariants.values()), default=flint.ctx.prec)

    @property
    def evidence(self) -> Evidence | None:
        """What speaks for the recognised coefficient for which least speaks."""
        found = [x.evidence for x in self._numbers() if x.evidence is not None]
        return min(found, key=lambda evidence: evidence.left_over, default=None)

    def same_invariants(self, other: AlgebraicCurve) -> bool:
        """Whether the invariants of two curves agree within their balls; False is proved.

        Raises
        ------
        ValueError
            If both have the same genus and model, and no invariants are computed for these.
        """
        if (self.genus, list(self.invariants)) != (other.genus, list(other.invariants)):
            return False
        if not self.invariants and self.model == other.model:
            raise ValueError(f"no invariants are computed of curves ({self.model}) of this genus")
        if self.weights == (0,):
            return bool(self.invariants["j"].overlaps(other.invariants["j"]))
        one, two = list(self.invariants.values()), list(other.invariants.values())
        with flint.ctx.workprec(max(self._bits, other._bits)):
            return same_point(one, two, self.weights)

    @property
    def equation(self) -> str:
        """The equation in words of a computer algebra system, with recognised numbers if there are.

        Digits of coefficients that are not recognised are those that are known, at most 12.
        """
        if not self.coefficients:
            return "no equation is computed"
        text = polynomial_text(self._texts(), ("x", "y", "z"))
        return f"{text} = 0" if self.model == "plane quartic" else f"y^2 = {text}"

    def _texts(self) -> dict[Exponents, str]:
        if self.is_recognised:
            numbers = {e: x for e, x in self.recognised.items() if x is not None}
            return {e: str(x) for e, x in numbers.items() if x.polynomial != (0, 1)}
        return {e: _digits(z) for e, z in self.coefficients.items() if not vanishes(z)}

    def _numbers(self) -> list[AlgebraicNumber]:
        return [x for x in self.recognised.values() if x is not None]

    def __repr__(self) -> str:
        return "\n".join([f"AlgebraicCurve of genus {self.genus}, {self.model}", *self._lines()])

    def _lines(self) -> list[str]:
        return [f"  {name}: {value}" for name, value in self.facts()]

    def facts(self) -> list[tuple[str, str]]:
        """What is known, in words."""
        facts = [("equation", self.equation)]
        if self.is_recognised:
            facts += [("over", str(self.field or "a field of large degree"))]
            facts += [("recognised, not proved", str(self.evidence))] if self.evidence else []
        elif self.coefficients:
            facts += [("coefficients", "in balls, not recognised")]
        return facts + [("remark", remark) for remark in self.remarks]

    def _repr_html_(self) -> str:
        return facts_html(f"Algebraic curve of genus {self.genus}", self.facts())

    def __reduce__(self) -> tuple[Any, ...]:
        # Balls do not pickle; as integers they do.
        names = self.__dataclass_fields__
        return _restored_curve, (stored({name: getattr(self, name) for name in names}),)


LARGEST_DECIDED = 5
_ZERO = AlgebraicNumber((0, 1), 0j)


def _restored_curve(fields: Any) -> AlgebraicCurve:
    return AlgebraicCurve(**restored(fields))


def polynomial_text(coefficients: Mapping[Any, str], names: tuple[str, ...]) -> str:
    """A polynomial, highest powers first.

    Examples
    --------
    >>> polynomial_text({(5,): "1", (1,): "-1", (0,): "2 + i"}, ("x",))
    'x^5 - x + (2 + i)'
    """
    text = ""
    for exponents in sorted(coefficients, reverse=True):
        pairs = zip(names, exponents, strict=False)
        monomial = "*".join(n if k == 1 else f"{n}^{k}" for n, k in pairs if k)
        c = coefficients[exponents]
        compound = any(sign in c[1:].replace("e-", "").replace("e+", "") for sign in "+-")
        c = f"({c})" if compound else c
        sign, c = ("-", c[1:]) if c.startswith("-") else ("+", c)
        term = monomial if c == "1" and monomial else "*".join(filter(None, (c, monomial)))
        joint = f" {sign} " if text else ("-" if sign == "-" else "")
        text += joint + term
    return text or "0"


def _digits(z: flint.acb) -> str:
    real, imag = (ball_digits(x, _SHOWN_DIGITS) for x in (z.real, z.imag))
    if imag == "0":
        return real
    return f"{imag}*i" if real == "0" else f"{real} {imag if imag[0] == '-' else '+' + imag}*i"
