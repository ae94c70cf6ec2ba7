"""A torus to draw."""

import pytest
from support.random_surfaces import torus_of_revolution

import igl_periods as ip


@pytest.fixture(scope="module")
def torus():
    """The torus of revolution with radii 2 and 0.7, in the plane z = 0."""
    return ip.period_matrix(*torus_of_revolution(2.0, 0.7, 40, 20)).reduced()
