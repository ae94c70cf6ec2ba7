r"""Coordinates in which a plane quartic has few and simple coefficients.

An automorphism γ = [[a, b], [c, d]] of Π acts on the normalised differentials by (cΠ + d)ᵀ, hence
on the plane of the canonical curve.  Where its three eigenvalues are distinct its eigenvectors are
coordinates in which the quartic has few terms: a diagonal matrix multiplies every term by a number,
and only those with the same number occur.  The diagonal scale that is left makes three
coefficients 1.  Klein's quartic becomes x³y + y³z + z³x by an element of order 7.

Of all eigenframes that with the fewest terms, then with the simplest coefficients is taken.  A
quartic without such automorphisms is left in coordinates x, y, z, x + y + z that are bitangents,
which are rarely rational.

References
----------
Henn, "Die Automorphismengruppen der algebraischen Kurven vom Geschlecht 3" (1976).
Dolgachev, "Classical algebraic geometry" (2012), section 6.5.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations, product
from math import gcd, lcm

import flint
import numpy as np

from igl_periods.arrays import Complexes, Ints
from igl_periods.recognition import AlgebraicNumber, recognise_number
from igl_periods.siegel import midpoint

from .ball_roots import logarithm
from .plane_quartics import Line
from .ternary_forms import Exponents, TernaryForm, transformed

_DISTINCT = 1e-4
_MOST_FRAMES = 4
_TINY = 1e-9
_MOST_ROOTS = 256
# Four in general position are looked for among so many bitangents.
_LINES = 9


@dataclass(frozen=True)
class RecognisedQuartic:
    """A plane quartic whose coefficients are recognised.

    Attributes
    ----------
    balls : dict
        From exponents to coefficients in balls.
    numbers : dict
        From exponents to algebraic numbers.
    change : (3, 3) acb_mat
        ``transformed(F, change)`` is a multiple of this quartic, F the one in normalised
        differentials.
    """

    balls: TernaryForm
    numbers: dict[Exponents, AlgebraicNumber]
    change: flint.acb_mat

    @property
    def cost(self) -> tuple[int, int, int, int]:
        """What is to be small: degree, number of terms, height, number of mixed terms."""
        degree = max(x.degree for x in self.numbers.values())
        height = sum(abs(c) for x in self.numbers.values() for c in x.polynomial)
        mixed = sum(max(e) < 4 for e in self.numbers)
        return degree, len(self.numbers), height, mixed


def model_of_quartic(
    F: TernaryForm, Pi: flint.acb_mat, automorphisms: Sequence[Ints], degree: int
) -> RecognisedQuartic | None:
    """The simplest equation that is found in eigenframes; None without recognised coefficients.

    Parameters
    ----------
    F : dict
        The quartic in the normalised differentials of Π.
    Pi : (3, 3) acb_mat
    automorphisms : list of (6, 6) int
        γ with γ·Π = Π.
    degree : int
        The largest degree of an algebraic number that is tried.
    """
    best: RecognisedQuartic | None = None
    for frame in _frames(F, Pi, automorphisms):
        G = {e: c for e, c in transformed(F, frame.tolist()).items() if not c.contains(0)}
        for scale, scaled in _scaled(G):
            found = _recognised(scaled, degree)
            if found is None:
                continue
            change = frame * flint.acb_mat(
                [[scale[i] if i == j else flint.acb(0) for j in range(3)] for i in range(3)]
            )
            quartic = RecognisedQuartic(scaled, found, change)
            if best is None or quartic.cost < best.cost:
                best = quartic
    return best


def in_bitangents(F: TernaryForm, lines: Sequence[Line]) -> TernaryForm | None:
    """The quartic in coordinates in which four bitangents are x, y, z and x + y + z.

    The largest coefficient is 1.  None if nothing is known of the others to within the balls.
    """
    first, second, third, fourth = _general_position(lines)
    rows = flint.acb_mat([first, second, third])
    if rows.det().contains(0):
        return None
    weights = rows.transpose().solve(flint.acb_mat([[x] for x in fourth])).entries()
    scaled = flint.acb_mat(
        [[w * x for x in row] for w, row in zip(weights, rows.tolist(), strict=True)]
    )
    if scaled.det().contains(0):
        return None
    G = transformed(F, scaled.inv().tolist())
    largest = max(G.values(), key=lambda c: float(c.abs_lower()))
    if largest.contains(0):
        return None
    G = {e: c / largest for e, c in G.items()}
    return G if all(c.is_finite() for c in G.values()) else None


def _general_position(lines: Sequence[Line]) -> list[Line]:
    """Four of the first lines, no three of which are nearly concurrent."""
    floats = np.array([[complex(c) for c in line] for line in lines[:_LINES]])
    floats /= np.linalg.norm(floats, axis=1, keepdims=True)

    def quality(chosen: tuple[int, ...]) -> float:
        return min(abs(np.linalg.det(floats[list(t)])) for t in combinations(chosen, 3))

    return [lines[i] for i in max(combinations(range(len(floats)), 4), key=quality)]


def _frames(
    F: TernaryForm, Pi: flint.acb_mat, automorphisms: Sequence[Ints]
) -> Iterator[flint.acb_mat]:
    """Eigenvectors of automorphisms with distinct eigenvalues: those with the fewest terms."""
    point = midpoint(Pi)
    floats = {e: complex(c) for e, c in F.items()}
    ranked: dict[tuple[int, tuple[float, ...]], Ints] = {}
    for gamma in automorphisms:
        action = _action(gamma, point)
        values, vectors = np.linalg.eig(action)
        gaps = [abs(values[i] - values[j]) for i, j in combinations(range(3), 2)]
        if min(gaps) < _DISTINCT:
            continue
        G = transformed(floats, vectors.tolist())
        sizes = np.abs(list(G.values()))
        terms = int(np.sum(sizes > _TINY * sizes.max()))
        # One frame of each kind: the sizes of the coefficients tell kinds apart.
        kind = tuple(np.round(np.sort(sizes / sizes.max())[::-1][:terms], 6).tolist())
        ranked.setdefault((terms, kind), gamma)
    for key in sorted(ranked)[:_MOST_FRAMES]:
        try:
            _, vectors = _ball_action(ranked[key], Pi).eig(right=True, multiple=False)
        except ValueError:  # balls too wide to isolate the eigenvalues
            continue
        yield vectors


def _action(gamma: Ints, Pi: Complexes) -> Complexes:
    """How γ moves the points of the canonical plane."""
    g = len(Pi)
    return np.asarray(gamma[g:, :g] @ Pi + gamma[g:, g:]).T


def _ball_action(gamma: Ints, Pi: flint.acb_mat) -> flint.acb_mat:
    g = Pi.nrows()
    c, d = (flint.acb_mat(flint.fmpz_mat(gamma[g:, s].tolist())) for s in (np.s_[:g], np.s_[g:]))
    return (c * Pi + d).transpose()


def _scaled(G: TernaryForm) -> Iterator[tuple[list[flint.acb], TernaryForm]]:
    """Diagonal scales that make three coefficients 1, and the quartic in these coordinates."""
    places = sorted(G, reverse=True)
    for triple in combinations(places, 3):
        E = flint.fmpz_mat([list(e) for e in triple])
        n = abs(int(E.det()))
        if n == 0:
            continue
        inverse = flint.fmpq_mat(E).inv()
        logs = [-logarithm(G[e]) for e in triple]
        yield from _branches(G, inverse, logs, n)
        return


def _branches(
    G: TernaryForm, inverse: flint.fmpq_mat, logs: list[flint.acb], n: int
) -> Iterator[tuple[list[flint.acb], TernaryForm]]:
    """All choices of roots that make a difference."""
    turn = flint.acb(0, 2) * flint.arb.pi()
    seen: set[tuple[tuple[float, float], ...]] = set()
    for count, k in enumerate(product(range(n), repeat=3)):
        if count >= _MOST_ROOTS:
            return
        moved = [x + turn * m for x, m in zip(logs, k, strict=True)]
        scale = [
            sum((flint.acb(inverse[i, j]) * moved[j] for j in range(3)), flint.acb(0)).exp()
            for i in range(3)
        ]
        form = {e: c * scale[0] ** e[0] * scale[1] ** e[1] * scale[2] ** e[2] for e, c in G.items()}
        key = tuple((round(complex(c).real, 6), round(complex(c).imag, 6)) for c in form.values())
        if key not in seen:
            seen.add(key)
            yield scale, form


def _recognised(G: TernaryForm, degree: int) -> dict[Exponents, AlgebraicNumber] | None:
    numbers: dict[Exponents, AlgebraicNumber] = {}
    for e, c in sorted(G.items(), reverse=True):
        number = recognise_number(c, degree=degree) if c.is_finite() else None
        if number is None:
            return None
        numbers[e] = number
    if all(x.is_rational for x in numbers.values()):
        fractions = [Fraction(-x.polynomial[0], x.polynomial[1]) for x in numbers.values()]
        denominator = lcm(*(c.denominator for c in fractions))
        integers = [int(c * denominator) for c in fractions]
        common = gcd(*integers)
        return {
            e: AlgebraicNumber((-(c // common), 1), complex(c // common), x.evidence)
            for (e, x), c in zip(numbers.items(), integers, strict=True)
        }
    return numbers
