"""Doubles along a part of the boundary."""

import numpy as np
import pytest
from support.flat_surfaces import flat_strip

import igl_periods as ip
from igl_periods.complexes import double


def test_a_strip_doubled_along_two_sides_is_a_cylinder():
    K = flat_strip(3, 1, 5, 2)
    free = np.flatnonzero(K.twin.ravel() < 0)
    # The sides of length 1/2 are those at the ends.
    ends = free[np.isclose(K.lengths.ravel()[free], 0.5)]
    along = np.setdiff1d(free, ends)
    L = double(K, along=along)
    assert L.euler_characteristic == 0
    assert L.n_boundary_edges == 2 * ends.size
    assert L.n_reversing_edges == 0
    closed = double(K, along=free)
    assert np.array_equal(closed.twin, double(K).twin)
    assert closed.genus == 0
    none = double(K, along=[])
    assert len(none.components()) == 2


@pytest.mark.parametrize(
    ("along", "message"),
    [([10**6], "half-edge 1000000 of along"), ([0.5], "integers, not float64")],
)
def test_what_is_no_boundary_is_refused(along, message):
    with pytest.raises(ip.ComplexError, match=message):
        double(flat_strip(3, 1, 6, 2), along=along)
