r"""From the energies in balls to a period matrix in balls.

Let D be the exact energy matrix of closed forms in a canonical basis, so that D_exact ≤ D and
D_exact is symplectic.  For *any* exact symmetric X and Y = L Lᵀ > 0 the matrix

.. math:: P = \begin{pmatrix} L^{-1} & L^{-1} X \\ 0 & L^T \end{pmatrix}

is symplectic, and G = P⁻¹ P⁻ᵀ is the energy matrix of X + iY.  If (1 + η) 1 − P D Pᵀ is positive
definite, then D_exact ≤ D ≤ (1 + η) G, and as both sides are symplectic G/(1 + η) ≤ D_exact too.
Hence

.. math:: \| L^{-1} (\Pi_{exact} - X - iY) L^{-T} \|_2 \le \eta, \qquad
          |\Pi_{exact} - X - iY|_{ij} \le \eta \sqrt{Y_{ii} Y_{jj}} .

Positive definiteness is proved by a Cholesky factor in balls.  The best X + iY is the symplectic
mean of D; it is found by Newton's iteration S ← ½ (S − S⁻¹) for the complex structure, from
S = J D, whose eigenvalues ± i d it moves to ± i from any d > 0.  Nothing depends on how well that
went.
"""

from __future__ import annotations

from dataclasses import dataclass

import flint
import numpy as np

from igl_periods.errors import ComplexError
from igl_periods.siegel import cholesky
from igl_periods.symplectic import standard_form

from .exact_arithmetic import exponent_of

Arb = flint.arb
ArbMat = flint.arb_mat

_MOST_ROUNDS = 60
# How much larger than necessary η may be.
_SHARPNESS = (1.001, 1.01, 1.1, 1.5, 2.0, 4.0)


@dataclass(frozen=True, eq=False)
class SiegelBall:
    """A point X + iY of the Siegel upper half-space, and how far the exact one is at most.

    Attributes
    ----------
    real, imag : arb_mat
        X and Y, exact and symmetric; (g, g).
    bound : arb
        η, exact.
    """

    real: ArbMat
    imag: ArbMat
    bound: Arb

    def matrix(self) -> flint.acb_mat:
        """Balls that contain the entries of the exact matrix."""
        g = self.real.nrows()
        roots = [self.imag[i, i].sqrt() for i in range(g)]
        return flint.acb_mat(
            [
                [
                    flint.acb(
                        self.real[i, j] + Arb(0, self.bound * roots[i] * roots[j]),
                        self.imag[i, j] + Arb(0, self.bound * roots[i] * roots[j]),
                    )
                    for j in range(g)
                ]
                for i in range(g)
            ]
        )


def siegel_ball(D: ArbMat) -> SiegelBall:
    """The period matrices that energies in a canonical basis leave possible.

    Parameters
    ----------
    D : (2g, 2g) arb_mat
        Contains the energies of closed forms on the surface.

    Raises
    ------
    ComplexError
        If the balls are so large that nothing follows.
    """
    unknown = ComplexError("the energies are known too badly for a period matrix.")
    if not all(x.is_finite() for x in D.entries()):
        raise unknown
    try:
        X, Y = symplectic_mean(D)
        M = normalised(D, X, Y)
    except ZeroDivisionError as error:
        raise unknown from error
    if M is None:
        raise unknown
    return SiegelBall(X, Y, _largest_excess(M))


def symplectic_mean(D: ArbMat) -> tuple[ArbMat, ArbMat]:
    """Exact symmetric X and Y of about the symplectic mean of the midpoint of D."""
    g = D.nrows() // 2
    J = ArbMat(standard_form(g).tolist())
    S = (J * D.mid()).mid()
    tolerance = Arb(2) ** (8 - flint.ctx.prec // 2)
    for _ in range(_MOST_ROUNDS):
        following = ((S - S.inv()) / 2).mid()
        change = max((abs(x) for x in (following - S).entries()), default=Arb(0))
        size = max((abs(x) for x in S.entries()), default=Arb(1))
        S = following
        if change < tolerance * size:
            break
    G = (-1 * (J * S)).mid().tolist()
    bb = ArbMat([row[g:] for row in G[g:]])
    ab = ArbMat([row[g:] for row in G[:g]])
    Y = bb.inv()
    return _symmetric(-1 * (ab * Y)), _symmetric(Y)


def normalised(D: ArbMat, X: ArbMat, Y: ArbMat) -> ArbMat | None:
    """P D Pᵀ, near 1 iff X + iY is near the period matrix of D; None if Y is not definite."""
    g = X.nrows()
    L = cholesky(Y)
    if L is None:
        return None
    inverse = L.inv()
    upper = zip(inverse.tolist(), (inverse * X).tolist())
    lower = zip([[Arb(0)] * g] * g, L.transpose().tolist())
    P = ArbMat([[*left, *right] for left, right in (*upper, *lower)])
    M = P * D * P.transpose()
    return (M + M.transpose()) / 2


def _largest_excess(M: ArbMat) -> Arb:
    """An exact η such that (1 + η) 1 − M is positive definite, hardly larger than necessary."""
    n = M.nrows()
    identity = ArbMat([[int(i == j) for j in range(n)] for i in range(n)])
    E = M - identity
    # Gershgorin's bound first: it also says on which scale to look.
    rows = [sum((abs(x) for x in row), Arb(0)).upper() for row in E.tolist()]
    outer = max(rows, default=Arb(0))
    if not outer.is_finite():
        raise ComplexError("the energies are known too badly for a period matrix.")
    if outer == 0:
        return Arb(0)
    unit = Arb(2) ** exponent_of(outer)
    scaled = E / unit
    midpoint = np.array([float(x.mid()) for x in scaled.entries()]).reshape(n, n)
    radius = max(float(x.rad()) for x in scaled.entries())
    guess = max(float(np.linalg.eigvalsh(midpoint)[-1]) + n * radius, 1e-3 * float(outer / unit))
    for factor in _SHARPNESS:
        eta = Arb(factor * guess)
        if cholesky(eta * identity - scaled) is not None:
            return (eta * unit).upper()
    return (outer * Arb(1.0 + 1e-9)).upper()


def _symmetric(A: ArbMat) -> ArbMat:
    return ((A + A.transpose()) / 2).mid()
