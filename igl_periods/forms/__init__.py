r"""The discrete theory of the paper on the double graph Λ = Γ ⊕ Γ*.

Γ is a Delaunay triangulation, Γ* its dual graph.  A function is a number for every vertex of Λ, a
1-form α one for every edge; with positive weights ρ the Hodge star is

.. math:: \int_{e^*} {*\alpha} = \rho(e) \int_e \alpha, \qquad
          \int_e {*\alpha} = -\frac{1}{\rho(e)} \int_{e^*} \alpha,

so that :math:`*^2 = -1`, and α is of type (1, 0) iff :math:`*\alpha = -i\alpha`.  From it follow
the scalar product, Laplacians, energies, the Hodge decomposition, and the holomorphic forms: of
type (1, 0) and closed, 2g-dimensional, since Γ and Γ* are independent of each other.  Normalised by
their a-periods on both graphs, the b-periods on Γ are the *primal* and those on Γ* the *dual*
estimate of the period matrix.

===============  ==============================================================================
``graph``        the double graph of a triangulation
``calculus``     d, its adjoint, Hodge star, wedge product, energies, types
``quad_graph``   the same on the quadrilaterals ◊, where forms can be multiplied by functions
``hodge``        the Hodge decomposition
``holomorphic``  holomorphic forms and their periods
===============  ==============================================================================

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", sections 2 and 3.
Mercat, "Discrete Riemann surfaces and the Ising model" (2001).
"""

from .graph import DoubleGraph, double_graph
from .calculus import (
    adjoint_d0,
    adjoint_d1,
    area,
    conformal_energy,
    d0,
    d1,
    derivatives,
    dirichlet_energy,
    hodge_star,
    is_holomorphic,
    is_holomorphic_form,
    laplacian_0,
    laplacian_1,
    scalar_product,
    type_01,
    type_10,
    wedge,
)
from .hodge import HodgeDecomposition, hodge_decomposition
from .holomorphic import holomorphic_forms, periods, symplectic_mean_forms
from .quad_graph import (
    on_diagonals,
    quad_product,
    side_d0,
    side_d1,
    side_ends,
    side_product,
    side_wedge,
)

__all__ = [
    "double_graph",
    "DoubleGraph",
    "adjoint_d0",
    "adjoint_d1",
    "area",
    "conformal_energy",
    "d0",
    "d1",
    "derivatives",
    "dirichlet_energy",
    "hodge_star",
    "is_holomorphic",
    "is_holomorphic_form",
    "laplacian_0",
    "laplacian_1",
    "scalar_product",
    "type_01",
    "type_10",
    "wedge",
    "HodgeDecomposition",
    "hodge_decomposition",
    "holomorphic_forms",
    "symplectic_mean_forms",
    "side_ends",
    "side_d0",
    "side_d1",
    "side_wedge",
    "side_product",
    "quad_product",
    "on_diagonals",
    "periods",
]
