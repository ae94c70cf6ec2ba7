"""Polygons with gluings by translations, and what is done to them."""

from collections import defaultdict
from fractions import Fraction

import igl_periods as ip
from igl_periods.complexes import exact_number

L_PAIRS = [((0, 0), (0, 5)), ((0, 1), (0, 3)), ((0, 2), (0, 7)), ((0, 4), (0, 6))]


def l_vertices(a, b=None):
    b = a if b is None else b
    return [(0, 0), (1, 0), (a, 0), (a, 1), (1, 1), (1, b), (0, b), (0, 1)]


def exact(polygon):
    return [tuple(exact_number(c) for c in vertex) for vertex in polygon]


def by_translations(polygons):
    """The gluing of parallel sides of the same length, where that is unambiguous."""
    at = defaultdict(list)
    for p, polygon in enumerate(polygons):
        for k, (a, b) in enumerate(zip(polygon, [*polygon[1:], polygon[0]])):
            at[b[0] - a[0], b[1] - a[1]].append((p, k))
    pairs = []
    for (x, y), sides in at.items():
        others = at[-x, -y]
        assert len(sides) == len(others) == 1
        if sides[0] < others[0]:
            pairs.append((sides[0], others[0]))
    return pairs


def applied(matrix, polygon):
    """The image of a polygon under a linear map [[a, b], [c, d]]."""
    (a, b), (c, d) = matrix
    return [(a * x + b * y, c * x + d * y) for x, y in polygon]


def same_periods(K, L, tolerance=1e-10):
    """Whether two surfaces have equivalent period matrices."""
    one, other = (ip.enclose(M, digits=11) for M in (K, L))
    return bool(ip.symplectic_isomorphisms(one, other, tolerance=tolerance, limit=1))


def cut(polygons, pairs, p, i, j):
    """Cut polygon p from vertex i to vertex j > i + 1; the new sides are glued to each other."""
    polygon = polygons[p]
    inner, outer = polygon[i : j + 1], [*polygon[j:], *polygon[: i + 1]]
    new, d = len(polygons), len(polygon)
    place = {}
    for k in range(d):
        place[p, k] = (new, k - i) if i <= k < j else (p, (k - j) % d)
    moved = [tuple(place.get(side, side) for side in pair) for pair in pairs]
    whole = [*polygons[:p], outer, *polygons[p + 1 :], inner]
    return whole, [*moved, ((p, len(outer) - 1), (new, len(inner) - 1))]


def rotated(polygon, c=Fraction(3, 5), s=Fraction(4, 5), by=(Fraction(1, 3), Fraction(2))):
    """The polygon moved by a rotation with rational entries and a translation."""
    return [(c * x - s * y + by[0], s * x + c * y + by[1]) for x, y in polygon]
