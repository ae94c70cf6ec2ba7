r"""Energies of forms of high degree, in balls.

On a face seen from its apex (:mod:`igl_periods.elements.reference_elements`), with λ the height
over the length of the opposite side and x the foot of the height, the energy of a trial function u
is the sum over the points of a Gauss quadrature of X_1² + X_2²,

.. math:: X_1 = \sqrt{\frac\kappa\lambda}\; a - \frac{(s - x)\, b}{\sqrt{\kappa \lambda}},
          \qquad X_2 = \sqrt{\frac\lambda\kappa}\; b, \qquad
          a = \sqrt{w \tau}\; u_\tau, \quad b = \sqrt{w \tau}\; \frac{u_s}{\tau},

exactly, since the integrand is a polynomial of degree at most 2 p − 1 in τ and 2 p in s, and there
are p and p + 1 points.  The nodes and weights, the values of the trial functions at the points, λ
and x are balls here.  What is exact:

* the coefficients of bubbles and of the ℓ_k on sides, *as they are stored*: any numbers make a
  trial function, the same on both sides of an edge;
* the exponents κ, for the same reason: the space of functions of :math:`t^\kappa` is conforming
  for any κ > 0 that is the same on all faces at the vertex, however far it may be from 2π/θ.

The values at corners are differences of stored numbers and integers, which are rounded.

The sums a = A u over trial functions are products of tables and coefficients in BLAS.  Per face
and form, in the norm over all points, with m and r midpoints and radii,

.. math:: \| a - m_A m_u \| \le \big( \gamma_n \| |m_A| \| + \|r_A\|_F \big) \|m_u\|
          + \big( \| |m_A| \| + \|r_A\|_F \big) \|r_u\| ,

and the same for b.  So radii are single numbers for each face and form, not one at each point:
a proof takes little more than the energies themselves.  The few functions of low order have the
large coefficients, the many of high order small ones.  So the sums are formed in groups of one
order after the other, each with its own n and ‖u‖, which keeps the bound within a few units in
the last place, like the rounding itself.

References
----------
Higham, "Accuracy and stability of numerical algorithms" (2002), chapter 3.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import flint
import numpy as np
from flint import arb
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.elements import Elements, HighOrderForms, ReferenceElement, jumps, unknowns
from igl_periods.run_log import progress

from .midpoint_radius import UNIT, Balls, gamma, inner_products, norms, total
from .shapes import check_known, cotangents, double_areas

_BITS = 192
_UP = 1.0 + 2.0**-30
_TINY = 2.0**-500


@dataclass(frozen=True, eq=False)
class Table:
    """Values of some trial functions at the points of the quadrature, in balls.

    Attributes
    ----------
    mid : (q, n) float
    size, error : float
        Upper bounds of the norms of the matrices of absolute values, and of radii.
    """

    mid: Floats
    size: float
    error: float

    @classmethod
    def of(cls, values: Balls) -> Table:
        """Balls (q, n) with the norms that matter."""
        return cls(values.mid, _norm_of_absolute(values.mid), _frobenius(values.rad))


@dataclass(frozen=True, eq=False)
class EnclosedReference:
    """The tables of a reference element, in balls.

    Attributes
    ----------
    nodes : (q,) balls
        The values of s at the quadrature points.
    groups : tuple of (n_i,) int
        The trial functions, by increasing order.
    by_tau, by_s : tuple of Table
        For each group sqrt(w τ) u_τ and sqrt(w / τ) u_s.
    """

    nodes: Balls
    groups: tuple[Ints, ...]
    by_tau: tuple[Table, ...]
    by_s: tuple[Table, ...]


@lru_cache(maxsize=64)
def enclosed_reference(reference: ReferenceElement) -> EnclosedReference:
    """The tables of an element at the points of its quadrature, in balls."""
    with flint.ctx.workprec(_BITS):
        s, s_root = _gauss(reference.degree + 1)
        tau, tau_root = _gauss(reference.degree)
        along, slope = _angular_functions(reference.degree, s)
        pairs = list(zip(reference.powers.tolist(), reference.factors[:, 1].tolist(), strict=True))
        radial = {pair: _radial_function(*pair, tau) for pair in set(pairs)}
        root = [weight * t.sqrt() for weight, t in zip(tau_root, tau, strict=True)]
        by_tau = [_outer(s_root, [-x for x in root])]
        by_s = [_outer([arb(0)] * len(s), root)]
        in_s = reference.factors[:, 0].tolist()
        for pair, i, sign in zip(pairs, in_s, reference.signs.tolist(), strict=True):
            quotient, derivative = radial[pair]
            weighted = [weight * int(sign) for weight in s_root]
            by_tau.append(_outer(_times(weighted, along[i]), _times(root, derivative)))
            by_s.append(_outer(_times(weighted, slope[i]), _times(root, quotient)))
        nodes = _balls([x for x in s for _ in tau])
    groups = _by_order(reference)
    tables = (
        tuple(Table.of(values[:, group]) for group in groups)
        for values in (_stacked(by_tau), _stacked(by_s))
    )
    return EnclosedReference(nodes, groups, *tables)


def _by_order(reference: ReferenceElement) -> tuple[Ints, ...]:
    """The trial functions in groups: of order 1, of order 2, up to 4, 8, …"""
    degree_in_tau = np.maximum(reference.factors[:, 1] + 2, 1)
    order = np.concatenate([[1], np.maximum(reference.factors[:, 0], degree_in_tau)])
    group = np.ceil(np.log2(order)).astype(np.int64)
    return tuple(np.flatnonzero(group == g) for g in range(int(group.max()) + 1))


def enclosed_energies(forms: HighOrderForms, lengths: Balls) -> Balls:
    """Dirichlet products ∫ ω_i ∧ *ω_j of the forms; (k, k).

    Parameters
    ----------
    forms : HighOrderForms
        Any coefficients; those of least energy give the least energies.
    lengths : (m, 3) balls
        The sides of the faces of ``forms.complex``.

    Raises
    ------
    ComplexError
        If a triangle may be degenerate.
    """
    return total(_on_blocks(forms, lengths))


def _on_blocks(forms: HighOrderForms, lengths: Balls) -> Iterator[Balls]:
    by_edge = forms.cochains.T.tocsr()
    done, n_faces, k = 0, forms.complex.n_faces, forms.cochains.shape[0]
    for elements, extension in zip(forms.elements, forms.extensions, strict=True):
        tables = enclosed_reference(elements.reference)
        for block in elements.blocks(max(k, 1) * tables.nodes.shape[0]):
            progress("energies in balls", done, n_faces)
            done += block.size
            u, error = _coefficients(forms, by_edge, elements, extension[block], block)
            shapes = _shapes(elements, block, lengths)
            for X, radius in _gradients(tables, shapes, u, error):
                yield _gram(X, radius)


def _gram(X: Floats, radius: Floats) -> Balls:
    """Xᵀ X for (q, b, k) values that are off by ``radius`` (b, k) at most, in norm over q."""
    q, b, k = X.shape
    rows = Balls.exact(X.reshape(q * b, k))
    D = inner_products(rows, rows)
    size, error = norms(rows.mid), norms(radius)
    spread = np.outer(size, error) + np.outer(error, size + error)
    return Balls(D.mid, (D.rad + spread) * _UP)


def _coefficients(
    forms: HighOrderForms, by_edge: csr_array, elements: Elements, extension: Floats, block: Ints
) -> tuple[Floats, Floats]:
    """Coefficients (n, b, k), 0 at the apex, and the norms (b, k) of what they are off by."""
    K = forms.complex
    index, sign = unknowns(K, elements, block)
    u = sign[:, :, None] * forms.traces[index]
    u[:, 1:3] -= u[:, :1]
    rounding = np.abs(u[:, 1:3])
    u[:, 0] = 0.0
    u[:, 1:3] += jumps(K, by_edge, elements, block)
    rounding = 1.01 * UNIT * (rounding + np.abs(u[:, 1:3]))
    whole = np.concatenate([u, extension @ u], axis=1).transpose(1, 0, 2)
    return np.ascontiguousarray(whole), np.hypot(rounding[:, 0], rounding[:, 1]) * _UP + _TINY


class _Shapes(NamedTuple):
    """Faces seen from their apexes; (b,) balls.

    Height over length of the side opposite the apex, the foot of the height on it, exponents.
    """

    aspect: Balls
    foot: Balls
    kappa: Balls


def _shapes(elements: Elements, block: Ints, lengths: Balls) -> _Shapes:
    face, apex = elements.face[block], elements.apex[block]
    sides = lengths[face]
    double_area = double_areas(sides)
    check_known(double_area)
    opposite = sides[np.arange(face.size), apex]
    aspect = double_area / (opposite * opposite)
    foot = aspect * cotangents(sides, double_area, (apex + 1) % 3)
    return _Shapes(aspect, foot, Balls.exact(elements.kappa[block]))


def _gradients(
    tables: EnclosedReference, shapes: _Shapes, u: Floats, error: Floats
) -> Iterator[tuple[Floats, Floats]]:
    """X_1 and X_2 at the points, (q, b, k), and how far they are off in norm over q, (b, k)."""
    aspect, foot, kappa = shapes
    by_group = [u[group] for group in tables.groups]
    a, error_a = _sums(tables.by_tau, by_group, error)
    d, error_d = _sums(tables.by_s, by_group, error)
    size_a, size_d = _norms(a), _norms(d)
    of_a = (kappa / aspect).sqrt()
    of_d = (kappa * aspect).sqrt()
    across = tables.nodes[:, None] - foot[None, :]
    slope = (across / of_d[None, :])[:, :, None]
    # The largest over the points of one face: radii are counted in norm over all points.
    steep, blur = slope.upper.max(axis=0), slope.rad.max(axis=0)
    wide, off = of_a.upper[:, None], of_a.rad[:, None]
    first = of_a.mid[:, None] * a
    second = slope.mid * d
    radius = off * size_a + wide * error_a + blur * size_d + steep * error_d
    radius += 3.0 * UNIT * (wide * size_a + steep * size_d)
    yield first - second, radius * _UP + _TINY
    down = (aspect / kappa).sqrt()
    wide, off = down.upper[:, None], down.rad[:, None]
    radius = off * size_d + wide * (error_d + UNIT * size_d)
    yield down.mid[:, None] * d, radius * _UP + _TINY


def _sums(tables: tuple[Table, ...], u: list[Floats], error: Floats) -> tuple[Floats, Floats]:
    """Sums over trial functions (q, b, k), and how far they are off in norm over q, (b, k).

    The coefficients (n_i, b, k) of the first group are off by ``error`` (b, k).
    """
    b, k = error.shape
    values = np.zeros((len(tables[0].mid), b, k))
    radius = (tables[0].size + tables[0].error) * error
    for table, part in zip(tables, u, strict=True):
        n = len(part)
        values += (table.mid @ part.reshape(n, b * k)).reshape(values.shape)
        # Each of the groups is rounded when it is added, and whenever one is added to it.
        radius += (gamma(n + len(tables)) * table.size + table.error) * _norms(part)
    return values, radius * _UP


def _norms(values: Floats) -> Floats:
    """Upper bounds of the norms over the first axis of an array (q, b, k)."""
    return np.asarray(np.sqrt(np.einsum("qbk,qbk->bk", values, values)) * _UP + _TINY)


def _norm_of_absolute(A: Floats) -> float:
    """An upper bound of the norm of the matrix of the absolute values."""
    size = np.abs(A)
    v: Floats = np.ones(A.shape[1])
    for _ in range(20):
        v = size.T @ (size @ v)
        v = v / v.max() + 1e-3
    # ‖M‖ ≤ max (M v)_i / v_i for a symmetric M without negative entries, M = |A|ᵀ |A|.
    return float(np.sqrt((size.T @ (size @ v) / v).max())) * _UP


def _frobenius(A: Floats) -> float:
    return float(np.sqrt(np.sum(A**2))) * _UP + _TINY


def _gauss(n: int) -> tuple[list[arb], list[arb]]:
    """Gauss–Legendre points on [0, 1], ascending, and the roots of their weights."""
    pairs = [arb.legendre_p_root(n, k, weight=True) for k in reversed(range(n))]
    return [(1 + x) / 2 for x, _ in pairs], [(w / 2).sqrt() for _, w in pairs]


def _radial_function(b: int, j: int, points: list[arb]) -> tuple[list[arb], list[arb]]:
    """R/τ and R' for R = τ^b (j = -1) or the bubble -c/(j+1) τ^b (1-τ) P_j^{(1,b)}(2τ-1)."""
    power = [t ** (b - 1) for t in points]
    if j < 0:
        return power, [b * x for x in power]
    c = arb(2 * j + 3).sqrt()
    quotient = [
        -c / (j + 1) * x * (1 - t) * (2 * t - 1).jacobi_p(j, 1, b)
        for t, x in zip(points, power, strict=True)
    ]
    derivative = [
        c * x * (2 * t - 1).jacobi_p(j + 1, 0, b - 1) for t, x in zip(points, power, strict=True)
    ]
    return quotient, derivative


def _angular_functions(degree: int, s: list[arb]) -> tuple[list[list[arb]], list[list[arb]]]:
    """1 - s, s, ℓ_2(s), …, ℓ_p(s) and their derivatives."""
    one = [arb(1)] * len(s)
    values, derivatives = [[1 - x for x in s], s], [[-x for x in one], one]
    for k in range(2, degree + 1):
        quotient, derivative = _radial_function(1, k - 2, s)
        values.append(_times(s, quotient))
        derivatives.append(derivative)
    return values, derivatives


def _times(one: list[arb], other: list[arb]) -> list[arb]:
    return [x * y for x, y in zip(one, other, strict=True)]


def _outer(over_s: list[arb], over_tau: list[arb]) -> Balls:
    """Products at all points (s, τ), the values of τ running faster; (q,)."""
    return (_balls(over_s)[:, None] * _balls(over_tau)[None, :]).reshape(-1)


def _balls(values: list[arb]) -> Balls:
    """Floating-point balls around those of python-flint."""
    mid = np.array([float(x) for x in values])
    rad = [abs(x - m).upper() for x, m in zip(values, mid.tolist(), strict=True)]
    return Balls(mid, np.nextafter(np.array([float(r) for r in rad]), np.inf))


def _stacked(columns: list[Balls]) -> Balls:
    return Balls(
        np.stack([column.mid for column in columns], axis=1),
        np.stack([column.rad for column in columns], axis=1),
    )
