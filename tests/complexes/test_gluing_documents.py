"""Surfaces as JSON: what is written is what is read."""

import json

import flint
import numpy as np
import pytest
from support.glued_polygons import L_PAIRS, l_vertices

import igl_periods as ip

GOLDEN = ip.algebraic_number([-1, -1, 1], 1.6)


def surfaces():
    yield "golden L", ip.surfaces.l_shape(GOLDEN)
    yield "rational", ip.surfaces.l_shape("3/2", 4)
    yield "unfolded", ip.surfaces.triangle_unfolding(1, 2, 4)
    yield "squares", ip.surfaces.origami("(1,2)", "(1,3)", 2)
    yield "klein", ip.surfaces.regular_map_surface("klein", 2)
    yield "bring", ip.surfaces.regular_map_surface("bring")
    yield (
        "rounded",
        ip.DeltaComplex.from_polygons(
            [np.exp(2j * np.pi * np.arange(10) / 10)], [((0, k), (0, k + 5)) for k in range(5)]
        ),
    )
    yield "lengths alone", ip.surfaces.regular_map_surface("klein", 1).components()[0]
    yield "boundary", ip.DeltaComplex.from_lengths([[1, 1, 1]], [[0, 1, 2]])


@pytest.mark.parametrize(("name", "K"), [*surfaces()])
def test_there_and_back(name, K, tmp_path):
    text = K.to_json()
    L = ip.DeltaComplex.from_json(text)
    for attribute in ("lengths", "twin", "edge", "sign", "corner_vertex"):
        assert np.array_equal(getattr(K, attribute), getattr(L, attribute)), attribute
    assert L.to_json() == text
    assert (K.exact_lengths is None) == (L.exact_lengths is None)
    if K.exact_lengths is not None:
        for a, b in zip(K.exact_lengths(500), L.exact_lengths(500)):
            assert a.overlaps(b)
            assert float(b.rad()) < 1e-140
    if K.polygons is not None:
        assert L.polygons.vertices == K.polygons.vertices
        assert L.polygons.gluing == K.polygons.gluing
        assert L.polygons.rounded == K.polygons.rounded
    # What the command line and load read.
    path = tmp_path / "surface.json"
    path.write_text(text)
    from igl_periods.meshes import read_surface

    (found,), report = read_surface(path)
    assert report is None
    assert np.array_equal(found.lengths, K.lengths)


def test_numbers_are_texts():
    document = json.loads(ip.surfaces.l_shape(GOLDEN).to_json())
    assert document["polygons"]["field"] == {"polynomial": [-1, -1, 1], "root": 1}
    assert document["polygons"]["vertices"][0][2] == [["0", "1"], "0"]
    document = json.loads(ip.surfaces.l_shape("3/2").to_json())
    assert document["polygons"]["vertices"][0][2] == ["3/2", "0"]
    document = json.loads(ip.surfaces.square_tiled_surface("omega_1").to_json())
    assert document["exact"]["lengths"] == ["sqrt(1)", "sqrt(2)"]


def test_computed_numbers_are_balls_of_200_digits():
    def root(bits):
        return flint.arb(2).sqrt()

    K = ip.DeltaComplex.from_polygons([l_vertices(root)], L_PAIRS)
    L = ip.DeltaComplex.from_json(K.to_json())
    assert "+/-" in K.to_json()
    with flint.ctx.workprec(800):
        assert all(a.overlaps(b) for a, b in zip(K.exact_lengths(800), L.exact_lengths(800)))
        assert max(float(x.rad()) for x in L.exact_lengths(800)) < 1e-195


def test_gluings_that_reverse_orientations():
    from support.flat_surfaces import flat_strip

    K = flat_strip(1, 1, 4, 3, glue_x="turned")
    L = ip.DeltaComplex.from_json(K.to_json())
    assert L.n_reversing_edges == K.n_reversing_edges > 0


def test_what_others_wrote_is_read():
    document = {"lengths": [[1, 1, 1], [1, 1, 1]], "twin": [[3, 4, 5], [0, 1, 2]]}
    K = ip.DeltaComplex.from_json(document)
    assert (K.n_faces, K.genus) == (2, 1)
    assert ip.DeltaComplex.from_json(json.dumps(document)).exact_lengths is None


@pytest.mark.parametrize(
    ("change", "error", "message"),
    [
        ({"twin": None}, ip.ComplexError, "twin must"),
        ({"lengths": 3}, ip.ComplexError, r"lengths must have shape"),
        ({"polygons": 3}, ip.MeshError, "the file holds no gluing"),
        ({"polygons": {"vertices": [[[["0", "1"], "0"]]], "gluing": []}}, ip.MeshError,
         "a coordinate in a field that is not given"),
        ({"polygons": {"vertices": [[[0, 0], [1, 0], [1, 1], [0, 1]]],
                       "gluing": [[[0, 0], [0, 2]], [[0, 1], [0, 3]]]}}, ip.ComplexError,
         "the polygons of the file are not divided into the triangles of it"),
        ({"exact": {"kinds": [[0, 0, 0]], "lengths": ["sqrt(1)"]}}, ip.ComplexError,
         "the exact lengths of the file are not those of 2 faces"),
        ({"exact": {"kinds": [[0, 0, 0]] * 2, "lengths": ["sqrt(one)"]}}, ip.MeshError,
         "the file holds no gluing"),
    ],
)  # fmt: skip
def test_documents_that_say_nothing(change, error, message):
    document = {"lengths": [[1, 1, 1], [1, 1, 1]], "twin": [[3, 4, 5], [0, 1, 2]]}
    with pytest.raises(error, match=message):
        ip.DeltaComplex.from_json(document | change)
    with pytest.raises(ip.MeshError, match="the file holds no gluing"):
        ip.DeltaComplex.from_json("no JSON")
