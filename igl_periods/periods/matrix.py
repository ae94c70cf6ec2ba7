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

Primal and dual are not symmetric in general; they and their mean depend on the basis.  The
symplectic mean does neither, and is exact wherever symmetries determine the surface.

**The certificate.**  If D is a matrix of energies of closed forms on the surface itself, then
D ≥ D_exact by Dirichlet's principle, and since D_exact is symplectic

.. math:: J D^{-1} J^T \le D_{exact} \le D .

With d the largest symplectic eigenvalue of D it follows for the symplectic mean Π = X + iY that

.. math:: \| Y^{-1/2} (\Pi_{exact} - \Pi) Y^{-1/2} \|_2 \le d - 1, \qquad
          |\Pi_{exact} - \Pi|_{ij} \le (d - 1) \sqrt{Y_{ii} Y_{jj}},

and Im primal ≤ Im Π_exact ≤ Im dual.  If rounding may have changed D by a factor 1 + r, the same
holds for (1 + r) D, which has the same symplectic mean: then d is replaced by (1 + r) d.  This r
is a rule, and where the bound is wanted *proved* it is replaced by balls
(:mod:`igl_periods.proofs.proved_energies`): whatever Π is, and however it was computed,

.. math:: D \le (1 + b)\, G(\Pi) \quad \text{in balls} \implies
          \| Y^{-1/2} (\Pi_{exact} - \Pi) Y^{-1/2} \|_2 \le b .

This is about the *polyhedral* surface of the stored lengths, not about a smooth one it samples.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol

import flint
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex
from igl_periods.display import (
    Shown,
    matrix_html,
    matrix_latex,
    matrix_lines,
    paragraph_html,
    rounded_up,
)
from igl_periods.errors import ComplexError, NotASiegelPointError, NotPositiveDefiniteError
from igl_periods.harmonic import energy_factor
from igl_periods.machine import threads_for
from igl_periods.options import in_words
from igl_periods.siegel import SIEGEL_GENUS_LIMIT, check_symplectic, siegel_reduce, to_flint
from igl_periods.symplectic import (
    form_action,
    product,
    siegel_point,
    williamson_of_factor,
)

from .differentiable import Differentiable
from .rounding import LEAST_ALLOWANCE, algebraic_allowance, combined, congruence
from .solved_forms import SolvedForms

_MOST_REDUCTIONS = 8
_ASYMMETRY = 1e-8
_LARGEST_LOSS = 0.1
# Entry bounds of a proof are rounded upwards by more than their few operations can round down.
_UPWARDS = 1.0 + 2.0**-48


class Proof(Protocol):
    """Energies in balls, as :class:`igl_periods.proofs.proved_energies.ProvedEnergies`."""

    def in_basis(self, U: NDArray[np.integer]) -> Proof:
        """The same energies with another canonical basis, U times this one."""

    def dirichlet(self) -> Floats:
        """Midpoints of the energies in the canonical basis."""

    def relative_radius(self, Pi: Complexes) -> float:
        """An upper bound of ‖Y^{-1/2} (Π_exact − Π) Y^{-1/2}‖₂, ∞ where nothing is proved."""


@dataclass(frozen=True, eq=False)
class PeriodMatrix(Shown, Differentiable):
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
    proof : Proof or None
        Energies in balls, with which the bound is proved.
    forms : SolvedForms or None
        The harmonic forms, where they were kept for derivatives (``keep_forms=True``).

    Examples
    --------
    >>> import igl_periods as ip
    >>> ip.period_matrix(ip.surfaces.square_tiled_surface("omega_3", n=2)).reduced()
    PeriodMatrix of genus 2, bound 0.0826
       1.2 i   -0.6 i
      -0.6 i    1.2 i
    """

    dirichlet: Floats
    certified: bool
    cocycles: csr_array
    complex: DeltaComplex
    rounding: float = LEAST_ALLOWANCE
    proof: Proof | None = None
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
        if self.proof is not None:
            return self._proved_bound
        d, r = float(self.symplectic_eigenvalues[0]), self.rounding_allowance
        return max(d - 1.0, 0.0) + r * max(d, 1.0)

    @property
    def rigorous(self) -> bool:
        """Whether the bound is proved, roundings included, and contains no allowance for them."""
        return self.proof is not None

    @cached_property
    def _proved_bound(self) -> float:
        assert self.proof is not None
        return self.proof.relative_radius(self.matrix)

    @cached_property
    def rounding_allowance(self) -> float:
        """What the bound contains for floating-point errors, in D and in what follows from it.

        About that: where the bound is proved, the radii of the balls are part of it.
        """
        if self.proof is not None:
            return self.rounding
        return combined(self.rounding, algebraic_allowance(self._factor))

    @property
    def entry_bounds(self) -> Floats | None:
        """Certified bounds of the entries of Π_exact − Π, ``bound`` √(Y_ii Y_jj); (g, g)."""
        if self.bound is None:
            return None
        scale = np.sqrt(np.diag(self.matrix.imag))
        upwards = _UPWARDS if self.rigorous else 1.0
        return _read_only(upwards * self.bound * np.outer(scale, scale))

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
            If gamma is not an integer symplectic matrix of this size.
        ComplexError
            If it is so large that no digits of the energies would be left.
        """
        U = form_action(check_symplectic(gamma, self.genus))
        changed = self._approximately_in(U) if self.proof is None else self._proved_in(U)
        if changed is None:
            raise ComplexError(
                f"gamma, with entries up to {np.abs(U).max()}, leads to a marking that is too "
                "extreme for double precision: no digits of the energies would be left. "
                "siegel_transform(gamma, pm) gives the matrix alone, without a bound."
            )
        return changed if self.forms is None else replace(changed, forms=self.forms.in_basis(U))

    def _approximately_in(self, U: Ints) -> PeriodMatrix | None:
        """The same in another basis of forms, or None where rounding would leave no digits."""
        try:
            D, loss = congruence(U, self.dirichlet)
        except ComplexError:
            return None
        if loss > _LARGEST_LOSS:
            return None
        cocycles = csr_array(csr_array(U) @ self.cocycles)
        rounding = combined(self.rounding, loss)
        return PeriodMatrix(D, self.certified, cocycles, self.complex, rounding)

    def _proved_in(self, U: Ints) -> PeriodMatrix | None:
        """The same, with a proof for the new matrix; the balls themselves lose nothing."""
        assert self.proof is not None
        cocycles = csr_array(csr_array(U) @ self.cocycles)
        known = combined(self.bound or 0.0, _LARGEST_LOSS)
        try:
            proof = self.proof.in_basis(U)
            changed = PeriodMatrix(
                proof.dirichlet(), True, cocycles, self.complex, self.rounding, proof
            )
            return changed if (changed.bound or 0.0) <= known else None
        except (ComplexError, NotPositiveDefiniteError, OverflowError):
            return None

    def to_flint(self) -> flint.acb_mat:
        """``matrix`` as balls with the radii ``entry_bounds``, for python-flint."""
        return to_flint(self)

    def __reduce__(self) -> tuple[type[PeriodMatrix], tuple[Any, ...]]:
        # Pickled without what is derived, and read-only again afterwards.
        fields = (self.dirichlet, self.certified, self.cocycles, self.complex, self.rounding)
        return PeriodMatrix, (*fields, self.proof, self.forms)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        if copy:
            return np.array(self.matrix, dtype=dtype)
        return np.asarray(self.matrix, dtype=dtype)

    def __repr__(self) -> str:
        bound = "not certified" if self.bound is None else f"bound {rounded_up(self.bound, 3)}"
        bound += ", proved" if self.rigorous else ""
        matrix = [f"  {line}" for line in matrix_lines(self.matrix, self.entry_bounds)]
        return "\n".join([f"PeriodMatrix of genus {self.genus}, {bound}", *matrix])

    def _repr_html_(self) -> str:
        title = paragraph_html(f"Period matrix Π of genus {self.genus}")
        if self.genus == 0:
            return title
        matrix = matrix_html(self.matrix, self.entry_bounds)
        return "\n".join([title, matrix, paragraph_html(self._accuracy())])

    def _repr_latex_(self) -> str:
        return rf"$\displaystyle \Pi = {matrix_latex(self.matrix, self.entry_bounds)}$"

    def _accuracy(self) -> str:
        """How far what is shown can be off, in a sentence."""
        if self.bound is None:
            return "Not certified: there is no bound, and digits are shown as they were computed."
        certified = "Proved" if self.rigorous else "Certified"
        return (
            f"{certified}: within {rounded_up(self.bound)} of the polyhedral surface's, relative "
            "to its size. Digits that this does not support are not shown; the last one of each "
            "number is off by 1 at most."
        )

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
    with threads_for(2.0 * len(total) ** 3):
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


def check_period_matrix(pm: Any) -> None:
    """Raise ValueError unless it is a :class:`PeriodMatrix`, with its surface and its marking."""
    if not isinstance(pm, PeriodMatrix):
        raise ValueError(
            f"this needs a PeriodMatrix, as period_matrix(V, F) returns it, not {in_words(pm)}."
        )


def _read_only(array: NDArray[Any]) -> NDArray[Any]:
    array.flags.writeable = False
    return array
