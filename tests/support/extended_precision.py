"""Energies of given forms in extended arithmetic, by tables of their own.

Nothing is shared with the library but the meaning of the coefficients: Jacobi polynomials come
from their recurrence, Gauss points from Newton's method, and the energy is written with the
vectors of the triangle, not with its aspect and foot.
"""

import numpy as np

from igl_periods.elements.reference_elements import conical_element

Extended = np.longdouble


def jacobi(n, a, b, x):
    before, now = np.zeros_like(x), np.ones_like(x)
    for k in range(1, n + 1):
        if k == 1:
            before, now = now, (a - b + (a + b + 2) * x) / 2
            continue
        c = 2 * k + a + b
        now, before = (
            (
                (c - 1) * (c * (c - 2) * x + a * a - b * b) * now
                - 2 * (k + a - 1) * (k + b - 1) * c * before
            )
            / Extended(2 * k * (k + a + b) * (c - 2)),
            now,
        )
    return now


def gauss(n):
    """Gauss–Legendre points and weights on [0, 1]."""
    x = np.polynomial.legendre.leggauss(n)[0].astype(Extended)
    for _ in range(3):
        slope = Extended(n + 1) / 2 * jacobi(n - 1, 1, 1, x)
        x = x - jacobi(n, 0, 0, x) / slope
    slope = Extended(n + 1) / 2 * jacobi(n - 1, 1, 1, x)
    return (1 + x) / 2, 1 / ((1 - x * x) * slope * slope)


def bubble(b, j, t):
    """-c / (j + 1) t^b (1 - t) P_j^{(1, b)}(2 t - 1), over t, and its derivative by products."""
    P = jacobi(j, 1, b, 2 * t - 1)
    slope_of_P = Extended(j + b + 2) * jacobi(j - 1, 2, b + 1, 2 * t - 1) if j else np.zeros_like(t)
    c = -np.sqrt(Extended(2 * j + 3)) / (j + 1)
    slope = t ** (b - 1) * ((b * (1 - t) - t) * P + t * (1 - t) * slope_of_P)
    return c * t ** (b - 1) * (1 - t) * P, c * slope


def shape_derivatives(degree, conical, s, t):
    """u_τ and u_s / τ of all trial functions at points (s, τ); two (points, n) arrays."""
    one, k = np.ones_like(s), range(2, degree + 1)
    along = [(1 - s, -one), (s, one)] + [(s * q, d) for q, d in (bubble(1, i - 2, s) for i in k)]
    table = [(-one, 0 * s)]

    def add(i, radial, sign=1):
        value, slope = along[i]
        quotient, derivative = radial
        table.append((sign * value * derivative, sign * slope * quotient))

    def exponent(i):
        return 1 if conical or i < 2 else i

    for i in (0, 1, *k):
        b = exponent(i)
        add(i, (t ** (b - 1), b * t ** (b - 1)))
    for i in k:
        add(1, bubble(1, i - 2, t), (-1) ** i)
    for i in k:
        add(0, bubble(1, i - 2, t))
    for i in k:
        for j in range(degree - 1 if conical else degree - i):
            add(i, bubble(exponent(i), j, t))
    return tuple(np.stack(columns, axis=1) for columns in zip(*table, strict=True))


def triangle(lengths):
    """Vectors a, b from the apex at corner 0 to corners 1 and 2, and twice the area."""
    l0, l1, l2 = (Extended(x) for x in lengths)
    x, y, z = sorted((l0, l1, l2), reverse=True)
    twice = np.sqrt((x + (y + z)) * (z - (x - y)) * (z + (x - y)) * (x + (y - z))) / 2
    inner = (min(l1, l2) ** 2 + (max(l1, l2) - l0) * (max(l1, l2) + l0)) / 2
    return np.array([l2, 0 * l2]), np.array([inner / l2, twice / l2]), twice


def gram_matrix(forms, coefficients):
    """The Dirichlet matrix of forms; ``coefficients(elements, block)`` as the library has them."""
    k = forms.cochains.shape[0]
    D = np.zeros((k, k), dtype=Extended)
    for elements in forms.elements:
        p = elements.reference.degree
        conical = elements.reference is conical_element(p)
        (s, s_weight), (t, t_weight) = gauss(p + 2), gauss(p + 1)
        s, t = np.repeat(s, t.size), np.tile(t, s.size)
        weight = np.outer(s_weight, t_weight).ravel()
        by_t, by_s = shape_derivatives(p, conical, s, t)
        u = coefficients(elements, np.arange(elements.face.size)).astype(Extended)
        for m, (face, apex) in enumerate(zip(elements.face, elements.apex, strict=True)):
            a, b, twice = triangle(np.roll(forms.complex.lengths[face], -apex))
            kappa = Extended(elements.kappa[m])
            R = a + s[:, None] * (b - a)
            normal = np.stack([-R[:, 1], R[:, 0]], axis=1)
            side = np.array([-(b - a)[1], (b - a)[0]])
            # |R × R'| ∇u = (κ u_τ i(a - b) + (u_s / τ) iR) τ / t up to sign; dA = |R × R'| t dt ds.
            u_t, u_s = by_t @ u[:, m], by_s @ u[:, m]
            for i in (0, 1):
                gradient = kappa * u_t * side[i] - u_s * normal[:, i, None]
                scaled = np.sqrt(weight * t / (kappa * twice))[:, None] * gradient
                D += scaled.T @ scaled
    return D
