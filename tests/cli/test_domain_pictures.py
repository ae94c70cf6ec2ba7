"""Pictures of the command ``capacity``."""

import json

import numpy as np
import pytest

from igl_periods.cli.program import main

FRAME = [
    [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]],
    [[1, 1], [3, 1], [3, 3], [1, 3], [1, 1]],
]


@pytest.fixture
def plate(tmp_path):
    path = tmp_path / "plate.geojson"
    path.write_text(json.dumps({"type": "Polygon", "coordinates": FRAME}))
    return str(path)


@pytest.mark.parametrize(
    "show",
    [
        [],
        ["--show", "radial"],
        ["--show", "parallel", "--point", "0.5,2"],
    ],
)
def test_pictures(plate, tmp_path, capsys, show):
    from PIL import Image

    file = tmp_path / "p.png"
    assert main(["capacity", plate, "--tolerance", "1e-3", "--picture", str(file), *show]) == 0
    assert f"{file}: the " in capsys.readouterr().out
    assert np.asarray(Image.open(file)).std() > 5


def test_json_says_nothing_else(plate, tmp_path, capsys):
    file = tmp_path / "p.png"
    assert main(["capacity", plate, "--json", "--picture", str(file)]) == 0
    assert json.loads(capsys.readouterr().out)["kind"] == "capacity matrix"
    assert file.exists()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--show", "radial"], "--show has no effect without --picture"),
        (["--picture", "p.png", "--show", "parallel"], "needs --point X,Y"),
        (["--picture", "p.png", "--point", "1,1"], "--point has no effect on --show measure"),
        (
            ["--picture", "p.png", "--show", "parallel", "--point", "1,1", "--loop", "3"],
            "--loop has no effect on --show parallel",
        ),
        (["--picture", "p.txt"], "a picture has a name in .png or .jpg"),
        (["--picture", "p.png", "--point", "1"], "a point is X,Y"),
        (["--lattice", "1,0"], "--lattice has no effect on polygons"),
        (["--double"], "there is no option --double"),
    ],
)
def test_wrong_usage(plate, capsys, arguments, message):
    with pytest.raises(SystemExit):
        main(["capacity", plate, *arguments])
    assert message in capsys.readouterr().err


def test_loops_that_there_are_not(plate, tmp_path, capsys):
    for show, first in (("measure", 1), ("radial", 2)):
        arguments = ["--picture", str(tmp_path / "p.png"), "--show", show, "--loop", "3"]
        assert main(["capacity", plate, "--tolerance", "1e-2", *arguments]) == 1
        assert f"there are loops {first} to 2" in capsys.readouterr().err
