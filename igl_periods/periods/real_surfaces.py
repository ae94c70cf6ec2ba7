r"""The real structure of the period matrix of a double.

The double of a surface (:func:`igl_periods.double`) has an isometry σ that reverses the
orientation.  So its period matrix is *real*, in the sense that there is an integer matrix γ with

.. math:: \gamma J \gamma^T = -J, \qquad
          (a \bar\Pi + b)(c \bar\Pi + d)^{-1} = \Pi, \qquad
          \gamma = \begin{pmatrix} a & b \\ c & d \end{pmatrix}.

With S the action of σ on a canonical basis of cohomology, σ*ω_i ~ Σ_j S_ij ω_j, and
:math:`S = \begin{pmatrix} p & q \\ r & s \end{pmatrix}`, it is
:math:`\gamma = \begin{pmatrix} s^T & q^T \\ r^T & p^T \end{pmatrix}`: if ζ is the normalised basis
of holomorphic forms, :math:`(1, \Pi)` in terms of the basis of cohomology, then
:math:`\overline{\sigma^* \zeta}` is a basis of them too, with the coefficients
:math:`(p + \bar\Pi r, q + \bar\Pi s)`, and normalised it has to be ζ again.

References
----------
Gross, Harris, "Real algebraic curves" (1981).
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Ints
from igl_periods.complexes import involution
from igl_periods.symplectic import standard_form
from igl_periods.topology import pairing

from .matrix import PeriodMatrix, check_period_matrix


def real_structure(pm: PeriodMatrix) -> Ints:
    """The integer matrix γ by which the involution of a double makes its period matrix real.

    Parameters
    ----------
    pm : PeriodMatrix
        Of a surface that :func:`double` returned, in any marking.

    Returns
    -------
    (2g, 2g) int
        γ with γ J γᵀ = −J and, with Π the exact period matrix,
        (a Π̄ + b)(c Π̄ + d)⁻¹ = Π.

    Raises
    ------
    ComplexError
        If ``pm.complex`` is not a double.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.planar_domain([0, 4, 4 + 4j, 4j], [[1 + 1j, 3 + 1j, 3 + 3j, 1 + 3j]])
    >>> pm = ip.period_matrix(ip.double(ip.DeltaComplex.from_mesh(V, F)))
    >>> ip.real_structure(pm)
    array([[-1,  0],
           [ 0,  1]])
    """
    check_period_matrix(pm)
    g = pm.genus
    S = _action(pm)
    p, q, r, s = S[:g, :g], S[:g, g:], S[g:, :g], S[g:, g:]
    return np.block([[s.T, q.T], [r.T, p.T]])


def _action(pm: PeriodMatrix) -> Ints:
    """The matrix S with σ*ω_i ~ Σ S_ij ω_j, from the pairings ∫ σ*ω_i ∧ ω_j = (S J)_ij."""
    moved = involution(pm.complex).pull_back(pm.cocycles)
    return pairing(pm.complex, moved, pm.cocycles) @ -standard_form(pm.genus)
