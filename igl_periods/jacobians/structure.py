"""The algebra of endomorphisms as a product of matrix rings over division algebras."""

from __future__ import annotations

from dataclasses import dataclass

from igl_periods.arrays import Ints

from .division_algebras import SimpleAlgebra, simple_algebra
from .splitting import restricted_lattice
from .subvarieties import Subvariety

_SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")


@dataclass(frozen=True)
class AlgebraComponent:
    """M_n(D): what acts on an isotypic part B^n.

    Attributes
    ----------
    division : SimpleAlgebra
        D, which acts on B.
    size : int
        n.
    dimension : int
        The dimension of B.
    """

    division: SimpleAlgebra
    size: int
    dimension: int

    @property
    def rank(self) -> int:
        """The dimension n² dim D over the rational numbers."""
        return self.size**2 * self.division.dimension

    @property
    def has_complex_multiplication(self) -> bool:
        """Whether D is a CM field of degree 2 dim B, or contains one by its dimension."""
        algebra = self.division
        if algebra.centre is None:
            return False
        index = round((algebra.dimension / algebra.centre.degree) ** 0.5)
        return index * algebra.centre.degree == 2 * self.dimension

    @property
    def name(self) -> str:
        """Such as ``M₂(Q)``."""
        if self.size == 1:
            return self.division.name
        return f"M{str(self.size).translate(_SUBSCRIPTS)}({self.division.name})"


@dataclass(frozen=True)
class AlgebraType:
    """A product of matrix rings over division algebras.

    Attributes
    ----------
    components : tuple of AlgebraComponent
    """

    components: tuple[AlgebraComponent, ...]

    @property
    def rank(self) -> int:
        """The dimension over the rational numbers."""
        return sum(component.rank for component in self.components)

    @property
    def name(self) -> str:
        """Such as ``M₂(Q) × Q(i)``."""
        return " × ".join(component.name for component in self.components)

    @property
    def has_complex_multiplication(self) -> bool:
        """Whether every component has."""
        return all(component.has_complex_multiplication for component in self.components)


def algebra_type(classes: list[list[Subvariety]], matrices: Ints) -> AlgebraType:
    """Name the algebra of endomorphisms of a Jacobian from its simple parts."""
    return AlgebraType(
        tuple(
            AlgebraComponent(
                simple_algebra(restricted_lattice(parts[0], matrices)),
                len(parts),
                parts[0].dimension,
            )
            for parts in classes
        )
    )
