"""What recognition needs of a surface: its period matrix.

:func:`igl_periods.identify` compares matrices, and stands below the computation of any.  Of a
complex it asks :func:`~igl_periods.surfaces.matrix_of`, which learns here how.
"""

from __future__ import annotations

from igl_periods.complexes import DeltaComplex
from igl_periods.surfaces import matrix_of

from .computation import period_matrix
from .matrix import PeriodMatrix


@matrix_of.register
def matrix_of_complex(K: DeltaComplex) -> PeriodMatrix:
    """The period matrix of a closed, oriented, connected complex, by linear functions."""
    return period_matrix(K)
