"""From the energies of forms in raw classes to the certified matrix in the canonical basis.

Energies are computed for the thin, sparse cochains of the cotree; the integer change of basis T is
applied to the 2g × 2g matrix, T D Tᵀ, not to 2g dense forms.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex
from igl_periods.errors import ComplexError

from .matrix import PeriodMatrix
from .rounding import LEAST_ALLOWANCE, combined, congruence

# Where rounding may change energies by more, relative to them, nothing is known of the matrix.
_LARGEST_ROUNDING = 1.0


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
        cocycles=combined_cochains(T, cochains),
        complex=K,
        rounding=max(LEAST_ALLOWANCE, rounding),
    )


def combined_cochains(T: NDArray[np.int8], cochains: csr_array) -> csr_array:
    """The cochains T c, with integers that have room."""
    return csr_array(csr_array(T.astype(np.int64)) @ cochains)
