"""Options and weights as callers hand them over, checked."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Floats
from igl_periods.complexes import DeltaComplex, check_equal_when_glued, checked_array
from igl_periods.errors import ComplexError
from igl_periods.options import checked_integer, checked_number, in_words

_LARGEST_WEIGHT = 1e100
_LARGEST_DEGREE = 1000


def checked_options(
    weights: str, degree: int, tolerance: float | None, rigorous: bool = False
) -> tuple[int, float | None]:
    """Refuse options of :func:`period_matrix` that have no such value or contradict each other.

    Returns
    -------
    degree : int
    tolerance : float or None
        As numbers of Python.
    """
    if not isinstance(weights, str) or weights not in ("intrinsic", "extrinsic"):
        raise ValueError(f'weights must be "intrinsic" or "extrinsic", not {in_words(weights)}.')
    degree = _checked_degree(degree)
    tolerance = checked_tolerance(tolerance)
    if weights == "extrinsic" and (degree != 1 or tolerance is not None):
        raise ValueError("extrinsic weights have degree 1 and no bound: leave both options out.")
    if weights == "extrinsic" and rigorous:
        raise ValueError("extrinsic weights have no bound that could be proved: rigorous=True.")
    if degree != 1 and tolerance is not None:
        raise ValueError("a tolerance chooses the degree: leave one of the two out.")
    return degree, tolerance


def _checked_degree(degree: int) -> int:
    try:
        p = checked_integer("it", degree)
    except ValueError as error:
        raise ValueError(
            f"degree = {degree!r}: trial functions have degree 1 at least, and {error}"
        ) from None
    if not 1 <= p <= _LARGEST_DEGREE:
        raise ValueError(
            f"degree = {p}: trial functions have degree 1 at least, {_LARGEST_DEGREE} at most."
        )
    return p


def checked_tolerance(tolerance: float | None) -> float | None:
    """A positive tolerance, or None."""
    if tolerance is None:
        return None
    number = checked_number("tolerance", tolerance)
    if not number > 0.0:
        raise ValueError(f"tolerance = {number:g}: a bound is always positive.")
    return number


def checked_limits(
    max_unknowns: float | None, max_memory: float | None
) -> tuple[float | None, float | None]:
    """Most unknowns and bytes, at least 0, or None where nothing is said."""
    limits = []
    for name, limit in (("max_unknowns", max_unknowns), ("max_memory", max_memory)):
        number = None if limit is None else checked_number(name, limit)
        if number is not None and not number >= 0.0:
            raise ValueError(f"{name} = {number:g}: a limit is not negative.")
        limits.append(number)
    return limits[0], limits[1]


def check_kept_forms(weights: str) -> None:
    """Refuse weights that have no derivative by lengths."""
    if weights == "extrinsic":
        raise ValueError(
            "keep_forms=True goes with intrinsic weights: extrinsic ones are no function of the "
            "lengths, by which derivatives are taken."
        )


def edge_weights(K: DeltaComplex, rho: ArrayLike) -> Floats:
    """Weights on half-edges, checked, as weights on edges; (n_edges,)."""
    array = checked_array(rho, "rho", ComplexError)
    if array.shape != K.twin.shape or array.dtype.kind not in "iuf":
        raise ComplexError(
            f"rho must be a real array of the shape of twin, {K.twin.shape}, not {array.shape} "
            f"of {array.dtype}."
        )
    values = array.astype(np.float64)
    if not np.isfinite(values).all():
        raise ComplexError("rho has entries that are NaN or infinite.")
    if np.abs(values).max() > _LARGEST_WEIGHT:
        raise ComplexError(
            f"rho reaches {np.abs(values).max():.3g}: energies up to {_LARGEST_WEIGHT:g} can be "
            "computed. The weights of round triangles are of order 1."
        )
    check_equal_when_glued(values, K.twin, "weights")
    weights = np.empty(K.n_edges)
    weights[K.edge.ravel()] = values.ravel()
    return weights
