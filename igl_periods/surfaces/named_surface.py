"""A surface with a name, and its exact period matrix in some marking."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from igl_periods.arrays import Complexes, ReadOnlyArrays
from igl_periods.display import facts_html, matrix_html
from igl_periods.siegel import check_siegel_point


@dataclass(frozen=True, eq=False)
class NamedSurface(ReadOnlyArrays):
    """A Riemann surface with an exact period matrix.

    Attributes
    ----------
    name : str
    aliases : tuple of str
        Other names of the same Riemann surface.
    genus : int
    source : str
        Where the period matrix comes from.
    """

    name: str
    aliases: tuple[str, ...]
    genus: int
    source: str
    _exact: Callable[[], Complexes]

    def __repr__(self) -> str:
        return f"NamedSurface({self.name}, genus {self.genus})"

    def _repr_html_(self) -> str:
        names = ", ".join(self.aliases) or "none"
        facts = [("genus", self.genus), ("other names", names), ("source", self.source)]
        return facts_html(self.name, facts, matrix_html(self.matrix, None))

    @cached_property
    def matrix(self) -> Complexes:
        """The period matrix, in some marking; (g, g) complex."""
        matrix = check_siegel_point(self._exact())
        matrix.flags.writeable = False
        return matrix
