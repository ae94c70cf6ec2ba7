"""Pictures: what scenes contain, what is drawn of it, and the commands that draw."""

import builtins
import ctypes
import subprocess
import sys
from pathlib import Path

import igl
import numpy as np
import pytest
from PIL import Image
from random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.cli import program
from igl_periods.complexes.doubling import double
from igl_periods.differentials.even_form import most_even_form
from igl_periods.differentials.parametrization import parametrize
from igl_periods.errors import RenderError
from igl_periods.meshes.surface_files import components_by_genus, surface_of
from igl_periods.periods.quality import mesh_quality
from igl_periods.pictures.rendering import check_display, render, save, with_legend
from igl_periods.pictures.scenes import (
    Scene,
    checkerboard,
    checkerboard_scene,
    cut_scene,
    cycle_colour,
    cycles_scene,
    density_scene,
    plain_scene,
    quality_scene,
    surface_in_space,
)
from igl_periods.pictures.tubes import smooth_closed_curves, tube
from igl_periods.surfaces import flat_torus

LAWSON = Path(__file__).parents[1] / "data" / "lawson_2_1.off"
SIZE = (240, 180)


@pytest.fixture(scope="module")
def torus():
    """The torus of revolution with radii 2 and 0.7, in the plane z = 0."""
    return ip.period_matrix(*torus_of_revolution(2.0, 0.7, 40, 20)).reduced()


@pytest.fixture(scope="module")
def lawson():
    V, F, _ = ip.load_mesh(LAWSON)
    return ip.period_matrix(V, F).reduced()


def is_drawn(picture):
    """Mask of what is not background."""
    return (picture < 250).any(axis=2)


def count_near(picture, colour, tolerance=0.06):
    """Number of pixels with the hue and nearly the saturation of a colour, however lit."""
    pixels = picture.reshape(-1, 3) / 255.0
    brightness = np.maximum(pixels.max(axis=1, keepdims=True), 0.25)
    wanted = np.asarray(colour) / max(colour)
    return np.count_nonzero(np.abs(pixels / brightness - wanted).max(axis=1) < 3 * tolerance)


def test_cycles_are_seen_in_their_colours(torus):
    scene = cycles_scene(torus)
    picture = render(scene, SIZE, direction=(0.3, -0.2, 1.0))
    assert picture.shape == (180, 240, 3)
    assert picture.dtype == np.uint8
    assert 0.3 < is_drawn(picture).mean() < 0.9
    assert np.array_equal(picture[0, 0], [255, 255, 255])
    assert [name for name, _ in scene.legend] == ["a1", "b1"]
    without = render(plain_scene(torus.complex), SIZE, direction=(0.3, -0.2, 1.0))
    for _, colour in scene.legend:
        assert count_near(picture, colour) > 40
        assert count_near(without, colour) == 0


def test_smoothed_cycles_stay_on_the_torus_and_in_their_classes(torus):
    scene = cycles_scene(torus)
    windings = []
    for curve in scene.tubes:
        x, y, z = curve.points.T
        distance = np.hypot(x, y)
        # The mesh is inscribed in the torus, of radius 0.7 around the circle of radius 2.
        assert np.all(np.abs(np.hypot(distance - 2.0, z) - 0.7) < 0.03)
        assert np.all(np.abs(np.linalg.norm(curve.normals, axis=1) - 1) < 1e-12)
        loop = [winding(np.arctan2(y, x)), winding(np.arctan2(z, distance - 2.0))]
        windings.append(loop)
    # A basis of the homology of the torus; both are shortest, so one is a meridian.
    assert abs(round(np.linalg.det(windings))) == 1
    assert [0, 1] in np.abs(windings).tolist()


def winding(angle):
    steps = np.diff(np.append(angle, angle[0]))
    return int(np.rint(np.sum((steps + np.pi) % (2 * np.pi) - np.pi) / (2 * np.pi)))


def test_smoothing_shortens_curves():
    V, F = torus_of_revolution(2.0, 0.7, 40, 20)
    u = np.linspace(0, 2 * np.pi, 50, endpoint=False)
    v = 0.3 * np.sin(9 * u)
    ring = 2.0 + 0.7 * np.cos(v)
    wavy = np.stack([ring * np.cos(u), ring * np.sin(u), 0.7 * np.sin(v)], axis=1)
    ((points, _),) = smooth_closed_curves(V, F, [wavy])
    lengths = [
        np.linalg.norm(np.diff(c, axis=0, append=c[:1]), axis=1).sum() for c in (wavy, points)
    ]
    assert 2 * np.pi * 2.6 < lengths[1] < 0.97 * lengths[0]
    assert smooth_closed_curves(V, F, []) == []


def test_tubes_are_tori_of_the_right_thickness():
    t = 2 * np.pi * np.arange(100) / 100
    circle = np.stack([3 * np.cos(t), 3 * np.sin(t), 0 * t], axis=1)
    V, F = tube(circle, np.tile([0.0, 0, 1], (100, 1)), 0.2, closed=True)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert K.genus == 1
    away = np.hypot(np.hypot(V[:, 0], V[:, 1]) - 3.0, V[:, 2])
    np.testing.assert_allclose(away, 0.2, rtol=1e-12)
    # Outward normals: the enclosed volume is positive, 2π² R r² but for the polygons.
    volume = np.einsum("fi,fi->", V[F[:, 0]], np.cross(V[F[:, 1]], V[F[:, 2]])) / 6
    assert volume == pytest.approx(2 * np.pi**2 * 3 * 0.04, rel=0.06)
    V, F = tube(circle[:30], np.tile([0.0, 0, 1], (30, 1)), 0.2, closed=False)
    assert ip.DeltaComplex.from_mesh(V, F).n_boundary_edges == 24


def test_checkerboard_shows_squares_and_zeros(lawson):
    P = parametrize(lawson, most_even_form(lawson))
    scene = checkerboard_scene(P)
    picture = render(scene, SIZE)
    # Lit or in the shade, dark squares are blue and pale ones are grey.
    pixels = picture[is_drawn(picture)].astype(float)
    blue = pixels[:, 2] > 1.5 * pixels[:, 0]
    grey = np.abs(pixels[:, 2] - pixels[:, 0]) < 25
    assert 0.3 < blue.mean() / (blue.mean() + grey.mean()) < 0.7
    assert blue.mean() + grey.mean() > 0.6
    zeros, _, colour = scene.balls[0]
    assert len(zeros) == np.count_nonzero(P.index > 0)
    with_zeros = Scene(scene.V, scene.F, scene.colours, balls=((scene.V[:1], 0.05, colour),))
    direction = scene.V[0] - scene.V.mean(axis=0)
    assert count_near(render(with_zeros, SIZE, direction), colour) > 20


def test_one_period_of_the_checkerboard():
    board = checkerboard(8)
    assert np.array_equal(board[:4, :4], board[4:, 4:])
    assert np.array_equal(board[:4, 4:], board[4:, :4])
    assert (board[0, 0] != board[0, 7]).all()


def test_density_is_light_where_the_form_is_large(torus):
    # |ζ| is inversely proportional to the distance from the axis.
    scene = density_scene(parametrize(torus, [1.0]))
    distance = np.hypot(scene.V[:, 0], scene.V[:, 1])
    lightness = scene.colours.sum(axis=1)
    assert np.corrcoef(lightness, distance)[0, 1] < -0.9
    low, high = (float(name) for name, _ in (scene.legend[0], scene.legend[-1]))
    assert high / low == pytest.approx(2.7 / 1.3, rel=0.05)
    pixels = render(scene, SIZE, (1, 0, 1)).reshape(-1, 3).astype(int)
    red, green, blue = pixels[is_drawn(pixels[None])[0]].T
    yellow, violet = (np.minimum(red, green) > 2 * blue), (np.minimum(red, blue) > green + 20)
    assert 0.02 < yellow.mean() < 0.5
    assert 0.02 < violet.mean() < 0.5


def test_quality_is_light_where_the_bound_originates(lawson):
    quality = mesh_quality(lawson.complex)
    scene = quality_scene(lawson.complex, quality)
    worst = np.argsort(quality.vertex_excess)[-10:]
    assert scene.colours[worst].sum(axis=1).mean() > scene.colours.sum(axis=1).mean() + 0.2
    drawn = is_drawn(render(scene, SIZE))
    plain = is_drawn(render(plain_scene(lawson.complex), SIZE))
    assert np.mean(drawn != plain) < 0.01
    assert 0.2 < drawn.mean() < 0.9


def test_the_cut_is_seen(lawson):
    P = parametrize(lawson, [1.0, 0.0])
    scene = cut_scene(P)
    assert len(scene.tubes) == P.seams.size
    assert count_near(render(scene, SIZE), scene.tubes[0].colour) > 100


def test_the_surface_fills_the_picture_and_is_seen_from_the_right_side():
    V, F = torus_of_revolution(2.0, 0.7, 40, 20)
    marked = Scene(V, F, np.full(V.shape, 0.8), balls=((np.array([[0, 0, 0.9]]), 0.1, (1, 0, 0)),))
    for direction in ((0, 0, 1), (1, 0, 0)):
        drawn = is_drawn(render(marked, (300, 200), direction))
        rows, columns = np.flatnonzero(drawn.any(axis=1)), np.flatnonzero(drawn.any(axis=0))
        height, width = np.ptp(rows) + 1, np.ptp(columns) + 1
        assert max(height / 200, width / 300) > 0.85
        assert rows[0] > 0
        assert rows[-1] < 199
        assert columns[0] > 0
        assert columns[-1] < 299
    hidden = Scene(
        V, F, np.full(V.shape, 0.8), balls=((np.array([[2.0, 0, 0.8]]), 0.1, (1, 0, 0)),)
    )
    above, below = (render(hidden, (300, 200), (0, 0, z)) for z in (1.0, -1.0))
    assert count_near(above, (1, 0, 0)) > 100
    assert count_near(below, (1, 0, 0)) < 0.2 * count_near(above, (1, 0, 0))


def test_of_a_double_only_one_sheet_is_shown():
    V, F = torus_of_revolution(2.0, 0.7, 20, 10)
    K = double(ip.DeltaComplex.from_mesh(V, np.delete(F, [0, 1, 200], axis=0)))
    pm = ip.period_matrix(K).reduced()
    for scene in (
        cycles_scene(pm),
        cut_scene(parametrize(pm, np.eye(pm.genus)[0])),
        checkerboard_scene(parametrize(pm, np.eye(pm.genus)[0])),
    ):
        assert len(scene.F) == K.n_faces // 2
        normals = np.concatenate([curve.normals for curve in scene.tubes] or [np.zeros((0, 3))])
        assert np.isfinite(normals).all()
        if scene.corner_uv is not None:
            assert len(scene.corner_uv) == len(scene.F)
    assert 0.3 < is_drawn(render(plain_scene(K), SIZE)).mean() < 0.9


def test_legend_and_files(torus, tmp_path):
    scene = cycles_scene(torus)
    picture = np.full((240, 320, 3), 255, dtype=np.uint8)
    labelled = with_legend(picture, scene)
    for k in range(2):
        exact = np.rint(255 * np.array(cycle_colour(k, 2)) - 0.5)
        assert np.count_nonzero((np.abs(labelled - exact) <= 1).all(axis=2)) >= 100
    assert np.array_equal(labelled[:200], picture[:200])
    save(tmp_path / "a.png", labelled)
    assert np.array_equal(np.asarray(Image.open(tmp_path / "a.png")), labelled)


def test_nothing_is_said_while_drawing(torus, capfd):
    render(plain_scene(torus.complex), (40, 30))
    assert capfd.readouterr() == ("", "")


def test_what_cannot_be_drawn_is_refused(torus):
    scene = plain_scene(torus.complex)
    for size in ((0, 10), (10, 5000)):
        with pytest.raises(ValueError, match="both must be between 1 and 4096"):
            render(scene, size)
    for direction in ((0, 0, 0), (1, 2), (np.nan, 0, 1)):
        with pytest.raises(ValueError, match="a direction is three numbers"):
            render(scene, SIZE, direction)
    with pytest.raises(ip.ComplexError, match="no positions in space"):
        plain_scene(flat_torus(1j, 3))
    V, F = torus_of_revolution(2.0, 0.7, 8, 5)
    K = ip.DeltaComplex.from_mesh(np.concatenate([V, V], axis=1), F)
    with pytest.raises(ip.ComplexError, match="lies in R\\^6"):
        surface_in_space(K)


def test_plane_surfaces_lie_in_space():
    K = ip.DeltaComplex.from_mesh([[0.0, 0], [1, 0], [0, 1]], [[0, 1, 2]])
    V, _ = surface_in_space(K)
    assert V.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


@pytest.mark.parametrize(
    ("message", "expected"),
    [
        ("libX11.so.6: cannot open shared object file", "libX11.so.6 is missing.*libx11-6"),
        ("libusb-1.0.so.0: cannot open shared object", "libusb-1.0.so.0 is missing.*libusb-1.0-0"),
        ("libunheard.so.3: cannot open", r"libunheard.so.3 is missing\."),
        ("No module named 'open3d'", "pip install open3d"),
    ],
)
def test_what_open3d_lacks_is_named(torus, monkeypatch, message, expected):
    original = builtins.__import__

    def broken(name, *arguments, **options):
        if name == "open3d":
            raise (ImportError if "module" in message else OSError)(message)
        return original(name, *arguments, **options)

    monkeypatch.setattr(builtins, "__import__", broken)
    with pytest.raises(RenderError, match=expected):
        render(plain_scene(torus.complex), SIZE)


def test_missing_egl_is_named(torus, monkeypatch):
    scene = plain_scene(torus.complex)

    class NoDriver:
        def __init__(self, name):
            self.eglGetPlatformDisplay = self.eglGetDisplay = Refusing()
            self.eglInitialize = Refusing()

    class Refusing:
        restype = None

        def __call__(self, *arguments):
            return 0

    monkeypatch.setattr(ctypes, "CDLL", NoDriver)
    with pytest.raises(RenderError, match=r"EGL finds no driver.*libegl-mesa0"):
        render(scene, SIZE)

    def missing(name):
        raise OSError(f"{name}: cannot open shared object file")

    monkeypatch.setattr(ctypes, "CDLL", missing)
    with pytest.raises(RenderError, match=r"libEGL.so.1 is missing.*libegl1"):
        render(scene, SIZE)


def test_open3d_is_imported_for_pictures_only():
    program = (
        "import sys, igl_periods, igl_periods.cli, igl_periods.reports;"
        f"V, F, _ = igl_periods.load_mesh({str(LAWSON)!r});"
        "igl_periods.period_matrix(V, F);"
        "sys.exit(sum(name in sys.modules for name in ('open3d', 'matplotlib', 'PIL')))"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


# ---- The commands ----


@pytest.fixture
def command(monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    parser = program._parser()

    def run(*arguments):
        options = parser.parse_args([str(argument) for argument in arguments])
        return options.run(options)

    return run


@pytest.mark.parametrize("kind", ["cycles", "checkerboard", "quality"])
def test_render(command, tmp_path, capsys, kind):
    file = tmp_path / "picture.png"
    assert command("render", LAWSON, "-o", file, "--show", kind, "--size", "80x60") == 0
    picture = np.asarray(Image.open(file))
    assert picture.shape == (60, 80, 3)
    assert 0.1 < is_drawn(picture).mean() < 0.9
    assert capsys.readouterr().out.startswith(f"{file}: ")


def test_forms_on_the_command_line(command, tmp_path):
    pictures = []
    for form in ("1", "1,0", "0.5+1i,2"):
        file = tmp_path / "p.png"
        arguments = ("--show", "checkerboard", "--size", "80x60", "--form", form)
        assert command("render", LAWSON, "-o", file, *arguments) == 0
        pictures.append(np.asarray(Image.open(file)).astype(int))
    assert np.array_equal(pictures[0], pictures[1])
    assert np.abs(pictures[0] - pictures[2]).mean() > 1


def test_view_needs_a_display(command, capsys):
    with pytest.raises(RenderError, match="DISPLAY is not set"):
        check_display()
    assert command("view", LAWSON) == 1
    assert "there is no display to open a window on" in capsys.readouterr().err


def test_view_shows_the_scene_in_a_window(command, monkeypatch, capsys):
    import open3d

    shown = []
    monkeypatch.setenv("DISPLAY", ":0")
    monkeypatch.setattr(open3d.visualization, "draw", lambda parts, **_: shown.extend(parts))
    assert command("view", LAWSON, "--show", "cut") == 0
    assert [part["name"] for part in shown] == ["surface", "marks"]
    surface, marks = (part["geometry"] for part in shown)
    assert len(surface.triangles) == 1536
    assert len(marks.triangles) > 1000
    assert "The cut that makes the surface a disk" in capsys.readouterr().out


@pytest.mark.parametrize("suffix", ["obj", "glb"])
def test_texture(command, tmp_path, capsys, suffix):
    file = tmp_path / f"surface.{suffix}"
    assert command("texture", LAWSON, "-o", file) == 0
    out = capsys.readouterr().out
    assert str(file) in out
    assert "together 2 = 2g − 2" in out
    assert file.stat().st_size > 10_000


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


def test_components_are_sorted_by_genus():
    V, F = torus_of_revolution(2.0, 0.7, 16, 8)
    sphere = np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]])
    W = np.concatenate([np.eye(4, 3), V])
    K = ip.DeltaComplex.from_mesh(W, np.concatenate([sphere, F + 4]))
    assert [part.genus for part in K.components()] == [0, 1]
    assert [part.genus for part in components_by_genus(K)] == [1, 0]
    assert surface_of(K, component=1).genus == 1
    assert surface_of(K) is K
    doubled = surface_of(ip.DeltaComplex.from_mesh(V, F[1:]), doubled=True, component=1)
    assert doubled.genus == 2


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


def test_a_machine_that_cannot_draw(command, tmp_path, capsys, monkeypatch):
    def missing(name):
        raise OSError(f"{name}: cannot open shared object file")

    monkeypatch.setattr(ctypes, "CDLL", missing)
    assert command("render", LAWSON, "-o", tmp_path / "p.png", "--show", "cut") == 1
    assert "libEGL.so.1 is missing" in capsys.readouterr().err
