r"""Forms on the edges of the quad-graph ◊, and how they relate to forms on its diagonals Λ.

The quadrilateral (x, y, x', y') of ◊ is counterclockwise.  Numbering its vertices x_1, …, x_4 in
this order, cyclically, the wedge product of 1-forms on its sides is the mean over its corners,

.. math:: \iint \alpha \wedge \beta = \tfrac14 \sum_k \Bigl(
          \int_{x_{k-1} x_k} \alpha \int_{x_k x_{k+1}} \beta
          - \int_{x_{k+1} x_k} \alpha \int_{x_k x_{k-1}} \beta \Bigr) .

d is a derivation for it when functions are averaged where they are multiplied: f α over the ends
of a side, f ω over the vertices of a quadrilateral.  Averaging a 1-form over the two ways along
sides from one end of a diagonal to the other gives a form on Λ (:func:`on_diagonals`).  The wedge
product of the averages is the wedge product on the sides, for all forms, closed or not.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 2.
Mercat, "Discrete Riemann surfaces and the Ising model" (2001), section 2.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Ints, Values

from .graph import DoubleGraph


def side_ends(graph: DoubleGraph) -> tuple[Ints, Ints]:
    """The vertices in Γ and in Γ* that each edge of ◊ joins; two arrays of shape (2 n_edges,)."""
    (x, y), (x2, y2) = graph.tail, graph.head
    start, end = np.empty((2, 2 * graph.n_edges), dtype=np.int64)
    start[graph.sides], end[graph.sides] = [x, x2, x2, x], [y, y, y2, y2]
    return start, end


def side_d0(graph: DoubleGraph, f: Values) -> Values:
    """The differential of a function on the edges of ◊.

    Parameters
    ----------
    f : (…, n_vertices)

    Returns
    -------
    (…, 2 n_edges)
    """
    start, end = side_ends(graph)
    return f[..., end] - f[..., start]


def side_d1(graph: DoubleGraph, alpha: Values) -> Values:
    """The exterior derivative of a 1-form on ◊: its sums around quadrilaterals.

    Parameters
    ----------
    alpha : (…, 2 n_edges)

    Returns
    -------
    (…, n_edges)
    """
    return _around(graph, alpha).sum(axis=-2)


def side_wedge(graph: DoubleGraph, alpha: Values, beta: Values) -> Values:
    """The wedge product of 1-forms on ◊, a 2-form on ◊.

    Parameters
    ----------
    alpha, beta : (…, 2 n_edges)

    Returns
    -------
    (…, n_edges)
    """
    after_a, after_b = _around(graph, alpha), _around(graph, beta)
    before_a, before_b = np.roll(after_a, 1, axis=-2), np.roll(after_b, 1, axis=-2)
    return 0.25 * (before_a * after_b - after_a * before_b).sum(axis=-2)


def side_product(graph: DoubleGraph, f: Values, alpha: Values) -> Values:
    """The 1-form f α on ◊, f being averaged over the ends of each side.

    Parameters
    ----------
    f : (…, n_vertices)
    alpha : (…, 2 n_edges)

    Returns
    -------
    (…, 2 n_edges)
    """
    start, end = side_ends(graph)
    return 0.5 * (f[..., start] + f[..., end]) * alpha


def quad_product(graph: DoubleGraph, f: Values, omega: Values) -> Values:
    """The 2-form f ω on ◊, f being averaged over the vertices of each quadrilateral.

    Parameters
    ----------
    f : (…, n_vertices)
    omega : (…, n_edges)

    Returns
    -------
    (…, n_edges)
    """
    return 0.25 * (f[..., graph.tail] + f[..., graph.head]).sum(axis=-2) * omega


def on_diagonals(graph: DoubleGraph, alpha: Values) -> Values:
    """The form on Λ that is, along a diagonal, the mean of α along the two ways around it.

    On the differential of a function it is the differential on Λ.

    Parameters
    ----------
    alpha : (…, 2 n_edges)

    Returns
    -------
    (…, 2, n_edges)
    """
    a1, a2, a3, a4 = np.moveaxis(_around(graph, alpha), -2, 0)
    return 0.5 * np.stack([a1 + a2 - a3 - a4, a2 + a3 - a4 - a1], axis=-2)


def _around(graph: DoubleGraph, alpha: Values) -> Values:
    """Values along the sides x y, y x', x' y', y' x of each quadrilateral; (…, 4, n_edges)."""
    return alpha[..., graph.sides] * np.array([[1], [-1], [1], [-1]])
