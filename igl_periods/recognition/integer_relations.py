r"""Small integers c with Σ c_k v_k ≈ 0 for vectors v_k that are known in balls.

The lattice of all integer vectors with the norm

.. math:: \|c\|^2 = \sum_k w_k^2 c_k^2 + 2^{2b} \Big\| \sum_k c_k v_k \Big\|^2

has a basis that LLL reduces; relations that hold are short there.  With n vectors of m real
coordinates and b bits the shortest vector of *any* such lattice is about 2^{bm/n} long, so that
only what is much shorter says something.

References
----------
Lenstra, Lenstra, Lovász, "Factoring polynomials with rational coefficients" (1982).
Cohen, "A course in computational algebraic number theory" (1993), section 2.7.2.
"""

from __future__ import annotations

from collections.abc import Sequence

import flint


def nearest_integer(x: flint.arb, bits: int = 0) -> int:
    """An integer next to 2^bits times the midpoint of a ball."""
    mantissa, exponent = (int(n) for n in x.mid().man_exp())
    shift = exponent + bits
    if shift >= 0:
        return mantissa << shift
    return (mantissa + (1 << (-shift - 1))) >> -shift


def scaled_lattice(
    values: Sequence[Sequence[flint.arb]], bits: int, weights: Sequence[int] | None = None
) -> flint.fmpz_mat:
    """Rows (w_k e_k, 2^bits v_k), rounded to integers: a basis of the lattice of relations."""
    n = len(values)
    w = [1] * n if weights is None else list(weights)
    rows = [
        [w[k] if i == k else 0 for i in range(n)] + [nearest_integer(x, bits) for x in value]
        for k, value in enumerate(values)
    ]
    return flint.fmpz_mat(rows)


def reduced_relations(
    values: Sequence[Sequence[flint.arb]], bits: int, weights: Sequence[int] | None = None
) -> list[list[int]]:
    """An LLL-reduced basis of all integer vectors, those with a small Σ c_k v_k first.

    Parameters
    ----------
    values : n vectors of m real balls
    bits : int
        Weight 2^bits of the sum, about what is known of it.
    weights : n positive int, optional
        Weights w_k of the coefficients; 1 by default.

    Returns
    -------
    n lists of n int

    Examples
    --------
    >>> phi = (1 + flint.arb(5).sqrt()) / 2
    >>> [[abs(c) for c in reduced_relations([[phi**k] for k in range(3)], 40)[0]]]
    [[1, 1, 1]]
    """
    n = len(values)
    reduced = scaled_lattice(values, bits, weights).lll().tolist()
    w = [1] * n if weights is None else list(weights)
    return [[int(c) // w[k] for k, c in enumerate(row[:n])] for row in reduced]
