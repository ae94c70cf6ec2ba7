r"""How far a given period matrix can be off, from the energies of closed forms in balls.

Let D be energies of closed forms in a canonical basis, so that D ≥ D_exact by Dirichlet's
principle, and Π̃ = X + iY any exactly symmetric matrix with Y > 0.  Its Dirichlet matrix is
symplectic,

.. math:: G = P^{-1} P^{-T}, \qquad P = \begin{pmatrix} L^{-1} & L^{-1} X \\ 0 & L^T
          \end{pmatrix}, \qquad Y = L L^T .

If :math:`P D P^T \le (1 + \eta)` then :math:`D_{exact} \le D \le (1 + \eta)\, G`, and since D_exact
and G are both symplectic also :math:`D_{exact} \ge G / (1 + \eta)`.  So the Siegel distance of
the two points is at most log(1 + η) in the operator norm, in other words

.. math:: \| Y^{-1/2} (\Pi_{exact} - \tilde\Pi) Y^{-1/2} \|_2 \le \eta, \qquad
          |\Pi_{exact} - \tilde\Pi|_{ij} \le \eta \sqrt{Y_{ii} Y_{jj}} .

(Move Π̃ to i by P.  The Cayley transform W of the exact point then has norm at most η/(2 + η), and
it is i + 2i W (1 − W)⁻¹.)  How Π̃ was found does not matter.

L is any floating-point matrix near a Cholesky factor of Y.  The proof is then about
:math:`X + i L L^T`, which differs from Π̃ by :math:`\delta = \|L^{-1} Y L^{-T} - 1\|` at most, in
units of :math:`L L^T`: in total :math:`(\eta + \delta) / (1 - \delta)`.

η is found by eigenvectors.  With any floating-point Q, near an orthogonal matrix of eigenvectors of
the midpoint of :math:`E = P D P^T - 1`, and all products in balls: where Λ = QᵀEQ and S = QᵀQ,
the matrix η S − Λ is diagonally dominant, hence E ≤ η, as soon as

.. math:: \eta\, \Big( S_{ii} - \sum_{j \ne i} |S_{ij}| \Big) \ge
          \Lambda_{ii} + \sum_{j \ne i} |\Lambda_{ij}| \quad \text{for all } i .

Λ is diagonal to all digits of E, so this is sharp.  The radii R of E, which have no such structure,
are left out of Λ and added as :math:`\|R\| \le \max_i (R v)_i / v_i`, for any v > 0.

References
----------
Siegel, "Symplectic geometry" (1943), on the distance and the Cayley transform.
Rump, "Verification methods: rigorous results using floating-point arithmetic" (2010), section 10.
"""

from __future__ import annotations

from collections.abc import Iterable

import flint
import numpy as np
from flint import arb, arb_mat
from numpy.typing import ArrayLike

from igl_periods.arrays import Floats
from igl_periods.symplectic import cholesky_factor

from .midpoint_radius import Balls

# What is computed beyond the radius of the energies; more than the markings of any surface need.
BITS = 192
_POWER_STEPS = 10


def relative_radius(D: arb_mat, X: ArrayLike, Y: ArrayLike, basis: arb_mat | None = None) -> arb:
    """An upper bound of ‖Y^{-1/2} (Π_exact − X − iY) Y^{-1/2}‖₂.

    Parameters
    ----------
    D : (k, k) arb_mat
        Energies of closed forms, or upper bounds of those in the sense of Loewner.
    X, Y : (g, g) float
        Exactly symmetric; Y positive definite.
    basis : (2g, k) arb_mat, optional
        Coefficients of a canonical basis in terms of the forms of D; the identity by default.

    Returns
    -------
    arb
        Exact, a number ≥ 0; +∞ where nothing can be proved.

    Raises
    ------
    ValueError
        If X or Y is not exactly symmetric.
    NotPositiveDefiniteError
        If Y is not positive definite.
    """
    real, imaginary = np.asarray(X, dtype=np.float64), np.asarray(Y, dtype=np.float64)
    if not (np.array_equal(real, real.T) and np.array_equal(imaginary, imaginary.T)):
        raise ValueError("a period matrix must be exactly symmetric: X = X^T, Y = Y^T.")
    if len(real) == 0:
        return arb(0)
    L = np.tril(cholesky_factor(imaginary))
    with flint.ctx.workprec(max(flint.ctx.prec, BITS)):
        inverse = _exact(L).inv()
        P = _to_the_standard_point(inverse, _exact(real), _exact(L))
        if basis is not None:
            P = P * basis
        eta = largest_eigenvalue(_minus_one(P * D * P.transpose()))
        delta = _norm(_minus_one(inverse * _exact(imaginary) * inverse.transpose()))
        bound = ((eta + delta) / (1 - delta)).upper()
        return bound if delta < 1 and bound.is_finite() else arb.pos_inf()


def largest_eigenvalue(E: arb_mat) -> arb:
    """An upper bound ≥ 0 of the eigenvalues of all symmetric matrices in a matrix of balls."""
    middle = E.mid()
    scale = max((abs(x) for x in middle.entries()), default=arb(0))
    if not scale.is_finite():
        return arb.pos_inf()
    radii = _norm_of_radii(E)
    if scale == 0:
        return radii
    # Symmetric up to rounding, which is part of the radii.
    half = (middle + middle.transpose()) / 2
    approximate = np.array([[float(x) for x in row] for row in (half / scale).table()])
    _, vectors = np.linalg.eigh(approximate)
    Q = _exact(vectors)
    diagonal, skeleton = Q.transpose() * half * Q, Q.transpose() * Q
    best = arb(0)
    for image, square in zip(_rows(diagonal), _rows(skeleton), strict=True):
        room = square[0] - square[1]
        if not room > 0:
            return arb.pos_inf()
        best = best.max((image[0] + image[1]) / room)
    return (best + radii).upper()


def energy_balls(D: Balls) -> arb_mat:
    """The same balls as a matrix for python-flint."""
    return arb_mat(
        [
            [arb(m, r) for m, r in zip(mids, rads, strict=True)]
            for mids, rads in zip(D.mid.tolist(), D.rad.tolist(), strict=True)
        ]
    )


def _to_the_standard_point(inverse: arb_mat, X: arb_mat, L: arb_mat) -> arb_mat:
    """The matrix P."""
    g = X.nrows()
    left, right, transposed = inverse.table(), (inverse * X).table(), L.transpose().table()
    top = [one + other for one, other in zip(left, right, strict=True)]
    return arb_mat(top + [[arb(0)] * g + row for row in transposed])


def _norm(E: arb_mat) -> arb:
    """An upper bound of the norm of a symmetric matrix: its largest row sum."""
    return _largest(_sum(abs(x) for x in row) for row in E.table())


def _norm_of_radii(E: arb_mat) -> arb:
    """A bound of the norms of all symmetric matrices with entries below the radii of E."""
    table = [[x.rad() for x in row] for row in E.table()]
    largest = _largest(x for row in table for x in row)
    if not largest.is_finite():
        return arb.pos_inf()
    if largest == 0:
        return largest
    # In units of the largest, which may be far below what floating point knows.
    upper = np.array([[_upper(x / largest) for x in row] for row in table])
    upper = np.maximum(upper, upper.T)
    v = np.ones(len(upper))
    for _ in range(_POWER_STEPS):
        image = upper @ v
        v = image / image.max() + 1e-3
    # Sums of n numbers ≥ 0, enlarged by more than their rounding.
    return (largest * (float((upper @ v / v).max()) * (1.0 + 1e-9))).upper()


def _rows(A: arb_mat) -> Iterable[tuple[arb, arb]]:
    """The diagonal entry of each row, and the sum of the absolute values of the others."""
    for i, row in enumerate(A.table()):
        yield row[i], _sum(abs(x) for j, x in enumerate(row) if j != i)


def _minus_one(A: arb_mat) -> arb_mat:
    return A - arb_mat(np.eye(A.nrows()).tolist())


def _exact(A: Floats) -> arb_mat:
    return arb_mat(A.tolist())


def _upper(x: arb) -> float:
    """A floating-point number that is not below x."""
    return float(np.nextafter(float(x.upper()), np.inf))


def _sum(terms: Iterable[arb]) -> arb:
    return sum(terms, arb(0))


def _largest(values: Iterable[arb]) -> arb:
    best = arb(0)
    for value in values:
        best = best.max(value)
    return best.upper()
