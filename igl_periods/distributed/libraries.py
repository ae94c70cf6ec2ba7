"""MPI and PETSc, imported when they are used and not before: they are an extra."""

from __future__ import annotations

from types import ModuleType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm


_MISSING = (
    "igl_periods.distributed needs mpi4py and petsc4py, and {name} cannot be imported ({error}). "
    "Run scripts/setup --distributed, or install an MPI with its compiler mpicc and then "
    '`pip install "igl_periods[distributed]"`, which builds PETSc.'
)


def world() -> Intracomm:
    """All ranks that mpiexec has started.

    Raises
    ------
    ImportError
        If mpi4py is missing, or finds no MPI.
    """
    try:
        from mpi4py import MPI
    # Without a library of MPI the import is a RuntimeError.
    except (ImportError, RuntimeError) as error:
        raise ImportError(_MISSING.format(name="mpi4py", error=error)) from error
    return MPI.COMM_WORLD


def load_petsc() -> ModuleType:
    """The module ``petsc4py.PETSc``; its options are those of the variable PETSC_OPTIONS.

    Raises
    ------
    ImportError
        If petsc4py is missing.
    """
    try:
        from petsc4py import PETSc
    except ImportError as error:
        raise ImportError(_MISSING.format(name="petsc4py", error=error)) from error
    return PETSc
