r"""Flat surfaces unfolded into the plane: frames of the faces, rotations across the edges.

Every face lies in the plane with its sides as complex vectors v_h, counterclockwise.  Walking from
the face of a half-edge h to that of its twin t, the frame turns by

.. math:: r_h = -v_h / v_t, \qquad |r_h| = 1 .

A spanning tree of the faces turns all frames so that r = 1 across its edges; the other rotations
then generate the *holonomy group* of the flat metric, a group of rotations.  It is trivial iff the
surface is a translation surface, {±1} iff it is a half-translation surface, and of order k iff
:math:`dz^k` is a differential on the surface.

Vectors are exact where the surface was glued from polygons with exact coordinates: pairs of numbers
of one field.  Otherwise they are balls, computed from the lengths.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import flint

from igl_periods.complexes import DeltaComplex, ball_of, check_surface

BITS = 400
_TOLERANCE = 1e-9


@dataclass(frozen=True)
class ExactComplex:
    """x + i y with x and y in one number field."""

    x: Any
    y: Any

    def __neg__(self) -> ExactComplex:
        return ExactComplex(-self.x, -self.y)

    def __add__(self, w: ExactComplex) -> ExactComplex:
        return ExactComplex(self.x + w.x, self.y + w.y)

    def __mul__(self, w: ExactComplex) -> ExactComplex:
        return ExactComplex(self.x * w.x - self.y * w.y, self.x * w.y + self.y * w.x)

    def __truediv__(self, w: ExactComplex) -> ExactComplex:
        norm = w.x * w.x + w.y * w.y
        product = self * ExactComplex(w.x, -w.y)
        return ExactComplex(product.x / norm, product.y / norm)

    def ball(self) -> flint.acb:
        """A ball that contains the number."""
        return flint.acb(ball_of(self.x, BITS), ball_of(self.y, BITS))


@dataclass(frozen=True, eq=False)
class Development:
    """The sides of all faces as vectors, in frames that agree across a spanning tree.

    Attributes
    ----------
    K : DeltaComplex
    vectors : list of ExactComplex or acb
        Of the half-edges.
    rotations : dict of int to ExactComplex or acb
        Across the half-edges that the tree leaves over, one of each edge.
    known_by : {"exact", "balls", "floats"}
        What the vectors are: exact numbers, balls about the exact lengths, or balls about lengths
        that are doubles, which may be rounded.
    """

    K: DeltaComplex
    vectors: list[Any]
    rotations: dict[int, Any]
    known_by: str

    def vector_balls(self) -> list[flint.acb]:
        """The vectors as balls."""
        return [v.ball() if isinstance(v, ExactComplex) else v for v in self.vectors]


def development(K: DeltaComplex) -> Development:
    """Unfold a closed, oriented, connected surface.

    Raises
    ------
    ComplexError
        If it is none.
    """
    check_surface(K)
    polygons = K.polygons
    with flint.ctx.workprec(BITS):
        if polygons is not None and polygons.is_exact and K.mollification == 0.0:
            known_by = "exact"
            v: list[Any] = [ExactComplex(*polygons.vector(h)) for h in range(3 * K.n_faces)]
        else:
            exact = K.exact_lengths if K.mollification == 0.0 else None
            known_by = "floats" if exact is None else "balls"
            v = _laid_out(K)
        turned, rotations = _unfolded(K, v, _first_frame(K, known_by))
    return Development(K, turned, rotations, known_by)


def _laid_out(K: DeltaComplex) -> list[flint.acb]:
    """The sides of each face with its side 0 along the positive axis."""
    if K.exact_lengths is not None and K.mollification == 0.0:
        lengths = [flint.arb(x) for x in K.exact_lengths(BITS)]
        sides = [lengths[e] for e in K.edge.ravel().tolist()]
    else:
        sides = [flint.arb(x) for x in K.lengths.ravel().tolist()]
    vectors = []
    for f in range(K.n_faces):
        a, b, c = sides[3 * f : 3 * f + 3]
        # Corner 1 at 0, corner 2 at a; c leads from corner 0 to 1, b from corner 2 to 0.
        x = (a * a + c * c - b * b) / (2 * a)
        apex = flint.acb(x, (c * c - x * x).sqrt())
        vectors += [flint.acb(a), apex - a, -apex]
    return vectors


def _first_frame(K: DeltaComplex, known_by: str) -> Any:
    """The rotation of face 0: as it lies in its polygon, where there is one."""
    if known_by == "exact":
        return ExactComplex(Fraction(1), Fraction(0))
    if K.polygons is None:
        return flint.acb(1)
    side = K.polygons.vector_ball(0, BITS)
    return side / abs(side)


def _unfolded(K: DeltaComplex, v: list[Any], first: Any) -> tuple[list[Any], dict[int, Any]]:
    twin = K.twin.ravel().tolist()
    turn: dict[int, Any] = {0: first}
    waiting, tree = deque([0]), set()
    while waiting:
        f = waiting.popleft()
        for h in range(3 * f, 3 * f + 3):
            g = twin[h] // 3
            if g not in turn:
                turn[g] = turn[f] * (-v[h] / v[twin[h]])
                tree.add(h)
                waiting.append(g)
    turned = [turn[h // 3] * x for h, x in enumerate(v)]
    rotations = {
        h: -turned[h] / turned[t]
        for h, t in enumerate(twin)
        if h < t and h not in tree and t not in tree
    }
    return turned, rotations


def order_of(rotation: Any, known_by: str) -> int | None:
    """The order of a rotation as an element of the circle; None for an infinite one.

    Exact rotations are raised to the power; of balls the angle has to be compatible with a rational
    multiple of 2π with a small denominator, which other rotations are not by chance.
    """
    is_exact = isinstance(rotation, ExactComplex)
    share = turn_share(rotation.ball() if is_exact else rotation)
    found = rational_in(share, known_by)
    if found is None or not is_exact:
        return None if found is None else found.denominator
    power, k = rotation, found.denominator
    for bit in bin(k)[3:]:
        power = power * power
        power = power * rotation if bit == "1" else power
    return k if (power.x, power.y) == (1, 0) else None


def turn_share(z: flint.acb) -> flint.arb:
    """The argument of a complex number as a part of 2π, in (−1/2, 1/2]."""
    with flint.ctx.workprec(BITS):
        if z.real < 0:
            # The cut of the argument lies on the negative axis.
            share = (-z).arg() / (2 * flint.arb.pi())
            return share + (flint.arb("0.5") if not share > 0 else flint.arb("-0.5"))
        return z.arg() / (2 * flint.arb.pi())


def rational_in(x: flint.arb, known_by: str) -> Fraction | None:
    """The rational number with a small denominator that a ball contains, if there is one.

    A ball of 100 digits contains one with a denominator up to 10⁶ by chance only with the
    probability 10⁻⁸⁷; of doubles, with 1e-9 and denominators up to 360, it is 1e-4.
    """
    largest, margin = (360, _TOLERANCE) if known_by == "floats" else (10**6, 0.0)
    middle = Fraction(*_ratio(x)).limit_denominator(largest)
    with flint.ctx.workprec(BITS):
        gap = abs(x - flint.fmpq(middle.numerator, middle.denominator))
        near = gap.contains(0) if margin == 0.0 else bool(gap < margin)
        return middle if near and float(gap.rad()) < 1e-9 else None


def _ratio(x: flint.arb) -> tuple[int, int]:
    mantissa, exponent = x.mid().man_exp()
    value = Fraction(int(mantissa)) * Fraction(2) ** int(exponent)
    return value.numerator, value.denominator
