"""Python on several ranks, and a communicator of one."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]
# Open MPI starts nothing as root, and no more ranks than there are cores, unless told to.
MPI_ENVIRONMENT = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
}


def mpiexec(n, *arguments):
    """Run Python on n ranks; skip where there is no PETSc or no MPI."""
    if not (
        importlib.util.find_spec("petsc4py")
        and importlib.util.find_spec("mpi4py")
        and shutil.which("mpiexec")
    ):
        pytest.skip("mpi4py, petsc4py or mpiexec is missing: scripts/setup --distributed")
    return subprocess.run(
        ["mpiexec", "-n", str(n), sys.executable, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=300,
        env=os.environ | MPI_ENVIRONMENT | {"PYTHONPATH": _with_tests()},
        check=False,
    )


def _with_tests():
    """The path of modules on which the tests find their helpers."""
    return os.pathsep.join(filter(None, [str(TESTS), os.environ.get("PYTHONPATH")]))


class OneRank:
    """A communicator of rank 0 alone."""

    rank, size = 0, 1

    @staticmethod
    def bcast(value):
        return value

    @staticmethod
    def allgather(value):
        return [value]

    @staticmethod
    def Barrier():  # noqa: N802  (MPI's name)
        pass
