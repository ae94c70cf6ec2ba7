r"""The symmetries of a period matrix, and those of the surface that they come from.

The group of a period matrix holds the γ in Sp(2g, Z) with γ · Π = Π, −1 among them.  By Torelli's
theorem it is the automorphism group of the Jacobian, and

* if the surface is hyperelliptic, −1 comes from the hyperelliptic involution and the group is
  Aut X (for g = 1: the automorphisms that fix a point);
* otherwise every ±γ comes from one automorphism, and the group is Aut X × {±1}.

Orientation-reversing symmetries are the integer σ with σ J σᵀ = −J and (aΠ̄ + b)(cΠ̄ + d)⁻¹ = Π.
Those with σ² = 1 are *real structures*: σ, or −σ, is an antiholomorphic involution of the surface.

References
----------
Milne, "Jacobian varieties" (1986), section 12, for Torelli's theorem in this form.
Lange, Birkenhake, "Complex abelian varieties" (2004), section 11.1 and exercise 11.12 (19).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import overload

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Ints
from igl_periods.display import facts_html
from igl_periods.errors import EnumerationLimitError
from igl_periods.siegel import PointInBalls

from .equivalence import Isomorphisms, symplectic_isomorphisms
from .finite_groups import FiniteGroup, group_of_matrices
from .group_names import group_name
from .theta import is_hyperelliptic

# No automorphism of a surface of genus g ≥ 2 has order above 4g + 2 (Wiman), no γ then above twice
# that; powers of elements of infinite order are followed no further.
_LARGEST_ORDER = 400


@dataclass(frozen=True, eq=False)
class SymplecticGroup(Sequence[Ints]):
    """The symplectic automorphisms of a period matrix: a sequence of (2g, 2g) integer arrays.

    Attributes
    ----------
    elements : Isomorphisms
        All γ with γ · Π = Π up to the tolerance, the identity first.
    reversing : Isomorphisms
        All integer σ with σ J σᵀ = −J and (aΠ̄ + b)(cΠ̄ + d)⁻¹ = Π up to the tolerance.
    hyperelliptic : bool or None
        Whether the surface is hyperelliptic; None if that was not decided (beyond genus 3).

    Raises
    ------
    RuntimeError
        If a search did not come to its end: then this is not the group.

    Examples
    --------
    >>> import igl_periods as ip
    >>> ip.symplectic_automorphism_group([[1j]], tolerance=1e-9).order
    4
    """

    elements: Isomorphisms
    reversing: Isomorphisms
    hyperelliptic: bool | None

    def __post_init__(self) -> None:
        for found in (self.elements, self.reversing):
            if not found.complete:
                raise EnumerationLimitError(found.gave_up or "the search was stopped at its limit")

    def __repr__(self) -> str:
        return f"SymplecticGroup({', '.join(f'{name} {value}' for name, value in self._facts())})"

    def _repr_html_(self) -> str:
        return facts_html("SymplecticGroup", self._facts())

    def _facts(self) -> list[tuple[str, str]]:
        answer = {True: "yes", False: "no", None: "not decided"}[self.hyperelliptic]
        return [
            ("order", str(self.order)),
            *([("name", self.name)] if self.name is not None else []),
            ("reversing", str(len(self.reversing))),
            ("hyperelliptic", answer),
            ("of the surface", " or ".join(map(str, self.surface_orders))),
        ]

    def __len__(self) -> int:
        return len(self.elements)

    @overload
    def __getitem__(self, index: int) -> Ints: ...
    @overload
    def __getitem__(self, index: slice) -> list[Ints]: ...
    def __getitem__(self, index: int | slice) -> Ints | list[Ints]:
        return self.elements[index]

    @property
    def order(self) -> int:
        """Number of elements, −1 included."""
        return len(self.elements)

    @cached_property
    def group(self) -> FiniteGroup:
        """The multiplication table of the elements, in their order.

        Raises
        ------
        ValueError
            If the elements are not a group: see ``generators``.
        """
        return group_of_matrices(list(self.elements))

    @cached_property
    def name(self) -> str | None:
        """The name of the group, such as ``"GL(2,3)"`` or ``"PSL(2,7) x C2"``.

        D_n has 2n elements.  None if it is isomorphic to none of the groups that have a name in
        :mod:`igl_periods.moduli.group_names`; a name that is given is right.
        """
        return group_name(self.group)

    @cached_property
    def surface_name(self) -> str | None:
        """The name of the group of automorphisms of the surface.

        The whole group if the surface is hyperelliptic, otherwise the quotient by −1; None if
        that is not known, or has no name.
        """
        if self.hyperelliptic is None:
            return None
        if self.hyperelliptic:
            return self.name
        minus = next(k for k, gamma in enumerate(self.elements) if not (gamma + self[0]).any())
        return group_name(self.group.quotient_by(minus))

    @property
    def surface_orders(self) -> tuple[int, ...]:
        """The possible orders of the group of automorphisms of the surface.

        One number if it is known whether the surface is hyperelliptic, otherwise the order of a
        surface that is not, and of one that is.  For g = 1 automorphisms fix a point.
        """
        if self.hyperelliptic is None:
            return self.order // 2, self.order
        return (self.order if self.hyperelliptic else self.order // 2,)

    @property
    def real_structures(self) -> list[Ints]:
        """The orientation-reversing σ with σ² = 1; −σ with every σ."""
        identity = np.eye(len(self.elements[0]), dtype=np.int64)
        return [sigma for sigma in self.reversing if np.array_equal(sigma @ sigma, identity)]

    @cached_property
    def generators(self) -> list[Ints]:
        """Few elements that generate the group.

        Raises
        ------
        ValueError
            If the elements are not a group: under a large tolerance, transformations that only
            nearly fix Π need not compose.
        """
        members = {gamma.tobytes() for gamma in self.elements}
        chosen: list[Ints] = []
        generated = _closure(chosen, self.elements[0], members)
        for gamma in sorted(self.elements, key=_multiplicative_order, reverse=True):
            if gamma.tobytes() not in generated:
                chosen.append(gamma)
                generated = _closure(chosen, self.elements[0], members)
        return chosen


def symplectic_automorphism_group(
    Pi: ArrayLike | PointInBalls, tolerance: float | None = None
) -> SymplecticGroup:
    """Find all γ in Sp(2g, Z) with γ · Π = Π, and the symmetries that reverse the orientation.

    Parameters
    ----------
    Pi : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat
    tolerance : float, optional
        As in :func:`~igl_periods.symplectic_isomorphisms`.  If it comes from a
        certificate, or Π is known in balls, all symmetries of the polyhedral surface are among
        the elements.

    Raises
    ------
    NotASiegelPointError, ValueError
        As :func:`~igl_periods.symplectic_isomorphisms`.
    RuntimeError
        If the search had to be given up.

    Examples
    --------
    >>> group = symplectic_automorphism_group([[1j]])
    >>> group.order, len(group.reversing), len(group.real_structures)
    (4, 4, 4)
    >>> [gamma.tolist() for gamma in group.generators]
    [[[0, 1], [-1, 0]]]
    """
    elements = symplectic_isomorphisms(Pi, Pi, tolerance)
    reversing = symplectic_isomorphisms(Pi, Pi, tolerance, reversing=True)
    certified = getattr(Pi, "bound", 0.0) is not None
    return SymplecticGroup(
        elements, reversing, is_hyperelliptic(Pi if certified else np.asarray(Pi))
    )


def _closure(generators: list[Ints], identity: Ints, members: set[bytes]) -> set[bytes]:
    """The group generated, as long as it stays among the members."""
    reached = {identity.tobytes()}
    frontier = [identity]
    while frontier:
        products = [gamma @ generator for gamma in frontier for generator in generators]
        frontier = []
        for gamma in products:
            key = gamma.tobytes()
            if key not in members:
                raise ValueError(
                    f"the {len(members)} transformations do not form a group: the tolerance is so "
                    "large that some of them only nearly fix the period matrix"
                )
            if key not in reached:
                reached.add(key)
                frontier.append(gamma)
    return reached


def _multiplicative_order(gamma: Ints) -> int:
    """The least n with γⁿ = 1; 0 if γ has infinite order."""
    power, identity = gamma, np.eye(len(gamma), dtype=np.int64)
    for n in range(1, _LARGEST_ORDER + 1):
        if np.array_equal(power, identity):
            return n
        power = power @ gamma
    return 0
