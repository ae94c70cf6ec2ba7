r"""Guessing exact entries of a period matrix: numbers (p + q √n) / r.

A real number y known to an error δ is a root of a quadratic polynomial with small integer
coefficients if the lattice spanned by

.. math:: (1, 0, 0, N y^2), \quad (0, 1, 0, N y), \quad (0, 0, 1, N), \qquad N = 1/\delta,

has a short vector (a, b, c, N (a y² + b y + c)); LLL finds it.  A shortest vector always exists, so
this proves nothing.  But the roots of the (2H + 1)³ polynomials of height H are spread over the
line, and about (2H + 1)³ δ of them come within δ of a given y by chance.  Where that number is not
small, no guess is made.

References
----------
Lenstra, Lenstra, Lovász, "Factoring polynomials with rational coefficients" (1982).
Cohen, "A course in computational algebraic number theory" (1993), section 2.7.2.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.recognition import reduced_relations, square_part
from igl_periods.siegel import check_siegel_point

# An expected number of coincidences above this is not evidence.
_LARGEST_COINCIDENCE = 1e-3
_ARRAY_ERROR = 1e-12
# Powers of doubles are exact, or nearly so, with this precision.
_BITS = 256


@dataclass(frozen=True)
class QuadraticGuess:
    """A guess that a number equals rational + root · √radicand.

    Attributes
    ----------
    rational, root : Fraction
    radicand : int
        Square-free, or 0 if the number is rational.
    error : float
        Distance of the guess from the number.
    coincidence : float
        Expected number of equally simple numbers that come as close by chance.
    """

    rational: Fraction
    root: Fraction
    radicand: int
    error: float
    coincidence: float

    def __float__(self) -> float:
        return float(self.rational) + float(self.root) * math.sqrt(self.radicand)

    def __str__(self) -> str:
        surd = f"{abs(self.root)}*sqrt({self.radicand})".removeprefix("1*")
        if not self.root:
            return str(self.rational)
        if not self.rational:
            return surd if self.root > 0 else f"-{surd}"
        return f"{self.rational} {'+' if self.root > 0 else '-'} {surd}"


def recognise_quadratic(y: float, error: float = _ARRAY_ERROR) -> QuadraticGuess | None:
    """Guess a rational number or a real quadratic irrational within an error.

    Parameters
    ----------
    y : float
    error : float
        How far y may be off, > 0.

    Returns
    -------
    QuadraticGuess or None
        None if nothing simple enough is near.

    Raises
    ------
    ValueError
        If y is not finite or the error is not positive.

    Examples
    --------
    >>> print(recognise_quadratic(-0.2 + 3**0.5 / 5))
    -1/5 + 1/5*sqrt(3)
    >>> print(recognise_quadratic(np.pi))
    None
    """
    if not (math.isfinite(y) and error > 0):
        raise ValueError(f"a finite number and a positive error are needed, not {y} and {error}")
    guesses = [
        guess for degree in (1, 2) if (guess := _guess(y, error, degree)) and guess.error <= error
    ]
    convincing = [guess for guess in guesses if guess.coincidence <= _LARGEST_COINCIDENCE]
    return min(convincing, key=lambda guess: guess.coincidence, default=None)


def recognise_entries(
    Pi: ArrayLike,
) -> list[list[tuple[QuadraticGuess | None, QuadraticGuess | None]]]:
    """Guess real and imaginary parts of all entries of a period matrix.

    Parameters
    ----------
    Pi : (g, g) array-like or PeriodMatrix
        Its error is that of the certificate; a plain array is taken to be right to 1e-12.

    Returns
    -------
    list of lists of (real part, imaginary part)
        Guesses, or None where there is none, independent of each other.  They are simplest in a
        reduced marking.

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.

    Examples
    --------
    >>> (entry,) = recognise_entries([[(-2 + 8**0.5 * 1j) / 3]])[0]
    >>> print(*entry, sep=", ")
    -2/3, 2/3*sqrt(2)
    """
    matrix = check_siegel_point(Pi)
    bounds = getattr(Pi, "entry_bounds", None)
    errors = np.full(matrix.shape, _ARRAY_ERROR) if bounds is None else np.asarray(bounds)
    return [
        [
            (recognise_quadratic(z.real, error), recognise_quadratic(z.imag, error))
            for z, error in zip(*row, strict=True)
        ]
        for row in zip(matrix.tolist(), errors.tolist(), strict=True)
    ]


def _guess(y: float, error: float, degree: int) -> QuadraticGuess | None:
    coefficients = _relation(y, error, degree)
    height = max(abs(n) for n in coefficients)
    number = _nearest_root(coefficients, y)
    if number is None:
        return None
    rational, root, radicand = number
    value = float(rational) + float(root) * math.sqrt(radicand)
    coincidence = (2 * height + 1) ** (degree + 1) * error
    return QuadraticGuess(rational, root, radicand, abs(value - y), coincidence)


def _relation(y: float, error: float, degree: int) -> list[int]:
    """Integers (c_0, …, c_n), not all 0, with Σ c_k y^k small: the shortest vector LLL finds."""
    bits = max(0, round(-math.log2(error)))
    with flint.ctx.workprec(_BITS):
        return reduced_relations([[flint.arb(y) ** k] for k in range(degree + 1)], bits)[0]


def _nearest_root(coefficients: list[int], y: float) -> tuple[Fraction, Fraction, int] | None:
    """The real root of c₀ + c₁ x (+ c₂ x²) next to y as rational + root · √radicand, or None."""
    c, b, a = [*coefficients, 0][:3]
    if a == 0:
        return (Fraction(-c, b), Fraction(0), 0) if b else None
    discriminant = b * b - 4 * a * c
    if discriminant < 0:
        return None
    square, radicand = square_part(discriminant)
    middle, half = Fraction(-b, 2 * a), Fraction(square, 2 * a)
    if radicand in (0, 1):
        roots = [(middle + sign * half * radicand, Fraction(0), 0) for sign in (1, -1)]
    else:
        roots = [(middle, sign * half, radicand) for sign in (1, -1)]
    return min(roots, key=lambda r: abs(float(r[0]) + float(r[1]) * math.sqrt(r[2]) - y))
