r"""Integer homology of a surface, exactly: canonical bases, cycles, cuts.

A spanning tree of the vertices and a spanning tree of the faces that crosses none of its edges
leave 2g edges over.  Each closes a loop of faces, whose signed crossing numbers with the edges are
a closed integer cochain.  Their pairing :math:`\int \alpha \wedge \beta` is integer and unimodular,
and a symplectic Gram–Schmidt process makes a *canonical basis* of them,

.. math:: \int \alpha_i \wedge \beta_j = \delta_{ij}, \qquad
          \int \alpha_i \wedge \alpha_j = \int \beta_i \wedge \beta_j = 0 .

The canonical cycles are its dual basis, :math:`\oint_{a_j} \alpha_i = \delta_{ij} =
\oint_{b_j} \beta_i`, with the intersection numbers **a_i · b_j = δ_ij**.  Cocycles are sparse
matrices (2g, n_edges), cycles closed walks of half-edges h = 3 f + s.  Nothing is rounded, and the
same complex always gets the same basis.

=====================  ========================================================================
``spanning_trees``     tree and cotree
``cohomology``         the cochains of the cotree, their pairing, the canonical basis
``cycles``             canonical cycles as walks along edges
``short_cycles``       short walks in the same classes
``dual_cycles``        canonical cycles as walks across edges
``fundamental_group``  the fundamental polygon, shortest loops at a vertex
``cuts``               a cut that makes the surface a disk
=====================  ========================================================================

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Eppstein, "Dynamic generators of topologically embedded graphs" (2003).
"""

from .spanning_trees import tree_cotree
from .cohomology import cochains_and_basis, cohomology_basis, mark, pairing
from .cycles import homology_basis
from .short_cycles import canonical_cycles
from .dual_cycles import crossing_cochain, dual_homology_basis, dual_walk
from .fundamental_group import FundamentalPolygon, fundamental_polygon, shortest_loops
from .cuts import cut_to_disk

__all__ = [
    "tree_cotree",
    "cochains_and_basis",
    "cohomology_basis",
    "mark",
    "pairing",
    "homology_basis",
    "canonical_cycles",
    "dual_homology_basis",
    "FundamentalPolygon",
    "fundamental_polygon",
    "shortest_loops",
    "cut_to_disk",
    "crossing_cochain",
    "dual_walk",
]
