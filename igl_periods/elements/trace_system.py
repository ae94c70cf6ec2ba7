r"""The sparse system for the traces of trial functions on all edges, and its solution.

The unknowns are the values at the vertices, then for each edge the coefficients of ℓ_2 … ℓ_p in
the direction of the edge.  Since :math:`\ell_k(1 - x) = (-1)^k \ell_k(x)`, a side that runs
against its edge sees the odd ones with the opposite sign.

On a face with the traces Pf of the unknowns f and those c of the potential of a cochain, the
energy is (c + Pf)ᵀ S (c + Pf) with the Schur complement S of the face
(:mod:`igl_periods.elements.condensation`).  So the least energy is that of the solution of

.. math::  \Big( \sum P^T S P \Big) f = - \sum P^T S c .

f matters up to a constant; vertex 0 gets the value 0.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix, csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex
from igl_periods.errors import ComplexError, NotPositiveDefiniteError
from igl_periods.harmonic import CholeskyFactor, factor, solve

from .condensation import condense
from .placement import Elements

# By how much the diagonal is raised where the matrix is not positive definite, one after another.
_RAISED = (0.0, 1e-13, 1e-11, 1e-9)


@dataclass(frozen=True, eq=False)
class CondensedSystem:
    """The system of equations for the traces.

    Attributes
    ----------
    matrix : (n - 1, n - 1) sparse
        The lower triangle, without unknown 0.
    load : (n, k) float
        The right-hand sides.
    extensions : tuple of (m, n_functions - 3 p, 3 p) float
        For each kind of elements: coefficients of bubbles in terms of those of traces.
    """

    matrix: csc_matrix
    load: Floats
    extensions: tuple[Floats, ...]


def condensed_system(
    K: DeltaComplex, cochains: csr_array, elements: tuple[Elements, ...]
) -> CondensedSystem:
    """Assemble the system for given elements, which cover all faces.

    Raises
    ------
    ComplexError
        If a triangle is too thin for floating-point arithmetic.
    """
    degree = elements[0].reference.degree
    n = count_unknowns(K, degree)
    load = np.zeros((n, cochains.shape[0]))
    extensions = tuple(_empty_extension(part) for part in elements)
    by_edge = cochains.T.tocsr()
    rows, columns, values = [], [], []
    for part, extension in zip(elements, extensions, strict=True):
        for block, S, E in _condensed(part):
            extension[block] = E
            index, sign = unknowns(K, part, block)
            S *= sign[:, :, None] * sign[:, None, :]
            # Potentials of cochains are linear on sides: they have the modes of vertices alone.
            np.add.at(load, index, -S[:, :, 1:3] @ jumps(K, by_edge, part, block))
            i, j = np.broadcast_arrays(index[:, :, None], index[:, None, :])
            kept = (i >= j) & (j > 0)
            rows.append(i[kept] - 1)
            columns.append(j[kept] - 1)
            values.append(S[kept])
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return CondensedSystem(csc_matrix(entries, shape=(n - 1, n - 1)), load, extensions)


def factored_system(system: CondensedSystem) -> CholeskyFactor:
    """The Cholesky factor of the matrix, or of one nearby that is positive definite.

    Rounding on extremely thin triangles can leave a matrix that is not.  Then its diagonal is
    raised by a small part of itself; the solution is only nearly the least
    (:mod:`igl_periods.elements.descent`).

    Raises
    ------
    ComplexError
        If that does not help.
    """
    for part in _RAISED:
        try:
            return factor(_raised(system.matrix, part) if part else system.matrix)
        except NotPositiveDefiniteError as error:
            failure = error
    raise _too_thin() from failure


def _raised(matrix: csc_matrix, part: float) -> csc_matrix:
    raised = matrix.copy()
    diagonal = raised.diagonal()
    raised.setdiag(diagonal + part * np.abs(diagonal))
    return raised


def least_traces(system: CondensedSystem, factor: CholeskyFactor | None = None) -> Floats:
    """The traces of least energy, 0 at vertex 0; (n, k) float.

    Parameters
    ----------
    factor : CholeskyFactor, optional
        :func:`factored_system` of the system, if it is at hand.

    Raises
    ------
    ComplexError
        As :func:`factored_system`.
    """
    traces = np.zeros_like(system.load)
    solve(factored_system(system) if factor is None else factor, system.load[1:], out=traces[1:])
    return traces


def unknowns(K: DeltaComplex, elements: Elements, block: Ints) -> tuple[NDArray[np.int32], Floats]:
    """Which unknowns the traces of some elements are, and with which sign; (b, 3 p) each."""
    p, face = elements.reference.degree, elements.face[block, None]
    k = np.arange(p - 1)
    corner = (elements.apex[block, None] + np.arange(3)) % 3
    modes = K.n_vertices + (p - 1) * K.edge[face, corner][:, :, None] + k
    signs = np.where(k % 2 == 1, K.sign[face, corner][:, :, None], 1)
    shape = (block.size, 3 * (p - 1))
    index = np.concatenate([K.corner_vertex[face, corner], modes.reshape(shape)], axis=1)
    ones = np.ones((block.size, 3))
    return index.astype(np.int32), np.concatenate([ones, signs.reshape(shape)], axis=1)


def jumps(K: DeltaComplex, by_edge: csr_array, elements: Elements, block: Ints) -> Floats:
    """Potentials of cochains at corners apex + 1 and apex + 2, 0 at the apex; (b, 2, k).

    Parameters
    ----------
    by_edge : (n_edges, k) sparse int
        The cochains as columns.
    """
    face, apex = elements.face[block], elements.apex[block]
    to_a, from_b = (apex + 2) % 3, (apex + 1) % 3
    at_a = K.sign[face, to_a, None] * by_edge[K.edge[face, to_a]].toarray()
    at_b = -K.sign[face, from_b, None] * by_edge[K.edge[face, from_b]].toarray()
    return np.stack([at_a, at_b], axis=1).astype(np.float64)


def _condensed(elements: Elements) -> Iterator[tuple[Ints, Floats, Floats]]:
    try:
        yield from condense(elements)
    except np.linalg.LinAlgError as error:
        raise _too_thin() from error


def _too_thin() -> ComplexError:
    return ComplexError(
        "the energy of trial functions is not positive definite in floating-point arithmetic: "
        "some triangles are too thin for elements of high degree. Use a lower degree, or remove "
        "needles and caps from the mesh."
    )


def _empty_extension(elements: Elements) -> Floats:
    reference = elements.reference
    n = reference.n_traces
    return np.empty((elements.face.size, reference.n_functions - n, n))


def count_unknowns(K: DeltaComplex, degree: int) -> int:
    """Unknowns of the condensed system on a complex whose cone points are separated."""
    return K.n_vertices + (degree - 1) * K.n_edges
