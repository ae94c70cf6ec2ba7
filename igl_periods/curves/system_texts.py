r"""Numbers, matrices and curves as text for LaTeX, Sage, Magma and PARI/GP.

Balls stay balls as far as the system has them.

============  =====================================================================================
LaTeX         the digits that are known; recognised numbers with roots
Sage          ``ComplexBallField``: midpoint and radius, ``CBF(RBF("m +/- r"), RBF("m +/- r"))``
Magma         midpoints over ``ComplexField(n)``; the largest radius in a comment
PARI/GP       midpoints with n digits; the largest radius in a comment
============  =====================================================================================

A ball is written in decimals, rounded outwards, so that a system that has balls reads one that
contains it.  A curve whose coefficients are recognised is written over its field, Q or Q(a).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any

import flint
import numpy as np

from igl_periods.display import ball_digits
from igl_periods.enclosures import ball_in_text
from igl_periods.recognition import AlgebraicNumber, NumberField, in_radicals
from igl_periods.siegel import balls_of, bits_of, to_flint

from .algebraic_curve import AlgebraicCurve, polynomial_text

_DIGITS_PER_BIT = 0.30102999566
_NAMES = ("x", "y", "z")


def to_latex(x: Any) -> str:
    r"""A number, a matrix, a period matrix or a curve in LaTeX, without dollars.

    Raises
    ------
    TypeError
        If it is none of these.

    Examples
    --------
    >>> to_latex(flint.acb(0, 1))
    '\\mathrm{i}'
    """
    if isinstance(x, AlgebraicCurve):
        texts = {e: _latex_coefficient(x, e) for e in _shown(x)}
        text = re.sub(r"\^(\d+)", r"^{\1}", polynomial_text(texts, _NAMES)).replace("*", " ")
        return f"{text} = 0" if x.model == "plane quartic" else f"y^2 = {text}"
    if isinstance(x, AlgebraicNumber):
        return _latex_number(x)
    if isinstance(x, (flint.acb, flint.arb, int, float, complex)):
        return _latex_ball(flint.acb(x))
    return _matrix(x, _latex_ball, r"\begin{pmatrix} ", " & ", r" \\ ", r" \end{pmatrix}")


def to_sage(x: Any) -> str:
    """The same for Sage; balls as ``ComplexBallField`` elements.

    Raises
    ------
    TypeError
        If it is none of these.
    """
    if isinstance(x, AlgebraicCurve):
        return _sage_curve(x)
    bits = _bits(x)
    head = f"RBF = RealBallField({bits})\nCBF = ComplexBallField({bits})\n"
    if isinstance(x, AlgebraicNumber):
        polynomial = polynomial_text(_univariate(x.polynomial), ("x",))
        return f"QQbar.polynomial_root(QQ['x']('{polynomial}'), {_box(x)})"
    if isinstance(x, (flint.acb, flint.arb)):
        return head + _sage_ball(flint.acb(x))
    return head + _matrix(x, _sage_ball, "matrix(CBF, [[", ", ", "],\n  [", "]])")


def to_magma(x: Any) -> str:
    """The same for Magma: midpoints over a complex field of so many digits.

    Raises
    ------
    TypeError
        If it is none of these.
    """
    if isinstance(x, AlgebraicCurve):
        return _magma_curve(x)
    if isinstance(x, AlgebraicNumber):
        polynomial = polynomial_text(_univariate(x.polynomial), ("t",))
        head = "P<t> := PolynomialRing(Rationals());\n"
        return f"{head}Roots({polynomial}, ComplexField(30)); // near {x.near}"
    digits = _digits_of(x)
    head = f"C<i> := ComplexField({digits});\n"
    entry = _midpoint_text(digits, "i")
    if isinstance(x, (flint.acb, flint.arb)):
        return f"{head}{entry(flint.acb(x))}; // radius {_radius([flint.acb(x)])}"
    body = _matrix(x, entry, "Matrix(C, [[", ", ", "],\n  [", "]]);")
    return f"{head}{body} // radius {_radius(_balls(x).entries())}"


def to_pari(x: Any) -> str:
    """The same for PARI/GP: midpoints with so many digits.

    Raises
    ------
    TypeError
        If it is none of these.
    """
    if isinstance(x, AlgebraicCurve):
        return _pari_curve(x)
    if isinstance(x, AlgebraicNumber):
        polynomial = polynomial_text(_univariate(x.polynomial), ("x",))
        return f"polroots({polynomial}) \\\\ near {x.near}"
    digits = _digits_of(x)
    head, entry = f"default(realprecision, {digits});\n", _midpoint_text(digits, "I")
    if isinstance(x, (flint.acb, flint.arb)):
        return f"{head}{entry(flint.acb(x))} \\\\ radius {_radius([flint.acb(x)])}"
    body = _matrix(x, entry, "[", ", ", "; ", "]")
    return f"{head}{body} \\\\ radius {_radius(_balls(x).entries())}"


def _shown(curve: AlgebraicCurve) -> list[tuple[int, ...]]:
    return [e for e, z in curve.coefficients.items() if not (z.contains(0) and z.is_exact())]


def _latex_coefficient(curve: AlgebraicCurve, e: tuple[int, ...]) -> str:
    number = curve.recognised.get(e) if curve.is_recognised else None
    return _latex_ball(curve.coefficients[e]) if number is None else _latex_number(number)


def _latex_number(x: AlgebraicNumber) -> str:
    surd = in_radicals(x)
    return str(surd.latex()) if surd is not None else _latex_ball(flint.acb(x.near))


def _latex_ball(z: flint.acb) -> str:
    real, imag = (_latex_real(x) for x in (z.real, z.imag))
    if imag == "0":
        return real
    unit = {"1": r"\mathrm{i}", "-1": r"-\mathrm{i}"}.get(imag, rf"{imag}\,\mathrm{{i}}")
    if real == "0":
        return unit
    return real + (unit if unit.startswith("-") else f"+{unit}")


def _latex_real(x: flint.arb) -> str:
    if x.is_exact() and x == x.floor() and abs(x) < 1e9:
        return str(int(float(x)))
    text = ball_digits(x, int(_DIGITS_PER_BIT * max(x.bits(), flint.ctx.prec)))
    mantissa, _, exponent = text.partition("e")
    return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa


def _matrix(x: Any, entry: Callable[[flint.acb], str], *marks: str) -> str:
    """Rows of texts between an opening mark, two separators and a closing mark."""
    opening, between, rows, closing = marks
    lines = [between.join(entry(z) for z in row) for row in _balls(x).tolist()]
    return opening + rows.join(lines) + closing


def _balls(x: Any) -> flint.acb_mat:
    balls = balls_of(x)
    if balls is not None:
        return balls
    if isinstance(x, flint.arb_mat):
        return flint.acb_mat(x)
    if hasattr(x, "entry_bounds"):
        return to_flint(x)
    array = np.asarray(x)
    if array.ndim != 2 or array.dtype.kind not in "biufc":
        raise TypeError(f"a number, a matrix or a curve is written, not {type(x).__name__}")
    return flint.acb_mat([[flint.acb(complex(z)) for z in row] for row in array.tolist()])


def _bits(x: Any) -> int:
    if isinstance(x, (flint.acb, flint.arb)):
        return max(x.bits(), flint.ctx.prec)
    return bits_of(x) if balls_of(x) is not None else 53


def _digits_of(x: Any) -> int:
    """Decimal digits that lose nothing of what is known."""
    return int(_DIGITS_PER_BIT * _bits(x)) + 2


def _sage_ball(z: flint.acb) -> str:
    digits = int(_DIGITS_PER_BIT * max(z.bits(), flint.ctx.prec)) + 2
    parts = (ball_in_text(x, digits).strip("[]") for x in (z.real, z.imag))
    return "CBF({}, {})".format(*(f'RBF("{text}")' for text in parts))


def _midpoint_text(digits: int, unit: str) -> Callable[[flint.acb], str]:
    def text(z: flint.acb) -> str:
        real, imag = (str(x.mid().str(digits, radius=False)) for x in (z.real, z.imag))
        return f"{real} + {unit}*({imag})"

    return text


def _radius(entries: list[flint.acb]) -> str:
    radius = flint.arb(0)
    for z in entries:
        radius = radius.max(z.real.rad()).max(z.imag.rad())
    return str((radius * flint.arb("1.01")).upper().str(2, radius=False))


def _univariate(polynomial: tuple[int, ...]) -> dict[tuple[int, ...], str]:
    return {(k,): str(c) for k, c in enumerate(polynomial) if c}


def _box(x: AlgebraicNumber) -> str:
    z = x.ball(64)
    parts = [(float(p.lower()), float(p.upper())) for p in (z.real, z.imag)]
    widened = [f"RIF({low - 1e-12!r}, {high + 1e-12!r})" for low, high in parts]
    return f"CIF({', '.join(widened)})"


def _over_field(curve: AlgebraicCurve) -> dict[tuple[int, ...], str] | None:
    """Coefficients as polynomials in a generator a of their field; None if it is not known."""
    field: NumberField | None = curve.field
    if field is None:
        return None
    texts = {}
    for e, number in curve.recognised.items():
        if number is not None and number.polynomial != (0, 1):
            powers = {(k,): str(q) for k, q in enumerate(field.coordinates(number)) if q}
            texts[e] = polynomial_text(powers, ("a",))
    return texts


def _curve_text(
    curve: AlgebraicCurve, declared: Callable[[str], str], entry: Callable[[flint.acb], str]
) -> tuple[str, str, bool]:
    """Declarations, the polynomial, and whether it is exact."""
    texts = _over_field(curve)
    if texts is None:
        return "", _joined({e: entry(curve.coefficients[e]) for e in _shown(curve)}), False
    field = curve.field
    head = ""
    if field is not None and field.degree > 1:
        head = declared(polynomial_text(_univariate(field.polynomial), ("t",)))
    return head, polynomial_text(texts, _NAMES), True


def _joined(texts: Mapping[tuple[int, ...], str]) -> str:
    return " + ".join(
        "*".join([f"({c})", *(f"{n}^{k}" for n, k in zip(_NAMES, e, strict=False) if k)])
        for e, c in sorted(texts.items(), reverse=True)
    )


def _sage_curve(curve: AlgebraicCurve) -> str:
    bits = max((z.bits() for z in curve.coefficients.values()), default=53)
    head, body, exact = _curve_text(
        curve, lambda p: f"t = polygen(QQ)\nK.<a> = NumberField({p})\n", _sage_ball
    )
    if not exact:
        head = f"RBF = RealBallField({bits})\nCBF = ComplexBallField({bits})\n"
    base = "CBF" if not exact else ("K" if head else "QQ")
    if curve.model == "plane quartic":
        tail = f"R.<x,y,z> = PolynomialRing({base})\nF = {body}\n"
        return head + tail + ("C = Curve(F)\n" if exact else "")
    tail = f"R.<x> = PolynomialRing({base})\nf = {body}\n"
    return head + tail + ("C = HyperellipticCurve(f)\n" if exact else "")


def _magma_curve(curve: AlgebraicCurve) -> str:
    digits = max((int(z.bits() * _DIGITS_PER_BIT) for z in curve.coefficients.values()), default=16)
    head, body, exact = _curve_text(
        curve,
        lambda p: f"P<t> := PolynomialRing(Rationals());\nK<a> := NumberField({p});\n",
        _midpoint_text(digits + 2, "i"),
    )
    if not exact:
        radius = _radius(list(curve.coefficients.values()))
        head = f"C<i> := ComplexField({digits + 2}); // radius {radius}\n"
    base = "C" if not exact else ("K" if head else "Rationals()")
    if curve.model == "plane quartic":
        tail = f"A<x,y,z> := ProjectiveSpace({base}, 2);\n"
        return head + tail + (f"X := Curve(A, {body});\n" if exact else f"F := {body};\n")
    tail = f"R<x> := PolynomialRing({base});\nf := {body};\n"
    return head + tail + ("X := HyperellipticCurve(f);\n" if exact else "")


def _pari_curve(curve: AlgebraicCurve) -> str:
    digits = max((int(z.bits() * _DIGITS_PER_BIT) for z in curve.coefficients.values()), default=16)
    head, body, exact = _curve_text(
        curve, lambda p: f"a = Mod(t, {p});\n", _midpoint_text(digits + 2, "I")
    )
    if not exact:
        radius = _radius(list(curve.coefficients.values()))
        head = f"default(realprecision, {digits + 2}); \\\\ radius {radius}\n"
    return f"{head}f = {body};\n"
