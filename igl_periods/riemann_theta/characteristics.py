r"""Characteristics as spin structures.

In a marking a_1..a_g, b_1..b_g the characteristic (a, b) is the quadratic form on H₁(Z/2)

.. math:: q\Big(\sum_i p_i\, a_i + q_i\, b_i\Big) = p \cdot q + a \cdot p + b \cdot q \pmod 2,

whose Arf invariant is a·b.  On a torus the odd one, (1, 1), is that of dz, and q of a simple closed
curve is 1 plus its number of turns as seen by dz.  Another marking, γ = [[A, B], [C, D]], gives the
same spin structure the characteristic

.. math:: a' = D a - C b + \mathrm{diag}(C D^T), \qquad b' = -B a + A b + \mathrm{diag}(A B^T),

and :math:`|\theta_{a',b'}(\gamma\Pi)| = |\det(C\Pi + D)|^{1/2} |\theta_{a,b}(\Pi)|`.

References
----------
Igusa, "Theta functions" (1972), section V.1.
Johnson, "Spin structures and quadratic forms on surfaces" (1980).
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Ints
from igl_periods.options import checked_integer
from igl_periods.siegel import check_symplectic

# There are 4^g of them.
_LARGEST_GENUS = 10


@dataclass(frozen=True, order=True)
class SpinStructure:
    """A spin structure in the marking of a surface, by its theta characteristic.

    Attributes
    ----------
    a, b : tuple of int
        g digits 0 or 1 each: the characteristic is (a/2, b/2).

    Examples
    --------
    >>> import igl_periods as ip
    >>> s = ip.SpinStructure((0, 1), (1, 1))
    >>> s.is_even
    False
    """

    a: tuple[int, ...]
    b: tuple[int, ...]

    def __post_init__(self) -> None:
        if len(self.a) != len(self.b) or not {*self.a, *self.b} <= {0, 1}:
            raise ValueError(f"a spin structure has g digits 0 or 1 twice, not {self.a}, {self.b}")

    @property
    def genus(self) -> int:
        """The genus g."""
        return len(self.a)

    @property
    def arf(self) -> int:
        """The Arf invariant, a·b mod 2: 0 of even spin structures, 1 of odd ones."""
        return sum(x * y for x, y in zip(self.a, self.b, strict=True)) % 2

    @property
    def is_even(self) -> bool:
        """Whether θ_{a,b} is an even function of z."""
        return self.arf == 0

    def __call__(self, cycle: ArrayLike) -> int:
        """The quadratic form q of a cycle Σ p_i a_i + q_i b_i.

        Parameters
        ----------
        cycle : (2g,) array-like of int
            p_1..p_g, q_1..q_g.

        Raises
        ------
        ValueError
            If there is another number of coefficients, or they are not integers.
        """
        x = np.asarray(cycle)
        if x.shape != (2 * self.genus,) or x.dtype.kind not in "iu":
            raise ValueError(f"a cycle has {2 * self.genus} integer coefficients, not {cycle!r}")
        p, q = np.split(x, 2)
        return int(p @ q + np.dot(self.a, p) + np.dot(self.b, q)) % 2

    def __add__(self, other: SpinStructure) -> tuple[int, ...]:
        """The point of order two by which two spin structures differ, 2g digits 0 or 1."""
        pairs = zip(self.a + self.b, other.a + other.b, strict=True)
        return tuple((x + y) % 2 for x, y in pairs)

    def moved(self, gamma: ArrayLike) -> SpinStructure:
        """The same spin structure in the marking of γ·Π.

        Parameters
        ----------
        gamma : (2g, 2g) int
            [[A, B], [C, D]] in Sp(2g, Z).

        Raises
        ------
        ValueError
            If gamma is not an integer symplectic matrix of this size.
        """
        g, matrix = self.genus, check_symplectic(gamma, self.genus)
        A, B, C, D = matrix[:g, :g], matrix[:g, g:], matrix[g:, :g], matrix[g:, g:]
        a, b = np.array(self.a, dtype=np.int64), np.array(self.b, dtype=np.int64)
        new_a = D @ a - C @ b + np.diag(C @ D.T)
        new_b = -B @ a + A @ b + np.diag(A @ B.T)
        return SpinStructure(_digits(new_a), _digits(new_b))


def spin_structures(genus: int, parity: str | None = None) -> list[SpinStructure]:
    """The 4^g spin structures of a surface, in binary order of (a, b).

    Parameters
    ----------
    genus : int
    parity : {"even", "odd"}, optional
        Only those.

    Raises
    ------
    ValueError
        If the genus is negative or larger than 10, or the parity is another word.

    Examples
    --------
    >>> len(spin_structures(3, "odd"))  # bitangents of a plane quartic
    28
    """
    g = checked_integer("genus", genus)
    if not 0 <= g <= _LARGEST_GENUS:
        raise ValueError(f"genus = {g}: spin structures are listed for genus 0 to {_LARGEST_GENUS}")
    if parity not in (None, "even", "odd"):
        raise ValueError(f"the parity is 'even' or 'odd', not {parity!r}")
    digits = list(product((0, 1), repeat=g))
    found = [SpinStructure(a, b) for a, b in product(digits, digits)]
    return [s for s in found if parity is None or s.is_even == (parity == "even")]


def twice_characteristic(characteristic: Any, genus: int) -> tuple[list[int], list[int]]:
    """2a and 2b of a characteristic (a, b) in (½ Z)^{2g}, however it is written.

    Raises
    ------
    ValueError
        If it is not a pair of g half integers each.
    """
    if characteristic is None:
        return [0] * genus, [0] * genus
    if isinstance(characteristic, SpinStructure):
        characteristic = (characteristic.a, characteristic.b)
    try:
        halves = [[Fraction(x) for x in part] for part in characteristic]
    except (TypeError, ValueError) as error:
        raise ValueError(f"this is not a characteristic (a, b): {characteristic!r}") from error
    if len(halves) == 1 or {len(part) for part in halves} != {genus} or len(halves) != 2:
        raise ValueError(
            f"a characteristic of genus {genus} is a pair of {genus} numbers each, not "
            f"{characteristic!r}"
        )
    if all(x.denominator == 1 for part in halves for x in part):
        return [int(x) for x in halves[0]], [int(x) for x in halves[1]]
    doubled = [[2 * x for x in part] for part in halves]
    if any(x.denominator != 1 for part in doubled for x in part):
        raise ValueError(f"a characteristic has entries in ½ Z, not {characteristic!r}")
    return [int(x) for x in doubled[0]], [int(x) for x in doubled[1]]


def _digits(vector: Ints) -> tuple[int, ...]:
    return tuple(int(x) for x in vector % 2)
