"""Meshes made by others, from the folder named by IGL_PERIODS_MESHES; surfaces computed once."""

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import flint
import igl
import numpy as np
import pytest
from support.parametrized_surfaces import EMPTY, genus_three, genus_two
from support.random_surfaces import BOLZA, noisy_torus, torus_of_revolution

import igl_periods as ip
from igl_periods.complexes.midpoint_subdivision import split


@pytest.fixture(autouse=True)
def default_precision() -> Iterator[None]:
    """Each test starts at the default precision of python-flint, whatever others have set."""
    flint.ctx.prec = 53
    yield
    flint.ctx.prec = 53


@pytest.fixture(scope="session")
def meshes() -> Path:
    """The folder of meshes made by others, or a skip where there is none."""
    folder = os.environ.get("IGL_PERIODS_MESHES")
    if not folder:
        pytest.skip("IGL_PERIODS_MESHES names no folder of meshes")
    return Path(folder)


@pytest.fixture(scope="session")
def mesh(meshes: Path) -> Callable[[str], tuple[np.ndarray, np.ndarray]]:
    """V, F of a mesh of that folder, exactly as stored."""
    return lambda name: igl.read_triangle_mesh(meshes / name)


@pytest.fixture(scope="session")
def computed(mesh) -> Callable[[str], ip.PeriodMatrix]:
    """The period matrix of a mesh of that folder, computed once."""
    cache: dict[str, ip.PeriodMatrix] = {}

    def compute(name: str) -> ip.PeriodMatrix:
        if name not in cache:
            cache[name] = ip.period_matrix(*mesh(name))
        return cache[name]

    return compute


@pytest.fixture(scope="session")
def surfaces():
    complexes = {
        "noisy torus": ip.DeltaComplex.from_mesh(*noisy_torus(9, 7, 0.15, 3)),
        "torus of revolution": ip.DeltaComplex.from_mesh(*torus_of_revolution(2.0, 0.7, 20, 12)),
        "genus 2": genus_two(),
        "genus 3": genus_three(),
        # Glued squares make a simplicial complex after two divisions.
        "squares": split(*split(ip.DeltaComplex.from_squares(BOLZA, 1), EMPTY))[0],
    }
    return {name: ip.period_matrix(K).reduced() for name, K in complexes.items()}
