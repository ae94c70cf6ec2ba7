"""The command ``texture``: the files that it writes."""

from pathlib import Path

import pytest

LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"


@pytest.mark.parametrize("suffix", ["obj", "glb"])
def test_texture(command, tmp_path, capsys, suffix):
    file = tmp_path / f"surface.{suffix}"
    assert command("texture", LAWSON, "-o", file) == 0
    out = capsys.readouterr().out
    assert str(file) in out
    assert "together 2 = 2g − 2" in out
    assert file.stat().st_size > 10_000
