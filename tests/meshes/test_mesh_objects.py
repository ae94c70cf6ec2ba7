"""Meshes of other libraries are the surfaces that their own arrays describe."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.errors import MeshError
from igl_periods.meshes import mesh_of_object
from igl_periods.surfaces import torus_of_revolution

V, F = torus_of_revolution(2.0, 0.9, 9, 7)
V = V + 0.05 * np.random.default_rng(3).normal(size=V.shape)


def trimesh_mesh(V, F):
    trimesh = pytest.importorskip("trimesh", reason="trimesh is not installed (extra test)")
    return trimesh.Trimesh(V, F, process=False)


def open3d_mesh(V, F):
    open3d = pytest.importorskip("open3d", reason="Open3D is not installed")
    utility = open3d.utility
    return open3d.geometry.TriangleMesh(
        utility.Vector3dVector(V), utility.Vector3iVector(F.astype(np.int32))
    )


def open3d_tensor_mesh(V, F):
    open3d = pytest.importorskip("open3d", reason="Open3D is not installed")
    tensor = open3d.core.Tensor
    return open3d.t.geometry.TriangleMesh(tensor(V), tensor(np.ascontiguousarray(F)))


def pyvista_mesh(V, F):
    pyvista = pytest.importorskip("pyvista", reason="PyVista is not installed (extra test)")
    return pyvista.PolyData.from_regular_faces(V, F)


def meshio_mesh(V, F):
    meshio = pytest.importorskip("meshio", reason="meshio is not installed (extra test)")
    return meshio.Mesh(V, [("line", F[:5, :2]), ("triangle", F[:50]), ("triangle", F[50:])])


LIBRARIES = [trimesh_mesh, open3d_mesh, open3d_tensor_mesh, pyvista_mesh, meshio_mesh]


@pytest.mark.parametrize("mesh_of", LIBRARIES)
def test_a_mesh_object_is_its_vertices_and_faces(mesh_of):
    K = ip.DeltaComplex.from_mesh(mesh_of(V, F))
    assert np.array_equal(K.positions, V)
    assert np.array_equal(K.corner_vertex, F)
    assert np.array_equal(ip.period_matrix(mesh_of(V, F)).matrix, ip.period_matrix(V, F).matrix)


@pytest.mark.parametrize("mesh_of", LIBRARIES)
def test_a_mesh_object_goes_where_a_complex_goes(mesh_of):
    K, mesh = ip.DeltaComplex.from_mesh(V, F), mesh_of(V, F)
    np.testing.assert_equal(ip.homology_basis(mesh, 3), ip.homology_basis(K, 3))
    assert ip.mesh_quality(mesh).bound == ip.mesh_quality(K).bound
    assert ip.identify(mesh, 0.1).genus == 1
    assert len(ip.double(mesh).components()) == 2


@pytest.mark.parametrize("mesh_of", LIBRARIES)
def test_a_mesh_object_is_refused_as_its_arrays_are(mesh_of):
    with pytest.raises(ip.ComplexError, match="not closed: it has 3 boundary edges"):
        ip.period_matrix(mesh_of(V, F[:-1]))
    with pytest.raises(MeshError, match="has faces of its own"):
        ip.mesh_quality(mesh_of(V, F), F)


def test_a_class_of_the_users_own_is_what_it_is_derived_from():
    trimesh = pytest.importorskip("trimesh", reason="trimesh is not installed (extra test)")

    class Scan(trimesh.Trimesh):
        pass

    assert ip.period_matrix(Scan(V, F, process=False)).genus == 1


# ---- Polygons ----


def quads(n, m):
    """The n m quadrilaterals of the torus of n × m vertices."""
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    k, right, up, both = (
        (i + a) % n * m + (j + b) % m for a, b in ((0, 0), (1, 0), (0, 1), (1, 1))
    )
    return np.stack([k, right, both, up], axis=-1).reshape(-1, 4)


def test_convex_polygons_are_divided():
    pyvista = pytest.importorskip("pyvista", reason="PyVista is not installed (extra test)")
    meshio = pytest.importorskip("meshio", reason="meshio is not installed (extra test)")
    V, F = torus_of_revolution(2.0, 0.9, 9, 7)
    Q = quads(9, 7)
    expected = ip.period_matrix(V, F).matrix
    triangles = np.stack([Q[40:, [0, 1, 2]], Q[40:, [0, 2, 3]]], axis=1).reshape(-1, 3)
    faces = [*np.insert(Q[:40], 0, 4, axis=1).ravel(), *np.insert(triangles, 0, 3, axis=1).ravel()]
    for mesh in (
        pyvista.PolyData.from_regular_faces(V, Q),
        pyvista.PolyData(V, faces),
        meshio.Mesh(V, [("quad", Q[:40]), ("triangle", triangles)]),
    ):
        # The diagonals of the grid, so the same polyhedral surface.
        assert np.allclose(ip.period_matrix(mesh).reduced().matrix, _reduced(expected), atol=1e-9)


def _reduced(matrix):
    return ip.siegel_reduce(matrix).matrix


DART = np.array([[0.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.5, 1.0, 0.0], [0.0, 3.0, 0.0], [0, 0, 2]])


def test_polygons_that_are_not_convex_are_divided_as_those_of_files():
    pyvista = pytest.importorskip("pyvista", reason="PyVista is not installed (extra test)")
    meshio = pytest.importorskip("meshio", reason="meshio is not installed (extra test)")
    dart, walls = [1, 2, 3, 0], [[1, 0, 4], [2, 1, 4], [3, 2, 4], [0, 3, 4]]
    faces = [4, *dart, *(k for wall in walls for k in (3, *wall))]
    for mesh in (
        pyvista.PolyData(DART, faces),
        meshio.Mesh(DART, [("quad", [dart]), ("triangle", walls)]),
    ):
        V, F = mesh_of_object(mesh)
        # At its reflex corner, which both triangles have.
        assert (F == 2).any(axis=1)[:2].all()
        assert ip.period_matrix(V, F).genus == 0
    corners = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]
    bow_tie = meshio.Mesh(corners, [("quad", [[0, 1, 2, 3]])])
    with pytest.raises(MeshError, match="crosses itself"):
        ip.period_matrix(bow_tie)


# ---- What is not a mesh of triangles ----


def test_what_is_no_surface_in_trimesh():
    trimesh = pytest.importorskip("trimesh", reason="trimesh is not installed (extra test)")
    mesh = trimesh_mesh(V, F)
    with pytest.raises(MeshError, match=r"a Scene of trimesh .* to_mesh\(\)"):
        ip.period_matrix(trimesh.Scene(mesh))
    assert ip.period_matrix(trimesh.Scene(mesh).to_mesh()).genus == 1
    with pytest.raises(MeshError, match="a PointCloud of trimesh"):
        ip.mesh_quality(trimesh.PointCloud(V))


def test_what_is_no_surface_in_open3d():
    open3d = pytest.importorskip("open3d", reason="Open3D is not installed")
    with pytest.raises(MeshError, match="a PointCloud of Open3D"):
        ip.period_matrix(open3d.geometry.PointCloud())
    with pytest.raises(MeshError, match="the mesh is empty"):
        ip.period_matrix(open3d.geometry.TriangleMesh())
    with pytest.raises(MeshError, match=r"the mesh is empty: it has no vertex\.positions"):
        ip.period_matrix(open3d.t.geometry.TriangleMesh())


def test_what_is_no_surface_in_pyvista():
    pyvista = pytest.importorskip("pyvista", reason="PyVista is not installed (extra test)")
    with pytest.raises(MeshError, match=r"a ImageData of PyVista .* extract_surface\(\)"):
        ip.period_matrix(pyvista.ImageData(dimensions=(2, 2, 2)))
    with pytest.raises(MeshError, match="the mesh is empty"):
        ip.period_matrix(pyvista.PolyData(V))
    with pytest.raises(MeshError, match=r"strips of triangles: take mesh\.triangulate\(\)"):
        ip.period_matrix(pyvista_mesh(V, F).strip())
    with pytest.raises(MeshError, match=r"of VTK .* pyvista\.wrap"):
        ip.period_matrix(pytest.importorskip("vtkmodules.vtkCommonDataModel").vtkPolyData())


def test_what_is_no_surface_in_meshio():
    meshio = pytest.importorskip("meshio", reason="meshio is not installed (extra test)")
    with pytest.raises(MeshError, match="cells of type 'tetra'"):
        ip.period_matrix(meshio.Mesh(V, [("tetra", [[0, 1, 2, 3]])]))
    with pytest.raises(MeshError, match="the mesh is empty"):
        ip.period_matrix(meshio.Mesh(V, []))
