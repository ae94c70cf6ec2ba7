"""Identification: named surfaces are found in any marking, others match nothing."""

import math
from itertools import pairwise

import numpy as np
import pytest
from support.modular_words import random_point, random_word

import igl_periods as ip
from igl_periods.errors import NotASiegelPointError
from igl_periods.siegel.half_space import siegel_distance, siegel_transform
from igl_periods.surfaces import (
    cyclic_cover,
    flat_torus,
    lawson_surface,
    regular_map_surface,
    square_tiled_surface,
    stereographic,
    torus_of_revolution,
)
from igl_periods.surfaces.identification import identify
from igl_periods.surfaces.named_surfaces import catalogue


def lawson(in_space: bool):
    V, F = lawson_surface(2, 1, 6)
    return (stereographic(V, 2, 1) if in_space else V), F


# Name, whether the polyhedral surface has exactly this conformal type, and how to make it.
SURFACES = [
    ("Omega_3", False, lambda: lawson(False)),
    ("Omega_3", False, lambda: lawson(True)),
    ("Omega_3", True, lambda: (square_tiled_surface("omega_3", 3),)),
    ("Omega_3", False, lambda: (cyclic_cover(2, np.exp(2j * np.pi * np.arange(6) / 6)),)),
    ("Omega_2", True, lambda: (square_tiled_surface("omega_2", 4),)),
    ("Omega_2", True, lambda: (regular_map_surface("bolza", 3),)),
    ("Omega_2", False, lambda: (cyclic_cover(2, [0, 1, -1, 1j, -1j]),)),
    ("Omega_1", True, lambda: (square_tiled_surface("omega_1", 6),)),
    ("Klein quartic", True, lambda: (regular_map_surface("klein", 2),)),
    ("Fermat quartic", True, lambda: (regular_map_surface("fermat", 2),)),
    ("gyroid", True, lambda: (regular_map_surface("schwarz_p", 4),)),
    ("Bring curve", True, lambda: (regular_map_surface("bring", 2),)),
    ("square torus", False, lambda: torus_of_revolution(2**0.5, 1.0, 48, 48)),
]


@pytest.mark.parametrize(("name", "exact", "make"), SURFACES)
def test_meshes_are_identified(name, exact, make):
    pm = ip.period_matrix(*make())
    result = identify(pm)
    nearest = result[0]
    assert name in (nearest.surface.name, *nearest.surface.aliases)
    assert nearest.distance < 0.03
    assert nearest.deviation <= nearest.distance <= math.sqrt(pm.genus) * nearest.deviation + 1e-12
    moved = siegel_transform(nearest.gamma, pm.matrix)
    assert abs(siegel_distance(moved, nearest.surface.matrix) - nearest.distance) < 1e-9
    if exact:  # a certificate that proved otherwise would be wrong
        assert "consistent with the certificate" in nearest.claim
    assert all(one.distance <= two.distance for one, two in pairwise(result))


def test_real_meshes(computed):
    # A mesh of Wente's torus made by others; it stores the faces inside out, but the torus is real.
    (nearest, *_) = identify(computed("wente_torus02.obj"))
    assert nearest.surface.name == "Wente torus"
    assert nearest.distance < 1e-3
    assert "consistent with the certificate" in nearest.claim
    for name in ("eight.off", "3holes.obj", "fertility.off"):
        assert len(identify(computed(name))) == 0


@pytest.mark.parametrize("genus", [1, 2, 3, 4])
def test_a_generic_surface_matches_nothing(genus):
    Pi = random_point(genus, np.random.default_rng(4))
    result = identify(Pi)
    assert len(result) == 0
    assert result.undecided == ()
    n = len(catalogue(genus))
    assert str(result) == f"none of {n} named surfaces of genus {genus} is within 0.1"


@pytest.mark.parametrize("genus", [2, 3, 5, 6])
def test_entries_are_identified_in_any_marking(genus):
    for entry in catalogue(genus):
        word = random_word(genus, 20, np.random.default_rng(1), 5)
        result = identify(siegel_transform(word, entry.matrix))
        assert result[0].surface.name == entry.name
        assert result[0].distance < 1e-9
        assert "consistent with the accuracy of the array (1e-08)" in result[0].claim


def test_claims_follow_certificate_and_mesh_error():
    # A flat torus is known exactly: it is not the square one, but a rough mesh of it might be.
    pm = ip.period_matrix(flat_torus(1.02j))
    assert pm.bound < 1e-10
    (match,) = identify(pm)
    assert abs(match.distance - math.log(1.02)) < 1e-10
    assert match.claim == "within 0.02: the polyhedral surface is proved to be another one"
    (match,) = identify(pm, tolerance=0.03)
    assert match.claim == (
        "within 0.02: consistent with the stated error of the mesh (0.03); this does not prove it; "
        "the polyhedral surface is proved to be another one"
    )
    (match,) = identify(pm, tolerance=0.01)
    assert "not consistent with the stated error of the mesh (0.01)" in match.claim
    (match,) = identify(ip.period_matrix(flat_torus(1j)), tolerance=0.01)
    assert "consistent with the certificate" in match.claim
    assert "this does not prove it" in match.claim


def test_claims_without_certificate():
    (match,) = identify([[1.001j]])
    assert match.claim == "within 0.001: near; no error of the mesh is stated"
    K = flat_torus(1j)
    abstract = ip.period_matrix_from_weights(np.ones((K.n_faces, 3)), K.twin)
    assert abstract.bound is None
    (match,) = identify(abstract)
    assert "near; no error of the mesh is stated" in match.claim
    (match,) = identify([[1.001j]], tolerance=0.01)
    assert match.claim == (
        "within 0.001: consistent with the stated error of the mesh (0.01); this does not prove it"
    )


def test_genus_zero_and_high_genus():
    assert len(identify(np.zeros((0, 0)))) == 0
    result = identify(random_point(28, np.random.default_rng(0)))
    assert len(result) == 0
    assert "Lawson xi_{28,1}" in result.undecided
    assert str(result).startswith("y^2 = x^57 - x: undecided, the search was given up\n")


@pytest.mark.parametrize(
    ("tolerance", "message"),
    [(-1.0, "must not be negative"), (math.nan, "must not be negative"), (1.0, "too large")],
)
def test_tolerances_that_make_no_sense(tolerance, message):
    with pytest.raises(ValueError, match=message):
        identify([[1j]], tolerance)


def test_certificate_too_weak():
    with pytest.raises(ValueError, match="too large to separate anything"):
        identify(ip.period_matrix(square_tiled_surface("omega_1", 1)))


def test_matrices_that_are_no_siegel_points():
    with pytest.raises(NotASiegelPointError, match="not symmetric"):
        identify([[1j, 0.5], [0.4, 1j]])
