"""The code blocks of the README run as they stand, in order, in one namespace."""

import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


BLOCKS = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), flags=re.DOTALL)


def test_code_blocks_run(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    assert BLOCKS
    namespace: dict[str, object] = {}
    for block in BLOCKS:
        exec(compile(block, "README.md", "exec"), namespace)
    assert capsys.readouterr().out


@pytest.mark.parametrize("command", ["scripts/demo", "scripts/test"])
def test_commands_of_the_readme_exist(command):
    assert (ROOT / command).stat().st_mode & 0o111
    assert command in (ROOT / "README.md").read_text()


def test_tables_are_those_of_the_measurements(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "scripts" / "measure")
    monkeypatch.setattr("sys.argv", ["readme_tables.py", "--check"])
    with pytest.raises(SystemExit) as end:
        importlib.import_module("readme_tables").main()
    assert end.value.code == 0
