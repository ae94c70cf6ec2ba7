"""Repair: what it undoes, restores, keeps apart and refuses."""

import numpy as np
import pytest
from support.mesh_files import cube, halved, torus
from support.mesh_index import INDEX, kinds

import igl_periods as ip
from igl_periods.meshes.facts import mesh_facts
from igl_periods.meshes.load import split_components
from igl_periods.meshes.repair import repair_mesh


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
    # However large the coordinates are, their mean is not an infinity.
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


@pytest.mark.parametrize(
    ("size", "message"),
    [
        (-1, "largest_hole = -1: holes have a number of edges"),
        (2.5, "largest_hole must be an integer, not 2.5"),
        ("4", "largest_hole must be an integer, not the string '4'"),
    ],
)
def test_sizes_of_holes_are_numbers_of_edges(size, message):
    with pytest.raises(ip.MeshError, match=message):
        repair_mesh(*torus(), largest_hole=size)


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
