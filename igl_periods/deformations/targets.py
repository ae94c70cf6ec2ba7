"""Deform a surface until it has a given period matrix: vertices, or lengths; also along a path."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Ints
from igl_periods.complexes import DeltaComplex, MarkedComplex, as_complex
from igl_periods.errors import ComplexError
from igl_periods.moduli import nearest_marking
from igl_periods.options import checked_integer, checked_number, checked_switch
from igl_periods.periods import PeriodMatrix, certified_period_matrix, checked_options, solve_forms
from igl_periods.run_log import logger, stage
from igl_periods.siegel import check_siegel_point, siegel_distance, siegel_transform
from igl_periods.topology import mark

from .charts import Chart, LengthChart, VertexChart
from .gauss_newton import GaussNewton, moduli
from .relaxation import Relaxation
from .results import Deformation, DeformationWarning, Step

_TOLERANCE = 1e-10
_MOST_STEPS = 200
_SMOOTHING = 1.0
# Linear functions lead to within this distance, before functions of high degree go on.
_COARSE = 1e-6
# Surfaces of more faces do not repel themselves: it takes the square of their number.
_MOST_REPELLING = 6_000


def deform_to(
    V: ArrayLike | DeltaComplex,
    F: ArrayLike | None,
    target: ArrayLike,
    *,
    basis: ArrayLike | None = None,
    smoothing: float = _SMOOTHING,
    embedded: bool = False,
    degree: int = 1,
    keep_marking: bool = False,
    tolerance: float = _TOLERANCE,
    max_steps: int = _MOST_STEPS,
) -> Deformation:
    r"""Move the vertices of a mesh until the surface has a given period matrix.

    Every step is the shortest one in the norm :math:`\int |dX|^2 / A + s^2 \int |\nabla dX|^2`.

    Parameters
    ----------
    V, F
        The mesh; or a ``DeltaComplex`` with positions, and None.
    target : (g, g) array-like or PeriodMatrix
    basis : (n_vertices, k) array-like, optional
        Functions on the vertices, such as :func:`smooth_functions` makes: every coordinate moves
        by a combination of them.  Without it every vertex moves freely.
    smoothing : float
        The s of the norm; it has no unit.  0 is the mass norm, in which small changes are the
        nearest, and big ones make ripples.
    embedded : bool
        Make no step after which the surface passes through itself.  Where that does not lead to the
        target, the way is gone again with a surface that repels itself, if it has no more than
        6,000 faces.  That takes minutes, and comes nearer without always arriving.
    degree : int
        Of the trial functions.  From degree 2 on the exact matrix of the polyhedral surface comes
        as near to the target as ``certified_distance`` says.
    keep_marking : bool
        Reach the target in the marking of ``period_matrix(V, F)``.  By default the marking is
        chosen in which it is nearest, and kept from there on.
    tolerance : float
        Siegel distance at which the target counts as reached.
    max_steps : int

    Returns
    -------
    Deformation

    Raises
    ------
    MeshError, ComplexError
        As :func:`period_matrix`; and if the genus is 0, or there are no positions.
    NotASiegelPointError
        If the target is not a point of the Siegel upper half-space.
    ValueError
        If it has another genus, the basis another shape, the tolerance is not positive, or the
        surface is to stay embedded and is not.

    Warns
    -----
    DeformationWarning
        If the target is not reached.  The result is the nearest surface that was found, and its
        ``verdict`` says why.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> found = ip.deform_to(V, F, [[1.8j]])
    >>> found.reached, bool(found.distance < 1e-9)
    (True, True)
    """
    K = as_complex(V, F)
    chart = VertexChart.of(K, basis, smoothing, embedded)
    return _deformed(chart, K, target, degree, keep_marking, tolerance, max_steps)


def lengths_with(
    K: DeltaComplex,
    target: ArrayLike,
    *,
    degree: int = 1,
    keep_marking: bool = False,
    tolerance: float = _TOLERANCE,
    max_steps: int = _MOST_STEPS,
) -> Deformation:
    """Change the lengths of the edges of a surface until it has a given period matrix.

    Every step is the one of least strain ε of the metric, ∫ tr ε²; triangle inequalities stay
    strict.

    Parameters, Returns, Raises, Warns
        As :func:`deform_to`; no positions are needed, and the result has none.

    Examples
    --------
    >>> import igl_periods as ip
    >>> ip.lengths_with(ip.surfaces.flat_torus(1j, 3), [[1.1j]]).reached
    True
    """
    return _deformed(LengthChart(K), K, target, degree, keep_marking, tolerance, max_steps)


def deform_along(
    V: ArrayLike | DeltaComplex,
    F: ArrayLike | None,
    path: Sequence[ArrayLike] | ArrayLike,
    *,
    basis: ArrayLike | None = None,
    smoothing: float = _SMOOTHING,
    embedded: bool = False,
    tolerance: float = _TOLERANCE,
) -> list[Deformation]:
    """Follow a path of period matrices with the vertices of a mesh: a deformation for each.

    Parameters
    ----------
    V, F, basis, smoothing, embedded, tolerance
        As in :func:`deform_to`.
    path : (n, g, g) array-like
        In the marking of ``period_matrix(V, F)``, such as :func:`moduli_path` makes it.

    Returns
    -------
    list of Deformation
        One for each point, each starting at the one before; it ends with the first point that is
        not reached.

    Raises, Warns
        As :func:`deform_to`.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> Pi = ip.period_matrix(V, F).matrix
    >>> path = ip.moduli_path(Pi, 1.1 * Pi, 3)
    >>> [found.reached for found in ip.deform_along(V, F, path)]
    [True, True, True]
    """
    K = as_complex(V, F)
    chart = VertexChart.of(K, basis, smoothing, embedded)
    return _followed(chart, K, path, tolerance)


def lengths_along(
    K: DeltaComplex, path: Sequence[ArrayLike] | ArrayLike, *, tolerance: float = _TOLERANCE
) -> list[Deformation]:
    """Follow a path of period matrices with the lengths of a surface; see :func:`deform_along`.

    Examples
    --------
    >>> import igl_periods as ip
    >>> K = ip.surfaces.flat_torus(1j, 3)
    >>> path = ip.moduli_path(ip.period_matrix(K).matrix, [[1.1j]], 3)
    >>> [found.reached for found in ip.lengths_along(K, path)]
    [True, True, True]
    """
    return _followed(LengthChart(K), K, path, tolerance)


def _deformed(
    chart: Chart,
    K: DeltaComplex,
    target: ArrayLike,
    degree: int,
    keep_marking: bool,
    tolerance: float,
    max_steps: int,
) -> Deformation:
    degree, tolerance = checked_options("intrinsic", degree, None)[0], _checked_tolerance(tolerance)
    max_steps = checked_integer("max_steps", max_steps)
    given = _marked(K)
    point = _checked_target(target, given)
    start = _computed(given, 1, K)
    gamma = np.eye(2 * start.genus, dtype=np.int64)
    if not checked_switch("keep_marking", keep_marking):
        point, gamma = _nearest(point, start)
    charts = [chart]
    if isinstance(chart, VertexChart) and chart.embedded and K.n_faces <= _MOST_REPELLING:
        charts.append(chart.repelling())
    ends = []
    for one in charts:
        ends.append(_gone(given, one, point, degree, tolerance, max_steps))
        if not ends[-1][2]:
            break
    best = min(ends, key=lambda end: siegel_distance(end[0].matrix, point))
    return _result(best[0], point, gamma, *best[1:])


def _gone(
    given: MarkedComplex,
    chart: Chart,
    point: Complexes,
    degree: int,
    tolerance: float,
    max_steps: int,
) -> tuple[PeriodMatrix, tuple[Step, ...], str]:
    """The whole way, with linear functions first; the matrix at its end, the steps, the verdict."""
    x = chart.start()
    degrees = [(1, tolerance)]
    if degree > 1:
        degrees = [(1, max(_COARSE, tolerance)), (degree, tolerance)]
    steps: list[Step] = []
    for p, within in degrees:
        search = _search(given, chart, p, point)
        x, pm, more, verdict = search.run(x, within, max_steps)
        steps += more
        if verdict:
            break
    return pm, tuple(steps), verdict


def _search(given: MarkedComplex, chart: Chart, degree: int, point: Complexes) -> GaussNewton:
    compute = partial(_computed, given, degree)
    relaxation = None
    if isinstance(chart, VertexChart) and chart.repulsion is not None:
        relaxation = Relaxation(chart, compute, moduli(len(point)))
    return GaussNewton(chart, compute, point, relaxation)


def _followed(
    chart: Chart, K: DeltaComplex, path: Sequence[ArrayLike] | ArrayLike, tolerance: float
) -> list[Deformation]:
    tolerance = _checked_tolerance(tolerance)
    given = _marked(K)
    points = [_checked_target(point, given) for point in np.asarray(path)]
    x, results = chart.start(), list[Deformation]()
    compute = partial(_computed, given, 1)
    gamma = np.eye(given.rank, dtype=np.int64)
    for k, point in enumerate(points):
        with stage(f"point {k + 1} of {len(points)} of the path"):
            search = GaussNewton(chart, compute, point)
            x, pm, steps, verdict = search.run(x, tolerance, _MOST_STEPS)
        results.append(_result(pm, point, gamma, steps, verdict))
        if verdict:
            break
    return results


def _computed(given: MarkedComplex, degree: int, K: DeltaComplex) -> PeriodMatrix:
    """The period matrix of the given triangulation with the lengths of K, with its forms."""
    moved = replace(given, complex=K)
    forms, raw, allowance = solve_forms(moved, degree=degree)
    return certified_period_matrix(moved, raw, allowance, forms)


def _checked_tolerance(tolerance: float) -> float:
    number = checked_number("tolerance", tolerance)
    if not number > 0.0:
        raise ValueError(f"tolerance = {tolerance}: a distance that can be reached is positive.")
    return number


def _marked(K: DeltaComplex) -> MarkedComplex:
    given = mark(K)
    if given.rank == 0:
        raise ComplexError("a surface of genus 0 has no moduli: there is nothing to reach.")
    return given


def _checked_target(target: ArrayLike, given: MarkedComplex) -> Complexes:
    point = check_siegel_point(target)
    if 2 * len(point) != given.rank:
        raise ValueError(
            f"the target has genus {len(point)}, the surface has genus {given.rank // 2}."
        )
    return point


def _nearest(point: Complexes, start: PeriodMatrix) -> tuple[Complexes, Ints]:
    with stage("nearest marking"):
        gamma, distance, proved = nearest_marking(point, start)
    how = "the nearest of all" if proved else "the nearest that was found"
    logger.info("in %s markings the target is at distance %.3g", how, distance)
    return siegel_transform(gamma, point), gamma


def _result(
    pm: PeriodMatrix, target: Complexes, gamma: Ints, steps: tuple[Step, ...], verdict: str
) -> Deformation:
    if verdict:
        warnings.warn(f"the target is not reached: {verdict}.", DeformationWarning, stacklevel=4)
    return Deformation(pm, target, gamma, siegel_distance(pm.matrix, target), steps, verdict)
