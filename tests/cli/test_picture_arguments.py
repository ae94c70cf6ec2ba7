"""What the commands with pictures have in common: forms, components, markings, refusals."""

from pathlib import Path

import igl
import numpy as np
import pytest
from PIL import Image
from support.mesh_folders import TETRAHEDRON
from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.cli.picture_arguments import chosen_scene, chosen_surface, reduced_matrix
from igl_periods.cli.program import _parser


def test_pictures_of_high_genus_are_in_the_marking_of_the_mesh(torus, monkeypatch):
    options = _parser().parse_args(["render", str(torus), "-o", "torus.png"])
    pm = ip.period_matrix(*ip.load_mesh(torus)[:2])
    K, _ = chosen_surface(options)
    assert np.array_equal(reduced_matrix(K, options).matrix, pm.reduced().matrix)
    monkeypatch.setattr("igl_periods.periods.matrix.SIEGEL_GENUS_LIMIT", 0)
    assert np.array_equal(reduced_matrix(K, options).matrix, pm.matrix)


SIMPLEX = np.eye(4)[:, :3], np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
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
        (("--form", "0,0"), "a form is 'even', a number k, or coefficients"),
        (("--form", "nan"), "a form is 'even', a number k, or coefficients"),
        (("--show", "densty"), "did you mean density?"),
        (("-o", "p.gif"), "a PNG or JPEG picture has a name in .png or .jpg or .jpeg, not 'p.gif'"),
        (("--form", "2"), "--form has no effect on --show cycles, which shows no form"),
        (("--form", "1,2", "--show", "cut"), "--form has no effect on --show cut"),
        (("--degree", "2", "--show", "cut"), "--degree has no effect on --show cut, which shows"),
        (("--tolerance", "1", "--show", "quality"), "--tolerance has no effect on --show quality"),
        (("--max-memory", "1", "--show", "quality"), "--max-memory has no effect"),
        (("--no-delaunay", "--show", "quality"), "--no-delaunay has no effect on --show quality"),
        (("--degree", "2", "--tolerance", "1"), "a tolerance chooses the degree"),
    ],
)
def test_wrong_usage(command, capsys, arguments, message):
    with pytest.raises(SystemExit) as exit_:
        command("render", LAWSON, "-o", "p.png", *arguments)
    assert exit_.value.code == 2
    assert message in capsys.readouterr().err


def never(*_):
    raise AssertionError("this should have been refused before anything is computed")


def test_wrong_files_and_forms(command, tmp_path, monkeypatch):
    igl.writeOBJ(str(tmp_path / "sphere.obj"), *SIMPLEX)
    monkeypatch.setattr("igl_periods.cli.picture_arguments.computed", never)
    with pytest.raises(ValueError, match="there is no form ζ_3: the genus is 2"):
        command("render", LAWSON, "-o", tmp_path / "p.png", "--show", "density", "--form", "3")
    with pytest.raises(ValueError, match=r"--form takes 2 coefficients, .* not 3"):
        command("texture", LAWSON, "-o", tmp_path / "p.obj", "--form", "1,2,3")
    with pytest.raises(FileNotFoundError, match="there is no folder"):
        command("render", LAWSON, "-o", tmp_path / "nowhere" / "p.png")
    with pytest.raises(ip.ComplexError, match="no positions in space"):
        command("render", LAWSON.with_name("omega_1.json"), "-o", tmp_path / "p.png")
    (tmp_path / "sphere.off").write_text(TETRAHEDRON)
    with pytest.raises(ip.ComplexError, match="sphere"):
        command("render", tmp_path / "sphere.off", "-o", tmp_path / "p.png", "--show", "cut")
    (tmp_path / "p.png").mkdir()
    with pytest.raises(IsADirectoryError, match=r"p\.png' is a folder"):
        command("texture", LAWSON, "-o", tmp_path / "p.obj")
    with pytest.raises(FileExistsError, match="would replace what is read"):
        command("texture", tmp_path / "sphere.obj", "-o", tmp_path / "sphere.obj")


def test_how_a_picture_was_computed_is_in_its_caption(tmp_path):
    def caption(*arguments):
        options = _parser().parse_args(["render", *map(str, arguments), "-o", "p.png"])
        return chosen_scene(options).caption

    assert caption(LAWSON).endswith("counted with signs.")
    density = ("--show", "density")
    assert caption(LAWSON, *density, "--degree", "3").endswith("with functions of degree 3.")
    told = caption(LAWSON, *density, "--tolerance", "1e-4")
    assert "A bound of at most 0.0001 was asked for; the one reached is" in told
    V, F = torus_of_revolution(2.0, 0.7, 16, 8)
    write_surface(tmp_path / "open.off", V, F[1:])
    assert "double of the one in the file" in caption(tmp_path / "open.off", "--double")


def test_the_form_depends_on_the_degree():
    """The period options have an effect on pictures of forms, so they are not refused."""
    scenes = []
    for degree in ("1", "3"):
        arguments = ["-o", "p.png", "--show", "checkerboard", "--form", "1", "--degree", degree]
        scenes.append(chosen_scene(_parser().parse_args(["render", str(LAWSON), *arguments])))
    difference = np.abs(scenes[0].corner_uv - scenes[1].corner_uv).max()
    assert 1e-6 < difference < 1.0
