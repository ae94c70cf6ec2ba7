"""Every format: what is written is read, and what is no mesh is refused."""

import struct

import numpy as np
import pytest
from support.mesh_files import (
    F4,
    FORMS,
    GOOD_PLY,
    TETRAHEDRON,
    V4,
    off,
    ply,
    stl,
    torus,
    written,
)

import igl_periods as ip
from igl_periods.meshes.load import load_mesh


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
    "long line": ("mesh.obj", TETRAHEDRON + "f" + " 1 2 3" * 400, "face 4 .*1200 corners. crosses"),
    "counted backwards too far": (
        "mesh.obj",
        TETRAHEDRON + "f -6 -1 -2\n",
        "vertex -6, counted backwards, and 4 vertices come before it",
    ),
    "many digits and a word": ("mesh.obj", "v" + 60 * " 111111111111" + " x\n", "no faces"),
    "infinity in digits": ("mesh.obj", TETRAHEDRON.replace("v 1", "v 1" + "0" * 309), "infinite"),
    "no OFF": ("mesh.off", "FOO\n4 4 0\n", "not OFF, COFF or NOFF"),
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
    "index 1.5": ("mesh.off", off(V4, [*F4, [1, 2, 1.5]]), "no face.*: '3 1 2 1.5'"),
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
    "NaN in ply": (
        "mesh.ply",
        GOOD_PLY.replace(b"1 0 0\n", b"nan 0 0\n"),
        "1 vertex has coordinates that are NaN",
    ),
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
        "holds no numbers that its header declares",
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
    "stl cut": ("mesh.stl", GOOD_STL[:-50], "no end: the file is truncated"),
    "binary stl cut": ("mesh.stl", BINARY_STL[:-30], "announced, and there are bytes for 3"),
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


def test_missing_file_and_folder(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"there is no mesh file '.*nothing\.off'"):
        load_mesh(tmp_path / "nothing.off")
    (tmp_path / "folder.off").mkdir()
    with pytest.raises(ip.MeshError, match="this is no file"):
        load_mesh(tmp_path / "folder.off")
