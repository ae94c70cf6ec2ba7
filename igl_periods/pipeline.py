"""From a surface to its period matrix: the steps, one after the other.

    V, F ─ delta_complex ▶ K ─ homology ▶ cochains ─ delaunay ▶ K′, cochains′
         ─ harmonic ▶ D ─ periods ▶ Π, bound

The basis of homology is chosen once, on the surface as it is given, and the cochains carry it
through all that follows.  So the matrices of every option are in the same marking, and can be
compared entry by entry.
"""

from __future__ import annotations

from functools import partial
from numbers import Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from . import high_order
from .adaptive import Triangulation, period_matrix_within
from .delaunay import intrinsic_delaunay
from .delta_complex import DeltaComplex, extrinsic_weights
from .errors import ComplexError, MeshError
from .harmonic import factorised, harmonic_potentials, weighted_energies
from .harmonic_energies import harmonic_energies, harmonic_problem
from .high_order import high_order_forms, separate_cones
from .homology import cochains_and_basis
from .memory import check_faces, check_high_order, room_for_forms
from .periods import PeriodMatrix
from .rounding import LEAST_ALLOWANCE, combined, congruence
from .stages import stage
from .validation import check_equal_when_glued, checked_array

Floats = NDArray[np.float64]

# Where rounding may change energies by more, relative to them, nothing is known of the matrix.
_LARGEST_ROUNDING = 1.0

_LARGEST_WEIGHT = 1e100


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
    K = as_complex(surface, F)
    room = room_for_forms(K, max_memory)
    if weights == "extrinsic":
        return _uncertified(K, extrinsic_weights(K))
    with stage("homology"):
        cochains, T = cochains_and_basis(K)
    certify = partial(certified_period_matrix, K, cochains, T)
    if tolerance is not None:
        where = Triangulation(*_triangulated(K, cochains, delaunay), T.astype(np.int64))
        return period_matrix_within(where, certify, tolerance, max_unknowns, max_memory)
    if degree > 1:
        separated = separate_cones(*_triangulated(K, cochains, delaunay))
        check_high_order(separated[0], degree, cochains.shape[0], max_memory)
        return certify(*_high_order(*separated, degree))
    # Nothing keeps the flipped complex while its Laplacian is factored, nor this one afterwards:
    # the factor takes the memory of all of them.
    laplacian, problem = harmonic_problem(*_triangulated(K, cochains, delaunay))
    with stage("factorisation"):
        factor = factorised(laplacian)
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
    return _uncertified(K, _edge_weights(K, rho))


def as_complex(surface: Any, F: ArrayLike | None = None) -> DeltaComplex:
    """The Δ-complex of ``(V, F)`` or of a mesh object, or ``surface`` itself if it is one.

    Mesh objects are Open3D's ``TriangleMesh`` and whatever else has ``vertices`` and ``triangles``
    or ``faces``.
    """
    if isinstance(surface, DeltaComplex):
        if F is not None:
            raise MeshError("a DeltaComplex has its own faces: leave F away.")
        return surface
    if F is None and hasattr(surface, "vertices"):
        faces = "triangles" if hasattr(surface, "triangles") else "faces"
        surface, F = np.asarray(surface.vertices), getattr(surface, faces, None)
    if F is None:
        raise MeshError("faces are missing: call period_matrix(V, F), or period_matrix(K).")
    check_faces(len(np.asarray(F)))
    with stage("surface"):
        return DeltaComplex.from_mesh(surface, np.asarray(F))


def check_options(weights: str, degree: int, tolerance: float | None) -> None:
    """Refuse options of :func:`period_matrix` that have no such value or contradict each other."""
    if weights not in ("intrinsic", "extrinsic"):
        raise ValueError(f'weights must be "intrinsic" or "extrinsic", not {weights!r}.')
    if not (isinstance(degree, Real) and float(degree).is_integer() and degree >= 1):
        raise ValueError(f"degree = {degree}: trial functions have degree 1 at least.")
    if tolerance is not None and not tolerance > 0.0:
        raise ValueError(f"tolerance = {tolerance}: a bound is always positive.")
    if weights == "extrinsic" and (degree != 1 or tolerance is not None):
        raise ValueError("extrinsic weights have degree 1 and no bound: leave both options away.")
    if degree != 1 and tolerance is not None:
        raise ValueError("a tolerance chooses the degree: leave one of the two away.")


def _triangulated(
    K: DeltaComplex, cochains: csr_array, delaunay: bool
) -> tuple[DeltaComplex, csr_array]:
    """The triangulation on which forms are computed, and the cochains there."""
    if not delaunay:
        return K, cochains
    with stage("Delaunay flips"):
        return intrinsic_delaunay(K, cochains)


def _high_order(K: DeltaComplex, cochains: csr_array, degree: int) -> tuple[Floats, float]:
    """Dirichlet matrix of the forms of some degree, and what rounding can change in it."""
    with stage(f"forms of degree {degree}"):
        forms = high_order_forms(K, cochains, degree)
    with stage("energies"):
        D = high_order.dirichlet_matrix(forms)
        return D, high_order.rounding_allowance(forms, D)


def certified_period_matrix(
    K: DeltaComplex, cochains: csr_array, T: NDArray[np.int8], raw: Floats, allowance: float
) -> PeriodMatrix:
    """The period matrix in the canonical basis T c, from energies in the classes c."""
    D, loss = congruence(T, raw)
    rounding = combined(allowance, loss)
    if rounding > _LARGEST_ROUNDING:
        raise ComplexError(
            f"rounding may change the energies of the forms by a factor {1 + rounding:.3g}: the "
            "triangles are too extreme for double precision. Remesh them; with delaunay=False "
            "(--no-delaunay) let edges be flipped."
        )
    return PeriodMatrix(
        dirichlet=D,
        certified=True,
        cocycles=_combined(T, cochains),
        complex=K,
        rounding=max(LEAST_ALLOWANCE, rounding),
    )


def _uncertified(K: DeltaComplex, rho: Floats) -> PeriodMatrix:
    with stage("homology"):
        cochains, T = cochains_and_basis(K)
    with stage("harmonic forms"):
        potentials = harmonic_potentials(K, rho, cochains)
    with stage("energies"):
        D = T @ weighted_energies(K, rho, cochains, potentials) @ T.T
        return PeriodMatrix(D, certified=False, cocycles=_combined(T, cochains), complex=K)


def _combined(T: NDArray[np.int8], cochains: csr_array) -> csr_array:
    return csr_array(csr_array(T.astype(np.int64)) @ cochains)


def _edge_weights(K: DeltaComplex, rho: ArrayLike) -> Floats:
    array = checked_array(rho, "rho", ComplexError)
    if array.shape != K.twin.shape or array.dtype.kind not in "iuf":
        raise ComplexError(
            f"rho must be a real array of the shape of twin, {K.twin.shape}, not {array.shape} "
            f"of {array.dtype}."
        )
    values = array.astype(np.float64)
    if not np.isfinite(values).all():
        raise ComplexError("rho has entries that are NaN or infinite.")
    if np.abs(values).max() > _LARGEST_WEIGHT:
        raise ComplexError(
            f"rho reaches {np.abs(values).max():.3g}: energies up to {_LARGEST_WEIGHT:g} can be "
            "computed. The weights of round triangles are of order 1."
        )
    check_equal_when_glued(values, K.twin, "weights")
    weights = np.empty(K.n_edges)
    weights[K.edge.ravel()] = values.ravel()
    return weights
