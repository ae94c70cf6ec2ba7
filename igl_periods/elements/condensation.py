r"""Energies of trial functions on many faces at once, and static condensation of their bubbles.

The energy of a trial function on a face is a quadratic form in its coefficients: those of its
traces on the sides, u, and those of its bubbles, v, which no other face sees,

.. math::  \begin{pmatrix} u \\ v \end{pmatrix}^T
           \begin{pmatrix} K_{uu} & K_{uv} \\ K_{vu} & K_{vv} \end{pmatrix}
           \begin{pmatrix} u \\ v \end{pmatrix}.

It is least for v = E u with :math:`E = -K_{vv}^{-1} K_{vu}`, and then equals uᵀ S u with the Schur
complement :math:`S = K_{uu} + K_{uv} E`.  Only the traces remain for the sparse system.

The matrices K serve to find the minimum.  The energy of the functions found is summed from the
squares of their gradients (:func:`scaled_gradients`): it is the energy of the functions that the
coefficients stand for, and errors of K or of the solver can only raise it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.machine import one_thread

from .placement import Elements


def condense(elements: Elements) -> Iterator[tuple[Ints, Floats, Floats]]:
    """Schur complements and extensions of all elements, block by block.

    Blocks are worked on in parallel, one thread each: threads within the small matrices of one
    face would only be in each other's way.

    Yields
    ------
    block : (b,) int
    S : (b, 3p, 3p) float
    E : (b, n - 3p, 3p) float
    """
    blocks = list(elements.blocks(elements.reference.n_functions**2))
    with one_thread(), ThreadPoolExecutor(os.cpu_count()) as pool:
        for block, (S, E) in zip(blocks, pool.map(lambda b: condense_block(elements, b), blocks)):
            yield block, S, E


def condense_block(elements: Elements, block: Ints) -> tuple[Floats, Floats]:
    """Schur complements and extensions of some elements; (b, 3p, 3p) and (b, n - 3p, 3p)."""
    n = elements.reference.n_traces
    K = stiffness(elements, block)
    coupling = K[:, n:, :n]
    extension = np.negative(np.linalg.solve(K[:, n:, n:], coupling), dtype=np.float64)
    return K[:, :n, :n] + coupling.transpose(0, 2, 1) @ extension, extension


def stiffness(elements: Elements, block: Ints) -> Floats:
    """Matrices of the Dirichlet energy of some elements; (b, n, n)."""
    aspect, kappa = elements.aspect[block], elements.kappa[block]
    foot = elements.foot[block] - 0.5
    angular = 1.0 / (aspect * kappa)
    weights = [
        kappa / aspect,
        -1.0 / aspect,
        foot / aspect,
        angular,
        -2.0 * foot * angular,
        foot**2 * angular + aspect / kappa,
    ]
    n = elements.reference.n_functions
    return (np.stack(weights, axis=1) @ elements.reference.stiffness_terms).reshape(-1, n, n)


def scaled_gradients(elements: Elements, block: Ints, coefficients: Floats) -> Iterator[Floats]:
    """Gradients of functions on some elements, at the quadrature points.

    Parameters
    ----------
    coefficients : (n, b, k) float

    Yields
    ------
    X : (q, b, k) float
        The derivatives along the sides opposite the apex, then those along the heights, times the
        roots of the weights: Σ X² over both is the energy.
    """
    n, b, k = coefficients.shape
    points, columns = elements.reference.quadrature, coefficients.reshape(n, b * k)
    aspect, foot, kappa = (a[block, None] for a in (elements.aspect, elements.foot, elements.kappa))
    shape = (points.nodes.size, b, k)
    u_tau = (points.by_tau @ columns).reshape(shape)
    u_s = (points.by_s @ columns).reshape(shape)
    across = (points.nodes[:, None, None] - foot) * u_s
    yield np.sqrt(kappa / aspect) * u_tau - across / np.sqrt(kappa * aspect)
    yield np.sqrt(aspect / kappa) * u_s


def transposed_gradients(elements: Elements, block: Ints, along: Floats, down: Floats) -> Floats:
    """The transpose of :func:`scaled_gradients`: from the points back to coefficients.

    Parameters
    ----------
    along, down : (q, b, k) float

    Returns
    -------
    (n, b, k) float
    """
    q, b, k = along.shape
    points = elements.reference.quadrature
    aspect, foot, kappa = (a[block, None] for a in (elements.aspect, elements.foot, elements.kappa))
    tilt = (points.nodes[:, None, None] - foot) / np.sqrt(kappa * aspect)
    by_tau = np.sqrt(kappa / aspect) * along
    by_s = np.sqrt(aspect / kappa) * down - tilt * along
    flat = points.by_tau.T @ by_tau.reshape(q, b * k) + points.by_s.T @ by_s.reshape(q, b * k)
    return flat.reshape(-1, b, k)
