"""What the commands with pictures have in common: forms, components, markings, refusals."""

from pathlib import Path

import igl
import numpy as np
import pytest
from PIL import Image
from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.cli.picture_arguments import reduced_surface as _reduced
from igl_periods.cli.program import _parser


def test_pictures_of_high_genus_are_in_the_marking_of_the_mesh(torus, monkeypatch):
    options = _parser().parse_args(["render", str(torus), "-o", "torus.png"])
    pm = ip.period_matrix(*ip.load_mesh(torus)[:2])
    assert np.array_equal(_reduced(options)[0].matrix, pm.reduced().matrix)
    monkeypatch.setattr("igl_periods.periods.matrix.SIEGEL_GENUS_LIMIT", 0)
    assert np.array_equal(_reduced(options)[0].matrix, pm.matrix)


LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"


def test_forms_on_the_command_line(command, tmp_path):
    pictures = []
    for form in ("1", "1,0", "0.5+1i,2"):
        file = tmp_path / "p.png"
        arguments = ("--show", "checkerboard", "--size", "80x60", "--form", form)
        assert command("render", LAWSON, "-o", file, *arguments) == 0
        pictures.append(np.asarray(Image.open(file)).astype(int))
    assert np.array_equal(pictures[0], pictures[1])
    assert np.abs(pictures[0] - pictures[2]).mean() > 1


def write_surface(path, V, F):
    igl.writeOFF(str(path), np.asarray(V, float), np.asarray(F, np.int64))


def test_doubles_and_components_on_the_command_line(command, tmp_path):
    V, F = torus_of_revolution(2.0, 0.7, 16, 8)
    open_torus, two = tmp_path / "open.off", tmp_path / "two.off"
    write_surface(open_torus, V, F[1:])
    write_surface(two, np.concatenate([V, V + 9]), np.concatenate([F, F + len(V)]))
    out = ("-o", tmp_path / "p.png", "--size", "80x60")
    with pytest.raises(ip.ComplexError, match="take the double"):
        command("render", open_torus, *out)
    assert command("render", open_torus, *out, "--double") == 0
    with pytest.raises(ip.ComplexError, match="2 components"):
        command("render", two, *out)
    assert command("render", two, *out, "--component", "2") == 0
    with pytest.raises(ip.ComplexError, match="no component 3: there are 2"):
        command("render", two, *out, "--component", "3")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--size", "large"), "a size is WIDTHxHEIGHT, such as 1200x900, not 'large'"),
        (("--direction", "up"), "a direction is three numbers X,Y,Z, not 'up'"),
        (("--form", "zeta"), "a form is 'even', a number k, or coefficients"),
        (("--show", "nothing"), "invalid choice"),
    ],
)
def test_wrong_usage(command, capsys, arguments, message):
    with pytest.raises(SystemExit) as exit_:
        command("render", LAWSON, "-o", "p.png", *arguments)
    assert exit_.value.code == 2
    assert message in capsys.readouterr().err


def test_wrong_files_and_forms(command, tmp_path):
    with pytest.raises(ValueError, match="a picture is a PNG or JPEG file"):
        command("render", LAWSON, "-o", tmp_path / "p.gif")
    with pytest.raises(ValueError, match="an OBJ or GLB file"):
        command("texture", LAWSON, "-o", tmp_path / "p.stl")
    with pytest.raises(ValueError, match="there is no form ζ_3: the genus is 2"):
        command("render", LAWSON, "-o", tmp_path / "p.png", "--show", "density", "--form", "3")
    with pytest.raises(ValueError, match="coefficients must be 2 finite numbers"):
        command("texture", LAWSON, "-o", tmp_path / "p.obj", "--form", "1,2,3")
