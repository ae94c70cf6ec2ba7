r"""Pairwise reduction of a canonical basis: making energies small two classes at a time.

Write v_1, …, v_2g for α_1..α_g, β_1..β_g, i* for the index of the partner of v_i, and
:math:`\sigma_i = \int v_i \wedge v_{i^*} = \pm 1` (+ for an α).  For j ≠ i, i* and an integer k

.. math:: v_i \mathrel{+}= k\, v_j, \qquad v_{j^*} \mathrel{-}= k\, \sigma_i \sigma_j\, v_{i^*}

leads to a canonical basis again: of all pairings only that of v_i with v_{j*} could change.  The
first changes it by k σ_j, the second by −k σ_i σ_j σ_i, and these cancel.  So does, alone,
:math:`v_i \mathrel{+}= k\, v_{i^*}`, because a class has no pairing with itself.  With D the matrix
of energies, these moves change trace D by

.. math:: 2 k N + k^2 S, \qquad N = D_{ij} - \sigma_i \sigma_j D_{i^* j^*}, \quad
          S = D_{jj} + D_{i^* i^*},

and by half of that for j = i*.  It is least for k the integer nearest to −N/S, and negative then,
unless k = 0.  Every move makes the trace smaller; since D is positive definite there are only
finitely many integer bases whose trace is below a number, and the moves come to an end.  Then
|N| ≤ S/2 for all pairs: the basis is reduced in all its pairs at once, as Gauss reduces a form in
two variables.

Moves that have no partner pair in common do not concern each other: their gains add up.  So each
round makes the best such moves that do not meet, best first.  A round costs O(g) for every class
that it touches; the best partner of every other one is kept.  The first round is O(g²), memory
too; U D Uᵀ from the result, O(g³), is left to the caller.

Pairwise reduction does not meet the definition of LLL or Siegel.  But it is done in a moment,
treats α and β alike, and leaves little for the expensive steps to do.
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.run_log import progress

# A move must gain this much, relative to the energies that it concerns: less may be rounding.
_LEAST_GAIN = 1e-9
# Integers above this end the reduction: D is too far from round for its digits to tell the moves.
_LARGE = 2.0**40
_LARGEST_MULTIPLE = 2.0**20
# There are seldom a few hundred rounds; without exact energies an end is not certain.
_MOST_ROUNDS = 10_000
# Numbers looked at together.
_NUMBERS_AT_ONCE = 2_000_000


def pairwise_reduction(D: Floats) -> Ints:
    """A canonical basis of small energies: U with ``U J Uᵀ = J`` exactly, trace U D Uᵀ small.

    Parameters
    ----------
    D : (2g, 2g) float
        Symmetric, positive definite: energies of α_1..α_g, β_1..β_g.

    Returns
    -------
    (2g, 2g) int
        It acts on forms; on period matrices acts γ = K U K, K = diag(1, −1)
        (:func:`igl_periods.symplectic.canonical_basis.form_action`).
    """
    D, U = D.copy(), np.eye(len(D), dtype=np.int64)
    gain, other = _best_moves(D, np.arange(len(D)))
    total = 0
    for _ in range(_MOST_ROUNDS):
        i = _disjoint(gain, other)
        if i.size == 0:
            break
        j = other[i]
        planes = np.unique(np.concatenate([i, j]) % (len(D) // 2))
        _move(D, U, i, j)
        if np.abs(U[i]).max() > _LARGE:
            break
        _refresh(D, gain, other, planes)
        total += len(i)
        progress("pairwise moves", total)
    return U


def _partner(i: Ints, size: int) -> Ints:
    return (i + size // 2) % size


def _sign(i: Ints, size: int) -> Ints:
    return np.where(i < size // 2, 1, -1)


def _best_moves(D: Floats, rows: Ints) -> tuple[Floats, Ints]:
    """The largest gain of moving each v_i, i in ``rows``, and the j that achieves it."""
    gain, other = np.empty(len(rows)), np.empty(len(rows), dtype=np.int64)
    step = max(_NUMBERS_AT_ONCE // max(len(D), 1), 1)
    for start in range(0, len(rows), step):
        part = slice(start, start + step)
        gains = _gains(D, rows[part])
        other[part] = np.argmax(gains, axis=1)
        gain[part] = gains[np.arange(len(gains)), other[part]]
    return gain, other


def _gains(D: Floats, i: Ints) -> Floats:
    """What moving each v_i by each v_j takes from the trace of D; (len(i), 2g)."""
    n = len(D)
    g, i_star, every = n // 2, _partner(i, n), np.arange(len(i))
    sign, crossed = _sign(i, n)[:, None], D[i_star]
    N = D[i]
    N[:, :g] -= sign * crossed[:, g:]
    N[:, g:] += sign * crossed[:, :g]
    energy = np.diagonal(D)
    S = energy + energy[i_star, None]
    crossed[:] = 0.0
    k = np.rint(np.divide(N, S, out=crossed, where=S > 0), out=crossed)
    # −2kN − k²S with k = −rint(N/S).
    N *= 2.0
    S_k = S * k
    N -= S_k
    gains = np.multiply(N, k, out=N)
    gains[every, i_star] *= 0.5
    gains[every, i] = 0.0
    gains[gains < _LEAST_GAIN * S] = 0.0
    return gains


def _disjoint(gain: Floats, other: Ints) -> Ints:
    """Indices i whose moves gain most and have no partner pair in common, best first."""
    g = len(gain) // 2
    candidates = np.flatnonzero(gain > 0)
    free = np.ones(g, dtype=bool)
    chosen = []
    for i in candidates[np.argsort(-gain[candidates], kind="stable")]:
        p, q = i % g, other[i] % g
        if free[p] and free[q]:
            free[p] = free[q] = False
            chosen.append(i)
    return np.array(chosen, dtype=np.int64)


def _move(D: Floats, U: Ints, i: Ints, j: Ints) -> None:
    """Make the moves of v_i by v_j, which have no partner pair in common, in place."""
    n = len(D)
    i_star, j_star, sign = _partner(i, n), _partner(j, n), _sign(i, n) * _sign(j, n)
    k = -np.rint((D[i, j] - sign * D[i_star, j_star]) / (D[j, j] + D[i_star, i_star]))
    # A smaller multiple is a gain too.
    k = np.clip(k, -_LARGEST_MULTIPLE, _LARGEST_MULTIPLE)
    two = j != i_star
    target = np.concatenate([i, j_star[two]])
    source = np.concatenate([j, i_star[two]])
    multiple = np.concatenate([k, (-k * sign)[two]])
    D[target] += multiple[:, None] * D[source]
    D[:, target] += D[:, source] * multiple
    U[target] += multiple.astype(np.int64)[:, None] * U[source]


def _refresh(D: Floats, gain: Floats, other: Ints, planes: Ints) -> None:
    """Find the best moves again where D has changed, in the rows and columns of some planes.

    The move of v_i by v_j is that of v_{j*} by v_{i*}: if i is in none of these planes and j is,
    it is found in the row of j*.
    """
    touched = np.zeros(len(D), dtype=bool)
    touched[np.concatenate([planes, planes + len(D) // 2])] = True
    rows = np.flatnonzero(touched | touched[other])
    gain[rows], other[rows] = _best_moves(D, rows)
