"""Thickened lattices and Menger's sponge: exact genus, embedded, with the symmetries they have."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import igl_periods as ip
from igl_periods.complexes.gluings import next_corner
from igl_periods.surfaces import menger_sponge, thickened_lattice, voxel_surface
from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.cohomology import pairing

SIDES = st.integers(1, 4)


def lattice_counts(a, b, c):
    """Nodes and struts."""
    return a * b * c, (a - 1) * b * c + a * (b - 1) * c + a * b * (c - 1)


def volume(V, F):
    a, b, c = V[F].transpose(1, 0, 2)
    return np.einsum("fd,fd->", a, np.cross(b, c)) / 6


def automorphism(K, vertex):
    """The edge permutation and signs of a permutation of the vertices of a simplicial complex."""
    half_edges = np.flatnonzero(K.sign.ravel() > 0)
    corners = K.corner_vertex.ravel()
    tail, head = corners[next_corner(half_edges)], corners[next_corner(half_edges, 2)]
    edge = {ends: e for e, ends in zip(K.edge.ravel()[half_edges], zip(tail, head))}
    moved = [(vertex[t], vertex[h]) for t, h in zip(tail, head)]
    image = np.empty(K.n_edges, dtype=np.int64)
    sign = np.empty(K.n_edges, dtype=np.int64)
    for e, (t, h) in zip(K.edge.ravel()[half_edges], moved):
        sign[e] = 1 if (t, h) in edge else -1
        image[e] = edge[(t, h)] if (t, h) in edge else edge[(h, t)]
    return image, sign


def action(pm, vertex):
    """S with σ*ω_i ~ Σ S_ij ω_j for the map σ of vertices; S J Sᵀ = ±J by orientation."""
    image, sign = automorphism(pm.complex, vertex)
    pulled_back = pm.cocycles[:, image].multiply(sign).tocsr()
    return pairing(pm.complex, pulled_back, pm.cocycles) @ -standard_form(pm.genus)


def turned(V):
    """The row of V at which each vertex arrives when the axes are exchanged cyclically."""
    where = {tuple(row): i for i, row in enumerate(V.tolist())}
    return np.array([where[z, x, y] for x, y, z in V.tolist()])


@settings(max_examples=30, deadline=None)
@given(shape=st.tuples(SIDES, SIDES, SIDES), n=st.integers(1, 2), aspect=st.integers(1, 3))
def test_lattices_have_the_genus_of_their_graph(shape, n, aspect):
    nodes, struts = lattice_counts(*shape)
    V, F = thickened_lattice(shape, n, aspect=aspect)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert K.genus == struts - nodes + 1
    assert len(F) == 2 * n**2 * (6 * nodes - 2 * struts + 4 * struts * aspect)
    assert volume(V, F) == n**3 * (nodes + struts * aspect)


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize(("level", "genus"), [(0, 0), (1, 5), (2, 81), (3, 1409)])
def test_sponges_have_their_genus(level, genus, n):
    V, F = menger_sponge(level, n)
    assert ip.DeltaComplex.from_mesh(V, F).genus == genus
    assert (21 * 20**level + 38 * 8**level - 59) / 133 == genus
    assert len(F) == 2 * n**2 * (2 * 20**level + 4 * 8**level)
    assert volume(V, F) == n**3 * 20**level


def test_a_sponge_of_level_one_is_a_lattice():
    for one, other in zip(menger_sponge(1, 2), thickened_lattice((2, 2, 2), 2), strict=True):
        assert np.array_equal(one, other)


def test_genus_600_with_100_000_faces():
    V, F = thickened_lattice((8, 7, 7), 2, aspect=3, jitter=0.1)
    assert ip.DeltaComplex.from_mesh(V, F).genus == 624
    assert len(F) == 100_016


def test_jitter_changes_neither_the_surface_nor_its_embedding():
    V, F = thickened_lattice((3, 2, 2), 2)
    W, G = thickened_lattice((3, 2, 2), 2, jitter=0.16, seed=3)
    assert np.array_equal(F, G)
    assert 0.15 < np.abs(W - V).max() <= 0.16
    assert not np.array_equal(W, thickened_lattice((3, 2, 2), 2, jitter=0.16, seed=4)[0])
    # An embedded surface has the winding number 1 in the centres of filled cells, 0 in others.
    cells = np.stack(
        np.meshgrid(*(np.arange(-1, n + 1) + 0.5 for n in (10, 6, 6)), indexing="ij"), -1
    )
    winding = [solid_angle(W[F] - point) / (4 * np.pi) for point in cells.reshape(-1, 3)]
    inside = np.round(winding)
    assert np.abs(winding - inside).max() < 1e-12
    assert set(inside) == {0, 1}
    assert inside.sum() == volume(V, F)


def solid_angle(triangles):
    """Van Oosterom and Strackee's formula, summed over triangles seen from the origin."""
    a, b, c = triangles.transpose(1, 0, 2)
    x, y, z = (np.linalg.norm(corner, axis=1) for corner in (a, b, c))
    triple = np.einsum("fd,fd->f", a, np.cross(b, c))
    dots = [np.einsum("fd,fd->f", one, other) for one, other in ((a, b), (b, c), (c, a))]
    return 2 * np.sum(np.arctan2(triple, x * y * z + dots[0] * z + dots[1] * x + dots[2] * y))


@pytest.mark.parametrize("surface", [menger_sponge(1, 2), thickened_lattice((3, 3, 3))])
def test_period_matrices_have_the_symmetry(surface):
    V, F = surface
    pm = ip.period_matrix(V, F)
    S = action(pm, turned(V))
    J = standard_form(pm.genus)
    assert np.array_equal(S @ J @ S.T, J)
    assert np.array_equal(S @ S @ S, np.eye(2 * pm.genus))
    assert not np.array_equal(S, np.eye(2 * pm.genus))
    assert np.abs(S @ pm.dirichlet @ S.T - pm.dirichlet).max() < 1e-12
    assert np.abs(ip.siegel_transform(conjugated(S), pm) - pm.matrix).max() < 1e-12


def conjugated(S):
    """K S K, K = diag(1, −1): from the action on forms to that on the half-space."""
    g = len(S) // 2
    K = np.diag(np.repeat([1, -1], g))
    return K @ S @ K


def test_jitter_breaks_the_symmetry():
    V, F = menger_sponge(1, 2)
    moved, _ = menger_sponge(1, 2, jitter=0.15, seed=1)
    pm = ip.period_matrix(moved, F)
    S = action(pm, turned(V))
    assert np.abs(S @ pm.dirichlet @ S.T - pm.dirichlet).max() > 1e-3


def test_wrong_arguments_are_refused():
    pinched = np.zeros((2, 2, 1), dtype=bool)
    pinched[0, 0] = pinched[1, 1] = True
    with pytest.raises(
        ip.MeshError, match=r"pinched at 2 corners of the grid, the first at \(1, 1, 0\)"
    ):
        voxel_surface(pinched)
    with pytest.raises(ip.MeshError, match="some cells of"):
        voxel_surface(np.zeros((2, 2, 2)))
    with pytest.raises(ip.MeshError, match="some cells of"):
        voxel_surface([True])
    with pytest.raises(ip.MeshError, match="0 <= jitter < 1/6"):
        menger_sponge(1, jitter=1 / 6)
    with pytest.raises(ip.MeshError, match="three numbers of nodes"):
        thickened_lattice((2, 2))
    for arguments in [((2, 0, 2),), ((2, 2, 2), 1.5), ((2, 2, 2), 0)]:
        with pytest.raises(ip.MeshError, match="a whole number >= 1"):
            thickened_lattice(*arguments)
    with pytest.raises(ip.MeshError, match="a whole number >= 0"):
        menger_sponge(-1)
    for oversized in (lambda: menger_sponge(9), lambda: thickened_lattice((10**9, 10**9, 10**9))):
        with pytest.raises(ip.MeshError, match="cells, and up to"):
            oversized()
