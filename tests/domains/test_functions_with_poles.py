"""Functions with poles: in a square they are quotients of theta functions."""

from itertools import pairwise

import numpy as np
import pytest
from support.random_domains import square

import igl_periods as ip
from igl_periods.domains import boundary_loops
from igl_periods.domains.functions_with_poles import Singularity, function_with_poles
from igl_periods.surfaces import planar_domain


@pytest.mark.parametrize("logarithm", [True, False])
def test_singular_parts_grow_as_their_derivatives_say(logarithm):
    s = Singularity(0.3 + 0.2j, 1.5 - 1j, logarithm)
    t = np.linspace(0, 1, 2001)
    path = (1 + 1j) * (1 - t) + (1.5 - 0.5j) * t
    slope = s.derivative(path)
    total = np.sum(0.5 * (slope[1:] + slope[:-1]) * np.diff(path))
    assert s.step(path[:1], path[-1:])[0] == pytest.approx(total, rel=1e-6)


def test_images_of_a_pole_in_a_square():
    # Reflected in the sides of the square, the point and its images are zeros and poles of a
    # quotient of theta functions, whose absolute value is 1 on the sides.
    K = ip.DeltaComplex.from_mesh(*planar_domain(square(0, 0, 1), area=0.02))
    a, b = 0.45 + 0.3j, 0.6 + 0.7j
    loops = boundary_loops(K)
    parts = [Singularity(a, 1.0, logarithm=True), Singularity(b, -1.0, logarithm=True)]
    z = K.positions @ [1, 1j]
    q = np.exp(-np.pi)

    def theta(x):
        n = np.arange(12)
        terms = (-1.0) ** n * q ** ((n + 0.5) ** 2)
        return 2 * (terms * np.sin((2 * n + 1) * np.pi / 2 * np.asarray(x)[..., None])).sum(axis=-1)

    def green(x, c):
        images = theta(x - c) * theta(x + c) / (theta(x - np.conj(c)) * theta(x + np.conj(c)))
        return np.log(np.abs(images))

    keep = (np.abs(z - a) > 0.05) & (np.abs(z - b) > 0.05)
    exact = green(z[keep], a) - green(z[keep], b)
    errors = []
    for degree in (4, 6, 8, 10):
        f, at = function_with_poles(K, loops, parts, [True], degree)
        found = f[keep].real + np.log(np.abs((z[keep] - a) / (z[keep] - b)))
        errors.append(np.ptp(found - exact))
        assert at.shape == (2,)
    assert errors[-1] < 5e-8
    assert all(one > 10 * other for one, other in pairwise(errors))
