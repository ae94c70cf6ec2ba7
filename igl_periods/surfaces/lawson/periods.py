r"""Exact period matrices of Lawson's surfaces ξ_{m,k}, in any marking of a mesh of them.

With M = m + 1 and n = k + 1, ξ_{m,k} is conformal to the curve

.. math:: y^n = \frac{x^M - 1}{x^M + 1}

(for k = 1 to y² = x^{2m+2} − 1).  With e(t) = exp(2π√−1 t), the P_i are the points over x = 0
(i odd) and x = ∞ (i even) where y = e(i/2n), and Q_j lies over x = e(j/2M).  The forms

.. math:: ω_{a,b} = \frac{x^{a-1}\, dx}{y^b\, (x^M + 1)}, \qquad 1 ≤ a < M,\ 1 ≤ b < n,

are a basis of the holomorphic ones, and along the sides P_i Q_j they integrate to roots of unity
times

.. math:: I(a, b) = \int_0^1 \Big(\frac{1 + x^M}{1 - x^M}\Big)^{b/n} \frac{x^{a-1} dx}{1 + x^M}
          = \tfrac1M B\big(\tfrac aM, 1 - \tfrac bn\big)\,
            {}_2F_1\big(1 - \tfrac bn, \tfrac aM; \tfrac aM + 1 - \tfrac bn; -1\big).

Sides are all that is needed: the discs are simply connected, so that closed forms are known, up to
exact ones, by their integrals along sides.  Every mesh of :mod:`.lawson` has the sides as walks
along edges.  So for any integer basis α, β of cohomology *on the mesh*, A = ∫ ω ∧ β and
B = −∫ ω ∧ α follow, and Π = A⁻¹B is the exact period matrix in the marking of the mesh.

References
----------
Lawson, "Complete minimal surfaces in S³" (1970).
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 4.3.
"""

from __future__ import annotations

from fractions import Fraction

import flint
import numpy as np
from scipy.sparse import coo_array, csr_array
from scipy.special import beta, hyp2f1

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex, half_edge_ends
from igl_periods.errors import ComplexError
from igl_periods.surfaces.exact_matrices import lawson_integral, root_of_unity, symmetrised
from igl_periods.topology import cohomology_basis

from .disc import check_orders
from .surface import boundary_numbers, discs, lawson_sides


def lawson_period_matrix(m: int, k: int) -> Complexes:
    """Return the exact period matrix of ξ_{m,k}, in some marking; shape (mk, mk).

    Raises
    ------
    MeshError
        If m < 1 or k < 1.

    Examples
    --------
    >>> abs(lawson_period_matrix(1, 1) - 1j).max() < 1e-14
    np.True_
    """
    check_orders(m, k)
    K = _crossed_discs(m, k)
    return lawson_period_matrix_in(K, cohomology_basis(K), m, k, segments=1)


def lawson_period_matrix_in(
    K: DeltaComplex, cocycles: csr_array, m: int, k: int, segments: int
) -> Complexes:
    """Return the exact period matrix of ξ_{m,k} in the marking of a mesh of it.

    Parameters
    ----------
    K : DeltaComplex
        Made from a mesh of :func:`lawson_surface` or its kin, or from its stereographic image:
        ``pm.complex``.
    cocycles : (2mk, n_edges) sparse int
        Closed cochains α_1..α_g, β_1..β_g on K with ∫ α_i ∧ β_j = δ_ij: ``pm.cocycles``.
    m, k : int
    segments : int
        Number of edges of the mesh along each side P_i Q_j.

    Returns
    -------
    (mk, mk) complex

    Raises
    ------
    MeshError
        If m < 1 or k < 1.
    ComplexError
        If K has no edges along the sides.
    """
    check_orders(m, k)
    genus = m * k
    integers = _along_sides(K, cocycles, lawson_sides(m, k, segments))
    forms = side_integrals(m, k)
    A = _pairing(forms, integers[genus:], m, k)
    B = -_pairing(forms, integers[:genus], m, k)
    return np.asarray(np.linalg.solve(A, B), dtype=np.complex128)


def lawson_period_matrix_in_balls(m: int, k: int) -> flint.acb_mat:
    """The exact period matrix of ξ_{m,k} in balls, in the marking of :func:`lawson_period_matrix`.

    Computed at the working precision, ``flint.ctx.prec``.

    Raises
    ------
    MeshError
        If m < 1 or k < 1.
    """
    check_orders(m, k)
    genus, K = m * k, _crossed_discs(m, k)
    integers = _along_sides(K, cohomology_basis(K), lawson_sides(m, k, 1))
    # ∫ ω ∧ η is linear in the integrals of ω along the sides, with multiples of ½ as coefficients.
    n_sides = 4 * (k + 1) * (m + 1)
    units = np.eye(n_sides, dtype=np.complex128).reshape(n_sides, 2 * (k + 1), 2 * (m + 1))
    coefficients = _pairing(units, integers, m, k).real
    forms = flint.acb_mat(side_balls(m, k))
    A = forms * flint.acb_mat(coefficients[:, genus:].tolist())
    B = forms * flint.acb_mat((-coefficients[:, :genus]).tolist())
    return symmetrised(A.solve(B))


def side_balls(m: int, k: int) -> list[list[flint.acb]]:
    """The same as :func:`side_integrals` in balls, a row for each form, sides in order."""
    M, n = m + 1, k + 1

    def side(a: int, b: int, i: int, j: int) -> flint.acb:
        start, power = (a if i % 2 else M - a), (b if j % 2 == 0 else n - b)
        size = lawson_integral(start, power, M, n)
        turn = Fraction(i * b, 2 * n) - Fraction(j * a, 2 * M)
        negative = i % 2 == 0 and j % 2 == 0
        return root_of_unity(turn) * (-size if negative else size)

    return [
        [side(a, b, i, j) for i in range(2 * n) for j in range(2 * M)]
        for a in range(1, M)
        for b in range(1, n)
    ]


def side_integrals(m: int, k: int) -> Complexes:
    """Integrals of the holomorphic forms along the sides P_i Q_j; (mk, 2(k+1), 2(m+1)).

    They are the complex conjugates of ω_{a,b}, because the identification of the P_i and Q_j above
    reverses the orientation of the meshes.
    """
    M, n = m + 1, k + 1
    i, j = np.meshgrid(np.arange(2 * n), np.arange(2 * M), indexing="ij")
    rows = []
    for a in range(1, M):
        for b in range(1, n):
            to_zero = np.where(j % 2 == 0, _integral(a, b, M, n), _integral(a, n - b, M, n))
            to_infinity = np.where(
                j % 2 == 0, -_integral(M - a, b, M, n), _integral(M - a, n - b, M, n)
            )
            size = np.where(i % 2 == 1, to_zero, to_infinity)
            rows.append(np.exp(-1j * np.pi * (j * a / M - i * b / n)) * size)
    return np.array(rows)


def _integral(a: int, b: int, M: int, n: int) -> float:
    """I(a, b) of the module's docstring."""
    p, q = a / M, 1 - b / n
    return float(beta(p, q) * hyp2f1(q, p, p + q, -1.0) / M)


def _crossed_discs(m: int, k: int) -> DeltaComplex:
    """Every disc cut into four equilateral triangles about its centre."""
    corners = np.array([boundary_numbers(m, k, i, j, 0) for i, j in discs(m, k)])
    centre = 2 * (k + 1) + 2 * (m + 1) + np.arange(len(corners))
    ring = _ring(corners, m, k)
    faces = [np.stack([centre, ring[:, s], ring[:, (s + 1) % 4]], axis=1) for s in range(4)]
    F = np.concatenate(faces)
    return DeltaComplex.from_lengths(np.ones(F.shape), F)


def _ring(corners: Ints, m: int, k: int) -> Ints:
    """The corners P0 P1 Q0 Q1 of the discs in the order of their oriented boundaries."""
    reverse = np.array([i % 2 == 1 for i, _ in discs(m, k)])
    ring = corners[:, [0, 2, 1, 3]]
    ring[reverse] = ring[reverse][:, ::-1]
    return ring


def _along_sides(K: DeltaComplex, cocycles: csr_array, walks: Ints) -> Floats:
    """Values of cochains along walks of vertices; (rows of cocycles, 2(k+1), 2(m+1))."""
    if K.n_vertices <= walks.max():
        raise ComplexError(
            f"the mesh has {K.n_vertices} vertices, and its sides would need {walks.max() + 1}: is "
            "it a mesh of this Lawson surface, with that many segments per side?"
        )
    tail, head = half_edge_ends(K)
    shape = (K.n_vertices, K.n_vertices)
    number = coo_array((K.edge.ravel() + 1, (tail, head)), shape=shape).tocsr()
    direction = coo_array((K.sign.ravel().astype(np.int64), (tail, head)), shape=shape).tocsr()
    start, end = walks[..., :-1].ravel(), walks[..., 1:].ravel()
    edge = np.asarray(number[start, end]).ravel() - 1
    if edge.min() < 0:
        raise ComplexError("the mesh has no edges along the sides of the discs.")
    values = cocycles.tocsc()[:, edge].toarray() * np.asarray(direction[start, end]).ravel()
    return values.reshape(-1, *walks.shape[:2], walks.shape[2] - 1).sum(axis=-1).astype(np.float64)


def _pairing(forms: Complexes, integers: Floats, m: int, k: int) -> Complexes:
    """∫ ω ∧ η over the discs, from values along their sides; (forms, integers)."""
    n_p = 2 * (k + 1)
    corners = np.array([boundary_numbers(m, k, i, j, 0) for i, j in discs(m, k)])
    ring = _ring(corners, m, k)
    total = np.zeros((len(forms), len(integers)), dtype=np.complex128)
    # A disc x0 x1 x2 x3 is the triangles x0 x1 x2 and x0 x2 x3; the diagonal is x0 x1 + x1 x2.
    first, second, third = (_step(ring, s, n_p) for s in range(3))
    w1, w2, w3 = (sign * forms[:, p, q] for p, q, sign in (first, second, third))
    e1, e2, e3 = (sign * integers[:, p, q] for p, q, sign in (first, second, third))
    total += 0.5 * (w1 @ e2.T - w2 @ e1.T)
    total += 0.5 * ((w1 + w2) @ e3.T - w3 @ (e1 + e2).T)
    return total


def _step(ring: Ints, s: int, n_p: int) -> tuple[Ints, Ints, Ints]:
    """Step s along the boundaries as indices of sides (i, j) and ±1 from P to Q or back."""
    start, end = ring[:, s], ring[:, s + 1]
    from_p = start < n_p
    return np.where(from_p, start, end), np.where(from_p, end, start) - n_p, np.where(from_p, 1, -1)
