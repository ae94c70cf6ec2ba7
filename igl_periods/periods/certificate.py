"""From the energies of forms in raw classes to the certified matrix in the canonical basis.

Energies are computed for the thin, sparse cochains of the cotree; the integer change of basis T is
applied to the 2g × 2g matrix, T D Tᵀ, not to 2g dense forms.
"""

from __future__ import annotations

from igl_periods.arrays import Floats
from igl_periods.complexes import MarkedComplex
from igl_periods.errors import ComplexError

from .matrix import PeriodMatrix
from .rounding import LEAST_ALLOWANCE, combined, congruence
from .solved_forms import SolvedForms

# Where rounding may change energies by more, relative to them, nothing is known of the matrix.
_LARGEST_ROUNDING = 1.0


def certified_period_matrix(
    given: MarkedComplex, raw: Floats, allowance: float, forms: SolvedForms | None = None
) -> PeriodMatrix:
    """The period matrix in the canonical basis, from energies in the classes of the cochains.

    Parameters
    ----------
    given : MarkedComplex
        The surface as it was given, before any flip.
    raw : (2g, 2g) float
        Energies of explicit forms in the classes of ``given.cochains``.
    allowance : float
        What rounding can have changed in them, relative to them.
    forms : SolvedForms, optional
        The forms, to be kept.

    Raises
    ------
    ComplexError
        If that is so much that nothing is known of the matrix.
    """
    D, loss = congruence(given.basis, raw)
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
        cocycles=given.cocycles(),
        complex=given.complex,
        rounding=max(LEAST_ALLOWANCE, rounding),
        forms=forms,
    )
