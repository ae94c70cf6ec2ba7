"""Cells of periodic surfaces and what they are glued to."""

import logging

import igl
import numpy as np
import pytest
from support.flat_surfaces import grid

import igl_periods as ip
from igl_periods.complexes.lattices import lattice_gluing
from igl_periods.moduli.equivalence import symplectic_isomorphisms


def cell(n, m, u, v, seed=None):
    """The parallelogram of u and v in n × m cells, inner vertices displaced."""
    i, j = np.meshgrid(np.arange(n + 1), np.arange(m + 1), indexing="ij")
    x, y = i / n, j / m
    if seed is not None:
        rng = np.random.default_rng(seed)
        inner = (i > 0) & (i < n) & (j > 0) & (j < m)
        x = x + inner * rng.uniform(-0.3, 0.3, x.shape) / n
        y = y + inner * rng.uniform(-0.3, 0.3, y.shape) / m
    V = x.ravel()[:, None] * np.asarray(u) + y.ravel()[:, None] * np.asarray(v)
    return V, grid(n, m)


@pytest.mark.parametrize("seed", range(6))
def test_flat_tori_in_space(seed):
    rng = np.random.default_rng(seed)
    L = rng.normal(size=(2, 3))
    V, F = cell(4, 3, *L, seed)
    K = ip.DeltaComplex.from_mesh(rng.permutation(9)[0] + V, F, lattice=L)
    assert K.genus == 1
    assert K.positions is None
    w = np.linalg.qr(L.T)[0].T @ L.T
    tau = complex(*w[:, 1]) / complex(*w[:, 0])
    tau = tau if tau.imag > 0 else tau.conjugate()
    pm = ip.period_matrix(K)
    assert symplectic_isomorphisms([[tau]], pm, tolerance=1e-10) or symplectic_isomorphisms(
        [[-tau.conjugate()]], pm, tolerance=1e-10
    )


def test_a_cell_with_a_single_vertex():
    V, F = cell(1, 1, [1, 0], [0.3, 0.8])
    K = ip.DeltaComplex.from_mesh(V, F, lattice=[[1, 0], [0.3, 0.8]])
    assert (K.n_vertices, K.n_edges, K.genus) == (1, 3, 1)
    assert K.labels.tolist() == [0]
    pm = ip.period_matrix(K)
    assert symplectic_isomorphisms([[0.3 + 0.8j]], pm, tolerance=1e-12)


def test_other_generators_and_translated_parts_are_the_same_lattice():
    L = np.array([[1.0, 0.0], [0.3, 0.8]])
    V, F = cell(4, 3, *L, 1)
    # Half of the faces elsewhere, with corners of their own.
    far = np.where(np.arange(len(F)) % 2, 1, 0)
    corners = V[F] + (far[:, None] * (3 * L[0] - 2 * L[1]))[:, None]
    soup = corners.reshape(-1, 2), np.arange(3 * len(F)).reshape(-1, 3)
    one = ip.DeltaComplex.from_mesh(V, F, lattice=L)
    other = ip.DeltaComplex.from_mesh(*soup, lattice=np.array([[2, 1], [1, 1]]) @ L)
    assert (one.n_vertices, one.n_edges) == (other.n_vertices, other.n_edges)
    assert ip.siegel_distance(
        ip.period_matrix(one).reduced(), ip.period_matrix(other).reduced()
    ) == pytest.approx(0, abs=1e-9)


def test_one_translation_leaves_a_boundary():
    V, F = cell(4, 3, [2, 0], [0, 1], 2)
    K = ip.DeltaComplex.from_mesh(V, F, lattice=[2, 0])
    assert K.n_boundary_edges == 8
    assert ip.capacity_matrix(K).matrix[1, 1] == pytest.approx(2, rel=1e-11)


def test_wrapped_meshes_have_minimal_images():
    L = np.array([[1.0, 0, 0], [0.4, 0.9, 0.2]])
    V, F = cell(5, 4, *L, 3)
    name = np.arange(6)[:, None] % 5 * 4 + np.arange(5) % 4
    wrapped = name.ravel()[F]
    rows = V.reshape(6, 5, 3)[:5, :4].reshape(-1, 3)
    whole = ip.DeltaComplex.from_mesh(V, F, lattice=L)
    K = ip.DeltaComplex.from_mesh(rows, wrapped, lattice=L)
    assert np.allclose(K.lengths, whole.lengths, rtol=1e-13)
    assert (K.n_vertices, K.genus) == (20, 1)
    assert lattice_gluing(rows, wrapped, L).n_glued > 0


def test_faces_turned_over_are_glued_as_they_are():
    V, F = cell(4, 4, [1, 0], [0, 1], 1)
    mirrored = V * [1, -1] + [1, 1]
    both = np.vstack([V, mirrored])
    K = ip.DeltaComplex.from_mesh(both, np.vstack([F, F + len(V)]), lattice=[[2, 0], [0, 1]])
    assert K.n_reversing_edges > 0
    assert K.n_boundary_edges == 0
    assert ip.complexes.is_orientable(K)
    assert K.euler_characteristic == 0


def nodal(n):
    """cos x + cos y + cos z = 0 in one cell, by marching cubes."""
    x = np.linspace(0, 2 * np.pi, n + 1)
    z, y, x = np.meshgrid(x, x, x, indexing="ij")
    P = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    # Off the symmetric position, so that no vertex is a vertex of the grid.
    S = np.cos(P - [0.1, 0.17, 0.23]).sum(axis=1)
    V, F, _ = igl.marching_cubes(S, P, n + 1, n + 1, n + 1, 0.0)
    return V, F


def test_marching_cubes_of_a_nodal_surface(tmp_path, caplog):
    V, F = nodal(16)
    L = 2 * np.pi * np.eye(3)
    with caplog.at_level(logging.INFO, logger="igl_periods"):
        K = ip.DeltaComplex.from_mesh(V, F, lattice=L)
    assert "the lattice glued" in caplog.text
    assert K.genus == 3
    # It has the symmetries of Schwarz's P surface, hence its conformal structure.
    pm = ip.period_matrix(K, degree=2)
    assert str(ip.identify(pm, tolerance=1e-3)).startswith("Schwarz P and D surfaces and gyroid")
    # From a file, with six digits.
    name = tmp_path / "cell.obj"
    lines = [f"v {x:.5f} {y:.5f} {z:.5f}" for x, y, z in V]
    lines += [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in F]
    name.write_text("\n".join(lines))
    loaded, G, _ = ip.load_mesh(name)
    assert ip.DeltaComplex.from_mesh(loaded, G, lattice=L, tolerance=1e-5).genus == 3


V0, F0 = cell(3, 3, [1, 0], [0, 1])


@pytest.mark.parametrize(
    ("lattice", "message"),
    [
        (np.eye(3), r"one to three translations of R\^2"),
        ([[1, 0], [2, 0]], "independent; these are not"),
        ([[0, 0]], "independent; these are not"),
        ([[np.nan, 0]], "finite real numbers"),
        ([[0.777, 0.1]], "the lattice glues nothing"),
    ],
)
def test_lattices_that_are_none(lattice, message):
    with pytest.raises(ip.MeshError, match=message):
        ip.DeltaComplex.from_mesh(V0, F0, lattice=lattice)


def test_other_refusals():
    with pytest.raises(ip.MeshError, match=r"would border . faces"):
        ip.DeltaComplex.from_mesh(V0, F0, lattice=np.eye(2) / 3)
    with pytest.raises(ip.MeshError, match="tolerance = 2"):
        ip.DeltaComplex.from_mesh(V0, F0, lattice=np.eye(2), tolerance=2)
    K = ip.DeltaComplex.from_mesh(V0, F0)
    with pytest.raises(ip.MeshError, match="not a complex"):
        ip.DeltaComplex.from_mesh(K, lattice=np.eye(2))
    tetrahedron = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]
    P = np.vstack([np.zeros(3), 0.4 * np.eye(3)])
    with pytest.raises(ip.MeshError, match="do not close up"):
        ip.DeltaComplex.from_mesh(P, tetrahedron, lattice=[[0.41, -0.41, 0.1]])
    with pytest.raises(ip.MeshError, match="glues nothing: the mesh is closed"):
        ip.DeltaComplex.from_mesh(P, tetrahedron, lattice=[[3.0, 0.0, 0.0]])
    # A coarse tolerance joins neighbours along the boundary in chains.
    V, F = cell(40, 40, [1, 0], [0, 1])
    with pytest.raises(ip.MeshError, match="chain of vertices"):
        ip.DeltaComplex.from_mesh(V, F, lattice=np.eye(2), tolerance=0.03)


def test_effective_conductivity_of_a_corrugated_sheet():
    # A unit cell z = h(x): along x currents run the length ℓ of the profile, across they have the
    # width ℓ.  Conductivities 1/ℓ and ℓ are the energies D of the unit fields dx and dy: Π = iℓ.
    V, F = cell(12, 5, [1, 0, 0], [0, 1, 0])
    V[:, 2] = 0.2 * np.sin(2 * np.pi * V[:, 0]) + 0.1 * np.cos(4 * np.pi * V[:, 0])
    profile = V.reshape(13, 6, 3)[:, 0]
    length = np.linalg.norm(np.diff(profile, axis=0), axis=1).sum()
    K = ip.DeltaComplex.from_mesh(V, F, lattice=[[1, 0, 0], [0, 1, 0]])
    pm = ip.period_matrix(K).reduced()
    assert pm.matrix[0, 0] == pytest.approx(1j * length, abs=1e-10)
    assert np.allclose(np.sort(np.diag(pm.dirichlet)), [1 / length, length], atol=1e-10)
    # Bumps in both directions: conductivities still have the product 1 (Keller, Dykhne).
    V[:, 2] += 0.1 * np.sin(2 * np.pi * (V[:, 1] + V[:, 0]))
    bumpy = ip.period_matrix(ip.DeltaComplex.from_mesh(V, F, lattice=np.eye(3)[:2]), degree=6)
    assert np.linalg.det(bumpy.dirichlet) == pytest.approx(1, abs=2 * bumpy.bound)
