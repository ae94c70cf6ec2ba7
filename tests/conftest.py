"""Meshes made by others, from the folder named by IGL_PERIODS_MESHES."""

import os
from collections.abc import Callable
from pathlib import Path

import igl
import numpy as np
import pytest

import igl_periods as ip


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
