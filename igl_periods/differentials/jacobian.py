r"""The Abel–Jacobi map.

It takes a point P to :math:`\bigl(\int_{P_0}^P \zeta_k\bigr)_k` in the Jacobian
:math:`C^g / (Z^g + \Pi Z^g)`.  With the real coordinates x, y of
:math:`x + \Pi y \in C^g` the Jacobian is R^{2g} / Z^{2g}, and the map is

.. math:: x_k(P) = \int_{P_0}^P \alpha_k, \qquad y_l(P) = \int_{P_0}^P \beta_l \pmod 1 .

It extends to divisors Σ m_P P by addition.

References
----------
Farkas, Kra, "Riemann surfaces" (1992), section III.6.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Complexes, Floats, ReadOnlyArrays
from igl_periods.complexes import along_sides, primitive
from igl_periods.display import facts_html
from igl_periods.options import checked_integer
from igl_periods.periods import PeriodMatrix, check_period_matrix

from .normalised import harmonic_forms_on_edges


@dataclass(frozen=True, eq=False)
class AbelJacobi(ReadOnlyArrays):
    """The Abel–Jacobi map of the vertices.

    Attributes
    ----------
    coordinates : (n_vertices, 2g) float
        x_1..x_g, y_1..y_g, each in [0, 1); 0 at the base vertex.
    points : (n_vertices, g) complex
        x + Π y, in the fundamental parallelepiped of the lattice Z^g + Π Z^g.
    """

    coordinates: Floats
    points: Complexes

    def __repr__(self) -> str:
        n, g = self.points.shape
        return f"AbelJacobi({n} vertices in a Jacobian of dimension {g})"

    def _repr_html_(self) -> str:
        n, g = self.points.shape
        facts = [("vertices", str(n)), ("Jacobian", f"C^{g} / (Z^{g} + Π Z^{g})")]
        return facts_html("Abel–Jacobi map", facts)


def abel_jacobi(pm: PeriodMatrix, base: int = 0) -> AbelJacobi:
    """The Abel–Jacobi map of all vertices to the Jacobian.

    Parameters
    ----------
    pm : PeriodMatrix
    base : int
        The vertex of ``pm.complex`` that goes to 0.

    Raises
    ------
    ValueError
        If there is no such vertex.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> pm = ip.period_matrix(V, F)
    >>> ip.abel_jacobi(pm)
    AbelJacobi(96 vertices in a Jacobian of dimension 1)
    """
    check_period_matrix(pm)
    K, base = pm.complex, checked_integer("base", base)
    if not 0 <= base < K.n_vertices:
        raise ValueError(f"there is no vertex {base}: there are {K.n_vertices}, counted from 0.")
    sides = along_sides(K, harmonic_forms_on_edges(pm))
    integrals = primitive(K.corner_vertex, np.moveaxis(sides, 0, -1))
    coordinates = np.mod(integrals - integrals[base], 1.0)
    # np.mod(-1e-17, 1) is 1.
    coordinates[coordinates == 1.0] = 0.0
    x, y = coordinates[:, : pm.genus], coordinates[:, pm.genus :]
    return AbelJacobi(coordinates, x + y @ pm.matrix)


def divisor_class(pm: PeriodMatrix, divisor: Mapping[int, int], base: int = 0) -> Complexes:
    """The point Σ m_P A(P) of the Jacobian, A the Abel–Jacobi map, for a divisor Σ m_P P.

    By Abel's theorem a divisor of degree 0 is that of a meromorphic function iff this is 0; of
    degree 0 it does not depend on the base vertex.

    Parameters
    ----------
    pm : PeriodMatrix
    divisor : mapping
        From vertices of ``pm.complex`` to multiplicities.
    base : int
        The vertex that goes to 0.

    Returns
    -------
    (g,) complex
        In the fundamental parallelepiped of the lattice Z^g + Π Z^g, up to rounding at its border.

    Raises
    ------
    ValueError
        If there is no such vertex, or a multiplicity is not an integer.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> pm = ip.period_matrix(V, F)
    >>> ip.divisor_class(pm, {0: 1, 5: -1}).shape
    (1,)
    """
    image, g = abel_jacobi(pm, base), pm.genus
    total = np.zeros(2 * g)
    for vertex, multiplicity in divisor.items():
        place = checked_integer("a vertex", vertex)
        if not 0 <= place < len(image.coordinates):
            raise ValueError(
                f"there is no vertex {place}: there are {len(image.coordinates)}, counted from 0."
            )
        total += checked_integer("a multiplicity", multiplicity) * image.coordinates[place]
    total = np.mod(total, 1.0)
    point: Complexes = total[:g] + total[g:] @ pm.matrix
    return point
