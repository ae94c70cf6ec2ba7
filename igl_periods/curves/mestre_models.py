r"""A sextic over Q for a curve of genus 2 whose invariants are rational.

The quadratic covariants y₁, y₂, y₃ of a sextic f map the projective line to a conic, and f to the
six points that a cubic cuts out of it:

.. math:: \sum A_{ij} x_i x_j = 0, \qquad \sum a_{ijk} x_i x_j x_k = 0, \qquad
          A_{ij} = (y_i, y_j)_2, \quad a_{ijk} = (((f, y_i)_2, y_j)_2, y_k)_2 .

A_{ij} and a_{ijk} are invariants, of degrees d_i + d_j and 1 + d_i + d_j + d_k, d = (3, 5, 7), all
of them even; divided by powers of one of degree 2 they lie in the field of moduli.  If that is Q,
the curve has a model over Q iff the conic has a rational point: its parametrization, put into the
cubic, is the sextic.  The construction fails where y₁, y₂, y₃ are linearly dependent, which is
where the curve has more involutions than one; then it has a model over its field of moduli anyway
(:mod:`~igl_periods.curves.hyperelliptic_models`).

References
----------
Mestre, "Construction de courbes de genre 2 à partir de leurs modules" (1991).
"""

from __future__ import annotations

from fractions import Fraction
from itertools import combinations_with_replacement, product

import flint

from igl_periods.recognition import recognise_number

from .binary_forms import Form, sextic_covariants, transvectant
from .hyperelliptic_models import ZERO, RecognisedForm, rational_form, weakest_evidence
from .rational_conics import UndecidedConicError, parametrization, rational_point
from .weighted_points import absolute_invariants, vanishes

_DEGREES = (3, 5, 7)

NO_RATIONAL_POINT = (
    "Mestre's conic has no rational point: the field of moduli is Q, as recognised, but no model "
    "of the curve is defined over Q"
)


def mestre_sextic(f: Form) -> tuple[RecognisedForm | None, str | None]:
    """A sextic with rational coefficients, or why there is none.

    Parameters
    ----------
    f : list of acb
        A sextic in any coordinates, in balls.

    Returns
    -------
    RecognisedForm or None
    str or None
        What stands against it; None if it is just not over Q.
    """
    *_, y1, y2, y3 = sextic_covariants(f)
    y = (y1, y2, y3)
    if _determinant(y).contains(0):
        return None, None
    pairs = list(combinations_with_replacement(range(3), 2))
    triples = list(combinations_with_replacement(range(3), 3))
    values = [transvectant(y[i], y[j], 2)[0] for i, j in pairs]
    values += [_cubic_coefficient(f, *(y[i] for i in triple)) for triple in triples]
    weights = [sum(_DEGREES[i] for i in pair) for pair in pairs]
    weights += [1 + sum(_DEGREES[i] for i in triple) for triple in triples]
    # Clebsch's A, of degree 2, makes the smallest denominators where it is not 0.
    absolute = absolute_invariants([transvectant(f, f, 6)[0], *values], [2, *weights])[1:]
    numbers = [ZERO if vanishes(x) else recognise_number(x, degree=1) for x in absolute]
    recognised = [x for x in numbers if x is not None]
    if len(recognised) < len(numbers):
        return None, None
    known = [Fraction(-x.polynomial[0], x.polynomial[1]) for x in recognised]
    A, a = (
        dict(zip(pairs, known, strict=False)),
        dict(zip(triples, known[len(pairs) :], strict=True)),
    )
    conic = [[A[min(i, j), max(i, j)] for j in range(3)] for i in range(3)]
    try:
        point = rational_point(conic)
    except UndecidedConicError as error:
        return None, f"Mestre's conic: {error}"
    if point is None:
        return None, NO_RATIONAL_POINT
    sextic = _substituted(a, parametrization(conic, point))
    return rational_form(sextic, weakest_evidence(recognised)), None


def _substituted(
    a: dict[tuple[int, int, int], Fraction], forms: list[list[Fraction]]
) -> list[Fraction]:
    polynomials = [
        flint.fmpq_poly([flint.fmpq(c.numerator, c.denominator) for c in form]) for form in forms
    ]
    total = flint.fmpq_poly([0])
    for i, j, k in product(range(3), repeat=3):
        first, second, third = sorted((i, j, k))
        c = a[first, second, third]
        term = polynomials[i] * polynomials[j] * polynomials[k]
        total += flint.fmpq(c.numerator, c.denominator) * term
    coefficients = [Fraction(int(c.p), int(c.q)) for c in total.coeffs()]
    return coefficients + [Fraction(0)] * (7 - len(coefficients))


def _cubic_coefficient(f: Form, p: Form, q: Form, r: Form) -> flint.acb:
    return transvectant(transvectant(transvectant(f, p, 2), q, 2), r, 2)[0]


def _determinant(y: tuple[Form, Form, Form]) -> flint.acb:
    return flint.acb_mat([list(form) for form in y]).det()
