r"""Harmonic potentials by conjugate gradients, preconditioned by algebraic multigrid.

The Laplacian of the surface is the sum of the Laplacians of its parts: each rank hands its own to
PETSc, in its own numbering, and PETSc adds them up where parts meet.  On an intrinsic Delaunay
triangulation it is an M-matrix, for which smoothed aggregation is made; the hierarchy is set up
once and serves all 2g right-hand sides.  Couplings below 5 % of the diagonal are dropped when
vertices are aggregated: the slivers that marching cubes leave then cost half as many iterations.

Constants are harmonic, so that the Laplacian is singular.  PETSc is told so.  The equations are
solvable, since what flows out of one vertex flows into others, and conjugate gradients converge
as if the constants were not there.  Grounding a vertex, as a factorisation needs it, takes the
same number of iterations, and would single out one rank.

Conjugate gradients minimise the energy of the error over their Krylov space, and that energy is
just what D then has too much:

.. math:: D(f)_{jj} - D(f^*)_{jj} = (f_j - f_j^*)^T L\, (f_j - f_j^*) .

They stop when the residual, in the norm of the preconditioner, which is close to that of the
energy, has fallen by the factor ``rtol``.  So an energy ends up too large by about rtol² times
the energy of the raw cochain.

References
----------
Vaněk, Mandel, Brezina, "Algebraic multigrid by smoothed aggregation for second and fourth order
elliptic problems" (1996).
Balay et al., "PETSc/TAO Users Manual".
"""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats
from igl_periods.complexes import cotan_weights, edge_ends
from igl_periods.harmonic import laplacian, outflow
from igl_periods.periods import ToleranceWarning
from igl_periods.run_log import logger, stage

from .collective import on_every_rank, on_root
from .libraries import load_petsc
from .partition import Part

if TYPE_CHECKING:
    from mpi4py.MPI import Intracomm
    from petsc4py.PETSc import KSP, Mat


_PREFIX = "igl_periods_"
_THRESHOLD = "pc_gamg_threshold"
_WEAK = 0.05
# Where a raw cochain is harmonic already there is nothing to solve, and its residual is rounding;
# energies of integer classes, the squares of this norm, are larger by far.
_NOTHING = 1e-14


def harmonic_potentials(comm: Intracomm, part: Part, rtol: float, max_iterations: int) -> Floats:
    """The functions f for which the cochains c + df are nearly harmonic, on the part of each rank.

    Collective.

    Parameters
    ----------
    part : Part
    rtol : float
        How far the residuals fall, in the norm of the preconditioner.
    max_iterations : int
        For each cochain.

    Returns
    -------
    (n_vertices, k) float
        At the vertices of ``part.complex``, ghosts included.  All ranks have the same value at a
        vertex: so the forms c + df fit together, whatever the solver did.
    """
    K, k = part.complex, part.cochains.shape[0]
    potentials = np.zeros((K.n_vertices, k))
    if k == 0 or comm.allreduce(part.n_owned) == 1:
        return potentials
    petsc = load_petsc()
    weights, (tail, head) = on_every_rank(comm, lambda: (cotan_weights(K), edge_ends(K)))
    with stage("multigrid"):
        solver = _solver(_summed_laplacian(comm, part, weights), rtol, max_iterations)
    ghosts = _integers(K.labels[part.n_owned :])
    f = petsc.Vec().createGhost(ghosts, (part.n_owned, petsc.DETERMINE), comm=comm)
    flux = f.duplicate()
    unsolved = 0
    with stage("harmonic forms"):
        for j in range(k):
            with flux.localForm() as local:
                flow = outflow(K.n_vertices, tail, head, weights, part.cochains[[j]])
                local.array[:] = flow.toarray()[:, 0]
            flux.ghostUpdate(petsc.InsertMode.ADD, petsc.ScatterMode.REVERSE)
            solver.solve(flux, f)
            unsolved += solver.getConvergedReason() <= 0
            _log(solver, j, k)
            f.ghostUpdate(petsc.InsertMode.INSERT, petsc.ScatterMode.FORWARD)
            with f.localForm() as local:
                potentials[:, j] = local.array
    if unsolved:
        # A filter of warnings may make it an error, which has to be everyone's.
        on_root(comm, lambda: _warn(unsolved, k, rtol, max_iterations))
    return potentials


def _summed_laplacian(comm: Intracomm, part: Part, weights: Floats) -> Mat:
    """The sum of the Laplacians of all parts, its rows where their vertices are owned."""
    petsc = load_petsc()
    summand = on_every_rank(comm, lambda: laplacian(part.complex, weights).tocsr())
    own = petsc.Mat().createAIJ(
        summand.shape,
        csr=(_integers(summand.indptr), _integers(summand.indices), summand.data),
        comm=petsc.COMM_SELF,
    )
    numbers = petsc.LGMap().create(_integers(part.complex.labels), comm=comm)
    owned = (part.n_owned, petsc.DETERMINE)
    L = petsc.Mat().createIS((owned, owned), lgmapr=numbers, lgmapc=numbers, comm=comm)
    L.setISLocalMat(own)
    L.assemble()
    return L.convert(petsc.Mat.Type.AIJ)


def _solver(L: Mat, rtol: float, max_iterations: int) -> KSP:
    """Conjugate gradients for a Laplacian; options of PETSc are taken with the prefix."""
    petsc = load_petsc()
    L.setNullSpace(petsc.NullSpace().create(constant=True, comm=L.comm))
    options = petsc.Options(_PREFIX)
    if not options.hasName(_THRESHOLD):
        options.setValue(_THRESHOLD, _WEAK)
    solver = petsc.KSP().create(L.comm)
    solver.setOptionsPrefix(_PREFIX)
    solver.setOperators(L)
    solver.setType(petsc.KSP.Type.CG)
    solver.setNormType(petsc.KSP.NormType.NATURAL)
    solver.setTolerances(rtol=rtol, atol=_NOTHING, max_it=max_iterations)
    solver.getPC().setType(petsc.PC.Type.GAMG)
    solver.setFromOptions()
    solver.setUp()
    return solver


def _integers(indices: NDArray[np.integer]) -> NDArray[np.integer]:
    return indices.astype(load_petsc().IntType)


def _log(solver: KSP, j: int, k: int) -> None:
    n = solver.getIterationNumber()
    logger.info("form %d of %d: %d iterations", j + 1, k, n, extra={"iterations": n})


def _warn(n_unsolved: int, k: int, rtol: float, max_iterations: int) -> None:
    warnings.warn(
        f"{n_unsolved} of {k} forms are not harmonic to rtol = {rtol:g} after {max_iterations} "
        "iterations at most. The bound is true all the same, only larger. Allow more iterations "
        "(max_iterations), or look for extreme triangles (mesh_quality).",
        ToleranceWarning,
        stacklevel=6,
    )
