"""Rows: what a table holds of one file, bit for bit, and of files that are refused."""

import json
from pathlib import Path

import igl
import numpy as np
import pytest
from support.flat_surfaces import flat_strip
from support.mesh_folders import TETRAHEDRON, matrix, two_tori
from support.random_surfaces import noisy_torus, torus_of_revolution
from threadpoolctl import threadpool_limits

import igl_periods as ip
from igl_periods.batch import BatchOptions, rows_of
from igl_periods.batch.rows import COLUMNS, file_hash
from igl_periods.moduli.genus_two import igusa_clebsch_invariants
from igl_periods.surfaces import cyclic_cover

DATA = Path(__file__).parents[2] / "data"


def write_gluing(path: Path, K: ip.DeltaComplex) -> Path:
    path.write_text(json.dumps({"lengths": K.lengths.tolist(), "twin": K.twin.tolist()}))
    return path


# ---- Rows ----


def test_matrices_of_very_high_genus_stay_in_the_marking_of_the_mesh(monkeypatch):
    monkeypatch.setattr("igl_periods.periods.matrix.SIEGEL_GENUS_LIMIT", 1)
    (row,) = rows_of(DATA / "lawson_2_1.off")
    pm = ip.period_matrix(*ip.load_mesh(DATA / "lawson_2_1.off")[:2])
    assert row["reduced"] is False
    assert row["matrix_imag"] == pm.matrix.imag.ravel().tolist()
    assert row["bound"] == pm.bound


@pytest.mark.parametrize("name", ["lawson_2_1.off", "klein.json"])
def test_a_row_holds_the_reduced_matrix_bit_for_bit(name):
    (row,) = rows_of(DATA / name)
    assert list(row) == list(COLUMNS)
    with threadpool_limits(1):
        surface = DATA / name
        if name.endswith("off"):
            pm = ip.period_matrix(*ip.load_mesh(surface)[:2]).reduced()
        else:
            pm = ip.period_matrix(ip.DeltaComplex.from_json(surface.read_text())).reduced()
    assert np.array_equal(matrix(row), pm.matrix)
    assert row["bound"] == pm.bound
    assert row["entry_bound"] == pm.entry_bounds.max()
    assert row["symplectic_eigenvalues"] == pm.symplectic_eigenvalues.tolist()
    assert (row["vertices"], row["faces"]) == (pm.complex.n_vertices, pm.complex.n_faces)
    assert row["hash"] == file_hash(surface)
    assert row["version"] == ip.__version__
    assert (row["error"], row["error_kind"], row["warning"]) == (None, None, None)
    if name.endswith("off"):
        assert json.loads(row["mesh_report"])["result"]["triangles"] == 1536
        assert json.loads(row["mesh_report"])["file"] == row["file"]
    else:
        assert row["mesh_report"] is None


def test_options_reach_the_computation():
    path = DATA / "omega_1.json"
    fine, plain = (rows_of(path, BatchOptions(degree=p))[0] for p in (3, 1))
    assert fine["bound"] < 0.1 * plain["bound"]
    assert json.loads(fine["options"]) == {
        "repair": False, "weld": 1e-9, "largest_hole": 0, "double": False, "weights": "intrinsic",
        "delaunay": True, "degree": 3, "tolerance": None, "rigorous": False, "max_memory": None,
    }  # fmt: skip
    (met,) = rows_of(path, BatchOptions(tolerance=1e-6))
    assert met["bound"] < 1e-6
    (unmet,) = rows_of(path, BatchOptions(tolerance=1e-17))
    assert "the bound is" in unmet["warning"]
    assert unmet["error"] is None


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"degree": 0}, "degree 1 at least"),
        ({"weights": "other"}, "weights must be"),
        ({"tolerance": -1.0}, "always positive"),
        ({"degree": 3, "tolerance": 1e-3}, "a tolerance chooses the degree"),
        ({"repair": True, "weld": 0.5}, "within a part of the diagonal"),
        ({"repair": True, "largest_hole": -1}, "largest_hole = -1: holes have a number of edges"),
        ({"repair": True, "largest_hole": "3"}, "largest_hole must be an integer, not the string"),
        ({"max_memory": "2 GB"}, "max_memory must be a number"),
        ({"max_memory": -1.0}, "a limit is not negative"),
        ({"rigorous": 1}, "rigorous must be True or False"),
    ],
)
def test_contradictory_options(options, message):
    with pytest.raises(ValueError, match=message):
        BatchOptions(**options)


def test_a_sphere_has_an_empty_matrix(tmp_path):
    (tmp_path / "sphere.off").write_text(TETRAHEDRON)
    (row,) = rows_of(tmp_path / "sphere.off")
    assert (row["genus"], row["matrix_real"], row["matrix_imag"]) == (0, [], [])
    assert matrix(row).shape == (0, 0)
    assert (row["bound"], row["entry_bound"], row["symplectic_eigenvalues"]) == (0.0, 0.0, [])
    assert (row["j_real"], row["hyperelliptic"]) == (None, None)


def test_components_are_rows_those_of_large_genus_first(tmp_path):
    rows = rows_of(two_tori(tmp_path))
    assert [(row["component"], row["genus"], row["vertices"]) for row in rows] == [
        (1, 1, 96),
        (2, 1, 42),
    ]
    assert rows[0]["mesh_report"] is not None
    assert rows[1]["mesh_report"] is None


def test_a_torn_file_is_refused_as_a_whole(tmp_path):
    # Every triangle has corners of its own.
    V, F = torus_of_revolution(2.0, 0.8, 12, 8)
    soup = V[F].reshape(-1, 3), np.arange(F.size).reshape(-1, 3)
    igl.write_triangle_mesh(str(tmp_path / "torn.obj"), *soup)
    (row,) = rows_of(tmp_path / "torn.obj")
    assert row["component"] is None
    assert row["error"].startswith("the surface is torn into 192 pieces. 576 boundary edges lie in")
    assert "--repair" in row["error"]
    (row,) = rows_of(tmp_path / "torn.obj", BatchOptions(repair=True))
    assert (row["genus"], row["error"]) == (1, None)
    # Beside a closed component the pieces are rows, as components are.
    both = np.concatenate([V, soup[0][:9] + 9.0]), np.concatenate([F, soup[1][:3] + len(V)])
    igl.write_triangle_mesh(str(tmp_path / "both.obj"), *both)
    rows = rows_of(tmp_path / "both.obj")
    assert [row["component"] for row in rows] == list(range(1, len(rows) + 1))
    assert [row["error"] is None for row in rows][:2] == [True, False]


def test_a_refused_component_is_a_row_beside_the_others(tmp_path):
    V, F = torus_of_revolution(2.0, 0.8, 12, 8)
    path = tmp_path / "one_open.off"
    both = np.concatenate([F[1:], F + len(V)])
    igl.write_triangle_mesh(str(path), np.concatenate([V, V + 9.0]), both)
    closed, opened = rows_of(path)
    assert (closed["genus"], closed["error"]) == (1, None)
    assert (opened["component"], opened["genus"], opened["vertices"]) == (2, None, 96)
    assert (opened["matrix_real"], opened["bound"]) == (None, None)
    assert opened["error_kind"] == "ComplexError"
    assert "it has 3 boundary edges" in opened["error"]
    doubles = rows_of(path, BatchOptions(double=True))
    assert [row["genus"] for row in doubles] == [2, 1, 1]


def test_repair_makes_a_surface(tmp_path):
    V, F = noisy_torus(7, 6, 0.1, 1)
    path = tmp_path / "soup.off"
    igl.write_triangle_mesh(str(path), V[F].reshape(-1, 3), np.arange(F.size).reshape(-1, 3))
    (row,) = rows_of(path)
    assert f"torn into {len(F)} pieces" in row["error"]
    (row,) = rows_of(path, BatchOptions(repair=True))
    assert (row["genus"], row["vertices"]) == (1, 42)


def test_how_far_a_repair_goes(tmp_path):
    V, F = noisy_torus(7, 6, 0.1, 1)
    # Corners of their own, 1e-6 away from each other, and a triangle less.
    apart = V[F[1:]] * (1.0 + 1e-6 * np.arange(len(F) - 1)[:, None, None] / len(F))
    path = tmp_path / "torn.obj"
    corners = np.arange(3 * (len(F) - 1)).reshape(-1, 3)
    igl.write_triangle_mesh(str(path), apart.reshape(-1, 3), corners)
    options = {"repair": True, "weld": 1e-5}
    assert len(rows_of(path, BatchOptions(repair=True))) == len(F) - 1
    (row,) = rows_of(path, BatchOptions(**options))
    assert "3 boundary edges" in row["error"]
    (row,) = rows_of(path, BatchOptions(**options, largest_hole=3))
    # A hole is filled with a vertex in its middle.
    assert (row["genus"], row["vertices"], row["error"]) == (1, 43, None)
    told = json.loads(row["options"])
    assert (told["repair"], told["weld"], told["largest_hole"]) == (True, 1e-5, 3)


def test_a_file_that_takes_too_much_memory_is_refused():
    (row,) = rows_of(DATA / "lawson_2_1.off", BatchOptions(max_memory=1e3))
    assert row["error_kind"] == "MemoryLimitError"
    assert row["genus"] is None
    (row,) = rows_of(DATA / "lawson_2_1.off", BatchOptions(max_memory=1e9))
    assert (row["genus"], json.loads(row["options"])["max_memory"]) == (2, 1e9)


@pytest.mark.parametrize(
    ("name", "content", "kind", "message"),
    [
        ("missing.off", None, "FileNotFoundError", "there is no mesh file"),
        ("missing.json", None, "FileNotFoundError", "No such file"),
        ("empty.off", "", "MeshError", "the file is empty."),
        ("nonsense.obj", "nonsense", "MeshError", "the mesh is empty"),
        ("other.json", "[]", "MeshError", "the file holds no gluing"),
        ("fins.off", "OFF\n5 3 0\n0 0 0\n0 0 1\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 0 1 3\n3 0 1 4\n",
         "MeshError", "border more than two faces"),
    ],
)  # fmt: skip
def test_refused_files_are_rows(tmp_path, name, content, kind, message):
    if content is not None:
        (tmp_path / name).write_text(content)
    (row,) = rows_of(tmp_path / name, name="x/y")
    assert row["error_kind"] == kind
    assert message in row["error"]
    assert (row["file"], row["component"], row["genus"]) == ("x/y", None, None)
    assert (row["hash"] is None) == (content is None)
    # The beginning of the message is not the path, which the column "file" has already.
    assert not row["error"].startswith(str(tmp_path))


def test_a_file_that_is_no_surface_has_its_report(tmp_path):
    V, F = torus_of_revolution(2.0, 0.8, 6, 5)
    path = tmp_path / "fin.off"
    igl.write_triangle_mesh(str(path), V, np.vstack([F, [[0, 5, 17]]]))
    (row,) = rows_of(path)
    assert row["error_kind"] == "MeshError"
    assert json.loads(row["mesh_report"])["result"]["nonmanifold_edges"] == 1


# ---- Invariants ----


def test_j_lies_within_its_certified_error(tmp_path):
    K = flat_strip(1.0, 2.0, 4, 5, "straight", "straight", seed=3)
    path = write_gluing(tmp_path / "torus.json", K)
    for tolerance in (None, 1e-6):
        (row,) = rows_of(path, BatchOptions(tolerance=tolerance))
        assert abs(row["j_real"] + 1j * row["j_imag"] - 66**3) <= row["j_error"]
    assert row["j_error"] < 10.0
    assert row["hyperelliptic"] is None


def test_without_a_certificate_nothing_is_certified(tmp_path):
    path = tmp_path / "torus.off"
    igl.write_triangle_mesh(str(path), *torus_of_revolution(2.0, 0.8, 20, 12))
    for surface in (path, DATA / "lawson_2_1.off"):
        (row,) = rows_of(surface, BatchOptions(weights="extrinsic"))
        assert row["matrix_real"] is not None
        assert [row[name] for name in ("bound", "entry_bound", "j_error")] == 3 * [None]
        assert [row[name] for name in ("hyperelliptic", "vanishing_thetas")] == 2 * [None]
        assert row["igusa_real"] is None


@pytest.mark.parametrize(
    ("name", "roots"),
    [("omega_2.json", [0, 1, -1, 1j, -1j]), ("omega_3.json", [1.5, 2.0, 3.0])],
)
def test_absolute_invariants_of_curves_of_genus_two(name, roots):
    (row,) = rows_of(DATA / name, BatchOptions(tolerance=1e-10))
    assert (row["hyperelliptic"], row["vanishing_thetas"]) == (True, 0)
    i2, i4, i6, i10 = igusa_clebsch_invariants(roots)
    found = np.array(row["igusa_real"]) + 1j * np.array(row["igusa_imag"])
    np.testing.assert_allclose(found, np.array([i2**5, i2**3 * i4, i2**2 * i6]) / i10, rtol=1e-7)


def test_hyperelliptic_in_genus_three(tmp_path):
    # "no" is proved; "yes" is not, and is not told.
    (klein,) = rows_of(DATA / "klein.json", BatchOptions(tolerance=1e-3))
    assert (klein["hyperelliptic"], klein["vanishing_thetas"]) == (False, 0)
    roots = [1, 2, -1, -2, 1j, -1j, 2j, 1 + 2j]
    path = write_gluing(tmp_path / "curve.json", cyclic_cover(2, roots, size=0.4))
    (curve,) = rows_of(path, BatchOptions(tolerance=1e-6))
    assert (curve["genus"], curve["hyperelliptic"], curve["vanishing_thetas"]) == (3, None, 1)
