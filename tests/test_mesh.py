"""Mesh files read, described and repaired."""

import functools
import json
import struct
import subprocess
import sys
from collections import Counter

import igl
import numpy as np
import pytest
from mesh_files import cube, gltf, halved, obj, off, ply, stl, torus, written

import igl_periods as ip
from igl_periods.complexes.surface_checks import check_surface
from igl_periods.meshes.facts import mesh_facts
from igl_periods.meshes.load import load_mesh, split_components
from igl_periods.meshes.repair import repair_mesh

# The INDEX.md of the folder of meshes: vertices, triangles, bad edges, bad vertices,
# inconsistently oriented edges, and components as (genus or crosscaps, boundary loops): number.
INDEX = {
    "spot_triangulated.obj": (2930, 5856, 0, 0, 0, {(0, 0): 1}),
    "Csaszar.ply": (7, 14, 0, 0, 0, {(1, 0): 1}),
    "bob_small.ply": (250, 500, 0, 0, 0, {(1, 0): 1}),
    "rocker-arm.obj": (10044, 20088, 0, 0, 0, {(1, 0): 1}),
    "wente_torus02.obj": (1240, 2480, 0, 0, 0, {(1, 0): 1}),
    "eight.off": (766, 1536, 0, 0, 0, {(2, 0): 1}),
    "3holes.obj": (1987, 3982, 0, 0, 0, {(3, 0): 1}),
    "kq_surface.obj": (56, 120, 0, 0, 0, {(3, 0): 1}),
    "fertility.off": (4494, 9000, 0, 0, 0, {(4, 0): 1}),
    "botijo.obj": (41158, 82332, 0, 0, 0, {(5, 0): 1}),
    "scaffolding.ply": (640, 1388, 0, 0, 0, {(28, 0): 1}),
    "buckyball.obj": (5221, 10562, 0, 0, 0, {(31, 0): 1}),
    "punctured-torus.obj": (4599, 9184, 0, 0, 0, {(1, 1): 1}),
    "moebius.obj": (280, 448, 0, 0, 4, {(1, 1): 1}),
    "klein_zero_coords.off": (9, 18, 0, 0, 21, {(2, 0): 1}),
    "hourglass_ico.obj": (23, 40, 0, 1, 0, {(0, 0): 2}),
    "triple_vierbein.obj": (75, 108, 20, 21, 3, {(0, 1): 6}),
    "two-tori.obj": (1152, 2304, 0, 0, 0, {(1, 0): 2}),
    "conrod.off": (3223, 6442, 3, 6, 5149, {(0, 1): 3, (0, 3): 1}),
    "featuretype.ply": (
        *(5096, 3476, 0, 0, 0),
        {(0, 1): 838, (0, 2): 11, (0, 3): 1, (0, 9): 1, (0, 11): 1},
    ),
    "bunny2.ply": (1623, 1000, 0, 1, 0, {(0, 4): 1}),
}
QUADRILATERALS = {"wente_torus02.obj": 1240, "moebius.obj": 224, "two-tori.obj": 1152}
NOT_ORIENTABLE = {"moebius.obj", "klein_zero_coords.off"}


@pytest.fixture(scope="module")
def load(meshes):
    """load_mesh of a mesh of the folder, done once."""
    return functools.cache(lambda name, repair=False: load_mesh(meshes / name, repair=repair))


def kinds(facts) -> dict[tuple[int, int], int]:
    return dict(Counter((part.genus, part.boundary_loops) for part in facts.components))


@pytest.mark.parametrize("name", INDEX)
def test_loaded_counts_are_those_of_the_index(load, name):
    n, m, bad_edges, bad_vertices, inconsistent, components = INDEX[name]
    V, F, report = load(name)
    facts = report.loaded
    assert (V.shape, F.shape) == ((n, 3), (m, 3))
    assert (facts.vertices, facts.triangles) == (n, m)
    assert facts.nonmanifold_edges == bad_edges
    assert facts.nonmanifold_vertices == bad_vertices
    assert facts.inconsistent_edges == inconsistent
    assert kinds(facts) == components
    assert {part.orientable for part in facts.components} == {name not in NOT_ORIENTABLE}
    assert report.polygons_fanned == QUADRILATERALS.get(name, 0)
    assert report.faces == m - QUADRILATERALS.get(name, 0)
    assert report.result == report.loaded
    assert report.repair == ()


@pytest.mark.parametrize("name", INDEX)
def test_arrays_are_bit_for_bit_those_of_libigl(load, meshes, name):
    V, F, _ = load(name)
    V_igl, F_igl = igl.read_triangle_mesh(meshes / name)
    assert V.dtype == np.float64
    assert F.dtype == np.int64
    np.testing.assert_array_equal(V, V_igl)
    np.testing.assert_array_equal(F, F_igl)


# What the components are worth, as they are and after repair: Euler characteristics, or a refusal.
OUTCOMES = {
    "punctured-torus.obj": ("16 boundary edges", "16 boundary edges"),
    "moebius.obj": ("112 boundary edges", "112 boundary edges"),
    "klein_zero_coords.off": ("face 0 is degenerate", "face 0 is degenerate"),
    "hourglass_ico.obj": ("1 vertices join more than one fan", [2, 2]),
    "triple_vierbein.obj": ("20 edges border more than two faces", "90 boundary edges"),
    "conrod.off": ("3 edges border more than two faces", "9 boundary edges"),
    "featuretype.ply": ("5074 boundary edges", [-16]),
    "bunny2.ply": ("1 vertices join more than one fan", "26 boundary edges"),
}


@pytest.mark.parametrize("repair", [False, True])
@pytest.mark.parametrize("name", INDEX)
def test_every_mesh_is_a_surface_or_refused_with_the_reason(load, name, repair):
    V, F, report = load(name, repair)
    closed = [2 - 2 * part.genus for part in report.result.components]
    outcome = OUTCOMES.get(name, (closed, closed))[repair]
    if isinstance(outcome, list):
        parts = ip.DeltaComplex.from_mesh(V, F).components()
        for part in parts:
            check_surface(part)
        assert [part.euler_characteristic for part in parts] == outcome == closed
    else:
        with pytest.raises(ValueError, match=outcome) as refusal:
            check_surface(ip.DeltaComplex.from_mesh(V, F))
        assert isinstance(refusal.value, ip.MeshError | ip.ComplexError)


@pytest.mark.parametrize("name", INDEX)
def test_repair_is_idempotent_and_leaves_surfaces_alone(load, name):
    V, F, report = load(name)
    V1, F1, _ = load(name, repair=True)
    V2, F2, steps = repair_mesh(V1, F1)
    assert [step.changed for step in steps] == [0] * len(steps)
    np.testing.assert_array_equal(V2, V1)
    np.testing.assert_array_equal(F2, F1)
    if report.loaded.is_closed_surface:
        np.testing.assert_array_equal(V1, V)
        np.testing.assert_array_equal(F1, F)
    # No vertex moves and none is invented.
    assert {tuple(x) for x in V1.tolist()} <= {tuple(x) for x in V.tolist()}


def changes(report) -> dict[str, int]:
    return {step.name: step.changed for step in report.repair if step.changed}


def test_featuretype_welds_to_one_closed_surface_of_genus_9(meshes):
    _, _, report = load_mesh(meshes / "featuretype.ply", repair=True)
    assert kinds(report.result) == {(9, 0): 1}
    assert report.result.is_closed_surface
    assert changes(report) == {
        "vertices welded by stitching boundary edges": 3374,
        "vertices without triangles dropped": 3374,
    }


def test_hourglass_falls_into_two_spheres(meshes):
    V, F, report = load_mesh(meshes / "hourglass_ico.obj", repair=True)
    assert kinds(report.result) == {(0, 0): 2}
    assert changes(report) == {"vertices added by splitting non-manifold vertices": 1}
    assert [(len(v), len(f)) for v, f in split_components(V, F)] == [(12, 20), (12, 20)]


def test_conrod_is_oriented_to_a_closed_sphere_and_three_lone_triangles(meshes):
    V, F, report = load_mesh(meshes / "conrod.off", repair=True)
    assert report.result.inconsistent_edges == 0
    assert kinds(report.result) == {(0, 0): 1, (0, 1): 3}
    assert changes(report)["duplicate triangles dropped"] == 3
    sphere = max(split_components(V, F), key=lambda part: len(part[1]))
    assert ip.DeltaComplex.from_mesh(*sphere).genus == 0


def test_bunny2_is_cleaned_and_its_holes_filled_up_to_a_size(meshes):
    _, _, cleaned = load_mesh(meshes / "bunny2.ply", repair=True)
    assert changes(cleaned) == {
        "vertices added by splitting non-manifold vertices": 1,
        "vertices without triangles dropped": 1113,
    }
    # The loops have 3, 5, 8 and 10 edges.
    for largest, left in ((2, 4), (3, 3), (7, 2), (8, 1), (10, 0)):
        _, _, filled = load_mesh(meshes / "bunny2.ply", repair=True, largest_hole=largest)
        assert kinds(filled.result) == {(0, left): 1}
        assert filled.result.inconsistent_edges == 0
    assert filled.result.is_closed_surface


def test_triple_vierbein_is_split_into_three_oriented_sheets(meshes):
    V, F, report = load_mesh(meshes / "triple_vierbein.obj", repair=True)
    assert report.result.nonmanifold_edges == report.result.nonmanifold_vertices == 0
    assert kinds(report.result) == {(0, 1): 3}
    assert report.result.defects() == ["90 edges with one triangle (boundary)", "3 components"]
    assert not report.result.is_closed_surface
    assert len(ip.DeltaComplex.from_mesh(V, F).components()) == 3


FORMS = {
    "mesh.obj": obj,
    "mesh.OFF": off,
    "text.ply": ply,
    "little.ply": lambda V, p: ply(V, p, "binary_little_endian"),
    "big.ply": lambda V, p: ply(V, p, "binary_big_endian"),
}


@pytest.mark.parametrize("name", FORMS)
def test_what_is_written_is_read(tmp_path, name):
    V, F = torus()
    # A folder with a space, and a name that is not ASCII.
    folder = tmp_path / "a b é"
    folder.mkdir()
    V_read, F_read, report = load_mesh(written(folder / name, FORMS[name](V, F.tolist())))
    np.testing.assert_array_equal(V_read, V)
    np.testing.assert_array_equal(F_read, F)
    assert (report.faces, report.polygons_fanned) == (len(F), 0)
    assert report.loaded.is_closed_surface


@pytest.mark.parametrize("name", FORMS)
def test_polygons_become_fans_in_the_order_of_the_file(tmp_path, name):
    # A cube with one side cut in two and one corner of the neighbouring sides made a pentagon.
    V, quads = cube()
    V = np.vstack([V, [0, 0.5, 0]])
    polygons = [[0, 1, 3], [8, 0, 3, 2], *quads[1:4].tolist(), [8, 2, 6, 4, 0], quads[5].tolist()]
    V_read, F, report = load_mesh(written(tmp_path / name, FORMS[name](V, polygons)))
    expected = [[p[0], p[i], p[i + 1]] for p in polygons for i in range(1, len(p) - 1)]
    assert F.tolist() == expected
    np.testing.assert_array_equal(V_read, V)
    assert (report.faces, report.polygons_fanned) == (7, 6)
    assert kinds(report.loaded) == {(0, 0): 1}


@pytest.mark.parametrize("binary", [False, True])
def test_stl_corners_are_welded_and_counted(tmp_path, binary):
    V, F = torus()
    V = V.astype(np.float32)
    V[0, 2] = 0.0
    content = stl(V.astype(float), F, binary)
    if not binary:
        # One of the corners at vertex 0 says -0.0, which is the same position.
        content = content.replace(b" 0.0\nendloop", b" -0.0\nendloop", 1)
        assert b" -0.0" in content
    V_read, F_read, report = load_mesh(written(tmp_path / "mesh.stl", content))
    assert (len(V_read), report.stl_corners_welded) == (len(V), 3 * len(F) - len(V))
    np.testing.assert_array_equal(V_read[F_read], V[F])
    assert kinds(report.loaded) == {(1, 0): 1}


TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
OBJ_DIALECTS = {
    "byte-order mark": "\ufeff" + TETRAHEDRON,
    "carriage returns": TETRAHEDRON.replace("\n", "\r\n"),
    "comments": TETRAHEDRON.replace("\n", " # c\n") + "# end",
    "continued line": TETRAHEDRON.replace("f 1 3 2", "f 1 3 \\\n2"),
    "other elements": "mtllib a.mtl\no x\ng y\nusemtl m\ns 1\n" + TETRAHEDRON + "l 1 2\n",
    "texture and normals": "vt 0 0\nvn 0 0 1\n"
    + TETRAHEDRON.replace("f 1 3 2", "f 1/1/1 3/1/1 2/1/1").replace("f 1 2 4", "f 1//1 2//1 4//1"),
    "counted backwards": TETRAHEDRON.replace("f 1 3 2", "f -4/1 -2/1 -3/1"),
    "colours": TETRAHEDRON.replace("v 1 0 0", "v 1 0 0 0.5 0.5 0.5"),
    "exponents": TETRAHEDRON.replace("v 1 0 0", "v +1.E+00 .0 0e3"),
}


@pytest.mark.parametrize("dialect", OBJ_DIALECTS)
def test_dialects_of_obj(tmp_path, capfd, dialect):
    V, F, _ = load_mesh(written(tmp_path / "mesh.obj", OBJ_DIALECTS[dialect]))
    assert V.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    assert F.tolist() == [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    # Neither Python nor libigl writes anything.
    assert capfd.readouterr() == ("", "")


def test_backward_indices_count_from_the_line_of_the_face(tmp_path):
    lines = TETRAHEDRON.splitlines()
    early = "\n".join([*lines[:3], "f -3 -1 -2", *lines[3:]])
    _, F, _ = load_mesh(written(tmp_path / "mesh.obj", early))
    assert F[0].tolist() == [0, 2, 1]


@pytest.mark.parametrize(
    "content",
    [
        "OFF 4 4 6\n{}",
        "OFF\n# comment\n\n4 4\n{}",
        "COFF\n4 4 0\n{}",
    ],
)
def test_dialects_of_off(tmp_path, content):
    V, F, _ = load_mesh(written(tmp_path / "good.obj", TETRAHEDRON))
    colour = " 1 1 1 1" if "COFF" in content else ""
    body = "".join(f"{x:g} {y:g} {z:g}{colour} # c\n" for x, y, z in V)
    body += "".join(f"3  {a} {b}\t{c} 255 0 0\n" for a, b, c in F)
    V_off, F_off, _ = load_mesh(written(tmp_path / "mesh.off", content.format(body) + "3 0 1 2\n"))
    np.testing.assert_array_equal(V_off, V)
    np.testing.assert_array_equal(F_off, F)


def test_gltf_is_read_by_open3d(tmp_path):
    V, F = torus()
    V_read, F_read, report = load_mesh(written(tmp_path / "mesh.gltf", gltf(V, F)), repair=True)
    assert report.result.is_closed_surface
    assert kinds(report.result) == {(1, 0): 1}
    # glTF stores single precision.
    np.testing.assert_array_equal(
        np.unique(V_read[F_read].reshape(-1, 3), axis=0),
        np.unique(V.astype(np.float32).astype(float), axis=0),
    )
    with pytest.raises(ip.MeshError, match="Open3D reads no triangles"):
        load_mesh(written(tmp_path / "broken.glb", b"glTF and no more"))


def test_open3d_is_not_imported_where_it_is_not_needed(tmp_path):
    path = written(tmp_path / "mesh.off", off(*torus()))
    code = (
        "import sys; from igl_periods.meshes.load import load_mesh; "
        f"load_mesh({str(path)!r}, repair=True); sys.exit('open3d' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


V4, F4 = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
GOOD_PLY = ply(V4, F4)
GOOD_BINARY = ply(V4, F4, "binary_little_endian")
GOOD_STL = stl(np.array(V4, dtype=float), F4, binary=False)
BINARY_STL = stl(np.array(V4, dtype=float), F4, binary=True)
REFUSED = {
    "no extension": ("mesh", TETRAHEDRON, r"the format '\(none\)' is not one of .obj .off"),
    "unknown extension": ("mesh.step", TETRAHEDRON, "the format '.step' is not one of"),
    "empty obj": ("mesh.obj", "", "the file is empty"),
    "empty ply": ("mesh.ply", "", "the file is empty"),
    "only comments": ("mesh.obj", "# nothing\n", "0 vertices and no faces"),
    "no faces": ("mesh.obj", TETRAHEDRON.split("f")[0], "4 vertices and no faces"),
    "binary obj": ("mesh.obj", b"v\0\1\2", "binary, where text is expected"),
    "NaN in obj": ("mesh.obj", TETRAHEDRON.replace("v 1", "v nan"), "no vertex.*'v nan 0 0'"),
    "overflow in obj": (
        "mesh.obj",
        TETRAHEDRON.replace("v 1", "v 1e999"),
        "infinite coordinates: 'v 1e999 0 0'",
    ),
    "two coordinates": ("mesh.obj", TETRAHEDRON.replace("v 1 0 0", "v 1 0"), "no vertex.*'v 1 0'"),
    "index 0": ("mesh.obj", TETRAHEDRON.replace("f 1 3 2", "f 0 3 2"), "refer to vertices -1 to 3"),
    "index too big": ("mesh.obj", TETRAHEDRON + "f 1 2 5\n", "refer to vertices 0 to 4 .*are 4"),
    "index enormous": ("mesh.obj", TETRAHEDRON + "f 1 2 99999999999\n", "no face.*99999999999"),
    "face of two": ("mesh.obj", TETRAHEDRON + "f 1 2\n", "face 4 .* has 2 corners"),
    "face of words": ("mesh.obj", TETRAHEDRON + "f a b c\n", "no face.*'f a b c'"),
    "long line": ("mesh.obj", TETRAHEDRON + "f" + " 1 2 3" * 400, "a line of 2401 characters"),
    "counted backwards too far": (
        "mesh.obj",
        TETRAHEDRON + "f -6 -1 -2\n",
        "vertex -6, counted backwards, and 4 vertices come before it",
    ),
    "many digits and a word": ("mesh.obj", "v" + 60 * " 111111111111" + " x\n", "no vertex"),
    "infinity in digits": ("mesh.obj", TETRAHEDRON.replace("v 1", "v 1" + "0" * 309), "infinite"),
    "no OFF": ("mesh.off", "4 4 0\n", "not OFF, COFF or NOFF"),
    "binary OFF": ("mesh.off", "OFF BINARY\n", "not OFF, COFF or NOFF, as in text files"),
    "no counts": ("mesh.off", "OFF\n0 0 0\n", "the mesh is empty"),
    "negative counts": (
        "mesh.off",
        "OFF\n4 -4 0\n0 0 0\n",
        "numbers of vertices and faces are miss",
    ),
    "absurd counts": ("mesh.off", "OFF\n9999999999 4 0\n0 0 0\n", "1 lines follow: .*truncated"),
    "thousands of digits": ("mesh.off", f"OFF\n{'9' * 5000} 4 0\n0 0 0\n", "faces are missing"),
    "degree of thousands of digits": (
        "mesh.off",
        off(V4, F4).replace("\n3 1", "\n" + "9" * 5000 + " 1"),
        "no face",
    ),
    "OFF cut in the vertices": ("mesh.off", off(V4, F4)[:20], "announced, and .* truncated"),
    "OFF cut in the faces": ("mesh.off", off(V4, F4)[:-10], "announced, and 7 lines .* truncated"),
    "OFF cut in a line": ("mesh.off", off(V4, F4)[:-3], "no face: '3 1 2'"),
    "degree 0": ("mesh.off", off(V4, [*F4, []]), "face 4 .* has 0 corners"),
    "degree enormous": (
        "mesh.off",
        off(V4, F4).replace("3 1", "999999999 1"),
        "no face: '999999999",
    ),
    "index -1": ("mesh.off", off(V4, [*F4, [1, 2, -1]]), "no face: '3 1 2 -1'"),
    "index 1.5": ("mesh.off", off(V4, [*F4, [1, 2, 1.5]]), "no face: '3 1 2 1.5'"),
    "inf in off": ("mesh.off", off(V4, F4).replace("1 0 0", "inf 0 0"), "no vertex.*'inf 0 0'"),
    "no ply": ("mesh.ply", TETRAHEDRON, "no PLY header"),
    "ply header cut": ("mesh.ply", GOOD_PLY[:60], "no PLY header from 'ply' to 'end_header'"),
    "unknown type": (
        "mesh.ply",
        GOOD_PLY.replace(b"double x", b"quad x"),
        "not understood: 'property",
    ),
    "no format": ("mesh.ply", GOOD_PLY.replace(b"format ascii 1.0\n", b""), "no format line"),
    "points": (
        "mesh.ply",
        GOOD_PLY.replace(b"vertex_indices", b"else"),
        "a point cloud or something",
    ),
    "text ply cut": ("mesh.ply", GOOD_PLY[:-20], "face rows ends early"),
    "text ply cut early": (
        "mesh.ply",
        GOOD_PLY[: GOOD_PLY.index(b"end_header") + 30],
        "vertex rows ends early",
    ),
    "word in ply": (
        "mesh.ply",
        GOOD_PLY.replace(b"3 0 2 1", b"3 0 x 1"),
        "face rows ends early or holds",
    ),
    "NaN in ply": ("mesh.ply", GOOD_PLY.replace(b"1 0 0\n", b"nan 0 0\n"), "1 vertices .* NaN"),
    "absurd ply": (
        "mesh.ply",
        GOOD_PLY.replace(b"face 4", b"face 4000000000"),
        "4000000000 face rows",
    ),
    "negative ply": (
        "mesh.ply",
        GOOD_PLY.replace(b"face 4", b"face -4"),
        "not understood: 'element",
    ),
    "ply count of thousands of digits": (
        "mesh.ply",
        GOOD_PLY.replace(b"face 4", b"face " + b"9" * 5000),
        "not understood: 'element face 9",
    ),
    "ply index beyond 64 bits": (
        "mesh.ply",
        GOOD_PLY.replace(b"3 0 2 1", b"3 0 2 99999999999999999999"),
        "face rows ends early or holds no numbers that its header declares",
    ),
    "ply index beyond its type": (
        "mesh.ply",
        GOOD_PLY.replace(b"3 0 2 1", b"3 0 2 4294967297"),
        "face rows ends early or holds no numbers that its header declares",
    ),
    "ply infinite in its type": (
        "mesh.ply",
        GOOD_PLY.replace(b"double", b"float").replace(b"1 0 0\n", b"1e39 0 0\n"),
        "NaN or infinite",
    ),
    "ply coordinates in lists": (
        "mesh.ply",
        GOOD_PLY.replace(b"property double x", b"property list uchar double x"),
        "ends early|a point cloud or something",
    ),
    "ply indices with fractions": (
        "mesh.ply",
        GOOD_BINARY.replace(b"list uchar int", b"list uchar float"),
        "a point cloud or something",
    ),
    "ply fractional degrees": (
        "mesh.ply",
        GOOD_PLY.replace(b"list uchar int", b"list float int"),
        "not understood: 'property list float",
    ),
    "ply column twice": (
        "mesh.ply",
        GOOD_PLY.replace(b"double z\n", b"double z\nproperty double x\n"),
        "declares one name twice, of x, y, z, x",
    ),
    "ply vertices twice": (
        "mesh.ply",
        GOOD_PLY.replace(b"element edge", b"element vertex"),
        "declares one name twice, of vertex, face, vertex",
    ),
    "binary ply cut": ("mesh.ply", GOOD_BINARY[:-20], "face rows ends early"),
    "binary ply degree": (
        "mesh.ply",
        GOOD_BINARY.replace(b"\3\0", b"\xff\0"),
        "face rows ends early",
    ),
    "ply index": ("mesh.ply", GOOD_PLY.replace(b"3 0 2 1", b"3 0 2 9"), "refer to vertices 0 to 9"),
    "stl cut": ("mesh.stl", GOOD_STL[:-50], "truncated or no STL"),
    "binary stl cut": ("mesh.stl", BINARY_STL[:-30], "truncated or no STL"),
    "stl without facets": ("mesh.stl", b"solid x\nendsolid x\n", "the mesh is empty"),
    "stl with a broken facet": (
        "mesh.stl",
        GOOD_STL.replace(b"vertex", b"vortex", 1),
        "not every facet has",
    ),
    "garbage in stl": (
        "mesh.stl",
        GOOD_STL.replace(b"vertex 1.0", b"vertex 1\x0e0"),
        "no vertex.*'vertex 1.x0e0 0.0 0.0'",
    ),
    "stl facets of 2 and 4": (
        "mesh.stl",
        GOOD_STL.replace(b"endfacet\n", b"", 1).replace(b"vertex", b"endfacet\nvertex", 3),
        "not every facet has three vertices",
    ),
    "infinity in binary stl": (
        "mesh.stl",
        BINARY_STL[:96] + struct.pack("<f", np.inf) + BINARY_STL[100:],
        "NaN or infinite",
    ),
    "NaN in stl": ("mesh.stl", GOOD_STL.replace(b"vertex 1.0", b"vertex nan"), "no vertex"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused_files(tmp_path, case):
    name, content, message = REFUSED[case]
    path = written(tmp_path / name, content)
    with pytest.raises(ip.MeshError, match=message) as refusal:
        load_mesh(path)
    # The file is named.
    assert str(path) in str(refusal.value)


def test_a_long_token_takes_no_more_memory_than_it_has(tmp_path):
    # A table of fixed width would have 40 GB.
    lines = GOOD_PLY.replace(b"comment", b"comment " + b"x" * 10).replace(
        b"vertex 4", b"vertex 200004"
    )
    zeros = b"0 0 0\n" * 200_000
    head, body = lines.split(b"end_header\n")
    body = body.replace(b"1 0 0\n", b"1." + b"0" * 200_000 + b" 0 0\n")
    V, F, _ = load_mesh(
        written(
            tmp_path / "mesh.ply",
            head + b"end_header\n" + body.replace(b"0 0 1\n", b"0 0 1\n" + zeros),
        )
    )
    assert F.tolist() == F4
    assert V[:4].tolist() == V4


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"there is no mesh file '.*nothing\.off'"):
        load_mesh(tmp_path / "nothing.off")
    (tmp_path / "folder.off").mkdir()
    with pytest.raises(ip.MeshError, match="this is no file"):
        load_mesh(tmp_path / "folder.off")


def test_facts_of_surfaces_known_by_hand():
    V, F = torus()
    assert kinds(mesh_facts(V, F)) == {(1, 0): 1}
    # Without one triangle, and without two that share no vertex.
    assert kinds(mesh_facts(V, F[1:])) == {(1, 1): 1}
    assert kinds(mesh_facts(V, np.delete(F, [0, 40], axis=0))) == {(1, 2): 1}
    # The projective plane with six vertices: half of an icosahedron.
    plane = [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 1]]
    plane += [[1, 2, 4], [2, 3, 5], [3, 4, 1], [4, 5, 2], [5, 1, 3]]
    facts = mesh_facts(np.random.default_rng(0).normal(size=(6, 3)), np.array(plane))
    assert (kinds(facts), facts.components[0].orientable) == ({(1, 0): 1}, False)
    assert "not orientable" in facts.defects()
    assert str(facts.components[0]) == "not orientable, 1 crosscap, closed"


def test_facts_do_not_depend_on_numbering_or_orientation():
    rng = np.random.default_rng(3)
    V, F = torus()
    F = np.delete(F, [3, 4, 30], axis=0)
    facts = mesh_facts(V, F)
    p = rng.permutation(len(V))
    relabelled = np.roll(np.argsort(p)[F], 1, axis=1)[rng.permutation(len(F))]
    assert mesh_facts(V[p], relabelled) == facts
    assert mesh_facts(V, F[:, ::-1]) == facts


def test_each_defect_is_counted():
    V, F = torus()
    V = np.vstack([V, V[:2], [[9.0, 9.0, 9.0]]])
    unused, copy = len(V) - 1, len(V) - 3
    F = F.copy()
    F[0] = F[0, ::-1]
    F = np.vstack([F, F[5], [[copy, copy + 1, copy]]])
    facts = mesh_facts(V, F)
    assert facts.unreferenced_vertices == 1 == np.setdiff1d(np.arange(unused + 1), F).size
    assert facts.coincident_vertices == 2
    assert facts.duplicate_triangles == 1
    assert facts.collapsed_triangles == facts.zero_area_triangles == 1
    assert facts.nonmanifold_edges == 3
    assert facts.inconsistent_edges >= 3


def test_repair_undoes_what_was_done_to_a_surface():
    """Seams opened, triangles turned and repeated, vertices added: the same surface again."""
    V, F = torus()
    rng = np.random.default_rng(0)
    turned = rng.random(len(F)) < 0.4
    soup = np.where(turned[:, None], F[:, ::-1], F)
    V_soup, F_soup = V[soup].reshape(-1, 3), np.arange(soup.size).reshape(-1, 3)
    F_soup = np.vstack([F_soup, F_soup[3], [[0, 1, 0]]])
    V_soup = np.vstack([V_soup, rng.normal(size=(4, 3))])
    V1, F1, steps = repair_mesh(V_soup, F_soup)
    assert (len(V1), len(F1)) == (len(V), len(F))
    assert ip.DeltaComplex.from_mesh(V1, F1).genus == 1
    counts = {step.name: step.changed for step in steps}
    assert counts["vertices welded by stitching boundary edges"] == 3 * len(F) - len(V)
    assert counts["triangles turned over"] in (turned.sum(), len(F) - turned.sum())
    assert counts["duplicate triangles dropped"] == 1
    assert counts["triangles dropped that used a vertex twice"] == 1


def test_cubes_that_share_an_edge_are_closed_surfaces_after_repair():
    V1, quads = cube()
    V2, _ = cube(1.0)
    # The second cube, moved up, meets the first along one edge.
    V = np.vstack([V1, V2 + np.array([0, 0, 1])])
    F = np.vstack([halved(quads), halved(quads) + 8])
    rename = np.arange(16)
    for i, x in enumerate(V1):
        rename[8:][(V[8:] == x).all(axis=1)] = i
    F = rename[F]
    assert mesh_facts(V, F).nonmanifold_edges == 1
    _, F1, _ = repair_mesh(V, F)
    facts = mesh_facts(np.zeros((F1.max() + 1, 3)), F1)
    assert facts.nonmanifold_edges == facts.nonmanifold_vertices == facts.boundary_edges == 0
    assert {part.genus for part in facts.components} == {0}


def test_repair_keeps_closed_sheets_apart_that_touch():
    # Two tori with one vertex in the same place, a pillow of two triangles, and a torus whose
    # vertices all coincide in pairs with those of a second one: nothing is welded.
    V, F = torus()
    far = V + (V[0] - V[9])
    V2, F2 = np.vstack([V, far, V]), np.vstack([F, F + len(V), F + 2 * len(V)])
    _, F3, steps = repair_mesh(V2, F2)
    np.testing.assert_array_equal(F3, F2)
    assert sum(step.changed for step in steps) == 0
    pillow = np.array([[0, 1, 2], [0, 2, 1]])
    _, kept, _ = repair_mesh(V[:3], pillow)
    np.testing.assert_array_equal(kept, pillow)


def test_a_surface_that_is_not_orientable_is_not_cut_open():
    V, F = torus(6, 6)
    # A Klein bottle: the last ring is glued to the first with a reflection.
    i, j = np.divmod(F, 6)
    wraps = (i.max(axis=1) == 5) & (i.min(axis=1) == 0)
    F = np.where(wraps[:, None] & (i == 0), (-j) % 6, F)
    facts = mesh_facts(V, F)
    assert (kinds(facts), facts.components[0].orientable) == ({(2, 0): 1}, False)
    _, F1, _ = repair_mesh(V, F)
    np.testing.assert_array_equal(F1, F)


def test_filled_holes_restore_the_genus():
    V, F = torus()
    open_torus = np.delete(F, [0, 1, 40], axis=0)
    facts = mesh_facts(V, open_torus)
    assert kinds(facts) == {(1, 2): 1}
    V1, F1, steps = repair_mesh(V, open_torus, largest_hole=4)
    assert ip.DeltaComplex.from_mesh(V1, F1).genus == 1
    assert steps[-2].changed == 2
    np.testing.assert_array_equal(V1[: len(V)], V)
    # However large the coordinates are, their mean is no infinity.
    huge, _, _ = repair_mesh(5e307 * V, open_torus, largest_hole=4)
    np.testing.assert_allclose(huge, 5e307 * V1, rtol=0, atol=1e293)
    # The centres of the two loops.
    centres = [V[F[40]].mean(axis=0), V[np.unique(F[:2])].mean(axis=0)]
    for centre in centres:
        assert np.abs(V1[len(V) :] - centre).max(axis=1).min() < 1e-15


def test_repair_refuses_what_leaves_nothing():
    with pytest.raises(ip.MeshError, match="no triangle is left after repair"):
        repair_mesh(np.zeros((3, 3)), np.array([[0, 1, 0]]))
    with pytest.raises(ip.MeshError, match="NaN or infinite"):
        repair_mesh(np.full((3, 3), np.nan), np.array([[0, 1, 2]]))


@pytest.mark.parametrize("function", [repair_mesh, split_components])
def test_arrays_that_are_no_mesh_are_refused(function):
    V = np.eye(3)
    for F, message in [
        (np.zeros((0, 3), dtype=int), "the mesh is empty: it has no faces"),
        ([[0, 1, 3]], "refers to vertex 3, out of range"),
        ([[0, 1, -1]], "negative indices"),
        ([[0, 1, 1.5]], "F must be integer"),
        ([[0, 1, 2], [0, 1]], "rows have different lengths"),
    ]:
        with pytest.raises(ip.MeshError, match=message):
            function(V, F)
    with pytest.raises(ip.MeshError, match="V must have shape"):
        function(np.zeros(3), [[0, 1, 2]])


def test_components_are_split_in_the_order_of_their_triangles():
    V, F = torus()
    W, quads = cube(10.0)
    parts = split_components(np.vstack([W, V]), np.vstack([F + len(W), halved(quads)]))
    assert [len(f) for _, f in parts] == [len(F), 12]
    np.testing.assert_array_equal(parts[0][0][parts[0][1]], V[F])
    np.testing.assert_array_equal(parts[1][0][parts[1][1]], W[halved(quads)])


def test_report_as_json_and_in_words(tmp_path):
    V, quads = cube()
    V, polygons = np.vstack([V, [5.0, 5.0, 5.0]]), quads[1:].tolist()
    path = written(tmp_path / "box.off", off(V, polygons))
    _, _, report = load_mesh(path, repair=True, largest_hole=4)
    document = json.loads(json.dumps(report.as_dict()))
    assert document["faces"] == document["polygons_fanned"] == 5
    assert document["loaded"]["boundary_edges"] == 4
    assert document["loaded"]["defects"] == ["4 edges with one triangle (boundary)"]
    assert document["result"]["defects"] == []
    assert document["result"]["components"] == [
        {"triangles": 14, "orientable": True, "genus": 0, "boundary_loops": 0}
    ]
    assert {step["name"]: step["changed"] for step in document["repair"]}[
        "holes of up to 4 edges filled"
    ] == 1
    assert str(report).splitlines() == [
        f"{path}: 9 vertices, 10 triangles",
        "  5 faces in the file; 5 polygons divided into triangles",
        "  1 vertex without triangles",
        "  genus 0, 1 boundary loop",
        "  defect: 4 edges with one triangle (boundary)",
        "  repair: holes of up to 4 edges filled: 1",
        "  repair: vertices without triangles dropped: 1",
        "after repair: 9 vertices, 14 triangles",
        "  genus 0, closed",
    ]
