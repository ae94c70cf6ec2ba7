"""Forms with prescribed periods."""

import numpy as np
from support.parametrized_surfaces import random_coefficients

from igl_periods.differentials.parametrization import parametrize
from igl_periods.differentials.prescribed_periods import form_of_periods, form_of_real_periods


def test_real_periods_determine_the_form(surfaces):
    pm = surfaces["genus 3"]
    wanted = np.array([1.0, 0, -2, 3, 0, 1])
    s = form_of_real_periods(pm, wanted)
    P = parametrize(pm, s)
    np.testing.assert_allclose(P.periods.real, wanted, rtol=0, atol=1e-12)
    # So the real part of the map has integer jumps: stripes have no seams.
    jumps = P.seam_jumps.real
    np.testing.assert_allclose(jumps, np.rint(jumps), rtol=0, atol=1e-11)
    assert np.abs(jumps).max() > 0.5


def test_periods_that_are_prescribed(surfaces):
    pm = surfaces["genus 3"]
    free = complex("nan")
    wanted = np.array([1.0, 2j, free, free, free, 1 + 1j])
    periods = parametrize(pm, form_of_periods(pm, wanted)).periods
    np.testing.assert_allclose(periods[[0, 1, 5]], wanted[[0, 1, 5]], rtol=0, atol=1e-12)
    # More than g: least squares, so that the residual is orthogonal to all forms.
    wanted = random_coefficients(6, 1)
    s = form_of_periods(pm, wanted)
    matrix = np.concatenate([np.eye(3), pm.matrix])
    np.testing.assert_allclose(matrix.conj().T @ (matrix @ s - wanted), 0, atol=1e-12)
    np.testing.assert_allclose(form_of_periods(pm, matrix @ s), s, rtol=0, atol=1e-12)
