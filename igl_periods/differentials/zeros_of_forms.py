r"""Zeros of a holomorphic differential, and the stratum it lies in.

The orders of the 2g − 2 zeros of ζ, decreasing, name its *stratum* H(k_1, …, k_n), Σ k_i = 2g − 2.
On a triangulation the index of z = ∫ζ at a vertex
(:mod:`igl_periods.differentials.parametrization`) is the order of the zero there.  A zero inside a
face, or between vertices, shows as a face that is turned over or as a vertex of negative index
beside it; only the sum of all is 2g − 2 then, and the stratum is not told.  On a translation
surface dz has its zeros at the cone points, exactly.

References
----------
Kontsevich, Zorich, "Connected components of the moduli spaces of Abelian differentials with
prescribed singularities" (2003).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Ints, ReadOnlyArrays
from igl_periods.periods import PeriodMatrix

from .parametrization import parametrize


@dataclass(frozen=True, eq=False)
class FormZeros(ReadOnlyArrays):
    """Where a differential vanishes.

    Attributes
    ----------
    vertices : (n,) int
        Vertices with an index that is not 0.
    orders : (n,) int
        These indices: orders of zeros, or negative beside zeros that lie between vertices.
    reversed_faces : (m,) int
        Faces that z = ∫ζ turns over: one order of a zero each.

    Examples
    --------
    >>> import igl_periods as ip
    >>> K = ip.surfaces.square_tiled_surface("omega_1", n=2)
    >>> pm = ip.period_matrix(K)
    >>> ip.form_zeros(pm, [1, 0]).total
    2
    """

    vertices: Ints
    orders: Ints
    reversed_faces: Ints

    @property
    def total(self) -> int:
        """The sum of all orders: 2g − 2."""
        return int(self.orders.sum()) + len(self.reversed_faces)

    @property
    def stratum(self) -> tuple[int, ...] | None:
        """The orders of the zeros, decreasing; None where zeros lie between vertices."""
        if len(self.reversed_faces) or np.any(self.orders < 0):
            return None
        return tuple(sorted((int(k) for k in self.orders), reverse=True))

    def __repr__(self) -> str:
        known = "zeros between vertices" if self.stratum is None else f"H{self.stratum}"
        return f"FormZeros({known}, of orders {self.total} in all)"


def form_zeros(pm: PeriodMatrix, coefficients: ArrayLike) -> FormZeros:
    """The zeros of ζ = Σ_k coefficients[k] ζ_k, on the triangulation as given.

    Parameters
    ----------
    pm : PeriodMatrix
    coefficients : (g,) array-like of complex

    Raises
    ------
    ValueError
        If the number of coefficients is not g, or all are 0 or one is not finite.
    ComplexError
        If the surface is a sphere, or its triangles are so thin that their Laplacian is singular
        to rounding.

    Examples
    --------
    2g − 2 of them.

    >>> import igl_periods as ip
    >>> K = ip.surfaces.square_tiled_surface("omega_1", n=2)
    >>> pm = ip.period_matrix(K)
    >>> ip.form_zeros(pm, ip.most_even_form(pm)).total
    2
    """
    P = parametrize(pm, coefficients)
    index = P.index
    vertices = np.flatnonzero(index)
    return FormZeros(vertices, index[vertices], np.flatnonzero(P.reversed_faces))
