"""Tables as text and CSV, and log-log plots, for the scripts that reproduce the paper's tables."""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import numpy as np


def arguments(description, levels):
    """The options all of these scripts have: where results go, and how many rows to compute."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--output", type=Path, default=Path("results"), help="folder for results")
    parser.add_argument(
        "--levels", type=int, default=levels, help=f"refinements to compute, 1 … {levels}"
    )
    options = parser.parse_args()
    if not 1 <= options.levels <= levels:
        parser.error(f"--levels must be 1 … {levels}")
    options.output.mkdir(parents=True, exist_ok=True)
    return options


def write(folder, name, rows, paragraphs):
    """Write ``name.csv`` and ``name.txt``, and show the latter."""
    with (folder / f"{name}.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows({key: exact(value) for key, value in row.items()} for row in rows)
    text = table(rows) + "\n\n" + "\n\n".join(paragraphs) + "\n"
    (folder / f"{name}.txt").write_text(text, encoding="utf-8")
    print(text)


def table(rows):
    """Columns as wide as they need to be, numbers to three digits."""
    cells = [list(rows[0])] + [[short(value) for value in row.values()] for row in rows]
    widths = [max(len(row[c]) for row in cells) for c in range(len(cells[0]))]
    lines = ["  ".join(c.rjust(w) for c, w in zip(row, widths, strict=True)) for row in cells]
    return "\n".join([lines[0], "-" * len(lines[0]), *lines[1:]])


def short(value):
    if value is None:
        return "-"
    return f"{value:.2e}" if isinstance(value, float) else str(value)


def exact(value):
    if value is None:
        return ""
    return repr(float(value)) if isinstance(value, float) else value


def same_digits(printed, computed):
    """Whether a number rounds to what is printed, to three significant digits."""
    return f"{printed:.2e}" == f"{computed:.2e}"


def order(sizes, errors):
    """The fitted order of errors in the mesh size h ~ V^(-1/2)."""
    if len(sizes) < 2:
        return float("nan")
    return -2 * float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


def loglog(path, title, curves):
    """Plot errors against numbers of vertices.

    ``curves`` maps a label to (numbers of vertices, errors, style).
    """
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    figure, axes = plt.subplots(figsize=(9, 5), layout="constrained")
    for label, (sizes, errors, style) in curves.items():
        axes.loglog(sizes, np.maximum(errors, 1e-16), style, label=label, markersize=5)
    axes.set(xlabel="vertices", ylabel="error", title=title)
    axes.grid(True, which="both", linewidth=0.3)
    figure.legend(loc="outside right upper", fontsize=8)
    figure.savefig(path, dpi=150)
    plt.close(figure)
