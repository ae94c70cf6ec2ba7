r"""From a surface to its period matrix in balls: the steps, one after the other.

    K ─ homology ▶ cochains ─ exact lengths, Delaunay moves ▶ triangulation ─ cut ▶ cells
      ─ degrees ▶ trial functions ─ least squares, refinement ▶ series
      ─ conforming forms, quadrature ▶ D in balls ─ Siegel point ▶ Π in balls

The last two steps prove, whatever came before.  If they prove less than was asked for, the goal of
the steps before is raised by what is missing, and they run again.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import partial
from numbers import Real

import flint
import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, ExactLengths, MarkedComplex
from igl_periods.errors import ComplexError
from igl_periods.periods import ToleranceWarning
from igl_periods.proofs import orthonormal_combination
from igl_periods.run_log import logger, stage
from igl_periods.topology import cochains_and_basis

from .cells import Cells, cells_of
from .conforming_forms import dirichlet_enclosure
from .delaunay_moves import improve_shapes, insert_centres, make_delaunay
from .enclosure import PeriodEnclosure
from .exact_lengths import checked_balls
from .float_energies import float_dirichlet_enclosure
from .float_traces import coefficients_in_floats
from .limits import Limits
from .refinement import Refined, precision_of
from .stages import STALLED, Stages
from .surface_choice import surface_and_lengths
from .triangulation import Triangulation
from .upper_energies import canonical_in_forms, linear_upper_energies, upper_energies

MOST_DIGITS = 1000
"""More digits than this are refused: they would take days."""

# Bits of the working precision that shapes need not have.
_GUARD_BITS = 48
_MOST_BITS = 100_000
# Digits by which quadrature is to be more accurate than the result.
_QUADRATURE_DIGITS = 8
# So many digits, at most, are tried in double precision; radii of energies by which they would be
# wrong are negligible if they are this much smaller.
_DIGITS_IN_FLOATS, _NEGLIGIBLE = 13, 0.2
# A proof that is worse than expected is tried again, so often in all.
_MOST_PROOFS = 3
_LOG_10 = float(np.log(10.0))
# Triangles with a circumradius above so many shortest sides are divided.
_RATIO, _RATIO_FOR_FEW_DIGITS = 2.0, 4.0


def enclose(
    surface: DeltaComplex | ArrayLike,
    F: ArrayLike | None = None,
    *,
    digits: int = 30,
    max_seconds: float | None = None,
    max_memory: float | None = None,
) -> PeriodEnclosure:
    """Compute a period matrix in balls that provably contain the exact one.

    Parameters
    ----------
    surface : (n, d) array-like or DeltaComplex
        Positions V of a triangle mesh, or a complex.  Positions are exact as they are stored, also
        integers and fractions, and lengths are the square roots of sums of squares of their
        differences.  A complex that carries ``exact_lengths`` has those; otherwise the stored
        doubles are the lengths, exactly.
    F : (m, 3) array-like of int, optional
        Corners of the triangles, with V.
    digits : int
        Wanted decimal digits of all entries Π_ij, relative to √(Y_ii Y_jj).
    max_seconds : float, optional
        Begin nothing that would probably end later than this, and give up what does.
    max_memory : float, optional
        Bytes that the computation may take; by default what is available.

    Returns
    -------
    PeriodEnclosure
        Of genus 0: a 0 × 0 matrix.

    Raises
    ------
    MeshError
        If V and F are not a triangulated surface.
    ComplexError
        If the surface is not closed, oriented and connected, or a triangle is so flat that its
        lengths do not determine it.
    MemoryLimitError
        If even the first stage takes more memory than there is.
    ValueError
        If ``digits`` is not a whole number from 1 to 1000, or a limit is not positive.

    Warns
    -----
    ToleranceWarning
        If fewer digits were proved than wanted.  The result is the best one that was proved.

    Examples
    --------
    >>> from igl_periods import DeltaComplex
    >>> torus = DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))])
    >>> enclose(torus, digits=20).reduced().contains([[1j]])
    True
    """
    _check_options(digits, max_seconds, max_memory)
    limits = Limits(max_seconds, max_memory)
    K, lengths = surface_and_lengths(surface, F)
    with stage("homology"):
        cochains, T = cochains_and_basis(K)
    if cochains.shape[0] == 0:
        return PeriodEnclosure(flint.arb_mat(0, 0), cochains, K, precision_of(digits))
    with stage("stars and faces"):
        triangulation, cells = _cut(K, lengths, cochains, digits)
    marking = csr_array(csr_array(T.astype(np.int64)) @ cochains)

    def prove(solution: Refined) -> PeriodEnclosure:
        with stage("energies in balls"), flint.ctx.workprec(precision_of(digits)):
            D = _energies(triangulation, solution, T.astype(np.int64), digits)
        return PeriodEnclosure(D, marking, K, precision_of(digits))

    def prove_less() -> PeriodEnclosure:
        with stage("forms that are linear on triangles"), flint.ctx.workprec(precision_of(digits)):
            D = linear_upper_energies(MarkedComplex(K, cochains, T), lengths)
        return PeriodEnclosure(D, marking, K, precision_of(digits))

    best, reason = _best_enclosure(Stages(cells, digits, limits), prove, digits, limits)
    if best is None:
        best = prove_less()
    if best.digits < digits:
        warnings.warn(
            f"{best.digits} digits are proved, {digits} were asked for: {reason}.",
            ToleranceWarning,
            stacklevel=2,
        )
    return best


def _cut(
    K: DeltaComplex, lengths: ExactLengths, cochains: csr_array, digits: int
) -> tuple[Triangulation, Cells]:
    """The cells of a good triangulation, known well enough."""
    # Where coefficients of series are large, as many bits again may cancel.
    wanted = 2 * precision_of(digits)
    bits = wanted
    while True:
        with flint.ctx.workprec(bits):
            triangulation = Triangulation.of(K, checked_balls(lengths, K, bits), cochains)
            make_delaunay(triangulation)
            insert_centres(triangulation)
            few = digits <= _DIGITS_IN_FLOATS
            improve_shapes(triangulation, _RATIO_FOR_FEW_DIGITS if few else _RATIO)
            cells = cells_of(triangulation)
        missing = wanted - _GUARD_BITS - cells.accuracy_in_bits()
        if missing <= 0:
            return triangulation, cells
        if 2 * bits > _MOST_BITS:
            raise ComplexError(
                f"with {bits} bits the shape of a cell is known to {cells.accuracy_in_bits()} bits "
                "only: exact_lengths gives balls that do not shrink, or a triangle is degenerate."
            )
        bits += max(missing, bits // 2)


def _best_enclosure(
    stages: Stages, prove: Callable[[Refined], PeriodEnclosure], digits: int, limits: Limits
) -> tuple[PeriodEnclosure | None, str]:
    """Solve in stages and prove; again with a higher goal as long as digits are missing.

    The result is the best that was proved, None if that is nothing, and why it is not better.
    """
    best: PeriodEnclosure | None = None
    for _ in range(_MOST_PROOFS):
        solution = stages.solve()
        if solution is None:
            break
        try:
            found = limits.proved(partial(prove, solution))
            proved = _proved(found) if found is not None else 0.0
        except ComplexError as error:
            return best, f"nothing more can be proved ({error})"
        if found is None:
            return best, limits.out_of_time()
        if best is not None and not found.bound < best.bound:
            break
        best = found
        if proved >= digits:
            return best, ""
        if stages.reason:
            break
        logger.info("%.2f digits proved", proved)
        stages.ask_for_more(proved)
    return best, stages.reason or STALLED


def _energies(surface: Triangulation, solution: Refined, basis: Ints, digits: int) -> flint.arb_mat:
    """Upper bounds of energies: in double precision where few digits are wanted."""
    accuracy = digits + _QUADRATURE_DIGITS
    if digits <= _DIGITS_IN_FLOATS:
        try:
            E, W = _energies_in_floats(surface, solution, -_LOG_10 * accuracy)
        except ComplexError as error:
            logger.info("not in double precision: %s", error)
        else:
            radius = max(float(x.rad()) for x in E.entries())
            if radius * E.nrows() < _NEGLIGIBLE * 10.0**-digits:
                return upper_energies(E, canonical_in_forms(basis, W))
            logger.info("double precision leaves energies unknown by %.2g", radius)
    with flint.ctx.workprec(precision_of(digits) + solution.series.excess_bits):
        E = dirichlet_enclosure(surface, solution.series, -_LOG_10 * accuracy)
    return upper_energies(E, flint.arb_mat(basis.tolist()))


def _energies_in_floats(
    surface: Triangulation, solution: Refined, accuracy: float
) -> tuple[flint.arb_mat, Floats]:
    """Energies of nearly orthonormal forms, in classes W c, and W."""
    trial = solution.problem.trial
    cells = trial.nodes.cells
    D = solution.approximate_energies()
    if not np.isfinite(D).all():
        raise ComplexError("the coefficients of the series are not finite.")
    W = orthonormal_combination(D, csr_array(cells.jumps))
    newton = [a @ W.T for a in solution.newton]
    coefficients = coefficients_in_floats(trial, newton)
    return float_dirichlet_enclosure(surface, cells, coefficients, accuracy, W), W


def _proved(found: PeriodEnclosure) -> float:
    """Proved digits, with fractions; nothing is proved where they are negative."""
    if found.bound == 0:
        return float(found.digits)
    if not found.bound < 1:
        raise ComplexError("the energies are known too badly for a period matrix.")
    with flint.ctx.workprec(64):
        return -float(found.bound.log().mid()) / _LOG_10


def _check_options(digits: int, max_seconds: float | None, max_memory: float | None) -> None:
    if not (isinstance(digits, Real) and float(digits).is_integer() and 1 <= digits <= MOST_DIGITS):
        raise ValueError(f"digits = {digits}: a whole number from 1 to {MOST_DIGITS} is wanted.")
    for name, limit in (("max_seconds", max_seconds), ("max_memory", max_memory)):
        if limit is not None and not limit > 0:
            raise ValueError(f"{name} = {limit}: a limit is positive.")
