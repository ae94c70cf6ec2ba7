r"""Stars and faces: the cells on which harmonic functions are power series.

A triangulated flat surface is cut into two kinds of cells.  The *star* of a vertex is the polygon
around it whose corners lie on the edges at it, at about half the length of the shortest one; what
is left of a triangle without its three corners is a *face cell*, a polygon with three to six sides.
An edge carries two such points, at exact dyadic fractions of it, or one where they would be close.

Cells meet in straight segments, the *interfaces*: the chord that cuts a corner off, between a face
and a star, and the gap between the two points of an edge, between two faces.  A face that is glued
to itself meets itself, a vertex that is alone has one star; nothing is assumed about the gluing.

Every cell has its own coordinate ζ.  In a face it is that of the plane, with its origin c inside
the cell.  In a star it is that of the plane of each triangle, with the vertex at 0 and the leaving
side on the positive axis.  With R a size and κ = 2π/θ, θ the total angle,

.. math:: w = \zeta / R \quad\text{in a face},\qquad
          w = e^{i\kappa\varphi_0} (\zeta/R)^\kappa \quad\text{in a star},

φ₀ the sum of the angles of the triangles passed before.  This w is one holomorphic coordinate on
the whole cell, which for a cone is what ζ is not.

Both kinds are star-shaped with respect to the origin, counterclockwise; this is proved in balls,
segment by segment.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import flint
import numpy as np

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.errors import ComplexError

from .delaunay_moves import fan
from .exact_arithmetic import exponent_of
from .planes import foot_and_height
from .triangulation import Triangulation, following

Arb = flint.arb
Acb = flint.acb

_FRACTIONS = 2**20
_LEAST_FRACTION = 0.02
_LEAST_GAP = 0.03


@dataclass(frozen=True, eq=False)
class Cells:
    """The cells of a surface and the segments between them.

    Cells 0 … n_stars − 1 are the stars of the vertices, the others the faces.  Interface i has a
    first side, always of a face, and a second side that runs the other way; for i < 3 m it is the
    chord at corner i, with a star on its second side.

    Attributes
    ----------
    n_stars : int
    cell : (n, 2) int
        The cell on each side.
    jumps : (n, k) int
        u_first − u_second, for each cochain.
    start, end : list of (acb, acb)
        ζ at the ends of each side, counterclockwise around its cell.
    turn : list of arb
        φ₀ of the star on the second side of each chord.
    exponent : list of arb
        κ of each star.
    scale : (n_cells,) float
        R: the largest |ζ| on the cell, so that |w| is at most about 1.
    """

    n_stars: int
    cell: Ints
    jumps: Ints
    start: list[tuple[Acb, Acb]]
    end: list[tuple[Acb, Acb]]
    turn: list[Arb]
    exponent: list[Arb]
    scale: Floats

    @property
    def n_cells(self) -> int:
        """Number of stars and faces."""
        return len(self.scale)

    @property
    def n_chords(self) -> int:
        """Number of interfaces between a face and a star: the first ones."""
        return len(self.turn)

    @property
    def n_interfaces(self) -> int:
        """Number of segments."""
        return len(self.cell)

    @cached_property
    def exponents(self) -> Floats:
        """κ of each cell in floating point, 1 for faces."""
        stars = [float(kappa.mid()) for kappa in self.exponent]
        return np.array(stars + [1.0] * (self.n_cells - self.n_stars))

    @cached_property
    def ends(self) -> Complexes:
        """ζ at start and end of each side, in floating point; (n, 2 sides, 2)."""
        return np.array(
            [
                [[complex(a.mid()), complex(b.mid())] for a, b in zip(starts, ends)]
                for starts, ends in zip(self.start, self.end)
            ]
        )

    @cached_property
    def turns(self) -> Floats:
        """φ₀ of each chord in floating point."""
        return np.array([float(turn.mid()) for turn in self.turn])

    def accuracy_in_bits(self) -> int:
        """To how many bits the corners of cells are known, relative to the size of the cell."""
        size = np.floor(np.log2(self.scale)).astype(int).tolist()
        worst = max(exponent_of(x.rad()) for x in (*self.turn, *self.exponent))
        for starts, ends, pair in zip(self.start, self.end, self.cell.tolist()):
            for side, cell in enumerate(pair):
                for z in (starts[side], ends[side]):
                    radius = max(z.real.rad(), z.imag.rad())
                    worst = max(worst, exponent_of(radius) - size[cell])
        return -worst

    def is_star(self, i: int, side: int) -> bool:
        """Whether there is a star on a side of an interface."""
        return side == 1 and i < self.n_chords


def cells_of(surface: Triangulation) -> Cells:
    """Cut a surface into stars and faces.

    Raises
    ------
    ComplexError
        If it is not certain that a cell is star-shaped, as with triangles that are too flat for
        the precision.
    """
    first, second = _points_on_edges(surface)
    near, far = _points_on_half_edges(surface, first, second)
    corners = [_corner_coordinates(surface, f) for f in range(surface.n_faces)]
    turn, exponent = _turns(surface, corners)
    chords = [_chord(surface, corners, near, far, corner) for corner in range(len(surface.twin))]
    centres = [_centre([chords[3 * f + k][0] for k in range(3)]) for f in range(surface.n_faces)]
    n_stars, k = surface.n_vertices, surface.n_cochains
    cell, jumps, start, end = [], [], [], []
    for corner, (on_face, on_star) in enumerate(chords):
        f = corner // 3
        cell.append((n_stars + f, surface.corner_vertex[corner]))
        jumps.append(_potential(surface, corner))
        start.append((on_face[0] - centres[f], on_star[0]))
        end.append((on_face[1] - centres[f], on_star[1]))
    for h, t in enumerate(surface.twin):
        if h > t or near[h] == far[h]:
            continue
        f, g = h // 3, t // 3
        tail, head = following(h), following(t)  # the corners where h and t start, in f and g
        cell.append((n_stars + f, n_stars + g))
        at_tail = _potential(surface, tail), _potential(surface, following(head))
        jumps.append(tuple(a - b for a, b in zip(*at_tail)))
        here, there = _gap(corners[f], near[h], far[h], h), _gap(corners[g], near[t], far[t], t)
        start.append((here[0] - centres[f], there[0] - centres[g]))
        end.append((here[1] - centres[f], there[1] - centres[g]))
    found = Cells(
        n_stars=n_stars,
        cell=np.array(cell, dtype=np.int64),
        jumps=np.array(jumps, dtype=np.int64).reshape(len(cell), k),
        start=start,
        end=end,
        turn=turn,
        exponent=exponent,
        scale=np.ones(n_stars + surface.n_faces),
    )
    _check_star_shaped(found)
    found.scale[:] = _scales(found)
    return found


def _points_on_edges(surface: Triangulation) -> tuple[list[int], list[int]]:
    """The points on each edge, as multiples of 2⁻²⁰ of it, in its direction."""
    lengths = np.array([float(length.mid()) for length in surface.lengths])
    tail = np.empty(lengths.size, dtype=np.int64)
    head = np.empty_like(tail)
    for h, (edge, sign) in enumerate(zip(surface.edge, surface.sign)):
        # Side h starts at the corner that follows it.
        (tail if sign > 0 else head)[edge] = surface.corner_vertex[following(h)]
    radius = np.full(surface.n_vertices, np.inf)
    np.minimum.at(radius, tail, 0.5 * lengths)
    np.minimum.at(radius, head, 0.5 * lengths)
    first = np.maximum(radius[tail] / lengths, _LEAST_FRACTION)
    second = np.minimum(1.0 - radius[head] / lengths, 1.0 - _LEAST_FRACTION)
    close = second - first < _LEAST_GAP
    middle = np.clip(0.5 * (first + second), _LEAST_FRACTION, 1.0 - _LEAST_FRACTION)
    first, second = np.where(close, middle, first), np.where(close, middle, second)
    return (
        np.rint(_FRACTIONS * first).astype(int).tolist(),
        np.rint(_FRACTIONS * second).astype(int).tolist(),
    )


def _points_on_half_edges(
    surface: Triangulation, first: list[int], second: list[int]
) -> tuple[list[flint.fmpq], list[flint.fmpq]]:
    """The fractions of each half-edge at which its points lie, the nearer to its start first."""
    near, far = [], []
    for edge, sign in zip(surface.edge, surface.sign):
        a, b = first[edge], second[edge]
        if sign < 0:
            a, b = _FRACTIONS - b, _FRACTIONS - a
        near.append(flint.fmpq(a, _FRACTIONS))
        far.append(flint.fmpq(b, _FRACTIONS))
    return near, far


def _corner_coordinates(surface: Triangulation, f: int) -> tuple[Acb, Acb, Acb]:
    """The corners of a face in the plane, corner 0 at 0 and corner 1 on the positive axis."""
    a, b, c = (surface.length(3 * f + s) for s in range(3))
    x, y = foot_and_height(c, b, a)
    return Acb(0), Acb(c), Acb(x, y)


def _leaving(corner: int) -> int:
    """The side that starts at a corner: side k + 2."""
    return following(following(corner))


def _turns(
    surface: Triangulation, corners: list[tuple[Acb, Acb, Acb]]
) -> tuple[list[Arb], list[Arb]]:
    """The angle before each corner around its vertex, and κ = 2π/θ of each vertex."""
    turn: list[Arb | None] = [None] * len(surface.twin)
    exponent: list[Arb | None] = [None] * surface.n_vertices
    for first in range(len(surface.twin)):
        if turn[first] is not None:
            continue
        total = Arb(0)
        for corner in fan(surface, first):
            turn[corner] = total
            a, b, c = (corners[corner // 3][(corner + j) % 3] for j in range(3))
            total = total + ((c - a) / (b - a)).arg()
        exponent[surface.corner_vertex[first]] = 2 * Arb.pi() / total
    return turn, exponent  # type: ignore[return-value]


def _chord(
    surface: Triangulation,
    corners: list[tuple[Acb, Acb, Acb]],
    near: list[flint.fmpq],
    far: list[flint.fmpq],
    corner: int,
) -> tuple[tuple[Acb, Acb], tuple[Acb, Acb]]:
    """The chord at a corner, counterclockwise around the face and around the vertex."""
    a, b, c = (corners[corner // 3][(corner + j) % 3] for j in range(3))
    out, back = Arb(near[_leaving(corner)]), Arb(1 - far[following(corner)])
    on_face = a + back * (c - a), a + out * (b - a)
    # In the plane with the vertex at 0 and the leaving side on the positive axis.
    length = surface.length(_leaving(corner))
    x, y = foot_and_height(length, surface.length(following(corner)), surface.length(corner))
    return on_face, (Acb(out * length), Acb(back * x, back * y))


def _gap(
    corners: tuple[Acb, Acb, Acb], near: flint.fmpq, far: flint.fmpq, h: int
) -> tuple[Acb, Acb]:
    """The part of a side between its two points, in the plane of its face."""
    tail, head = corners[(h + 1) % 3], corners[(h + 2) % 3]
    return tail + Arb(near) * (head - tail), tail + Arb(far) * (head - tail)


def _centre(chords: list[tuple[Acb, Acb]]) -> Acb:
    """An exact point in the middle of the face cell with these chords."""
    points = np.array([complex(z.mid()) for chord in chords for z in chord])
    size = np.abs(points - points.mean()).max()
    unit = 2.0 ** (np.floor(np.log2(size)) - 20)
    centre = unit * np.rint(points.mean() / unit)
    return Acb(float(centre.real), float(centre.imag))


def _potential(surface: Triangulation, corner: int) -> tuple[int, ...]:
    """The linear potentials of the cochains at a corner, 0 at corner 0 of its face."""
    k, side_2, side_1 = corner % 3, corner - corner % 3 + 2, corner - corner % 3 + 1
    if k == 0:
        return tuple(0 for _ in range(surface.n_cochains))
    # Side 2 runs from corner 0 to corner 1, side 1 from corner 2 to corner 0.
    return surface.value(side_2) if k == 1 else tuple(-x for x in surface.value(side_1))


def _check_star_shaped(cells: Cells) -> None:
    for i in range(cells.n_interfaces):
        for side in range(2):
            if not (cells.start[i][side].conjugate() * cells.end[i][side]).imag > 0:
                raise ComplexError(
                    f"cell {cells.cell[i, side]} is not certainly star-shaped: a triangle is so "
                    "flat that its lengths do not determine it. Remesh the surface."
                )


def _scales(cells: Cells) -> Floats:
    """The distance of the farthest corner of each cell from its origin, about."""
    farthest = np.zeros(cells.n_cells)
    np.maximum.at(farthest, cells.cell.ravel(), np.abs(cells.ends).max(axis=2).ravel())
    return farthest
