r"""Invariants as points of a weighted projective space.

Invariants J_1, …, J_n of degrees w_1, …, w_n of isomorphic curves differ by J_i ↦ μ^{w_i} J_i.
With d the greatest common divisor of the degrees of those that do not vanish, and integers e_i with
Σ e_i w_i = d, the monomial m = ∏ J_i^{e_i} has degree d, and

.. math:: A_i = J_i / m^{w_i / d}

are *absolute* invariants, rational functions on the moduli space: two curves with the same
vanishing invariants are the same point iff all A_i agree.  They generate the field of moduli.

References
----------
Lercier, Ritzenthaler, "Hyperelliptic curves and their invariants: geometric, arithmetic and
algorithmic aspects" (2012), section 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import gcd
from typing import Any

import flint


def absolute_invariants(invariants: Sequence[Any], weights: Sequence[int]) -> list[Any]:
    """The A_i of a point; those of vanishing invariants are 0.

    Parameters
    ----------
    invariants : sequence of acb or fmpq
        Balls that contain 0 are taken to be 0.
    weights : sequence of int

    Raises
    ------
    ValueError
        If all invariants vanish, or the numbers of invariants and weights differ.

    Examples
    --------
    >>> absolute_invariants([flint.fmpq(4), flint.fmpq(24)], [2, 3])  # m = 24/4
    [1/9, 1/9]
    """
    if len(invariants) != len(weights):
        raise ValueError(f"{len(invariants)} invariants have {len(weights)} weights")
    places = [i for i, value in enumerate(invariants) if not vanishes(value)]
    if not places:
        raise ValueError("all invariants vanish: the form is unstable, and no smooth curve")
    exponents = _bezout([weights[i] for i in places])
    d = sum(e * weights[i] for e, i in zip(exponents, places, strict=True))
    monomial = invariants[places[0]] ** 0
    for e, i in zip(exponents, places, strict=True):
        monomial = monomial * invariants[i] ** e
    return [
        value / monomial ** (weight // d) if i in places else value
        for i, (value, weight) in enumerate(zip(invariants, weights, strict=True))
    ]


def same_point(one: Sequence[Any], two: Sequence[Any], weights: Sequence[int]) -> bool:
    """Whether two points agree as far as balls tell; False is proved.

    The scale comes from the invariants that certainly vanish for neither, so that a ball around 0
    is compared with what it may be.
    """
    pairs = list(zip(one, two, weights, strict=True))
    sure = [(a, b, w) for a, b, w in pairs if not (vanishes(a) or vanishes(b))]
    if not sure:
        return True
    exponents = _bezout([w for _, _, w in sure])
    d = gcd(*(w for _, _, w in sure))
    # μ^d, if two = μ · one.
    scale = flint.acb(1)
    for e, (a, b, _) in zip(exponents, sure, strict=True):
        scale *= (flint.acb(b) / flint.acb(a)) ** e
    for a, b, w in pairs:
        power = d // gcd(d, w)
        if not vanishes(flint.acb(b) ** power - flint.acb(a) ** power * scale ** (w * power // d)):
            return False
    return True


def vanishes(value: Any) -> bool:
    """Whether a number may be 0: exactly, or within its ball."""
    return bool(value.contains(0) if isinstance(value, (flint.acb, flint.arb)) else value == 0)


def _bezout(weights: Sequence[int]) -> list[int]:
    """Integers e, as small as the order of the weights gives, with Σ e_i w_i = gcd."""
    exponents, common = [1], weights[0]
    for weight in weights[1:]:
        d = gcd(common, weight)
        if d == common:
            exponents.append(0)
            continue
        # s common + t weight = d, with s of the least absolute value.
        modulus = weight // d
        s = pow(common // d, -1, modulus)
        s = s - modulus if 2 * s > modulus else s
        exponents = [s * e for e in exponents] + [(d - s * common) // weight]
        common = d
    return exponents
