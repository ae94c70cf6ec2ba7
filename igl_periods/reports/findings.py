"""What a period matrix says about its surface: invariants, symmetries, and named surfaces near it.

Digits of invariants are shown as far as the bound of the matrix proves them.
"""

from __future__ import annotations

import flint

from igl_periods.display import ball_digits, known_digits
from igl_periods.errors import EnumerationLimitError
from igl_periods.moduli import (
    absolute_igusa_invariants,
    certified_j_invariant,
    j_invariant,
    symplectic_automorphism_group,
)
from igl_periods.periods import PeriodMatrix
from igl_periods.surfaces import identify

# Beyond, the search for symmetries may take minutes.
_LARGEST_SEARCHED = 5
_DIGITS = 12
_UNPROVED = " (of the matrix as it is computed: the bound proves no digit)"
_TOO_LARGE = f"not searched for beyond genus {_LARGEST_SEARCHED}"


def invariants(pm: PeriodMatrix) -> list[tuple[str, str]]:
    """Names and values of the invariants of a surface of genus 1 or 2."""
    if pm.genus == 1:
        return [("Klein's j", _klein(pm))]
    if pm.genus == 2:
        names = ("I_2^5 / I_10", "I_2^3 I_4 / I_10", "I_2^2 I_6 / I_10")
        return list(zip(names, _igusa(pm)))
    return []


def _klein(pm: PeriodMatrix) -> str:
    certified = certified_j_invariant(pm) if pm.certified else None
    if certified is None:
        return f"about {_complex(j_invariant(pm.matrix))}{_UNPROVED}"
    j, error = certified
    real, imaginary = known_digits(j.real, error), known_digits(j.imag, error)
    return real if imaginary == "0" else f"{real} + {imaginary} i".replace("+ -", "− ")


def _igusa(pm: PeriodMatrix) -> list[str]:
    values = absolute_igusa_invariants(pm.matrix)
    if values is None:
        return 3 * ["none: the surface cannot be told from a product of two elliptic curves"]
    balls = absolute_igusa_invariants(pm.to_flint()) if pm.certified else None
    if balls is None or not all(_has_digits(z) for z in balls):
        return [f"about {_complex(complex(z))}{_UNPROVED}" for z in values]
    return [_ball(z) for z in balls]


def _has_digits(z: flint.acb) -> bool:
    return bool(z.is_finite()) and (z.contains(0) or ball_digits(z.real, _DIGITS) != "0")


def _ball(z: flint.acb) -> str:
    real, imaginary = ball_digits(z.real, _DIGITS), ball_digits(z.imag, _DIGITS)
    return real if imaginary == "0" else f"{real} + {imaginary} i".replace("+ -", "− ")


def _complex(z: complex) -> str:
    size = abs(z)
    if abs(z.imag) < 1e-6 * size:
        return f"{z.real:.4g}"
    return f"{z.real:.4g} + {z.imag:.4g} i".replace("+ -", "− ")


def symmetries(pm: PeriodMatrix) -> list[tuple[str, str]]:
    """What the automorphisms of the period matrix are, within its bound."""
    if not 0 < pm.genus <= _LARGEST_SEARCHED:
        return [("symmetries of the period matrix", _TOO_LARGE)] if pm.genus else []
    try:
        group = symplectic_automorphism_group(pm)
    except (EnumerationLimitError, ValueError) as error:
        return [("symmetries of the period matrix", f"not decided: {error}")]
    answer = {True: "yes", False: "no", None: "not decided"}[group.hyperelliptic]
    return [
        ("γ in Sp(2g, Z) with γ · Π = Π, within the bound", str(group.order)),
        ("symmetries that reverse the orientation", str(len(group.reversing))),
        ("hyperelliptic", answer),
    ]


def named_surfaces(pm: PeriodMatrix) -> list[tuple[str, str]]:
    """Named surfaces near the period matrix, and what may be said about each."""
    if pm.genus == 0:
        return []
    try:
        found = identify(pm)
    except ValueError as error:
        return [("named surfaces", f"not compared: {error}")]
    if not found.compared:
        return [("named surfaces", "none of this genus is in the catalogue")]
    if not found:
        return [("named surfaces", f"none near Π, of {len(found.compared)} compared")]
    return [(match.surface.name, match.claim) for match in found]
