r"""Ternary forms and the invariants of plane quartics.

A form F(x, y, z) is a dictionary from exponents to coefficients, complex balls or rational numbers.
A form Φ(u, v, w) in dual coordinates acts on it as a differential operator, D_Φ(F).  Of a quartic F

* the contravariants σ (degree 2, order 4) and ψ (degree 3, order 6) are the invariants I and J of
  the binary quartic to which F restricts on the line u x + v y + w z = 0;
* H is its Hessian, ρ = D_F(ψ), τ = D_ρ(F), ξ = D_σ(H), η = D_ξ(σ), ν = D_η(D_ρ(H)).

With tr(AB), tr(A* B*), det A and det B of pairs of conics (A* the adjugate) come the invariants of
Dixmier, of degrees 3, 6, 9, 12, 15, 18, and those of Ohno, of degrees 9, 12, 15, 18, 21, 21.  They
generate the ring of invariants together with the discriminant, of degree 27, so that quartics with
the same values and smooth are projectively equivalent but for a few cases that only the
discriminant tells apart.  The factors are those of this construction with derivatives as they are,
and not of Dixmier's.

References
----------
Dixmier, "On the projective invariants of quartic plane curves" (1987).
Ohno, "The graded ring of invariants of ternary quartics" (2007, preprint).
Girard, Kohel, "Classification of genus 3 curves in special strata of the moduli space" (2006).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import product
from math import factorial
from typing import Any, TypeAlias

import flint

Exponents: TypeAlias = tuple[int, int, int]
TernaryForm: TypeAlias = dict[Exponents, Any]
Conic: TypeAlias = list[list[Any]]

DIXMIER_OHNO_WEIGHTS = (3, 6, 9, 9, 12, 12, 15, 15, 18, 18, 21, 21)


def added(F: TernaryForm, G: TernaryForm, factor: Any = 1) -> TernaryForm:
    """F + factor · G."""
    total = dict(F)
    for exponents, c in G.items():
        total[exponents] = total[exponents] + factor * c if exponents in total else factor * c
    return total


def multiplied(F: TernaryForm, G: TernaryForm) -> TernaryForm:
    """The product."""
    total: TernaryForm = {}
    for (i, j, k), a in F.items():
        for (p, q, r), b in G.items():
            exponents = (i + p, j + q, k + r)
            c = a * b
            total[exponents] = total[exponents] + c if exponents in total else c
    return total


def applied(operator: TernaryForm, F: TernaryForm) -> TernaryForm:
    """D_Φ(F): Φ with ∂/∂x, ∂/∂y, ∂/∂z for its variables, applied to F."""
    total: TernaryForm = {}
    for e, a in operator.items():
        for f, b in F.items():
            if all(x <= y for x, y in zip(e, f, strict=True)):
                exponents = (f[0] - e[0], f[1] - e[1], f[2] - e[2])
                falling = 1
                for x, y in zip(e, f, strict=True):
                    falling *= factorial(y) // factorial(y - x)
                c = a * b * falling
                total[exponents] = total[exponents] + c if exponents in total else c
    return total


def linear(coefficients: Sequence[Any]) -> TernaryForm:
    """A x + b y + c z."""
    a, b, c = coefficients
    return {(1, 0, 0): a, (0, 1, 0): b, (0, 0, 1): c}


def transformed(F: TernaryForm, matrix: Sequence[Sequence[Any]]) -> TernaryForm:
    """F(M (x, y, z))."""
    rows = [linear(row) for row in matrix]
    total: TernaryForm = {}
    for exponents, c in F.items():
        term: TernaryForm = {(0, 0, 0): c}
        for row, power in zip(rows, exponents, strict=True):
            for _ in range(power):
                term = multiplied(term, row)
        total = added(total, term)
    return total


def dixmier_ohno_invariants(F: TernaryForm) -> list[Any]:
    """I₃, I₆, I₉, J₉, I₁₂, J₁₂, I₁₅, J₁₅, I₁₈, J₁₈, I₂₁, J₂₁ of a plane quartic.

    Parameters
    ----------
    F : dict
        From exponents (i, j, k), i + j + k = 4, to coefficients.

    Raises
    ------
    ValueError
        If this is not a quartic.
    """
    if not F or {sum(exponents) for exponents in F} != {4}:
        raise ValueError("a plane quartic has terms of degree 4 and no others")
    sigma, psi = line_contravariants(F)
    H = hessian(F)
    rho = applied(F, psi)
    tau, xi = applied(rho, F), applied(sigma, H)
    eta = applied(xi, sigma)
    nu = applied(eta, applied(rho, H))
    zero = next(iter(F.values())) * 0
    R, T, X, E, N = (_conic(form, zero) for form in (rho, tau, xi, eta, nu))
    i3 = applied(sigma, F).get((0, 0, 0), zero)
    return [
        i3,
        applied(psi, H).get((0, 0, 0), zero),
        _trace(T, R),
        _trace(X, R),
        _determinant(R),
        _trace(T, E),
        _determinant(T),
        _determinant(X),
        _trace(_adjugate(T), _adjugate(R)),
        _trace(_adjugate(X), _adjugate(R)),
        _determinant(E),
        _trace(N, E),
    ]


def hessian(F: TernaryForm) -> TernaryForm:
    """The determinant of the second derivatives."""
    units: list[Exponents] = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    second = [[applied({_sum(a, b): 1}, F) for b in units] for a in units]
    total: TernaryForm = {}
    for i, j, k, sign in _PERMUTATIONS:
        term = multiplied(multiplied(second[0][i], second[1][j]), second[2][k])
        total = added(total, term, sign)
    return total


def line_contravariants(F: TernaryForm) -> tuple[TernaryForm, TernaryForm]:
    """σ and ψ: the invariants I, J of F on the line (u, v, w), as forms in u, v, w.

    On the line spanned by (w, 0, −u) and (0, w, −v), of which u x + v y + w z vanishes, F is a
    binary quartic with coefficients in u, v, w; its I is w⁴ σ and its J is w⁶ ψ.
    """
    quartic: list[TernaryForm] = [{} for _ in range(5)]
    for (i, j, k), c in F.items():
        # (w s)^i (w t)^j (−u s − v t)^k
        for m in range(k + 1):
            binomial = factorial(k) // (factorial(m) * factorial(k - m)) * (-1) ** k
            term = {(m, k - m, i + j): c * binomial}
            quartic[i + m] = added(quartic[i + m], term)
    a, b, c, d, e = (
        {key: value * flint.fmpq(1, n) for key, value in part.items()}
        for part, n in zip(reversed(quartic), (1, 4, 6, 4, 1), strict=True)
    )
    products = [(a, e, 1), (b, d, -4), (c, c, 3)]
    I_form = _combination((multiplied(p, q), n) for p, q, n in products)
    triples = [(a, c, e, 1), (b, c, d, 2), (a, d, d, -1), (b, b, e, -1), (c, c, c, -1)]
    J_form = _combination((multiplied(multiplied(p, q), r), n) for p, q, r, n in triples)
    return _divided(I_form, 4), _divided(J_form, 6)


_PERMUTATIONS = [
    (0, 1, 2, 1), (1, 2, 0, 1), (2, 0, 1, 1), (0, 2, 1, -1), (1, 0, 2, -1), (2, 1, 0, -1),
]  # fmt: skip


def _sum(a: Exponents, b: Exponents) -> Exponents:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _combination(terms: Iterable[tuple[TernaryForm, int]]) -> TernaryForm:
    total: TernaryForm = {}
    for form, factor in terms:
        total = added(total, form, factor)
    return total


def _divided(F: TernaryForm, power: int) -> TernaryForm:
    """F / w^power: terms that are not divisible cancel, and are left out."""
    return {(i, j, k - power): c for (i, j, k), c in F.items() if k >= power}


def _conic(F: TernaryForm, zero: Any) -> Conic:
    """The symmetric matrix of a quadratic form."""
    units: list[Exponents] = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
    half = flint.fmpq(1, 2)
    return [[F.get(_sum(a, b), zero) * (1 if a == b else half) for b in units] for a in units]


def _determinant(A: Conic) -> Any:
    return sum((s * A[0][i] * A[1][j] * A[2][k] for i, j, k, s in _PERMUTATIONS), A[0][0] * 0)


def _trace(A: Conic, B: Conic) -> Any:
    return sum((A[i][j] * B[j][i] for i, j in product(range(3), repeat=2)), A[0][0] * 0)


def _adjugate(A: Conic) -> Conic:
    def cofactor(i: int, j: int) -> Any:
        p, q = (i + 1) % 3, (i + 2) % 3
        r, s = (j + 1) % 3, (j + 2) % 3
        return A[p][r] * A[q][s] - A[p][s] * A[q][r]

    return [[cofactor(j, i) for j in range(3)] for i in range(3)]
