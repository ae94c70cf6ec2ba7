"""The most even form: more even than others, less distorted under refinement."""

import numpy as np
import pytest
from support.parametrized_surfaces import check_seams, distortion, random_coefficients

import igl_periods as ip
from igl_periods.complexes.midpoint_subdivision import split
from igl_periods.differentials.even_form import evenness, most_even_form
from igl_periods.differentials.parametrization import parametrize
from igl_periods.harmonic.constant_forms import face_areas
from igl_periods.periods.matrix import PeriodMatrix


@pytest.mark.parametrize("name", ["genus 2", "genus 3", "squares"])
def test_the_most_even_form_is_more_even_than_others(surfaces, name):
    pm = surfaces[name]
    best, g = most_even_form(pm), pm.genus
    others = [evenness(pm, random_coefficients(g, seed)) for seed in range(100)]
    near = [evenness(pm, best + 1e-3 * random_coefficients(g, seed)) for seed in range(20)]
    assert max(near) < evenness(pm, best) < 1
    assert max(others) < evenness(pm, best)
    # The mean of |ζ|² is 1, and the marking does not matter.
    P = parametrize(pm, best)
    area = face_areas(pm.complex)
    assert P.density @ area / area.sum() == pytest.approx(1, rel=1e-12)
    original = ip.period_matrix(pm.complex)
    assert evenness(original, most_even_form(original)) == pytest.approx(
        evenness(pm, best), rel=1e-3
    )


def refined(pm):
    K, cocycles = split(pm.complex, pm.cocycles)
    return PeriodMatrix(pm.dirichlet, True, cocycles, K)


def test_distortion_of_the_most_even_form_falls_under_refinement(surfaces):
    pm = surfaces["genus 3"]
    s, found = most_even_form(pm), []
    for _ in range(3):
        P = parametrize(pm, s)
        assert np.count_nonzero(P.reversed_faces) + P.index.sum() == 4
        found.append(distortion(P))
        pm = refined(pm)
    median, tail, folds = np.array(found).T
    # First order in the middle of faces, slower at the corners of angle 3π.
    assert np.all(np.diff(np.log2(median)) < -0.8)
    assert np.all(np.diff(tail) < 0)
    assert np.all(np.diff(folds) <= 0)


@pytest.mark.parametrize(
    ("name", "genus"), [("eight.off", 2), ("fertility.off", 4), ("botijo.obj", 5)]
)
def test_meshes_made_by_others(computed, name, genus):
    pm = computed(name).reduced()
    for s in (most_even_form(pm), random_coefficients(genus, 1)):
        P = parametrize(pm, s)
        assert np.count_nonzero(P.reversed_faces) + P.index.sum() == 2 * genus - 2
        check_seams(P)


@pytest.mark.parametrize("name", ["eight.off", "fertility.off"])
def test_distortion_on_meshes_made_by_others_falls_under_refinement(computed, name):
    pm = computed(name).reduced()
    best = most_even_form(pm)
    before = distortion(parametrize(pm, best))
    after = distortion(parametrize(refined(pm), best))
    assert after[0] < 0.6 * before[0]
    assert after[1] < 0.6 * before[1]
    assert after[2] <= before[2]
