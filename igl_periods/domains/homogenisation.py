r"""The effective conductivity of a periodic surface: its period matrix, seen by an engineer.

A sheet of conductivity 1 is M ⊂ R^d, invariant under a lattice of translations L_1 … L_k.  In a
mean field e the potential u grows by e·L_j from cell to cell, and the effective conductivity σ is
defined by

.. math:: e^T \sigma\, e = \frac1{|\Lambda|} \min_u \int_{M/\Lambda} |\nabla u|^2, \qquad
          \sigma = \frac1{|\Lambda|} \sum_{ij} N_{ij}\, L_i L_j^T,

|Λ| the volume of the parallelepiped of translations, N the energies of the classes n_1 … n_k of
cohomology that count cells: :math:`dx = \sum n_j L_j + d(\dots)`.  Where M/Λ is closed they are
part of the Dirichlet matrix.  Where it has boundary loops, the holes are insulating, the energies
those of the insulated block, or filled with perfect conductors, each at a potential of its own:
those of the conducting block (:mod:`~igl_periods.domains.conjugate_blocks`), the least over these
potentials.

Both bounds of the Dirichlet matrix bound σ, in the Loewner order.  For a plate in the plane, with R
the rotation by 90°, conjugate potentials give Keller's duality

.. math:: R\, \sigma_{insulating}\, R^T = \sigma_{conducting}^{-1} .

On a triply periodic minimal surface coordinates are harmonic: :math:`\operatorname{tr} \sigma` is
twice the area over |Λ|.

References
----------
Keller, "A theorem on the conductivity of a composite medium", J. Math. Phys. 5 (1964).
Milton, "The theory of composites" (2002), chapter 3.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import (
    DeltaComplex,
    check_connected,
    double,
    forward_half_edges,
    half_edge_ends,
    involution,
    lift,
    of_a_surface,
)
from igl_periods.errors import ComplexError
from igl_periods.periods import PeriodMatrix, period_matrix
from igl_periods.symplectic import energy_matrix

from .boundary_classes import BoundaryLoop, boundary_loops, doubled_with_classes
from .capacities import Bounds, coordinates, energy_bounds


@dataclass(frozen=True, eq=False, repr=False)
class EffectiveConductivity:
    """The effective conductivity of a periodic surface.

    ``numpy.asarray`` gives ``tensor``.

    Attributes
    ----------
    tensor : (d, d) float
        σ, of the symplectic mean; 0 across the lattice, where it has less than d translations.
    bounds : Bounds
        Lower ≤ σ ≤ upper in the Loewner order.
    period_matrix : PeriodMatrix
        Of the surface, or of its double.

    Examples
    --------
    A plane sheet conducts alike in all directions.

    >>> import igl_periods as ip
    >>> V = [[0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 2, 0]]
    >>> lattice = [[1, 0, 0], [0, 2, 0]]
    >>> K = ip.DeltaComplex.from_mesh(V, [[0, 1, 2], [0, 2, 3]], lattice=lattice)
    >>> ip.effective_conductivity(K).tensor.round(9) + 0.0
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 0.]])
    """

    tensor: Floats
    bounds: Bounds
    period_matrix: PeriodMatrix

    def __array__(self, dtype: object = None, copy: bool | None = None) -> Floats:
        return np.array(self.tensor) if copy else self.tensor

    def __repr__(self) -> str:
        rows = np.array2string(self.tensor, precision=6, suppress_small=True)
        return f"EffectiveConductivity, bound {self.period_matrix.bound or 0.0:.2g}\n{rows}"


@of_a_surface
def effective_conductivity(
    K: DeltaComplex,
    *,
    conducting_holes: bool = False,
    tolerance: float | None = 1e-6,
    degree: int | None = None,
) -> EffectiveConductivity:
    """The effective conductivity of a periodic surface, between two proved bounds.

    Parameters
    ----------
    K : DeltaComplex
        The quotient by a lattice, ``DeltaComplex.from_mesh(V, F, lattice=…)``: oriented and
        connected, with boundary loops or without.
    conducting_holes : bool
        Whether holes are filled with perfect conductors; otherwise they insulate.
    tolerance : float, optional
        Wanted bound of the relative error of the Dirichlet matrix.
    degree : int, optional
        Degree of the trial functions instead of a tolerance.

    Returns
    -------
    EffectiveConductivity

    Raises
    ------
    ComplexError
        If the complex is not a quotient by a lattice, is not oriented and connected, or a
        conducting boundary leads from cell to cell.

    Warns
    -----
    ToleranceWarning
        If the tolerance is not met.

    Examples
    --------
    A plane sheet conducts alike in all directions.

    >>> import igl_periods as ip
    >>> V = [[0, 0, 0], [1, 0, 0], [1, 2, 0], [0, 2, 0]]
    >>> lattice = [[1, 0, 0], [0, 2, 0]]
    >>> K = ip.DeltaComplex.from_mesh(V, [[0, 1, 2], [0, 2, 3]], lattice=lattice)
    >>> ip.effective_conductivity(K).tensor[:2, :2].round(9) + 0.0
    array([[1., 0.],
           [0., 1.]])
    """
    if K.cell is None:
        raise ComplexError(
            "an effective conductivity is that of a periodic surface: "
            "DeltaComplex.from_mesh(V, F, lattice=…)."
        )
    check_connected(K)
    loops = boundary_loops(K)
    counting = _counting_cochains(K, loops, conducting_holes)
    L = double(K) if loops else K
    options = {"tolerance": tolerance} if degree is None else {"degree": degree}
    pm = period_matrix(L, **options)
    if conducting_holes and loops:
        classes, factor = _odd_classes(K, pm, counting, loops), 0.5
    else:
        pulled = lift(K, L, counting) if loops else counting
        classes, factor = coordinates(pm, pulled), 0.5 if loops else 1.0
    D = energy_matrix(pm.matrix)
    mean = factor * classes @ D @ classes.T
    lower, upper = energy_bounds(pm, classes, factor)
    k = len(K.cell.lattice)
    tensors = [_tensor(_least(N, k), K.cell.lattice) for N in (mean, lower, upper)]
    return EffectiveConductivity(tensors[0], Bounds(tensors[1], tensors[2]), pm)


def _least(N: Floats, k: int) -> Floats:
    """Energies of the first k classes, the least that others can be added to; (k, k)."""
    rest = N[k:, k:]
    if not len(rest):
        return N
    return np.asarray(N[:k, :k] - N[:k, k:] @ np.linalg.solve(rest, N[k:, :k]))


def _tensor(N: Floats, lattice: Floats) -> Floats:
    volume = np.sqrt(np.linalg.det(lattice @ lattice.T))
    return np.asarray(lattice.T @ N @ lattice / volume)


def _counting_cochains(K: DeltaComplex, loops: list[BoundaryLoop], relative: bool) -> csr_array:
    """The integer cochains n_j that count how often an edge goes on to the next cell; (k, edges).

    If they are to be relative, they are 0 along the boundary.
    """
    assert K.cell is not None
    corners, lattice = K.cell.corners, K.cell.lattice
    place = np.empty((K.n_vertices, corners.shape[2]))
    place[K.corner_vertex] = corners
    face, s = np.divmod(np.arange(3 * K.n_faces), 3)
    step = corners[face, (s + 2) % 3] - corners[face, (s + 1) % 3]
    if relative:
        for k, loop in enumerate(loops):
            along = step[loop.half_edges]
            if np.linalg.norm(along.sum(axis=0)) > 1e-6 * np.linalg.norm(lattice[0]):
                raise ComplexError(
                    f"loop {k} of the boundary leads from cell to cell: as a conductor it would "
                    "have no resistance."
                )
            before = np.concatenate([np.zeros_like(along[:1]), np.cumsum(along[:-1], axis=0)])
            place[loop.vertices] = place[loop.vertices[0]] + before
    tail, head = half_edge_ends(K)
    forward = forward_half_edges(K)
    left = step[forward] - place[head[forward]] + place[tail[forward]]
    counts = np.rint(left @ np.linalg.pinv(lattice)).astype(np.int64)
    return csr_array(counts.T)


def _odd_classes(
    K: DeltaComplex, pm: PeriodMatrix, counting: csr_array, loops: list[BoundaryLoop]
) -> Ints:
    """The classes of the counting cochains, then those of the loops but the first, made odd."""
    L, of_loops = doubled_with_classes(K, loops)
    first = np.zeros(L.n_edges, dtype=np.int64)
    first[L.edge[: K.n_faces].ravel()] = 1
    extended = csr_array(lift(K, L, counting) * first[None, :])
    sigma = coordinates(pm, involution(L).pull_back(pm.cocycles))
    rows = np.vstack([coordinates(pm, extended), coordinates(pm, of_loops)[1:]])
    return np.asarray(rows - rows @ sigma)
