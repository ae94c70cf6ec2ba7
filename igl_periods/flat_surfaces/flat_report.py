r"""What a flat surface is: its stratum, cone angles, holonomy, area, and the periods of dz.

With a holonomy group of order k, :math:`dz^k` is a differential of order k on the surface, and a
point of the total angle θ is a zero of order

.. math:: m = k \left( \frac{\theta}{2\pi} - 1 \right), \qquad \sum m = k (2 g - 2) .

For k = 1 the form dz itself is a closed complex cochain, the sides as vectors, and holomorphic:
with the periods A along the canonical cycles a_i and B along the b_i, B = Π A.  The signature of
the stratum is written as in the literature, H(…) for k = 1, Q(…) for k = 2, and Ω^k(…); marked
points, of order 0, are counted beside.

Whether a rotation is the identity is decided exactly, for polygons with exact coordinates.  From
lengths as balls it can only be refuted; what is not refuted to 100 digits is believed, and
``known_by`` says so.

References
----------
Zorich, "Flat surfaces" (2006), sections 1 and 3.
Bainbridge, Chen, Gendron, Grushevsky, Möller, "Strata of k-differentials" (2019).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import flint
import numpy as np

from igl_periods.arrays import Complexes, ReadOnlyArrays
from igl_periods.complexes import DeltaComplex, of_a_surface
from igl_periods.display import facts_html, known_digits
from igl_periods.topology import homology_basis

from .developments import (
    BITS,
    Development,
    ExactComplex,
    development,
    order_of,
    rational_in,
    turn_share,
)

_LARGEST_ORDER = 10**6
# More zeros of one order than this are written as a power.
_MOST_LISTED = 6


@dataclass(frozen=True, eq=False, repr=False)
class FlatSurfaceReport(ReadOnlyArrays):
    """What :func:`flat_surface_report` found.

    Attributes
    ----------
    genus : int
    holonomy : int or None
        The order of the holonomy group; None if it is infinite.
    orders : tuple of int or None
        The orders of dz^k at the vertices that are not marked points, decreasing; None for an
        infinite holonomy group.
    marked_points : int
        Vertices of the angle 2π.
    cone_angles : tuple of Fraction or float
        The angles of all vertices as multiples of 2π, by vertex; floats where they are not seen to
        be rational.
    area : arb
    exact_area : Fraction, FieldElement or None
        The area, where the surface was glued from polygons with exact coordinates.
    form : (n_edges,) complex or None
        The cochain dz of a translation surface, along the edges in their directions; None of other
        surfaces.  Face 0 lies as in its polygon; without polygons, with its side 0 along the
        positive axis.
    periods : (2g,) complex or None
        Its periods along the canonical cycles a_1, …, a_g, b_1, …, b_g
        (:func:`~igl_periods.cohomology_basis`).
    period_balls : tuple of acb or None
        The same as balls.
    known_by : {"exact", "balls", "floats"}
        How the holonomy was decided: exactly, from exact lengths to 100 digits, or from lengths
        that are doubles to 1e-9.

    Examples
    --------
    >>> import igl_periods as ip
    >>> report = ip.flat_surface_report(ip.surfaces.origami("(1,2,3)", "(1,4)"))
    >>> report.stratum, report.genus
    ('H(2)', 2)
    """

    genus: int
    holonomy: int | None
    orders: tuple[int, ...] | None
    marked_points: int
    cone_angles: tuple[Fraction | float, ...]
    area: flint.arb
    exact_area: Any
    form: Complexes | None
    periods: Complexes | None
    period_balls: tuple[flint.acb, ...] | None
    known_by: str

    @property
    def is_translation_surface(self) -> bool:
        """Whether all rotations are trivial: dz is a holomorphic form."""
        return self.holonomy == 1

    @property
    def is_half_translation_surface(self) -> bool:
        """Whether all rotations are by 0 or π: dz² is a quadratic differential."""
        return self.holonomy in (1, 2)

    @cached_property
    def stratum(self) -> str:
        """The signature: ``H(2)``, ``Q(1, -1, -1, …)``, ``Ω^3(…)``; empty for an infinite group."""
        if self.holonomy is None or self.orders is None:
            return ""
        name = {1: "H", 2: "Q"}.get(self.holonomy, f"Ω^{self.holonomy}")
        # The torus has no zero, and its stratum is named by its marked point.
        orders = self.orders or (0,)
        counts = [(m, orders.count(m)) for m in sorted(set(orders), reverse=True)]
        texts = [f"{m}^{n}" if n > _MOST_LISTED else ", ".join([str(m)] * n) for m, n in counts]
        return f"{name}({', '.join(texts)})"

    def __repr__(self) -> str:
        return "\n".join(["FlatSurfaceReport", *(f"  {a:<12} {b}" for a, b in self._facts())])

    def _repr_html_(self) -> str:
        return facts_html("FlatSurfaceReport", self._facts())

    def _facts(self) -> list[tuple[str, str]]:
        kind = {1: "translation surface", 2: "half-translation surface"}
        named = "cone metric" if self.holonomy is None else f"{self.holonomy}-differential"
        how = {
            "exact": "decided exactly",
            "balls": "to 100 digits, from lengths in balls",
            "floats": "to 1e-9, from lengths in double precision",
        }
        group = "infinite" if self.holonomy is None else f"order {self.holonomy}"
        facts = [
            ("surface", kind.get(self.holonomy or 0, named)),
            ("genus", str(self.genus)),
            ("holonomy", f"{group}, {how[self.known_by]}"),
            ("cone angles", f"{_angles_text(self.cone_angles)} times 2π"),
        ]
        if self.stratum:
            marked = self.marked_points - (0 if self.orders else 1)
            more = f", and {marked} marked point{'s' * (marked > 1)}" if marked > 0 else ""
            facts.insert(1, ("stratum", self.stratum + more))
        facts.append(("area", self._area_text()))
        if self.periods is not None:
            facts.append(("periods", ", ".join(_period_text(z) for z in self.periods)))
        return facts

    def _area_text(self) -> str:
        value = known_digits(float(self.area.mid()), 1e-12)
        if self.exact_area is None:
            return value
        exact = str(self.exact_area)
        return f"{exact} ≈ {value}" if "√" in exact or "/" in exact else exact


@of_a_surface
def flat_surface_report(K: DeltaComplex) -> FlatSurfaceReport:
    """Which flat surface this is: stratum, holonomy, area, dz and its periods.

    Parameters
    ----------
    K : surface
        Closed, oriented and connected.

    Returns
    -------
    FlatSurfaceReport

    Raises
    ------
    ComplexError
        If it is not closed, oriented and connected.

    Examples
    --------
    >>> from igl_periods.complexes import DeltaComplex
    >>> flat_surface_report(DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))]))
    FlatSurfaceReport
      surface      translation surface
      stratum      H(0)
      genus        1
      holonomy     order 1, to 100 digits, from lengths in balls
      cone angles  1 times 2π
      area         1.000000000000
      periods      1, -1 + i
    """
    unfolded = development(K)
    orders = [order_of(r, unfolded.known_by) for r in unfolded.rotations.values()]
    group = None if None in orders else math.lcm(*(k for k in orders if k is not None))
    if group is not None and group > _LARGEST_ORDER:
        group = None
    angles = _cone_angles(unfolded, group)
    zeros = None
    if group is not None and all(isinstance(a, Fraction) for a in angles):
        zeros = tuple(sorted((int(group * (a - 1)) for a in angles if a != 1), reverse=True))
    form = periods = balls = None
    if group == 1:
        vectors = unfolded.vector_balls()
        balls = _periods(unfolded.K, vectors)
        periods = np.array([complex(z) for z in balls])
        form = _cochain(unfolded.K, vectors)
    exact_area = _exact_area(unfolded)
    return FlatSurfaceReport(
        genus=K.genus,
        holonomy=group,
        orders=zeros,
        marked_points=sum(a == 1 for a in angles),
        cone_angles=angles,
        area=_area(unfolded),
        exact_area=exact_area,
        form=form,
        periods=periods,
        period_balls=balls,
        known_by=unfolded.known_by,
    )


def _cone_angles(unfolded: Development, group: int | None) -> tuple[Fraction | float, ...]:
    """The angles by vertex, as multiples of 2π."""
    K, v = unfolded.K, unfolded.vector_balls()
    with flint.ctx.workprec(BITS):
        total = [flint.arb(0)] * K.n_vertices
        for corner, vertex in enumerate(K.corner_vertex.ravel().tolist()):
            f, s = divmod(corner, 3)
            # Side s + 2 leaves the corner s, and side s + 1 arrives there.
            leaving, arriving = v[3 * f + (s + 2) % 3], v[3 * f + (s + 1) % 3]
            total[vertex] = total[vertex] + turn_share(-arriving / leaving)
    return tuple(_angle(x, group, unfolded.known_by) for x in total)


def _angle(share: flint.arb, group: int | None, known_by: str) -> Fraction | float:
    """An angle as a multiple of 2π: with a holonomy group of order k, one of 2π/k."""
    found = rational_in(share, known_by)
    if found is None or (group is not None and (group * found).denominator != 1):
        return float(share.mid())
    return found


def _area(unfolded: Development) -> flint.arb:
    v = unfolded.vector_balls()
    with flint.ctx.workprec(BITS):
        doubled = flint.arb(0)
        for a, b in zip(v[0::3], v[1::3]):
            doubled = doubled + a.real * b.imag - a.imag * b.real
        return doubled / 2


def _exact_area(unfolded: Development) -> Any:
    v = unfolded.vectors
    if not isinstance(v[0], ExactComplex):
        return None
    doubled: Any = Fraction(0)
    for a, b in zip(v[0::3], v[1::3]):
        doubled = doubled + a.x * b.y - a.y * b.x
    return doubled * Fraction(1, 2)


def _periods(K: DeltaComplex, v: list[flint.acb]) -> tuple[flint.acb, ...]:
    with flint.ctx.workprec(BITS):
        return tuple(sum((v[h] for h in walk.tolist()), flint.acb(0)) for walk in homology_basis(K))


def _cochain(K: DeltaComplex, v: list[flint.acb]) -> Complexes:
    values = np.array([complex(z) for z in v])
    form = np.empty(K.n_edges, dtype=np.complex128)
    forward = K.sign.ravel() > 0
    form[K.edge.ravel()[forward]] = values[forward]
    return form


def _angles_text(angles: tuple[Fraction | float, ...]) -> str:
    texts = [str(a) if isinstance(a, Fraction) else f"{a:.6g}" for a in angles]
    distinct = sorted(set(texts), key=lambda t: -float(Fraction(t)))
    counts = [(t, texts.count(t)) for t in distinct[:8]]
    shown = ", ".join(t if n == 1 else f"{t} ({n} vertices)" for t, n in counts)
    return shown + (", …" if len(distinct) > 8 else "")


def _period_text(z: complex) -> str:
    x, y = (0.0 if abs(part) < 1e-12 else part for part in (z.real, z.imag))
    if y == 0.0:
        return f"{x:.6g}"
    imag = "i" if abs(y) == 1.0 else f"{abs(y):.6g}i"
    if x == 0.0:
        return f"-{imag}" if y < 0 else imag
    return f"{x:.6g} {'-' if y < 0 else '+'} {imag}"
