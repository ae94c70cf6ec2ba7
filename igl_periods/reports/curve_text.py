"""An algebraic curve for the terminal and for programs: what is proved, and what is recognised."""

from __future__ import annotations

import textwrap
from typing import Any

import flint

from igl_periods.curves import AlgebraicCurve
from igl_periods.display import ball_digits
from igl_periods.enclosures import ball_in_text
from igl_periods.recognition import AlgebraicNumber

_WIDTH = 92
_DIGITS = 12


def curve_summary(curve: AlgebraicCurve) -> str:
    """The equation, its field, invariants, and which of this is proved."""
    lines = [f"Curve of genus {curve.genus}, {curve.model}:", "", f"    {curve.equation}", ""]
    facts = [fact for fact in curve.facts() if fact[0] != "equation"]
    field = curve.field_of_moduli
    facts += [("field of moduli, recognised", str(field))] if field is not None else []
    lines += [
        textwrap.fill(f"{name}: {value}", _WIDTH, subsequent_indent="    ") for name, value in facts
    ]
    if curve.invariants:
        lines += ["", "Absolute invariants:", "", *(f"    {row}" for row in invariant_lines(curve))]
    return "\n".join(lines)


def invariant_lines(curve: AlgebraicCurve) -> list[str]:
    """Absolute invariants, a line each: digits that are known, and the number that is recognised.

    Those that vanish within their balls are named together.
    """
    recognised, zero, lines = curve.recognised_invariants, [], []
    for name, z in curve.absolute_invariants.items():
        if z.contains(0):
            zero.append(name)
            continue
        number = recognised[name]
        known = f"recognised as {number}" if number is not None else "not recognised"
        lines.append(f"{name} = {_digits(z)}, {known}")
    if zero:
        lines.append(f"{', '.join(zero)}: 0 within the balls")
    return lines


def curve_to_json(curve: AlgebraicCurve) -> dict[str, Any]:
    """A document: balls as text, recognised numbers by their minimal polynomials."""
    evidence = curve.evidence
    return {
        "genus": curve.genus,
        "model": curve.model,
        "equation": curve.equation,
        "digits": curve.digits,
        "proved_balls": curve.proved,
        "coefficients": [
            {
                "exponents": list(exponents),
                "ball": _ball(z),
                "recognised": number_to_json(curve.recognised.get(exponents)),
            }
            for exponents, z in curve.coefficients.items()
        ],
        "field": None if curve.field is None else str(curve.field),
        "evidence": None
        if evidence is None
        else {"digits": evidence.digits, "left_over": evidence.left_over},
        "invariants": {name: _ball(z) for name, z in curve.invariants.items()},
        "absolute_invariants": {
            name: {
                "ball": _ball(z),
                "recognised": number_to_json(curve.recognised_invariants[name]),
            }
            for name, z in curve.absolute_invariants.items()
        },
        "vanishing_theta_constants": curve.vanishing_theta_constants,
        "remarks": list(curve.remarks),
    }


def number_to_json(number: AlgebraicNumber | None) -> dict[str, Any] | None:
    """The minimal polynomial c_0, …, c_n, which root is meant, and the number in words."""
    if number is None:
        return None
    near = complex(number)
    return {
        "polynomial": list(number.polynomial),
        "near": [near.real, near.imag],
        "text": str(number),
    }


def _ball(z: flint.acb) -> dict[str, str]:
    digits = max(int(z.bits() * 0.30103) + 2, 3)
    return {"real": ball_in_text(z.real, digits), "imag": ball_in_text(z.imag, digits)}


def _digits(z: flint.acb) -> str:
    real, imag = (ball_digits(x, _DIGITS) for x in (z.real, z.imag))
    if imag == "0":
        return real
    return f"{imag} i" if real == "0" else f"{real} {'' if imag[0] == '-' else '+'}{imag} i"
