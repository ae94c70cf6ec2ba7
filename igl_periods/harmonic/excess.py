r"""Where on the surface the bound of a period matrix comes from.

Let D be the Dirichlet matrix of closed forms in a basis of cohomology, d_1 ≥ … ≥ d_g its symplectic
eigenvalues, and x_1..x_g, y_1..y_g forms, real combinations of the given ones, in terms of which
D = diag(d, d) and the pairing is standard, ∫ x_i ∧ y_j = δ_ij.  On the exact surface
:math:`*y_i = -x_i`; of the computed forms

.. math:: \tfrac12 \| x_i + {*y_i} \|^2 = \tfrac12 (d_i + d_i) - \int x_i \wedge y_i = d_i - 1 .

The left side is an integral over the surface of something that is nowhere negative.  So every
face has its share of d_i − 1, and since the bound is d_1 − 1, of the bound: exactly, it is no
estimate (the hypercircle of Prager and Synge).

References
----------
Prager, Synge, "Approximations in elasticity based on the concept of function space" (1947).
Dörfler, "A convergent adaptive algorithm for Poisson's equation" (1996).
"""

from __future__ import annotations

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, edge_ends
from igl_periods.symplectic import williamson_basis

from .constant_forms import face_areas, gradients
from .rounding import energy_factor


def energy_excess(K: DeltaComplex, cochains: csr_array, potentials: Floats, D: Floats) -> Floats:
    """The shares of all faces in Σ (d_i − 1).

    Parameters
    ----------
    K : DeltaComplex
        The complex on which the forms c + df live.
    cochains : (2g, n_edges) sparse
        A canonical basis of cohomology c.
    potentials : (n_vertices, 2g) float
        The functions f.
    D : (2g, 2g) float
        Dirichlet matrix of c + df.

    Returns
    -------
    (g, m) float
        Row i adds up to d_i − 1, where d is decreasing.
    """
    pairs = williamson_basis(energy_factor(D))
    shares = np.empty((len(pairs), K.n_faces))
    area, (tail, head) = face_areas(K), edge_ends(K)
    by_edge = csr_array(cochains.T)
    for share, pair in zip(shares, pairs, strict=True):
        f = potentials @ pair.T
        x, y = gradients(K, (by_edge @ pair.T + f[head] - f[tail]).T)
        share[:] = 0.5 * area * np.abs(x + 1j * y) ** 2
    return shares


def most_of(excess: Floats, part: float) -> Ints:
    """The fewest faces that hold this part of the excess, the worst first (Dörfler's marking)."""
    order = np.argsort(-excess, kind="stable")
    held = np.cumsum(excess[order])
    return order[: 1 + int(np.searchsorted(held, part * held[-1]))]
