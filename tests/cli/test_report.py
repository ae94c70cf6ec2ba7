"""The command ``report``: the page that it writes, and what it refuses."""

import re
from pathlib import Path

import pytest

DATA = Path(__file__).parents[2] / "data"


@pytest.fixture(autouse=True)
def _small_pictures(monkeypatch):
    for size in ("_BESIDE", "_ALONE"):
        monkeypatch.setattr(f"igl_periods.reports.page.{size}", (40, 30))


def test_a_page_about_a_gluing(command, tmp_path, capsys):
    page = tmp_path / "page.html"
    assert command("report", DATA / "omega_1.json", "-o", page, "--no-interactive") == 0
    assert capsys.readouterr().out == f"wrote {page}\n"
    text = page.read_text(encoding="utf-8")
    assert "omega_1.json" in text
    assert "<iframe" not in text
    assert '<th scope="row">bound asked for</th><td>none</td>' in text


def test_the_page_needs_a_name(command, capsys):
    with pytest.raises(SystemExit) as exit_:
        command("report", DATA / "lawson_2_1.off")
    assert exit_.value.code == 2
    assert "-o" in capsys.readouterr().err


def test_the_page_says_how_its_matrix_was_computed(command, tmp_path):
    page = tmp_path / "page.html"
    assert command("report", DATA / "omega_1.json", "-o", page, "--tolerance", "1e-5") == 0
    text = page.read_text(encoding="utf-8")
    assert "A bound of at most 10<sup>−5</sup> was asked for; the one reached is" in text
    assert "<iframe" in text
    (number,) = re.findall(r"known to within (\S+), relative to its size; no entry", text)
    digits, power = re.fullmatch(r"(\S+)·10<sup>−(\d+)</sup>", number).groups()
    assert float(f"{digits}e-{power}") <= 1.1e-5
