"""The discs of Lawson's surfaces lie in their tetrahedra."""

import numpy as np
import pytest
from support.lawson_convergence import segments_of

from igl_periods.surfaces import (
    lawson_sides,
    lawson_surface,
)
from igl_periods.surfaces.lawson.surface import discs


@pytest.mark.parametrize(("m", "k"), [(2, 1), (3, 2)])
def test_discs_lie_in_their_tetrahedra(m, k):
    # Inner vertices have arg z and arg w strictly between those of the corners of their disc, and
    # different discs have different cells: no two can meet.
    V, _ = lawson_surface(m, k, 4)
    inside = V[lawson_sides(m, k, segments_of(m, k, 4)).max() + 1 :].reshape(
        len(discs(m, k)), -1, 4
    )
    r = np.arctan2(inside[..., 1], inside[..., 0]) * (k + 1) / np.pi
    s = np.arctan2(inside[..., 3], inside[..., 2]) * (m + 1) / np.pi
    i, j = (np.array(index)[:, None] for index in zip(*discs(m, k), strict=True))
    assert np.all(np.floor(r) % (2 * k + 2) == i)
    assert np.all(np.floor(s) % (2 * m + 2) == j)
    assert min(np.abs(r - np.round(r)).min(), np.abs(s - np.round(s)).min()) > 1e-3
