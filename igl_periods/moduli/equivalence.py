r"""When do two period matrices belong to the same Riemann surface?

By Torelli's theorem they do iff an element of Sp(2g, Z) takes one to the other.  In terms of the
Dirichlet matrices G₁, G₂ that is an isometry of lattices: an integer U with

.. math:: U G_1 U^T = G_2, \qquad U J U^T = J,

and those can be found (:mod:`igl_periods.moduli.lattice_isometries`).

**Tolerance.**  Let G₁, G₂ be the symplectic means of discrete Dirichlet matrices, c₁, c₂ their
largest symplectic eigenvalues and c = c₁c₂.  If the polyhedral surfaces are equivalent, then there
is a U with

.. math:: c^{-1} G_2 \le U G_1 U^T \le c\, G_2, \qquad\text{hence}\qquad
          |U G_1 U^T - G_2|_{ij} \le (c - 1) \sqrt{G_{2,ii}\, G_{2,jj}} .

All U under the first inequality are enumerated, by way of the second; where there is none, the
surfaces are *proved* to be different.  A tolerance t stands for c = e^t, so that it bounds all
|log λ|, λ the eigenvalues of (U G₁ Uᵀ)⁻¹ G₂, and is itself at most Siegel's distance.

An integer U with U J Uᵀ = −J reverses the orientation.

**Balls.**  Where the matrices are known in balls, nothing is tolerated: all U are enumerated for
which U G₁ Uᵀ and G₂ overlap (:mod:`~igl_periods.moduli.isometries_in_balls`), at the precision of
the balls.  None is a proof that the surfaces differ.  One that is found proves that the matrices
agree to the digits that are known, and no number of digits proves them equal.

References
----------
Plesken, Souvignier, "Computing isometries of lattices" (1997).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.display import counted, facts_html, integer_lines, lines_html
from igl_periods.errors import EnumerationLimitError
from igl_periods.options import checked_integer, checked_number, checked_switch
from igl_periods.siegel import (
    PointInBalls,
    balls_of,
    check_same_genus,
    check_siegel_point,
    log_eigenvalues,
    siegel_reduce,
    siegel_transform,
)
from igl_periods.symplectic import energy_matrix, form_action, product, unimodular_inverse

from .balls_in_comparison import ReducedBalls, agreeing_digits, in_balls, reduced_balls
from .isometries_in_balls import ball_isometries
from .lattice_isometries import isometries

# What a plain array is taken to be right to, and the largest tolerance: with lengths uncertain by
# a factor 2 the zero vector could be the image of a basis vector.
ARRAY_TOLERANCE = 1e-8
LARGEST_TOLERANCE = math.log(2.0)
# How far energies of midpoints are off that are rounded to double precision, with much to spare.
_ROUNDED_MIDPOINT = 1e-12


class Isomorphisms(list[Ints]):
    """A list of modular transformations, and what it proves.

    Attributes
    ----------
    tolerance : float
        The t of the search: all γ were looked for for which the eigenvalues λ of
        D(γ·Π₁)⁻¹ D(Π₂) lie between e^{−t} and e^t.  Of a search in balls: how large they are,
        relative to the energies; nothing depends on it.
    certified : bool
        Whether t comes from the certificates of two polyhedral surfaces, or the search was one in
        balls that contain the exact matrices.  If so, an equivalence of the two surfaces is in the
        list, and an empty list proves that there is none.
    in_balls : bool
        Whether all was decided in balls, without a tolerance.
    digits : int or None
        Of a search in balls that found something: every γ · Π₁ in the list agrees with Π₂ to so
        many digits, relative to √(Y_ii Y_jj); that is proved where the matrices are certified.
    complete : bool
        Whether the search came to its end: neither the limit that was asked for nor the work
        limit stopped it.  Nothing follows from what is not in an incomplete list.
    gave_up : str
        Which work limit stopped the search; empty if none did.

    Examples
    --------
    >>> import igl_periods as ip
    >>> found = ip.symplectic_isomorphisms([[1j]], [[1j]], 1e-9)
    >>> len(found), found.complete
    (4, True)
    """

    def __init__(self, tolerance: float, certified: bool) -> None:
        super().__init__()
        self.tolerance = tolerance
        self.certified = certified
        self.complete = False
        self.gave_up = ""
        self.in_balls = False
        self.digits: int | None = None

    def __repr__(self) -> str:
        return f"Isomorphisms({self.verdict})"

    def _repr_html_(self) -> str:
        facts = [
            ("verdict", self.verdict),
            ("decided", "in balls") if self.in_balls else ("tolerance", self._tolerance()),
            ("search", "complete" if self.complete else "stopped"),
        ]
        first = [lines_html("the first γ", integer_lines(self[0]))] if 0 < len(self) else []
        return facts_html("Isomorphisms", facts, *first)

    @property
    def verdict(self) -> str:
        """What the search shows, in words."""
        if self.gave_up:
            return f"undecided: the search was given up ({self.gave_up})"
        if self:
            stopped = "" if self.complete else ", and there may be more"
            if self.in_balls:
                return f"{self._agreement()}{stopped}"
            found = counted(len(self), "transformation", "transformations")
            return f"{found} within {self.tolerance:.3g}{stopped}"
        if not self.complete:
            return "undecided: the search was stopped before it found a transformation"
        if self.certified and self.in_balls:
            return "proved in balls: the two surfaces are not conformally equivalent"
        if self.certified:
            return "proved: the two polyhedral surfaces are not conformally equivalent"
        return f"no transformation within {self.tolerance:.3g}"

    def _agreement(self) -> str:
        return (
            f"{len(self)} transformations, after each of which the balls overlap: consistent to "
            f"{self.digits} digits, which does not prove equality"
        )

    def _tolerance(self) -> str:
        return f"{self.tolerance:.3g}{', certified' * self.certified}"

    def __reduce__(self) -> tuple[Any, ...]:
        return Isomorphisms, (self.tolerance, self.certified), self.__dict__, iter(self)


def symplectic_isomorphisms(
    Pi1: ArrayLike | PointInBalls,
    Pi2: ArrayLike | PointInBalls,
    tolerance: float | None = None,
    reversing: bool = False,
    limit: int | None = None,
) -> Isomorphisms:
    """Find every γ in Sp(2g, Z) with γ · Π₁ = Π₂, up to a tolerance.

    Parameters
    ----------
    Pi1, Pi2 : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat
        If one of them is known in balls, no tolerance is given, and the other one is no
        ``PeriodMatrix``, everything is decided in balls.
    tolerance : float, optional
        A t, 0 < t < log 2, see above.  If it is not given it follows from the certificates of the
        arguments; a plain array is taken to be right to 1e-8.
    reversing : bool
        Search for the transformations that reverse the orientation instead: integer γ with
        γ J γᵀ = −J and (a Π̄₁ + b)(c Π̄₁ + d)⁻¹ = Π₂.
    limit : int, optional
        Stop after so many.

    Returns
    -------
    Isomorphisms
        A list of (2g, 2g) int arrays that knows whether it is complete and what it proves; the
        ones with small entries first.

    Raises
    ------
    NotASiegelPointError
        If an argument is not a point of the Siegel upper half-space.
    ValueError
        If the genera differ, the tolerance is not positive or too large to separate anything, or
        there is no tolerance: an uncertified PeriodMatrix has none.  If an option has no such
        value.

    Examples
    --------
    >>> [gamma.tolist() for gamma in symplectic_isomorphisms([[2j]], [[0.5j]])]
    [[[0, 1], [-1, 0]], [[0, -1], [1, 0]]]
    """
    genus = len(check_same_genus(Pi1, Pi2)[0])
    limit, reversing = _checked_limit(limit), checked_switch("reversing", reversing)
    if tolerance is None and in_balls(Pi1, Pi2):
        found = _found_in_balls(reduced_balls(Pi1), reduced_balls(Pi2), reversing, limit)
    else:
        found = Isomorphisms(*_checked_tolerance(Pi1, Pi2, tolerance))
        _search((Pi1, Pi2), found, reversing, limit)
    if reversing:
        # γ = γ' K, where γ' takes −Π̄₁ to Π₂ and K = diag(1, −1).
        found[:] = [gamma * np.repeat([1, -1], genus) for gamma in found]
    found.sort(key=_simplest_first)
    return found


def moduli_distance(
    Pi1: ArrayLike | PointInBalls, Pi2: ArrayLike | PointInBalls, tolerance: float
) -> float:
    """Siegel's distance in moduli space: the least of γ · Π₁ and Π₂ over all γ in Sp(2g, Z).

    Parameters
    ----------
    Pi1, Pi2 : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat
        Of what is known in balls, the midpoints with all of their digits.
    tolerance : float
        Only the γ under this tolerance are compared, as in :func:`symplectic_isomorphisms`.

    Returns
    -------
    float
        The distance, if it is at most the tolerance.  A larger value means that the distance
        exceeds the tolerance; ∞ that there is no γ under it at all.

    Raises
    ------
    RuntimeError
        If the search had to be given up.
    NotASiegelPointError, ValueError
        As :func:`symplectic_isomorphisms`.

    Examples
    --------
    >>> round(moduli_distance([[2j]], [[7 + 0.499j]], tolerance=0.1), 6)  # log(1 / 0.998)
    0.002002
    """
    found = symplectic_isomorphisms(Pi1, Pi2, tolerance)
    if not found.complete:
        raise EnumerationLimitError(found.gave_up)
    logarithms = logarithms_found(found, Pi1, Pi2)
    return float(np.linalg.norm(logarithms, axis=1).min(initial=math.inf))


def logarithms_found(
    found: Sequence[Ints], Pi1: ArrayLike | PointInBalls, Pi2: ArrayLike | PointInBalls
) -> Floats:
    """The log λ_i of γ · Π₁ and Π₂ for each γ that was found; (len(found), g)."""
    # Measured where Π₂ is reduced, so that no digits are lost.
    target: Any
    target, gamma2 = siegel_reduce(Pi2)
    moved = [siegel_transform(product(gamma2, gamma), Pi1) for gamma in found]
    genus = len(gamma2) // 2
    return np.array([log_eigenvalues(Pi, target) for Pi in moved]).reshape(len(moved), genus)


def _checked_tolerance(Pi1: Any, Pi2: Any, tolerance: float | None) -> tuple[float, bool]:
    """The tolerance t, and whether it comes from two certificates."""
    certified = tolerance is None and all(hasattr(Pi, "bound") for Pi in (Pi1, Pi2))
    if tolerance is None:
        t = sum(_log_bound(Pi) for Pi in (Pi1, Pi2)) + float(np.finfo(np.float64).eps)
    else:
        t = checked_number("the tolerance", tolerance)
    if not t > 0:
        raise ValueError(f"the tolerance must be a positive number, not {tolerance}")
    if t >= LARGEST_TOLERANCE:
        raise ValueError(
            f"a tolerance of {t!r} is too large to separate anything: it must be less than "
            f"log 2 = {LARGEST_TOLERANCE!r}. Where it comes from certificates, refine the mesh "
            "or raise the degree."
        )
    return t, certified


def _checked_limit(limit: int | None) -> int | None:
    if limit is None:
        return None
    number = checked_integer("limit", limit)
    if number < 0:
        raise ValueError(f"limit = {number}: a number of transformations is not negative.")
    return number


def _log_bound(Pi: Any) -> float:
    """The logarithm of the factor by which lengths may be wrong."""
    if not hasattr(Pi, "bound"):
        return ARRAY_TOLERANCE
    if Pi.bound is None:
        raise ValueError("a period matrix without a certificate: state a tolerance yourself")
    # Midpoints of balls are rounded to double precision.
    rounded = 0.0 if balls_of(Pi) is None else _ROUNDED_MIDPOINT
    return math.log1p(float(Pi.bound)) + rounded


def _simplest_first(gamma: Ints) -> tuple[int, list[int]]:
    return int(np.abs(gamma).sum()), (-gamma).ravel().tolist()


def _search(pair: tuple[Any, Any], found: Isomorphisms, reversing: bool, limit: int | None) -> None:
    """Search between reduced matrices and conjugate back."""
    (point1, gamma1), (point2, gamma2) = (_reduced_point(Pi) for Pi in pair)
    if len(point1) == 0:
        found.append(np.zeros((0, 0), dtype=np.int64))
        found.complete = True
        return
    if reversing:
        # γ · Π = Π' implies (K γ K) · (−Π̄) = −Π̄', K = diag(1, −1).
        point1, gamma1 = -point1.conj(), form_action(gamma1)
    candidates = isometries(energy_matrix(point1), energy_matrix(point2), found.tolerance)
    _collect(candidates, (gamma1, gamma2), found, limit)


def _reduced_point(Pi: Any) -> tuple[Complexes, Ints]:
    matrix, gamma = siegel_reduce(Pi)
    return check_siegel_point(matrix), gamma


def _found_in_balls(
    one: ReducedBalls, two: ReducedBalls, reversing: bool, limit: int | None
) -> Isomorphisms:
    """Search between reduced matrices of balls, the first reflected if orientation is reversed."""
    if reversing:
        one = one.reflected()
    found = Isomorphisms(one.relative_radius() + two.relative_radius(), one.proved and two.proved)
    found.in_balls = True
    if one.genus == 0:
        found.append(np.zeros((0, 0), dtype=np.int64))
        found.complete, found.digits = True, 0
        return found
    bits = max(one.bits, two.bits)
    with flint.ctx.workprec(bits):
        candidates = ball_isometries(one.energies(), two.energies())
        _collect(candidates, (one.gamma, two.gamma), found, limit)
    found.digits = agreeing_digits(one, two, found) if found else None
    return found


def _collect(
    candidates: Iterator[Ints], markings: tuple[Ints, Ints], found: Isomorphisms, limit: int | None
) -> None:
    """Append to the list what is found, as transformations between the given markings."""
    gamma1, gamma2 = markings
    back = unimodular_inverse(gamma2)
    try:
        for U in candidates:
            if limit is not None and len(found) >= limit:
                return
            found.append(product(back, product(form_action(U).astype(np.int64), gamma1)))
    except EnumerationLimitError as error:
        found.gave_up = str(error)
    else:
        found.complete = True
