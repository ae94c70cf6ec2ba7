r"""Conformal maps of domains with holes onto annuli and rectangles with slits.

Let p be harmonic and q its conjugate, dq = *dp.  The domain is mapped conformally by p + iq, or by
exp(p + iq) where q grows by 2π around a hole; boundary loops on which p is constant become pieces
of vertical lines or circles, and those that are insulated, with q constant, pieces of horizontal
lines or rays.

=============  ===============================================  ================================
map            p                                                other loops become
=============  ===============================================  ================================
``circular``   0 on C_1, constant on all others, flux through   arcs of circles around 0
               C_k alone
``radial``     0 on C_1, constant on C_k, others insulated      pieces of rays from 0
``parallel``   0 and 1 on two sides of a quadrilateral,         horizontal slits
               all else insulated
=============  ===============================================  ================================

The circular one has p = Σ c_i u_i with C c = 2π (e_1 − e_k), a linear system for the capacity
matrix.  Insulated loops are mirrors: the surface is doubled along them first.

On the double, dp has the coefficients 2 c B in the canonical basis ω of cohomology, and the star of
harmonic forms is *ω = D J ω there, D the exact Dirichlet matrix: so dq has real coefficients as
well, and both are integrated from forms of least energy of high degree along the edges of the mesh.

References
----------
Nehari, "Conformal mapping" (1952), chapter VII.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import breadth_first_order

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex, double, half_edge_ends, of_a_surface
from igl_periods.elements import HighOrderForms, dirichlet_matrix, high_order_forms
from igl_periods.errors import ComplexError
from igl_periods.symplectic import standard_form
from igl_periods.topology import cohomology_basis, pairing

from .boundary_classes import BoundaryLoop, boundary_loops, doubled_with_classes
from .quadrilaterals import insulated_sides


@dataclass(frozen=True, eq=False, repr=False)
class SlitMap:
    """A conformal map of a domain, at its vertices.

    Attributes
    ----------
    values : (n_vertices,) complex
        Where each vertex goes.
    complex : DeltaComplex
    loops : list of BoundaryLoop
        C_1 … C_n.
    polar : bool
        Whether 0 is a centre of the image: boundary loops become circles, arcs or pieces of rays.
    is_bounded : bool
        Whether no point of the domain goes to infinity.
    """

    values: Complexes
    complex: DeltaComplex
    loops: list[BoundaryLoop]
    polar: bool
    is_bounded: bool = True

    def __repr__(self) -> str:
        return f"SlitMap of {self.complex.n_vertices} vertices, {len(self.loops)} boundary loops"


@of_a_surface
def circular_slit_map(K: DeltaComplex, inner: int = 1, *, degree: int = 6) -> SlitMap:
    """Map a domain onto an annulus with circular slits.

    Parameters
    ----------
    K : surface
        Plane, or of genus 0: connected, oriented, with two boundary loops at least.
    inner : int
        Which loop, counted from 0, becomes the inner circle.  Loop 0 becomes the unit circle.
    degree : int
        Degree of the trial functions.

    Raises
    ------
    ComplexError
        If the surface has handles or less than two loops, is not oriented and connected, or there
        is no such inner loop.
    """
    loops = _loops(K, inner)
    solved = _Solved.on(K, degree)
    flux = np.zeros(len(loops) - 1)
    flux[inner - 1] = -2 * np.pi
    levels = np.concatenate([[0.0], np.linalg.solve(solved.capacities[1:, 1:], flux)])
    dp, dq = solved.differentials(levels)
    return SlitMap(np.exp(_integrated(K, dp + 1j * dq, loops[0])), K, loops, polar=True)


@of_a_surface
def radial_slit_map(K: DeltaComplex, inner: int = 1, *, degree: int = 6) -> SlitMap:
    """Map a domain onto an annulus with radial slits.

    Parameters, Raises
        As for :func:`circular_slit_map`.
    """
    loops = _loops(K, inner)
    others = [loop.half_edges for k, loop in enumerate(loops) if k not in (0, inner)]
    if not others:
        return circular_slit_map(K, inner, degree=degree)
    M = double(K, along=np.concatenate(others))
    inside = set(K.labels[loops[inner].vertices].tolist())
    chosen = [int(M.labels[loop.vertices[0]]) in inside for loop in boundary_loops(M)]
    solved = _Solved.on(M, degree)
    levels = np.array(chosen, dtype=np.float64)
    # Both copies of the inner loop together have twice the flux of one.
    levels *= -4 * np.pi / float(levels @ solved.capacities @ levels)
    dp, dq = solved.differentials(levels)
    first = slice(0, 3 * K.n_faces)
    return SlitMap(np.exp(_integrated(K, (dp + 1j * dq)[first], loops[0])), K, loops, polar=True)


@of_a_surface
def parallel_slit_map(K: DeltaComplex, corners: ArrayLike, *, degree: int = 6) -> SlitMap:
    """Map a quadrilateral with holes onto a rectangle with horizontal slits.

    The side from z_1 to z_2 goes to Re w = 0, that from z_3 to z_4 to Re w = 1, and z_2 goes to 0;
    the height of the rectangle is the conductance between the two.

    Parameters
    ----------
    K : surface
        Plane, or of genus 0: connected, oriented.
    corners : (4,) array-like of int
        As for :func:`extremal_length`.
    degree : int
        Degree of the trial functions.

    Raises
    ------
    ComplexError
        As for :func:`extremal_length`, and if the surface has handles.
    """
    loops = boundary_loops(K)
    check_planar(K, loops)
    mirrors, chosen = insulated_sides(K, corners)
    M = double(K, along=mirrors)
    start = {int(M.labels[v]) for v in boundary_loops(M)[0].vertices}
    levels = np.array([0.0, 1.0]) if int(chosen[0]) in start else np.array([1.0, 0.0])
    dp, dq = _Solved.on(M, degree).differentials(levels)
    w = _integrated(K, (dp + 1j * dq)[: 3 * K.n_faces], loops[0])
    return SlitMap(w - w[np.flatnonzero(K.labels == chosen[1])[0]], K, loops, polar=False)


def _loops(K: DeltaComplex, inner: int) -> list[BoundaryLoop]:
    loops = boundary_loops(K)
    check_planar(K, loops)
    if not 1 <= inner < len(loops):
        raise ComplexError(
            f"inner = {inner}: of {len(loops)} boundary loops, counted from 0, one from 1 to "
            f"{len(loops) - 1} becomes the inner circle."
        )
    return loops


def check_planar(K: DeltaComplex, loops: list[BoundaryLoop]) -> None:
    """Raise unless a surface with these boundary loops has genus 0.

    Raises
    ------
    ComplexError
    """
    handles = (2 - len(loops) - K.euler_characteristic) // 2
    if handles:
        raise ComplexError(
            f"the surface has genus {handles}: only domains, of genus 0, are mapped to the plane."
        )


@dataclass(frozen=True, eq=False)
class _Solved:
    """Harmonic forms on the double of a surface, solved for once.

    Attributes
    ----------
    surface, double : DeltaComplex
    cocycles : (2g, n_edges) sparse int
        A canonical basis on the double.
    forms : HighOrderForms
        ω_1 … ω_2g, in these classes.
    classes : (n, 2g) int
        Those of the boundary loops in this basis.
    energies : (2g, 2g) float
        The mean of D and J D⁻¹ Jᵀ, off by the square of what D is off by.
    """

    surface: DeltaComplex
    double: DeltaComplex
    cocycles: csr_array
    forms: HighOrderForms
    classes: Ints
    energies: Floats

    @classmethod
    def on(cls, M: DeltaComplex, degree: int) -> _Solved:
        """Solve on the double of a surface."""
        L, of_loops = doubled_with_classes(M, boundary_loops(M))
        cocycles = cohomology_basis(L)
        J = standard_form(cocycles.shape[0] // 2)
        forms = high_order_forms(L, cocycles, degree)
        D = dirichlet_matrix(forms)
        mean = 0.5 * (D + J @ np.linalg.inv(D) @ J.T)
        return cls(M, L, cocycles, forms, pairing(L, of_loops, cocycles) @ -J, mean)

    @property
    def capacities(self) -> Floats:
        """The capacity matrix of the loops; (n, n)."""
        return np.asarray(2.0 * self.classes @ self.energies @ self.classes.T)

    def differentials(self, levels: Floats) -> tuple[Floats, Floats]:
        """Integrals along half-edges of dp, p = Σ levels_i u_i, and of dq = *dp; (3 m,) each."""
        L = self.double
        dp = 2.0 * levels @ self.classes
        dq = dp @ self.energies @ standard_form(len(dp) // 2)
        # Vertices keep their numbers where faces are divided, so edges of L join known values.
        f = self.forms.traces[: L.n_vertices]
        tail, head = half_edge_ends(L)
        cochains = L.sign.ravel()[:, None] * self.cocycles.T.tocsr()[L.edge.ravel()].toarray()
        along = (cochains + f[head] - f[tail])[: 3 * self.surface.n_faces]
        return np.asarray(along @ dp), np.asarray(along @ dq)


def _integrated(K: DeltaComplex, form: Complexes, loop: BoundaryLoop) -> Complexes:
    """The integral from the first vertex of a loop to all others, along a tree; (n_vertices,)."""
    tail, head = half_edge_ends(K)
    graph = coo_array((np.ones(tail.size), (tail, head)), shape=(K.n_vertices,) * 2).tocsr()
    order, before = breadth_first_order(graph, int(loop.vertices[0]), directed=False)
    step = dict(zip(zip(tail.tolist(), head.tolist()), form.tolist()))
    step |= {(b, a): -x for (a, b), x in step.items() if (b, a) not in step}
    w = np.zeros(K.n_vertices, dtype=np.complex128)
    for vertex in order[1:].tolist():
        w[vertex] = w[before[vertex]] + step[int(before[vertex]), vertex]
    return w
