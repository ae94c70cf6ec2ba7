"""Mesh files of others, described, repaired and refused as their index says."""

import numpy as np
import pytest
from support.mesh_files import cube, halved, torus
from support.mesh_index import INDEX, kinds

import igl_periods as ip
from igl_periods.complexes.surface_checks import check_surface
from igl_periods.meshes.load import load_mesh, split_components

QUADRILATERALS = {"wente_torus02.obj": 1240, "moebius.obj": 224, "two-tori.obj": 1152}


NOT_ORIENTABLE = {"moebius.obj", "klein_zero_coords.off"}


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


def test_components_are_split_in_the_order_of_their_triangles():
    V, F = torus()
    W, quads = cube(10.0)
    parts = split_components(np.vstack([W, V]), np.vstack([F + len(W), halved(quads)]))
    assert [len(f) for _, f in parts] == [len(F), 12]
    np.testing.assert_array_equal(parts[0][0][parts[0][1]], V[F])
    np.testing.assert_array_equal(parts[1][0][parts[1][1]], W[halved(quads)])
