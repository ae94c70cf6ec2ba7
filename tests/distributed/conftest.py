"""The same surfaces on several ranks and on one machine."""

import pickle

import pytest
from support import distributed_runs
from support.distributed_runs import OPTIONS, SURFACES
from support.mpi_processes import mpiexec

import igl_periods as ip


@pytest.fixture(scope="session")
def runs(tmp_path_factory):
    """What each rank got of ``distributed_runs.py`` on n ranks, run once for each n."""
    cache = {}

    def run(n):
        if n not in cache:
            path = tmp_path_factory.mktemp("ranks") / f"{n}.pickle"
            done = mpiexec(n, distributed_runs.__file__, path)
            assert done.returncode == 0, done.stderr
            cache[n] = pickle.loads(path.read_bytes())
        return cache[n]

    return run


@pytest.fixture(scope="session")
def alone():
    """The same on one machine, without MPI."""
    return {
        (name, how): ip.period_matrix(K, delaunay=how != "no flips")
        for name, K in SURFACES.items()
        for how in OPTIONS
    }
