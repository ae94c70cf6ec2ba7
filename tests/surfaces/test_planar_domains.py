"""Triangulated plane domains: what they are, and what is refused with its place."""

from types import SimpleNamespace

import numpy as np
import pytest
from support.random_domains import AITCH, ELL, random_domain, square

import igl_periods as ip
from igl_periods.complexes import angles
from igl_periods.surfaces.planar_domains import planar_domain


def area(z):
    return abs(np.imag(np.conj(z) * np.roll(z, -1)).sum()) / 2


def areas(V, F):
    a, b, c = V[F].transpose(1, 0, 2)
    return ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2


@pytest.mark.parametrize("seed", range(20))
def test_the_triangles_are_the_domain(seed):
    outer, holes = random_domain(np.random.default_rng(seed))
    V, F = planar_domain(outer, holes)
    polygons = [outer, *holes]
    corners = np.concatenate(polygons)
    assert np.array_equal(V[: len(corners)] @ [1, 1j], corners)
    assert areas(V, F).min() > 0
    assert areas(V, F).sum() == pytest.approx(area(outer) - sum(map(area, holes)), rel=1e-12)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert K.euler_characteristic == 1 - len(holes)


def test_poor_cells_get_points_and_others_none():
    thin = planar_domain(square(0, 0, 10), [square(4.9, 4.9, 0.2)])
    bare = planar_domain(square(0, 0, 10), [square(4.9, 4.9, 0.2)], angle=0)
    assert len(bare[0]) == 8
    smallest = np.degrees(angles(ip.DeltaComplex.from_mesh(*thin).lengths).min())
    assert smallest >= 25
    fine = planar_domain(square(0, 0, 10), area=0.5)
    assert areas(*fine).max() <= 0.5 + 1e-12


def test_input_of_all_kinds_is_the_same_domain():
    V, F = planar_domain(AITCH, [0.2 + 0.2j + 0.3 * ELL])
    pairs = [np.stack([z.real, z.imag], 1) for z in (AITCH, 0.2 + 0.2j + 0.3 * ELL)]
    closed = [np.vstack([ring, ring[:1]]) for ring in pairs]
    # As Shapely has it: rings that are closed, with a third coordinate or without.
    polygon = SimpleNamespace(
        exterior=SimpleNamespace(coords=[tuple(x) for x in closed[0]]),
        interiors=[SimpleNamespace(coords=[(*x, 7.0) for x in closed[1]])],
    )
    for surface in (planar_domain(pairs[0], pairs[1:]), planar_domain(polygon)):
        assert np.array_equal(surface[1], F)
        assert np.allclose(surface[0], V, atol=1e-15)


def test_either_orientation():
    V, F = planar_domain(AITCH[::-1], [0.2 + 0.2j + 0.3 * ELL[::-1]])
    assert areas(V, F).min() > 0


@pytest.mark.parametrize("scale", [1e-200, 1e150])
def test_any_size(scale):
    V, F = planar_domain(scale * square(0, 0, 4), [scale * square(1, 1, 1)])
    assert len(F) == len(planar_domain(square(0, 0, 4), [square(1, 1, 1)])[1])
    assert V.max() == 4 * scale


def test_many_corners_and_holes():
    holes = [square(x, y, 0.5) for x in range(12) for y in range(12)]
    V, F = planar_domain(square(-1, -1, 14), holes)
    assert ip.DeltaComplex.from_mesh(V, F).euler_characteristic == 1 - 144


OUTER = square(0, 0, 4)


@pytest.mark.parametrize(
    ("outer", "holes", "message"),
    [
        ([0, 1], [], "the outer boundary has 2 different corners"),
        (OUTER, [[1, 1, 1]], "hole 0 has 0 different corners"),
        (OUTER, [[1 + 1j, 2 + 1j, np.nan]], "hole 0 has corners that are not finite.* corner 2"),
        (OUTER, ["abc"], "hole 0 must be corners"),
        (OUTER, [3], "hole 0 is not a list of corners"),
        (np.ones((4, 5)), [], r"the outer boundary must be .* not an array of shape \(4, 5\)"),
        ([0, 2, 2j, 2 + 2j], [], r"meets itself at \(1, 1\)"),
        (OUTER, [square(3, 1, 2)], r"meets itself at \(4, [13]\)"),
        (OUTER, [square(2, 1, 2)], r"meets itself at \(4, [13]\)"),
        (OUTER, [square(1, 1, 1), square(2, 2, 1)], r"meets itself at \(2, 2\)"),
        (OUTER, [square(5, 5, 1)], r"hole 0 is not inside .* corner \(5, 5\)"),
        (OUTER, [square(1, 1, 2), square(1.5, 1.5, 1)], r"hole 1 is inside of hole 0"),
        (OUTER, [[1 + 1j, 2 + 1j, 3 + 1j]], r"runs back along itself at \([13], 1\)"),
        ([0, 4, 4 + 4j, 4j, 2j, 2 + 2j, 2j + 1e-14], [], r"runs back along itself at \(2, 2\)"),
    ],
)  # fmt: skip
def test_what_is_no_domain_is_refused_with_its_place(outer, holes, message):
    with pytest.raises(ip.MeshError, match=message):
        planar_domain(outer, holes)


def test_options_out_of_range():
    with pytest.raises(ValueError, match=r"angle = 40: .* from 0 to 30 degrees"):
        planar_domain(OUTER, angle=40)
    with pytest.raises(ValueError, match="area = 0: the largest area"):
        planar_domain(OUTER, area=0)
