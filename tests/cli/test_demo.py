"""The command ``demo``: what ``compute`` says of a surface that comes with the package."""

import shlex

import pytest

import igl_periods as ip
from igl_periods.cli import main


def test_demo(capsys):
    assert main(["demo"]) == 0
    out = capsys.readouterr().out
    first, _, result = out.partition("\n\n")
    file = str(ip.sample_files()["lawson_2_1"])
    assert first.endswith(f"of genus 2: igl-periods compute {shlex.quote(str(file))}")
    assert main(["compute", file]) == 0
    assert result == capsys.readouterr().out
    assert main(["demo", "klein"]) == 0
    assert "genus 3" in capsys.readouterr().out


def test_demo_of_nothing_known(capsys):
    with pytest.raises(SystemExit) as end:
        main(["demo", "bunny"])
    assert end.value.code == 2
    assert "invalid choice: 'bunny'" in capsys.readouterr().err
