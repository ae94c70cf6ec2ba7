"""Every object that a user gets is short to look at, and what it says is true."""

import dataclasses
import importlib
import inspect
import re
from xml.etree import ElementTree as ET

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.batch import BatchOptions, BatchResult
from igl_periods.complexes import intrinsic_delaunay, involution
from igl_periods.surfaces import square_tiled_surface, torus_of_revolution
from igl_periods.topology import tree_cotree

V, F = torus_of_revolution(2.0, 0.9, 9, 7)
V = V + 0.05 * np.random.default_rng(3).normal(size=V.shape)


def off_text(V, F):
    rows = [["OFF"], [len(V), len(F), 0], *V.tolist(), *([3, *face] for face in F.tolist())]
    return "".join(" ".join(map(str, row)) + "\n" for row in rows)


@pytest.fixture(scope="module")
def objects(tmp_path_factory):
    """One object of every kind, by name."""
    file = tmp_path_factory.mktemp("shown") / "torus & co.off"
    file.write_text(off_text(V, F))
    pm = ip.period_matrix(V, F)
    genus_two = ip.period_matrix(square_tiled_surface("omega_1", n=2), degree=4)
    K = pm.complex
    L, _ = intrinsic_delaunay(K, pm.cocycles)
    graph = ip.double_graph(L)
    one_form = np.ones((2, graph.n_edges))
    report = ip.load_mesh(file, repair=True)[2]
    identified = ip.identify(genus_two)
    enclosed = ip.enclose(square_tiled_surface("omega_1", n=2), digits=8)
    return {
        "PeriodMatrix": pm,
        "of genus 2": genus_two,
        "of genus 0": ip.period_matrix(ip.double([[0, 0], [1, 0], [0, 1]], [[0, 1, 2]])),
        "uncertified": ip.period_matrix(K, weights="extrinsic"),
        "DeltaComplex": K,
        "with boundary": ip.DeltaComplex.from_mesh(V, F[:-1]),
        "double": ip.double(K),
        "Involution": involution(ip.double(K)),
        "TreeCotree": tree_cotree(K),
        "DoubleGraph": graph,
        "HodgeDecomposition": ip.hodge_decomposition(graph, one_form),
        "FundamentalPolygon": ip.fundamental_polygon(K),
        "MeshQuality": ip.mesh_quality(K),
        "MeshReport": report,
        "MeshFacts": report.result,
        "Refined": ip.refined_period_matrix(K, 0.02),
        "Extrapolation": ip.richardson(lambda n: torus_of_revolution(2.0, 1.0, n, n), (8, 12, 16)),
        "SiegelReduction": ip.siegel_reduce(pm),
        "PeriodEnclosure": enclosed,
        "EnclosedReduction": ip.siegel_reduce(enclosed),
        "in balls": ip.symplectic_isomorphisms(enclosed, enclosed),
        "Isomorphisms": ip.symplectic_isomorphisms(genus_two, genus_two),
        "none": ip.symplectic_isomorphisms([[1j]], [[1.2j]]),
        "SymplecticGroup": ip.symplectic_automorphism_group(genus_two),
        "Identification": identified,
        "Match": identified[0],
        "NamedSurface": ip.catalogue(2)[0],
        "Parametrization": ip.parametrize(pm, [1.0]),
        "AbelJacobi": ip.abel_jacobi(pm),
        "BatchOptions": BatchOptions(),
        "BatchResult": BatchResult([{"error": None}], 1, 0),
    }


PLAIN = {"MeshFacts", "TreeCotree", "Involution", "BatchOptions"}


def test_objects_are_short_to_look_at(objects):
    for name, thing in objects.items():
        lines = repr(thing).splitlines()
        assert 0 < len(lines) <= 10, name
        assert all(len(line) <= 160 for line in lines), (name, lines)
        assert "array(" not in repr(thing) and "0x" not in repr(thing), name


def test_a_notebook_shows_a_table_that_is_whole(objects):
    for name, thing in objects.items():
        if name not in PLAIN:
            ET.fromstring(f"<body>{thing._repr_html_()}</body>")


def test_no_class_of_a_face_dumps_its_arrays():
    packages = (
        "complexes topology forms siegel moduli surfaces periods differentials meshes batch "
        "jacobians"
    )
    for package in packages.split():
        for name, thing in vars(importlib.import_module(f"igl_periods.{package}")).items():
            if not (inspect.isclass(thing) and dataclasses.is_dataclass(thing)):
                continue
            kinds = str(inspect.get_annotations(thing))
            if re.search("Ints|Floats|Complexes|Bools|NDArray|csr_array", kinds):
                shown = inspect.unwrap(thing.__repr__)
                assert "dataclasses" not in shown.__code__.co_filename, name
                assert shown.__code__.co_filename.endswith(".py"), name


def test_what_is_said_of_them(objects):
    assert repr(objects["DeltaComplex"]) == (
        "DeltaComplex(63 vertices, 189 edges, 126 faces; genus 1)"
    )
    assert repr(objects["with boundary"]).endswith("125 faces; 3 boundary edges)")
    assert repr(objects["double"]).endswith("252 faces; 2 components)")
    assert repr(objects["Isomorphisms"]).startswith("Isomorphisms(")
    assert "Omega_1" in repr(objects["Identification"])
    assert repr(objects["FundamentalPolygon"]).startswith("FundamentalPolygon(4 sides")
    assert "not certified" in repr(objects["uncertified"])
    assert repr(objects["of genus 0"]) == "PeriodMatrix of genus 0, bound 0"
    moebius = ip.DeltaComplex.from_gluing([[1, 1, 1]], [[2, -1, 0]], [[True, False, True]])
    assert repr(moebius) == (
        "DeltaComplex(1 vertex, 2 edges, 1 face; 1 boundary edge, not orientable)"
    )


CELL = re.compile(r"<td[^>]*>([^<]*)</td>")
NUMBER = r"[−+]?\s*\d+(?:\.\d*)?"


def parts(cell):
    """The real and the imaginary part as they are written in a cell."""
    imaginary = re.search(rf"({NUMBER}) i$", cell)
    rest = cell[: imaginary.start()] if imaginary else cell
    return rest.strip() or "0", imaginary[1].replace(" ", "").lstrip("+") if imaginary else "0"


@pytest.mark.parametrize("degree", [1, 2, 4])
def test_the_digits_of_a_period_matrix_are_those_of_the_surface(degree):
    """Against three more digits: none that is shown is off by more than 1."""
    pm = ip.period_matrix(V, F, degree=degree)
    exact = ip.period_matrix(V, F, tolerance=1e-3 * pm.bound)
    cells = CELL.findall(pm._repr_html_())
    assert len(cells) == pm.genus**2
    for cell, z in zip(cells, exact.matrix.ravel()):
        for text, x in zip(parts(cell), (z.real, z.imag)):
            shown = text.replace("−", "-")
            decimals = len(shown.partition(".")[2])
            error = 1e-3 * float(pm.entry_bounds.max())
            if shown != "0":
                assert abs(float(shown) - x) <= 1.5 * 10.0**-decimals + error
            else:
                assert abs(x) <= 10.0 * float(pm.entry_bounds.max())


def test_latex_of_a_period_matrix(objects):
    latex = objects["of genus 2"]._repr_latex_()
    assert latex.startswith(r"$\displaystyle \Pi = \begin{pmatrix} ")
    assert latex.endswith(r" \end{pmatrix}$")
