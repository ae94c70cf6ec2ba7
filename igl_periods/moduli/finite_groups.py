r"""Finite groups as multiplication tables, and whether two of them are isomorphic.

An isomorphism is determined by the images of generators.  Generators of one group are sent to
elements of the other that look alike (order, size of the conjugacy class, number of square roots);
the map is continued along words until it contradicts itself, or is a bijection.  So the answer is
exact both ways.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np

from igl_periods.arrays import Ints

Element = TypeVar("Element", bound=Hashable)
# What two elements of isomorphic groups that correspond to each other have in common.
Look = tuple[int, int, int]


@dataclass(frozen=True, eq=False)
class FiniteGroup:
    """A finite group.

    Attributes
    ----------
    table : (n, n) int
        The product of the elements i and j is table[i, j]; 0 is the neutral element.
    """

    table: Ints

    def __repr__(self) -> str:
        return f"FiniteGroup(order {self.order})"

    @property
    def order(self) -> int:
        """The number of elements."""
        return len(self.table)

    @cached_property
    def inverse(self) -> Ints:
        """The inverses of all elements."""
        return np.argmin(self.table, axis=1)

    @cached_property
    def orders(self) -> Ints:
        """The orders of all elements."""
        found = np.zeros(self.order, dtype=np.int64)
        power, everything = np.arange(self.order), np.arange(self.order)
        n = 1
        while (found == 0).any():
            found[(power == 0) & (found == 0)] = n
            power, n = self.table[power, everything], n + 1
        return found

    @cached_property
    def class_sizes(self) -> Ints:
        """The sizes of the conjugacy classes of all elements."""
        centralizer = (self.table == self.table.T).sum(axis=1)
        return self.order // centralizer

    @cached_property
    def looks(self) -> list[Look]:
        """Order, size of the conjugacy class and number of square roots of all elements."""
        roots = np.bincount(np.diagonal(self.table), minlength=self.order)
        columns = (self.orders, self.class_sizes, roots)
        return list(zip(*(column.tolist() for column in columns), strict=True))

    @property
    def is_abelian(self) -> bool:
        """Whether all elements commute."""
        return bool(np.array_equal(self.table, self.table.T))

    @property
    def centre_order(self) -> int:
        """The order of the centre."""
        return int((self.class_sizes == 1).sum())

    @cached_property
    def derived_order(self) -> int:
        """The order of the subgroup that commutators generate."""
        inverses = self.table[self.inverse[:, None], self.inverse[None]]
        commutators = np.unique(self.table[inverses, self.table])
        return len(self.generated(commutators.tolist()))

    @cached_property
    def invariants(self) -> tuple[int, int, int, tuple[tuple[Look, int], ...]]:
        """Numbers that isomorphic groups share."""
        looks = tuple(sorted(Counter(self.looks).items()))
        return self.order, self.centre_order, self.derived_order, looks

    def quotient_by(self, z: int) -> FiniteGroup:
        """The quotient by an element of order 2 in the centre."""
        partner = self.table[:, z]
        chosen = np.flatnonzero(np.arange(self.order) < partner)
        place = np.empty(self.order, dtype=np.int64)
        place[chosen] = place[partner[chosen]] = np.arange(len(chosen))
        return FiniteGroup(place[self.table[np.ix_(chosen, chosen)]])

    def generated(self, generators: Sequence[int]) -> set[int]:
        """The subgroup that some elements generate."""
        reached, frontier = {0}, {0}
        while frontier:
            products = {int(self.table[x, s]) for x in frontier for s in generators}
            frontier = products - reached
            reached |= frontier
        return reached

    @cached_property
    def generators(self) -> list[int]:
        """Few elements that generate the group, of large order first."""
        chosen: list[int] = []
        reached = {0}
        while len(reached) < self.order:
            best = max(
                (x for x in np.argsort(-self.orders, kind="stable").tolist() if x not in reached),
                key=lambda x: self.orders[x] if not chosen else len(self.generated([*chosen, x])),
            )
            chosen.append(best)
            reached = self.generated(chosen)
        return chosen


def group_of(generators: Sequence[Element], compose: Callable[[Element, Element], Element],
             neutral: Element) -> FiniteGroup:  # fmt: skip
    """The group that some elements generate, under a composition."""
    index = {neutral: 0}
    elements = [neutral]
    for x in elements:
        for s in generators:
            y = compose(x, s)
            if y not in index:
                index[y] = len(elements)
                elements.append(y)
    return FiniteGroup(np.array([[index[compose(x, y)] for y in elements] for x in elements]))


def group_of_matrices(matrices: Sequence[Ints]) -> FiniteGroup:
    """The group of integer matrices that are closed under products, the neutral one first.

    Raises
    ------
    ValueError
        If they are not closed under products.
    """
    stack = np.stack(list(matrices)).astype(np.int64)
    generator = np.random.default_rng(0)
    vector = generator.integers(1, 1 << 20, stack.shape[1])
    images = stack @ vector  # (n, 2g); matrices are told apart by where they send a vector
    weights = generator.integers(1, 1 << 30, stack.shape[1])
    keys = images @ weights
    order = np.argsort(keys)
    if len(np.unique(keys)) < len(keys):
        raise ValueError("the matrices are not different from each other")
    table = np.empty((len(stack), len(stack)), dtype=np.int64)
    for i, M in enumerate(stack):
        products = (images @ M.T) @ weights
        places = np.clip(np.searchsorted(keys, products, sorter=order), 0, len(keys) - 1)
        table[i] = order[places]
        if not np.array_equal(keys[table[i]], products):
            raise ValueError(f"the {len(stack)} matrices are not closed under products")
    return FiniteGroup(table)


def direct_product(G: FiniteGroup, H: FiniteGroup) -> FiniteGroup:
    """The direct product of two groups."""
    n, m = G.order, H.order
    table = G.table[:, None, :, None] * m + H.table[None, :, None, :]
    return FiniteGroup(table.reshape(n * m, n * m))


def are_isomorphic(G: FiniteGroup, H: FiniteGroup) -> bool:
    """Whether two groups are isomorphic."""
    if G.invariants != H.invariants:
        return False
    return next(_isomorphisms(G, H), None) is not None


def _isomorphisms(G: FiniteGroup, H: FiniteGroup) -> Iterator[dict[int, int]]:
    """Isomorphisms G → H, the first generator up to conjugation."""
    generators = G.generators
    if not generators:
        yield {0: 0}
        return
    stack: list[list[int]] = [[h] for h in _representatives(H) if _alike(G, H, generators[0], h)]
    while stack:
        images = stack.pop()
        found = _continued(G, H, generators[: len(images)], images)
        if found is None:
            continue
        if len(images) == len(generators):
            yield found
            return
        following = generators[len(images)]
        stack += [[*images, h] for h in range(H.order) if _alike(G, H, following, h)]


def _alike(G: FiniteGroup, H: FiniteGroup, g: int, h: int) -> bool:
    return G.looks[g] == H.looks[h]


def _representatives(G: FiniteGroup) -> list[int]:
    """One element of each conjugacy class."""
    left, chosen = np.ones(G.order, dtype=bool), []
    for x in range(G.order):
        if left[x]:
            chosen.append(x)
            left[G.table[G.table[:, x], G.inverse]] = False
    return chosen


def _continued(
    G: FiniteGroup, H: FiniteGroup, generators: Sequence[int], images: Sequence[int]
) -> dict[int, int] | None:
    """The map on the subgroup generated that sends generators to images, if it is one to one."""
    image, frontier = {0: 0}, [0]
    used = {0}
    while frontier:
        reached = []
        for x in frontier:
            for s, t in zip(generators, images, strict=True):
                y, z = int(G.table[x, s]), int(H.table[image[x], t])
                if y not in image:
                    if z in used:
                        return None
                    image[y] = z
                    used.add(z)
                    reached.append(y)
                elif image[y] != z:
                    return None
        frontier = reached
    return image
