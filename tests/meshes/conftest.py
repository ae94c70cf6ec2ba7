"""Meshes of the folder of meshes made by others, loaded once."""

import functools

import pytest

from igl_periods.meshes.load import load_mesh


@pytest.fixture(scope="session")
def load(meshes):
    """load_mesh of a mesh of the folder, done once."""
    return functools.cache(lambda name, repair=False: load_mesh(meshes / name, repair=repair))
