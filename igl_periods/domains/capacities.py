r"""The capacity matrix of the boundary loops of a surface, between two proved bounds.

Let u_i be the harmonic function on the surface K that is 1 on the boundary loop C_i and 0 on all
others.  The *capacity matrix*

.. math:: C_{ij} = \int_K \nabla u_i \cdot \nabla u_j = \oint_{C_j} {*du_i}

is symmetric, its rows add up to 0, and entries off the diagonal are negative: it is the matrix of
charges of conductors C_j at potentials u = 1 on C_i and 0 elsewhere.  *Grounded* at C_1 it is what
remains without the first row and column, a positive definite matrix.

On the double L the form that is du_i on the first sheet and −du_i, pulled back by the involution,
on the second one is harmonic, by reflection.  It has the periods of 2 β_i
(:mod:`~igl_periods.domains.boundary_classes`), and twice the energy of du_i.  So

.. math:: 4\, D(\beta_i, \beta_j) = 2\, C_{ij}, \qquad C = 2 B D_{exact} B^T,

B the coefficients of the β_i in the canonical basis of cohomology, D_exact the Dirichlet matrix of
L.  Both bounds of :math:`J D^{-1} J^T \le D_{exact} \le D` are bounds of C.  For a planar domain
with the a-cycles C_2 … C_n the grounded matrix is :math:`2\, (\operatorname{Im} \Pi)^{-1}`.

From lower ≤ C ≤ upper, with M the mean and R half the difference of the two, every entry of C is
within :math:`\sqrt{R_{ii} R_{jj}}` of that of M.

References
----------
Pólya, Szegő, "Isoperimetric inequalities in mathematical physics" (1951).
Schiffer, Spencer, "Functionals of finite Riemann surfaces" (1954), on doubles.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, of_a_surface
from igl_periods.display import known_digits, rounded_up
from igl_periods.errors import ComplexError
from igl_periods.periods import PeriodMatrix, combined, congruence, period_matrix
from igl_periods.symplectic import energy_matrix, standard_form
from igl_periods.topology import pairing

from .boundary_classes import BoundaryLoop, boundary_loops, doubled_with_classes
from .measures import harmonic_measures


class Bounds(NamedTuple):
    """Two matrices between which the exact one lies, in one of the two orders."""

    lower: Floats
    upper: Floats


@dataclass(frozen=True, eq=False, repr=False)
class CapacityMatrix:
    """Capacities of the boundary loops of a surface.

    ``numpy.asarray`` gives ``matrix``.

    Attributes
    ----------
    period_matrix : PeriodMatrix
        Of the double of the surface: its certificate is that of the capacities.
    coefficients : (n, 2g) int
        The classes β_i of the loops in the basis of ``period_matrix``.
    loops : list of BoundaryLoop
        C_1 … C_n, the rows of ``matrix``.
    complex : DeltaComplex
        The surface with boundary.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.planar_domain([0, 4, 4 + 4j, 4j], [[1 + 1j, 3 + 1j, 3 + 3j, 1 + 3j]])
    >>> ip.capacity_matrix(V, F, tolerance=1e-6)
    CapacityMatrix of 2 loops, bound 1.11e-07
      10.23409  -10.23409
      -10.23409  10.23409
    """

    period_matrix: PeriodMatrix
    coefficients: Ints
    loops: list[BoundaryLoop]
    complex: DeltaComplex

    @cached_property
    def matrix(self) -> Floats:
        """The capacity matrix C of the symplectic mean, between both bounds; (n, n)."""
        return self._full(
            2.0 * _in_classes(self._grounded_classes, energy_matrix(self.period_matrix.matrix))[0]
        )

    @property
    def grounded(self) -> Floats:
        """The matrix without its first row and column: C_1 is kept at 0; (n − 1, n − 1)."""
        return self.matrix[1:, 1:]

    @cached_property
    def bounds(self) -> Bounds:
        """Lower ≤ C ≤ upper in the Loewner order: differences are positive semidefinite."""
        lower, upper = self._grounded_bounds
        return Bounds(self._full(lower), self._full(upper))

    @property
    def entry_bounds(self) -> Bounds:
        """Bounds of the single entries of C, from those in the Loewner order."""
        lower, upper = self.bounds
        root = np.sqrt(np.maximum(np.diag(upper - lower) / 2, 0.0))
        mean, error = (lower + upper) / 2, np.outer(root, root)
        # Sums of entries of this size are rounded here.
        error = error + 4 * np.finfo(float).eps * np.abs(mean)
        return Bounds(mean - error, mean + error)

    @property
    def conjugate(self) -> Floats:
        """Energies of fields with the flux 1 through one of C_2 … C_n; (n − 1, n − 1).

        By the classes of loops the differentials *du_i have the periods C_ij; normalised to the
        periods δ_ij they have these energies, the inverse of ``grounded``.
        """
        return np.asarray(np.linalg.inv(self.grounded), dtype=np.float64)

    @property
    def conjugate_bounds(self) -> Bounds:
        """Lower ≤ ``conjugate`` ≤ upper in the Loewner order."""
        lower, upper = self._grounded_bounds
        inverse = (np.asarray(np.linalg.inv(bound), np.float64) for bound in (upper, lower))
        return Bounds(*inverse)

    @property
    def resistances(self) -> Floats:
        """Resistances R_ij between C_i and C_j while the other loops carry no charge; (n, n).

        Of a ring domain 1 / C_22: 2π times that is its modulus log(r_2 / r_1).
        """
        return _resistances(self.grounded)

    @property
    def resistance_bounds(self) -> Bounds:
        """Bounds of the entries of ``resistances``."""
        lower, upper = self._grounded_bounds
        return Bounds(_resistances(upper), _resistances(lower))

    @property
    def moduli(self) -> Floats:
        """2π R_ij: of a ring domain log(r_2 / r_1) of the equivalent round annulus; (n, n)."""
        return 2 * np.pi * self.resistances

    def harmonic_measures(self, degree: int = 4) -> Floats:
        """The functions u_i at the vertices: :func:`~igl_periods.domains.harmonic_measures`."""
        return harmonic_measures(self.complex, degree)

    @cached_property
    def _grounded_bounds(self) -> Bounds:
        return energy_bounds(self.period_matrix, self._grounded_classes, 2.0)

    @property
    def _grounded_classes(self) -> Ints:
        return self.coefficients[1:]

    def _full(self, grounded: Floats) -> Floats:
        """With the row and column of C_1, which make the sums 0."""
        n = len(grounded)
        T = np.vstack([-np.ones((1, n)), np.eye(n)])
        full = np.asarray(T @ grounded @ T.T)
        full.flags.writeable = False
        return full

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        return np.array(self.matrix, dtype=dtype) if copy else np.asarray(self.matrix, dtype=dtype)

    def __repr__(self) -> str:
        lower, upper = self.entry_bounds
        n = len(self.matrix)
        rows = [
            "  ".join(
                known_digits(self.matrix[i, j], max(upper[i, j] - self.matrix[i, j],
                                                    self.matrix[i, j] - lower[i, j]))
                for j in range(n)
            )
            for i in range(n)
        ]  # fmt: skip
        bound = rounded_up(self.period_matrix.bound or 0.0, 3)
        return "\n".join([f"CapacityMatrix of {n} loops, bound {bound}", *(f"  {r}" for r in rows)])


@of_a_surface
def capacity_matrix(
    K: DeltaComplex,
    *,
    tolerance: float | None = 1e-8,
    degree: int | None = None,
    max_unknowns: int | None = None,
) -> CapacityMatrix:
    """The capacity matrix of the boundary loops of a surface, between two proved bounds.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`, with a boundary; oriented and connected.  It may
        have handles.
    tolerance : float, optional
        Wanted bound of the relative error, in the Loewner order: the two bounds of C differ by
        about twice as much of it.
    degree : int, optional
        Degree of the trial functions instead of a tolerance.
    max_unknowns : int, optional
        As for :func:`~igl_periods.period_matrix`.

    Returns
    -------
    CapacityMatrix
        With loops ordered by their first vertices; of one loop it is (0).

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
    A cylinder of circumference 3 and height 1 has the capacity 3.

    >>> from igl_periods import DeltaComplex
    >>> cylinder = DeltaComplex.from_gluing(
    ...     [[1, 10**0.5, 3], [3, 1, 10**0.5]], [[4, 5, -1], [-1, 0, 1]]
    ... )
    >>> capacity_matrix(cylinder).matrix.round(9).tolist()
    [[3.0, -3.0], [-3.0, 3.0]]
    """
    loops = boundary_loops(K)
    if not loops:
        raise ComplexError(
            "the surface has no boundary: capacities are those of boundary loops. Its holomorphic "
            "forms have periods (igl_periods.period_matrix)."
        )
    L, classes = doubled_with_classes(K, loops)
    if degree is None:
        pm = period_matrix(L, tolerance=tolerance, max_unknowns=max_unknowns)
    else:
        pm = period_matrix(L, degree=degree)
    return CapacityMatrix(pm, coordinates(pm, classes), loops, K)


def energy_bounds(pm: PeriodMatrix, classes: Ints, factor: float = 1.0) -> Bounds:
    """Lower and upper bounds of energies of classes, in the Loewner order.

    Parameters
    ----------
    pm : PeriodMatrix
        With a certificate.
    classes : (k, 2g) int
    factor : float
    """
    D, J = pm.dirichlet, standard_form(pm.genus)
    upper, loss = _in_classes(classes, D)
    lower, other_loss = _in_classes(classes, J @ np.linalg.inv(D) @ J.T)
    allowance = combined(pm.rounding_allowance, max(loss, other_loss))
    return Bounds(factor * lower / (1.0 + allowance), factor * upper * (1.0 + allowance))


def _in_classes(classes: Ints, D: Floats) -> tuple[Floats, float]:
    if len(classes) == 0:
        return np.zeros((0, 0)), 0.0
    return congruence(classes, np.asarray(0.5 * (D + D.T)))


def coordinates(pm: PeriodMatrix, classes: csr_array) -> Ints:
    """Closed cochains in the basis ω_k of cohomology: B with β ~ B ω; (n, 2g) int."""
    # ∫ β ∧ ω = B ∫ ω ∧ ω = B J, and J² = −1.
    return pairing(pm.complex, classes, pm.cocycles) @ -standard_form(pm.genus)


def _resistances(grounded: Floats) -> Floats:
    n = len(grounded)
    inverse = np.zeros((n + 1, n + 1))
    inverse[1:, 1:] = np.linalg.inv(grounded) if n else 0.0
    diagonal = np.diag(inverse)
    return np.asarray(diagonal[:, None] + diagonal[None, :] - 2 * inverse)
