r"""Newton bases at Leja points: the power series of a cell, well conditioned in floating point.

On each cell the trial functions are u = Re F, F = Σ_{k<K} a_k φ_k(w), with

.. math:: \varphi_0 = 1, \qquad \varphi_{k+1} = \sigma_k\, \varphi_k\, (w - w_k),

w_k the node of the cell's boundary at which |φ_k| is largest and σ_k such that the largest |φ_k+1|
is 1.  These are Leja points: they fill the boundary as a charge in equilibrium would, so that
|φ_k| stays of order 1 on all of it, where the monomials w^k are hopelessly small on most of it.
Points and factors are doubles, and exact: what is a polynomial here is the same one in any
precision.  A larger basis goes on where a smaller one ended, on other nodes of the same boundary,
so that coefficients keep their meaning.  Outside, |φ_k| grows like exp(k γ), γ Green's function of
the complement of the cell; so a_k falls like exp(−k γ) at the nearest singularity of u, a vertex.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from igl_periods.arrays import Complexes, Floats, Ints

from .interface_nodes import InterfaceNodes

_ROWS_AT_ONCE = 200_000


@dataclass(frozen=True, eq=False)
class TrialFunctions:
    """The bases of all cells, and their values at the nodes of the interfaces.

    Attributes
    ----------
    nodes : InterfaceNodes
    size : (n_cells,) int
        The number K of functions of each cell.
    points : list of (K,) complex
        w_k of each cell.
    factors : list of (K,) float
        σ_k of each cell.
    values : list of (rows of the cell, K) complex
        φ_k at the nodes.
    slopes : list of (rows of the cell, K) complex
        dφ_k/ds at the nodes, s along the side.
    """

    nodes: InterfaceNodes
    size: Ints
    points: list[Complexes]
    factors: list[Floats]
    values: list[Complexes]
    slopes: list[Complexes]


def trial_functions(
    nodes: InterfaceNodes, size: Ints, before: TrialFunctions | None = None
) -> TrialFunctions:
    """Newton bases at Leja points of the nodes, ``size`` functions for each cell.

    They begin with the functions of ``before``, no more than ``size``, where that is given.
    """
    n_cells = nodes.cells.n_cells
    found = TrialFunctions(
        nodes,
        size,
        *([np.empty(0)] * n_cells for _ in range(4)),  # type: ignore[arg-type]
    )
    n_rows = np.diff(nodes.start)
    for K in np.unique(size):
        alike = np.flatnonzero(size == K)
        portion = np.cumsum(n_rows[alike]) // _ROWS_AT_ONCE
        for p in np.unique(portion):
            _fill(found, alike[portion == p], int(K), before)
    return found


def _fill(found: TrialFunctions, chosen: Ints, K: int, before: TrialFunctions | None) -> None:
    """The bases of some cells, K functions each, step by step for all of them at once."""
    nodes = found.nodes
    n_rows = np.diff(nodes.start)[chosen]
    first = np.cumsum(n_rows) - n_rows
    owner = np.repeat(np.arange(chosen.size), n_rows)
    rows = nodes.start[chosen][owner] + np.arange(owner.size) - first[owner]
    w, dw = (x[rows] for x in nodes.coordinates)
    values = np.empty((K, owner.size), dtype=np.complex128)
    slopes = np.empty_like(values)
    points = np.empty((chosen.size, K), dtype=np.complex128)
    factors = np.empty((chosen.size, K))
    values[0], slopes[0] = 1.0, 0.0
    known = _known(chosen, before, points, factors)
    size = np.abs(w)
    for k in range(K):
        new = known <= k
        largest = _row_of_largest(size, first, owner)
        points[new, k] = w[largest[new]]
        step = w - points[owner, k]
        product = values[k] * step
        size = np.abs(product)
        factors[new, k] = 1.0 / np.maximum.reduceat(size, first)[new]
        if k + 1 == K:
            break
        factor = factors[owner, k]
        slopes[k + 1] = factor * (slopes[k] * step + values[k])
        values[k + 1] = factor * product
    slopes *= dw
    ends = [slice(a, a + n) for a, n in zip(first, n_rows)]
    for i, cell in enumerate(chosen.tolist()):
        found.points[cell], found.factors[cell] = points[i], factors[i]
        found.values[cell] = np.ascontiguousarray(values[:, ends[i]].T)
        found.slopes[cell] = np.ascontiguousarray(slopes[:, ends[i]].T)


def _known(chosen: Ints, before: TrialFunctions | None, points: Complexes, factors: Floats) -> Ints:
    """Copy points and factors that there were, and say how many of each cell."""
    known = np.zeros(chosen.size, dtype=np.int64)
    if before is not None:
        known = before.size[chosen]
        for i, (cell, n) in enumerate(zip(chosen.tolist(), known.tolist())):
            points[i, :n], factors[i, :n] = before.points[cell], before.factors[cell]
    return known


def _row_of_largest(size: Floats, first: Ints, owner: Ints) -> Ints:
    """The first row of each cell at which ``size`` is largest."""
    largest = np.flatnonzero(size == np.maximum.reduceat(size, first)[owner])
    _, index = np.unique(owner[largest], return_index=True)
    return largest[index]
