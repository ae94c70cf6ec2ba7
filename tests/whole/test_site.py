"""The site has a chapter for each package and an entry for each public name; it builds."""

import importlib
import inspect
import re
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

import igl_periods as ip

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "scripts" / "docs"
PACKAGES = sorted(path.parent.name for path in (ROOT / "igl_periods").glob("*/__init__.py"))


@pytest.fixture(scope="module")
def chapters():
    sys.path.insert(0, str(DOCS))
    try:
        yield importlib.import_module("chapters")
    finally:
        sys.path.remove(str(DOCS))


@pytest.fixture(scope="module")
def pages(chapters):
    return chapters.pages()


def documented(pages):
    """The names of all entries."""
    for text in pages.values():
        module = ""
        for line in text.splitlines():
            if line.startswith(".. py:currentmodule:: "):
                module = line.split()[-1]
            entry = re.match(r"\.\. (?:autoclass|autofunction|py:data):: (\w+)", line)
            if entry:
                yield f"{module}.{entry.group(1)}"


@pytest.mark.parametrize("package", PACKAGES)
def test_each_package_has_its_chapter(pages, package):
    page = pages[f"chapters/{package}.rst"]
    doc = inspect.getdoc(importlib.import_module(f"igl_periods.{package}"))
    # All of its words, but for backslashes before bars and stars.
    assert re.sub(r"\\(?=[|*])", "", doc.partition("\n")[2].strip()) in re.sub(
        r"\\(?=[|*])", "", page
    )
    assert f"   {package}\n" in pages["chapters/index.rst"]
    assert f"   {package}\n" in pages["reference/index.rst"]


@pytest.mark.parametrize("package", PACKAGES)
def test_each_chapter_is_restructured_text(package, chapters):
    core = pytest.importorskip("docutils.core", reason="docutils is not installed")
    from docutils.parsers.rst import roles
    from plain_mathematics import escaped_lines

    for role in ("mod", "class", "func", "meth", "attr"):
        roles.register_generic_role(role, importlib.import_module("docutils.nodes").literal)
    doc = inspect.getdoc(importlib.import_module(f"igl_periods.{package}"))
    text = "\n".join(escaped_lines(doc.splitlines()))
    # A mistake of level 2, a warning, ends this.
    core.publish_doctree(text, settings_overrides={"halt_level": 2, "report_level": 5})


def test_each_public_name_has_one_entry(pages, chapters):
    found = list(documented(pages))
    assert len(found) == len(set(found))
    modules = [ip, ip.genus_two, *(importlib.import_module(f"igl_periods.{p}") for p in PACKAGES)]
    for module in modules:
        for name in chapters.public_names(module):
            entry = chapters.entries()[chapters.identity(module, name)]
            assert entry in found, f"{module.__name__}.{name}"


def test_names_of_users_are_in_the_index(pages):
    for name in ip.__all__:
        if not isinstance(getattr(ip, name), ModuleType):
            assert f"<igl_periods.{name}>`" in pages["reference/index.rst"], name
    for name in ip.surfaces.__all__:
        assert re.search(rf"<igl_periods\.(surfaces\.)?{name}>`", pages["reference/index.rst"]), (
            name
        )


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("The form of |ζ|² and *ω", r"The form of \|ζ\|² and \*ω"),
        ("what ``|x|`` is, *here*", "what ``|x|`` is, *here*"),
        (r":math:`|z|` and |z|", r":math:`|z|` and \|z\|"),
    ],
)
def test_bars_and_stars_are_no_markup(chapters, line, expected):
    from plain_mathematics import escaped

    assert escaped(line) == expected


def test_formulas_and_examples_are_left_alone(chapters):
    from plain_mathematics import escaped_lines

    lines = [".. math:: |z|", "   + |w|", "", ">>> a * b", "|c|", "", "|d|"]
    assert list(escaped_lines(lines)) == [*lines[:-1], r"\|d\|"]


def test_references_find_entries_by_other_names(chapters):
    from cross_references import entry_name, page_of_module, page_of_object

    assert entry_name("igl_periods.periods.period_matrix", None) == "igl_periods.period_matrix"
    assert entry_name("PeriodMatrix.reduced", "igl_periods.periods") == (
        "igl_periods.PeriodMatrix.reduced"
    )
    assert entry_name("no_such_thing", "igl_periods") is None
    assert page_of_module(".cluster", "igl_periods.batch") == "chapters/batch"
    assert page_of_object("repair_mesh", "igl_periods.meshes") == "chapters/meshes"


def test_tutorials_have_a_place_in_the_gallery(chapters):
    from tutorial_order import ORDER, by_number

    scripts = {path.stem for path in (ROOT / "scripts" / "examples").glob("*.py")}
    assert set(ORDER) <= scripts
    assert by_number(f"somewhere/{ORDER[1]}.py") < by_number("another.py")


def test_the_command_sets_up_and_builds():
    command = DOCS / "build"
    assert command.stat().st_mode & 0o111
    assert 'scripts/setup" --docs' in command.read_text(encoding="utf-8")
    assert "/build/" in (ROOT / ".gitignore").read_text(encoding="utf-8")


@pytest.mark.slow
def test_the_site_builds_without_a_warning(tmp_path):
    pytest.importorskip("sphinx_gallery", reason="scripts/setup --docs installs what builds it")
    command = [sys.executable, str(DOCS), "--fresh", "--output", str(tmp_path / "site")]
    ended = subprocess.run(command, capture_output=True, text=True, timeout=1800, check=False)
    assert ended.returncode == 0, ended.stderr
    for page in ("index", "search", "chapters/periods", "reference/periods", "examples/textures"):
        html = (tmp_path / "site" / f"{page}.html").read_text(encoding="utf-8")
        # Nothing comes from a network: neither scripts nor styles nor pictures.
        assert not re.search(r"<(?:script|img|link)[^>]+(?:src|href)=\"(?:https?:)?//", html), page
    assert list((tmp_path / "site").rglob("*.ipynb"))
