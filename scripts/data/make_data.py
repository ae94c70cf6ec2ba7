"""Write the small meshes of ``data/`` and their README; the same bytes every time.

    python scripts/data/make_data.py
    python scripts/data/make_data.py --output somewhere

Numbers are rounded to ten decimals, so that the last bits of a processor's arithmetic do not show;
surfaces whose lengths are known exactly are written with them.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np

from igl_periods import DeltaComplex
from igl_periods.surfaces import (
    cyclic_cover,
    lawson_surface,
    regular_map_period_matrix,
    regular_map_surface,
    square_tiled_period_matrix,
    square_tiled_surface,
    stereographic,
    wente_modulus,
    wente_torus,
)

DECIMALS = 10
SQUARES = {
    "omega_1": ("three", "the L-shaped origami, one vertex of total angle 6π"),
    "omega_2": ("four", "Bolza's curve y² = x⁵ − x, two vertices of total angle 4π"),
    "omega_3": ("six", "y² = x⁶ − 1, four vertices of total angle 3π"),
}

README = """\
# Small surfaces with exactly known period matrices

Written by `python scripts/data/make_data.py`; running it again gives the same files, byte for byte.
Coordinates and lengths are rounded to {decimals} decimals; `omega_*.json` and `klein.json` carry
exact lengths, too, so that `igl_periods.enclose` proves digits of the surfaces that they are meant
to be. A period matrix Π belongs to a marking,
so a computed one agrees with the one given here up to the action of Sp(2g, Z).

`*.off`, `*.obj` are meshes: `V, F, report = igl_periods.load_mesh(path)`.

`*.json` are triangles glued along their sides, for surfaces that have no embedding at hand (and may
have double edges and loops): an object with the keys

* `"lengths"`: one row of three numbers per triangle, the length of the side opposite each corner;
* `"twin"`: one row of three half-edges per triangle; half-edge 3 f + s is side s of triangle f, the
  one opposite corner s, and the two glued sides run in opposite directions,

and, where they are known, exact lengths and polygons (`igl_periods.DeltaComplex.to_json`).

    pm = igl_periods.period_matrix(path)

Polyhedral surfaces that are inscribed in smooth ones have Π only in the limit of fine meshes; the
square-tiled ones have it exactly, and the certified bound of a computation is about them.

| file | vertices, triangles | genus |
|---|---|---|
{table}

{entries}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    default = Path(__file__).resolve().parents[2] / "data"
    parser.add_argument("--output", type=Path, default=default, help="folder (default: data)")
    output = parser.parse_args().output
    output.mkdir(parents=True, exist_ok=True)
    for name, content in files().items():
        (output / name).write_text(content, encoding="utf-8", newline="\n")


def files():
    """Names and contents of all files."""
    surfaces = [lawson(), lawson_in_the_sphere(), wente(), quintic(), sextic(), klein()]
    surfaces += map(square_tiled, SQUARES)
    contents = {name: content for name, content, *_ in surfaces}
    table = [
        f"| `{name}` | {vertices}, {triangles} | {genus} |"
        for name, _, vertices, triangles, genus, _ in surfaces
    ]
    contents["README.md"] = README.format(
        decimals=DECIMALS,
        table="\n".join(table),
        entries="\n".join(f"## `{name}`\n\n{text}" for name, *_, text in surfaces),
    )
    return contents


def lawson():
    V, F = lawson_surface(2, 1, 8)
    text = (
        "Lawson's minimal surface ξ_{2,1} ⊂ S³ in stereographic projection: "
        "`lawson_surface(2, 1, 8)`, `stereographic(V, 2, 1)`.\nIts curve is y² = x⁶ − 1.\n\n"
        + shown(square_tiled_period_matrix("omega_3"), "(i/√3) [[2, −1], [−1, 2]]")
    )
    return "lawson_2_1.off", off(stereographic(V, 2, 1), F), len(V), len(F), 2, text


def lawson_in_the_sphere():
    V, F = lawson_surface(2, 1, 8)
    K = DeltaComplex.from_mesh(V, F)
    text = (
        "The same surface with its lengths in S³ ⊂ R⁴, where it has all of its symmetries: "
        "`lawson_surface(2, 1, 8)`.\n\n"
        + shown(square_tiled_period_matrix("omega_3"), "(i/√3) [[2, −1], [−1, 2]]")
    )
    return "lawson_2_1_sphere.json", gluing(K), len(V), len(F), 2, text


def wente():
    V, F = wente_torus(20)
    text = (
        "Wente's immersed torus of constant mean curvature ½ with three lobes, on a 20 × 20 grid "
        "of conformal coordinates:\n`wente_torus(20)`.\n\n"
        + shown(
            np.array([[wente_modulus()]]), "exp(2i arctan(X/3Y)), see `igl_periods.surfaces.wente`"
        )
    )
    return "wente_20x20.obj", obj(V, F), len(V), len(F), 1, text


def quintic():
    c, s, t = np.cos(2 * np.pi / 5), np.sin(2 * np.pi / 5), np.sin(np.pi / 5)
    Pi = np.array([[2j * t, c - 0.5 - 1j * t], [c - 0.5 - 1j * t, -c + 1j * s]])
    formula = (
        "[[2i t, c − ½ − i t], [c − ½ − i t, −c + i s]], c = cos 72°, s = sin 72°, t = sin 36°"
    )
    return hyperelliptic(5, "y² = x⁵ − 1", shown(Pi, formula))


def sextic():
    Pi = square_tiled_period_matrix("omega_3")
    return hyperelliptic(6, "y² = x⁶ − 1", shown(Pi, "(i/√3) [[2, −1], [−1, 2]]"))


def hyperelliptic(n, curve, matrix):
    K = cyclic_cover(2, np.exp(2j * np.pi * np.arange(n) / n), size=0.25, graded=True)
    text = (
        f"The curve {curve}: two sheets over an inscribed polyhedral sphere, with triangles "
        "graded towards the six branch\npoints: `cyclic_cover(2, roots, size=0.25, graded=True)`."
        f"\n\n{matrix}"
    )
    return f"hyperelliptic_x{n}_1.json", gluing(K), K.n_vertices, K.n_faces, 2, text


def klein():
    K = regular_map_surface("klein", 1)
    text = (
        "Klein's quartic, from 56 equilateral triangles, seven at each vertex: "
        '`regular_map_surface("klein", 1)`.\n\n'
        + shown(
            regular_map_period_matrix("klein"),
            "½ [[e, 1, 1], [1, e, 1], [1, 1, e]], e = (−1 + i√7)/2",
        )
    )
    return "klein.json", exact_gluing(K), K.n_vertices, K.n_faces, 3, text


def square_tiled(name):
    K = square_tiled_surface(name, 4)
    squares, description = SQUARES[name]
    formulas = {
        "omega_1": "(i/3) [[5, −4], [−4, 5]]",
        "omega_2": "(1/3) [[−2 + √8 i, 1 − √2 i], [1 − √2 i, −2 + √8 i]]",
        "omega_3": "(i/√3) [[2, −1], [−1, 2]]",
    }
    text = (
        f"The paper's surface of {squares} unit squares ({description}), each square divided into "
        f'4 × 4:\n`square_tiled_surface("{name}", 4)`.\n\n'
        + shown(square_tiled_period_matrix(name), formulas[name])
    )
    return f"{name}.json", exact_gluing(K), K.n_vertices, K.n_faces, 2, text


def shown(Pi, formula):
    """A period matrix as a formula and in decimals."""
    rows = [", ".join(f"{z.real + 0:.12f} {z.imag:+.12f}i" for z in row) for row in Pi]
    return f"Π = {formula}\n\n" + "".join(f"    [{row}]\n" for row in rows)


def off(V, F):
    lines = ["OFF", f"{len(V)} {len(F)} 0"]
    lines += [" ".join(map(decimal, v)) for v in V]
    lines += [f"3 {a} {b} {c}" for a, b, c in F]
    return "\n".join(lines) + "\n"


def obj(V, F):
    lines = ["v " + " ".join(map(decimal, v)) for v in V]
    lines += [f"f {a} {b} {c}" for a, b, c in F + 1]
    return "\n".join(lines) + "\n"


def gluing(K):
    """Lengths and twins as JSON, a triangle to a line."""
    lengths = ",\n".join("[" + ", ".join(map(decimal, row)) + "]" for row in K.lengths)
    twin = ",\n".join(json.dumps(row) for row in K.twin.tolist())
    return f'{{"lengths": [\n{lengths}\n],\n"twin": [\n{twin}\n]}}\n'


def exact_gluing(K):
    """The same with exact lengths, as the library writes it."""
    return K.to_json().replace("], [", "],\n[") + "\n"


def decimal(x):
    return f"{round(float(x), DECIMALS) + 0.0:.{DECIMALS}f}"


if __name__ == "__main__":
    main()
