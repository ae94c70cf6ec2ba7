"""P, D and the gyroid: three lattices, one Riemann surface."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes import lattice_gluing
from igl_periods.moduli.equivalence import symplectic_isomorphisms
from igl_periods.surfaces import regular_map_period_matrix
from igl_periods.surfaces.minimal_periodic import triply_periodic_minimal_surface

NAMES = ("P", "D", "G")
# Cosines of the angles between shortest translations: primitive cubic, face- and body-centred.
COSINES = {"P": 0.0, "D": 0.5, "G": 1 / 3}


def quotient(name, n):
    V, F, lattice = triply_periodic_minimal_surface(name, n)
    return ip.DeltaComplex.from_mesh(V, F, lattice=lattice)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("n", [1, 3])
def test_genus_and_lattice(name, n):
    V, F, lattice = triply_periodic_minimal_surface(name, n)
    assert len(F) == 48 * n * n
    K = ip.DeltaComplex.from_mesh(V, F, lattice=lattice)
    assert K.genus == 3
    assert lattice_gluing(V, F, lattice).gap < 1e-10
    norms = np.linalg.norm(lattice, axis=1)
    assert np.allclose(norms, norms[0], rtol=1e-9)
    gram = lattice @ lattice.T / norms[0] ** 2
    off = np.abs(gram[np.triu_indices(3, 1)])
    # Of a face-centred lattice some shortest translations are orthogonal.
    assert np.all(np.isclose(off, COSINES[name]) | np.isclose(off, 0, atol=1e-9))
    volume = {"P": 1.0, "D": np.sqrt(0.5), "G": 4 / np.sqrt(27)}[name]
    assert abs(np.linalg.det(lattice)) == pytest.approx(volume * norms[0] ** 3, rel=1e-9)


def test_any_other_bonnet_angle_has_no_lattice():
    # The gyroid's angle is one of isolated ones: 38.0148 degrees from D.
    from igl_periods.surfaces.minimal_periodic import _BONNET

    assert 90 - np.degrees(_BONNET["G"]) == pytest.approx(38.0147740, abs=1e-7)


def test_they_are_the_same_riemann_surface():
    exact = regular_map_period_matrix("schwarz_p")
    matrices = [ip.period_matrix(quotient(name, 1), tolerance=1e-7) for name in NAMES]
    for pm in matrices:
        # The polyhedral surface, however coarse, has the symmetries that determine its matrix.
        assert symplectic_isomorphisms(exact, pm, tolerance=2 * pm.bound)
        assert len(ip.symplectic_automorphism_group(pm)) == 48
    for one, other in zip(matrices, matrices[1:] + matrices[:1]):
        assert ip.symplectic_isomorphisms(one, other)


@pytest.mark.parametrize("name", NAMES)
def test_identified(name):
    found = str(ip.identify(ip.period_matrix(quotient(name, 2), tolerance=1e-6)))
    assert found.startswith("Schwarz P and D surfaces and gyroid")


def test_areas_agree_in_the_limit():
    # The three are isometric; what the chords miss has order 2.
    areas = []
    for n in (2, 4):
        K = [quotient(name, n) for name in NAMES]
        areas.append([ip.complexes.double_areas(k.lengths).sum() / 2 for k in K])
    spread = np.ptp(areas, axis=1)
    assert spread[0] / spread[1] == pytest.approx(4, rel=0.2)


def test_unknown_surfaces():
    with pytest.raises(ip.MeshError, match='"P", "D" and "G"'):
        triply_periodic_minimal_surface("H")
    with pytest.raises(ip.MeshError, match="n = 0"):
        triply_periodic_minimal_surface("P", 0)
