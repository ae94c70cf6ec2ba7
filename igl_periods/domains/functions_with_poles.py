r"""Analytic functions on a plane domain with given poles or zeros, constant in part on each loop.

Let S be the singular part: :math:`e^{-i\theta}/(z - a)`, :math:`\log(z - a)`, or
:math:`\log(z - a) - \log(z - b)`.  Wanted is F = S + f, f analytic, such that on each boundary loop
the real part of F is constant, or the imaginary one.

S is not a trial function.  Take a set B of faces around the singularities, away from the boundary.
Outside of B the trial functions stand for F itself, inside for f = F − S.  With x the function that
they have at the vertices, F − S in both, they jump across ∂B by the part of S that is not linear on
its edges, the coefficients of ℓ_k in it (:mod:`igl_periods.elements.reference_elements`).  The
normal derivative jumps by that of S: the real part of F minimises

.. math:: \tfrac12 \int |\nabla u|^2 + \oint_{\partial B} u\, \partial_n \operatorname{Re} S,
          \qquad \partial_n \operatorname{Re} S = \partial_t \operatorname{Im} S,

among the functions that are constant on the loops where that is wanted, each with a constant of its
own; the imaginary one is the same with −iS in the place of S.  On the other loops the normal
derivative vanishes of itself, and so do the fluxes through the loops: F is single-valued there.
Both are computed, each with the functions of high degree that are conical at the corners.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse import csc_matrix, csr_array

from igl_periods.arrays import Bools, Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex, components_of, double, split
from igl_periods.elements import (
    Elements,
    HighOrderForms,
    choose_elements,
    condense,
    count_unknowns,
    potentials,
    separate_cones,
    unknowns,
)
from igl_periods.errors import ComplexError
from igl_periods.harmonic import factor, solve

from .boundary_classes import BoundaryLoop

_MOST_DIVISIONS = 5
_NODES = 40


@dataclass(frozen=True)
class Singularity:
    """What happens at a point: z ↦ factor/(z − point), or factor · log(z − point)."""

    point: complex
    factor: complex
    logarithm: bool

    def step(self, start: Complexes, end: Complexes) -> Complexes:
        """By how much it grows along segments that do not meet the point."""
        if self.logarithm:
            return np.asarray(self.factor * np.log((end - self.point) / (start - self.point)))
        return np.asarray(self.factor * (1 / (end - self.point) - 1 / (start - self.point)))

    def derivative(self, z: Complexes) -> Complexes:
        """By z."""
        if self.logarithm:
            return np.asarray(self.factor / (z - self.point))
        return np.asarray(-self.factor / (z - self.point) ** 2)


def function_with_poles(
    K: DeltaComplex,
    loops: Sequence[BoundaryLoop],
    singularities: Sequence[Singularity],
    real: Sequence[bool],
    degree: int,
) -> tuple[Complexes, Complexes]:
    """The function f = F − S at the vertices of a domain and at the singularities.

    Parameters
    ----------
    K : DeltaComplex
        In the plane, of genus 0, counterclockwise.
    loops : sequence of BoundaryLoop
        All of its loops.
    singularities : sequence of Singularity
        S is the sum of these.
    real : sequence of bool
        For each loop whether the real part is constant there, or else the imaginary one.
    degree : int
        Of the trial functions.

    Returns
    -------
    at_vertices : (n_vertices,) complex
    at_singularities : (k,) complex
        Both up to the same constant.

    Raises
    ------
    ComplexError
        If K is not in the plane, or a singularity is not inside of the domain, or so close to its
        boundary or to another one that five divisions of all faces do not keep them apart.
    """
    _check_plane(K)
    prepared = _prepared(K, [s.point for s in singularities], degree)
    z = prepared.z
    loop = _loop_of_vertices(prepared, K, loops)
    traces = np.zeros((prepared.n_unknowns, 2))
    # The imaginary part of F is the real one of −iF.
    for column, turn in enumerate((1.0, -1.0j)):
        turned = [Singularity(s.point, turn * s.factor, s.logarithm) for s in singularities]
        fixed = np.array(real, dtype=bool) == (column == 0)
        held = np.where(loop >= 0, np.where(fixed[loop], loop, -1), -1)
        traces[:, column] = _traces(prepared, turned, held)
    f = traces @ np.array([1.0, 1.0j])
    at_points = [_value_at(prepared, traces, s.point) for s in singularities]
    vertex = np.empty(K.n_vertices, dtype=np.int64)
    vertex[K.corner_vertex] = prepared.first_corners
    return f[: len(z)][vertex], np.array(at_points)


@dataclass(frozen=True, eq=False)
class _Prepared:
    """The double of a domain, divided so that there is room around the points.

    Attributes
    ----------
    complex : DeltaComplex
        Its first half is the domain.
    elements : tuple of Elements
        On that half.
    condensed : list of (Elements, block, S, E)
    inner : (m,) bool
        The faces of B.
    z : (n_vertices,) complex
    first_corners : (faces of K, 3) int
        The vertices at the corners of the faces that were divided.
    """

    complex: DeltaComplex
    elements: tuple[Elements, ...]
    condensed: list[tuple[Elements, Ints, Floats, Floats]]
    inner: Bools
    z: Complexes
    first_corners: Ints

    @property
    def degree(self) -> int:
        return self.elements[0].reference.degree

    @property
    def n_unknowns(self) -> int:
        return count_unknowns(self.complex, self.degree)


def _check_plane(K: DeltaComplex) -> None:
    P = K.positions
    if P is None or P.shape[1] < 2 or np.ptp(P[:, 2:], axis=0).any():
        raise ComplexError("a pole is a point of the plane: the domain has to lie there.")
    z = P[:, 0] + 1j * P[:, 1]
    a, b, c = z[K.corner_vertex].T
    if np.imag(np.conj(b - a) * (c - a)).min() <= 0:
        raise ComplexError("a pole is a point of the plane: there triangles run counterclockwise.")


def _prepared(K: DeltaComplex, points: Sequence[complex], degree: int) -> _Prepared:
    L = double(K)
    first = L.corner_vertex[: K.n_faces].copy()
    none = csr_array((0, L.n_edges), dtype=np.int64)
    L, none = separate_cones(L, none)
    for division in range(_MOST_DIVISIONS + 1):
        inner = _room(L, points)
        if inner is not None:
            break
        if division == _MOST_DIVISIONS:
            raise ComplexError(
                "a pole is too close to the boundary, or to another one, for this mesh: make its "
                "triangles smaller there (planar_domain(…, area=…))."
            )
        L, none = split(L, none)
    m = L.n_faces // 2
    everywhere = choose_elements(L, degree)
    parts = [_on_faces(part, part.face < m) for part in everywhere]
    elements = tuple(part for part in parts if part.face.size)
    condensed = [(part, *block) for part in elements for block in condense(part)]
    assert L.positions is not None and inner is not None
    z = L.positions[:, 0] + 1j * L.positions[:, 1]
    return _Prepared(L, elements, condensed, inner, z, first)


def _on_faces(part: Elements, chosen: Bools) -> Elements:
    return Elements(
        part.reference,
        part.face[chosen],
        part.apex[chosen],
        part.aspect[chosen],
        part.foot[chosen],
        part.kappa[chosen],
    )


def _room(L: DeltaComplex, points: Sequence[complex]) -> Bools | None:
    """The faces of B: those around the points, or None if there is no room for them yet."""
    m = L.n_faces // 2
    corner = L.corner_vertex[:m]
    twin = L.twin[:m]
    on_boundary = np.zeros(L.n_vertices, dtype=bool)
    face, s = np.nonzero(twin >= 3 * m)
    on_boundary[corner[face, (s + 1) % 3]] = on_boundary[corner[face, (s + 2) % 3]] = True
    inner = np.zeros(m, dtype=bool)
    for point in points:
        star = np.zeros(L.n_vertices, dtype=bool)
        star[corner[_face_at(L, point)]] = True
        around = star[corner].any(axis=1)
        if on_boundary[corner[around]].any() or inner[around].any():
            return None
        inner |= around
    return inner


def _face_at(L: DeltaComplex, point: complex) -> int:
    """The face of the first sheet that contains a point."""
    weights = _barycentric(L, point)
    face = int(np.argmax(weights.min(axis=1)))
    if weights[face].min() < -1e-12:
        raise ComplexError(f"the point {point:.6g} is not inside of the domain.")
    return face


def _barycentric(L: DeltaComplex, point: complex) -> Floats:
    assert L.positions is not None
    z = (L.positions[:, 0] + 1j * L.positions[:, 1])[L.corner_vertex[: L.n_faces // 2]] - point
    areas = np.imag(np.conj(np.roll(z, -1, axis=1)) * np.roll(z, 1, axis=1))
    return np.asarray(areas / areas.sum(axis=1, keepdims=True))


def _loop_of_vertices(prepared: _Prepared, K: DeltaComplex, loops: Sequence[BoundaryLoop]) -> Ints:
    """The number of the loop that each vertex is on, −1 for those within; (n_vertices,)."""
    L = prepared.complex
    m = L.n_faces // 2
    face, s = np.nonzero(L.twin[:m] >= 3 * m)
    tail, head = L.corner_vertex[face, (s + 1) % 3], L.corner_vertex[face, (s + 2) % 3]
    _, label = components_of(tail, head, L.n_vertices)
    vertex = np.empty(K.n_vertices, dtype=np.int64)
    vertex[K.corner_vertex] = prepared.first_corners
    loop = np.full(L.n_vertices, -1, dtype=np.int64)
    for k, boundary in enumerate(loops):
        loop[label == label[vertex[boundary.vertices[0]]]] = k
    return loop


def _traces(prepared: _Prepared, singular: Sequence[Singularity], held: Ints) -> Floats:
    """The real part of F − S that is F = const on the held loops, and natural elsewhere.

    Parameters
    ----------
    held : (n_vertices,) int
        The loop of each vertex where F is constant, −1 elsewhere.
    """
    L, z, n = prepared.complex, prepared.z, prepared.n_unknowns
    modes, load = _on_the_rim(prepared, singular)
    rows, columns, values = [], [], []
    for part, block, S, _ in prepared.condensed:
        index, sign = unknowns(L, part, block)
        S = S * sign[:, :, None] * sign[:, None, :]
        inside = prepared.inner[part.face[block]]
        shift = np.where(inside[:, None], -modes[index], 0.0)
        corner = z[index[~inside, :3]]
        shift[~inside, :3] = np.real(sum(s.step(corner[:, :1], corner) for s in singular))
        np.add.at(load, index, -np.einsum("fij,fj->fi", S, shift))
        i, j = np.broadcast_arrays(index[:, :, None], index[:, None, :])
        rows.append(i.ravel())
        columns.append(j.ravel())
        values.append(S.ravel())
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    A = csc_matrix(entries, shape=(n, n))
    Q, fixed = _admissible(prepared, singular, held)
    # One value is known: F matters up to a constant.
    Q = Q[:, 1:]
    reduced = csc_matrix(Q.T @ A @ Q)
    right = np.ascontiguousarray((Q.T @ (load - A @ fixed))[:, None])
    y = np.zeros_like(right)
    solve(factor(_lower(reduced)), right, out=y)
    return np.asarray(Q @ y[:, 0] + fixed)


def _lower(matrix: csc_matrix) -> csc_matrix:
    entries = matrix.tocoo()
    kept = entries.row >= entries.col
    return csc_matrix(
        (entries.data[kept], (entries.row[kept], entries.col[kept])), shape=matrix.shape
    )


def _on_the_rim(prepared: _Prepared, singular: Sequence[Singularity]) -> tuple[Floats, Floats]:
    """Coefficients of ℓ_k in Re S on the edges of ∂B, and −∮ φ ∂_t Im S; (n_unknowns,) each."""
    L, p, z = prepared.complex, prepared.degree, prepared.z
    modes, load = np.zeros(prepared.n_unknowns), np.zeros(prepared.n_unknowns)
    m = len(prepared.inner)
    inside = np.concatenate([prepared.inner, np.zeros(m, dtype=bool)])
    face, s = np.nonzero(prepared.inner[:, None] & ~inside[L.twin[:m] // 3])
    tail, head = L.corner_vertex[face, (s + 1) % 3], L.corner_vertex[face, (s + 2) % 3]
    x, weights = np.polynomial.legendre.leggauss(_NODES)
    x, weights = 0.5 * (x + 1), 0.5 * weights
    step = (z[head] - z[tail])[:, None]
    slope = sum(one.derivative(z[tail][:, None] + x * step) for one in singular) * step
    np.add.at(load, tail, -np.imag(slope) @ (weights * (1 - x)))
    np.add.at(load, head, -np.imag(slope) @ (weights * x))
    k = np.arange(2, p + 1)
    # ℓ_k' is √(2k−1) P_{k−1}, and ℓ_k the difference of the next two.
    P = np.polynomial.legendre.legvander(2 * x - 1, p)
    derivative = np.sqrt(2 * k - 1) * P[:, k - 1]
    value = (P[:, k] - P[:, k - 2]) / (2 * np.sqrt(2 * k - 1))
    sign = np.where(k % 2 == 1, L.sign[face, s][:, None], 1)
    index = L.n_vertices + (p - 1) * L.edge[face, s][:, None] + k - 2
    modes[index] = sign * (np.real(slope) @ (weights[:, None] * derivative))
    load[index] = sign * -(np.imag(slope) @ (weights[:, None] * value))
    return modes, load


def _admissible(
    prepared: _Prepared, singular: Sequence[Singularity], held: Ints
) -> tuple[csc_matrix, Floats]:
    """Functions Q y + x_0 that make F constant on the held loops.

    The first column of Q is the constant on one loop, or the value at a vertex.
    """
    L, p = prepared.complex, prepared.degree
    n, m = prepared.n_unknowns, L.n_faces // 2
    used = np.zeros(n, dtype=bool)
    used[L.corner_vertex[:m]] = True
    modes = L.n_vertices + (p - 1) * L.edge[:m][:, :, None] + np.arange(p - 1)
    used[modes] = True
    face, s = np.nonzero(L.twin[:m] >= 3 * m)
    on_held = held[L.corner_vertex[face, (s + 1) % 3]] >= 0
    used[modes[face[on_held], s[on_held]]] = False
    fixed = np.zeros(n)
    vertices = np.flatnonzero(held >= 0)
    used[vertices] = False
    free = np.flatnonzero(used)
    loops, group = np.unique(held[vertices], return_inverse=True)
    rows = np.concatenate([vertices, free])
    columns = np.concatenate([group, loops.size + np.arange(free.size)])
    Q = csc_matrix((np.ones(rows.size), (rows, columns)), shape=(n, loops.size + free.size))
    for k in loops.tolist():
        fixed[np.flatnonzero(held == k)] = -np.real(_grown_along(prepared, singular, held == k))
    return Q, fixed


def _grown_along(prepared: _Prepared, singular: Sequence[Singularity], on_loop: Bools) -> Complexes:
    """S at the vertices of a loop, continued along it; in the order of the vertices."""
    L, z = prepared.complex, prepared.z
    m = L.n_faces // 2
    face, s = np.nonzero(L.twin[:m] >= 3 * m)
    tail, head = L.corner_vertex[face, (s + 1) % 3], L.corner_vertex[face, (s + 2) % 3]
    after = {int(a): int(b) for a, b in zip(tail, head) if on_loop[a]}
    walk = [min(after)]
    while after[walk[-1]] != walk[0]:
        walk.append(after[walk[-1]])
    places = z[walk]
    steps = sum(one.step(places[:-1], places[1:]) for one in singular)
    grown = np.zeros(L.n_vertices, dtype=np.complex128)
    grown[walk] = np.concatenate([[0], np.cumsum(steps)])
    return grown[on_loop]


def _value_at(prepared: _Prepared, traces: Floats, point: complex) -> complex:
    """F − S at a point of B whose face has no side on ∂B."""
    L = prepared.complex
    forms = HighOrderForms(
        L, csr_array((2, L.n_edges), dtype=np.int64), prepared.degree, prepared.elements,
        tuple(_extensions(prepared)), traces,
    )  # fmt: skip
    face = _face_at(L, point)
    weights = np.clip(_barycentric(L, point)[face], 0.0, None)
    grown = potentials(forms, [face], [weights / weights.sum()])[0]
    u, v = traces[L.corner_vertex[face, 0]] + grown
    return complex(u, v)


def _extensions(prepared: _Prepared) -> list[Floats]:
    return [
        np.concatenate([E for other, _, _, E in prepared.condensed if other is part])
        for part in prepared.elements
    ]
