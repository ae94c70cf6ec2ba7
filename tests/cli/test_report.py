"""The command ``report``: the page that it writes, and what it refuses."""

from pathlib import Path

import pytest

DATA = Path(__file__).parents[2] / "data"


def test_a_page_about_a_gluing(command, tmp_path, capsys):
    page = tmp_path / "page.html"
    assert command("report", DATA / "omega_1.json", "-o", page) == 0
    assert capsys.readouterr().out == f"wrote {page}\n"
    assert "omega_1.json" in page.read_text(encoding="utf-8")


def test_the_page_needs_a_name(command, capsys):
    with pytest.raises(SystemExit) as exit_:
        command("report", DATA / "lawson_2_1.off")
    assert exit_.value.code == 2
    assert "-o" in capsys.readouterr().err
