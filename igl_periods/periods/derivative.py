r"""Derivatives of the period matrix by the lengths of edges, and by the positions of vertices.

Forward, a direction in which lengths (or vertices) move gives ∂Π, a complex matrix.  Backward, a
complex matrix W gives the gradient of the real function

.. math:: \phi = \operatorname{Re} \sum_{kl} \bar W_{kl}\, \Pi_{kl}

by all lengths, and by all positions.  So W = 1 at (k, l) asks for Re Π_kl, W = i for Im Π_kl; and
if f is a holomorphic function of Π with ∂f = Σ f'_kl ∂Π_kl, then W = conj(f') asks for Re f.

Lengths are those of the triangulation that was given, whatever flips were made to compute Π; where
four vertices lie on one circle, there are kinks (:mod:`igl_periods.complexes.flipped_lengths`).
With linear functions the derivative is that of the discrete Π, to rounding.  From degree 2 on it is
Rauch's formula :math:`\int \omega_i^T (\operatorname{tr} \epsilon - 2\epsilon)\, \omega_j` with the
forms at hand, for deformations that are linear on triangles: the derivative of the exact Π, with
an error of the order of the bound, exponentially small in the degree.  (Measured: 1 to 3 bounds for
deformations that are linear in space, up to 60 where every vertex moves at random.)

Noise of the vertices, of covariance Σ, makes the entries of Π uncertain: to first order their
covariance is J Σ Jᵀ, J the rows of gradients.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from igl_periods.arrays import Complexes, Floats
from igl_periods.complexes import DeltaComplex, edge_directions
from igl_periods.display import arrays_repr
from igl_periods.errors import ComplexError
from igl_periods.symplectic import EstimateDerivative

from .solved_forms import SolvedForms


@dataclass(frozen=True, eq=False)
class Gradient:
    """The gradient of a real function of the period matrix, or of several.

    Attributes
    ----------
    lengths : (…, n_edges) float
        By the lengths of the edges of ``complex``.
    vertices : (…, n_vertices, d) float or None
        By the positions of its vertices; None where it has none.
    """

    lengths: Floats
    vertices: Floats | None

    __repr__ = arrays_repr


@dataclass(frozen=True, eq=False)
class EntryCovariance:
    """How uncertain the entries of a period matrix are, to first order.

    Attributes
    ----------
    covariance : (2, g, g, 2, g, g) float
        Of the real (index 0) and imaginary parts (1) of all entries.
    """

    covariance: Floats

    __repr__ = arrays_repr

    @property
    def standard_deviations(self) -> Complexes:
        """Of the real parts, + i those of the imaginary parts; (g, g) complex."""
        re, im = np.sqrt(np.einsum("pijpij->pij", self.covariance))
        return np.asarray(re + 1j * im)


def derivative_along(
    K: DeltaComplex,
    forms: SolvedForms,
    estimate: EstimateDerivative,
    by_length: Floats,
) -> Complexes:
    """∂Π for directions of the lengths (…, n_edges); (…, g, g)."""
    rows = by_length.reshape(-1, K.n_edges)
    dPi = estimate.forward(forms.energy_derivatives(K, rows))
    return np.asarray(dPi.reshape(*by_length.shape[:-1], *dPi.shape[1:]))


def gradient_of(
    K: DeltaComplex, forms: SolvedForms, estimate: EstimateDerivative, W: Complexes
) -> Gradient:
    """The gradients of Re Σ W̄ Π for some W (…, g, g)."""
    S = estimate.backward(W.reshape(math.prod(W.shape[:-2]), *W.shape[-2:]))
    lengths = forms.length_gradients(K, S).reshape(*W.shape[:-2], K.n_edges)
    return Gradient(lengths, None if K.positions is None else _by_vertices(K, lengths))


def checked_directions(
    K: DeltaComplex, lengths: ArrayLike | None, vertices: ArrayLike | None
) -> Floats:
    """How lengths move, from what is given of the two.

    Raises
    ------
    ValueError
        Unless exactly one of them is given, of the right shape and finite.
    ComplexError
        If there are no positions.
    """
    if (lengths is None) == (vertices is None):
        raise ValueError("give either lengths=dl or vertices=dV, how one of the two moves.")
    if lengths is not None:
        return _checked(lengths, (K.n_edges,), "lengths")
    tail, head, unit = edge_directions(K)
    moved = _checked(vertices, (K.n_vertices, unit.shape[1]), "vertices")
    return np.asarray(np.sum((moved[..., head, :] - moved[..., tail, :]) * unit, axis=-1))


def checked_weights(W: ArrayLike, g: int) -> Complexes:
    """W as complex matrices (…, g, g); ValueError if it is something else."""
    matrix = np.asarray(W, dtype=np.complex128)
    if matrix.shape[-2:] != (g, g) or matrix.ndim < 2:
        raise ValueError(
            f"W has the shape of the period matrix, {(g, g)}, after any others; not {matrix.shape}."
        )
    if not np.isfinite(matrix).all():
        raise ValueError("W has entries that are not finite.")
    return matrix


def entry_weights(g: int) -> Complexes:
    """The W of the real and the imaginary parts of all entries; (2, g, g, g, g)."""
    unit = np.eye(g * g).reshape(g, g, g, g)
    return np.stack([unit, 1j * unit])


def noise_covariance(by_vertex: Floats, noise: ArrayLike) -> EntryCovariance:
    """J Σ Jᵀ for the gradients (2, g, g, n, d) of all entries.

    Parameters
    ----------
    noise : float, (n,), (n, d, d) or (n d, n d) array-like
        A standard deviation of all coordinates, or one for each vertex; or covariances of the
        positions, each vertex for itself or all together.

    Raises
    ------
    ValueError
        If it has none of these shapes, a standard deviation is negative, or a covariance is not
        symmetric.
    """
    n, d = by_vertex.shape[-2:]
    g = by_vertex.shape[1]
    sigma = np.asarray(noise, dtype=np.float64)
    J = by_vertex.reshape(2 * g * g, n, d)
    if not np.isfinite(sigma).all():
        raise ValueError("the noise of the vertices is not finite.")
    if sigma.shape in ((), (n,)):
        if (sigma < 0.0).any():
            raise ValueError("standard deviations are not negative.")
        scaled = J * np.broadcast_to(sigma, (n,))[:, None] ** 2
    elif sigma.shape in ((n, d, d), (n * d, n * d)):
        if not np.allclose(sigma, np.swapaxes(sigma, -1, -2)):
            raise ValueError("covariances are symmetric; these are not.")
        if sigma.ndim == 3:
            scaled = np.einsum("cnd,nde->cne", J, sigma)
        else:
            scaled = (J.reshape(len(J), -1) @ sigma).reshape(J.shape)
    else:
        raise ValueError(
            f"noise of {n} vertices in R^{d} is a number, or has the shape {(n,)}, {(n, d, d)} or "
            f"{(n * d, n * d)}; not {sigma.shape}."
        )
    covariance = J.reshape(len(J), -1) @ scaled.reshape(len(J), -1).T
    return EntryCovariance(covariance.reshape(2, g, g, 2, g, g))


def _checked(values: Any, shape: tuple[int, ...], name: str) -> Floats:
    array: NDArray[Any] = np.asarray(values)
    if array.dtype.kind not in "iuf" or array.shape[max(array.ndim - len(shape), 0) :] != shape:
        raise ValueError(
            f"{name} move by real numbers of the shape {shape}, after any others; not by "
            f"{array.shape} of {array.dtype}."
        )
    if not np.isfinite(array).all():
        raise ValueError(f"the directions of the {name} are not finite.")
    return array.astype(np.float64)


def _by_vertices(K: DeltaComplex, by_length: Floats) -> Floats | None:
    try:
        tail, head, unit = edge_directions(K)
    except ComplexError:
        return None
    n, d = K.n_vertices, unit.shape[1]
    rows = by_length.reshape(-1, K.n_edges)
    found = np.empty((len(rows), n, d))
    for out, row in zip(found, rows):
        for axis in range(d):
            force = row * unit[:, axis]
            out[:, axis] = np.bincount(head, force, n) - np.bincount(tail, force, n)
    return found.reshape(*by_length.shape[:-1], n, d)
