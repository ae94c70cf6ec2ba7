r"""Quadrilaterals: a disc with four points on its boundary, and its modulus.

Let z_1 … z_4 lie in this order on a boundary loop of a surface K.  The electrodes are the sides
from z_1 to z_2 and from z_3 to z_4, at potentials 0 and 1; all else of the boundary is insulated.
The *modulus* h is the resistance between them, the extremal length of the curves that join them.  A
disc is equivalent to a rectangle of width 1 and height h, the electrodes its bottom and its top.

Insulated sides are mirrors: doubled along them the surface is one whose boundary consists of the
two doubled electrodes, and it has half the resistance.  What remains is that of two loops
(:mod:`~igl_periods.domains.capacities`).

If K is a disc, the conjugate quadrilateral z_2, z_3, z_4, z_1 has the modulus 1/h.  Its computation
has trial functions of its own: that the product is 1 within the bounds is a check of both.

References
----------
Ahlfors, "Conformal invariants" (1973), chapter 4.
Papamichael, Stylianopoulos, "Numerical conformal mapping: domain decomposition and the mapping of
quadrilaterals" (2010).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Ints
from igl_periods.complexes import DeltaComplex, checked_array, double, of_a_surface
from igl_periods.display import known_digits, rounded_up
from igl_periods.errors import ComplexError

from .boundary_classes import BoundaryLoop, boundary_loops
from .capacities import CapacityMatrix, capacity_matrix


@dataclass(frozen=True, eq=False, repr=False)
class ExtremalLength:
    """The extremal length between two sides of a quadrilateral, between two proved bounds.

    ``float`` gives ``value``.

    Attributes
    ----------
    corners : (4,) int
        The rows of V, or labels of vertices, of z_1 … z_4.
    capacities : CapacityMatrix
        Of the surface doubled along the insulated sides: it has twice the capacity.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.planar_domain([0, 3, 3 + 1j, 1j])
    >>> round(float(ip.extremal_length(V, F, [0, 1, 2, 3])), 9)
    0.333333333
    """

    corners: Ints
    capacities: CapacityMatrix

    @property
    def value(self) -> float:
        """The modulus h."""
        return 2.0 * float(self.capacities.resistances[0, 1])

    @property
    def bounds(self) -> tuple[float, float]:
        """The lower and the upper bound of h."""
        lower, upper = self.capacities.resistance_bounds
        return 2.0 * float(lower[0, 1]), 2.0 * float(upper[0, 1])

    def __float__(self) -> float:
        return self.value

    def __repr__(self) -> str:
        lower, upper = self.bounds
        error = max(upper - self.value, self.value - lower)
        return f"ExtremalLength({known_digits(self.value, error)}, within {rounded_up(error, 3)})"


@of_a_surface
def extremal_length(
    K: DeltaComplex,
    corners: ArrayLike,
    *,
    tolerance: float | None = 1e-8,
    degree: int | None = None,
    max_unknowns: int | None = None,
) -> ExtremalLength:
    """The modulus of a quadrilateral: the extremal length between two of its sides.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`, with a boundary; oriented and connected.  Other
        boundary loops and handles may be there: those loops are insulated.
    corners : (4,) array-like of int
        Rows of V (labels of vertices) z_1 … z_4 on one boundary loop, in its order, which has the
        surface on the left.  The sides are those from z_1 to z_2 and from z_3 to z_4.
    tolerance, degree, max_unknowns
        As for :func:`capacity_matrix`.

    Returns
    -------
    ExtremalLength

    Raises
    ------
    ComplexError
        If the corners are not four vertices of one boundary loop in its order, or the surface is
        not connected and oriented.

    Warns
    -----
    ToleranceWarning
        If the tolerance is not met.

    Examples
    --------
    >>> rectangle = [[0, 0], [2, 0], [2, 3], [0, 3]]
    >>> h = extremal_length(rectangle, [[0, 1, 2], [0, 2, 3]], [0, 1, 2, 3])
    >>> round(h.value, 12), h.bounds[0] <= 1.5 <= h.bounds[1]
    (1.5, True)
    """
    mirrors, chosen = insulated_sides(K, corners)
    C = capacity_matrix(
        double(K, along=mirrors), tolerance=tolerance, degree=degree, max_unknowns=max_unknowns
    )
    return ExtremalLength(chosen, C)


def insulated_sides(K: DeltaComplex, corners: ArrayLike) -> tuple[Ints, Ints]:
    """The half-edges of the boundary that are on no electrode of a quadrilateral, and its corners.

    Raises
    ------
    ComplexError
        As for :func:`extremal_length`.
    """
    chosen = _checked_corners(corners)
    loop, place = _places(K, boundary_loops(K), chosen)
    insulated = np.ones(K.twin.size, dtype=bool)
    n = loop.half_edges.size
    for start, end in ((place[0], place[1]), (place[2], place[3])):
        insulated[loop.half_edges[(start + np.arange((end - start) % n)) % n]] = False
    return np.flatnonzero(insulated & (K.twin.ravel() < 0)), chosen


def _checked_corners(corners: ArrayLike) -> Ints:
    chosen = checked_array(corners, "corners", ComplexError)
    if chosen.shape != (4,) or chosen.dtype.kind not in "iu":
        raise ComplexError(
            f"a quadrilateral has four corners, integers that number vertices, not an array of "
            f"shape {chosen.shape} of {chosen.dtype}."
        )
    return chosen.astype(np.int64)


def _places(K: DeltaComplex, loops: list[BoundaryLoop], corners: Ints) -> tuple[BoundaryLoop, Ints]:
    """The loop of the corners, and where they are on it."""
    for loop in loops:
        place = {label: k for k, label in enumerate(K.labels[loop.vertices].tolist())}
        found = [place.get(corner) for corner in corners.tolist()]
        known = [k for k in found if k is not None]
        if not known:
            continue
        if len(known) < 4:
            missing = corners[found.index(None)]
            raise ComplexError(
                f"vertex {missing} is not on the boundary loop of the other corners: four corners "
                "lie on one loop."
            )
        steps = (np.roll(known, -1) - known) % loop.half_edges.size
        if steps.min() == 0 or steps.sum() != loop.half_edges.size:
            raise ComplexError(
                f"the corners {corners.tolist()} do not follow each other along the boundary, with "
                "the surface on the left: take four different ones in this order."
            )
        return loop, np.array(known, dtype=np.int64)
    raise ComplexError(f"vertex {corners[0]} is on no boundary loop: corners lie on the boundary.")
