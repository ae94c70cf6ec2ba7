"""The command ``render``, and machines that cannot draw."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from support.rendered_pictures import is_drawn

LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"


def test_open3d_is_imported_for_pictures_only():
    program = (
        "import sys, igl_periods, igl_periods.cli, igl_periods.reports;"
        f"V, F, _ = igl_periods.load_mesh({str(LAWSON)!r});"
        "igl_periods.period_matrix(V, F);"
        "sys.exit(sum(name in sys.modules for name in ('open3d', 'matplotlib', 'PIL')))"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


@pytest.mark.parametrize("kind", ["cycles", "checkerboard", "quality", "sensitivity", "quadratic"])
def test_render(command, tmp_path, capsys, kind):
    file = tmp_path / "picture.png"
    assert command("render", LAWSON, "-o", file, "--show", kind, "--size", "80x60") == 0
    picture = np.asarray(Image.open(file))
    assert picture.shape == (60, 80, 3)
    assert 0.1 < is_drawn(picture).mean() < 0.9
    assert capsys.readouterr().out.startswith(f"{file}: ")


def test_a_machine_without_drivers(command, tmp_path, capsys, monkeypatch):
    # Where the loaders of EGL and of Vulkan look for drivers.
    for variable in ("__EGL_VENDOR_LIBRARY_FILENAMES", "VK_DRIVER_FILES", "VK_ICD_FILENAMES"):
        monkeypatch.setenv(variable, "/nowhere.json")
    assert command("render", LAWSON, "-o", tmp_path / "p.png", "--show", "cut") == 1
    assert re.search(r"(EGL|Vulkan) finds no driver", capsys.readouterr().err)
    assert not (tmp_path / "p.png").exists()
