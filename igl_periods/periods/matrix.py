r"""The period matrix of a surface, and how far it can be off.

Holomorphic forms ζ_1..ζ_g are normalised by :math:`\oint_{a_l} \zeta_k = \delta_{kl}`; the period
matrix is :math:`\Pi_{kl} = \oint_{b_l} \zeta_k = X + iY`, symmetric with Y > 0.  It is read off the
Dirichlet matrix D of a canonical basis of integer cohomology
(:mod:`igl_periods.symplectic`).  A discrete D is symplectic only approximately, and gives

========  =========================  =================================  ==========================
name      X                          Y
========  =========================  =================================  ==========================
primal    −D_ab D_bb⁻¹               D_bb⁻¹                             b-periods along cycles on Γ
dual      −D_bb⁻¹ D_ba               D_aa − D_ab D_bb⁻¹ D_ba            b-periods along cycles on Γ*
mean      average of the two                                            the paper's Ω_D
matrix    of the symplectic mean G of D (:func:`igl_periods.symplectic.williamson`)
========  =========================  =================================  ==========================

Primal and dual are not symmetric in general, and like their mean they depend on the basis.  The
symplectic mean is symmetric and does not; it is exact wherever the symmetries of the
discretisation determine the surface.

**The certificate.**  If D is a matrix of energies of closed forms on the surface itself, then
D ≥ D_exact by Dirichlet's principle, and since D_exact is symplectic

.. math:: J D^{-1} J^T \le D_{exact} \le D .

With d the largest symplectic eigenvalue of D it follows for the symplectic mean Π = X + iY that

.. math:: \| Y^{-1/2} (\Pi_{exact} - \Pi) Y^{-1/2} \|_2 \le d - 1, \qquad
          |\Pi_{exact} - \Pi|_{ij} \le (d - 1) \sqrt{Y_{ii} Y_{jj}},

and Im primal ≤ Im Π_exact ≤ Im dual.  If rounding may have changed D by a factor 1 + r, the same
holds for (1 + r) D, which has the same symplectic mean: then d is replaced by (1 + r) d.

This is about the conformal structure of the *polyhedral* surface, whose triangles have the stored
side lengths; it says nothing about a smooth surface that a mesh samples.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import flint
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Complexes, Floats
from igl_periods.complexes import DeltaComplex
from igl_periods.errors import ComplexError, NotASiegelPointError
from igl_periods.harmonic import energy_factor
from igl_periods.siegel import SIEGEL_GENUS_LIMIT, check_symplectic, siegel_reduce, to_flint
from igl_periods.symplectic import (
    estimate_derivative,
    form_action,
    product,
    siegel_point,
    williamson_of_factor,
)

from .derivative import (
    EntryCovariance,
    Gradient,
    checked_directions,
    checked_weights,
    derivative_along,
    entry_weights,
    gradient_of,
    noise_covariance,
)
from .rounding import LEAST_ALLOWANCE, algebraic_allowance, combined, congruence
from .solved_forms import SolvedForms, recomputed_forms

_MOST_REDUCTIONS = 8
_ASYMMETRY = 1e-8
_LARGEST_LOSS = 0.1


@dataclass(frozen=True, eq=False)
class PeriodMatrix:
    """A period matrix with its certificate and its marking.

    ``numpy.asarray(pm)`` is ``pm.matrix``.  All arrays are read-only.

    Attributes
    ----------
    dirichlet : (2g, 2g) float
        Energies ∫ ω_i ∧ *ω_j of the discrete harmonic forms in the classes of ``cocycles``.
    certified : bool
        Whether they are energies of forms on the surface itself, so that there is a bound.
    cocycles : (2g, n_edges) sparse int
        The marking: closed cochains α_1..α_g, β_1..β_g on the edges of ``complex``.
    complex : DeltaComplex
        The surface as it was given, before any flip.
    rounding : float
        What the bound allows for floating-point errors in ``dirichlet``, relative like itself.
    forms : SolvedForms or None
        The harmonic forms, where they were kept for derivatives (``keep_forms=True``).
    """

    dirichlet: Floats
    certified: bool
    cocycles: csr_array
    complex: DeltaComplex
    rounding: float = LEAST_ALLOWANCE
    forms: SolvedForms | None = None

    def __post_init__(self) -> None:
        D = np.array(self.dirichlet, dtype=np.float64)
        edges = (D.shape[0], self.complex.n_edges)
        if D.ndim != 2 or D.shape[0] != D.shape[1] or D.shape[0] % 2:
            raise ComplexError(f"a Dirichlet matrix has shape (2g, 2g), not {D.shape}.")
        if not np.isfinite(D).all():
            raise ComplexError("the Dirichlet matrix has entries that are not finite.")
        if np.abs(D - D.T).max(initial=0.0) > _ASYMMETRY * np.abs(D).max(initial=0.0):
            raise ComplexError("a Dirichlet matrix is symmetric; this one is not.")
        if self.cocycles.shape != edges:
            raise ComplexError(f"the cocycles have shape {self.cocycles.shape}, not {edges}.")
        object.__setattr__(self, "dirichlet", _read_only(0.5 * (D + D.T)))
        _ = self._factor
        _read_only(self.cocycles.data)

    @property
    def genus(self) -> int:
        """The genus g."""
        return len(self.dirichlet) // 2

    @cached_property
    def _factor(self) -> Floats:
        return energy_factor(self.dirichlet)

    @cached_property
    def _williamson(self) -> tuple[Floats, Floats]:
        return williamson_of_factor(self._factor)

    @property
    def symplectic_eigenvalues(self) -> Floats:
        """Symplectic eigenvalues of ``dirichlet``, decreasing; (g,).  All 1 iff it is exact."""
        return _read_only(self._williamson[0])

    @cached_property
    def matrix(self) -> Complexes:
        """The period matrix Π, from the symplectic mean; (g, g) complex, symmetric."""
        return _read_only(siegel_point(self._williamson[1]))

    @property
    def riemann_matrix(self) -> Complexes:
        """The same as ``matrix``: what algebraists call the Riemann matrix."""
        return self.matrix

    @cached_property
    def primal(self) -> Complexes:
        """Periods along cycles on Γ: −D_ab D_bb⁻¹ + i D_bb⁻¹; (g, g), not symmetric in general."""
        _, ab, _, bb = self._blocks()
        inverse = np.linalg.inv(bb)
        return _read_only(-ab @ inverse + 1j * inverse)

    @cached_property
    def dual(self) -> Complexes:
        """Periods along cycles on Γ*: −D_bb⁻¹ D_ba + i (D_aa − D_ab D_bb⁻¹ D_ba); (g, g)."""
        aa, ab, ba, bb = self._blocks()
        quotient = np.linalg.solve(bb, ba)
        return _read_only(-quotient + 1j * (aa - ab @ quotient))

    @cached_property
    def mean(self) -> Complexes:
        """The average of ``primal`` and ``dual``, the paper's Ω_D; (g, g), symmetric."""
        return _read_only(0.5 * (self.primal + self.dual))

    @property
    def bound(self) -> float | None:
        """Certified bound of ‖Y^{-1/2} (Π_exact − Π) Y^{-1/2}‖₂, or None without a certificate.

        Π_exact is the period matrix of the polyhedral surface ``complex`` in the same marking,
        Π = ``matrix`` and Y its imaginary part.
        """
        if not self.certified:
            return None
        if self.genus == 0:
            return 0.0
        d, r = float(self.symplectic_eigenvalues[0]), self.rounding_allowance
        return max(d - 1.0, 0.0) + r * max(d, 1.0)

    @cached_property
    def rounding_allowance(self) -> float:
        """What the bound contains for floating-point errors, in D and in what follows from it."""
        return combined(self.rounding, algebraic_allowance(self._factor))

    @property
    def entry_bounds(self) -> Floats | None:
        """Certified bounds of the entries of Π_exact − Π, ``bound`` √(Y_ii Y_jj); (g, g)."""
        if self.bound is None:
            return None
        scale = np.sqrt(np.diag(self.matrix.imag))
        return _read_only(self.bound * np.outer(scale, scale))

    def reduced(self, *, max_genus: int = SIEGEL_GENUS_LIMIT) -> PeriodMatrix:
        """The same surface with a Siegel-reduced matrix; see :func:`siegel_reduce`.

        Raises
        ------
        ValueError
            If the genus is larger than ``max_genus``.
        """
        return siegel_reduced(self, max_genus=max_genus)[0]

    def change_basis(self, gamma: ArrayLike) -> PeriodMatrix:
        """The same surface in another canonical basis: Π ↦ (aΠ + b)(cΠ + d)⁻¹.

        Parameters
        ----------
        gamma : (2g, 2g) int
            [[a, b], [c, d]] in Sp(2g, Z).

        Raises
        ------
        ValueError
            If gamma is no integer symplectic matrix of this size.
        ComplexError
            If it is so large that no digits of the energies would be left.
        """
        U = form_action(check_symplectic(gamma, self.genus))
        try:
            D, loss = congruence(U, self.dirichlet)
        except ComplexError:
            loss = np.inf
        if loss > _LARGEST_LOSS:
            raise ComplexError(
                f"gamma, with entries up to {np.abs(U).max()}, leads to a marking that is too "
                "extreme for double precision: no digits of the energies would be left. "
                "siegel_transform(gamma, pm) gives the matrix alone, without a bound."
            )
        return PeriodMatrix(
            dirichlet=D,
            certified=self.certified,
            cocycles=csr_array(csr_array(U) @ self.cocycles),
            complex=self.complex,
            rounding=combined(self.rounding, loss),
            forms=None if self.forms is None else self.forms.in_basis(U),
        )

    def derivative(
        self,
        *,
        lengths: ArrayLike | None = None,
        vertices: ArrayLike | None = None,
        estimate: str = "matrix",
    ) -> Complexes:
        """How Π moves as the lengths of ``complex`` or its vertices do.

        Without kept forms (``keep_forms=True``), the first derivative solves for them once more.

        Parameters
        ----------
        lengths : (…, n_edges) array-like
            One direction or several, in the order of the edges (``complexes.edge_ends``).
        vertices : (…, n_vertices, d) array-like
            Instead of ``lengths``; rows as of ``complex.positions``.
        estimate : {"matrix", "primal", "dual", "mean"}

        Returns
        -------
        (…, g, g) complex
            :mod:`igl_periods.periods.derivative` says of what, at which degree.

        Raises
        ------
        ValueError
            If not exactly one of the directions is given, shapes are wrong, numbers are not
            finite, or there is no such estimate.
        ComplexError
            If there are no positions, or the forms were not kept and are not linear ones.
        """
        moved = checked_directions(self.complex, lengths, vertices)
        mean = estimate_derivative(self.dirichlet, estimate)
        return derivative_along(self.complex, self._solved, mean, moved)

    def gradient(self, W: ArrayLike, *, estimate: str = "matrix") -> Gradient:
        """The gradient of Re Σ W̄ Π by lengths and by vertices: ``derivative``, transposed.

        Parameters
        ----------
        W : (…, g, g) array-like
            One function or several.
        estimate : {"matrix", "primal", "dual", "mean"}

        Returns
        -------
        Gradient
            ``lengths`` (…, n_edges) and ``vertices`` (…, n_vertices, d).

        Raises
        ------
        ValueError, ComplexError
            As :meth:`derivative`.
        """
        weights = checked_weights(W, self.genus)
        mean = estimate_derivative(self.dirichlet, estimate)
        return gradient_of(self.complex, self._solved, mean, weights)

    def covariance(self, vertex_noise: ArrayLike) -> EntryCovariance:
        """How uncertain the entries of Π are if the vertices are, to first order.

        Parameters
        ----------
        vertex_noise : float, (n,), (n, d, d) or (n d, n d) array-like
            The standard deviation of every coordinate, one for each vertex; or covariances of
            positions, each vertex for itself or all together.

        Raises
        ------
        ValueError
            If it is none of these, negative, or not symmetric.
        ComplexError
            As :meth:`derivative`.
        """
        by_vertex = self.gradient(entry_weights(self.genus)).vertices
        if by_vertex is None:
            raise ComplexError("the surface has no positions, only lengths: no vertex has noise.")
        return noise_covariance(by_vertex, vertex_noise)

    @cached_property
    def _solved(self) -> SolvedForms:
        if self.forms is not None:
            return self.forms
        return recomputed_forms(self.complex, self.cocycles, self.dirichlet)

    def to_flint(self) -> flint.acb_mat:
        """``matrix`` as balls with the radii ``entry_bounds``, for python-flint."""
        return to_flint(self)

    def __reduce__(self) -> tuple[type[PeriodMatrix], tuple[Any, ...]]:
        # Pickled without what is derived, and read-only again afterwards.
        kept = (self.rounding, self.forms)
        return PeriodMatrix, (self.dirichlet, self.certified, self.cocycles, self.complex, *kept)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy:
            return np.array(self.matrix, dtype=dtype)
        return np.asarray(self.matrix, dtype=dtype)

    def __repr__(self) -> str:
        bound = "not certified" if self.bound is None else f"bound {self.bound:.3g}"
        matrix = np.array2string(self.matrix, precision=6, suppress_small=True, threshold=36)
        return f"PeriodMatrix of genus {self.genus}, {bound}\n{matrix}"

    def _blocks(self) -> tuple[Floats, Floats, Floats, Floats]:
        g, D = self.genus, self.dirichlet
        return D[:g, :g], D[:g, g:], D[g:, :g], D[g:, g:]


def siegel_reduced(
    pm: PeriodMatrix, *, max_genus: int = SIEGEL_GENUS_LIMIT
) -> tuple[PeriodMatrix, NDArray[np.int64]]:
    """The same surface with a Siegel-reduced matrix, and the γ that leads to it.

    The matrix is computed anew from its Dirichlet matrix in the new marking, where it is better
    conditioned; so the reduction is repeated until there is nothing left to reduce.  Each time the
    whole γ is applied to the given Dirichlet matrix, so rounding is counted once.
    """
    reduced, total = pm, np.eye(2 * pm.genus, dtype=np.int64)
    for _ in range(_MOST_REDUCTIONS):
        gamma = siegel_reduce(reduced.matrix, max_genus=max_genus).gamma
        if np.array_equal(gamma, np.eye(2 * pm.genus)):
            break
        total = product(gamma, total)
        reduced = pm.change_basis(total)
    return reduced, total


def reduced_if_feasible(
    pm: PeriodMatrix, *, max_genus: int | None = None
) -> tuple[PeriodMatrix, NDArray[np.int64]] | tuple[None, None]:
    """As :func:`siegel_reduced`, or (None, None) where that takes too long or cannot be done.

    It takes long above the genus ``max_genus``, by default ``SIEGEL_GENUS_LIMIT``.  A matrix that
    cannot be reduced in double precision is not lost: a warning says so.
    """
    if pm.genus > (SIEGEL_GENUS_LIMIT if max_genus is None else max_genus):
        return None, None
    try:
        return siegel_reduced(pm, max_genus=pm.genus)
    except (ComplexError, NotASiegelPointError) as error:
        warnings.warn(f"the matrix was not reduced: {error}", stacklevel=2)
        return None, None


def _read_only(array: NDArray[Any]) -> NDArray[Any]:
    array.flags.writeable = False
    return array
