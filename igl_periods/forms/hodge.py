r"""Hodge decomposition of 1-forms on the double graph.

Every 1-form on Λ is in exactly one way a sum

.. math:: \alpha = df + {*dg} + h, \qquad dh = d{*h} = 0,

of an exact, a co-exact and a harmonic form, orthogonal to each other.  The star interchanges Γ and
Γ*, exact and co-exact forms.  So on Γ the function f solves L f = d*α with the Laplacian L of Γ,
and h is a projection on the 2g harmonic forms of Γ; what remains is co-exact.  The function g on Γ
solves the same equation with −*α in place of α; *dg lives on Γ*, and what remains there is exact.
Nothing is solved on Γ*, where an edge with nearly cocircular triangles has a huge weight 1/ρ.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from igl_periods.arrays import Values
from igl_periods.display import facts_html, shape_in_words
from igl_periods.harmonic import factored_laplacian, harmonic_basis, solutions

from .calculus import adjoint_d0, d1
from .graph import DoubleGraph


class HodgeDecomposition(NamedTuple):
    """The three orthogonal parts of a 1-form on Λ, each of shape (…, 2, n_edges).

    Attributes
    ----------
    exact : differentials of functions on Λ
    coexact : Hodge stars of such
    harmonic : closed and co-closed
    """

    exact: Values
    coexact: Values
    harmonic: Values

    def __repr__(self) -> str:
        return f"HodgeDecomposition(exact, coexact, harmonic: {shape_in_words(self.exact)} each)"

    def _repr_html_(self) -> str:
        names = zip(self._fields, ("d f", "*d g", "closed and co-closed"))
        size = shape_in_words(self.exact)
        return facts_html("HodgeDecomposition", [(n, f"{what}, {size}") for n, what in names])


def hodge_decomposition(graph: DoubleGraph, alpha: Values) -> HodgeDecomposition:
    """Split a 1-form on Λ into its exact, co-exact and harmonic parts.

    Parameters
    ----------
    graph : DoubleGraph
    alpha : (…, 2, n_edges)
        Any 1-form, real or complex.

    Returns
    -------
    HodgeDecomposition
        Named tuple (exact, coexact, harmonic) of arrays of the shape of ``alpha``.

    References
    ----------
    Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 2.

    Examples
    --------
    >>> import igl_periods as ip
    >>> import numpy as np
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> K = ip.DeltaComplex.from_mesh(V, F)
    >>> graph = ip.double_graph(K)
    >>> alpha = np.random.default_rng(0).normal(size=(2, len(graph.edges)))
    >>> parts = ip.hodge_decomposition(graph, alpha)
    >>> np.allclose(parts.exact + parts.coexact + parts.harmonic, alpha)
    True
    """
    omega, D = harmonic_basis(graph.complex, graph.weights)
    omega = omega[:, graph.edges]
    # The parts on Γ* are stars of parts on Γ: *dg of a function g, and *ω.
    source = np.stack([adjoint_d0(graph, alpha), -d1(graph, alpha)], axis=-2)
    f = _green(graph, source[..., : graph.complex.n_vertices])
    star = np.stack([np.ones(graph.n_edges), graph.rho])
    gradient = star * (f[..., graph.head[0]] - f[..., graph.tail[0]])
    flux = star[::-1] * alpha
    harmonic = star * (flux @ np.linalg.solve(D, omega).T @ omega)
    rest = alpha - gradient - harmonic
    on_gamma = np.array([[True], [False]])
    return HodgeDecomposition(
        exact=np.where(on_gamma, gradient, rest),
        coexact=np.where(on_gamma, rest, gradient),
        harmonic=harmonic,
    )


def _green(graph: DoubleGraph, source: Values) -> Values:
    """The functions f on Γ, 0 at vertex 0, with L f = source; (…, vertices of Γ)."""
    factor = factored_laplacian(graph.complex, graph.weights)
    columns = source.reshape(-1, source.shape[-1]).T
    f = solutions(factor, columns.real)
    if np.iscomplexobj(columns):
        f = f + 1j * solutions(factor, columns.imag)
    return f.T.reshape(source.shape)
