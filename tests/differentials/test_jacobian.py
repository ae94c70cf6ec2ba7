"""The Abel–Jacobi map: integrals of the differentials modulo the lattice."""

import numpy as np
import pytest
from support.parametrized_surfaces import NAMES

import igl_periods as ip
from igl_periods.complexes.cochains import along_sides
from igl_periods.differentials.jacobian import abel_jacobi, divisor_class
from igl_periods.differentials.normalised import normalised_differentials
from igl_periods.surfaces import flat_torus


@pytest.mark.parametrize("name", NAMES)
def test_abel_jacobi_integrates_the_differentials_modulo_the_lattice(surfaces, name):
    pm = surfaces[name]
    g, K, base = pm.genus, pm.complex, 5
    image = abel_jacobi(pm, base)
    assert np.all(image.coordinates >= 0)
    assert np.all(image.coordinates < 1)
    assert not image.points[base].any()
    x, y = image.coordinates[:, :g], image.coordinates[:, g:]
    np.testing.assert_allclose(image.points, x + y @ pm.matrix.T, rtol=0, atol=1e-14)
    # Along every side the image moves by the integral of ζ, up to an element of Z^g + Π Z^g.
    A = image.points[K.corner_vertex]
    step = np.roll(A, 1, axis=1) - np.roll(A, -1, axis=1)
    sides = np.moveaxis(along_sides(K, normalised_differentials(pm)), 0, -1)
    difference = step - sides
    n = np.linalg.solve(pm.matrix.imag, difference.imag.reshape(-1, g).T)
    m = difference.real.reshape(-1, g).T - pm.matrix.real @ n
    np.testing.assert_allclose(n, np.rint(n), rtol=0, atol=1e-9)
    np.testing.assert_allclose(m, np.rint(m), rtol=0, atol=1e-9)


def test_abel_jacobi_is_an_isomorphism_of_flat_tori():
    # Vertices of an n × n grid go to the n-division points of the Jacobian.
    image = abel_jacobi(ip.period_matrix(flat_torus(0.3 + 1.1j, 4))).coordinates * 4
    np.testing.assert_allclose(image, np.rint(image), rtol=0, atol=1e-12)
    assert len(np.unique(np.rint(image) % 4, axis=0)) == 16


def test_abels_theorem_on_a_flat_torus():
    """P + Q − R − S is a divisor of a function iff P + Q = R + S in the group."""
    pm = ip.period_matrix(flat_torus(0.3 + 1.1j, 4))
    points = abel_jacobi(pm).points[:, 0]

    def size(divisor, base=0):
        z = divisor_class(pm, divisor, base)
        x = np.linalg.solve(
            [[1, pm.matrix[0, 0].real], [0, pm.matrix[0, 0].imag]], [z.real, z.imag]
        )
        return np.abs(x - np.rint(x)).max()

    P, Q, R = 3, 7, 10
    for S in range(16):
        gap = points[P] + points[Q] - points[R] - points[S]
        y = gap.imag / pm.matrix[0, 0].imag
        x = (gap - y * pm.matrix[0, 0]).real
        principal = max(abs(x - round(x)), abs(y - round(y))) < 1e-9
        assert (size({P: 1, Q: 1, R: -1, S: -1}) < 1e-9) == principal
        assert (size({P: 1, Q: 1, R: -1, S: -1}, base=5) < 1e-9) == principal


def test_divisors_are_refused():
    pm = ip.period_matrix(flat_torus(0.3 + 1.1j, 4))
    with pytest.raises(ValueError, match="there is no vertex 16"):
        divisor_class(pm, {16: 1})
    with pytest.raises(ValueError, match="a multiplicity must be an integer"):
        divisor_class(pm, {1: 0.5})
