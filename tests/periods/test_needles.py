"""Needles and caps: a finite certified result that contains the right one, or a clear refusal.

A coarse torus gets vertices 1e-9 … 1e-13 from others, on a face or beside them, and vertices so
close to a side that the angle there is π up to 1e-12.  Without them its period matrix is known.
"""

import warnings

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.periods.adaptive_degree import ToleranceWarning

# What moving vertices by 1e-9, and lengthening all sides by 1e-13 of them (mollification), does.
MOVED, MOLLIFIED = 1e-7, 1e-4


def coarse_torus(rng, n=4, m=3):
    a, b = np.meshgrid(*(2 * np.pi * np.arange(k) / k for k in (n, m)), indexing="ij")
    r = rng.uniform(1.5, 4.0) + np.cos(b)
    V = np.stack([r * np.cos(a), r * np.sin(a), np.sin(b)], axis=-1).reshape(-1, 3)
    corner = np.arange(n * m).reshape(n, m)
    right, up = np.roll(corner, -1, 0), np.roll(corner, -1, 1)
    both = np.roll(right, -1, 1)
    F = np.stack([corner, right, both, corner, both, up], axis=-1).reshape(-1, 3)
    return V + rng.uniform(0.0, 0.3) * rng.normal(size=V.shape), F


def with_vertex_in_face(V, F, point, f):
    a, b, c = F[f]
    n = len(V)
    return np.vstack([V, point]), np.vstack([np.delete(F, f, 0), [[a, b, n], [b, c, n], [c, a, n]]])


def random_corner(V, F, rng):
    f = rng.integers(len(F))
    a, b, c = np.roll(F[f], rng.integers(3))
    return f, V[a], V[b] - V[a], V[c] - V[a], rng.uniform(0.05, 0.95)


def needle(V, F, rng):
    """A vertex in a face, at a corner."""
    f, corner, one, other, t = random_corner(V, F, rng)
    size = 10.0 ** -rng.uniform(9, 13)
    return with_vertex_in_face(V, F, corner + size * ((1 - t) * one + t * other), f)


def cap(V, F, rng):
    """A vertex in a face, at a side."""
    f, corner, one, other, t = random_corner(V, F, rng)
    return with_vertex_in_face(V, F, corner + t * one + 10.0 ** -rng.uniform(3, 12) * other, f)


def twins(V, F, rng):
    """A vertex becomes two; two needles lie between them."""
    # Three faces at a vertex are too few for two needles between them.
    a, n = rng.choice(np.flatnonzero(np.bincount(F.ravel()) > 3)), len(V)
    around = {}
    for f in np.flatnonzero((F == a).any(axis=1)):
        _, b, c = np.roll(F[f], -int(np.argmax(F[f] == a)))
        around[b] = (c, f)
    ring = [next(iter(around))]
    while len(ring) < len(around):
        ring.append(around[ring[-1]][0])
    start, k = rng.integers(len(ring)), rng.integers(2, len(ring) - 1)
    F = F.copy()
    for i in range(k):
        f = around[ring[(start + i) % len(ring)]][1]
        F[f] = np.where(F[f] == a, n, F[f])
    b, c = ring[start], ring[(start + k) % len(ring)]
    point = V[a] + 10.0 ** -rng.uniform(9, 13) * rng.normal(size=3)
    return np.vstack([V, point]), np.vstack([F, [[b, n, a], [n, c, a]]])


def surface_and_reference(seed):
    rng = np.random.default_rng(seed)
    V, F = coarse_torus(rng)
    reference = ip.period_matrix(V, F, degree=8)
    for _ in range(rng.integers(1, 4)):
        V, F = (needle, cap, twins)[rng.integers(3)](V, F, rng)
    return V, F, reference


def options(seed):
    rng = np.random.default_rng([seed, 1])
    yield {"degree": int(rng.integers(2, 17))}
    yield {"degree": int(rng.integers(2, 9)), "delaunay": False}
    yield {"tolerance": 10.0 ** -rng.uniform(2, 8)}


def check_containment(pm, reference):
    assert np.isfinite(pm.matrix).all()
    assert np.isfinite(pm.bound)
    uncertain = MOLLIFIED if pm.complex.mollification else MOVED
    t = np.log1p(pm.bound) + np.log1p(reference.bound) + uncertain
    if t < np.log(2):
        assert ip.symplectic_isomorphisms(pm.matrix, reference.matrix, t), (pm, reference)


def judge(seed):
    """How many results there are, all of them right; the others are refused with a sentence."""
    V, F, reference = surface_and_reference(seed)
    results = 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.simplefilter("ignore", ToleranceWarning)
        for chosen in options(seed):
            try:
                pm = ip.period_matrix(V, F, **chosen)
            except ip.ComplexError as error:
                assert "degenerate" in str(error) or "too" in str(error), error  # noqa: PT017
            else:
                check_containment(pm, reference)
                results += 1
    return results


def test_surfaces_with_needles_and_caps():
    seeds = range(6)
    assert sum(judge(seed) for seed in seeds) > 0.95 * 3 * len(seeds)


@pytest.mark.slow
@pytest.mark.parametrize("part", range(10))
def test_ten_thousand_results_on_needles_and_caps(part):
    seeds = range(1000 + 334 * part, 1334 + 334 * part)
    assert sum(judge(seed) for seed in seeds) > 0.95 * 3 * len(seeds)


def beside_a_vertex(distance):
    """The flat torus of aspect about 3 in space, with a vertex beside another one."""
    V, F = coarse_torus(np.random.default_rng(3))
    n = len(V)
    reference = ip.period_matrix(V, F, degree=8)
    point = V[F[0, 0]] + distance * (
        0.6 * (V[F[0, 1]] - V[F[0, 0]]) + 0.3 * (V[F[0, 2]] - V[F[0, 0]])
    )
    V, F = with_vertex_in_face(V, F, point, 0)
    assert len(V) == n + 1
    return V, F, reference


@pytest.mark.parametrize("distance", [1e-9, 1e-10, 1e-11, 1e-12])
def test_a_tolerance_is_met_beside_a_vertex(distance):
    # Barycentres of needles made triangles without area, and NaN.
    V, F, reference = beside_a_vertex(distance)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ToleranceWarning)
        pm = ip.period_matrix(V, F, tolerance=1e-4)
    check_containment(pm, reference)
    assert pm.bound < 3e-4
