r"""Binary forms and their invariants: sextics (genus 2), octics (genus 3).

A form f(x, z) = Σ f_k x^k z^{n−k} is the list of its coefficients f_0, …, f_n: complex balls, or
rational numbers.  The k-th transvectant of f and g, of degrees m and n,

.. math:: (f, g)_k = \frac{(m-k)!\,(n-k)!}{m!\,n!} \sum_{i=0}^{k} (-1)^i \binom ki
          \frac{\partial^k f}{\partial x^{k-i} \partial z^i}
          \frac{\partial^k g}{\partial x^i \partial z^{k-i}} ,

is covariant under SL₂.  From it come the invariants A, B, C, D of Clebsch, hence those of Igusa and
Clebsch, and J₂, …, J₁₀ of Shioda, which decide whether two curves y² = f are isomorphic.

References
----------
Clebsch, "Theorie der binären algebraischen Formen" (1872).
Shioda, "On the graded ring of invariants of binary octavics" (1967).
Mestre, "Construction de courbes de genre 2 à partir de leurs modules" (1991).
"""

from __future__ import annotations

from collections.abc import Sequence
from math import comb, factorial
from typing import Any, TypeAlias

import flint

# Coefficients are acb, or rational: fmpq.
Form: TypeAlias = list[Any]
# A point of the projective line.
Point: TypeAlias = tuple[Any, Any]


def transvectant(f: Form, g: Form, k: int) -> Form:
    """The k-th transvectant, of degree m + n − 2k; invariants are forms of degree 0.

    Raises
    ------
    ValueError
        If k is larger than one of the degrees.

    Examples
    --------
    >>> transvectant([1, 0, 1], [1, 0, 1], 2)  # twice the determinant of x² + z²
    [2]
    """
    m, n = len(f) - 1, len(g) - 1
    if not 0 <= k <= min(m, n):
        raise ValueError(f"forms of degrees {m} and {n} have transvectants 0 to {min(m, n)}")
    total: Form = [f[0] * 0] * (m + n - 2 * k + 1)
    for i in range(k + 1):
        product = _times(_derivative(f, k - i, i), _derivative(g, i, k - i))
        sign = (-1) ** i * comb(k, i)
        total = [a + sign * b for a, b in zip(total, product, strict=True)]
    scale = flint.fmpq(factorial(m - k) * factorial(n - k), factorial(m) * factorial(n))
    return [scale * a for a in total]


def clebsch_invariants(f: Form) -> list[Any]:
    """A, B, C, D of a sextic, of degrees 2, 4, 6, 10.

    Raises
    ------
    ValueError
        If this is not a sextic.
    """
    _check_degree(f, 6)
    i, _, delta, y1, _, y3 = sextic_covariants(f)
    return [
        transvectant(f, f, 6)[0],
        transvectant(i, i, 4)[0],
        transvectant(i, delta, 4)[0],
        transvectant(y3, y1, 2)[0],
    ]


def sextic_covariants(f: Form) -> tuple[Form, Form, Form, Form, Form, Form]:
    """I = (f,f)₄, (f,i)₄, Δ = (i,i)₂ and the three quadratic covariants y₁, y₂, y₃ of a sextic."""
    i = transvectant(f, f, 4)
    delta = transvectant(i, i, 2)
    y1 = transvectant(f, i, 4)
    y2 = transvectant(i, y1, 2)
    return i, y1, delta, y1, y2, transvectant(i, y2, 2)


def igusa_clebsch_of_sextic(f: Form) -> list[Any]:
    """I₂, I₄, I₆, I₁₀ of a sextic, as sums over its roots define them.

    Examples
    --------
    >>> one, zero = flint.fmpq(1), flint.fmpq(0)
    >>> igusa_clebsch_of_sextic([zero, -one, zero, zero, zero, one, zero])  # y² = x⁵ − x
    [-40, -80, 320, -256]
    """
    A, B, C, D = clebsch_invariants(f)
    return [
        -120 * A,
        -720 * A**2 + 6750 * B,
        8640 * A**3 - 108000 * A * B + 202500 * C,
        -62208 * A**5
        + 972000 * A**3 * B
        + 1620000 * A**2 * C
        - 3037500 * A * B**2
        - 6075000 * B * C
        - 4556250 * D,
    ]


def shioda_invariants(f: Form) -> list[Any]:
    """J₂, J₃, …, J₁₀ of an octic, up to rational factors that do not depend on it.

    Raises
    ------
    ValueError
        If this is not an octic.
    """
    _check_degree(f, 8)
    g, k = transvectant(f, f, 4), transvectant(f, f, 6)
    h, m = transvectant(k, k, 2), transvectant(f, k, 4)
    n, p, q = transvectant(f, h, 4), transvectant(g, k, 4), transvectant(g, h, 4)
    return [
        transvectant(f, f, 8)[0],
        transvectant(f, g, 8)[0],
        transvectant(k, k, 4)[0],
        transvectant(m, k, 4)[0],
        transvectant(k, h, 4)[0],
        transvectant(m, h, 4)[0],
        transvectant(p, h, 4)[0],
        transvectant(n, h, 4)[0],
        transvectant(q, h, 4)[0],
    ]


def form_of_points(points: Sequence[Point]) -> Form:
    """The form ∏ (z_i x − x_i z) that vanishes at points (x_i : z_i)."""
    form: Form = [points[0][0] * 0 + 1]
    for x, z in points:
        form = _times(form, [-x, z])
    return form


def substituted(f: Form, matrix: Sequence[Sequence[Any]]) -> Form:
    """f(a x + b z, c x + d z) for [[a, b], [c, d]]."""
    (a, b), (c, d) = matrix
    n = len(f) - 1
    one: Form = [f[0] * 0 + 1]
    first, second = [one], [one]
    for _ in range(n):
        first.append(_times(first[-1], [b, a]))
        second.append(_times(second[-1], [d, c]))
    total: Form = [f[0] * 0] * (n + 1)
    for k, coefficient in enumerate(f):
        product = _times(first[k], second[n - k])
        total = [x + coefficient * y for x, y in zip(total, product, strict=True)]
    return total


def _derivative(f: Form, by_x: int, by_z: int) -> Form:
    """∂^{by_x + by_z} f / ∂x^{by_x} ∂z^{by_z}."""
    n = len(f) - 1
    return [
        f[k] * (factorial(k) // factorial(k - by_x)) * (factorial(n - k) // factorial(n - k - by_z))
        for k in range(by_x, n - by_z + 1)
    ]


def _times(f: Form, g: Form) -> Form:
    product: Form = [f[0] * 0] * (len(f) + len(g) - 1)
    for i, a in enumerate(f):
        for j, b in enumerate(g):
            product[i + j] = product[i + j] + a * b
    return product


def _check_degree(f: Form, degree: int) -> None:
    if len(f) != degree + 1:
        raise ValueError(f"a form of degree {degree} has {degree + 1} coefficients, not {len(f)}")
