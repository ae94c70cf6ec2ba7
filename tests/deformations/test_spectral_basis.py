"""Smooth functions on surfaces."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes import cotan_weights
from igl_periods.harmonic import laplacian
from igl_periods.surfaces import flat_torus


def test_eigenfunctions_of_a_flat_torus():
    """λ = 4π² (m² + n²) on the unit square torus, each as often as it occurs."""
    K = flat_torus(1j, 40)
    functions = ip.smooth_functions(K, count=9)
    assert np.ptp(functions[:, 0]) < 1e-9 * np.abs(functions[0, 0])
    energies = np.einsum("vi,vi->i", functions, laplacian(K, cotan_weights(K)) @ functions)
    values = energies / np.mean(functions**2, axis=0)
    assert np.allclose(values[1:] / (4 * np.pi**2), [1, 1, 1, 1, 2, 2, 2, 2], rtol=0.01)


def test_they_are_the_same_every_time():
    K = flat_torus(0.3 + 1j, 8)
    one, two = (ip.smooth_functions(K, count=5) for _ in range(2))
    assert np.array_equal(one, two)


@pytest.mark.parametrize("count", [0, 64, -1])
def test_there_are_only_so_many(count):
    with pytest.raises(ValueError, match="of 64 vertices 1 to 63 functions"):
        ip.smooth_functions(flat_torus(1j, 8), count=count)
