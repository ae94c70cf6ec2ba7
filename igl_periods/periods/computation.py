"""From a surface to its period matrix: the steps, one after the other.

    V, F ─ delta_complex ▶ K ─ homology ▶ cochains ─ delaunay ▶ K′, cochains′
         ─ harmonic ▶ D ─ periods ▶ Π, bound

The basis of homology is chosen once, on the surface as it is given, and the cochains carry it
through all that follows.  So the matrices of every option are in the same marking, and can be
compared entry by entry.
"""

from __future__ import annotations

from functools import partial

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csc_matrix

from igl_periods import elements
from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex, MarkedComplex, extrinsic_weights, intrinsic_delaunay
from igl_periods.elements import high_order_forms, separate_cones
from igl_periods.harmonic import (
    HarmonicProblem,
    factored,
    harmonic_energies,
    harmonic_potentials,
    harmonic_problem,
    weighted_energies,
)
from igl_periods.run_log import stage
from igl_periods.topology import mark

from .adaptive_degree import period_matrix_within
from .arguments import as_complex, check_options, edge_weights
from .certificate import certified_period_matrix
from .matrix import PeriodMatrix
from .memory_estimates import check_high_order, room_for_forms
from .solved_forms import solve_forms


def period_matrix(
    surface: DeltaComplex | ArrayLike,
    F: ArrayLike | None = None,
    *,
    weights: str = "intrinsic",
    delaunay: bool = True,
    degree: int = 1,
    tolerance: float | None = None,
    max_unknowns: int | None = None,
    max_memory: float | None = None,
    keep_forms: bool = False,
) -> PeriodMatrix:
    """Compute the period matrix of a closed, oriented, connected polyhedral surface.

    Parameters
    ----------
    surface : (n, d) array-like, DeltaComplex, or mesh object
        Vertex positions V of a triangle mesh, a complex, or an object with ``vertices`` and
        ``triangles`` or ``faces``, such as Open3D's ``TriangleMesh``.
    F : (m, 3) array-like of int, optional
        Corners of the triangles, with V.
    weights : {"intrinsic", "extrinsic"}
        How ρ is measured: on the surface (cotangents), or between circumcentres in space, on the
        triangulation as given.  There is no certificate for extrinsic weights.
    delaunay : bool
        Make the triangulation intrinsically Delaunay first.  The surface stays the same; the
        bound gets sharper.
    degree : int
        Degree of the trial functions.  1 is the theory of the paper; from 2 on the functions are
        polynomials of this degree on flat faces, and powers of the distance at cone points, and
        the bound falls exponentially with the degree.
    tolerance : float, optional
        Raise the degree, and divide faces where that is cheaper, until ``bound`` is at most this.
    max_unknowns : int, optional
        With ``tolerance``: solve no system with more unknowns.
    max_memory : float, optional
        Bytes that the computation may take; by default what is available.  Where the functions of
        all forms have no room at once, which is a matter of high genus, they are computed in
        portions.
    keep_forms : bool
        Keep the forms in the result, so that derivatives cost no new solution.  Not with a
        tolerance or extrinsic weights.

    Returns
    -------
    PeriodMatrix
        Of genus 0: a 0 × 0 matrix.

    Raises
    ------
    MeshError
        If V and F are no triangulated surface (:meth:`DeltaComplex.from_mesh`).
    ComplexError
        If the surface is not closed, oriented and connected, its triangles are too degenerate, or
        the weights define no positive definite energy.
    MemoryLimitError
        If the computation would take more memory than it may.
    ValueError
        If an option has no such value, or options contradict each other: extrinsic weights have
        degree 1 and no bound, and a tolerance chooses the degree.

    Warns
    -----
    ToleranceWarning
        If the tolerance is not met.  The result is the best one, with its bound.

    Examples
    --------
    >>> from igl_periods import DeltaComplex, period_matrix
    >>> torus = DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))])
    >>> pm = period_matrix(torus)
    >>> pm.genus, bool(abs(pm.reduced().matrix[0, 0] - 1j) < 1e-12), pm.bound < 1e-12
    (1, True, True)
    """
    check_options(weights, degree, tolerance)
    if keep_forms and (weights == "extrinsic" or tolerance is not None):
        raise ValueError(
            "forms are kept with intrinsic weights and a degree that is given: compute once with "
            "the tolerance, and again with the degree that it took."
        )
    K = as_complex(surface, F)
    room = room_for_forms(K, max_memory)
    if weights == "extrinsic":
        return _uncertified(K, extrinsic_weights(K))
    with stage("homology"):
        given = mark(K)
    if keep_forms:
        forms, raw, allowance = solve_forms(given, delaunay=delaunay, degree=degree)
        return certified_period_matrix(given, raw, allowance, forms)
    certify = partial(certified_period_matrix, given)
    if tolerance is not None:
        where = _triangulated(given, delaunay)
        return period_matrix_within(where, certify, tolerance, max_unknowns, max_memory)
    if degree > 1:
        separated = _triangulated(given, delaunay).after(separate_cones)
        check_high_order(separated.complex, degree, given.rank, max_memory)
        return certify(*_high_order(separated, degree))
    # Nothing keeps the flipped complex while its Laplacian is factored, nor this one afterwards:
    # the factor takes the memory of all of them.
    laplacian, problem = _linear_problem(_triangulated(given, delaunay))
    with stage("factorisation"):
        factor = factored(laplacian)
        del laplacian
    with stage("harmonic forms"):
        return certify(*harmonic_energies(problem, factor, room))


def period_matrix_from_weights(rho: ArrayLike, twin: ArrayLike) -> PeriodMatrix:
    """Compute the period matrix of an abstract discrete conformal structure.

    Parameters
    ----------
    rho : (m, 3) array-like
        The weight of each side, equal on glued sides.
    twin : (m, 3) array-like of int
        The gluing, as in :meth:`DeltaComplex.from_gluing`.

    Returns
    -------
    PeriodMatrix
        Without a certificate.  Its ``complex`` has the combinatorics; its lengths are all 1 and
        mean nothing.

    Raises
    ------
    ComplexError
        If the gluing or the weights are malformed, weights differ on glued sides, the surface is
        not closed and connected, or the energy is not positive definite.
    """
    K = DeltaComplex.from_gluing(np.ones(np.shape(twin)), twin)
    return _uncertified(K, edge_weights(K, rho))


def _triangulated(given: MarkedComplex, delaunay: bool) -> MarkedComplex:
    """The triangulation on which forms are computed, and the cochains there."""
    if not delaunay:
        return given
    with stage("Delaunay flips"):
        return given.after(intrinsic_delaunay)


def _linear_problem(where: MarkedComplex) -> tuple[csc_matrix, HarmonicProblem]:
    return harmonic_problem(where.complex, where.cochains)


def _high_order(where: MarkedComplex, degree: int) -> tuple[Floats, float]:
    """Dirichlet matrix of the forms of some degree, and what rounding can change in it."""
    with stage(f"forms of degree {degree}"):
        forms = high_order_forms(where.complex, where.cochains, degree)
    with stage("energies"):
        D = elements.dirichlet_matrix(forms)
        return D, elements.rounding_allowance(forms, D)


def _uncertified(K: DeltaComplex, rho: Floats) -> PeriodMatrix:
    with stage("homology"):
        given = mark(K)
    with stage("harmonic forms"):
        potentials = harmonic_potentials(K, rho, given.cochains)
    with stage("energies"):
        raw = weighted_energies(K, rho, given.cochains, potentials)
        D = given.basis @ raw @ given.basis.T
        return PeriodMatrix(D, certified=False, cocycles=given.cocycles(), complex=K)
