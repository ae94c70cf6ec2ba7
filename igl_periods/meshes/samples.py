"""Surfaces for a first try, which come with the package."""

from __future__ import annotations

from pathlib import Path

SAMPLES = {
    "lawson_2_1": ("lawson_2_1.off", "Lawson's minimal surface ξ_{2,1} in S³, of genus 2"),
    "wente_20x20": ("wente_20x20.obj", "Wente's torus of constant mean curvature"),
    "klein": ("klein.json", "Klein's quartic, 56 triangles glued along their sides, of genus 3"),
    "omega_1": ("omega_1.json", "a square-tiled surface of genus 2, the first of the paper"),
    "omega_2": ("omega_2.json", "a square-tiled surface of genus 2, the second of the paper"),
    "omega_3": ("omega_3.json", "a square-tiled surface of genus 2, the third of the paper"),
}

# In an installed package, and in a checkout.
_FOLDERS = (Path(__file__).parents[1] / "data", Path(__file__).parents[2] / "data")


def sample_files() -> dict[str, Path]:
    """The files of the surfaces for a first try, by their names.

    ``.off`` and ``.obj`` are meshes; ``.json`` are triangles glued along their sides, the
    arguments of :meth:`DeltaComplex.from_gluing`.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F, _ = ip.load_mesh(ip.sample_files()["lawson_2_1"])
    >>> ip.period_matrix(V, F).genus
    2
    """
    folder = next(folder for folder in _FOLDERS if folder.is_dir())
    return {name: folder / file for name, (file, _) in SAMPLES.items()}
