r"""Short representatives of the canonical cycles.

The cycles of a tree–cotree decomposition run to the root of the tree and back, and cycles of
another marking are sums of them.  For looking at, shorter walks in the same homology classes are
better.  A part of a walk may be replaced by the shortest path between its ends if the two are
homologous, that is if all 2g cocycles of the marking have the same integrals along them.  These
are integers, so that the class of a cycle is kept exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, half_edge_ends
from igl_periods.run_log import stage
from igl_periods.symplectic import standard_form

from .cycles import homology_basis, reversed_walk, without_returns

# Each round starts at one of so many places along the walk, and goes on until all are in vain.
_PLACES, _MOST_ROUNDS = 6, 60
_LEAST_SAVING = 1e-12


def canonical_cycles(K: DeltaComplex, cocycles: csr_array) -> list[Ints]:
    """Short closed walks in the classes of a_1..a_g, b_1..b_g of a marking.

    Parameters
    ----------
    K : DeltaComplex
        Closed, oriented, connected.
    cocycles : (2g, n_edges) sparse int
        Any marking: the cycles are dual to it, ∮_{a_j} α_i = δ_ij = ∮_{b_j} β_i.

    Returns
    -------
    list of 2g int arrays
        Half-edges in the order in which they are passed, as in
        :func:`igl_periods.homology_basis`.
    """
    with stage("cycles"):
        graph = _Graph.of(K, cocycles)
        walks = homology_basis(K)
        periods = np.array([graph.period[walk].sum(axis=0) for walk in walks]).T
        J = standard_form(K.genus)
        # periods[i, j] = ∮_{walk j} cocycle i is symplectic; the dual basis has the coefficients
        # of its inverse transpose −J periods J.
        coefficients = -J @ periods @ J
        return [graph.shortened(graph.combined(walks, row)) for row in coefficients]


@dataclass(frozen=True, eq=False)
class _Tree:
    """Shortest paths from a root: distances, and the half-edge into each vertex or -1."""

    distance: Floats
    into: Ints


@dataclass(frozen=True, eq=False)
class _Graph:
    """The graph of vertices, with one shortest half-edge from vertex to vertex."""

    tail: Ints
    head: Ints
    twin: Ints
    length: Floats
    period: Ints  # of the cocycles along each half-edge; (3 m, 2g)
    weights: csr_array
    half_edge: Ints  # of each entry of weights
    key: Ints  # tail n + head of those, increasing

    @classmethod
    def of(cls, K: DeltaComplex, cocycles: csr_array) -> _Graph:
        tail, head = half_edge_ends(K)
        length = K.lengths.ravel()
        order = np.lexsort((length, head, tail))
        order = order[tail[order] != head[order]]
        first = np.ones(order.size, dtype=bool)
        first[1:] = (np.diff(tail[order]) != 0) | (np.diff(head[order]) != 0)
        best = order[first]
        start = np.searchsorted(tail[best], np.arange(K.n_vertices + 1))
        return cls(
            tail=tail,
            head=head,
            twin=K.twin.ravel(),
            length=length,
            period=cocycles.toarray().T[K.edge.ravel()] * K.sign.ravel()[:, None],
            weights=csr_array((length[best], head[best], start), shape=(K.n_vertices,) * 2),
            half_edge=best,
            key=tail[best] * K.n_vertices + head[best],
        )

    def combined(self, walks: list[Ints], coefficients: Ints) -> Ints:
        """The walks with multiplicities, joined by shortest paths from the start of the first."""
        chosen = np.flatnonzero(coefficients)
        if chosen.size == 0:
            return np.zeros(0, dtype=np.int64)
        tree = self.tree(int(self.tail[walks[chosen[0]][0]]), np.inf)
        parts: list[Ints] = []
        for j in chosen:
            there = self.path(tree, int(self.tail[walks[j][0]]))
            once = walks[j] if coefficients[j] > 0 else reversed_walk(walks[j], self.twin)
            parts += [there, *[once] * int(abs(coefficients[j])), reversed_walk(there, self.twin)]
        return without_returns(np.concatenate(parts), self.twin)

    def shortened(self, walk: Ints) -> Ints:
        """A closed walk in the same homology class that is not longer."""
        in_vain = 0
        for _ in range(_MOST_ROUNDS):
            if walk.size < 3 or in_vain == _PLACES:
                break
            shorter = self._with_shortcut(walk)
            in_vain = in_vain + 1 if shorter is walk else 0
            shift = 1 + shorter.size // _PLACES
            walk = without_returns(np.roll(shorter, -shift), self.twin)
        return walk

    def _with_shortcut(self, walk: Ints) -> Ints:
        """The walk with the part from its start that is best replaced by a shortest path."""
        along, ends = np.cumsum(self.length[walk]), self.head[walk]
        # Parts longer than half of the walk are shortened in pieces.
        tree = self.tree(int(self.tail[walk[0]]), 0.5 * float(along[-1]))
        saving = along - tree.distance[ends]
        periods = np.cumsum(self.period[walk], axis=0)
        saving[(self._periods(tree, ends) != periods).any(axis=1)] = 0.0
        j = int(np.argmax(saving))
        if saving[j] <= _LEAST_SAVING * along[-1]:
            return walk
        return np.concatenate([self.path(tree, int(ends[j])), walk[j + 1 :]])

    def tree(self, root: int, limit: float) -> _Tree:
        """Shortest paths from a vertex to those within a distance."""
        distance, before = dijkstra(
            self.weights, indices=root, return_predecessors=True, limit=limit
        )
        reached = np.flatnonzero(before >= 0)
        n = np.int64(distance.size)
        into = np.full(n, -1, dtype=np.int64)
        into[reached] = self.half_edge[np.searchsorted(self.key, before[reached] * n + reached)]
        return _Tree(distance, into)

    def path(self, tree: _Tree, vertex: int) -> Ints:
        """The half-edges from the root to a vertex."""
        steps: list[int] = []
        while (half_edge := int(tree.into[vertex])) >= 0:
            steps.append(half_edge)
            vertex = int(self.tail[half_edge])
        return np.array(steps[::-1], dtype=np.int64)

    def _periods(self, tree: _Tree, vertices: Ints) -> Ints:
        """Integrals of the cocycles along the shortest paths to some vertices; (k, 2g)."""
        total = np.zeros((vertices.size, self.period.shape[1]), dtype=np.int64)
        vertices, climbing = vertices.copy(), np.arange(vertices.size)
        while climbing.size:
            half_edge = tree.into[vertices[climbing]]
            below = half_edge >= 0
            climbing, half_edge = climbing[below], half_edge[below]
            total[climbing] += self.period[half_edge]
            vertices[climbing] = self.tail[half_edge]
        return total
