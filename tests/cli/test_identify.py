"""The command ``identify``: named surfaces are named, others are not."""

from pathlib import Path

import igl
import pytest
from support.random_surfaces import noisy_torus

from igl_periods.cli.program import main

DATA = Path(__file__).parents[2] / "data"


@pytest.mark.parametrize(
    ("name", "surface"),
    [
        ("lawson_2_1.off", "Lawson xi_{2,1}"),
        ("lawson_2_1_sphere.json", "Lawson xi_{2,1}"),
        ("omega_3.json", "Lawson xi_{2,1}"),
        ("hyperelliptic_x6_1.json", "Lawson xi_{2,1}"),
        ("klein.json", "Klein"),
        ("omega_2.json", "Bolza"),
        ("omega_1.json", "Omega_1"),
        ("wente_20x20.obj", "Wente"),
    ],
)
def test_surfaces_are_identified(capsys, name, surface):
    assert main(["identify", str(DATA / name)]) == 0
    first = capsys.readouterr().out.split("\n\n")[1].splitlines()[0]
    assert surface.lower() in first.lower()
    assert "consistent with the certificate" in first


def test_a_generic_surface_is_none_of_the_named_ones(tmp_path, capsys):
    path = tmp_path / "generic.obj"
    igl.write_triangle_mesh(str(path), *noisy_torus(12, 9, 0.1, 4))
    assert main(["identify", str(path)]) == 0
    assert "consistent" not in capsys.readouterr().out
