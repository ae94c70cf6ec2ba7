"""From a surface on rank 0 to its period matrix there, solved and summed on all ranks."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from igl_periods.arrays import Floats
from igl_periods.complexes import (
    DeltaComplex,
    MarkedComplex,
    as_complex,
)
from igl_periods.harmonic import allowance_for_loss, dirichlet_matrix, extreme_sensitivity
from igl_periods.machine import release_freed_memory
from igl_periods.periods import PeriodMatrix, certified_period_matrix
from igl_periods.run_log import stage
from igl_periods.topology import mark

from .collective import on_every_rank, on_root, scatter
from .flips import delaunay_on_all_ranks
from .libraries import load_petsc, world
from .partition import Part, Partition
from .pieces import Piece
from .potentials import harmonic_potentials

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm


def period_matrix(
    surface: DeltaComplex | ArrayLike | None = None,
    F: ArrayLike | None = None,
    *,
    comm: Intracomm | None = None,
    delaunay: bool = True,
    rtol: float = 1e-8,
    max_iterations: int = 1_000,
) -> PeriodMatrix | None:
    """Compute the period matrix of one surface on all ranks of a communicator.

    Collective: every rank calls it, with the same options.

    Parameters
    ----------
    surface, F
        The surface, as in :func:`igl_periods.period_matrix`.  Only those of rank 0 are used; the
        other ranks leave them out.
    comm : mpi4py.MPI.Intracomm, optional
        All ranks that mpiexec has started, by default.
    delaunay : bool
        Make the triangulation intrinsically Delaunay first.
    rtol : float
        How far the residual of each solution falls, in the norm of the preconditioner.  The
        energies are too large by about rtol² times those of the raw cochains, which the bound
        contains whatever it comes to.
    max_iterations : int
        Stop each solution after so many iterations at the latest.

    Returns
    -------
    PeriodMatrix or None
        On rank 0 the same as :func:`igl_periods.period_matrix` returns, with a bound that is
        certified whatever the solver did; None on the others.

    Raises
    ------
    MeshError, ComplexError
        As :func:`igl_periods.period_matrix`; on every rank.
    ValueError
        If rtol is not between 0 and 1, or max_iterations less than 1.
    ImportError
        If mpi4py or petsc4py are missing.

    Warns
    -----
    ToleranceWarning
        On rank 0, if some solutions ended before their residual had fallen by rtol.
    """
    if not 0.0 < rtol < 1.0:
        raise ValueError(f"rtol = {rtol}: residuals fall by a factor between 0 and 1, as 1e-8.")
    if max_iterations < 1:
        raise ValueError(f"max_iterations = {max_iterations}: one iteration is the least.")
    if comm is None:
        comm = world()
    load_petsc()  # now, and not after all the work of rank 0
    marked, part = _distributed(comm, surface, F, delaunay)
    potentials = harmonic_potentials(comm, part, rtol, max_iterations)
    with stage("energies"):
        D, loss = _energies(comm, part, potentials)

    def certify() -> PeriodMatrix:
        assert marked is not None and D is not None and loss is not None, "rank 0 has them"
        allowance = allowance_for_loss(D, loss)
        return certified_period_matrix(marked, D, allowance)

    return on_root(comm, certify)


def _distributed(
    comm: Intracomm, surface: Any, F: ArrayLike | None, delaunay: bool
) -> tuple[MarkedComplex | None, Part]:
    """The marked surface on rank 0, and the part of each rank after flips on all."""
    marked, piece, owned = _scattered(comm, surface, F)
    if delaunay:
        with stage("Delaunay flips"):
            piece = delaunay_on_all_ranks(comm, piece)
    return marked, on_every_rank(comm, lambda: Part.of(piece, *owned))


def _scattered(
    comm: Intracomm, surface: Any, F: ArrayLike | None
) -> tuple[MarkedComplex | None, Piece, tuple[int, int]]:
    """Mark the surface and divide it, on rank 0; the faces of each rank, and the places it owns."""

    def divide() -> tuple[MarkedComplex, Partition]:
        K = as_complex(surface, F)
        with stage("homology"):
            given = mark(K)
        with stage("partition"):
            return given, Partition.of(given.complex, given.cochains, comm.size)

    # The partition ends with this function: the pieces are all that is needed of it.
    marked, partition = on_root(comm, divide) or (None, None)
    release_freed_memory()
    with stage("scattering"):
        return marked, *scatter(comm, partition.share if partition else None)


def _energies(
    comm: Intracomm, part: Part, potentials: Floats
) -> tuple[Floats | None, Floats | None]:
    """Dirichlet matrix, and what rounding of extreme triangles can change in it; on rank 0.

    Each is a sum over faces: of the blocks of faces of each rank, and then of the ranks.  One
    machine adds up at least as many terms one after the other for the same surface; so the same
    allowance covers the rounding of the sum.
    """

    def of_part() -> tuple[Floats, Floats]:
        energies = partial(dirichlet_matrix, part.complex, part.cochains, potentials)
        return energies(), energies(extreme_sensitivity(part.complex))

    D, loss = on_every_rank(comm, of_part)
    return comm.reduce(D), comm.reduce(loss)
