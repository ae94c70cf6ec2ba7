"""Build the site: guide, tutorials, chapters, reference.

    python scripts/docs                    # into build/site; open build/site/index.html
    python scripts/docs --no-run           # without running the tutorials: a minute less
    python scripts/docs --output FOLDER

Sources are collected in build/docs, where the pages that are made from the package join those
written by hand.  Warnings are errors; nothing is fetched from a network.
"""

import argparse
import os
import re
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
# As deep below the root as the sources, so that the same relative paths lead to data/.
STAGE = ROOT / "build" / "docs"
sys.path[:0] = [str(HERE), str(ROOT)]

from chapters import pages  # noqa: E402

# Links of the guide to sources, which people follow where they read it as Markdown; in the site
# there are pages of these.
PAGES_OF_SOURCES = (
    (r"\((?:\.\./)+igl_periods/(\w+)/__init__\.py\)", r"(/chapters/\1.rst)"),
    (r"\((?:\.\./)+scripts/examples/(\w+)\.py\)", r"(/examples/\1.rst)"),
    (r"\((?:\.\./)+scripts/examples/\)", "(/examples/index.rst)"),
    (r"\((?:\.\./)+(\.github/[\w.]+|LICENSE|scripts/[\w/.]+|data/README\.md)\)", None),
)


def linked(text):
    """A page of the guide, with its links to sources made links to pages of the site."""
    for pattern, page in PAGES_OF_SOURCES:
        if page is None:
            text = re.sub(rf"\[([^\]]*)\]{pattern}", r"\1 (`\2`)", text)
        else:
            text = re.sub(pattern, page, text)
    return text


def write(path, text):
    """Write a file unless it is there already: Sphinx reads again what is newer."""
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def collect(stage):
    """Bring all sources together: those written by hand, and those made from the package."""
    made = {stage / name: text for name, text in pages().items()}
    for path in HERE.rglob("*.md"):
        made[stage / path.relative_to(HERE)] = linked(path.read_text(encoding="utf-8"))
    for path, text in made.items():
        write(path, text)
    for folder in ("guide", "chapters", "reference"):
        for path in (stage / folder).glob("*"):
            if path not in made:
                path.unlink()
    shutil.copytree(HERE / "static", stage / "static", dirs_exist_ok=True)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, default=ROOT / "build" / "site")
    parser.add_argument("--no-run", action="store_true", help="do not run the tutorials")
    parser.add_argument("--fresh", action="store_true", help="make all pages anew")
    options = parser.parse_args(arguments)
    try:
        from sphinx.cmd.build import build_main
    except ImportError:
        parser.error("Sphinx is missing: scripts/docs/build sets everything up")
    if options.fresh:
        shutil.rmtree(STAGE, ignore_errors=True)
        shutil.rmtree(options.output, ignore_errors=True)
    collect(STAGE)
    os.environ.setdefault("MPLBACKEND", "agg")
    command = ["-b", "html", "-W", "--keep-going", "-q", "-n", "-c", str(HERE)]
    if options.no_run:
        os.environ["IGL_PERIODS_TUTORIALS_NOT_RUN"] = "1"
    code = build_main([*command, str(STAGE), str(options.output)])
    if code == 0:
        print(options.output / "index.html")
    return code


if __name__ == "__main__":
    sys.exit(main())
