r"""Side lengths in balls, while a triangulation is changed: flips, midpoints, barycentres.

The surface is the one whose triangles have the side lengths that the complex *stores*: these
floating-point numbers are its lengths, exactly.  (Lengths of a mesh are rounded distances of its
vertices; where mollification added something, it is part of them.)  A complex that carries exact
lengths beside them means these as well.  Each change of the
triangulation leaves the surface as it is, and makes new sides, whose lengths are balls around what
was computed:

* a *flip* replaces the common side of two triangles by the other diagonal of the quadrilateral that
  they form in the plane.  It has the length √(x² + y²), x the difference of the feet of the heights
  on the old side and y the sum of these heights.  That the diagonal lies in the quadrilateral is
  part of the proof: it crosses the line of the old side at a point whose distances from both ends
  are positive.  Errors grow from flip to flip, mostly little; the few lengths that are not known
  well in the end are computed anew with more bits, from the sides that they depend on;
* *midpoints* of sides halve lengths, which is exact;
* a *barycentre* has from the corner opposite the side a, b ≥ c the other sides, the distance d with
  :math:`9 d^2 = (b - c)^2 + (c - (a - b)) (a + b + c)`.

Cochains take sums of their values, which are integers; so the marking passes exactly.
"""

from __future__ import annotations

import flint
import numpy as np
from flint import arb

from igl_periods.arrays import Ints
from igl_periods.complexes import DeltaComplex, Flips
from igl_periods.display import counted
from igl_periods.errors import ComplexError

from .midpoint_radius import Balls
from .shapes import double_areas, foot

# Lengths that are not known to so much, relatively, are computed with more bits: the first of
# these that leads to no more flips than stand beside it.
_SHARPENED = ((2.0**-49, 20_000.0), (2.0**-40, 100_000.0), (2.0**-30, np.inf))
# Balls may become several times as large with each of the flips that follow each other.
_LEAST_BITS, _BITS_A_ROUND = 128, 3
# Exact lengths and those that are stored differ by no more than this, relatively.
_LARGEST_ROUNDING = 1e-9


def stored_lengths(K: DeltaComplex) -> Balls:
    """The lengths of the edges, exactly as they are stored; (n_edges,).

    Raises
    ------
    ComplexError
        If the two halves of an edge have different lengths.
    """
    lengths = np.empty(K.n_edges)
    lengths[K.edge.ravel()] = K.lengths.ravel()
    if not np.array_equal(lengths[K.edge], K.lengths):
        raise ComplexError(
            "glued sides must have exactly the same length where something is to be proved: make "
            "the complex by DeltaComplex.from_mesh, from_lengths or from_gluing."
        )
    return Balls.exact(lengths)


def lengths_of_edges(K: DeltaComplex) -> Balls:
    """Balls that contain the stored lengths of the edges, and the exact ones if there are any.

    A complex may carry ``exact_lengths``, a function of the precision in bits that gives a ball for
    each edge.  Then a proof is about both surfaces, the one with these lengths and the one with the
    stored ones; unless mollification made them different on purpose.

    Raises
    ------
    ComplexError
        If the two halves of an edge have different lengths, or exact lengths are not those that
        are stored.
    """
    stored = stored_lengths(K)
    exact = getattr(K, "exact_lengths", None)
    if exact is None or K.mollification:
        return stored
    with flint.ctx.workprec(_LEAST_BITS):
        pairs = zip(exact(_LEAST_BITS), stored.mid.tolist(), strict=True)
        apart = np.array([float(abs(length - middle).upper()) for length, middle in pairs])
    if not np.all(apart <= _LARGEST_ROUNDING * stored.mid):
        raise ComplexError(
            f"exact lengths differ from the stored ones by up to {np.max(apart):.3g}: they are "
            "lengths of different surfaces."
        )
    return Balls(stored.mid, np.nextafter(apart, np.inf))


def after_flips(lengths: Balls, rounds: list[Flips]) -> Balls:
    """The lengths of the edges after rounds of flips; (n_edges,).

    Raises
    ------
    ComplexError
        If rounding hides whether an edge can be flipped.
    """
    if not rounds:
        return lengths
    now = Balls(lengths.mid.copy(), lengths.rad.copy())
    with np.errstate(invalid="ignore", over="ignore"):
        for flips in rounds:
            diagonal = _diagonals(*(now[side] for side in _quadrilateral(flips)))
            now.mid[flips.edge], now.rad[flips.edge] = diagonal.mid, diagonal.rad
    for precision, most in _SHARPENED:
        doubtful = np.flatnonzero(~(now.rad <= precision * now.mid))
        portions = _flips_behind(doubtful, rounds, now.mid.size)
        if sum(map(len, portions)) <= most:
            _sharpen(now, doubtful, lengths, portions)
            break
    unknown = np.flatnonzero(~np.isfinite(now.rad))
    if unknown.size:
        raise ComplexError(
            f"rounding hides whether {counted(unknown.size, 'edge', 'edges')} can be flipped, edge "
            f"{unknown[0]} the first: the triangles are too extreme. Remesh them, or keep the "
            "triangulation as it is (delaunay=False, --no-delaunay)."
        )
    return now


def after_midpoints(K: DeltaComplex, lengths: Balls) -> Balls:
    """The lengths of the edges after :func:`igl_periods.complexes.split` of K."""
    halves = lengths.scaled(0.5)
    inner = halves[K.edge.ravel()]
    return Balls(
        np.concatenate([np.repeat(halves.mid, 2), inner.mid]),
        np.concatenate([np.repeat(halves.rad, 2), inner.rad]),
    )


def after_barycentres(K: DeltaComplex, lengths: Balls, faces: Ints) -> Balls:
    """The lengths of the edges after barycentres were inserted into faces of K.

    The edges are those of :func:`igl_periods.complexes.insert_barycentres`.
    """
    sides = lengths[K.edge[faces]]
    distances = [_barycentre_distance(*(sides[:, (s + i) % 3] for i in range(3))) for s in range(3)]
    return Balls(
        np.concatenate([lengths.mid, np.stack([d.mid for d in distances], axis=1).ravel()]),
        np.concatenate([lengths.rad, np.stack([d.rad for d in distances], axis=1).ravel()]),
    )


def _barycentre_distance(a: Balls, one: Balls, other: Balls) -> Balls:
    """Of the barycentre from the corner opposite a."""
    difference = one - other
    # (b − c)² + (c − (a − b)) (a + b + c) for any order of b and c.
    squares = difference * difference + (other - (a - one)) * (a + (one + other))
    return squares.sqrt() / Balls.exact(np.full(a.shape, 3.0))


def _quadrilateral(flips: Flips) -> tuple[Ints, ...]:
    """The old edges from a to b, and the sides p a, p b, q a, q b around them."""
    return flips.edge, flips.second, flips.third, flips.first, flips.fourth


def _diagonals(base: Balls, pa: Balls, pb: Balls, qa: Balls, qb: Balls) -> Balls:
    """Distances of p and q, on different sides of the base from a to b, in the plane.

    Of radius ∞ where the base may not be crossed between a and b.
    """
    p_height, q_height = (
        double_areas(_triangles(base, one, other)) / base for one, other in ((pa, pb), (qa, qb))
    )
    p_from_a, q_from_a = foot(base, pa, pb), foot(base, qa, qb)
    p_from_b, q_from_b = foot(base, pb, pa), foot(base, qb, qa)
    crossed = (p_from_a * q_height + q_from_a * p_height).is_positive()
    crossed &= (p_from_b * q_height + q_from_b * p_height).is_positive()
    near_a = pa.mid + qa.mid < pb.mid + qb.mid
    from_a, from_b = p_from_a - q_from_a, q_from_b - p_from_b
    along = Balls(
        np.where(near_a, from_a.mid, from_b.mid), np.where(near_a, from_a.rad, from_b.rad)
    )
    height = p_height + q_height
    diagonal = (along * along + height * height).sqrt()
    diagonal.rad[~crossed] = np.inf
    return diagonal


def _flips_behind(edges: Ints, rounds: list[Flips], n_edges: int) -> list[Ints]:
    """The flips of each round that the lengths of edges depend on; (n, 5) quadrilaterals."""
    wanted = np.zeros(n_edges, dtype=bool)
    wanted[edges] = True
    portions = []
    for flips in reversed(rounds):
        sides = np.stack(_quadrilateral(flips), axis=1)[wanted[flips.edge]]
        portions.append(sides)
        wanted[sides] = True
    return portions[::-1]


def _sharpen(now: Balls, edges: Ints, before: Balls, portions: list[Ints]) -> None:
    """Compute the lengths of edges with more bits, in place."""
    with flint.ctx.workprec(_LEAST_BITS + _BITS_A_ROUND * len(portions)):
        known: dict[int, arb] = {}

        def length(edge: int) -> arb:
            if edge not in known:
                known[edge] = arb(float(before.mid[edge]), float(before.rad[edge]))
            return known[edge]

        for portion in portions:
            for quadrilateral in portion.tolist():
                known[quadrilateral[0]] = _diagonal_in_arb(*map(length, quadrilateral))
        for edge in edges.tolist():
            exact = length(edge)
            if exact.is_finite():
                now.mid[edge] = middle = float(exact)
                now.rad[edge] = np.nextafter(float(abs(exact - middle).upper()), np.inf)


def _diagonal_in_arb(base: arb, pa: arb, pb: arb, qa: arb, qb: arb) -> arb:
    """The same as :func:`_diagonals`, with more bits."""
    p_along, q_along = ((base + (one**2 - two**2) / base) / 2 for one, two in ((pa, pb), (qa, qb)))
    p_across, q_across = (pa**2 - p_along**2).sqrt(), (qa**2 - q_along**2).sqrt()
    from_a = p_along * q_across + q_along * p_across
    from_b = (base - p_along) * q_across + (base - q_along) * p_across
    if not (p_across > 0 and q_across > 0 and from_a > 0 and from_b > 0):
        return arb.nan()
    return ((p_along - q_along) ** 2 + (p_across + q_across) ** 2).sqrt()


def _triangles(base: Balls, one: Balls, other: Balls) -> Balls:
    sides = (base, one, other)
    return Balls(np.stack([x.mid for x in sides], 1), np.stack([x.rad for x in sides], 1))
