"""Seams welded within a tolerance: how many, how far, and what is never welded."""

import re

import numpy as np
import pytest
from support.mesh_files import torus

import igl_periods as ip
from igl_periods.meshes.facts import mesh_facts
from igl_periods.meshes.repair import repair_mesh


def soup(V, F, noise, seed=0):
    """Every triangle with vertices of its own, off by up to ``noise`` along each axis."""
    rng = np.random.default_rng(seed)
    return V[F].reshape(-1, 3) + noise * rng.uniform(-1, 1, (F.size, 3)), np.arange(F.size).reshape(
        -1, 3
    )


def steps(report_or_steps):
    return {step.name: step for step in report_or_steps if step.changed}


WELDED = "vertices welded within the tolerance"


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
    with pytest.raises(ip.MeshError, match=r"weld = .*: vertices are welded within a part"):
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
        _, F3, done = repair_mesh(V2, F2)
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
