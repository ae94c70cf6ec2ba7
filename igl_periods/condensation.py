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
from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import ThreadpoolController

from .cone_element import ReferenceElement, reference_element
from .delta_complex import DeltaComplex
from .triangles import cotangents

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Numbers that are worked on at once: few enough to stay in the cache.
_NUMBERS_AT_ONCE = 2**19


@dataclass(frozen=True, eq=False)
class Elements:
    """The faces that carry the same reference element, and their shapes seen from the apex.

    Attributes
    ----------
    reference : ReferenceElement
    face : (m,) int
        The faces, ascending.
    apex : (m,) int
        The corner of each that is the apex.
    aspect : (m,) float
        Height over length of the side opposite the apex.
    foot : (m,) float
        Where the foot of that height lies on the side: 0 at corner apex + 1, 1 at apex + 2.
    kappa : (m,) float
        The exponent 2π/θ of the cone at the apex, 1 on flat elements.
    """

    reference: ReferenceElement
    face: Ints
    apex: Ints
    aspect: Floats
    foot: Floats
    kappa: Floats

    def blocks(self, numbers_per_face: int) -> Iterator[Ints]:
        """Runs of the indices 0 … m - 1, short enough to be worked on at once."""
        size = max(1, _NUMBERS_AT_ONCE // max(numbers_per_face, 1))
        for start in range(0, self.face.size, size):
            yield np.arange(start, min(start + size, self.face.size))


def shaped_elements(
    K: DeltaComplex, reference: ReferenceElement, face: Ints, apex: Ints, kappa: Floats
) -> Elements:
    """Elements on the given faces, with the shapes that the lengths of the sides determine."""
    cot = cotangents(K.lengths[face])
    row = np.arange(face.size)
    cot_a, cot_b = cot[row, (apex + 1) % 3], cot[row, (apex + 2) % 3]
    aspect = 1.0 / (cot_a + cot_b)
    return Elements(reference, face, apex, aspect, aspect * cot_a, kappa)


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
    with _blas().limit(limits=1), ThreadPoolExecutor(os.cpu_count()) as pool:
        for block, (S, E) in zip(blocks, pool.map(lambda b: condense_block(elements, b), blocks)):
            yield block, S, E


@cache
def _blas() -> ThreadpoolController:
    return ThreadpoolController()


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
    terms = _stiffness_terms(elements.reference.degree, elements.reference.conical)
    n = elements.reference.n_functions
    return (np.stack(weights, axis=1) @ terms).reshape(-1, n, n)


@lru_cache(maxsize=64)
def _stiffness_terms(degree: int, conical: bool) -> Floats:
    """The six matrices that :func:`stiffness` combines, as rows; s is counted from 1/2."""
    reference = reference_element(degree, conical)
    P, Q = reference.by_tau, reference.by_s
    moment = (reference.nodes - 0.5)[:, None] * Q
    mixed, central = P.T @ moment, P.T @ Q
    terms = np.stack(
        [P.T @ P, mixed + mixed.T, central + central.T, moment.T @ moment, moment.T @ Q, Q.T @ Q]
    )
    rows = terms.reshape(6, -1)
    rows.setflags(write=False)
    return rows


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
    reference, columns = elements.reference, coefficients.reshape(n, b * k)
    aspect, foot, kappa = (a[block, None] for a in (elements.aspect, elements.foot, elements.kappa))
    shape = (reference.nodes.size, b, k)
    u_tau = (reference.by_tau @ columns).reshape(shape)
    u_s = (reference.by_s @ columns).reshape(shape)
    across = (reference.nodes[:, None, None] - foot) * u_s
    yield np.sqrt(kappa / aspect) * u_tau - across / np.sqrt(kappa * aspect)
    yield np.sqrt(aspect / kappa) * u_s
