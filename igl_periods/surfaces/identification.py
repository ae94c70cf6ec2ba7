r"""Which named surface is it?

Period matrices are compared with those of the catalogue up to Sp(2g, Z), by Siegel's distance and
by the *deviation* max \|log λ\|, λ the eigenvalues of D₁⁻¹ D₂, which is a distance too.  A period
matrix with the certificate ``bound`` is known within the deviation t = log(1 + bound), and

* if no γ in Sp(2g, Z) brings an exact matrix within t, then the polyhedral surface is *proved* to
  be another one;
* if one does, nothing is proved: close is not equal.

Of a period matrix that is known in balls nothing is tolerated: it is compared in balls with exact
matrices in balls, which have as many digits.  If they do not overlap, under any γ, that is a proof;
if they do, they are consistent to a number of digits, and still not proved to be equal.

A mesh of a smooth surface is another surface.  How far the two may be apart no period matrix tells;
it has to be stated, as a deviation.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 4.3, where the Lawson
surface ξ_{2,1} was recognised in this way.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import singledispatch
from numbers import Real
from typing import Any, overload

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Ints, ReadOnlyArrays
from igl_periods.complexes import SurfaceLike, as_complex, is_array_like
from igl_periods.display import facts_html
from igl_periods.moduli import (
    ARRAY_TOLERANCE,
    LARGEST_TOLERANCE,
    Isomorphisms,
    logarithms_found,
    reduced_balls,
    symplectic_isomorphisms,
)
from igl_periods.options import checked_number
from igl_periods.siegel import PointInBalls, balls_of, bits_of, check_siegel_point

from .named_surface import NamedSurface
from .named_surfaces import catalogue

# Surfaces up to this deviation (beyond the certificate) are listed where no mesh error is stated.
_NEIGHBOURHOOD = 0.1
_LARGEST_RADIUS = 0.999 * LARGEST_TOLERANCE
_EXACT_ERROR = 1e-12
# Exact matrices are computed with so many digits more than Π has.
_DIGITS_PER_BIT, _MORE_DIGITS = math.log10(2.0), 10


@dataclass(frozen=True, eq=False)
class Match(ReadOnlyArrays):
    r"""A named surface near a period matrix Π.

    Attributes
    ----------
    surface : NamedSurface
    distance : float
        Siegel's distance of γ · Π and the exact matrix, the least over Sp(2g, Z).
    deviation : float
        The least, over Sp(2g, Z), of the largest \|log λ\|.
    gamma : (2g, 2g) int
        γ · Π is close to ``surface.matrix``.
    claim : str
        What may be said, in words.
    digits : int or None
        Where Π is known in balls, and consistent with the surface: to how many digits.
    """

    surface: NamedSurface
    distance: float
    deviation: float
    gamma: Ints
    claim: str
    digits: int | None = None

    def __repr__(self) -> str:
        return f"Match({self.surface.name}: {self.claim})"

    def _repr_html_(self) -> str:
        return facts_html("Match", [(self.surface.name, self.claim)])


@dataclass(frozen=True, eq=False)
class Identification(Sequence[Match]):
    """The named surfaces near a period matrix, nearest first.

    Attributes
    ----------
    matches : tuple of Match
    genus : int
    compared : tuple of str
        Names of all surfaces that were compared.
    undecided : tuple of str
        Those for which the search was given up.
    radius : float
        The deviation up to which surfaces are listed.

    Examples
    --------
    >>> import igl_periods as ip
    >>> found = ip.identify([[1j]])
    >>> [match.surface.name for match in found]
    ['square torus']
    """

    matches: tuple[Match, ...]
    genus: int
    compared: tuple[str, ...]
    undecided: tuple[str, ...]
    radius: float

    def __len__(self) -> int:
        return len(self.matches)

    @overload
    def __getitem__(self, index: int) -> Match: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[Match, ...]: ...
    def __getitem__(self, index: int | slice) -> Match | tuple[Match, ...]:
        return self.matches[index]

    def __repr__(self) -> str:
        names = ", ".join(match.surface.name for match in self.matches) or "none"
        undecided = f"; {len(self.undecided)} undecided" if self.undecided else ""
        return (
            f"Identification({names} of {len(self.compared)} surfaces of genus {self.genus}"
            f"{undecided})"
        )

    def _repr_html_(self) -> str:
        rows = [line.partition(": ")[::2] for line in str(self).splitlines()]
        return facts_html(f"Named surfaces of genus {self.genus} near Π", rows)

    def __str__(self) -> str:
        lines = [f"{match.surface.name}: {match.claim}" for match in self.matches]
        n_decided = len(self.compared) - len(self.undecided)
        if not lines and n_decided:
            lines = [
                f"none of {n_decided} named surfaces of genus {self.genus} is within "
                f"{self.radius:.2g}"
            ]
        lines += [f"{name}: undecided, the search was given up" for name in self.undecided]
        return "\n".join(lines)


@singledispatch
def matrix_of(surface: Any) -> Any:
    """The period matrix of a complex, as the package that computes such matrices registers it."""
    raise NotImplementedError(f"no period matrix of {type(surface).__name__} is computed here")


@overload
def identify(
    Pi: ArrayLike | PointInBalls | SurfaceLike, *, tolerance: float | None = None
) -> Identification: ...
@overload
def identify(Pi: ArrayLike | SurfaceLike, tolerance: float | None, /) -> Identification: ...
@overload
def identify(V: ArrayLike, F: ArrayLike, /, tolerance: float | None = None) -> Identification: ...
def identify(Pi: Any, F: Any = None, tolerance: float | None = None) -> Identification:
    """Find the named surfaces whose exact period matrices are near Π.

    Called as ``identify(Pi, tolerance)``, ``identify(surface, tolerance)`` or
    ``identify(V, F, tolerance)``.

    Parameters
    ----------
    Pi : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat, or surface
        With a certificate, Π is known within log(1 + bound); a plain array is taken to be right to
        1e-8; balls are compared in balls.  Of a surface
        (:func:`~igl_periods.complexes.as_complex`) the period matrix is computed, of degree 1.
    F : (m, 3) array-like of int, optional
        The triangles, where ``Pi`` is V.
    tolerance : float, optional
        How far the polyhedral surface may be from the surface that is meant (the error of the
        mesh), as a deviation.  If it is not stated, claims are about the polyhedral surface only.
        Surfaces within 0.1 beyond the certificate are listed anyway.

    Returns
    -------
    Identification

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.
    ValueError
        If the tolerance is negative, or with the certificate's too large to separate anything.

    Examples
    --------
    >>> print(identify([[-0.5 + 0.5j]]))  # doctest: +ELLIPSIS
    square torus: within 0: consistent with the accuracy of the array (1e-08); ...
    """
    if tolerance is None and isinstance(F, Real):
        F, tolerance = None, F
    if F is not None or not (is_array_like(Pi) or balls_of(Pi) is not None):
        Pi = matrix_of(as_complex(Pi, F))
    matrix = check_siegel_point(Pi)
    if tolerance is not None:
        tolerance = checked_number("the tolerance", tolerance)
        if not tolerance >= 0:
            raise ValueError(f"the tolerance must not be negative, but it is {tolerance}")
    known = _Knowledge.of(Pi, tolerance)
    surfaces = catalogue(len(matrix))
    matches, undecided = [], []
    for surface in surfaces:
        found = symplectic_isomorphisms(Pi, surface.matrix, known.radius)
        if not found.complete:
            undecided.append(surface.name)
        elif found:
            matches.append(_nearest(Pi, surface, found, known))
    matches.sort(key=lambda match: match.distance)
    names = tuple(surface.name for surface in surfaces)
    return Identification(tuple(matches), len(matrix), names, tuple(undecided), known.radius)


def _nearest(Pi: Any, surface: NamedSurface, found: Sequence[Ints], known: _Knowledge) -> Match:
    exact = _exact_balls(Pi, surface)
    logarithms = logarithms_found(found, Pi, surface.matrix if exact is None else exact)
    distances = np.linalg.norm(logarithms, axis=1)
    nearest, distance = int(np.argmin(distances)), float(distances.min())
    deviation = float(np.max(logarithms, axis=1).min())
    if exact is None:
        return Match(surface, distance, deviation, found[nearest], known.claim(distance, deviation))
    in_balls = symplectic_isomorphisms(Pi, exact)
    claim = known.claim_in_balls(distance, deviation, in_balls)
    return Match(surface, distance, deviation, found[nearest], claim, in_balls.digits)


def _exact_balls(Pi: Any, surface: NamedSurface) -> flint.acb_mat | None:
    """The exact matrix with more digits than Π has, if Π is known in balls and there is one."""
    if balls_of(Pi) is None:
        return None
    return surface.matrix_in_balls(int(bits_of(Pi) * _DIGITS_PER_BIT) + _MORE_DIGITS)


@dataclass(frozen=True)
class _Knowledge:
    """What is known about Π: its deviation from the polyhedral surface, and that of the mesh."""

    own: float | None
    certified: bool
    mesh: float | None
    radius: float

    @classmethod
    def of(cls, Pi: ArrayLike, mesh: float | None) -> _Knowledge:
        own: float | None = ARRAY_TOLERANCE
        certified = balls_of(Pi) is not None or getattr(Pi, "bound", None) is not None
        if balls_of(Pi) is not None:
            reduced = reduced_balls(Pi)
            own = math.log1p(reduced.genus * reduced.relative_radius()) + _EXACT_ERROR
        elif hasattr(Pi, "bound"):
            own = math.log1p(Pi.bound) + _EXACT_ERROR if certified else None
        stated = (own or 0.0) + (mesh or 0.0)
        shown = min((own or 0.0) + _NEIGHBOURHOOD, _LARGEST_RADIUS)
        return cls(own, certified, mesh, max(stated, shown))

    def claim(self, distance: float, deviation: float) -> str:
        return f"within {distance:.2g}: {self._judgement(deviation)}"

    def claim_in_balls(self, distance: float, deviation: float, found: Isomorphisms) -> str:
        """The same, where Π and the exact matrix were compared in balls."""
        if not found.complete:
            judged = f"undecided in balls, the search was given up ({found.gave_up})"
        elif found:
            judged = f"consistent to {found.digits} digits, in balls; this does not prove it"
        else:
            judged = self._another(deviation, "in balls, the polyhedral surface is proved to be")
        return f"within {distance:.2g}: {judged}"

    def _judgement(self, deviation: float) -> str:
        if self.own is not None and deviation <= self.own:
            what = "the certificate" if self.certified else "the accuracy of the array"
            return f"consistent with {what} ({self.own:.2g}); this does not prove it"
        return self._another(
            deviation, "the polyhedral surface is proved to be" if self.certified else ""
        )

    def _another(self, deviation: float, proved: str) -> str:
        """What is said of a surface that Π is not consistent with."""
        other = f"{proved} another one" if proved else ""
        if self.mesh is None:
            return other or "near; no error of the mesh is stated"
        consistent = deviation <= (self.own or 0.0) + self.mesh
        judgement = (
            f"{'consistent' if consistent else 'not consistent'} with the stated error of the mesh "
            f"({self.mesh:.2g}){'; this does not prove it' if consistent else ''}"
        )
        return f"{judgement}; {other}" if other else judgement
