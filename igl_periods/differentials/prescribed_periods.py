r"""The holomorphic differential with given periods.

The periods of ζ = Σ s_k ζ_k, s ∈ C^g, are s along the a-cycles and Π s along the b-cycles.  So g of
the 2g complex periods can be prescribed, more only in the sense of least squares; or the *real
parts* of all of them: for p along the a- and q along the b-cycles,

.. math:: s = p + i\, Y^{-1} (X p - q), \qquad \Pi = X + iY .

With integer real parts the function exp(2πi Re ∫ζ) is well defined on the surface: stripes have
no seams.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from igl_periods.arrays import Complexes
from igl_periods.periods import PeriodMatrix


def form_of_periods(pm: PeriodMatrix, periods: ArrayLike) -> Complexes:
    """Coefficients of the differential with prescribed periods, or the nearest to them.

    Parameters
    ----------
    pm : PeriodMatrix
    periods : (2g,) array-like of complex
        Along a_1..a_g, b_1..b_g; NaN where a period is free.

    Returns
    -------
    (g,) complex
        Of least squares of the differences, and of least norm among these.

    Raises
    ------
    ValueError
        If the number of periods is not 2g, or all of them are free.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> pm = ip.period_matrix(V, F)
    >>> bool(abs(ip.form_of_periods(pm, [2, 2 * pm.matrix[0, 0]])[0] - 2.0) < 1e-12)
    True
    """
    wanted = _checked_periods(pm, np.asarray(periods, dtype=np.complex128))
    given = ~np.isnan(wanted)
    if not given.any():
        raise ValueError("all periods are free (NaN): prescribe at least one.")
    matrix = np.concatenate([np.eye(pm.genus), pm.matrix])
    s, *_ = np.linalg.lstsq(matrix[given], wanted[given], rcond=None)
    return s


def form_of_real_periods(pm: PeriodMatrix, periods: ArrayLike) -> Complexes:
    """Coefficients of the only differential whose periods have given real parts.

    Parameters
    ----------
    pm : PeriodMatrix
    periods : (2g,) array-like of float
        Real parts of the periods along a_1..a_g, b_1..b_g.

    Returns
    -------
    (g,) complex

    Raises
    ------
    ValueError
        If the number of periods is not 2g, or one is not finite.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> pm = ip.period_matrix(V, F)
    >>> ip.form_of_real_periods(pm, [1.0, 0.0]).shape
    (1,)
    """
    wanted = _checked_periods(pm, np.asarray(periods, dtype=np.float64))
    if not np.isfinite(wanted).all():
        raise ValueError("real parts of periods must all be finite: they determine the form.")
    p, q = wanted[: pm.genus], wanted[pm.genus :]
    X, Y = np.asarray(pm.matrix.real, np.float64), np.asarray(pm.matrix.imag, np.float64)
    imaginary = np.linalg.solve(Y, np.asarray(X @ p - q, np.float64))
    s: Complexes = p + 1j * imaginary
    return s


def _checked_periods(pm: PeriodMatrix, periods: NDArray[np.inexact]) -> NDArray[np.inexact]:
    if periods.shape != (2 * pm.genus,):
        raise ValueError(
            f"periods must be {2 * pm.genus} numbers, along a_1..a_g and b_1..b_g, not an array "
            f"of shape {periods.shape}."
        )
    return periods
