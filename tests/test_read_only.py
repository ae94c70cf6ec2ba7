"""Results stay as they are: their arrays are read-only, also in copies and from pickles."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest
from scipy.sparse import issparse

import igl_periods as ip

SQUARE = [((0, 0), (0, 2)), ((0, 1), (0, 3))]
K = ip.DeltaComplex.from_squares(SQUARE, 3)
PM = ip.period_matrix(K)


def mesh(n):
    a, b = np.meshgrid(*(2 * [2 * np.pi * np.arange(n) / n]), indexing="ij")
    V = np.stack([np.cos(a), np.sin(a), np.cos(b), np.sin(b)], axis=-1).reshape(-1, 4)
    corner = np.arange(n * n).reshape(n, n)
    right, up = np.roll(corner, -1, 0), np.roll(corner, -1, 1)
    both = np.roll(right, -1, 1)
    return V, np.stack([corner, right, both, corner, both, up], axis=-1).reshape(-1, 3)


RESULTS = {
    "complex": ip.DeltaComplex.from_mesh(*mesh(4)),
    "period matrix": PM,
    "quality": ip.mesh_quality(K),
    "refined": ip.refined_period_matrix(K, 1e-30, largest=40),
    "extrapolation": ip.richardson(lambda n: ip.DeltaComplex.from_squares(SQUARE, n), (1, 2, 3)),
    "match": ip.identify([[1j]])[0],
    "polygon": ip.fundamental_polygon(K),
    "parametrization": ip.parametrize(ip.period_matrix(*mesh(4)), [1]),
    "Abel–Jacobi": ip.abel_jacobi(PM),
    "double graph": ip.double_graph(K),
}


def arrays(result):
    for field in dataclasses.fields(result):
        value = getattr(result, field.name)
        if dataclasses.is_dataclass(value):
            yield from arrays(value)
        elif issparse(value):
            yield value.data
        elif isinstance(value, np.ndarray):
            yield value


@pytest.mark.parametrize("name", RESULTS)
def test_arrays_are_read_only(name):
    result = RESULTS[name]
    copies = (pickle.loads(pickle.dumps(result)), copy.copy(result), copy.deepcopy(result))
    count = len(list(arrays(result)))
    assert count > 0
    for one in (result, *copies):
        found = list(arrays(one))
        assert len(found) == count
        assert not any(array.flags.writeable for array in found)


def test_an_assignment_to_a_pickled_array_is_refused():
    pm = pickle.loads(pickle.dumps(PM))
    with pytest.raises(ValueError, match="read-only"):
        pm.complex.lengths[0, 0] = 2.0
    with pytest.raises(ValueError, match="read-only"):
        pm.dirichlet[0, 0] = 2.0
