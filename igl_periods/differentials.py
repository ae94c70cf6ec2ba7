r"""Holomorphic differentials on the triangulation of the mesh, and the Abel–Jacobi map.

Let α_1..α_g, β_1..β_g be the harmonic forms, linear on the triangles as given, in the classes of
the marking of a period matrix Π.  The normalised holomorphic differentials

.. math:: \zeta_k = \alpha_k + \sum_l \Pi_{kl}\, \beta_l

have :math:`\oint_{a_l} \zeta_k = \delta_{kl}` and :math:`\oint_{b_l} \zeta_k = \Pi_{kl}` exactly,
for the Π that was computed, by whatever method.  Their real and imaginary parts are harmonic in
the discrete sense, and ζ_k is holomorphic up to the error of discretisation, which shows in how
far the map z = ∫ζ is from being conformal on each triangle.

The Abel–Jacobi map takes a point P to :math:`\bigl(\int_{P_0}^P \zeta_k\bigr)_k` in the Jacobian
:math:`C^g / (Z^g + \Pi Z^g)`.  With the real coordinates x, y of
:math:`x + \Pi y \in C^g` the Jacobian is R^{2g} / Z^{2g}, and the map is

.. math:: x_k(P) = \int_{P_0}^P \alpha_k, \qquad y_l(P) = \int_{P_0}^P \beta_l \pmod 1 .

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Farkas, Kra, "Riemann surfaces" (1992), section III.6.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order

from .face_forms import along_sides
from .holomorphic import harmonic_forms
from .periods import PeriodMatrix
from .stages import stage

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Ints = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class AbelJacobi:
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


def normalised_differentials(pm: PeriodMatrix) -> Complexes:
    """The differentials ζ_1..ζ_g with periods δ and Π, along all edges; (g, n_edges) complex.

    Parameters
    ----------
    pm : PeriodMatrix
        Its ``complex`` and ``cocycles`` say on which triangulation and in which marking.

    Raises
    ------
    ComplexError
        If the triangles are so thin that their Laplacian is singular to rounding.
    """
    forms = _harmonic_forms(pm)
    zeta: Complexes = forms[: pm.genus] + pm.matrix @ forms[pm.genus :]
    return zeta


def abel_jacobi(pm: PeriodMatrix, base: int = 0) -> AbelJacobi:
    """Map every vertex to the Jacobian.

    Parameters
    ----------
    pm : PeriodMatrix
    base : int
        The vertex of ``pm.complex`` that goes to 0.

    Raises
    ------
    ValueError
        If there is no such vertex.
    """
    K = pm.complex
    if not 0 <= base < K.n_vertices:
        raise ValueError(f"there is no vertex {base}: there are {K.n_vertices}, counted from 0.")
    sides = along_sides(K, _harmonic_forms(pm))
    integrals = primitive(K.corner_vertex, np.moveaxis(sides, 0, -1))
    coordinates = np.mod(integrals - integrals[base], 1.0)
    # np.mod(-1e-17, 1) is 1.
    coordinates[coordinates == 1.0] = 0.0
    x, y = coordinates[:, : pm.genus], coordinates[:, pm.genus :]
    return AbelJacobi(coordinates, x + y @ pm.matrix)


def _harmonic_forms(pm: PeriodMatrix) -> Floats:
    """α_1..α_g, β_1..β_g on the triangulation as given; (2g, n_edges)."""
    with stage("harmonic forms on the mesh"):
        return harmonic_forms(pm.complex, pm.cocycles)


def primitive(corner: Ints, sides: NDArray[Any]) -> NDArray[Any]:
    """Integrate values along sides to values at vertices, along a spanning tree.

    Parameters
    ----------
    corner : (m, 3) int
        The vertices of connected triangles.
    sides : (m, 3, …)
        Value along side s of each face, from corner s + 1 to corner s + 2.

    Returns
    -------
    (n, …)
        0 at vertex 0.
    """
    tail, head = np.roll(corner, -1, axis=1).ravel(), np.roll(corner, 1, axis=1).ravel()
    n = int(corner.max()) + 1
    # Every side both ways: sides of a boundary are run through once only.
    graph = csr_array((np.ones(tail.size, dtype=np.int8), (tail, head)), shape=(n, n))
    order, parent = breadth_first_order(graph + graph.T, 0, directed=True)
    assert order.size == n, "the triangles are connected"
    parent = parent.astype(np.int64)
    parent[0] = 0
    values = sides.reshape(tail.size, *sides.shape[2:])
    total = np.zeros((n, *values.shape[1:]), dtype=values.dtype)
    for start, end, sign in ((tail, head, 1), (head, tail, -1)):
        steps = np.flatnonzero(parent[end] == start)
        total[end[steps]] = sign * values[steps]
    total[0] = 0
    # Add up along the paths to the root, in as many rounds as their length has binary digits.
    while parent.any():
        total += total[parent]
        parent = parent[parent]
    return total
