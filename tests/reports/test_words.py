"""Advice in words: it names what limits the accuracy."""

import numpy as np
from support.random_surfaces import (
    L_SHAPE,
    noisy_torus,
    torus_of_revolution,
)

import igl_periods as ip
from igl_periods.display import rounded_up
from igl_periods.periods.quality import mesh_quality
from igl_periods.reports.words import advice, method_in_words, options_in_words
from igl_periods.surfaces import flat_torus, square_tiled_surface


def advice_about(K):
    return " ".join(advice(mesh_quality(K)))


def test_advice_names_what_limits_the_accuracy():
    words = advice_about(ip.DeltaComplex.from_squares(L_SHAPE, 4))
    assert "1 vertex of total angle above 450°, the largest 1080°" in words
    assert "like h^0.67" in words
    assert "to blame" not in words

    V, F = torus_of_revolution(2.0, 0.7, 40, 16)
    words = advice_about(ip.DeltaComplex.from_mesh(V, F))
    assert "the mesh is as coarse as it is" in words
    assert "total angle above" not in words

    words = advice_about(ip.DeltaComplex.from_mesh(*torus_of_revolution(2.0, 0.7, 200, 4)))
    assert "with an angle below 10° in every triangulation" in words

    V, F = noisy_torus(8, 6, 0.15, 2)
    quality = mesh_quality(ip.DeltaComplex.from_mesh(V, F))
    assert quality.flips >= quality.non_delaunay_edges > 0
    assert f"{quality.non_delaunay_edges} of 144 edges of the mesh are not Delaunay" in " ".join(
        advice(quality)
    )


def test_advice_about_degenerate_triangles_and_spheres():
    K = flat_torus(1j, 3)
    lengths = K.lengths.copy()
    # The diagonal of one cell is as long as two sides of it together.
    longest = np.argmax(K.lengths[0])
    pair = [longest, int(K.twin[0, longest])]
    lengths.ravel()[pair] = np.delete(K.lengths[0], longest).sum()
    degenerate = ip.DeltaComplex.from_gluing(lengths, K.twin)
    assert degenerate.mollification > 0
    assert "Some triangles are degenerate" in advice_about(degenerate)
    sphere = ip.DeltaComplex.from_lengths(
        np.ones((4, 3)), [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    )
    assert "a sphere" in advice_about(sphere)
    assert mesh_quality(sphere).bound == 0


def test_what_is_not_usual_is_said():
    pm = ip.period_matrix(square_tiled_surface("omega_1"), degree=4)
    usual = {"weights": "intrinsic", "delaunay": True, "degree": 1, "tolerance": None}
    assert method_in_words(usual, pm) == []
    assert method_in_words({"degree": 4}, pm) == ["Π is computed with functions of degree 4."]
    (met,), (unmet,) = (method_in_words({"tolerance": r}, pm) for r in (1.0, 1e-17))
    assert met == f"A bound of at most 1 was asked for; the one reached is {rounded_up(pm.bound)}."
    assert unmet.endswith(f"the one reached is {rounded_up(pm.bound)}, which is more.")
    rest = {"repair": True, "double": True, "component": 2, "weights": "extrinsic"}
    assert len(method_in_words({**rest, "delaunay": False}, pm)) == 5
    # Without a matrix only the surface can be spoken of.
    assert len(method_in_words({**rest, "degree": 4})) == 3


def test_all_options_are_told():
    usual = dict(options_in_words({}))
    assert usual["edge weights"] == "intrinsic"
    assert usual["intrinsic Delaunay flips"] == "yes"
    assert (usual["degree of the functions"], usual["bound asked for"]) == ("1", "none")
    assert [usual[k] for k in ("mesh repaired", "double taken")] == ["no", "no"]
    chosen = {"degree": 3, "tolerance": 1e-5, "double": True, "component": 2, "lattice": None}
    told = dict(options_in_words(chosen))
    assert told | {"component": "2"} == told
    assert (told["bound asked for"], told["double taken"]) == ("1e-05", "yes")
    assert "translations" not in told
