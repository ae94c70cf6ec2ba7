"""Cycles through a periodic surface, and several copies of its cell."""

import igl
import numpy as np
import pytest

import igl_periods as ip
from igl_periods.differentials import most_even_form, parametrize
from igl_periods.pictures.cells import copy_shifts, periodic_copies, smooth_cycles
from igl_periods.pictures.derivative_scenes import sensitivity_scene
from igl_periods.pictures.scenes import checkerboard_scene, cut_scene, cycles_scene, density_scene
from igl_periods.pictures.sheets import Sheet
from igl_periods.pictures.textured_meshes import write_glb, write_obj
from igl_periods.surfaces import triply_periodic_minimal_surface
from igl_periods.topology import canonical_cycles


def reduced(name, n):
    V, F, lattice = triply_periodic_minimal_surface(name, n)
    return ip.period_matrix(ip.DeltaComplex.from_mesh(V, F, lattice=lattice)).reduced()


@pytest.fixture(scope="module")
def gyroid():
    return reduced("G", 3)


def holonomies(K, walks):
    """The translations to which closed walks lead."""
    sheet = Sheet.of(K)
    return [(sheet.V[sheet.ends(w)[1]] - sheet.V[sheet.ends(w)[0]]).sum(axis=0) for w in walks]


def test_walks_lead_to_translates(gyroid):
    K = gyroid.complex
    found = np.array(holonomies(K, canonical_cycles(K, gyroid.cocycles)))
    cells = found @ np.linalg.inv(K.cell.lattice)
    assert np.abs(cells - np.rint(cells)).max() < 1e-9
    # The quotient generates all of the lattice.
    assert np.linalg.matrix_rank(cells) == 3


@pytest.mark.parametrize(("name", "n"), [("G", 3), ("D", 2), ("P", 2)])
def test_pieces_lie_in_the_cell_and_continue_each_other(name, n):
    pm = reduced(name, n)
    K = pm.complex
    sheet = Sheet.of(K)
    tree = igl.AABB()
    tree.init(sheet.V, sheet.F)
    step = 0.0065 * np.linalg.norm(np.ptp(sheet.V, axis=0))
    walks = canonical_cycles(K, pm.cocycles)
    inverse = np.linalg.inv(K.cell.lattice)
    for pieces, holonomy in zip(smooth_cycles(sheet, walks), holonomies(K, walks)):
        total = np.zeros(3)
        for k, (points, normals, closed) in enumerate(pieces):
            assert np.allclose(np.linalg.norm(normals, axis=1), 1)
            squared, *_ = tree.squared_distance(sheet.V, sheet.F, np.ascontiguousarray(points[:-1]))
            assert np.sqrt(squared.max()) < 1e-9
            assert np.linalg.norm(np.diff(points, axis=0), axis=1).max() < 1.5 * step
            # The next piece begins where this one ends, up to a translation.
            jump = (pieces[(k + 1) % len(pieces)][0][0] - points[-1]) @ inverse
            assert closed == (len(pieces) == 1 and not np.rint(jump).any())
            if not closed:
                assert np.abs(jump - np.rint(jump)).max() < 1e-9
                total -= np.rint(jump) @ K.cell.lattice
        assert np.allclose(total, holonomy, atol=1e-9)


def test_scenes_show_the_cell(gyroid):
    P = parametrize(gyroid, most_even_form(gyroid))
    n = gyroid.complex.n_faces
    for scene in (cycles_scene(gyroid), checkerboard_scene(P), density_scene(P), cut_scene(P)):
        assert len(scene.F) == n
        assert len(scene.colours) == len(scene.V) > gyroid.complex.n_vertices
    # Each seam at both sides, or once where it is inside of the cell.
    assert P.seams.size <= len(cut_scene(P).tubes) <= 2 * P.seams.size
    with pytest.raises(ip.ComplexError, match="no positions that Π could be sensitive to"):
        sensitivity_scene(ip.period_matrix(gyroid.complex, keep_forms=True))


def test_copies(gyroid):
    cell = gyroid.complex.cell
    scene = cycles_scene(gyroid)
    two = periodic_copies(scene, cell, (2, 1, 3))
    n = len(scene.V)
    assert (len(two.V), len(two.F), len(two.tubes)) == (
        6 * n,
        6 * len(scene.F),
        6 * len(scene.tubes),
    )
    assert np.allclose(two.V[-n:], scene.V + cell.lattice[0] + 2 * cell.lattice[2])
    # Glued copies of a closed surface have less boundary than cells on their own.
    all_of_them = periodic_copies(scene, cell, (2,))
    places = np.unique(np.rint(1e7 * all_of_them.V), axis=0)
    assert len(places) < len(all_of_them.V)
    for copies in ((2, 2), (0,), (1, 1, 0)):
        with pytest.raises(ValueError, match="one number of copies for each of 3 translations"):
            copy_shifts(cell, copies)
    with pytest.raises(ValueError, match="periodic surfaces alone"):
        copy_shifts(None, (2,))
    assert copy_shifts(None, (1,)).tolist() == [[0, 0, 0]]


def test_textures_of_copies(gyroid, tmp_path):
    P = parametrize(gyroid, most_even_form(gyroid))
    write_obj(tmp_path / "g.obj", P, copies=(2, 1, 1))
    V, _, _, F, G, _ = igl.readOBJ(str(tmp_path / "g.obj"))
    m = gyroid.complex.n_faces
    assert len(F) == len(G) == 2 * m
    assert np.allclose(V[F[m:]] - V[F[:m]], gyroid.complex.cell.lattice[0], atol=1e-9)
    assert np.array_equal(G[m:], G[:m])
    loaded = []
    for copies in ((1,), (2,)):
        write_glb(tmp_path / "g.glb", P, copies=copies)
        W, T, _ = ip.load_mesh(tmp_path / "g.glb")
        loaded.append((len(T), np.ptp(W, axis=0)))
    assert loaded[1][0] == 8 * loaded[0][0]
    assert np.all(loaded[1][1] > loaded[0][1])
