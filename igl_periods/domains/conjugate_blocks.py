r"""Surfaces with handles and boundary loops: both blocks of the Dirichlet matrix.

The double L of a surface K of genus g with n boundary loops has the genus G = 2g + n − 1, and its
involution σ divides cohomology in two halves of dimension G each.

* *Insulated*: a class α of H¹(K) is pulled back to L.  Its harmonic form has no flux through the
  boundary.
* *Conducting*: a class β of H¹(K, ∂K), whose forms vanish along the boundary, is β on the first
  sheet and −σ*β on the second one.  Its harmonic form is normal to the boundary: potentials are
  constant on loops.  With g = 0 these are the classes of the harmonic measures, and the block is
  the capacity matrix, grounded.

Both energies on K are half of those on L,

.. math:: A_{ij} = \tfrac12 D(\alpha_i, \alpha_j), \qquad R_{ij} = \tfrac12 D(\beta_i, \beta_j),

and mixed ones vanish.  In bases that are dual to each other, ∫_K α_i ∧ β_j = δ_ij, the star maps
one half to the other, so that the exact blocks are inverse: :math:`R = A^{-1}`, as of conjugate
networks.  Both bounds of :math:`J D^{-1} J^T \le D_{exact} \le D` are bounds of each of the blocks.

In the lattice H¹(L, Z) the second half is the image of 1 − σ*, the first one that of restricting to
the first sheet and pulling back; bases are Hermite normal forms, reduced.

References
----------
Schiffer, Spencer, "Functionals of finite Riemann surfaces" (1954), chapters 2 and 4.
"""

from __future__ import annotations

from dataclasses import dataclass

import flint
import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import (
    DeltaComplex,
    double,
    forward_half_edges,
    involution,
    lift,
    of_a_surface,
)
from igl_periods.errors import ComplexError
from igl_periods.periods import PeriodMatrix, period_matrix
from igl_periods.symplectic import energy_matrix, standard_form

from .boundary_classes import BoundaryLoop, boundary_loops, check_oriented
from .capacities import Bounds, coordinates, energy_bounds


@dataclass(frozen=True, eq=False, repr=False)
class EnergyBlocks:
    """Energies of harmonic fields on a surface with boundary, insulated and conducting.

    Attributes
    ----------
    period_matrix : PeriodMatrix
        Of the double of the surface.
    insulated_classes, conducting_classes : (G, 2G) int
        α_i and β_i on the double, in the basis of ``period_matrix``; dual to each other on K.
    loops : list of BoundaryLoop
    complex : DeltaComplex
        The surface with boundary.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.planar_domain([0, 4, 4 + 4j, 4j], [[1 + 1j, 3 + 1j, 3 + 3j, 1 + 3j]])
    >>> blocks = ip.energy_blocks(V, F, tolerance=1e-6)
    >>> len(blocks.loops)
    2
    """

    period_matrix: PeriodMatrix
    insulated_classes: Ints
    conducting_classes: Ints
    loops: list[BoundaryLoop]
    complex: DeltaComplex

    @property
    def insulated(self) -> Floats:
        """A, of the symplectic mean; (G, G)."""
        return 0.5 * self._energies(self.insulated_classes)

    @property
    def conducting(self) -> Floats:
        """R, of the symplectic mean: the inverse of ``insulated``; (G, G)."""
        return 0.5 * self._energies(self.conducting_classes)

    @property
    def insulated_bounds(self) -> Bounds:
        """Lower ≤ A ≤ upper in the Loewner order."""
        return energy_bounds(self.period_matrix, self.insulated_classes, 0.5)

    @property
    def conducting_bounds(self) -> Bounds:
        """Lower ≤ R ≤ upper in the Loewner order."""
        return energy_bounds(self.period_matrix, self.conducting_classes, 0.5)

    def _energies(self, classes: Ints) -> Floats:
        D = energy_matrix(self.period_matrix.matrix)
        return np.asarray(classes @ D @ classes.T)

    def __repr__(self) -> str:
        G = len(self.insulated_classes)
        return (
            f"EnergyBlocks of genus {(G + 1 - len(self.loops)) // 2} with {len(self.loops)} loops, "
            f"two of {G} x {G}"
        )


@of_a_surface
def energy_blocks(
    K: DeltaComplex,
    *,
    tolerance: float | None = 1e-8,
    degree: int | None = None,
    max_unknowns: int | None = None,
) -> EnergyBlocks:
    """Both blocks of the Dirichlet matrix of a surface with boundary.

    Parameters
    ----------
    K : surface
        As for :func:`capacity_matrix`: oriented and connected, with a boundary; handles are
        welcome.
    tolerance, degree, max_unknowns
        As for :func:`capacity_matrix`.

    Returns
    -------
    EnergyBlocks

    Raises
    ------
    ComplexError
        If the surface has no boundary, is not connected, or orientations of faces disagree.

    Warns
    -----
    ToleranceWarning
        If the tolerance is not met.

    Examples
    --------
    A cylinder of circumference 3 and height 1: what runs along it, and what runs around it.

    >>> from igl_periods import DeltaComplex
    >>> cylinder = DeltaComplex.from_gluing(
    ...     [[1, 10**0.5, 3], [3, 1, 10**0.5]], [[4, 5, -1], [-1, 0, 1]]
    ... )
    >>> blocks = energy_blocks(cylinder)
    >>> blocks.conducting.round(9).tolist(), blocks.insulated.round(9).tolist()
    ([[3.0]], [[0.333333333]])
    """
    check_oriented(K)
    loops = boundary_loops(K)
    if not loops:
        raise ComplexError("the surface has no boundary: there is one block (period_matrix).")
    L = double(K)
    if degree is None:
        pm = period_matrix(L, tolerance=tolerance, max_unknowns=max_unknowns)
    else:
        pm = period_matrix(L, degree=degree)
    even = coordinates(pm, lift(K, L, _restricted(K, L, pm.cocycles)))
    sigma = coordinates(pm, involution(L).pull_back(pm.cocycles))
    odd = np.eye(2 * pm.genus, dtype=np.int64) - sigma
    alpha, beta = _basis(even), _basis(odd)
    # ∫_K α ∧ β is half of that on the double; unimodular, so its inverse is integer.
    P = alpha @ standard_form(pm.genus) @ beta.T // 2
    inverse = np.rint(np.linalg.inv(P)).astype(np.int64) if len(P) else P
    return EnergyBlocks(pm, alpha, inverse.T @ beta if len(P) else beta, loops, K)


def _restricted(K: DeltaComplex, L: DeltaComplex, cochains: csr_array) -> csr_array:
    """Cochains of the double on the edges of the first sheet."""
    forward = forward_half_edges(K)
    sign = L.sign.ravel()[forward].astype(np.int64)
    return csr_array(cochains.tocsc()[:, L.edge.ravel()[forward]] * sign[None, :])


def _basis(generators: Ints) -> Ints:
    """A reduced basis of the lattice that rows generate."""
    H = flint.fmpz_mat(generators.tolist()).hnf()
    rows = [row for row in np.array(H.tolist(), dtype=object) if any(x != 0 for x in row)]
    if not rows:
        return np.zeros((0, generators.shape[1]), dtype=np.int64)
    reduced = flint.fmpz_mat([[int(x) for x in row] for row in rows]).lll()
    return np.array([[int(x) for x in row] for row in reduced.tolist()], dtype=np.int64)
