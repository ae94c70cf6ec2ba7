"""A surface with a name, and its exact period matrix in some marking."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import flint

from igl_periods.arrays import Complexes, ReadOnlyArrays
from igl_periods.display import facts_html, matrix_html
from igl_periods.options import checked_integer
from igl_periods.siegel import check_siegel_point

_BITS_PER_DIGIT = math.log2(10.0)
_LEAST_BITS, _GUARD_BITS = 64, 32


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
    _balls: Callable[[], flint.acb_mat] | None = None

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

    def matrix_in_balls(self, digits: int = 30) -> flint.acb_mat | None:
        """Balls that contain the exact entries, in the marking of ``matrix``.

        Parameters
        ----------
        digits : int
            Decimal digits that are computed with; all but the last few are right.

        Returns
        -------
        (g, g) acb_mat or None
            None where there is no formula, and ``matrix`` is known in double precision only.

        Raises
        ------
        ValueError
            If ``digits`` is not an integer, or less than 1.

        Examples
        --------
        >>> from igl_periods import catalogue
        >>> print(catalogue(1)[1].matrix_in_balls(20)[0, 0].imag.str(18, radius=False))
        0.866025403784438647
        """
        digits = checked_integer("digits", digits)
        if digits < 1:
            raise ValueError(f"digits = {digits}: at least one is wanted.")
        if self._balls is None:
            return None
        with flint.ctx.workprec(
            max(_LEAST_BITS, math.ceil(digits * _BITS_PER_DIGIT) + _GUARD_BITS)
        ):
            return self._balls()
