"""Files as programs write them: the same torus in every dialect, and refusals that say why."""

# ruff: noqa: E501  # one line for each case

import gzip
import struct
from pathlib import Path

import numpy as np
import pytest

import igl_periods as ip

CASES = Path(__file__).parents[1] / "cases"
TAU = 2.75085651j
DOUBLE = sorted(p.name for p in CASES.iterdir() if p.name[:3] in ("obj", "off", "tor"))
SINGLE = sorted(p.name for p in CASES.iterdir() if p.name[:3] in ("ply", "stl"))
ODD = {
    "stl_count_short.stl": "191 triangles are announced, and there are 192",
    "stl_trailing.stl": "17 bytes behind the 192 triangles .* ignored",
    "stl_no_endsolid.stl": "there is no 'endsolid'",
}


def load(path, **options):
    """Positions and triangles of a file that is not odd."""
    return ip.load_mesh(path, **options)[:2]


@pytest.fixture(scope="module")
def torus():
    return load(CASES / "torus.off")


def positions_of_corners(V, F):
    """The triangles as rows of nine numbers, in an order of their own."""
    rows = V[F].reshape(len(F), 9)
    return rows[np.lexsort(np.round(rows, 5).T)]


@pytest.mark.parametrize("name", [*DOUBLE, *SINGLE])
def test_every_dialect_is_the_same_torus(torus, name):
    path = CASES / name
    if name in ODD:
        with pytest.warns(UserWarning, match=ODD[name]):
            V, F = load(path, repair=True)
    else:
        V, F = load(path, repair=True)
    assert (len(V), len(F)) == (96, 192)
    expected = positions_of_corners(*torus)
    # Single precision, noise in the last bit, and nine digits in 3MF.
    tolerance = 0 if name.startswith(("obj", "off", "torus.o")) else 1e-6
    np.testing.assert_allclose(positions_of_corners(V, F), expected, rtol=0, atol=tolerance)


@pytest.mark.parametrize("name", ["torus.off", "stl_noise_last_bit.stl", "torus.3mf"])
def test_its_period_matrix(name):
    pm = ip.period_matrix(*load(CASES / name, repair=True), tolerance=1e-6).reduced()
    assert abs(pm.matrix[0, 0] - TAU) < 3e-6


TETRAHEDRON = (
    [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
)
V4, F4 = TETRAHEDRON
OBJ = "".join(f"v {x} {y} {z}\n" for x, y, z in V4) + "".join(
    f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in F4
)
OFF = (
    "OFF\n4 4 6\n"
    + "".join(f"{x} {y} {z}\n" for x, y, z in V4)
    + "".join(f"3 {a} {b} {c}\n" for a, b, c in F4)
)
PLY = (
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n" + OFF.split("\n", 2)[2]
)
STL = "solid a\n" + "".join(
    "facet normal 0 0 0\nouter loop\n"
    + "".join(f"vertex {V4[i][0]} {V4[i][1]} {V4[i][2]}\n" for i in f)
    + "endloop\nendfacet\n"
    for f in F4
) + "endsolid a\n"  # fmt: skip
BINARY_STL = b"made".ljust(80) + struct.pack("<I", 4) + b"".join(
    struct.pack("<12fH", 0, 0, 0, *(x for i in f for x in V4[i]), 0) for f in F4
)  # fmt: skip
BINARY_PLY = (
    PLY.split("end_header")[0].replace("ascii", "binary_little_endian").replace("\n", "\r")
    + "end_header\r"
).encode() + struct.pack("<12f", *(x for v in V4 for x in v)) + b"".join(
    struct.pack("<B3i", 3, *f) for f in F4
)  # fmt: skip
COORDINATES = OFF.split("\n", 2)[2]

DIALECTS = {
    # Numbers
    "Fortran": ("a.obj", OBJ.replace("v 1 0 0", "v 1.0D+00 0.0d0 0.")),
    "decimal commas": ("a.obj", OBJ.replace("v 1 0 0", "v 1,0 0,0e0 0,00")),
    "zeros with three decimals": ("a.obj", OBJ.replace("v 1 0 0", "v 1,000 0,000 0,000")),
    "commas in off": ("a.off", OFF.replace("\n1 0 0", "\n1,0 0,0 0")),
    # Encodings, ends of lines, ends of files
    "utf-16 without mark": ("a.obj", OBJ.encode("utf-16-le")),
    "utf-16, the other order": ("a.off", b"\xfe\xff" + OFF.encode("utf-16-be")),
    "utf-32": ("a.obj", OBJ.encode("utf-32")),
    "utf-16 ply": ("a.ply", PLY.encode("utf-16")),
    "utf-16 stl": ("a.stl", STL.encode("utf-16")),
    "mark before ply": ("a.ply", b"\xef\xbb\xbf" + PLY.encode()),
    "mark before stl": ("a.stl", b"\xef\xbb\xbf" + STL.encode()),
    "end of a file of DOS": ("a.obj", OBJ + "\x1a"),
    "zeros at the end": ("a.off", OFF + "\0\0\0"),
    "old Macintosh": ("a.obj", OBJ.replace("\n", "\r")),
    "latin comments": ("a.obj", b"# \xe9\xe8\n" + OBJ.encode()),
    # OBJ
    "w and colours": ("a.obj", OBJ.replace("v 1 0 0", "v 1 0 0 1 nan -inf x")),
    "old faces": ("a.obj", OBJ.replace("f 1 3 2", "fo 1 3 2")),
    "indices with decimals": ("a.obj", OBJ.replace("f 1 3 2", "f 1.0/1.0 3.000000 2.0e+00//")),
    "continued with blanks": ("a.obj", OBJ.replace("f 1 3 2", "f 1 \\\r\n 3 \\\r\n 2")),
    # OFF
    "small letters": ("a.off", OFF.replace("OFF", "off")),
    "edges not counted": ("a.off", OFF.replace("4 4 6", "4 4")),
    "counts on lines": ("a.off", OFF.replace("4 4 6", "4\n4\n6")),
    "one line": ("a.off", OFF.replace("\n", " ")),
    "one word a line": ("a.off", OFF.replace(" ", "\n")),
    "normals before texture": ("a.off", OFF.replace("OFF", "STNOFF").replace(
        COORDINATES, "".join(f"{x} {y} {z} 0 0 1 .5 .5\n" for x, y, z in V4) + COORDINATES.split("\n", 4)[4])),
    "colours without line breaks": ("a.off", "COFF 4 4 0 " + " ".join(
        f"{x} {y} {z} 1 0 0 1" for x, y, z in V4) + " " + COORDINATES.split("\n", 4)[4].replace("\n", " ")),
    "colours of three": ("a.off", "COFF 4 4 0 " + " ".join(
        f"{x} {y} {z} 1 0 0" for x, y, z in V4) + " " + COORDINATES.split("\n", 4)[4].replace("\n", " ")),
    "colours of faces": ("a.off", OFF.replace("3 0 2 1", "3 0 2 1 255 0 0").replace("3 0 1 3", "3 0 1 3 0.5 1 1 1")),
    "dimension three": ("a.off", OFF.replace("OFF", "nOFF 3")),
    "comments first": ("a.off", "# by hand\n\n" + OFF.replace("\n", " # here\n")),
    # PLY
    "rows broken": ("a.ply", PLY.replace("0 1 0\n", "0\n1 0\n")),
    "one long row": ("a.ply", PLY.split("end_header\n")[0] + "end_header\n" + COORDINATES.replace("\n", " ")),
    "capitals": ("a.ply", PLY.replace("float x", "float X").replace("element face", "element Face")),
    "obj_info": ("a.ply", PLY.replace("element face", "obj_info end_header\nelement face")),
    "texture lists": ("a.ply", PLY.replace(
        "end_header", "property list uchar float texcoord\nend_header").replace("3 0 2 1", "3 0 2 1 2 .5 .5").replace(
        "3 0 1 3", "3 0 1 3 0").replace("3 0 3 2", "3 0 3 2 0").replace("3 1 2 3", "3 1 2 3 0")),
    "returns and bytes": ("a.ply", BINARY_PLY),
    "long indices": ("a.ply", PLY.replace("list uchar int", "list uchar int64")),
    # STL
    "capitals in stl": ("a.stl", STL.upper()),
    "one line of stl": ("a.stl", STL.replace("\n", " ")),
    "two solids": ("a.stl", STL.replace("facet normal 0 0 0\nouter loop\nvertex 1", "endsolid\nsolid b c\nfacet normal 0 0 0\nouter loop\nvertex 1", 1)),
    "name with its words": ("a.stl", STL.replace("solid a", "solid facet vertex endfacet")),
    "normals of any kind": ("a.stl", STL.replace("normal 0 0 0", "normal -nan(ind) 1,#QNAN nan", 2)),
    "words with spaces": ("a.stl", STL.replace("endloop", "end loop").replace("endfacet", "end facet")),
    "tabs": ("a.stl", STL.replace("facet", "\tfacet").replace(" ", "\t").replace("\n", "\r\n")),
    "header that says solid": ("a.stl", b"solid " + BINARY_STL[6:]),
}  # fmt: skip


@pytest.mark.parametrize("name", DIALECTS)
def test_dialects_that_mean_the_tetrahedron(tmp_path, name):
    file, content = DIALECTS[name]
    path = tmp_path / file
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    V, F = load(path)
    np.testing.assert_array_equal(V[F], np.array(V4, float)[np.array(F4)])


REFUSED = {
    "thousands": ("a.obj", OBJ.replace("v 1 0 0", "v 1,000 2,500 0"), "not clear what commas"),
    "thousands and decimals": ("a.obj", OBJ.replace("v 1 0 0", "v 1,000.5 0 0"), "not clear what comm"),
    "commas between": ("a.obj", OBJ.replace("v 1 0 0", "v 1, 0, 0"), "not clear what commas"),
    "NaN of Windows": ("a.obj", OBJ.replace("v 1 0 0", "v 1.#QNAN 0 0"), "not a vertex"),
    "index 1.5": ("a.obj", OBJ.replace("f 1 3 2", "f 1.5 3 2"), "not a face.*'f 1.5 3 2'"),
    "before the start": ("a.obj", OBJ.replace("f 1 3 2", "f -9 3 2"), "vertex -9, counted backw"),
    "underscore": ("a.off", OFF.replace("\n1 0 0", "\n1_0 0 0"), "not a vertex.*'1_0 0 0'"),
    "four dimensions": ("a.off", OFF.replace("OFF", "nOFF 4"), "lies in dimension '4', and 3"),
    "at infinity": (
        "a.off",
        OFF.replace("OFF", "4OFF").replace("0 0 0\n", "0 0 0 0\n").replace("1 0 0\n", "1 0 0 1\n")
        .replace("0 1 0\n", "0 1 0 1\n").replace("0 0 1\n3", "0 0 1 1\n3"),
        "the last is 0, lie at infinity",
    ),
    "counts too small": ("a.off", OFF.replace("4 4 6", "4 3 6").replace("\n", " "), "cannot be divided"),
    "counts too large": ("a.off", OFF.replace("4 4 6", "4 5 6"), "truncated, or its counts"),
    "binary off": ("a.off", "OFF BINARY\n\x01", "binary OFF"),
    "two lists": (
        "a.ply",
        PLY.replace("vertex_indices", "vertices").replace("end_header", "property list uchar int indices\nend_header"),
        "vertices, indices, and none is called|ends early",
    ),
    "floats that are not indices": ("a.ply", PLY.replace("uchar int", "uchar float").replace("3 0 2 1", "3 0 2 0.5"), "holds no numbers"),
    "half a facet": ("a.stl", STL[: STL.rindex("endloop")], "the last facet has no end"),
    "four vertices": ("a.stl", STL.replace("endloop", "vertex 5 5 5\nendloop", 1), "not every facet has three"),
    "fewer triangles than announced": ("a.stl", BINARY_STL[:-50], "4 triangles are announced, .* for 3"),
    "short and binary": ("a.stl", BINARY_STL[:70], "is not STL.*with 70 bytes"),
    "count unknown, half a triangle": ("a.stl", BINARY_STL[:80] + b"\0" * 4 + BINARY_STL[84:-7], "not a whole number"),
    "CAD": ("a.stp", "ISO-10303-21;", "format '.stp' is not one of .*Export the part as STL or 3MF"),
    "FBX": ("a.fbx", "; FBX 7.4.0", "format '.fbx' is not one of .*Export the mesh as glTF or OBJ"),
    "pointer": ("a.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:1\n", "Git LFS"),
    "web page": ("a.obj", "<!DOCTYPE html><html></html>", "a web page"),
    "compressed, named otherwise": ("a.obj", gzip.compress(OBJ.encode()), "its name has to end in .gz"),
    "not compressed": ("a.obj.gz", OBJ, "not a gzip file"),
    "half of it": ("a.obj.gz", gzip.compress(OBJ.encode() * 50)[:-20], "not a gzip file, or truncated"),
    "empty inside": ("a.obj.gz", gzip.compress(b""), "the file is empty"),
    "unknown inside": ("a.step.gz", gzip.compress(b"x"), "format '.step' is not one of"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_refusals_say_the_true_reason(tmp_path, name):
    file, content, reason = REFUSED[name]
    path = tmp_path / file
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(ip.MeshError, match=reason) as refusal:
        ip.load_mesh(path)
    assert str(path) in str(refusal.value)


def test_homogeneous_coordinates_are_divided_and_that_is_said(tmp_path):
    rows = "".join(f"{2 * x} {2 * y} {2 * z} 2\n" for x, y, z in V4)
    path = tmp_path / "a.off"
    path.write_text("4OFF\n4 4 6\n" + rows + COORDINATES.split("\n", 4)[4])
    with pytest.warns(UserWarning, match="divided by the last"):
        V, _, report = ip.load_mesh(path)
    np.testing.assert_array_equal(V, V4)
    assert "warning: vertices have four coordinates" in str(report)


def test_what_an_obj_file_holds_besides_polygons_is_said(tmp_path):
    path = tmp_path / "a.obj"
    path.write_text(OBJ + "cstype bspline\nsurf 0 1 0 1 1 2 3 4\n")
    with pytest.warns(UserWarning, match="only polygons are read, and the file holds surf too"):
        ip.load_mesh(path)


@pytest.mark.parametrize("count", [0, 2**32 - 1])
def test_counts_that_are_not_known_when_they_are_written(tmp_path, count):
    path = tmp_path / "a.stl"
    path.write_bytes(BINARY_STL[:80] + struct.pack("<I", count) + BINARY_STL[84:])
    with pytest.warns(UserWarning, match=f"{count} triangles are announced, and there are 4"):
        assert len(ip.load_mesh(path)[1]) == 4


@pytest.mark.parametrize("name", ["a.obj", "a.off", "a.ply", "a.stl"])
def test_compressed_files_are_those_inside(tmp_path, name):
    content = {"a.obj": OBJ, "a.off": OFF, "a.ply": PLY, "a.stl": STL}[name].encode()
    (tmp_path / name).write_bytes(content)
    (tmp_path / f"{name}.GZ").write_bytes(gzip.compress(content))
    for one, other in zip(load(tmp_path / name), load(tmp_path / f"{name}.GZ")):
        np.testing.assert_array_equal(one, other)
