"""Harmonic forms as values on the edges of a triangulation.

ω = c + df on edges, for every class of a canonical basis; a few at a time where the genus is so
high that not all fit into memory.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex, cotan_weights, edge_ends, of_a_surface
from igl_periods.errors import ComplexError
from igl_periods.options import checked_integer, in_words
from igl_periods.symplectic import standard_form
from igl_periods.topology import cohomology_basis, pairing

from .laplace_matrix import outflow
from .potentials import factored_laplacian, solutions


@of_a_surface
def harmonic_forms(K: DeltaComplex, cocycles: csr_array | None = None) -> Floats:
    r"""The harmonic cochains on the edges of a triangulation, in a basis of cohomology.

    Each is the form of least energy Σ ρ(e) ω(e)² in its class, with the intrinsic cotangent
    weights of this triangulation; it need not be Delaunay.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected.
    cocycles : (2g, n_edges) sparse, optional
        Closed cochains on the edges of ``K``; the default is ``cohomology_basis(K)``.

    Returns
    -------
    (2g, n_edges) float
        ∮ ω_i = δ_ij along the cycles ``homology_basis(K)``; values along edges in their direction.

    Raises
    ------
    ComplexError
        If the surface is not closed, oriented and connected, or ``cocycles`` do not fit it.

    References
    ----------
    Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.

    Examples
    --------
    >>> import igl_periods as ip
    >>> K = ip.surfaces.square_tiled_surface("omega_1", n=2)
    >>> ip.harmonic_forms(K).shape == (4, K.n_edges)
    True
    """
    return _harmonic(K, cotan_weights(K), checked_basis(K, cocycles))


@of_a_surface
def harmonic_form_blocks(
    K: DeltaComplex, cocycles: csr_array | None = None, *, rows: int = 32
) -> Iterator[Floats]:
    """The harmonic cochains a few at a time, for surfaces of so high a genus that not all fit.

    Parameters
    ----------
    K, cocycles
        As in :func:`harmonic_forms`.
    rows : int
        Forms in each block (fewer in the last one): a block takes ``8 rows n_edges`` bytes, and
        twice that while it is made.

    Yields
    ------
    (rows, n_edges) float
        Rows 0, 1, … of :func:`harmonic_forms`.  The Laplacian is factored once.

    Raises
    ------
    ValueError
        If ``rows`` is less than 1.
    ComplexError
        As :func:`harmonic_forms`.

    Examples
    --------
    >>> import igl_periods as ip
    >>> K = ip.surfaces.square_tiled_surface("omega_1", n=2)
    >>> [block.shape[0] for block in ip.harmonic_form_blocks(K, rows=3)]
    [3, 1]
    """
    rows = checked_integer("rows", rows)
    if rows < 1:
        raise ValueError(f"rows = {rows}: a block has 1 row at least.")
    return _harmonic_blocks(K, cotan_weights(K), checked_basis(K, cocycles), rows)


def harmonic_basis(
    K: DeltaComplex, weights: Floats, cocycles: csr_array | None = None
) -> tuple[Floats, Floats]:
    """The harmonic cochains in a canonical basis of cohomology, and their Dirichlet matrix.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.
    weights : (n_edges,) float
        ρ(e) ≥ 0.
    cocycles : (2g, n_edges) sparse, optional
        A canonical basis of cohomology; the default is ``cohomology_basis(K)``.

    Returns
    -------
    omega : (2g, n_edges) float
    D : (2g, 2g) float
    """
    omega = _harmonic(K, weights, checked_basis(K, cocycles))
    D = (omega * weights) @ omega.T
    return omega, 0.5 * (D + D.T)


def _harmonic(K: DeltaComplex, weights: Floats, basis: csr_array) -> Floats:
    blocks = _harmonic_blocks(K, weights, basis, max(basis.shape[0], 1))
    return next(blocks, np.zeros((0, K.n_edges)))


def _harmonic_blocks(
    K: DeltaComplex, weights: Floats, basis: csr_array, rows: int
) -> Iterator[Floats]:
    tail, head = edge_ends(K)
    sources = outflow(K.n_vertices, tail, head, weights, basis)
    factor = factored_laplacian(K, weights)
    for start in range(0, basis.shape[0], rows):
        block = slice(start, start + rows)
        f = np.ascontiguousarray(solutions(factor, sources[:, block]).T)
        yield basis[block].toarray() + (f[:, head] - f[:, tail])


def checked_basis(K: DeltaComplex, cocycles: csr_array | None) -> csr_array:
    """The default canonical basis of cohomology, or ``cocycles`` if they are one."""
    if cocycles is None:
        return cohomology_basis(K)
    expected = (2 * K.genus, K.n_edges)
    if getattr(cocycles, "shape", None) is None:
        raise ComplexError(f"cocycles must be a sparse matrix, not {in_words(cocycles)}.")
    if cocycles.shape != expected:
        raise ComplexError(
            f"cocycles must have shape {expected}, a row for each class and a column for each "
            f"edge, not {cocycles.shape}. After flips, take the cocycles that were carried along."
        )
    around = sum(side_matrix(K, s) @ cocycles.T for s in range(3))
    if around.count_nonzero():
        raise ComplexError("the cocycles are not closed on the triangles of this complex.")
    if not np.array_equal(pairing(K, cocycles, cocycles), standard_form(K.genus)):
        raise ComplexError("the cocycles are not a canonical basis: their pairing is not J.")
    return cocycles


def side_matrix(K: DeltaComplex, s: int) -> csr_array:
    """The map from cochains to their values along side s of each triangle; (m, n_edges)."""
    rows = np.arange(K.n_faces)
    return csr_array((K.sign[:, s].astype(np.int64), (rows, K.edge[:, s])), (K.n_faces, K.n_edges))
