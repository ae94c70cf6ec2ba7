r"""Hyperelliptic period matrices of genus 3 near a given one.

In genus 3 a Riemann surface is hyperelliptic iff exactly one even theta constant vanishes (Mumford
1984).  The equation θ(Π) = 0 is solved by Newton's method, with the steps that are shortest in
Siegel's metric :math:`\operatorname{tr} Y^{-1} \partial\Pi\, Y^{-1} \overline{\partial\Pi}`,

.. math:: \partial\Pi = -\frac{\theta}{|\theta'|^2}\; Y\, \overline{\theta'}\, Y, \qquad
          |\theta'|^2 = \operatorname{tr} Y \theta'\, Y \overline{\theta'} .

References
----------
Mumford, "Tata lectures on theta II" (1984), section IIIa.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes
from igl_periods.siegel import siegel_reduce, siegel_transform
from igl_periods.symplectic import unimodular_inverse

from .invariant_derivatives import theta_derivatives
from .theta import of_genus, theta_constants

_MOST_STEPS = 50
_ZERO = 1e-14


def hyperelliptic_point(Pi: ArrayLike) -> Complexes:
    """A period matrix of genus 3 with a vanishing even theta constant, near Π; (3, 3) complex.

    The constant is the one that is smallest, relative to its derivative, where Π is reduced.

    Parameters
    ----------
    Pi : (3, 3) array-like or PeriodMatrix

    Raises
    ------
    ValueError
        If Π has another genus (NotASiegelPointError if it is not a point of the half-space), or
        Newton's method leaves the half-space or does not converge.

    Examples
    --------
    >>> from igl_periods import is_hyperelliptic
    >>> Pi = 1j * np.eye(3) + 0.2j * (1 - np.eye(3)) + np.diag([0.1, 0.0, 0.2])
    >>> is_hyperelliptic(Pi), is_hyperelliptic(hyperelliptic_point(Pi))
    (False, True)
    """
    point, gamma = siegel_reduce(of_genus(Pi, 3))
    values, slopes = theta_constants(point), theta_derivatives(point)
    norms = np.array([[_norm(slope, point) for slope in row] for row in slopes])
    even = np.bitwise_count(np.arange(8)[:, None] & np.arange(8)) % 2 == 0
    nearness = np.where(even, np.abs(values) / np.maximum(norms, 1e-300), np.inf)
    a, b = np.unravel_index(np.argmin(nearness), nearness.shape)
    for _ in range(_MOST_STEPS):
        value, slope = theta_constants(point)[a, b], theta_derivatives(point)[a, b]
        if abs(value) < _ZERO:
            return siegel_transform(unimodular_inverse(gamma), point)
        Y = point.imag
        point = point - value / _norm(slope, point) ** 2 * (Y @ slope.conj() @ Y)
        if np.linalg.eigvalsh(point.imag)[0] <= 0.0:
            break
    raise ValueError("no hyperelliptic point is found near this period matrix.")


def _norm(slope: Complexes, Pi: Complexes) -> float:
    """The norm of a derivative, dual to Siegel's."""
    return float(np.sqrt(np.einsum("ij,jk,kl,li->", Pi.imag, slope, Pi.imag, slope.conj()).real))
