r"""Period matrices of smooth surfaces: extrapolation over a family of meshes.

The certificate of a period matrix is about a polyhedral surface.  If polyhedral surfaces of n = n_0
< n_1 < … approximate a smooth one, and the error has an expansion that starts with

.. math:: \Pi(n) = \Pi + C n^{-q} + o(n^{-q}),

then three of them determine the order q and the limit Π (Richardson 1911).  With the successive
differences Δ₁ = Π(n_1) − Π(n_0), Δ₂ = Π(n_2) − Π(n_1), the order is the solution of

.. math:: \frac{n_1^{-q} - n_2^{-q}}{n_0^{-q} - n_1^{-q}} = \kappa
          = \frac{\langle \Delta_1, \Delta_2 \rangle}{\langle \Delta_1, \Delta_1 \rangle}, \qquad
          \Pi \approx \Pi(n_2) + \frac{n_2^{-q}}{n_1^{-q} - n_2^{-q}} \Delta_2 .

**Nothing is certified here.**  That the error has such an expansion is an assumption about the
family, and no finite number of meshes proves it.  The error is estimated by the largest of two
numbers: what the extrapolations from the last three meshes and from the three before differ by
(or, where there are only three meshes, the whole correction), and the change of the correction
when q is replaced by the nearest integer, since smooth surfaces have integer orders and an estimate
in between tells that the meshes are still too coarse.

Each mesh comes with a marking of its own.  All are brought to that of the finest mesh by the
modular transformation that takes their matrices closest to its one.

References
----------
Richardson, "The approximate arithmetical solution by finite differences of physical problems
involving differential equations" (1911).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Floats, Ints, ReadOnlyArrays
from igl_periods.complexes import DeltaComplex, periodic_grid
from igl_periods.display import facts_html, matrix_html, matrix_lines
from igl_periods.moduli import symplectic_isomorphisms
from igl_periods.options import checked_integer, in_words
from igl_periods.run_log import logger
from igl_periods.siegel import siegel_distance, siegel_transform

from .computation import period_matrix
from .matrix import PeriodMatrix
from .rounding import LEAST_ALLOWANCE

Mesh = tuple[ArrayLike, ArrayLike]
Family = Callable[[int], DeltaComplex | Mesh]
_LEAST_ORDER, _LARGEST_ORDER = 0.25, 12.0
# How far apart, in terms of log-lengths, matrices of neighbouring meshes are looked for.
_SEARCHED = (0.01, 0.1, 0.4, 0.69)


@dataclass(frozen=True, eq=False)
class Extrapolation(ReadOnlyArrays):
    """The period matrix of a smooth surface, by extrapolation: an estimate, not a certificate.

    Attributes
    ----------
    matrix : (g, g) complex
        The extrapolated matrix; that of the finest mesh where ``order`` is None.
    order : float or None
        The estimated order q of convergence; None where the differences of the last three
        matrices do not decrease like a power of n.
    error_estimate : float
        Estimate of ‖Y^{-1/2} (Π − matrix) Y^{-1/2}‖₂, Π the matrix of the smooth surface.  It is
        no bound.
    sizes : tuple of int
    period_matrices : tuple of PeriodMatrix
        Those of the meshes, in the marking of the finest one; their ``bound`` is a certificate for
        the mesh, and says nothing about the smooth surface.

    Examples
    --------
    >>> import igl_periods as ip
    >>> from igl_periods.surfaces import torus_of_revolution
    >>> found = ip.richardson(lambda n: torus_of_revolution(2.0, 1.0, 2 * n, n), [6, 12, 24])
    >>> found.order > 1.5
    True
    """

    matrix: Complexes
    order: float | None
    error_estimate: float
    sizes: tuple[int, ...]
    period_matrices: tuple[PeriodMatrix, ...]

    def __repr__(self) -> str:
        lines = [f"  {line}" for line in matrix_lines(self.matrix, self._estimates())]
        facts = ", ".join(f"{name} {value}" for name, value in self._facts())
        return "\n".join([f"Extrapolation: {facts}", *lines])

    def _repr_html_(self) -> str:
        matrix = matrix_html(self.matrix, self._estimates())
        return facts_html("Extrapolation (an estimate, no certificate)", self._facts(), matrix)

    def _facts(self) -> list[tuple[str, str]]:
        order = "unknown" if self.order is None else f"{self.order:.3g}"
        sizes = " ".join(map(str, self.sizes))
        return [("order", order), ("error about", f"{self.error_estimate:.2g}"), ("sizes", sizes)]

    def _estimates(self) -> Floats | None:
        """Errors of the entries, by the estimate; None where that says nothing."""
        scale = np.sqrt(np.diag(self.matrix).imag)
        known = np.isfinite(self.error_estimate)
        return self.error_estimate * np.outer(scale, scale) if known else None


def richardson(family: Family, sizes: Sequence[int], **options: Any) -> Extrapolation:
    """Extrapolate the period matrices of a family of meshes to that of the limit.

    Parameters
    ----------
    family : callable
        The complex, or the mesh (V, F), for each n; its edges have lengths of order 1/n.
    sizes : sequence of int
        At least three numbers n, ascending.  Four or more give a better estimate of the error.
    **options
        For :func:`igl_periods.period_matrix`.  With a small ``tolerance``, what is left to be
        extrapolated is the difference between the meshes and the smooth surface alone.

    Raises
    ------
    ValueError
        If there are less than three sizes, they do not ascend, the genus changes, or the matrices
        of two meshes are too far apart to be compared, or too symmetric.

    Examples
    --------
    >>> from igl_periods.surfaces.tori import torus_of_revolution
    >>> limit = richardson(lambda n: torus_of_revolution(2.0, 1.0, n, n), (12, 24, 48))
    >>> 1.9 < limit.order < 2.1
    True
    """
    sizes = _checked_sizes(sizes)
    if not callable(family):
        raise ValueError(f"the family must be a function of n, not {in_words(family)}.")
    if len(sizes) < 3 or not all(a < b for a, b in pairwise(sizes)) or sizes[0] < 1:
        raise ValueError(f"richardson needs three or more ascending sizes, not {list(sizes)}.")
    computed = [_period_matrix(family(n), options) for n in sizes]
    aligned = [_in_marking_of(computed[-1], pm) for pm in computed[:-1]] + [computed[-1]]
    matrices = [pm.matrix for pm in aligned]
    metric = np.linalg.inv(np.linalg.cholesky(matrices[-1].imag))
    limits = [_limit(sizes[i : i + 3], matrices[i : i + 3], metric) for i in range(len(sizes) - 2)]
    matrix, order, correction, uncertain = limits[-1]
    error = correction
    if len(limits) > 1 and order is not None and limits[-2][1] is not None:
        error = max(_distance(matrix, limits[-2][0], metric), uncertain)
    error = max(error, LEAST_ALLOWANCE)
    logger.info("extrapolated from n = %s: order %s, error about %.1e", list(sizes), order, error)
    return Extrapolation(matrix, order, error, tuple(sizes), tuple(aligned))


def _checked_sizes(sizes: Sequence[int]) -> list[int]:
    if not isinstance(sizes, Iterable) or np.ndim(sizes) == 0:
        raise ValueError(f"richardson needs three or more ascending sizes, not {in_words(sizes)}.")
    return [checked_integer("a size", n) for n in sizes]


def sampled_torus(immersion: Callable[[Floats, Floats], Floats], aspect: float = 1.0) -> Family:
    """The family of meshes of a doubly periodic immersion, on regular grids.

    Parameters
    ----------
    immersion : callable
        Takes arrays u, v of shape (k,), periodic with period 1 in both, to points (k, d).
    aspect : float
        The mesh for n has n vertices in the direction of u and ``round(aspect n)`` in that of v.

    Examples
    --------
    >>> import igl_periods as ip
    >>> import numpy as np
    >>> def immersion(x, y):
    ...     s, t = 2 * np.pi * x, 2 * np.pi * y
    ...     r = 2 + np.cos(t)
    ...     return np.stack([r * np.cos(s), r * np.sin(s), np.sin(t)], axis=-1)
    ...
    >>> V, F = ip.sampled_torus(immersion)(8)
    >>> len(V), len(F)
    (64, 128)
    """

    def mesh(n: int) -> Mesh:
        m = max(round(aspect * n), 3)
        u, v = np.meshgrid(np.arange(n) / n, np.arange(m) / m, indexing="ij")
        return immersion(u.ravel(), v.ravel()), periodic_grid(n, m)

    return mesh


def _period_matrix(surface: DeltaComplex | Mesh, options: dict[str, Any]) -> PeriodMatrix:
    if isinstance(surface, DeltaComplex):
        return period_matrix(surface, **options)
    return period_matrix(*surface, **options)


def _in_marking_of(finest: PeriodMatrix, pm: PeriodMatrix) -> PeriodMatrix:
    if pm.genus != finest.genus:
        raise ValueError(f"the genus of the meshes changes, from {pm.genus} to {finest.genus}.")
    for tolerance in _SEARCHED:
        found = symplectic_isomorphisms(pm.matrix, finest.matrix, tolerance=tolerance)
        if not found.complete:
            raise ValueError(
                "the search for the marking that two of the meshes have in common was given up "
                f"({found.gave_up}): start with a finer mesh."
            )
        if found:
            return pm.change_basis(min(found, key=lambda gamma: _moved(gamma, pm, finest)))
    raise ValueError(
        "the period matrices of two of the meshes differ too much to be compared: start with a "
        "finer mesh."
    )


def _moved(gamma: Ints, pm: PeriodMatrix, finest: PeriodMatrix) -> float:
    return siegel_distance(siegel_transform(gamma, pm.matrix), finest.matrix)


def _limit(
    sizes: Sequence[int], matrices: Sequence[Complexes], metric: Floats
) -> tuple[Complexes, float | None, float, float]:
    """Limit, order, size of the correction, and its change with the nearest integer order."""
    first, second = (metric @ (b - a) @ metric.T for a, b in pairwise(matrices))
    changes = [float(np.linalg.norm(change, 2)) for change in (first, second)]
    order = _order(sizes, first, second)
    if order is None:
        return matrices[-1], None, max(changes), max(changes)
    factor, nearest = (_factor(sizes, q) for q in (order, max(round(order), 1)))
    limit = matrices[-1] + factor * (matrices[-1] - matrices[-2])
    return limit, order, factor * changes[1], abs(factor - nearest) * changes[1]


def _order(sizes: Sequence[int], first: Complexes, second: Complexes) -> float | None:
    """The order q, or None if the differences are not those of a power of n."""
    if not np.any(first) or not np.any(second):
        return None
    kappa = float(np.vdot(first, second).real / np.vdot(first, first).real)
    n = np.asarray(sizes, dtype=np.float64) / sizes[-1]

    def excess(q: float) -> float:
        p = n**-q
        return float((p[1] - p[2]) / (p[0] - p[1]) - kappa)

    parallel = np.linalg.norm(second - kappa * first) < 0.5 * np.linalg.norm(second)
    if not parallel or excess(_LEAST_ORDER) * excess(_LARGEST_ORDER) > 0.0:
        return None
    from scipy.optimize import brentq  # slow to import, and seldom needed

    return float(brentq(excess, _LEAST_ORDER, _LARGEST_ORDER))


def _factor(sizes: Sequence[int], q: float) -> float:
    return 1.0 / ((sizes[-1] / sizes[-2]) ** q - 1.0)


def _distance(one: Complexes, other: Complexes, metric: Floats) -> float:
    return float(np.linalg.norm(metric @ (one - other) @ metric.T, 2))
