"""Marked surfaces and their spanning trees."""

import pytest
from support.walked_surfaces import SURFACES

from igl_periods.topology.spanning_trees import shortest_tree_cotree, tree_cotree


@pytest.fixture(params=SURFACES)
def K(request):
    return SURFACES[request.param]


@pytest.fixture(params=["breadth first", "shortest"])
def trees(request, K):
    root = K.n_vertices - 1
    return (
        tree_cotree(K, root) if request.param == "breadth first" else shortest_tree_cotree(K, root)
    )
