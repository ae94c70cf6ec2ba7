r"""The marking of one surface in which its period matrix is nearest to another one.

Two surfaces may be close in moduli space while their matrices are far apart, for want of markings
that correspond.  Wanted is γ with γ·Π near Π₀.  All γ under a tolerance t are enumerated
(:mod:`igl_periods.moduli.equivalence`).  Any other γ has max |log λ| > t, hence Siegel distance
above t: so where the nearest of those found is at a distance of at most t, it is the nearest of
all.  Beyond that, what both Siegel reductions suggest is changed by transvections

.. math:: T_v(x) = x + \langle x, v \rangle\, v

(the best few markings are kept in each round).  That is a search, and proves nothing.
"""

from __future__ import annotations

from itertools import combinations, product
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Complexes, Ints
from igl_periods.siegel import (
    check_same_genus,
    siegel_distance,
    siegel_reduce,
    siegel_transform,
)
from igl_periods.symplectic import energy_matrix, form_action, standard_form, unimodular_inverse
from igl_periods.symplectic import product as integer_product

from .equivalence import symplectic_isomorphisms

_TOLERANCES = (0.1, 0.35, 0.69)
# Transvections along vectors with up to so many entries, each 1 or −1, are tried.
_MOST_ENTRIES = 4
# Markings that are followed at a time, and passes without success that end the search.
_BEAM = 24
_IDLE_PASSES = 3


class NearestMarking(NamedTuple):
    """A change of marking and what it achieves.

    Attributes
    ----------
    gamma : (2g, 2g) int
    distance : float
        Siegel's, of γ·Π and the other matrix.
    proved : bool
        Whether no other γ comes nearer.
    """

    gamma: Ints
    distance: float
    proved: bool


def nearest_marking(Pi: ArrayLike, other: ArrayLike) -> NearestMarking:
    """The γ for which γ·Π is nearest to another period matrix.

    Parameters
    ----------
    Pi, other : (g, g) array-like or PeriodMatrix
        Taken as they are, whatever their bounds.

    Raises
    ------
    NotASiegelPointError
        If one of them is not a point of the Siegel upper half-space.
    ValueError
        If they have different genus.

    Examples
    --------
    >>> found = nearest_marking([[0.5j]], [[2.01j]])
    >>> found.gamma.tolist(), found.proved
    ([[0, 1], [-1, 0]], True)
    """
    moving, fixed = check_same_genus(Pi, other)
    if len(moving) == 0:
        return NearestMarking(np.zeros((0, 0), dtype=np.int64), 0.0, True)
    for tolerance in _TOLERANCES:
        nearest = _enumerated(moving, fixed, tolerance)
        if nearest is not None and nearest.distance <= tolerance:
            return nearest
    searched = _searched(moving, fixed)
    return searched if nearest is None or searched.distance < nearest.distance else nearest


def _enumerated(moving: Complexes, fixed: Complexes, tolerance: float) -> NearestMarking | None:
    found = symplectic_isomorphisms(moving, fixed, tolerance)
    distances = [siegel_distance(siegel_transform(gamma, moving), fixed) for gamma in found]
    if not distances:
        return None
    best = int(np.argmin(distances))
    return NearestMarking(
        found[best], distances[best], found.complete and distances[best] <= tolerance
    )


def _searched(moving: Complexes, fixed: Complexes) -> NearestMarking:
    """A search by transvections from where both matrices are reduced.

    The forms U ω have the energies U G Uᵀ, and tr G₀⁻¹ U G Uᵀ = Σ (λ + 1/λ) is small where the λ
    are near 1.
    """
    (here, gamma), (there, gamma_there) = siegel_reduce(moving), siegel_reduce(fixed)
    G, inverse = energy_matrix(here), np.linalg.inv(energy_matrix(there))
    moves = _transvections(len(here))
    known: dict[bytes, float] = {}
    beam = [np.eye(len(G), dtype=np.int64)]
    best, least, idle = beam[0], float(np.trace(inverse @ G)), 0
    while idle < _IDLE_PASSES:
        tried = np.concatenate([moves @ U for U in beam])
        traces = np.einsum("ij,njk,kl,nil->n", inverse, tried, G, tried, optimize=True)
        order = np.argsort(traces, kind="stable")
        beam = []
        for k in order:
            if len(beam) == _BEAM:
                break
            key = tried[k].tobytes()
            if key not in known:
                known[key] = float(traces[k])
                beam.append(tried[k])
        idle += 1
        if traces[order[0]] < least * (1.0 - 1e-9):
            best, least, idle = tried[order[0]], float(traces[order[0]]), 0
    moved = integer_product(form_action(best).astype(np.int64), gamma)
    total = integer_product(unimodular_inverse(gamma_there), moved)
    return NearestMarking(total, siegel_distance(siegel_transform(total, moving), fixed), False)


def _transvections(g: int) -> Ints:
    """The transvections 1 ± v vᵀJ along short v; (N, 2g, 2g)."""
    J, size = standard_form(g), 2 * g
    moves = []
    for count in range(1, min(_MOST_ENTRIES if g < 4 else 2, size) + 1):
        for places in combinations(range(size), count):
            for signs in product((1, -1), repeat=count - 1):
                v = np.zeros((size, 1), dtype=np.int64)
                v[list(places), 0] = 1, *signs
                twist = v @ v.T @ J
                moves += [np.eye(size, dtype=np.int64) + k * twist for k in (1, -1)]
    return np.array(moves)
