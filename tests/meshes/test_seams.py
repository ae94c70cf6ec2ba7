"""Seams welded within a tolerance, edges without length contracted, and the way out in words."""

import re
from pathlib import Path

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.cli import main
from igl_periods.meshes.facts import mesh_facts
from igl_periods.meshes.repair import repair_mesh

CASES = Path(__file__).parent / "cases"


def torus(n=7, m=5):
    i, j = np.divmod(np.arange(n * m), m)
    u, v = 2 * np.pi * (i + 0.1) / n, 2 * np.pi * (j + 0.2) / m
    V = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], axis=1)
    a, b = m * i + j, m * ((i + 1) % n) + j
    c, d = m * ((i + 1) % n) + (j + 1) % m, m * i + (j + 1) % m
    return V, np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)


def soup(V, F, noise, seed=0):
    """Every triangle with vertices of its own, off by up to ``noise`` along each axis."""
    rng = np.random.default_rng(seed)
    return V[F].reshape(-1, 3) + noise * rng.uniform(-1, 1, (F.size, 3)), np.arange(F.size).reshape(
        -1, 3
    )


def steps(report_or_steps):
    return {step.name: step for step in report_or_steps if step.changed}


WELDED = "vertices welded within the tolerance"
CONTRACTED = "edges without length contracted"


@pytest.mark.parametrize("noise", [1e-16, 1e-13, 1e-10])
def test_noise_below_the_tolerance_is_welded_and_measured(noise):
    V, F = torus()
    V1, F1 = soup(V, F, noise)
    V2, F2, done = repair_mesh(V1, F1)
    assert (len(V2), ip.DeltaComplex.from_mesh(V2, F2).genus) == (len(V), 1)
    far = steps(done)[WELDED].distance if WELDED in steps(done) else 0.0
    assert far <= 2 * np.sqrt(3) * noise + 1e-15
    # No vertex is invented, and none moves further than that.
    assert np.linalg.norm(V2[F2] - V[F], axis=2).max() <= 4 * noise + 1e-15


def test_noise_above_the_tolerance_is_left_and_a_larger_one_welds_it():
    V, F = torus()
    V1, F1 = soup(V, F, 1e-6)
    _, F2, done = repair_mesh(V1, F1)
    assert WELDED not in steps(done)
    assert mesh_facts(V1, F1).boundary_edges == 3 * len(F)
    V2, F2, done = repair_mesh(V1, F1, weld=1e-5)
    assert ip.DeltaComplex.from_mesh(V2, F2).genus == 1
    assert 1e-7 < steps(done)[WELDED].distance < 4e-6
    assert re.search(
        r"welded within the tolerance: \d+, up to .*e-06 apart", str(steps(done)[WELDED])
    )
    # Zero is for what is equal.
    _, _, done = repair_mesh(*soup(V, F, 1e-16), weld=0.0)
    assert WELDED not in steps(done)


@pytest.mark.parametrize("weld", [-1e-9, 0.01, 1, np.nan, np.inf, "1e-9"])
def test_tolerances_that_are_none(weld):
    with pytest.raises(ip.MeshError, match="weld = .*: vertices are welded within a part"):
        repair_mesh(*torus(), weld=weld)


def test_no_triangle_is_collapsed():
    # A torus with a row of edges shorter than the tolerance, torn along all of its edges.
    V, F = torus()
    V = V.copy()
    V[1] = V[0] + 1e-12 * (V[1] - V[0])
    V1, F1 = soup(V, F, 1e-14)
    _, F2, _ = repair_mesh(V1, F1)
    assert len(F2) == len(F)
    assert ((F2 != np.roll(F2, 1, axis=1)).all(axis=1)).all()


def test_closed_sheets_that_nearly_touch_stay_apart():
    V, F = torus()
    for gap in (0.0, 1e-12):
        V2, F2 = np.vstack([V, V + gap]), np.vstack([F, F + len(V)])
        V3, F3, done = repair_mesh(V2, F2)
        np.testing.assert_array_equal(F3, F2)
        assert not steps(done)


def test_three_boundary_edges_at_one_place_are_no_seam():
    V = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1.0]])
    V = np.vstack([V, V[:2] + 1e-13, V[:2] - 1e-13])
    F = np.array([[0, 1, 2], [6, 5, 3], [7, 8, 4]])
    facts = mesh_facts(V, F)
    assert (facts.boundary_edges, facts.seam_edges) == (9, 0)
    assert not steps(repair_mesh(V, F)[2])


def test_seams_are_counted_and_named():
    V, F = torus()
    facts = mesh_facts(*soup(V, F, 1e-13))
    assert facts.seam_edges == facts.boundary_edges == 3 * len(F)
    assert (
        f"{3 * len(F)} edges with one triangle, in pairs at the same place (seams)"
        in facts.defects()
    )
    open_torus = mesh_facts(V, F[1:])
    assert (open_torus.seam_edges, open_torus.boundary_edges) == (0, 3)


def test_cad_part_with_rounded_corners_is_closed_of_genus_9(meshes):
    _, _, report = ip.load_mesh(meshes / "featuretype.stl", repair=True)
    assert [(part.genus, part.boundary_loops) for part in report.result.components] == [(9, 0)]
    assert report.result.is_closed_surface
    assert steps(report.repair)[WELDED].changed == 288
    assert 0 < steps(report.repair)[WELDED].distance < 1e-15
    _, _, exact = ip.load_mesh(meshes / "featuretype.stl", repair=True, weld=0.0)
    assert exact.result.boundary_edges == exact.result.seam_edges == 576


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
        nxt = [
            f
            for f in np.flatnonzero((F == a).any(axis=1) & (F == corner).any(axis=1))
            if f != current
        ][0]
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
    point, F2, done = repair_mesh(np.zeros((4, 3)), [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    assert len(F2) == 4
    assert CONTRACTED not in steps(done)


SQUARE = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"
CUBE_WITHOUT_LID = (
    "OFF\n8 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
)


def test_each_mesh_is_shown_its_own_way_out(tmp_path, capsys):
    torn = CASES / "stl_noise_near_zero.stl"
    square, box = tmp_path / "square.off", tmp_path / "box.off"
    square.write_text(SQUARE)
    box.write_text(CUBE_WITHOUT_LID)
    assert main(["compute", str(torn)]) == 1
    error = capsys.readouterr().err
    assert "lie in pairs at the same place" in error and "Repair the mesh first" in error
    assert "--double" not in error
    assert main(["compute", str(torn), "--repair"]) == 0
    assert "welded within the tolerance: 171, up to 4.7e-17 apart" in capsys.readouterr().out
    assert main(["compute", str(square)]) == 1
    error = capsys.readouterr().err
    assert "--fill-holes SIZE" in error and "--double" in error and "Repair" not in error
    # The log of the repair is shown with the refusal.
    assert main(["compute", str(box), "--fill-holes", "3"]) == 1
    error = capsys.readouterr().err
    assert "repair: nothing to do" in error and "defect: 4 edges with one triangle" in error
    assert main(["compute", str(box), "--fill-holes", "4"]) == 0
    assert "holes of up to 4 edges filled: 1" in capsys.readouterr().out


def test_the_double_of_a_torn_surface_is_warned_of(tmp_path, capsys):
    # A torus cut along one of its circles: a cylinder, whose double is another torus.
    V, F = torus()
    last = (F >= 30).any(axis=1) & (F < 5).any(axis=1)
    torn = np.where(last[:, None] & (F < 5), F + len(V), F)
    rows = "".join(" ".join(map(repr, x)) + "\n" for x in np.vstack([V, V[:5]]).tolist())
    faces = "".join(f"3 {a} {b} {c}\n" for a, b, c in torn)
    path = tmp_path / "torn.off"
    path.write_text(f"OFF\n{len(V) + 5} {len(F)} 0\n{rows}{faces}")
    assert main(["compute", str(path), "--double"]) == 0
    assert "warning: the double of a torn surface: 10 boundary edges" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "reason"),
    [(["--weld", "1"], "from 0 to 0.01"), (["--fill-holes", "-1"], "a number of edges")],
)
def test_options_that_are_none(capsys, options, reason):
    with pytest.raises(SystemExit):
        main(["compute", "x.off", *options])
    assert reason in capsys.readouterr().err
