"""JSON: numbers are read back bit for bit, and the document is consistent with itself."""

import json

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.periods.matrix import siegel_reduced
from igl_periods.reports.json_document import cycles_to_json, matrix_to_json, result_to_json
from igl_periods.surfaces import square_tiled_surface


def read(matrix):
    return np.array(matrix["real"]) + 1j * np.array(matrix["imag"])


def test_matrices_are_read_back_bit_for_bit():
    rng = np.random.default_rng(0)
    A = rng.normal(size=(3, 4)) * 10.0 ** rng.integers(-300, 300, (3, 4))
    assert np.array_equal(json.loads(json.dumps(matrix_to_json(A))), A)
    B = A + 1j * A[::-1]
    assert np.array_equal(read(json.loads(json.dumps(matrix_to_json(B)))), B)
    assert matrix_to_json(np.zeros((0, 0), dtype=complex)) == {"real": [], "imag": []}


@pytest.mark.parametrize(
    "pm",
    [
        ip.period_matrix(*noisy_torus(7, 6, 0.1, 1)),
        ip.period_matrix(square_tiled_surface("omega_1", 3)),
    ],
    ids=["torus", "omega_1"],
)
def test_both_markings_are_of_one_surface(pm):
    document = json.loads(json.dumps(result_to_json(pm, *siegel_reduced(pm)), allow_nan=False))
    surface, marking = document["surface"], document["mesh_marking"]
    assert surface["vertices"] - surface["edges"] + surface["faces"] == 2 - 2 * surface["genus"]
    assert np.array_equal(read(marking["matrix"]), pm.matrix)
    reduced = document["reduced_marking"]
    moved = ip.siegel_transform(np.array(reduced["gamma"]), read(marking["matrix"]))
    np.testing.assert_allclose(moved, read(reduced["matrix"]), rtol=0, atol=1e-12)
    assert reduced["bound"] == pytest.approx(marking["bound"], rel=1e-6, abs=1e-12)


def test_what_was_not_reduced_has_no_second_marking():
    pm = ip.period_matrix(square_tiled_surface("omega_2"))
    assert result_to_json(pm, None, None)["reduced_marking"] is None


def test_cycles_pass_edges_of_the_mesh_and_close():
    V, F = noisy_torus(7, 6, 0.1, 1)
    cycles = cycles_to_json(ip.DeltaComplex.from_mesh(V, F))
    edges = {frozenset(pair) for a, b, c in F.tolist() for pair in ((a, b), (b, c), (c, a))}
    assert [len(cycles[kind]) for kind in "ab"] == [1, 1]
    for walk in cycles["a"] + cycles["b"]:
        assert all(frozenset(pair) in edges for pair in zip(walk, walk[1:] + walk[:1]))
