"""Needles, caps, sides of very different length, many components: bounds stay true.

A bound is checked against what is known otherwise.  A torus of congruent triangles is flat whatever
their floating-point sides are, and its modulus follows from them exactly; an origami that is
sheared along all its cylinders is the same surface; faces divided at points near their corners and
sides are the same surface too, with more functions on it, hence less energy.
"""

from itertools import pairwise
from math import lcm

import flint
import numpy as np
import pytest
from flint import acb, arb
from support.result_checks import check_result

import igl_periods as ip
from igl_periods.complexes.glued_squares import squares
from igl_periods.surfaces import (
    glued_rectangles,
    menger_sponge,
    square_tiled_surface,
    thickened_lattice,
)
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.cohomology import pairing

BITS = 400


def parallelograms(gluing, right, up, diagonal):
    """Parallelograms with these sides and this diagonal, glued like squares."""
    _, twin = squares(gluing, 1)
    lengths = np.empty(twin.shape)
    lengths[0::2], lengths[1::2] = (up, diagonal, right), (right, up, diagonal)
    return ip.DeltaComplex.from_gluing(lengths, twin)


def translations(right, up):
    pairs = [((k, 1), (r, 3)) for k, r in enumerate(np.ravel(right).tolist())]
    return pairs + [((k, 2), (u, 0)) for k, u in enumerate(np.ravel(up).tolist())]


def torus(n, m, shape):
    """The torus of n × m parallelograms with sides 1 and shape, and its modulus to 100 digits."""
    cell = np.arange(n * m).reshape(n, m)
    gluing = translations(np.roll(cell, -1, 0), np.roll(cell, -1, 1))
    K = parallelograms(gluing, 1.0, abs(shape), abs(1.0 + shape))
    flint.ctx.prec = BITS
    up, diagonal, right = (arb(x) for x in K.lengths[0].tolist())
    x = (diagonal**2 - right**2 - up**2) / (2 * right)
    return K, acb(x, (up**2 - x**2).sqrt()) * m / (right * n)


def in_fundamental_domain(tau):
    while True:
        tau -= (tau.real + arb(0.5)).floor().unique_fmpz()
        if (tau.real**2 + tau.imag**2).mid() >= 1 - 1e-30:
            return tau
        tau = -1 / tau


def relative_error(pm, tau):
    """|Π − τ| / Im Π in the best of the markings at the boundary of the fundamental domain."""
    tau, found = in_fundamental_domain(tau), pm.matrix[0, 0]
    nearest = [tau, tau + 1, tau - 1, -1 / tau, 1 - 1 / tau, -1 - 1 / tau]
    return min(abs(complex(candidate) - found) for candidate in nearest) / found.imag


def check_torus(n, m, shape, **options):
    K, tau = torus(n, m, shape)
    pm = ip.period_matrix(K, **options).reduced()
    # The holomorphic form is linear on every triangle: all of the bound is owed to rounding.
    assert relative_error(pm, tau) <= pm.bound
    return K, pm


SHAPES = {
    "needles": 0.37 + 1e4j,
    "thinner needles": 0.37 + 1e6j,
    "caps": -0.37 + 1e-4j,
    "flatter caps": -0.37 + 2e-6j,
    "sheared needles": 300.3 + 0.9j,
    "sheared caps": 30.3 + 3e-3j,
}


@pytest.mark.parametrize("options", [{}, {"delaunay": False}, {"degree": 3}], ids=str)
@pytest.mark.parametrize("name", SHAPES)
def test_tori_of_extreme_triangles(name, options):
    K, pm = check_torus(3, 2, SHAPES[name], **options)
    assert K.mollification == 0
    assert pm.bound < 0.05


@pytest.mark.parametrize("seed", range(30))
def test_tori_of_random_extreme_triangles(seed):
    rng = np.random.default_rng(seed)
    shape = complex(rng.uniform(-2, 2), 10.0 ** rng.uniform(-4, 6))
    options = [{}, {"delaunay": False}, {"degree": 2}, {"degree": 4, "delaunay": False}][seed % 4]
    check_torus(*rng.integers(1, 5, 2), shape, **options)


def test_what_is_mollified_is_computed_for_the_lengths_that_are_stored():
    K, pm = check_torus(2, 3, -0.3 + 1e-9j)
    assert 0 < K.mollification < 1e-11
    assert pm.bound < 1


def test_what_lengths_cannot_say_is_refused():
    # The sides 1, 1e17, 1e17 + 1/2, whose last digits are lost.
    with pytest.raises(ip.ComplexError, match="too extreme for double precision"):
        ip.period_matrix(torus(2, 2, 1e17 + 1j)[0])


@pytest.mark.slow
@pytest.mark.parametrize("name", SHAPES)
def test_hundred_thousand_extreme_triangles(name):
    K, pm = check_torus(250, 200, SHAPES[name])
    assert K.n_faces == 100_000
    assert pm.bound < 0.05


def random_origami(n, seed):
    """A connected origami of genus 2 or 3, and the shear that all its cylinders have in common."""
    for k in range(1000):
        rng = np.random.default_rng([seed, k])
        right, up = rng.permutation(n), rng.permutation(n)
        parts = ip.DeltaComplex.from_squares(translations(right, up)).components()
        if len(parts) == 1 and parts[0].genus in (2, 3):
            lengths = [len(cycle) for cycle in cycles(right)]
            return translations(right, up), lcm(*lengths)
    raise AssertionError("there are such origamis")


def cycles(permutation):
    left = set(range(len(permutation)))
    while left:
        cycle = [left.pop()]
        while (k := int(permutation[cycle[-1]])) != cycle[0]:
            left.discard(k)
            cycle.append(k)
        yield cycle


def check_shear(gluing, twist):
    """The squares sheared by a multiple of all cylinders: another triangulation of the surface."""
    shape = complex(twist, 1)
    K = parallelograms(gluing, 1.0, abs(shape), abs(1.0 + shape))
    plain = ip.DeltaComplex.from_squares(gluing)
    assert np.degrees(1 / twist**2) > 2 * np.degrees(angles_of(K).min()) / 3
    for degree in (1, 6):
        sheared, expected = (ip.period_matrix(L, degree=degree) for L in (K, plain))
        check_result(sheared)
        # Flips lead back to the squares.
        rounding = sheared.rounding_allowance + expected.rounding_allowance
        assert abs(sheared.bound - expected.bound) <= 1e-4 * expected.bound + 1.01 * rounding
    assert sheared.bound < 0.2
    # None at all would be a theorem: that the surfaces are different.
    assert ip.symplectic_isomorphisms(sheared, expected, limit=1)


def angles_of(K):
    a, b, c = np.sort(K.lengths, axis=1).T
    height = np.sqrt((a + (b + c)) * (a - (c - b)) * (a + (c - b)) * (c + (b - a))) / 2
    return height / (b * c)


@pytest.mark.parametrize("seed", range(4))
def test_origamis_sheared_along_their_cylinders(seed):
    gluing, period = random_origami(5 + seed % 2, seed)
    check_shear(gluing, period * (60 // period))


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_origamis_sheared_to_needles_of_1e_5_degrees(seed):
    gluing, period = random_origami(5 + seed % 3, seed)
    check_shear(gluing, period * (2400 // period))


def divided(K, faces, weights):
    """Divide faces at the points with these barycentric coordinates.

    Returns
    -------
    L : DeltaComplex
    image : (3 m,) int
        The half-edge of ``L`` that each half-edge of ``K`` has become.
    """
    m = K.n_faces
    first = np.arange(m)
    chosen = np.zeros(m, dtype=bool)
    chosen[faces] = True
    # Part s of a face has the new vertex, corner s + 1 and corner s + 2; part 0 keeps the number.
    part = np.stack([first, *(first + k for k in (0, 0))], axis=1)
    part[faces, 1] = m + 2 * np.arange(faces.size)
    part[faces, 2] = part[faces, 1] + 1
    image = np.where(chosen[:, None], 3 * part, 3 * first[:, None] + np.arange(3)).ravel()
    twin = np.empty(3 * (m + 2 * faces.size), dtype=np.int64)
    twin[image] = image[K.twin.ravel()]
    lengths = np.empty(twin.size)
    lengths[image] = K.lengths.ravel()
    spokes = distances(K.lengths[faces], weights)
    for s in range(3):
        here, there = 3 * part[faces, s] + 1, 3 * part[faces, (s + 1) % 3] + 2
        twin[here], twin[there] = there, here
        lengths[here] = lengths[there] = spokes[:, (s + 2) % 3]
    return ip.DeltaComplex.from_gluing(lengths.reshape(-1, 3), twin.reshape(-1, 3)), image


def distances(lengths, weights):
    """Distance of a point from each corner: with v and w along sides c and b from corner a."""
    result = np.empty(lengths.shape)
    for s in range(3):
        v, w = weights[:, s - 2], weights[:, s - 1]
        a, b, c = lengths[:, s], lengths[:, s - 2], lengths[:, s - 1]
        result[:, s] = np.sqrt((v * c - w * b) ** 2 + v * w * (b + c - a) * (b + c + a))
    return result


def with_needles(K, share, thinnest, seed):
    """Faces divided near corners and near sides, three times over; the last ``image`` of all."""
    rng = np.random.default_rng(seed)
    total = np.arange(3 * K.n_faces)
    for _ in range(3):
        faces = rng.choice(K.n_faces, int(share * K.n_faces), replace=False)
        small = 10.0 ** -rng.uniform(1, thinnest, faces.size)
        near_corner, near_side = (1 - 2 * small, small, small), (small, *2 * [(1 - small) / 2])
        kind = rng.integers(2, size=faces.size)
        weights = np.where(kind[:, None], np.column_stack(near_corner), np.column_stack(near_side))
        K, image = divided(K, faces, rng.permuted(weights, axis=1))
        total = image[total]
    return K, total


def check_needles(K, share, thinnest):
    """Less energy, but not less than the certificate allows; the same Π within both bounds."""
    L, image = with_needles(K, share, thinnest, 0)
    pm, finer = ip.period_matrix(K, delaunay=False), ip.period_matrix(L)
    if K.genus < 30:
        check_result(finer)
    # Classes of L in terms of those of K: their values on the edges of K are closed.
    half_edge = np.flatnonzero(K.sign.ravel() > 0)
    there = image[half_edge[np.argsort(K.edge.ravel()[half_edge])]]
    on_K = finer.cocycles[:, L.edge.ravel()[there]].multiply(L.sign.ravel()[there]).tocsr()
    J = standard_form(K.genus)
    U = pairing(K, on_K, pm.cocycles) @ -J
    assert np.array_equal(U @ J @ U.T, J)
    D, D_finer = U @ pm.dirichlet @ U.T, finer.dirichlet
    moved = pm.change_basis(conjugated(U))
    np.testing.assert_allclose(moved.dirichlet, D, rtol=0, atol=1e-9 * np.abs(D).max())
    rounding = moved.rounding_allowance + finer.rounding_allowance
    assert rounding < 0.02
    # J D⁻¹ Jᵀ ≤ exact ≤ finer D ≤ D, relative to D.
    assert excess(D, D_finer) >= -rounding
    assert excess(D_finer, J @ np.linalg.inv(D) @ J.T) >= -rounding
    assert np.all(np.abs(moved.matrix - finer.matrix) <= moved.entry_bounds + finer.entry_bounds)
    return finer


def excess(A, B):
    """The least eigenvalue of A − B relative to A."""
    whiten = np.linalg.inv(np.linalg.cholesky(A))
    return np.linalg.eigvalsh(np.eye(len(A)) - whiten @ B @ whiten.T)[0]


def conjugated(U):
    """K U K, K = diag(1, −1): from the action on forms to that on the half-space."""
    sign = np.repeat([1, -1], len(U) // 2)
    return sign[:, None] * U * sign


@pytest.mark.parametrize("thinnest", [2, 5])
def test_the_same_surface_with_and_without_needles(thinnest):
    check_needles(ip.DeltaComplex.from_mesh(*menger_sponge(1, 3, jitter=0.15)), 0.3, thinnest)


def test_needles_at_cone_points_of_an_origami():
    for n in (1, 4):
        check_needles(square_tiled_surface("omega_1", n), 0.5, 4)


@pytest.mark.slow
@pytest.mark.parametrize("thinnest", [3, 6])
def test_a_surface_of_genus_81_with_and_without_needles(thinnest):
    K = ip.DeltaComplex.from_mesh(*menger_sponge(2, 4, jitter=0.15))
    finer = check_needles(K, 0.6, thinnest)
    assert finer.complex.n_faces > 100_000


@pytest.mark.slow
def test_a_lattice_of_genus_216_with_and_without_needles():
    K = ip.DeltaComplex.from_mesh(*thickened_lattice((6, 5, 5), 2, aspect=2, jitter=0.15))
    assert K.genus == 216
    check_needles(K, 0.4, 4)


def graded_rectangles(widths, heights):
    """Sizes and gluing of a torus of rectangles with these widths and heights."""
    cell = np.arange(len(widths) * len(heights)).reshape(len(widths), -1)
    sizes = np.stack(np.meshgrid(widths, heights, indexing="ij"), axis=-1).reshape(-1, 2)
    return sizes, translations(np.roll(cell, -1, 0), np.roll(cell, -1, 1))


@pytest.mark.parametrize("n", [8, pytest.param(223, marks=pytest.mark.slow)])
def test_sides_of_very_different_length(n):
    # Sides from 1e-6 to 1; the modulus is that of the whole rectangle.
    widths, heights = 10.0 ** np.linspace(-6, 0, n), 10.0 ** np.linspace(0, -6, n)
    K = glued_rectangles(*graded_rectangles(widths, heights))
    assert K.lengths.max() / K.lengths.min() > 1e6
    pm = ip.period_matrix(K).reduced()
    tau = acb(0, heights.sum() / widths.sum())
    # Diagonals are rounded to half an ulp, and a needle of 1e-6 makes 4e6 times as much of it.
    assert relative_error(pm, tau) <= pm.bound + 4e6 * 2.0**-53


def sides_of(K):
    return tuple(np.unique(K.lengths).tolist())


@pytest.mark.parametrize("n_components", [40, pytest.param(1000, marks=pytest.mark.slow)])
def test_many_components(n_components):
    # Tori of extreme triangles next to each other: each component has its own exact modulus.
    rng = np.random.default_rng(n_components)
    tori = [
        torus(4, 3, complex(rng.uniform(-1, 1), 10.0 ** rng.uniform(-3, 3)))
        for _ in range(n_components)
    ]
    starts = np.cumsum([0] + [K.twin.size for K, _ in tori])
    twin = np.concatenate([K.twin + start for (K, _), start in zip(tori, starts, strict=False)])
    lengths = np.concatenate([K.lengths for K, _ in tori])
    shuffled = np.random.default_rng(1).permutation(len(twin))
    place = np.argsort(shuffled)
    twin = (3 * place[twin // 3] + twin % 3)[shuffled]
    K = ip.DeltaComplex.from_gluing(lengths[shuffled], twin)
    with pytest.raises(ip.ComplexError, match=f"{n_components} components"):
        ip.period_matrix(K)
    parts = K.components()
    firsts = [int(np.flatnonzero((K.lengths == part.lengths[0]).all(axis=1))[0]) for part in parts]
    assert all(one < other for one, other in pairwise(firsts))
    modulus = {sides_of(L): tau for L, tau in tori}
    assert len(parts) == len(modulus) == n_components
    for part in parts:
        pm = ip.period_matrix(part).reduced()
        assert relative_error(pm, modulus[sides_of(part)]) <= pm.bound < 1e-3
