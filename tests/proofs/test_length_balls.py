"""Lengths in balls, carried through changes of the triangulation, against 300 bits."""

import dataclasses

import flint
import numpy as np
import pytest
from flint import arb
from scipy.sparse import csr_array
from support.ball_arithmetic import BITS
from support.energies_in_300_bits import flipped_surface
from support.random_surfaces import noisy_torus, random_gluing, random_lengths

import igl_periods as ip
from igl_periods.complexes import insert_barycentres, split
from igl_periods.complexes.delaunay import delaunay_flips
from igl_periods.proofs import length_balls
from igl_periods.proofs.length_balls import (
    after_barycentres,
    after_flips,
    after_midpoints,
    lengths_of_edges,
    stored_lengths,
)
from igl_periods.proofs.midpoint_radius import Balls


def no_cochains(K):
    return csr_array((0, K.n_edges), dtype=np.int64)


def gluing(n_faces, seed):
    rng = np.random.default_rng(seed)
    twin = random_gluing(n_faces, rng)
    parts = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()
    return max(parts, key=lambda part: part.n_faces)


def contained(balls, exact):
    return all(
        arb(m, r).contains(x)
        for m, r, x in zip(balls.mid.tolist(), balls.rad.tolist(), exact, strict=True)
    )


def sheared_strip(k):
    """Two triangles on a torus, sheared k times: they need about k flips, one after the other."""
    lengths = [(np.hypot(k - 1, 1), np.hypot(k, 1), 1), (1, np.hypot(k - 1, 1), np.hypot(k, 1))]
    # Half-edge 3 f + s; the two triangles make one parallelogram, glued to a torus.
    twin = [[4, 5, 3], [2, 0, 1]]
    lengths[1] = (lengths[0][2], lengths[0][0], lengths[0][1])
    return ip.DeltaComplex.from_gluing(lengths, twin)


SURFACES = {
    "noisy torus": ip.DeltaComplex.from_mesh(*noisy_torus(8, 6, 0.35, 0)),
    "gluing": gluing(60, 0),
    "sheared": sheared_strip(40),
}


@pytest.mark.parametrize("sharpened", [True, False])
@pytest.mark.parametrize("name", SURFACES)
def test_lengths_of_flipped_edges_are_contained(name, sharpened, monkeypatch):
    if not sharpened:
        monkeypatch.setattr(length_balls, "_SHARPENED", ())
    K = SURFACES[name]
    _, rounds = delaunay_flips(K)
    assert rounds
    if name == "sheared" and not sharpened:
        with pytest.raises(ip.ComplexError, match="rounding hides whether 2 edges can be flipped"):
            after_flips(stored_lengths(K), rounds)
        return
    balls = after_flips(stored_lengths(K), rounds)
    exact = flipped_surface(K, no_cochains(K), rounds).lengths
    assert contained(balls, exact)
    if sharpened:
        assert np.all(balls.rad <= 2.0**-49 * balls.mid)


def test_sharpening_pays_after_many_flips(monkeypatch):
    K = sheared_strip(10)
    _, rounds = delaunay_flips(K)
    assert len(rounds) > 5
    sharp = after_flips(stored_lengths(K), rounds)
    monkeypatch.setattr(length_balls, "_SHARPENED", ())
    assert after_flips(stored_lengths(K), rounds).rad.max() > 100 * sharp.rad.max()


def test_lengths_that_are_not_exact_stay_contained():
    # Exact lengths at the ends of the balls one starts with.
    K = SURFACES["noisy torus"]
    _, rounds = delaunay_flips(K)
    stored = stored_lengths(K)
    start = Balls(stored.mid, 1e-9 * stored.mid)
    balls = after_flips(start, rounds)
    for t in (-1e-9, 1e-9):
        scaled = dataclasses.replace(K, lengths=K.lengths * (1 + 0.99 * t))
        assert contained(balls, flipped_surface(scaled, no_cochains(K), rounds).lengths)
    assert np.all(balls.rad >= 1e-9 * balls.mid * (1 - 1e-6))


def test_flips_that_are_impossible_are_refused():
    # A Delaunay triangulation with a reflex quadrilateral: its diagonal lies outside.
    V = [[0, 0, 0], [4, 0, 0], [1, 0.2, 0], [1, -6, 0], [1, 0, 5]]
    F = [[0, 1, 2], [1, 0, 3], [0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4]]
    K = ip.DeltaComplex.from_mesh(V, F)
    _, rounds = delaunay_flips(SURFACES["noisy torus"])
    first = int(K.edge[0, 1])
    around = {name: np.array([int(K.edge[f, s])]) for name, f, s in
              (("second", 0, 0), ("third", 0, 2), ("first", 2, 0), ("fourth", 2, 1))}  # fmt: skip
    impossible = dataclasses.replace(rounds[0], edge=np.array([first]), **around)
    with pytest.raises(ip.ComplexError, match="rounding hides whether 1 edge can be flipped"):
        after_flips(stored_lengths(K), [impossible])


@pytest.mark.parametrize("name", SURFACES)
def test_midpoints_halve_lengths(name):
    K = SURFACES[name]
    finer, _ = split(K, no_cochains(K))
    balls = after_midpoints(K, stored_lengths(K))
    assert np.array_equal(balls.mid[finer.edge], finer.lengths)
    assert np.all(balls.rad <= 2.0**-900)


@pytest.mark.parametrize("name", SURFACES)
def test_distances_of_barycentres_are_contained(name):
    flint.ctx.prec = BITS
    K = SURFACES[name]
    faces = np.random.default_rng(0).permutation(K.n_faces)[: max(K.n_faces // 2, 1)]
    finer, _ = insert_barycentres(K, no_cochains(K), faces)
    balls = after_barycentres(K, stored_lengths(K), faces)
    exact = [arb(x) for x in stored_lengths(K).mid.tolist()]
    for row in K.lengths[faces].tolist():
        a, b, c = (arb(x) ** 2 for x in row)
        exact += [x.sqrt() / 3 for x in (2 * b + 2 * c - a, 2 * c + 2 * a - b, 2 * a + 2 * b - c)]
    assert contained(balls, exact)
    assert np.allclose(balls.mid[finer.edge], finer.lengths, rtol=1e-13)
    assert np.all(balls.rad < 1e-13 * balls.mid)


def test_glued_sides_must_have_the_same_length():
    K = SURFACES["gluing"]
    lengths = K.lengths.copy()
    lengths[0, 0] = np.nextafter(lengths[0, 0], 2.0)
    with pytest.raises(ip.ComplexError, match="glued sides must have exactly the same length"):
        stored_lengths(dataclasses.replace(K, lengths=lengths))


def with_exact_lengths(K, exact):
    exactly = dataclasses.replace(K)
    object.__setattr__(exactly, "exact_lengths", exact)
    return exactly


def test_exact_lengths_are_contained_beside_the_stored_ones():
    K = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], 2)
    stored = stored_lengths(K)

    def exact(bits):
        with flint.ctx.workprec(bits):
            return [arb(m) if m == 0.5 else arb(0.5).sqrt() for m in stored.mid.tolist()]

    balls = lengths_of_edges(with_exact_lengths(K, exact))
    assert contained(balls, exact(BITS))
    assert np.array_equal(balls.mid, stored.mid)
    assert 1e-17 < balls.rad.max() < 1e-16
    assert not lengths_of_edges(with_exact_lengths(K, None)).rad.any()
    # A mollified surface is another one.
    mollified = dataclasses.replace(K, mollification=1e-9)
    assert not lengths_of_edges(with_exact_lengths(mollified, exact)).rad.any()


@pytest.mark.parametrize("wrong", [1.001, np.nan])
def test_exact_lengths_of_another_surface_are_refused(wrong):
    K = SURFACES["gluing"]
    other = with_exact_lengths(K, lambda bits: [arb(wrong * m) for m in stored_lengths(K).mid])
    with pytest.raises(ip.ComplexError, match="they are lengths of different surfaces"):
        lengths_of_edges(other)
