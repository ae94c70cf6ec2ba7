"""The extras of the installation: a core that needs none, and what is said where one is missing."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.machine import EXTRAS, missing_library, require
from igl_periods.pictures import plain_scene, render, save, with_legend, write_obj
from igl_periods.reports import write_report

ROOT = Path(__file__).parents[2]
LAWSON = ROOT / "data" / "lawson_2_1.off"
BROUGHT = {package for packages in EXTRAS.values() for package in packages}
# What a package is called in an import and in an installation.
DISTRIBUTIONS = {"PIL": "pillow"}


def without(monkeypatch, *packages):
    for package in packages:
        monkeypatch.setitem(sys.modules, package, None)


def section(name):
    """A table of pyproject.toml, as text: Python 3.10 has no reader of TOML."""
    text = (ROOT / "pyproject.toml").read_text()
    return re.search(rf"^\[{re.escape(name)}\]\n(.*?)(?=^\[|\Z)", text, re.DOTALL | re.MULTILINE)[1]


def test_extras_are_those_of_the_installation():
    lists = dict(
        re.findall(r"^(\w+) = \[(.*?)\]$", section("project.optional-dependencies"), re.M | re.S)
    )
    for extra, packages in EXTRAS.items():
        names = set(re.findall(r'"([\w-]+)', lists[extra]))
        assert names == {DISTRIBUTIONS.get(package, package) for package in packages}
    assert set(re.findall(r"\w+", lists["all"].partition("[")[2])) == {
        "pictures",
        "batch",
        "completion",
        "domains",
    }
    required = set(re.findall(r'^  "([\w-]+)', section("project"), re.M))
    assert required.isdisjoint(DISTRIBUTIONS.get(package, package) for package in BROUGHT)


def run_without(packages, program, folder):
    """Run a program in a Python that lacks some packages."""
    lacking = f"import sys; sys.modules |= dict.fromkeys({sorted(packages)!r})\n"
    return subprocess.run(
        [sys.executable, "-c", lacking + program],
        capture_output=True,
        check=False,
        cwd=folder,
        text=True,
    )


def test_the_core_needs_no_extra(tmp_path):
    program = f"""
import igl_periods as ip, igl_periods.cli, igl_periods.surfaces
V, F, _ = ip.load_mesh({str(LAWSON)!r})
assert ip.period_matrix(V, F, degree=2).bound < 1e-3
sys.exit(igl_periods.cli.main(["compute", {str(LAWSON)!r}, "--json"]))
"""
    done = run_without(BROUGHT, program, tmp_path)
    assert done.stderr == ""
    assert done.returncode == 0


def test_require_names_what_is_missing(monkeypatch):
    require("arithmetic", "numpy")
    without(monkeypatch, "dask", "tqdm")
    with pytest.raises(ip.MissingExtraError, match=r"^a table needs dask and tqdm: pip install"):
        require("a table", "dask", "pyarrow", "tqdm")
    assert issubclass(ip.MissingExtraError, ImportError)
    assert issubclass(ip.MissingExtraError, ValueError)


def test_missing_libraries_are_named():
    assert "apt-get install libgl1" in missing_library(OSError("libGL.so.1: cannot open"))


def doors(tmp_path):
    """What needs an extra, from Python: its packages, its extra, a call."""
    pm = ip.period_matrix(*torus_of_revolution(2.0, 0.7, 8, 6))
    scene = plain_scene(pm.complex)
    return {
        "render": (("open3d",), "pictures", lambda: render(scene, (8, 6))),
        "legend": (("PIL",), "pictures", lambda: with_legend(scene.V, scene)),
        "save": (("PIL",), "pictures", lambda: save(tmp_path / "p.png", scene.V)),
        "report": (
            ("matplotlib",),
            "pictures",
            lambda: write_report(tmp_path / "r.html", pm, name="torus"),
        ),
        "turning": (("k3d",), "pictures", pm.show),
        "texture": (
            ("PIL",),
            "pictures",
            lambda: write_obj(tmp_path / "t.obj", ip.parametrize(pm, [1.0])),
        ),
        "drawing": (("svgelements",), "domains", lambda: ip.read_domain(tmp_path / "d.svg")),
    }


@pytest.mark.parametrize(
    "door", ["render", "legend", "save", "report", "turning", "texture", "drawing"]
)
def test_every_door_names_its_extra(monkeypatch, tmp_path, door):
    packages, extra, call = doors(tmp_path)[door]
    without(monkeypatch, *packages)
    message = rf"needs {' and '.join(packages)}: pip install 'igl_periods\[{extra}\]'$"
    with pytest.raises(ip.MissingExtraError, match=message):
        call()


def test_the_package_of_batches_names_its_extra(tmp_path):
    done = run_without(["dask", "pyarrow"], "import igl_periods.batch", tmp_path)
    assert done.stderr.splitlines()[-1] == (
        "igl_periods.errors.MissingExtraError: a batch needs dask and pyarrow: "
        "pip install 'igl_periods[batch]'"
    )


@pytest.mark.parametrize(
    ("arguments", "missing", "extra"),
    [
        (("render", LAWSON, "-o", "p.png"), "open3d", "pictures"),
        (("view", LAWSON), "open3d", "pictures"),
        (("report", LAWSON, "-o", "r.html"), "matplotlib", "pictures"),
        (("report", LAWSON, "-o", "r.html"), "k3d", "pictures"),
        (("view", LAWSON, "-o", "v.html"), "k3d", "pictures"),
        (("texture", LAWSON, "-o", "t.glb"), "PIL", "pictures"),
        (("batch", LAWSON, "-o", "b.parquet"), "pyarrow", "batch"),
        (("batch", LAWSON, "-o", "b.parquet"), "tqdm", "batch"),
    ],
)
def test_every_command_names_its_extra_in_one_line(tmp_path, arguments, missing, extra):
    words = [str(argument) for argument in arguments]
    program = f"import igl_periods.cli; sys.exit(igl_periods.cli.main({words!r}))"
    done = run_without([missing], program, tmp_path)
    assert done.returncode == 1
    assert done.stdout == ""
    line = rf"igl-periods: [\w. ]+ needs {missing}: pip install 'igl_periods\[{extra}\]'\n"
    assert re.fullmatch(line, done.stderr)
