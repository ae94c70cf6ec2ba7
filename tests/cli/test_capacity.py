"""The command ``capacity``, and cells given with ``--lattice``."""

import json

import igl
import numpy as np
import pytest
from support.random_domains import frame

from igl_periods.cli.program import main
from igl_periods.surfaces import triply_periodic_minimal_surface

FRAME = [
    [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]],
    [[1, 1], [3, 1], [3, 3], [1, 3], [1, 1]],
]


def write(path, V, F):
    igl.write_triangle_mesh(str(path), np.column_stack([V, np.zeros((len(V), 3 - V.shape[1]))]), F)
    return str(path)


def test_mesh_and_polygon_have_the_same_capacities(tmp_path, capsys):
    mesh = write(tmp_path / "frame.obj", *frame(4, 2))
    polygon = tmp_path / "frame.geojson"
    geometry = {"type": "Polygon", "coordinates": FRAME}
    polygon.write_text(json.dumps(geometry))
    for path in (mesh, str(polygon)):
        assert main(["capacity", path, "--tolerance", "1e-8"]) == 0
        out = capsys.readouterr().out
        assert out.startswith("CapacityMatrix of 2 loops, bound ")
        assert "10.23409" in out
        assert "loop 2: BoundaryLoop(" in out
    feature = {"type": "Feature", "geometry": geometry}
    collection = {"type": "FeatureCollection", "features": [feature]}
    polygon.write_text(json.dumps(collection))
    assert main(["capacity", str(polygon), "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    assert document["lower"][1][1] <= 10.2340925693681 <= document["upper"][1][1]
    assert document["loops"][1]["point"] == [1.0, 1.0]
    assert document["loops"][0]["length"] == 16.0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{}", "not a GeoJSON file with a polygon"),
        ("[1", "not a GeoJSON file with a polygon"),
        ('{"type": "Point", "coordinates": [0, 0]}', "holds Point: one Polygon is needed"),
        ('{"type": "Polygon", "coordinates": [[[0, 0], [1, 0]]]}', "2 different corners"),
    ],
)
def test_files_that_hold_no_polygon(tmp_path, capsys, text, message):
    path = tmp_path / "none.geojson"
    path.write_text(text)
    assert main(["capacity", str(path)]) == 1
    assert message in capsys.readouterr().err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["plate.geojson", "--fill-holes", "3"], "--fill-holes has no effect on polygons"),
        (["plate.geojson", "--lattice", "1,0"], "--lattice has no effect on polygons"),
        (["plate.off", "--double"], "there is no option --double"),
    ],
)
def test_options_without_effect(capsys, arguments, message):
    with pytest.raises(SystemExit):
        main(["capacity", *arguments])
    assert message in capsys.readouterr().err


def test_closed_surfaces_have_no_capacities(torus, capsys):
    assert main(["capacity", str(torus)]) == 1
    assert "has no boundary" in capsys.readouterr().err


def test_cells_are_glued_by_their_lattice(tmp_path, capsys):
    V, F, lattice = triply_periodic_minimal_surface("G", 2)
    path = write(tmp_path / "gyroid.obj", V, F)
    text = ";".join(",".join(map(str, row)) for row in lattice)
    assert main(["identify", path, "--tolerance", "1e-4", f"--lattice={text}"]) == 0
    assert "gyroid" in capsys.readouterr().out
    assert main(["compute", path, f"--lattice={text}"]) == 0
    assert "genus 3" in capsys.readouterr().out
    assert main(["compute", path, "--lattice=0.3,0,0"]) == 1
    assert "the lattice glues nothing" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["compute", path, "--lattice=a,b"])
    assert "translations as in" in capsys.readouterr().err


def test_a_marching_cubes_cell_of_the_p_surface_from_a_file(tmp_path, capsys):
    n = 12
    x = np.linspace(0, 2 * np.pi, n + 1)
    z, y, x = np.meshgrid(x, x, x, indexing="ij")
    P = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    values = np.cos(P - [0.1, 0.17, 0.23]).sum(axis=1)
    V, F, _ = igl.marching_cubes(values, P, n + 1, n + 1, n + 1, 0.0)
    path = tmp_path / "p.obj"
    # With six digits, as programs write them.
    lines = [f"v {a:.6g} {b:.6g} {c:.6g}" for a, b, c in V]
    path.write_text("\n".join(lines + [f"f {a + 1} {b + 1} {c + 1}" for a, b, c in F]))
    period = 2 * np.pi
    lattice = f"--lattice={period},0,0;0,{period},0;0,0,{period}"
    assert main(["identify", str(path), "--degree", "2", lattice]) == 0
    assert "Schwarz P and D surfaces and gyroid" in capsys.readouterr().out
    picture = tmp_path / "p.png"
    arguments = ["-o", str(picture), "--size", "80x60", "--copies", "2,1,1"]
    assert main(["render", str(path), lattice, *arguments]) == 0
    assert picture.exists()
    assert (
        main(["texture", str(path), lattice, "-o", str(tmp_path / "t.obj"), "--copies", "2"]) == 0
    )
    assert (tmp_path / "t.obj").read_text().count("\nf ") == 8 * len(F)
    with pytest.raises(SystemExit):
        main(["render", str(path), "-o", str(picture), "--copies", "2"])
    assert "--copies has no effect without --lattice" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["render", str(path), lattice, "-o", str(picture), "--copies", "2,2"])
    assert "one number, or 3" in capsys.readouterr().err
    with pytest.raises(SystemExit):
        main(["render", str(path), lattice, "-o", str(picture), "--copies", "0"])
    assert "numbers of copies are" in capsys.readouterr().err
