"""Facts about meshes: known by hand, independent of numbering, each defect counted."""

import numpy as np
from support.mesh_files import torus
from support.mesh_index import kinds

from igl_periods.meshes.facts import mesh_facts


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
