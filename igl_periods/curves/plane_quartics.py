r"""The plane quartic of a surface of genus 3 that is not hyperelliptic, from its bitangents.

The gradient of an odd theta function, :math:`b_\chi(x) = \sum_k \partial_k \theta_\chi(0)\, x_k`,
is a bitangent of the canonical curve in the coordinates x_k = ζ_k; there are 28.  For a point ε ≠ 0
of order two there are six pairs {χ, χ + ε} of odd characteristics, a Steiner complex, and

.. math:: \sqrt{b_\chi\, b_{\chi+ε}}

are sections of one bundle of degree 4, K ⊗ ε, which has two of them.  So the six products Q_i span
three dimensions only, squares of sections form a conic in their plane, on which all six lie, and
the curve is where the values (Q_1, Q_2, Q_3) of three of them lie on the dual conic.  With Q_4 and
Q_5 as combinations of Q_1, Q_2, Q_3 that conic through five points is

.. math:: a\, βγ + b\, γα + c\, αβ = 0, \qquad
          F = a^2 Q_1^2 + b^2 Q_2^2 + c^2 Q_3^2 - 2ab\, Q_1 Q_2 - 2bc\, Q_2 Q_3 - 2ca\, Q_3 Q_1 .

No square root of a theta constant is taken, so that there are no signs to choose.

References
----------
Weber, "Theorie der Abel'schen Functionen vom Geschlecht 3" (1876).
Dolgachev, "Classical algebraic geometry" (2012), chapter 6.
Guàrdia, "On the Torelli problem and Jacobian Nullwerte in genus three" (2011).
"""

from __future__ import annotations

import flint

from igl_periods.errors import CurveError
from igl_periods.riemann_theta import SpinStructure, spin_structures, theta_series

from .ternary_forms import TernaryForm, added, linear, multiplied

Line = list[flint.acb]
_COMPLEXES = 3
_MONOMIALS = [(2, 0, 0), (0, 2, 0), (0, 0, 2), (1, 1, 0), (0, 1, 1), (1, 0, 1)]


def bitangent(Pi: flint.acb_mat, spin: SpinStructure) -> Line:
    """Coefficients of the bitangent b_χ of an odd spin structure.

    Works at the precision ``flint.ctx.prec``; Π should be reduced.

    Raises
    ------
    ValueError
        If the spin structure is even.
    """
    if spin.is_even:
        raise ValueError(f"bitangents belong to odd spin structures, and {spin} is even")
    zero = flint.acb_mat(Pi.nrows(), 1)
    jet = theta_series(Pi, zero, list(spin.a), list(spin.b), 1)
    return [jet[(k,)] for k in range(Pi.nrows())]


def bitangents(Pi: flint.acb_mat) -> list[Line]:
    """All 28 bitangents, in the order of the odd spin structures."""
    return [bitangent(Pi, spin) for spin in spin_structures(3, "odd")]


def plane_quartic(Pi: flint.acb_mat) -> TernaryForm:
    """The quartic in the coordinates ζ_1, ζ_2, ζ_3 of the marking.

    Parameters
    ----------
    Pi : (3, 3) acb_mat
        Reduced, and not of a hyperelliptic surface.

    Returns
    -------
    dict
        From exponents to coefficients in balls.

    Raises
    ------
    CurveError
        If no five pairs of bitangents are in general position to within the balls, as those of a
        smooth quartic are.
    """
    odd = set(spin_structures(3, "odd"))
    # Every ε does in exact arithmetic; in balls one may be better than another.
    for order_two in spin_structures(3)[1 : 1 + _COMPLEXES]:
        pairs = sorted(
            {tuple(sorted((s, _moved(s, order_two)))) for s in odd if _moved(s, order_two) in odd}
        )
        quartic = _from_pairs(Pi, pairs)
        if quartic is not None:
            return quartic
    raise CurveError(
        "the bitangents of this matrix are in special position, or not known well enough: it may "
        "be near that of a product"
    )


def _from_pairs(Pi: flint.acb_mat, pairs: list[tuple[SpinStructure, ...]]) -> TernaryForm | None:
    products = [multiplied(*(linear(bitangent(Pi, spin)) for spin in pair)) for pair in pairs[:5]]
    fourth, fifth = (_in_terms(products[:3], Q) for Q in products[3:])
    if fourth is None or fifth is None:
        return None
    # (a, b, c) is perpendicular to (βγ, γα, αβ) of both.
    (p, q, r), (s, t, u) = ((y * z, z * x, x * y) for x, y, z in (fourth, fifth))
    a, b, c = q * u - r * t, r * s - p * u, p * t - q * s
    if any(x.contains(0) for x in (a, b, c)):
        return None
    A, B, C = ({e: k * v for e, v in Q.items()} for k, Q in zip((a, b, c), products, strict=False))
    F = added(added(multiplied(A, A), multiplied(B, B)), multiplied(C, C))
    for one, two in ((A, B), (B, C), (C, A)):
        F = added(F, multiplied(one, two), -2)
    return F


def _in_terms(basis: list[TernaryForm], Q: TernaryForm) -> list[flint.acb] | None:
    """Coefficients of a conic in terms of three others, from a 3 × 3 minor that is not 0."""
    columns = [[form[e] for form in basis] for e in _MONOMIALS]
    best, rows = None, None
    for i in range(4):
        for j in range(i + 1, 5):
            for k in range(j + 1, 6):
                minor = flint.acb_mat([columns[i], columns[j], columns[k]]).det()
                size = float(minor.abs_lower())
                if best is None or size > best:
                    best, rows = size, (i, j, k)
    if not best or rows is None:
        return None
    matrix = flint.acb_mat([columns[i] for i in rows])
    right = flint.acb_mat([[Q[_MONOMIALS[i]]] for i in rows])
    try:
        return list(matrix.solve(right).entries())
    except ZeroDivisionError:
        return None


def _moved(spin: SpinStructure, by: SpinStructure) -> SpinStructure:
    digits, g = spin + by, spin.genus
    return SpinStructure(digits[:g], digits[g:])
