"""What is an array, what is a pair, and who is asked about the rest."""

import numpy as np
import pytest
from scipy.sparse import csr_array

import igl_periods as ip
from igl_periods.complexes import is_array_like, mesh_reader
from igl_periods.complexes.mesh_readers import described, has_rows, vertices_and_faces
from igl_periods.errors import MeshError

V, F = np.eye(3), np.array([[0, 1, 2]])


@pytest.mark.parametrize(
    "value", [V, V.tolist(), tuple(map(tuple, V.tolist())), list(V), memoryview(V)]
)
def test_rows_of_numbers_are_arrays(value):
    assert is_array_like(value)
    assert vertices_and_faces(value, F) == (value, F) if isinstance(value, list) else True


@pytest.mark.parametrize(
    "value",
    [(V, F), [V, F], (V.tolist(), F.tolist()), (V, F, "report"), "file", b"file", {}, 3, None],
)
def test_pairs_paths_and_objects_are_none(value):
    assert not is_array_like(value)


def test_rows_of_different_lengths_are_rows():
    assert has_rows([[1, 2], [3]])
    assert not has_rows([1, 2])
    # A pair with such faces is a pair, and its faces are refused as such.
    with pytest.raises(MeshError, match="F is not a rectangular array"):
        ip.period_matrix((V, [[0, 1, 2], [0, 2]]))


def test_a_reader_is_asked_about_what_it_knows():
    class Cloud:
        pass

    @mesh_reader
    def read(thing):
        return (V, F) if isinstance(thing, Cloud) else None

    assert vertices_and_faces(Cloud()) == (V, F)
    assert ip.DeltaComplex.from_mesh(Cloud()).n_faces == 1
    with pytest.raises(MeshError, match="an object of type object is not a surface"):
        vertices_and_faces(object())


def test_objects_in_words():
    assert described(None) == "None"
    assert described("a.obj") == "'a.obj'"
    assert described(csr_array((2, 2))) == "an object of type csr_array"
    assert described("x" * 80) == "an object of type str"
