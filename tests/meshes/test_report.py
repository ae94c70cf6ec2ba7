"""The report on a mesh, as JSON and in words."""

import json

import numpy as np
from support.mesh_files import cube, off, written

from igl_periods.meshes.load import load_mesh


def test_report_as_json_and_in_words(tmp_path):
    V, quads = cube()
    V, polygons = np.vstack([V, [5.0, 5.0, 5.0]]), quads[1:].tolist()
    path = written(tmp_path / "box.off", off(V, polygons))
    _, _, report = load_mesh(path, repair=True, largest_hole=4)
    document = json.loads(json.dumps(report.as_dict()))
    assert document["faces"] == document["polygons_fanned"] == 5
    assert document["loaded"]["boundary_edges"] == 4
    assert document["loaded"]["defects"] == ["4 edges with one triangle (boundary)"]
    assert document["result"]["defects"] == []
    assert document["result"]["components"] == [
        {"triangles": 14, "orientable": True, "genus": 0, "boundary_loops": 0}
    ]
    assert {step["name"]: step["changed"] for step in document["repair"]}[
        "holes of up to 4 edges filled"
    ] == 1
    assert str(report).splitlines() == [
        f"{path}: 9 vertices, 10 triangles",
        "  5 faces in the file; 5 polygons divided into triangles",
        "  1 vertex without triangles",
        "  genus 0, 1 boundary loop",
        "  defect: 4 edges with one triangle (boundary)",
        "  repair: holes of up to 4 edges filled: 1",
        "  repair: vertices without triangles dropped: 1",
        "after repair: 9 vertices, 14 triangles",
        "  genus 0, closed",
    ]
