"""Two workers whose habits are known: files named so kill them, or take their time."""

import dask
import pytest

from igl_periods.batch import local_cluster

# What the workers of these tests load: files whose name says so kill them, or take their time.
HABITS = """
import os, time
from igl_periods.meshes import surface_files
from igl_periods.batch import rows as batch_rows

def read_surface(path, **how):
    if "poison" in str(path):
        os.kill(os.getpid(), 9)
    if "slow" in str(path):
        time.sleep(0.1)
    return surface_files.read_surface(path, **how)

batch_rows.read_surface = read_surface
"""


@pytest.fixture(scope="module")
def habits(tmp_path_factory):
    path = tmp_path_factory.mktemp("habits") / "habits.py"
    path.write_text(HABITS)
    return path


@pytest.fixture(scope="module")
def cluster(habits):
    """Two workers, started once."""
    with dask.config.set({"distributed.worker.preload": [str(habits)]}), local_cluster(2) as client:
        yield client


@pytest.fixture
def address(cluster):
    return cluster.scheduler.address
