r"""The Siegel upper half-space, its modular group and its metric.

The Siegel upper half-space of genus g holds the symmetric complex matrices Π = X + iY with Y
positive definite.  The modular group Sp(2g, Z) acts on it by

.. math:: \gamma \cdot \Pi = (a \Pi + b)(c \Pi + d)^{-1}, \qquad
          \gamma = \begin{pmatrix} a & b \\ c & d \end{pmatrix},

and two matrices in one orbit belong to the same Riemann surface with two markings.  Siegel's
distance is invariant under the action: with λ_i ≥ 1 the eigenvalues of D₁⁻¹ D₂ (D the Dirichlet
matrices), :math:`d^2 = \sum_{i \le g} \log^2 \lambda_i`.

References
----------
Siegel, "Symplectic geometry" (1943).
"""

from __future__ import annotations

from typing import Any, overload

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.errors import NotASiegelPointError
from igl_periods.options import in_words
from igl_periods.symplectic import is_symplectic

from .action import moebius
from .enclosed_points import PointInBalls, balls_of, bits_of, in_marking, midpoint

# Entries may differ from their mirror image by this much, relative to the largest entry.
_ASYMMETRY = 1e-8
_LARGEST_ENTRY = int(np.iinfo(np.int64).max)


def check_siegel_point(Pi: ArrayLike | PointInBalls) -> Complexes:
    """Return Π as a symmetric complex array, or raise if it is not a point of the half-space.

    Parameters
    ----------
    Pi : (g, g) array-like
        Or an object that ``numpy.asarray`` turns into one, such as a ``PeriodMatrix``.  Of a
        point that is known in balls the midpoints are taken.

    Raises
    ------
    NotASiegelPointError
        If Π is not square, not finite, not symmetric (to 1e-8 of its largest entry), or Im Π is
        not positive definite.
    """
    balls = balls_of(Pi)
    matrix = _complex_array(Pi if balls is None else midpoint(balls))
    if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1]:
        raise NotASiegelPointError(f"a period matrix is square, but this has shape {matrix.shape}")
    if not np.isfinite(matrix).all():
        bad = np.argwhere(~np.isfinite(matrix))
        raise NotASiegelPointError(
            f"the period matrix has {len(bad)} entries that are not finite, the first at "
            f"{tuple(int(i) for i in bad[0])}"
        )
    if matrix.size:
        _check_symmetry(matrix)
        _check_positivity(matrix.imag)
    return 0.5 * (matrix + matrix.T)


def _complex_array(Pi: Any) -> Complexes:
    try:
        given = np.asarray(Pi)
        if given.dtype.kind in "biufcO":
            return np.array(given, dtype=np.complex128)
    except (TypeError, ValueError):
        given = np.empty(0, dtype=object)
    what = in_words(Pi) if given.dtype.kind == "O" else f"an array of {given.dtype}"
    raise NotASiegelPointError(f"a period matrix is an array of complex numbers, not {what}")


def _check_symmetry(matrix: Complexes) -> None:
    asymmetry = float(np.abs(matrix - matrix.T).max())
    allowed = _ASYMMETRY * float(np.abs(matrix).max())
    if asymmetry > allowed:
        raise NotASiegelPointError(
            f"the period matrix is not symmetric: mirrored entries differ by up to {asymmetry:.3g} "
            f"(allowed: {allowed:.3g}). The primal and the dual estimate are not symmetric in "
            "general; the symplectic mean is."
        )


def _check_positivity(Y: Floats) -> None:
    try:
        np.linalg.cholesky(0.5 * (Y + Y.T))
    except np.linalg.LinAlgError as error:
        least = float(np.linalg.eigvalsh(0.5 * (Y + Y.T))[0])
        raise NotASiegelPointError(
            f"the imaginary part is not positive definite: its least eigenvalue is {least:.3g} "
            f"(largest entry {float(np.abs(Y).max()):.3g}). Perhaps a- and b-periods are "
            "interchanged, or the orientation is reversed."
        ) from error


def check_same_genus(
    Pi1: ArrayLike | PointInBalls, Pi2: ArrayLike | PointInBalls
) -> tuple[Complexes, Complexes]:
    """Both matrices, checked; ValueError if their genera differ."""
    one, two = check_siegel_point(Pi1), check_siegel_point(Pi2)
    if len(one) != len(two):
        raise ValueError(f"period matrices of different genus, {len(one)} and {len(two)}")
    return one, two


@overload
def siegel_transform(gamma: ArrayLike, Pi: PointInBalls) -> flint.acb_mat: ...
@overload
def siegel_transform(gamma: ArrayLike, Pi: ArrayLike) -> Complexes: ...
def siegel_transform(gamma: ArrayLike, Pi: ArrayLike | PointInBalls) -> Complexes | flint.acb_mat:
    """The Möbius action γ · Π = (a Π + b)(c Π + d)⁻¹ of Sp(2g, Z).

    Computed from the given floating-point Π with as many digits as it needs
    (:mod:`igl_periods.siegel.action`): every entry is right to rounding, however large γ is.

    Parameters
    ----------
    gamma : (2g, 2g) array-like of int
        ``[[a, b], [c, d]]``, symplectic: γ J γᵀ = J.
    Pi : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat

    Returns
    -------
    (g, g) complex, or acb_mat
        Symmetric, with positive definite imaginary part.  Of a point that is known in balls: balls
        that contain γ · Π for every Π in the given ones.

    Raises
    ------
    ValueError
        If γ is not integer, has entries beyond 64 bits or another size than Π asks for, or is not
        symplectic (exactly).
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.

    Examples
    --------
    >>> siegel_transform([[0, -1], [1, 0]], [[2j]])
    array([[0.+0.5j]])
    """
    point = check_siegel_point(Pi)
    checked = check_symplectic(gamma, len(point))
    if balls_of(Pi) is not None:
        return in_marking(Pi, checked)
    return moebius(checked, point)


def check_symplectic(gamma: ArrayLike, g: int) -> Ints:
    """Return γ as an int64 array, or raise ValueError unless it lies in Sp(2g, Z)."""
    given = np.asarray(gamma)
    if given.shape != (2 * g, 2 * g):
        raise ValueError(
            f"a modular transformation in genus {g} has shape {(2 * g, 2 * g)}, not {given.shape}"
        )
    if given.dtype.kind not in "biufO" or not all(_is_integral(x) for x in given.ravel().tolist()):
        raise ValueError("a modular transformation has integer entries, this matrix has others")
    largest = max((abs(int(x)) for x in given.ravel().tolist()), default=0)
    if largest > _LARGEST_ENTRY:
        raise ValueError(
            f"a modular transformation has entries up to 2^63 - 1 here, and this has {largest}. "
            "Apply it in steps, or reduce the matrix first (siegel_reduce)."
        )
    matrix = given.astype(np.int64)
    if not is_symplectic(matrix):
        raise ValueError(
            "the matrix is not symplectic: γ J γᵀ differs from J = [[0, 1], [-1, 0]]. (Matrices "
            "that act on forms or cycles in another order are other conjugates of γ.)"
        )
    return matrix


def _is_integral(x: Any) -> bool:
    return isinstance(x, int) or (isinstance(x, float) and x.is_integer())


def siegel_distance(Pi1: ArrayLike | PointInBalls, Pi2: ArrayLike | PointInBalls) -> float:
    r"""Siegel's distance of two period matrices, invariant under Sp(2g, R).

    :math:`d^2 = \sum_{i \le g} \log^2 \lambda_i`, where λ_i ≥ 1 and 1/λ_i are the eigenvalues
    of D₁⁻¹ D₂.  For g = 1 it is the hyperbolic distance.  It is computed from the generalised
    cross-ratio: a transformation takes Π₁ to i and Π₂ to W = i + Δ, the Cayley transform W → Z =
    Δ (Δ + 2i)⁻¹ takes that to the disk, and the singular values of Z are tanh(½ log λ_i).  Hence
    nearby points are as accurate as their difference Π₂ − Π₁.

    Parameters
    ----------
    Pi1, Pi2 : (g, g) array-like, PeriodMatrix, PeriodEnclosure or acb_mat
        Of what is known in balls: the midpoints, whose difference is taken before it is rounded.

    Raises
    ------
    NotASiegelPointError
        If one of them is not a point of the Siegel upper half-space.
    ValueError
        If they have different genus.

    References
    ----------
    Siegel, "Symplectic geometry" (1943), section 2.

    Examples
    --------
    >>> round(siegel_distance([[1j]], [[2j]]), 12)  # log 2
    0.69314718056
    """
    return float(np.linalg.norm(log_eigenvalues(Pi1, Pi2)))


def log_eigenvalues(Pi1: ArrayLike | PointInBalls, Pi2: ArrayLike | PointInBalls) -> Floats:
    """The log λ_i ≥ 0 of two points of the half-space, increasing; (g,).

    Computed as described in :func:`siegel_distance`.
    """
    one, two = check_same_genus(Pi1, Pi2)
    L = np.linalg.cholesky(one.imag)
    difference = np.linalg.solve(L, np.linalg.solve(L, _difference(Pi1, Pi2, one, two)).T)
    M = np.linalg.solve(L, np.linalg.cholesky(two.imag))
    denominator = np.linalg.inv(difference + 2j * np.eye(len(one)))
    # tanh and 1/cosh of half the logarithms; neither alone is accurate both near and far.
    tanh = np.linalg.svd(difference @ denominator, compute_uv=False)
    sech = np.linalg.svd(2 * M.T @ denominator, compute_uv=False)
    logarithms: Floats = 2 * np.arcsinh(tanh / sech[::-1])
    return logarithms[::-1]


def _difference(
    Pi1: ArrayLike | PointInBalls, Pi2: ArrayLike | PointInBalls, one: Complexes, two: Complexes
) -> Complexes:
    """Π₂ − Π₁; of midpoints of balls, where both have them, with all of their digits."""
    balls = balls_of(Pi1), balls_of(Pi2)
    if balls[0] is None or balls[1] is None:
        return two - one
    with flint.ctx.workprec(max(bits_of(Pi1), bits_of(Pi2))):
        return midpoint(balls[1].mid() - balls[0].mid())
