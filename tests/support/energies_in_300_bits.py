"""Energies of given forms, by other routes than the library's, in balls of 300 bits.

Degree 1: flips one after the other, cotangents, sums over edges.  High degree: trial functions as
polynomials with integer coefficients, integrated in closed form; there is no quadrature.
"""

from functools import lru_cache
from math import comb

import numpy as np
from flint import arb, arb_mat, ctx, fmpq, fmpq_poly
from support.ball_arithmetic import BITS, Surface, area


def flipped_surface(K, cochains, rounds):
    """K after rounds of flips, its lengths and cochains known to 300 bits."""
    ctx.prec = BITS
    surface = Surface(K, cochains)
    for flips in rounds:
        for edge in flips.edge.tolist():
            surface.flip(edge)
    return surface


def linear_energies(surface, potentials, combination):
    """Σ_e ρ(e) ω_i(e) ω_j(e) of ω = W c + df, W and f floating-point numbers."""
    ctx.prec = BITS
    weights = [arb(0)] * len(surface.lengths)
    forms = [None] * len(surface.lengths)
    W = arb_mat(combination.tolist())
    for h, edge in enumerate(surface.edge):
        a, b = surface.length(h), surface.length(surface.next[h])
        c = surface.length(surface.next[surface.next[h]])
        weights[edge] += (b * b + c * c - a * a) / (8 * area(a, b, c))
        if surface.sign[h] > 0:
            values = W * arb_mat([[int(v)] for v in surface.cochains[edge]])
            tail, head = surface.start[h], surface.start[surface.next[h]]
            forms[edge] = [
                v + arb(float(y)) - arb(float(x))
                for v, x, y in zip(
                    values.entries(), potentials[tail], potentials[head], strict=True
                )
            ]
    X = arb_mat(forms)
    weighted = [[w * x for x in row] for w, row in zip(weights, forms, strict=True)]
    return X.transpose() * arb_mat(weighted)


def _jacobi(n, a, b):
    """P_n^{(a, b)}(2 t − 1) as a polynomial in t."""
    t, one = fmpq_poly([0, 1]), fmpq_poly([1])
    terms = (
        comb(n + a, n - s) * comb(n + b, s) * (t - one) ** s * t ** (n - s) for s in range(n + 1)
    )
    return sum(terms, fmpq_poly([0]))


def _bubble(b, j):
    """t^b, or −1/(j + 1) t^b (1 − t) P_j^{(1, b)}(2 t − 1) and its factor √(2 j + 3)."""
    t = fmpq_poly([0, 1])
    if j < 0:
        return t**b, arb(1)
    return t**b * (fmpq_poly([1]) - t) * _jacobi(j, 1, b) / fmpq(-(j + 1)), arb(2 * j + 3).sqrt()


def _trial_functions(degree, conical):
    """Polynomials S, T and a factor for each function S(s) T(τ)."""
    one, s, k = fmpq_poly([1]), fmpq_poly([0, 1]), range(2, degree + 1)
    along = [(one - s, arb(1)), (s, arb(1)), *(_bubble(1, i - 2) for i in k)]

    def product(i, j, sign=1):
        T, c = _bubble(1 if conical or i < 2 else i, j)
        return along[i][0], T, sign * c * along[i][1]

    functions = [(one, one - s, arb(1))]
    functions += [product(i, -1) for i in (0, 1, *k)]
    functions += [product(1, i - 2, (-1) ** i) for i in k]
    functions += [product(0, i - 2) for i in k]
    functions += [product(i, j) for i in k for j in range(degree - 1 if conical else degree - i)]
    return functions


def _integral(p):
    whole = p.integral()
    return whole(fmpq(1)) - whole(fmpq(0))


def _tables(rows, columns):
    """Integrals over [0, 1] of all products."""
    return [[_integral(p * q) for q in columns] for p in rows]


@lru_cache
def stiffness_terms(reference):
    """Matrices of ∫∫ τ u_τ v_τ, of s^i u_τ v_s (i < 2), and of s^i u_s v_s / τ (i < 3)."""
    ctx.prec = BITS
    # Only functions of the conical element are all linear in τ near the apex.
    conical = bool(np.all(reference.powers == 1))
    S, T, factor = zip(*_trial_functions(reference.degree, conical), strict=True)
    slope_S, slope_T = [p.derivative() for p in S], [p.derivative() for p in T]
    t = fmpq_poly([0, 1])
    # The quotient T / t matters only where S′ is not 0, and there it is a polynomial.
    over_t = [(p // t) for p in T]

    def matrix(in_s, in_t):
        n = range(len(S))
        return arb_mat(
            [[arb(in_s[i][j] * in_t[i][j]) * factor[i] * factor[j] for j in n] for i in n]
        )

    first = matrix(_tables(S, S), _tables([t * p for p in slope_T], slope_T))
    mixed_t = _tables(slope_T, T)
    mixed = [matrix(_tables([t**i * p for p in S], slope_S), mixed_t) for i in range(2)]
    last_t = _tables(T, over_t)
    last = [matrix(_tables([t**i * p for p in slope_S], slope_S), last_t) for i in range(3)]
    return first, mixed, last


def stiffness(terms, lengths, apex, kappa):
    """The matrix of the Dirichlet energy on a face with the given sides, in balls."""
    opposite, one, other = (lengths[(apex + i) % 3] for i in range(3))
    height = 2 * area(*lengths) / opposite
    aspect = height / opposite
    # Side apex + 1 joins corner b to the apex, side apex + 2 the apex to corner a.
    foot = (other**2 + opposite**2 - one**2) / (2 * opposite**2)
    first, mixed, last = terms
    kappa = arb(float(kappa))
    cross = mixed[1] - mixed[0] * foot
    angular = last[2] - last[1] * (2 * foot) + last[0] * (foot**2 + aspect**2)
    return (first * kappa - cross - cross.transpose() + angular * (1 / kappa)) * (1 / aspect)


def polynomial_energies(forms, coefficients, lengths):
    """The Dirichlet matrix of forms of high degree.

    ``coefficients(elements, m)`` are (n, k) balls, ``lengths`` (3,) balls of each face.
    """
    ctx.prec = BITS
    k = forms.cochains.shape[0]
    D = arb_mat(k, k)
    for elements in forms.elements:
        terms = stiffness_terms(elements.reference)
        for m, (face, apex) in enumerate(zip(elements.face, elements.apex, strict=True)):
            u = coefficients(elements, m)
            D += u.transpose() * stiffness(terms, lengths(face), int(apex), elements.kappa[m]) * u
    return D


def contains(balls, exact):
    """Whether balls of arrays contain those of a flint matrix, entry by entry."""
    table = exact.table()
    return all(
        arb(float(m), float(r)).contains(table[i][j])
        for (i, j), m in np.ndenumerate(balls.mid)
        for r in (balls.rad[i, j],)
    )
