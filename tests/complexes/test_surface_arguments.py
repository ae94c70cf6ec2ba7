"""Every function of a surface takes every spelling of it, with the same result."""

import inspect

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes import as_complex, intrinsic_delaunay
from igl_periods.errors import MeshError
from igl_periods.surfaces import torus_of_revolution

V, F = torus_of_revolution(2.0, 0.9, 9, 7)
V = V + 0.05 * np.random.default_rng(3).normal(size=V.shape)


class Mesh:
    """An object with vertices and faces, of no library that is known."""

    vertices = V
    faces = F


@pytest.fixture
def path(tmp_path):
    rows = ["OFF", f"{len(V)} {len(F)} 0"]
    rows += [" ".join(map(repr, row)) for row in V.tolist()]
    rows += [" ".join(map(str, [3, *row])) for row in F.tolist()]
    file = tmp_path / "torus.off"
    file.write_text("\n".join(rows) + "\n")
    return file


SPELLINGS = {
    "arrays": lambda path: (V, F),
    "lists": lambda path: (V.tolist(), F.tolist()),
    "tuples": lambda path: (tuple(map(tuple, V.tolist())), F),
    "complex": lambda path: (ip.DeltaComplex.from_mesh(V, F),),
    "pair": lambda path: ((V, F),),
    "pair of lists": lambda path: ([V.tolist(), F.tolist()],),
    "triple": lambda path: (ip.load_mesh(path),),
    "path": lambda path: (path,),
    "string": lambda path: (str(path),),
    "object": lambda path: (Mesh(),),
}


def delaunay(*surface):
    K = as_complex(*surface)
    return intrinsic_delaunay(K, ip.cohomology_basis(K))[0]


FUNCTIONS = {
    "period_matrix": lambda *s: ip.period_matrix(*s).matrix,
    "mesh_quality": lambda *s: ip.mesh_quality(*s).excess,
    "homology_basis": lambda *s: ip.homology_basis(*s),
    "cohomology_basis": lambda *s: ip.cohomology_basis(*s).toarray(),
    "dual_homology_basis": lambda *s: ip.dual_homology_basis(*s),
    "harmonic_forms": lambda *s: ip.harmonic_forms(*s),
    "harmonic_form_blocks": lambda *s: list(ip.harmonic_form_blocks(*s)),
    "double": lambda *s: ip.double(*s).twin,
    "fundamental_polygon": lambda *s: ip.fundamental_polygon(*s).word,
    "shortest_loops": lambda *s: ip.shortest_loops(*s),
    "identify": lambda *s: [match.distance for match in ip.identify(*s)],
    "refined_period_matrix": lambda *s: ip.refined_period_matrix(*s, 0.02).cochains.toarray(),
    "from_mesh": lambda *s: ip.DeltaComplex.from_mesh(*s).lengths,
    # Only Delaunay triangulations have a double graph.
    "double_graph": lambda *s: ip.double_graph(delaunay(*s)).rho,
    "holomorphic_forms": lambda *s: ip.holomorphic_forms(delaunay(*s)),
    "symplectic_mean_forms": lambda *s: ip.symplectic_mean_forms(delaunay(*s)),
}


@pytest.mark.parametrize("function", FUNCTIONS.values(), ids=FUNCTIONS)
def test_spellings_of_a_surface_mean_the_same(function, path):
    expected = function(ip.DeltaComplex.from_mesh(V, F))
    for name, spelling in SPELLINGS.items():
        found = function(*spelling(path))
        np.testing.assert_equal(found, expected, err_msg=name)


def test_a_gluing_is_a_surface_by_its_path(tmp_path):
    file = tmp_path / "torus.json"
    file.write_text('{"lengths": [[1, 1, 1], [1, 1, 1]], "twin": [[3, 4, 5], [0, 1, 2]]}')
    pm = ip.period_matrix(file)
    assert ip.DeltaComplex.from_mesh(file).genus == pm.genus == 1
    # Two equilateral triangles: the hexagonal torus.
    assert abs(pm.reduced().matrix[0, 0] - (0.5 + np.sqrt(0.75) * 1j)) % 1.0 < 1e-12


def test_what_follows_the_surface_keeps_its_place():
    K = ip.DeltaComplex.from_mesh(V, F)
    for same in (
        ip.homology_basis(V, F, 5),
        ip.homology_basis((V, F), 5),
        ip.homology_basis(V, F, root=5),
        ip.homology_basis(V, F=F, root=5),
        ip.homology_basis(K=K, root=5),
    ):
        np.testing.assert_equal(same, ip.homology_basis(K, 5))
    cocycles = ip.cohomology_basis(K, 5)
    assert np.array_equal(ip.harmonic_forms(V, F, cocycles), ip.harmonic_forms(K, cocycles))
    graph = ip.double_graph(delaunay(K))
    assert np.array_equal(ip.holomorphic_forms(graph), ip.holomorphic_forms(graph.complex))


def test_identify_takes_matrices_surfaces_and_a_tolerance_after_either():
    pm = ip.period_matrix(V, F)
    known = ip.identify(pm, 0.05)
    for same in (ip.identify(V, F, 0.05), ip.identify((V, F), 0.05),
                 ip.identify(pm.complex, tolerance=0.05)):  # fmt: skip
        assert [m.claim for m in same] == [m.claim for m in known]
        assert same.radius == known.radius
    assert ip.identify(((1j, 0.0), (0.0, 1j))).genus == 2  # rows, not a pair


def test_a_function_keeps_its_name_and_its_description():
    for function in (ip.homology_basis, ip.double, ip.holomorphic_forms):
        assert function.__doc__ and function.__module__.startswith("igl_periods.")
        assert next(iter(inspect.signature(function).parameters)) == "K"


@pytest.mark.parametrize("function", [ip.period_matrix, ip.homology_basis, as_complex])
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((None,), "None is not a surface"),
        ((3,), "3 is not a surface"),
        ((object(),), "an object of type object is not a surface. Hand over V and F"),
        (({"V": V, "F": F},), "an object of type dict is not a surface"),
        ((b"mesh.off",), "an object of type bytes is not a surface"),
        ((V,), "faces are missing beside an object of type ndarray"),
        ((V, None), "faces are missing"),
        (((V, F, F, F),), "faces are missing"),
        ((V, 3), r"F must have shape \(m, 3\), not \(\)"),
        ((V, "F"), r"F must have shape \(m, 3\), not \(\)"),
        ((V, F[:, :2]), r"F must have shape \(m, 3\)"),
        ((V, [[0, 1], [2]]), "F is not a rectangular array"),
        (([[0.0], [1.0, 2.0]], F), "V is not a rectangular array"),
        ((V.astype(str), F), "V must hold real numbers"),
        ((Mesh(), F), "an object of type Mesh has faces of its own"),
        (((V, F), F), "an object of type tuple has faces of its own"),
        (("torus.off", F), "'torus.off' has faces of its own"),
        ((ip.DeltaComplex.from_mesh(V, F), F), "a DeltaComplex has its own faces"),
    ],
)  # fmt: skip
def test_wrong_arguments_get_a_sentence(function, arguments, message):
    with pytest.raises(MeshError, match=message):
        function(*arguments)


def test_what_belongs_to_a_surface_is_none():
    with pytest.raises(
        MeshError, match=r"PeriodMatrix is not a surface .* hand over its \.complex"
    ):
        ip.homology_basis(ip.period_matrix(V, F))


def test_a_missing_file_is_missing():
    with pytest.raises(FileNotFoundError, match=r"nowhere\.off"):
        ip.double("nowhere.off")


def test_a_surface_that_has_no_room_is_refused(monkeypatch):
    monkeypatch.setattr("igl_periods.machine.memory.available_memory", lambda: 1e3)
    with pytest.raises(ip.MemoryLimitError, match="a complex of 126 faces takes"):
        ip.homology_basis(V, F)
