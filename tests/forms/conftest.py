"""The Delaunay triangulations on which the discrete theory is tested."""

import numpy as np
import pytest
from support.delaunay_surfaces import SURFACES

GRAPHS = {name: surface.graph for name, surface in SURFACES.items()}


@pytest.fixture(params=GRAPHS)
def graph(request):
    return GRAPHS[request.param]


@pytest.fixture
def rng():
    return np.random.default_rng(0)


@pytest.fixture(params=SURFACES)
def surface(request):
    return SURFACES[request.param]
