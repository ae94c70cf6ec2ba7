"""Write the tables of the guide: measurements of ``benchmark.py``, and the packages.

    python scripts/measure/benchmark.py --json data/measurements/benchmark.json
    python scripts/measure/guide_tables.py                  from data/measurements/benchmark.json
    python scripts/measure/guide_tables.py --check

Each table stands in a page of ``scripts/docs`` between two comments, ``<!-- speed -->`` and
``<!-- /speed -->``; the others are growth, genus, digits, enclosures and peers (from
``enclosures.json`` and ``peers.json`` beside it), and packages, which is made of the first lines of
their faces.  Sections that were not measured stay as they are.
"""

import argparse
import ast
import json
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GUIDE = ROOT / "scripts" / "docs"
SOURCE = ROOT / "igl_periods"
MEASUREMENTS = ROOT / "data" / "measurements"
BESIDE = (MEASUREMENTS / "enclosures.json", MEASUREMENTS / "peers.json")


def speed(rows):
    yield "surface of genus 2", "vertices", "edges to flip", "seconds", "CHOLMOD", "ratio", "memory"
    for row in rows:
        yield (
            row["surface"],
            f"{row['vertices']:,}",
            f"{100 * row['bad_edges']:.0f} %",
            f"{row['seconds']:.1f} s",
            f"{row['cholmod_seconds']:.1f} s",
            f"{row['ratio']:.2f}",
            f"{row['memory_ratio']:.2f}",
        )


def growth(section):
    yield "vertices", "seconds", "over CHOLMOD", "peak memory", "over CHOLMOD"
    for row in section["rows"]:
        yield (
            f"{row['vertices']:,}",
            f"{row['seconds']:.2f} s",
            f"{row['ratio']:.2f}",
            f"{row['peak_bytes'] / 1e6:,.0f} MB",
            f"{row['memory_ratio']:.2f}",
        )
    exponents = section["exponents"]
    yield (
        "exponent",
        f"{exponents['seconds']:.2f}",
        "",
        f"{exponents['peak_bytes']:.2f}",
        "",
    )


def genus(rows):
    yield "surface", "genus", "triangles", "bound", "topology", "Π and bound", "reduction", "memory"
    for row in rows:
        reduction = row["reduction_seconds"]
        yield (
            row["surface"],
            f"{row['genus']:,}",
            f"{row['faces']:,}",
            f"{row['bound']:.2g}",
            f"{row['topology_seconds']:.2f} s",
            f"{row['seconds']:.1f} s",
            "–" if reduction is None else f"{reduction:.1f} s",
            f"{row['peak_bytes'] / 1e9:.2g} GB",
        )


def digits(rows):
    yield "mesh", "genus", "vertices", "1e-6", "1e-8", "1e-10", "ratio"
    for row in rows:
        seconds = [f"{entry['seconds']:.2g} s" for entry in row["tolerances"].values()]
        yield (
            f"`{row['surface']}`",
            str(row["genus"]),
            f"{row['vertices']:,}",
            *seconds,
            f"{row['degree_6_ratio']:.1f}",
        )


def enclosures(rows):
    """Surfaces with what they take for each number of digits, one after the other."""
    yield "surface", "genus", "triangles", "proved digits, in seconds of one core"
    for name in dict.fromkeys(row["surface"] for row in rows):
        mine = [row for row in rows if row["surface"] == name]
        yield (
            f"`{name}`",
            str(mine[0]["genus"]),
            f"{mine[0]['faces']:,}",
            ", ".join(f"{row['proved']} in {row['seconds']:.2g} s" for row in mine),
        )


def peers(rows):
    """Tasks with who does them; the seconds, and their ratio to ours, for each size."""
    sizes = sorted({row["faces"] for row in rows})
    yield "task", "by", *(f"{faces:,} faces" for faces in sizes), "difference to ours"
    for task, way in dict.fromkeys((row["task"], row["by"]) for row in rows):
        mine = {row["faces"]: row for row in rows if (row["task"], row["by"]) == (task, way)}
        times = [
            f"{mine[faces]['seconds']:.2g} s ({mine[faces]['over_ours']:.2f})"
            if faces in mine
            else "–"
            for faces in sizes
        ]
        difference = max(row["difference"] for row in mine.values())
        yield task, way, *times, f"{difference:.0e}" if difference else "–"


def packages():
    """The packages in reading order, and the first lines of their faces."""
    order = re.findall(
        r"``(\w+)``", ast.get_docstring(ast.parse((SOURCE / "__init__.py").read_text()))
    )
    yield "package", "what is in it"
    for name in (name for name in order if (SOURCE / name / "__init__.py").exists()):
        face = ast.get_docstring(ast.parse((SOURCE / name / "__init__.py").read_text("utf-8")))
        summary = face.splitlines()[0].rstrip(".").replace("``", "`")
        yield f"[`{name}/`](../../../igl_periods/{name}/__init__.py)", summary


TABLES = {
    "speed": speed,
    "growth": growth,
    "genus": genus,
    "digits": digits,
    "enclosures": enclosures,
    "peers": peers,
}


def markdown(rows):
    head, *body = rows
    lines = [head, ["---"] * len(head), *body]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in lines)


def with_tables(text, tables):
    """A page with its tables put in their places."""
    for name, rows in tables.items():
        table = f"<!-- {name} -->\n{markdown(rows)}\n<!-- /{name} -->"
        text = re.sub(
            rf"<!-- {name} -->.*?<!-- /{name} -->", lambda _, new=table: new, text, flags=re.S
        )
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("json", type=Path, nargs="?", default=MEASUREMENTS / "benchmark.json")
    parser.add_argument("--check", action="store_true", help="write nothing; fail on differences")
    options = parser.parse_args()
    measured = list(json.loads(options.json.read_text(encoding="utf-8")).items())
    for path in filter(Path.exists, BESIDE):
        measured += json.loads(path.read_text(encoding="utf-8")).items()
    tables = {name: TABLES[name](section) for name, section in measured if name in TABLES}
    tables = {name: list(rows) for name, rows in {"packages": packages(), **tables}.items()}
    missing = set(tables)
    for page in sorted(GUIDE.rglob("*.md")):
        before = page.read_text(encoding="utf-8")
        missing -= set(re.findall(r"<!-- (\w+) -->", before))
        text = with_tables(before, tables)
        if options.check and text != before:
            sys.exit(f"{page} differs from the measurements")
        if text != before:
            page.write_text(text, encoding="utf-8")
    sys.exit(f"no page has a place for {', '.join(sorted(missing))}" if missing else 0)


if __name__ == "__main__":
    main()
