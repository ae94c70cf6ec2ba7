"""The surfaces in data/: written by the script, byte for byte, and with the matrices stated."""

import re
from pathlib import Path

import numpy as np
import pytest
from support.brute_force_equivalence import isomorphisms

import igl_periods as ip

DATA = Path(__file__).parents[2] / "data"


# What is left of the difference to the exact matrix: nothing where symmetries determine the surface
# (lengths are rounded to ten decimals), else the distance of the mesh from the smooth surface.
TOLERANCES = {
    "lawson_2_1.off": 2e-3,
    "lawson_2_1_sphere.json": 1e-8,
    "wente_20x20.obj": 2e-3,
    "hyperelliptic_x5_1.json": 2e-2,
    "hyperelliptic_x6_1.json": 2e-2,
    "klein.json": 1e-8,
    "omega_1.json": 1e-8,
    "omega_2.json": 1e-8,
    "omega_3.json": 1e-8,
}


@pytest.fixture
def make_data(monkeypatch):
    monkeypatch.syspath_prepend(DATA.parent / "scripts" / "data")
    import make_data

    return make_data


def stated(name):
    """The matrix and the size that the README states."""
    text = (DATA / "README.md").read_text(encoding="utf-8")
    section = text.split(f"## `{name}`")[1].split("\n## ")[0]
    rows = re.findall(r"^    \[(.*)\]$", section, re.MULTILINE)
    entries = [
        [complex(z.replace("i", "j").replace(" ", "")) for z in row.split(",")] for row in rows
    ]
    counts = re.search(rf"\| `{re.escape(name)}` \| (\d+), (\d+) \| (\d+) \|", text).groups()
    return np.array(entries), tuple(map(int, counts))


def loaded(name):
    if name.endswith(".json"):
        return ip.DeltaComplex.from_json((DATA / name).read_text())
    V, F, _ = ip.load_mesh(DATA / name)
    return ip.DeltaComplex.from_mesh(V, F)


def test_regenerating_gives_the_same_bytes(make_data, monkeypatch, tmp_path):
    monkeypatch.setattr("sys.argv", ["make_data.py", "--output", str(tmp_path)])
    make_data.main()
    assert {p.name for p in tmp_path.iterdir()} == {p.name for p in DATA.iterdir() if p.is_file()}
    for path in tmp_path.iterdir():
        assert path.read_bytes() == (DATA / path.name).read_bytes(), path.name


@pytest.mark.parametrize("name", TOLERANCES)
def test_surfaces_are_what_the_readme_states(name):
    exact, counts = stated(name)
    K = loaded(name)
    assert (K.n_vertices, K.n_faces, K.genus) == counts
    pm = ip.period_matrix(K)
    Pi = pm.reduced()
    # All entries up to 4 for the markings of genus 2; in genus 3 that many cannot be tried.
    matches = isomorphisms(Pi.matrix, exact, 0.05, size=4 if K.genus < 3 else 2, limit=50)
    nearest = min(np.abs(Pi.change_basis(g).matrix - exact).max() for g in matches)
    assert nearest < TOLERANCES[name]


def test_the_readme_names_every_file():
    text = (DATA / "README.md").read_text(encoding="utf-8")
    files = {p.name for p in DATA.iterdir() if p.is_file()} - {"README.md"}
    assert all(f"## `{name}`" in text for name in files)
