"""The code blocks of README and guide run as they stand, in order, each page in one namespace."""

import importlib
import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SITE = ROOT / "scripts" / "docs"
PAGES = [ROOT / "README.md", *sorted(SITE.rglob("*.md"))]


def named(page):
    return page.relative_to(ROOT).as_posix()


def blocks(page):
    return re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), flags=re.DOTALL)


@pytest.mark.parametrize("page", [page for page in PAGES if blocks(page)], ids=named)
def test_code_blocks_run(page, monkeypatch):
    monkeypatch.chdir(ROOT)
    namespace: dict[str, object] = {}
    for block in blocks(page):
        exec(compile(block, named(page), "exec"), namespace)


@pytest.mark.parametrize("page", PAGES, ids=named)
def test_links_lead_somewhere(page):
    for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
        if ":" in target:
            continue
        # Pages that are made when the site is built begin with a slash.
        if target.startswith("/"):
            assert target.split("/")[1] in {"chapters", "examples", "reference"}, target
        else:
            assert (page.parent / target).resolve().exists(), target


def test_the_readme_leads_to_every_page_of_the_guide():
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES if page.name != "index.md")
    for page in (SITE / "guide").glob("*.md"):
        if page.name != "index.md":
            assert f"{page.name})" in text, page.name


@pytest.mark.parametrize("command", ["scripts/demo", "scripts/test"])
def test_commands_of_the_readme_exist(command):
    assert (ROOT / command).stat().st_mode & 0o111
    assert command in (ROOT / "README.md").read_text(encoding="utf-8")


def test_a_person_reads_the_readme_on_two_screens():
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) <= 100


def test_tables_are_those_of_the_measurements(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "scripts" / "measure")
    monkeypatch.setattr("sys.argv", ["guide_tables.py", "--check"])
    with pytest.raises(SystemExit) as end:
        importlib.import_module("guide_tables").main()
    assert end.value.code == 0
