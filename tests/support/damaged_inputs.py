"""Hypothesis strategies: damaged files, meshes and gluings, most of them just a little."""

import contextlib
import json
import re
import struct
import warnings

import numpy as np
from hypothesis import strategies as st
from support.mesh_files import cube, glb, gltf, halved, obj, off, ply, stl, torus
from support.random_surfaces import needle_gluing, random_gluing, random_lengths

_SEEDS = st.integers(0, 2**32 - 1)
_TORUS, _CUBE = torus(3, 3), cube()
_MESHES = [(V, F.tolist()) for V, F in (_TORUS, _CUBE)]


def _gluing_file():
    twin = random_gluing(4, np.random.default_rng(5))
    lengths = random_lengths(twin, np.random.default_rng(5))
    return json.dumps({"lengths": lengths.tolist(), "twin": twin.tolist()}).encode()


def _triangles(F):
    return halved(np.array(F)) if len(F[0]) == 4 else np.array(F)


# Good files: (extension, content).
FILES = [
    (extension, content if isinstance(content, bytes) else content.encode())
    for V, F in _MESHES
    for extension, content in (
        (".obj", obj(V, F)),
        (".off", off(V, F)),
        (".ply", ply(V, F)),
        (".ply", ply(V, F, "binary_little_endian")),
        (".ply", ply(V, F, "binary_big_endian")),
        (".stl", stl(V, _triangles(F), binary=False)),
        (".stl", stl(V, _triangles(F), binary=True)),
    )
] + [(".json", _gluing_file())]
SCENES = [
    file
    for V, F in _MESHES
    for file in (
        (".gltf", gltf(V, _triangles(F)).encode()),
        (".glb", glb(V, _triangles(F))),
    )
]

_TOKENS = [
    b"-1", b"0", b"1", b"3", b"4", b"7", b"255", b"256", b"-7", b"-6", b"2147483648", b"4294967295",
    b"4294967296", b"9223372036854775808", b"99999999999999999999", b"9" * 5000, b"1.5", b"nan",
    b"inf", b"-inf", b"1e400", b"1e-320", b"1e200", b"-1e308", b"1e39", b"1_0", b"0x10", b"--1",
    b"\xb2", b"\xff\xff\xff\xff", b"1/2/3/4", b"1//", b"1/", b"-", b"", b"f", b"v", b"#", b"\\",
    b"NaN", b"Infinity", b"null", b"[]", b"[" * 20000, b"{}", b'"', b"list", b"char", b"uchar",
    b"float", b"double", b"int", b"vertex", b"face", b"element face 9", b"end_header", b"ascii",
    b"property list uchar int vertex_indices", b"property float x", b"\nvertex_index\n", b"solid",
    b"endsolid", b"endfacet", b"OFF", b"COFF", b"binary_little_endian", b"1" * 300,
    b"1e5" + b"0" * 40, b"11111 " * 60,
]  # fmt: skip
_WORDS = [
    *(struct.pack("<I", n) for n in (0, 1, 3, 255, 2**31 - 1, 2**31, 2**32 - 1)),
    *(struct.pack(">I", n) for n in (1, 3, 2**31 - 1)),
    *(struct.pack("<f", x) for x in (np.nan, np.inf, -np.inf, 3e38, 1e-45, 0.0, -0.0)),
    *(struct.pack("<d", x) for x in (np.nan, np.inf, 1e308, 5e-324)),
]
_JUNK = [b"\n", b"\r", b"\r\n", b" ", b"\t", b"\0", b"\xef\xbb\xbf", b"\x1a", b"\v", b"\f", b"\x85"]


def _split_tokens(data):
    """Words and what is between them, alternating."""
    return re.split(rb"([^\s,\[\]]+)", data)


def _damaged(data, how, where, other, what):
    """One change of the bytes; ``where`` and ``other`` in [0, 1) say where."""
    n = len(data)
    i, j = sorted((int(where * (n + 1)), int(other * (n + 1))))
    if how == "cut":
        return data[:i]
    if how == "drop":
        return data[:i] + data[j:]
    if how == "repeat":
        return data[:j] + data[i:]
    if how == "flip" and i < n:
        return data[:i] + bytes([data[i] ^ (1 << (what % 8))]) + data[i + 1 :]
    if how == "insert":
        junk = (_JUNK + _TOKENS)[what % (len(_JUNK) + len(_TOKENS))]
        return data[:i] + junk + data[i:]
    if how == "overwrite":
        word = _WORDS[what % len(_WORDS)]
        return data[:i] + word + data[i + len(word) :]
    if how == "token":
        parts = _split_tokens(data)
        k = 2 * int(where * (len(parts) // 2)) + 1
        if k < len(parts):
            parts[k] = _TOKENS[what % len(_TOKENS)]
        return b"".join(parts)
    if how == "swap":
        parts = _split_tokens(data)
        k, m = (2 * int(x * (len(parts) // 2)) + 1 for x in (where, other))
        if max(k, m) < len(parts):
            parts[k], parts[m] = parts[m], parts[k]
        return b"".join(parts)
    if how == "line":
        lines = data.split(b"\n")
        k, m = int(where * len(lines)), int(other * len(lines))
        lines.insert(k, lines[m])
        return b"\n".join(lines)
    if how == "unline":
        lines = data.split(b"\n")
        del lines[int(where * len(lines))]
        return b"\n".join(lines)
    if how == "crlf":
        return data.replace(b"\n", b"\r\n")
    if how == "cr":
        return data.replace(b"\n", b"\r")
    return data


_HOW = ["cut", "drop", "repeat", "flip", "insert", "overwrite", "token", "swap", "line", "unline"]
_WHERE = st.floats(0, 1, exclude_max=True, allow_subnormal=False)
_CHANGES = st.tuples(
    st.sampled_from([*_HOW, "token", "token", "overwrite", "crlf", "cr"]),
    _WHERE,
    _WHERE,
    st.integers(0, 10_000),
)


@st.composite
def files(draw, good=FILES):
    """Extension and content of a good file, changed here and there; one in ten is noise."""
    extension, data = draw(st.sampled_from(good))
    if draw(st.integers(0, 9)) == 0:
        return extension, draw(st.binary(max_size=200))
    for change in draw(st.lists(_CHANGES, max_size=2)):
        data = _damaged(data, *change)
    return extension, data


_COORDINATES = [0.0, 1.0, -1.0, 0.5, np.nan, np.inf, 1e308, -1e308, 1e160, 1e-160, 1e-308, 5e-324,
                1e59, 1e61, 1e-61, 1e8, 1.0 + 2**-52, 1e-14]  # fmt: skip
_INDICES = [-1, 0, 1, 5, 8, 9, 100, 2**31, 2**32, 2**62, -(2**63), 2**63 - 1]
_DTYPES = ["float32", "float16", "int64", "int8", "uint64", "bool", "complex128", "object", "U5",
           "longdouble", "datetime64[s]"]  # fmt: skip


@st.composite
def meshes(draw):
    """V, F: some triangles of a small closed surface, changed here and there."""
    rng = np.random.default_rng(draw(_SEEDS))
    V, F = draw(st.sampled_from(_MESHES))
    V, F = V.copy(), _triangles(F)
    if draw(st.booleans()):
        V = V + draw(st.sampled_from([1e-12, 1e-3, 0.3, 3.0])) * rng.normal(size=V.shape)
    for how in draw(st.lists(st.sampled_from(sorted(_MESH_CHANGES)), max_size=4)):
        # What does not apply to what is left of the mesh is left out.
        with contextlib.suppress(IndexError, ValueError), np.errstate(all="ignore"):
            V, F = _MESH_CHANGES[how](V, F, rng)
    if draw(st.integers(0, 19)) == 0:
        V, F = _other_types(V, F, draw(st.sampled_from(_DTYPES)), draw(st.booleans()))
    return V, F


def _at(array, rng, value):
    array = array.copy()
    array[tuple(rng.integers(n) for n in array.shape)] = value
    return array


_MESH_CHANGES = {
    "coordinate": lambda V, F, rng: (_at(V, rng, rng.choice(_COORDINATES)), F),
    "index": lambda V, F, rng: (V, _at(F, rng, _INDICES[rng.integers(len(_INDICES))])),
    "near index": lambda V, F, rng: (V, _at(F, rng, rng.integers(len(V) + 1))),
    "merge": lambda V, F, rng: (V, np.where(rng.integers(len(V)) == F, rng.integers(len(V)), F)),
    "coincide": lambda V, F, rng: (V[np.where(rng.random(len(V)) < 0.2, 0, np.arange(len(V)))], F),
    "near": lambda V, F, rng: (V[0] + (V - V[0]) * 10.0 ** -rng.integers(0, 16, (len(V), 1)), F),
    "flat": lambda V, F, rng: (V * [1, 1, 0], F),
    "collinear": lambda V, F, rng: (V * [1, 0, 0], F),
    "lattice": lambda V, F, rng: (np.round(V, int(rng.integers(0, 3))), F),
    "scale": lambda V, F, rng: (V * 10.0 ** rng.integers(-70, 70), F),
    "squeeze": lambda V, F, rng: (V * 10.0 ** -rng.integers(0, 17, 3), F),
    "delete": lambda V, F, rng: (V, np.delete(F, rng.integers(len(F)), 0)),
    "repeat": lambda V, F, rng: (V, np.vstack([F, F[rng.integers(len(F), size=2)]])),
    "turn": lambda V, F, rng: (V, np.where((rng.random(len(F)) < 0.3)[:, None], F[:, ::-1], F)),
    "second": lambda V, F, rng: (np.vstack([V, V + rng.integers(3)]), np.vstack([F, F + len(V)])),
    "touch": lambda V, F, rng: (np.vstack([V, V]), np.vstack([F, np.where(F, F + len(V), 0)])),
    "soup": lambda V, F, rng: (V[F].reshape(-1, V.shape[1]), np.arange(F.size).reshape(-1, 3)),
    "random": lambda V, F, rng: (V, rng.integers(len(V), size=F.shape)),
    "shuffle": lambda V, F, rng: (V, rng.permuted(F, axis=1)),
    "dimension": lambda V, F, rng: (V[:, :2] if rng.integers(2) else np.hstack([V, V]), F),
    "one": lambda V, F, rng: (V, F[:1]),
    "none": lambda V, F, rng: (V, F[:0]),
    "transpose": lambda V, F, rng: (V.T, F.T),
    "fan": lambda V, F, rng: (V, np.vstack([F, [[0, 1, k] for k in range(2, min(len(V), 6))]])),
}  # fmt: skip


def _other_types(V, F, dtype, lists):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            V = V.astype(dtype)
        except (ValueError, TypeError, OverflowError):
            F = F.astype(float)
    if lists:
        return [*V.tolist(), [1]], F.tolist()
    return V, F


@st.composite
def gluings(draw):
    """lengths, twin, same: a random gluing of triangles, changed here and there."""
    rng = np.random.default_rng(draw(_SEEDS))
    twin = random_gluing(2 * draw(st.integers(1, 5)), rng)
    lengths = random_lengths(twin, rng)
    same = np.zeros(twin.shape, dtype=bool)
    for how in draw(st.lists(st.sampled_from(sorted(_GLUING_CHANGES)), max_size=3)):
        with contextlib.suppress(IndexError, ValueError), np.errstate(all="ignore"):
            lengths, twin, same = _GLUING_CHANGES[how](lengths, twin, same, rng)
    if draw(st.integers(0, 19)) == 0:
        dtype = draw(st.sampled_from(_DTYPES))
        lengths, twin = _other_types(lengths, twin, dtype, draw(st.booleans()))
    return lengths, twin, same


def _both(array, twin, rng, value):
    """A value at a side and at the side glued to it."""
    array, h = array.copy(), int(rng.integers(array.size))
    array.flat[h] = value
    if 0 <= twin.flat[h] < array.size:
        array.flat[twin.flat[h]] = value
    return array


_GLUING_CHANGES = {
    "length": lambda le, tw, sa, rng: (_both(le, tw, rng, rng.choice(_COORDINATES)), tw, sa),
    "one length": lambda le, tw, sa, rng: (_at(le, rng, rng.choice(_COORDINATES)), tw, sa),
    "rounded": lambda le, tw, sa, rng: (le * (1 + 1e-12 * rng.normal(size=le.shape)), tw, sa),
    "thin": lambda le, tw, sa, rng: (_both(le, tw, rng, 10.0 ** -rng.uniform(0, 16)), tw, sa),
    "scale": lambda le, tw, sa, rng: (le * 10.0 ** rng.integers(-70, 70), tw, sa),
    "equal": lambda le, tw, sa, rng: (np.ones(le.shape), tw, sa),
    "collinear": lambda le, tw, sa, rng: (np.tile([1.0, 1.0, 2.0], (len(le), 1)), tw, sa),
    "twin": lambda le, tw, sa, rng: (le, _at(tw, rng, _INDICES[rng.integers(len(_INDICES))]), sa),
    "free": lambda le, tw, sa, rng: (le, _both(tw, tw, rng, -1), sa),
    "same": lambda le, tw, sa, rng: (le, tw, _both(sa, tw, rng, True)),
    "one same": lambda le, tw, sa, rng: (le, tw, _at(sa, rng, True)),
    "one face less": lambda le, tw, sa, rng: (le[1:], tw[1:], sa[1:]),
    "one row less": lambda le, tw, sa, rng: (le[1:], tw, sa),
    "flat": lambda le, tw, sa, rng: (le.ravel(), tw, sa),
}


@st.composite
def lengths(draw):
    """lengths, F: the side lengths of a mesh, changed here and there."""
    V, F = draw(meshes())
    rng = np.random.default_rng(draw(_SEEDS))
    with contextlib.suppress(Exception), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        corners = V[F]
        sides = np.linalg.norm(np.roll(corners, -1, 1) - np.roll(corners, 1, 1), axis=2)
        if draw(st.integers(0, 3)) == 0:
            sides = _at(sides, rng, rng.choice(_COORDINATES))
        if draw(st.integers(0, 9)) == 0:
            sides = sides[1:]
        return sides, F
    return V, F


@st.composite
def squares(draw):
    """Gluings of squares, changed here and there, and how often these are divided."""
    rng = np.random.default_rng(draw(_SEEDS))
    n_squares = draw(st.integers(0, 4))
    sides = rng.permutation([(k, s) for k in range(n_squares) for s in range(4)]).tolist()
    gluing = [list(pair) for pair in zip(sides[0::2], sides[1::2])]
    n = draw(st.sampled_from([1, 1, 2, 3]))
    match draw(st.integers(0, 12)):
        case 0:
            gluing = gluing[1:]
        case 1:
            gluing = gluing + gluing[:1]
        case 2 if gluing:
            gluing[0][0][draw(st.integers(0, 1))] = draw(st.sampled_from([*_INDICES, 4, 0.5, None]))
        case 3 if gluing:
            gluing[0] = gluing[0][:1]
        case 4:
            gluing = draw(st.sampled_from([None, 3, "squares", {}, [[]], [1, 2], [None]]))
        case 5:
            n = draw(st.sampled_from([0, -1, 1.5, None, "2", 10**6, 10**9, 10**18]))
    return gluing, n


@st.composite
def needles(draw):
    """lengths, twin, same: glued needles, undamaged."""
    rng = np.random.default_rng(draw(_SEEDS))
    lengths, twin = needle_gluing(2 * draw(st.integers(1, 6)), draw(st.floats(1, 14)), rng)
    return lengths, twin, np.zeros(twin.shape, dtype=bool)
