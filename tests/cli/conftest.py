"""A mesh on disk, and commands run without a display."""

import igl
import pytest
from support.random_surfaces import torus_of_revolution

from igl_periods.cli import program


@pytest.fixture
def torus(tmp_path):
    path = tmp_path / "torus.off"
    igl.write_triangle_mesh(str(path), *torus_of_revolution(2.0, 0.8, 20, 12))
    return path


@pytest.fixture
def command(monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    parser = program._parser()

    def run(*arguments):
        options = parser.parse_args([str(argument) for argument in arguments])
        return options.run(options)

    return run
