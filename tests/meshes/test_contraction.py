"""Edges without length are contracted, which changes no distance."""

import numpy as np
from support.mesh_files import torus

import igl_periods as ip
from igl_periods.meshes.facts import mesh_facts
from igl_periods.meshes.repair import repair_mesh

CONTRACTED = "edges without length contracted"


def steps(done):
    return {step.name: step for step in done if step.changed}


def split_edge(V, F, face):
    """A vertex of a mesh doubled: two vertices at one place, and the two triangles between them."""
    a, b, c = F[face]
    other = int(
        np.flatnonzero((F == b).any(axis=1) & (F == a).any(axis=1) & (np.arange(len(F)) != face))[0]
    )
    # The fan at a from c to the far corner of the other face goes to the copy.
    d = int(F[other][(F[other] != a) & (F[other] != b)][0])
    new, G = len(V), F.copy()
    corner, current = c, face
    fan = []
    while corner != d or not fan:
        at = np.flatnonzero((F == a).any(axis=1) & (F == corner).any(axis=1))
        nxt = int(at[at != current][0])
        if nxt == other:
            break
        fan.append(nxt)
        corner = int(F[nxt][(F[nxt] != a) & (F[nxt] != corner)][0])
        current = nxt
        if len(fan) == 2:
            break
    for f in fan:
        G[f][G[f] == a] = new
    return np.vstack([V, V[a]]), np.vstack([G, [[a, new, c], [new, a, corner]]])


def test_edges_without_length_are_contracted_and_change_nothing():
    V, F = torus(8, 6)
    V1, F1 = split_edge(V, F, 0)
    facts = mesh_facts(V1, F1)
    assert [(part.genus, part.boundary_loops) for part in facts.components] == [(1, 0)]
    assert facts.zero_area_triangles == 2
    V2, F2, done = repair_mesh(V1, F1)
    assert steps(done)[CONTRACTED].changed == 1
    assert (len(V2), len(F2)) == (len(V), len(F))

    # The same triangles again.
    def rows(V, F):
        return np.array(
            sorted(
                np.roll(t, -int(np.lexsort(t.T[::-1])[0]), axis=0).ravel().tolist() for t in V[F]
            )
        )

    np.testing.assert_array_equal(rows(V2, F2), rows(V, F))


def test_a_hole_without_size_is_closed():
    # A pole written as a ring of vertices at one place, on a lathe-turned sphere.
    n = 9
    ring = 2 * np.pi * np.arange(n) / n
    V = np.vstack([
        np.column_stack([r * np.cos(ring), r * np.sin(ring), np.full(n, z)])
        for r, z in ((0.0, 1.0), (1.0, 0.3), (1.0, -0.4), (0.0, -1.0))
    ])  # fmt: skip
    i, k = np.divmod(np.arange(3 * n), n)
    a, b = n * i + k, n * i + (k + 1) % n
    F = np.stack([a, a + n, b + n, a, b + n, b], axis=1).reshape(-1, 3)
    assert mesh_facts(V, F).boundary_edges == 2 * n
    V1, F1, done = repair_mesh(V, F)
    assert steps(done)[CONTRACTED].changed == 2 * (n - 1)
    assert (len(V1), ip.DeltaComplex.from_mesh(V1, F1).genus) == (2 * n + 2, 0)


def test_contraction_keeps_what_has_no_room_for_it():
    # Where the ends have a third common neighbour, contraction would make sheets meet.
    V, F = torus(3, 3)
    V = V.copy()
    V[F[0, 1]] = V[F[0, 0]]
    _, F1, done = repair_mesh(V, F)
    assert ip.DeltaComplex.from_lengths(np.ones((len(F1), 3)), F1).genus == 1
    _, F2, done = repair_mesh(np.zeros((4, 3)), [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    assert len(F2) == 4
    assert CONTRACTED not in steps(done)
