r"""From a period matrix to the equation of its curve.

====================  =============================================================================
genus 1               j, and a Weierstrass equation
genus 2               branch points from theta constants, sextics, Mestre's conic
genus 3               one vanishing even theta constant: branch points, an octic; none: the plane
                      quartic of the bitangents
genus 4 and 5         hyperelliptic if the pattern of vanishing theta constants is that of Thomae
beyond                nothing: 2^{g−1}(2^g + 1) theta constants
====================  =============================================================================

Everything is computed in balls from Π reduced; recognition comes last.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import flint
import numpy as np

from igl_periods.errors import CurveError
from igl_periods.moduli import ReducedBalls, reduced_balls, symplectic_automorphism_group
from igl_periods.options import checked_integer
from igl_periods.recognition import AlgebraicNumber, recognise_number
from igl_periods.riemann_theta import spin_structures
from igl_periods.run_log import stage
from igl_periods.siegel import PRECISION, ball_matrix, balls_of, check_siegel_point

from .algebraic_curve import LARGEST_DECIDED, AlgebraicCurve
from .binary_forms import Form, Point, form_of_points, igusa_clebsch_of_sextic, shioda_invariants
from .branch_points import branch_points, number_vanishing, vanishing_even
from .elliptic_models import minimal_coefficients, rational, weierstrass_coefficients
from .hyperelliptic_models import RecognisedForm, model_of_branch_points
from .mestre_models import mestre_sextic
from .plane_quartics import bitangents, plane_quartic
from .quartic_models import in_bitangents, model_of_quartic
from .ternary_forms import DIXMIER_OHNO_WEIGHTS, TernaryForm, dixmier_ohno_invariants

DEGREE = 6
_DIGITS_PER_BIT = math.log10(2.0)
_IGUSA = ("I2", "I4", "I6", "I10")
_SHIODA = tuple(f"J{n}" for n in range(2, 11))
_OHNO = (
    "I3", "I6", "I9", "J9", "I12", "J12", "I15", "J15", "I18", "J18", "I21", "J21",
)  # fmt: skip
_THREE_POINTS = "coordinates in which three branch points are 1, 0, ∞"


def curve(Pi: Any, *, degree: int = DEGREE) -> AlgebraicCurve:
    """The algebraic curve of a period matrix.

    Parameters
    ----------
    Pi : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat
        Best in balls of 50 digits: ``ip.enclose(surface, digits=50)``.  A ``PeriodMatrix`` is known
        within its certificate, a plain array is taken to be right to 1e-8: enough for invariants
        of a few digits, seldom for coefficients.
    degree : int
        The largest degree of an algebraic number that is tried for coefficients.

    Returns
    -------
    AlgebraicCurve
        Its invariants are balls that contain those of the curve; its coefficients are recognised,
        which is not a proof.

    Raises
    ------
    CurveError
        For a sphere; for a ``PeriodMatrix`` without a certificate; for a period matrix of a product
        of lower genera, which is that of no curve, or one so near that its balls cannot tell.
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.
    ValueError
        If the degree is not a positive integer.

    Examples
    --------
    >>> import flint
    >>> with flint.ctx.workdps(40):
    ...     root = flint.arb(3).sqrt()
    ...     Pi = flint.acb_mat([[2, -1], [-1, 2]]) * (flint.acb(0, 1) / root)
    ...     curve(Pi).equation
    'y^2 = x^6 - 1'
    """
    genus = len(check_siegel_point(Pi))
    degree = checked_integer("degree", degree)
    if degree < 1:
        raise ValueError(f"degree = {degree}: algebraic numbers have a degree of 1 and more")
    if genus == 0:
        raise CurveError("the surface is a sphere (genus 0): its curve is the projective line")
    reduced = _reduced(Pi)
    known = {"genus": genus, "digits": _digits_known(reduced), "proved": reduced.proved}
    with flint.ctx.workprec(reduced.bits):
        if genus == 1:
            return _elliptic(reduced.matrix[0, 0].modular_j(), degree, known)
        if genus > LARGEST_DECIDED:
            return _unknown(known, None)
        with stage("theta constants"):
            constants = reduced.matrix.theta(flint.acb_mat(genus, 1)).entries()
        table = flint.acb_mat(2**genus, 2**genus, constants)
        vanishing = len(vanishing_even(table))
        known["vanishing_theta_constants"] = vanishing
        if vanishing == number_vanishing(genus):
            return _hyperelliptic(branch_points(table), degree, known)
        if genus == 3 and vanishing == 0:
            return _quartic(reduced, degree, known)
        if genus <= 3:
            raise CurveError(_no_curve(vanishing, genus))
        return _unknown(known, vanishing)


def _reduced(Pi: Any) -> ReducedBalls:
    """Π in balls, reduced: of floating point within the certificate, if there is one."""
    if balls_of(Pi) is not None or not hasattr(Pi, "entry_bounds"):
        return reduced_balls(Pi)
    reduced = Pi.reduced()
    if reduced.entry_bounds is None:
        raise CurveError("a period matrix without a certificate: take its array, pm.matrix")
    balls = ball_matrix(reduced.matrix, reduced.entry_bounds)
    # The marking does not matter to the curve.
    marking = np.eye(2 * len(reduced.matrix), dtype=np.int64)
    return ReducedBalls(balls, marking, PRECISION, bool(Pi.rigorous))


def curve_of_form(
    f: Sequence[Any] | Mapping[tuple[int, int, int], Any], *, digits: int = 50
) -> AlgebraicCurve:
    """The curve y² = f(x), or the plane quartic F = 0, with known coefficients, for comparison.

    Parameters
    ----------
    f : sequence of int, fmpq or acb, or mapping
        f_0, …, f_{2g+2}, the last 0 for an odd degree; or from exponents (i, j, k) of x^i y^j z^k,
        i + j + k = 4, to coefficients.
    digits : int

    Raises
    ------
    ValueError
        If there are not 7 or 9 coefficients, or F is not a quartic.

    Examples
    --------
    >>> curve_of_form({(4, 0, 0): 1, (0, 4, 0): 1, (0, 0, 4): 1}).equation
    'x^4 + y^4 + z^4 = 0'
    """
    if isinstance(f, Mapping):
        return _quartic_of_form(f, digits)
    if len(f) not in (7, 9):
        raise ValueError(f"a sextic or an octic has 7 or 9 coefficients, not {len(f)}")
    with flint.ctx.workdps(digits):
        form = [flint.acb(c) for c in f]
        names, weights, invariants = _invariants(form)
        coefficients = {(k,): c for k, c in enumerate(form) if not c.contains(0)}
        recognised = {e: recognise_number(c) for e, c in coefficients.items()}
    return AlgebraicCurve(
        genus=len(f) // 2 - 1,
        model="hyperelliptic",
        coefficients=coefficients,
        recognised=recognised,
        invariants=dict(zip(names, invariants, strict=True)),
        weights=weights,
        digits=digits,
    )


def _quartic_of_form(F: Mapping[tuple[int, int, int], Any], digits: int) -> AlgebraicCurve:
    with flint.ctx.workdps(digits):
        form = {e: flint.acb(c) for e, c in F.items()}
        invariants = dixmier_ohno_invariants(form)
        recognised = {e: recognise_number(c) for e, c in form.items()}
    return AlgebraicCurve(
        genus=3,
        model="plane quartic",
        coefficients=form,
        recognised=recognised,
        invariants=dict(zip(_OHNO, invariants, strict=True)),
        weights=DIXMIER_OHNO_WEIGHTS,
        digits=digits,
    )


def _elliptic(j: flint.acb, degree: int, known: dict[str, Any]) -> AlgebraicCurve:
    number = recognise_number(j, degree=degree) if j.is_finite() else None
    fraction = rational(number)
    remarks: tuple[str, ...] = ()
    coefficients: dict[tuple[int, ...], flint.acb] = {(3,): flint.acb(1)}
    recognised: dict[tuple[int, ...], AlgebraicNumber | None] = {(3,): _integer(1, None)}
    if fraction is not None and number is not None:
        for k, c in zip((1, 0), minimal_coefficients(fraction), strict=True):
            if c:
                coefficients[(k,)] = flint.acb(c)
                recognised[(k,)] = _integer(c, number)
    elif not (j - 1728).contains(0):
        for k, z in zip((1, 0), weierstrass_coefficients(j), strict=True):
            coefficients[(k,)] = z
            recognised[(k,)] = recognise_number(z, degree=degree) if number is not None else None
    else:
        coefficients, recognised = {}, {}
        remarks = ("j is not known to be another number than 1728, that of y^2 = x^3 - x",)
    return AlgebraicCurve(
        model="elliptic",
        coefficients=coefficients,
        recognised=recognised,
        invariants={"j": j},
        weights=(0,),
        remarks=remarks,
        **known,
    )


def _integer(c: int, like: AlgebraicNumber | None) -> AlgebraicNumber:
    return AlgebraicNumber((-c, 1), complex(c), None if like is None else like.evidence)


def _hyperelliptic(points: list[Point], degree: int, known: dict[str, Any]) -> AlgebraicCurve:
    form = form_of_points(points)
    names, weights, invariants = _invariants(form)
    with stage("recognition"):
        model = model_of_branch_points(points, degree)
        remark = None
        if known["genus"] == 2 and (model is None or model.degree > 1):
            over_q, remark = mestre_sextic(form)
            model = model if over_q is None else over_q
    remarks: tuple[str, ...] = (remark,) if remark else ()
    if model is None:
        remarks = (_THREE_POINTS, *remarks)
        places = {(k,): c for k, c in enumerate(form)}
        coefficients = {e: c for e, c in places.items() if e[0] not in (0, len(form) - 1)}
        recognised: dict[Any, AlgebraicNumber | None] = dict.fromkeys(coefficients)
    else:
        coefficients, recognised = _terms(model)
    return AlgebraicCurve(
        model="hyperelliptic",
        coefficients=coefficients,
        recognised=recognised,
        invariants=dict(zip(names, invariants, strict=True)),
        weights=weights,
        branch_points=tuple(points),
        remarks=remarks,
        **known,
    )


def _terms(model: RecognisedForm) -> tuple[dict[Any, flint.acb], dict[Any, AlgebraicNumber | None]]:
    """The terms that are not 0; of odd degree if only that is short: f(x) or its reversal."""
    balls, numbers = list(model.balls), list(model.numbers)
    if numbers[-1].polynomial != (0, 1) and numbers[0].polynomial == (0, 1):
        balls, numbers = balls[::-1], numbers[::-1]
    places = [k for k, x in enumerate(numbers) if x.polynomial != (0, 1)]
    if len(places) == 2 and model.degree == 1 and (places[1] - places[0]) % 2:
        # x ↦ −x makes the signs of two terms different.
        low, high = (complex(numbers[k]).real for k in places)
        if low * high > 0:
            balls[places[0]], numbers[places[0]] = -balls[places[0]], _negative(numbers[places[0]])
    if model.degree == 1 and complex(numbers[places[-1]]).real < 0:
        balls = [-c for c in balls]
        numbers = [_negative(x) for x in numbers]
    return {(k,): balls[k] for k in places}, {(k,): numbers[k] for k in places}


def _negative(x: AlgebraicNumber) -> AlgebraicNumber:
    return _integer(x.polynomial[0], x)


def _invariants(form: Form) -> tuple[tuple[str, ...], tuple[int, ...], list[flint.acb]]:
    if len(form) == 7:
        return _IGUSA, (2, 4, 6, 10), igusa_clebsch_of_sextic(form)
    if len(form) == 9:
        return _SHIODA, tuple(range(2, 11)), shioda_invariants(form)
    return (), (), []


def _quartic(reduced: ReducedBalls, degree: int, known: dict[str, Any]) -> AlgebraicCurve:
    with stage("bitangents"):
        F = plane_quartic(reduced.matrix)
    invariants = dixmier_ohno_invariants(F)
    automorphisms = symplectic_automorphism_group(reduced.matrix)
    with stage("recognition"):
        model = model_of_quartic(F, reduced.matrix, list(automorphisms), degree)
    remarks: tuple[str, ...] = ()
    if model is not None:
        coefficients, recognised = model.balls, dict(model.numbers)
    else:
        coefficients, recognised, remarks = _in_bitangents(F, reduced.matrix, degree)
    return AlgebraicCurve(
        model="plane quartic",
        coefficients=coefficients,
        recognised=recognised,
        invariants=dict(zip(_OHNO, invariants, strict=True)),
        weights=DIXMIER_OHNO_WEIGHTS,
        remarks=remarks,
        **known,
    )


def _in_bitangents(F: TernaryForm, Pi: flint.acb_mat, degree: int) -> tuple[Any, Any, Any]:
    """The quartic in four bitangents, if these are known well enough."""
    G = in_bitangents(F, bitangents(Pi))
    if G is None:
        return F, dict.fromkeys(F), ("the coordinates are normalised differentials",)
    numbers = {e: recognise_number(c, degree=degree) for e, c in G.items()}
    return G, numbers, ("coordinates x, y, z, x + y + z that are bitangents",)


def _unknown(known: dict[str, Any], vanishing: int | None) -> AlgebraicCurve:
    genus = known["genus"]
    remark = (
        f"theta constants are computed up to genus {LARGEST_DECIDED}: nothing is known of the curve"
        if vanishing is None
        else f"{vanishing} of {len(spin_structures(genus, 'even'))} even theta constants vanish, "
        f"and {number_vanishing(genus)} do on a hyperelliptic curve: this is none, and curves of "
        f"genus {genus} that are not hyperelliptic are not reconstructed"
    )
    return AlgebraicCurve(
        model="unknown",
        coefficients={},
        recognised={},
        invariants={},
        weights=(),
        remarks=(remark,),
        **known,
    )


def _no_curve(vanishing: int, genus: int) -> str:
    return (
        f"{vanishing} even theta constants vanish within their balls, and "
        f"{number_vanishing(genus)}{' or 0' if genus == 3 else ''} do on a curve of genus {genus}: "
        "this is the period matrix of a product of curves of lower genus, or known too badly to "
        "be told from one; ask for more digits"
    )


def _digits_known(reduced: ReducedBalls) -> int:
    radius = reduced.relative_radius()
    most = int(reduced.bits * _DIGITS_PER_BIT)
    return most if radius <= 10.0**-most else max(0, min(most, int(-math.log10(radius))))
