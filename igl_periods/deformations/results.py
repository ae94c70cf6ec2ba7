"""What a deformation achieved, with its bound."""

from __future__ import annotations

import math
from dataclasses import dataclass

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex
from igl_periods.periods import PeriodMatrix


class DeformationWarning(UserWarning):
    """A target was not reached; the result is the surface nearest to it that was found."""


@dataclass(frozen=True)
class Step:
    """One step of the iteration.

    Attributes
    ----------
    distance : float
        Siegel distance to the target after it.
    strain : float
        The largest relative change of an edge, about.
    """

    distance: float
    strain: float


@dataclass(frozen=True, eq=False)
class Deformation:
    """A surface deformed towards a period matrix.

    Attributes
    ----------
    period_matrix : PeriodMatrix
        Of the deformed surface, in the marking of the given one, with its bound.
    target : (g, g) complex
        What was to be reached, in this marking.
    gamma : (2g, 2g) int
        The change of marking that made it of the target as it was given; 1 where that was kept.
    distance : float
        Siegel distance of ``period_matrix.matrix`` to the target.
    steps : tuple of Step
    verdict : str
        How it ended, in words; empty where the target was reached.

    Examples
    --------
    >>> import igl_periods as ip
    >>> found = ip.lengths_with(ip.surfaces.flat_torus(1j, 3), [[1.1j]])
    >>> found.reached, found.vertices is None
    (True, True)
    """

    period_matrix: PeriodMatrix
    target: Complexes
    gamma: Ints
    distance: float
    steps: tuple[Step, ...]
    verdict: str

    def __repr__(self) -> str:
        end = "reached" if self.reached else "not reached"
        return (
            f"Deformation: target {end}, Siegel distance {self.distance:.3g} after "
            f"{len(self.steps)} steps\n{self.period_matrix!r}"
        )

    @property
    def reached(self) -> bool:
        """Whether the distance is within the tolerance that was asked for."""
        return not self.verdict

    @property
    def complex(self) -> DeltaComplex:
        """The deformed surface."""
        return self.period_matrix.complex

    @property
    def vertices(self) -> Floats | None:
        """Its vertices (n, d); None where there are only lengths."""
        return self.complex.positions

    @property
    def certified_distance(self) -> float | None:
        """A bound of the Siegel distance of the exact matrix of the surface to the target.

        All |log λ| between the exact matrix and the computed one are at most log(1 + bound); None
        without a certificate.
        """
        bound = self.period_matrix.bound
        if bound is None:
            return None
        return self.distance + math.sqrt(len(self.target)) * math.log1p(bound)
