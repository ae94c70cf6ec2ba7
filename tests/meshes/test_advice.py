"""Each mesh is shown its own way out, on the command line too."""

from pathlib import Path

import numpy as np
import pytest
from support.mesh_files import torus

from igl_periods.cli import main

CASES = Path(__file__).parent / "cases"

SQUARE = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"
CUBE_WITHOUT_LID = (
    "OFF\n8 5 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n"
)


def test_each_mesh_is_shown_its_own_way_out(tmp_path, capsys):
    torn = CASES / "stl_noise_near_zero.stl"
    square, box = tmp_path / "square.off", tmp_path / "box.off"
    square.write_text(SQUARE)
    box.write_text(CUBE_WITHOUT_LID)
    assert main(["compute", str(torn)]) == 1
    error = capsys.readouterr().err
    assert "lie in pairs at the same place" in error and "Repair the mesh first" in error
    assert "--double" not in error
    assert main(["compute", str(torn), "--repair"]) == 0
    assert "welded within the tolerance: 171, up to 4.7e-17 apart" in capsys.readouterr().out
    assert main(["compute", str(square)]) == 1
    error = capsys.readouterr().err
    assert "--fill-holes SIZE" in error and "--double" in error and "Repair" not in error
    # The log of the repair is shown with the refusal.
    assert main(["compute", str(box), "--fill-holes", "3"]) == 1
    error = capsys.readouterr().err
    assert "repair: nothing to do" in error and "defect: 4 edges with one triangle" in error
    assert main(["compute", str(box), "--fill-holes", "4"]) == 0
    assert "holes of up to 4 edges filled: 1" in capsys.readouterr().out


def test_the_double_of_a_torn_surface_is_warned_of(tmp_path, capsys):
    # A torus cut along one of its circles: a cylinder, whose double is another torus.
    V, F = torus()
    last = (F >= 30).any(axis=1) & (F < 5).any(axis=1)
    torn = np.where(last[:, None] & (F < 5), F + len(V), F)
    rows = "".join(" ".join(map(repr, x)) + "\n" for x in np.vstack([V, V[:5]]).tolist())
    faces = "".join(f"3 {a} {b} {c}\n" for a, b, c in torn)
    path = tmp_path / "torn.off"
    path.write_text(f"OFF\n{len(V) + 5} {len(F)} 0\n{rows}{faces}")
    assert main(["compute", str(path), "--double"]) == 0
    assert "warning: the double of a torn surface: 10 boundary edges" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("options", "reason"),
    [(["--weld", "1"], "from 0 to 0.01"), (["--fill-holes", "-1"], "a number of edges")],
)
def test_options_that_are_none(capsys, options, reason):
    with pytest.raises(SystemExit):
        main(["compute", "x.off", *options])
    assert reason in capsys.readouterr().err
