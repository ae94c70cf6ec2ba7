"""From a surface to its period matrix: the steps, one after the other.

    V, F ─ delta_complex ▶ K ─ homology ▶ cochains ─ delaunay ▶ K′, cochains′
         ─ harmonic ▶ D ─ periods ▶ Π, bound

The basis of homology is chosen once, on the surface as it is given, and the cochains carry it
through all that follows.  So the matrices of every option are in the same marking, and can be
compared entry by entry.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Floats
from igl_periods.complexes import (
    DeltaComplex,
    MarkedComplex,
    SurfaceLike,
    as_complex,
    extrinsic_weights,
)
from igl_periods.elements import high_order_forms, separate_cones
from igl_periods.harmonic import (
    factor_operations,
    factored,
    harmonic_potentials,
    weighted_energies,
)
from igl_periods.machine import threads_for
from igl_periods.options import checked_switch
from igl_periods.run_log import stage
from igl_periods.topology import mark

from .adaptive_degree import period_matrix_within
from .arguments import check_kept_forms, checked_limits, checked_options, edge_weights
from .certificate import Method, WithAllowance
from .keeping import Keeping
from .matrix import PeriodMatrix
from .memory_estimates import check_high_order, room_for_forms
from .proof import Proved


def period_matrix(
    surface: SurfaceLike | ArrayLike,
    F: ArrayLike | None = None,
    *,
    weights: str = "intrinsic",
    delaunay: bool = True,
    degree: int = 1,
    tolerance: float | None = None,
    max_unknowns: float | None = None,
    max_memory: float | None = None,
    rigorous: bool = False,
    keep_forms: bool = False,
) -> PeriodMatrix:
    """Compute the period matrix of a closed, oriented, connected polyhedral surface.

    Parameters
    ----------
    surface : surface
        Vertex positions V (n, d) of a triangle mesh, with F; a :class:`DeltaComplex`; ``(V, F)``;
        a path; or a mesh of trimesh, Open3D, PyVista or meshio
        (:func:`~igl_periods.complexes.as_complex`).
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
    max_unknowns : number, optional
        With ``tolerance``: solve no system with more unknowns.
    max_memory : float, optional
        Bytes that the computation may take; by default what is available.  Where the functions of
        all forms have no room at once, which is a matter of high genus, they are computed in
        portions.
    rigorous : bool
        Prove the bound: all that it depends on is computed in balls that cover every rounding,
        at nearly the speed of floating point.  The surface is the one whose triangles have the side
        lengths that the complex stores, exactly.
    keep_forms : bool
        Keep the forms in the result, so that derivatives cost no new solution.  With a proof they
        are computed for themselves, as it keeps none.  Not with extrinsic weights.

    Returns
    -------
    PeriodMatrix
        Of genus 0: a 0 × 0 matrix.

    Raises
    ------
    MeshError
        If V and F are not a triangulated surface (:meth:`DeltaComplex.from_mesh`).
    ComplexError
        If the surface is not closed, oriented and connected, its triangles are too degenerate, or
        the weights define no positive definite energy; with ``rigorous``, if rounding leaves
        nothing to prove.
    MemoryLimitError
        If the computation would take more memory than it may.
    ValueError
        If an option has no such value, or options contradict each other: extrinsic weights have
        degree 1 and no bound, hence nothing to prove, and a tolerance chooses the degree.
    ArithmeticError
        If a proof is wanted where floating-point numbers are not rounded to nearest, or tiny ones
        are flushed to zero.

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
    >>> proved = period_matrix(torus, rigorous=True)
    >>> proved.rigorous, proved.bound < 1e-12
    (True, True)
    """
    degree, tolerance = checked_options(weights, degree, tolerance, rigorous)
    max_unknowns, max_memory = checked_limits(max_unknowns, max_memory)
    delaunay = checked_switch("delaunay", delaunay)
    rigorous = checked_switch("rigorous", rigorous)
    if checked_switch("keep_forms", keep_forms):
        check_kept_forms(weights)
    K = as_complex(surface, F)
    if rigorous and keep_forms:
        compute = partial(
            period_matrix,
            K,
            delaunay=delaunay,
            degree=degree,
            tolerance=tolerance,
            max_unknowns=max_unknowns,
            max_memory=max_memory,
        )
        return replace(compute(rigorous=True), forms=compute(keep_forms=True).forms)
    with threads_for(_largest_piece(K)):
        room = room_for_forms(K, max_memory)
        if weights == "extrinsic":
            return _uncertified(K, extrinsic_weights(K))
        with stage("homology"):
            given = mark(K)
        method = _method(given, rigorous, keep_forms)
        if tolerance is not None:
            where = method.triangulation(delaunay)
            return period_matrix_within(where, method, tolerance, max_unknowns, max_memory)
        if degree > 1:
            where = method.triangulation(delaunay)
            check_high_order(where.after(separate_cones).complex, degree, given.rank, max_memory)
            with stage(f"forms of degree {degree}"):
                forms = high_order_forms(where.complex, where.cochains, degree)
            return method.high_order(where, forms)
        # Nothing keeps the flipped complex while its Laplacian is factored, nor this one
        # afterwards: the factor takes the memory of all of them.
        laplacian, problem = method.problem(method.triangulation(delaunay))
        with stage("factorisation"):
            factor = factored(laplacian)
            del laplacian
        with stage("harmonic forms"):
            return method.linear(problem, factor, room)


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

    Examples
    --------
    The square torus of two triangles: its diagonal has the weight 0.

    >>> import igl_periods as ip
    >>> import numpy as np
    >>> twin = [[3, 4, 5], [0, 1, 2]]
    >>> pm = ip.period_matrix_from_weights(np.tile([0.0, 1.0, 1.0], (2, 1)), twin)
    >>> pm.reduced().matrix.round(9), pm.bound
    (array([[0.+1.j]]), None)
    """
    K = DeltaComplex.from_gluing(np.ones(np.shape(twin)), twin)
    return _uncertified(K, edge_weights(K, rho))


def _largest_piece(K: DeltaComplex) -> float:
    """Operations of the Cholesky factor, or of a product of dense matrices of all forms.

    Either is much where threads are worth it; everything else is less.
    """
    n_forms = max(2 - K.euler_characteristic, 0)
    return max(2.0 * n_forms**3, factor_operations(K.n_vertices))


def _method(given: MarkedComplex, rigorous: bool, keep_forms: bool) -> Method:
    """How energies are computed: in floating point, also with forms that are kept, or in balls."""
    if rigorous:
        return Proved(given)
    return Keeping(given) if keep_forms else WithAllowance(given)


def _uncertified(K: DeltaComplex, rho: Floats) -> PeriodMatrix:
    with stage("homology"):
        given = mark(K)
    with stage("harmonic forms"):
        potentials = harmonic_potentials(K, rho, given.cochains)
    with stage("energies"):
        raw = weighted_energies(K, rho, given.cochains, potentials)
        D = given.basis @ raw @ given.basis.T
        return PeriodMatrix(D, certified=False, cocycles=given.cocycles(), complex=K)
