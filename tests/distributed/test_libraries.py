"""MPI and PETSc are named where they are missing, and imported when needed."""

import subprocess
import sys

import pytest

from igl_periods.distributed.libraries import load_petsc, world


@pytest.mark.parametrize(
    ("load", "module", "name"), [(world, "mpi4py", "mpi4py"), (load_petsc, "petsc4py", "petsc4py")]
)
def test_missing_libraries_are_named(monkeypatch, load, module, name):
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(ImportError, match=rf"{name} cannot be imported.*setup --distributed") as no:
        load()
    assert 'pip install "igl_periods[distributed]"' in str(no.value)


def test_neither_library_is_imported_with_the_package():
    code = (
        "import sys, igl_periods, igl_periods.distributed; "
        "assert not {'mpi4py', 'petsc4py'} & set(sys.modules)"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
