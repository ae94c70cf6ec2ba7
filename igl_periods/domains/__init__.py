r"""Domains with holes: capacities, extremal lengths, and conformal maps onto slit domains.

A domain, or any surface K with boundary loops C_1 … C_n, has a double, and engineers know the
period matrix of that by other names.  The harmonic function u_i that is 1 on C_i and 0 on the other
loops gives the capacity matrix

.. math:: C_{ij} = \int_K \nabla u_i \cdot \nabla u_j = 2\, D(\beta_i, \beta_j)

of conductors C_1 … C_n, where β_i is the class on the double that a path through C_i meets once.
For a plane domain it is :math:`2\, (\operatorname{Im} \Pi)^{-1}`, in the marking whose a-cycles are
C_2 … C_n.  So both sides of :math:`J D^{-1} J^T \le D_{exact} \le D` bound it, in the Loewner order
and entry by entry.

========================  ======================================================================
``domain_files``          polygons with holes from GeoJSON and SVG
``boundary_classes``      the loops, and the classes that they make on the double
``measures``              the functions u_i
``capacities``            the capacity matrix between its bounds
``conjugate_blocks``      both blocks of energies, of surfaces with handles too
``capacity_balls``        the same in balls, to as many digits as are asked for
``homogenisation``        effective conductivities of periodic surfaces and plates
``quadrilaterals``        extremal lengths between two of four sides
``slit_maps``             conformal maps onto annuli and rectangles with slits
``functions_with_poles``  analytic functions with poles, constant in part on each loop
``slit_planes``           conformal maps onto planes and discs with slits, normalised at points
========================  ======================================================================

References
----------
Ahlfors, "Conformal invariants" (1973), chapter 4.
Schiffer, Spencer, "Functionals of finite Riemann surfaces" (1954).
"""

from .domain_files import is_domain_file, read_domain
from .boundary_classes import BoundaryLoop, boundary_loops
from .measures import harmonic_measures
from .capacities import Bounds, CapacityMatrix, capacity_matrix
from .conjugate_blocks import EnergyBlocks, energy_blocks
from .capacity_balls import CapacityEnclosure, enclosed_capacities
from .homogenisation import EffectiveConductivity, effective_conductivity
from .quadrilaterals import ExtremalLength, extremal_length
from .slit_planes import (
    circular_slit_disc,
    circular_slit_plane,
    parallel_slit_plane,
    radial_slit_disc,
    radial_slit_plane,
)
from .slit_maps import SlitMap, circular_slit_map, parallel_slit_map, radial_slit_map

__all__ = [
    "is_domain_file",
    "read_domain",
    "BoundaryLoop",
    "boundary_loops",
    "harmonic_measures",
    "Bounds",
    "CapacityMatrix",
    "capacity_matrix",
    "EnergyBlocks",
    "energy_blocks",
    "CapacityEnclosure",
    "enclosed_capacities",
    "EffectiveConductivity",
    "effective_conductivity",
    "ExtremalLength",
    "extremal_length",
    "SlitMap",
    "circular_slit_map",
    "radial_slit_map",
    "parallel_slit_map",
    "parallel_slit_plane",
    "circular_slit_plane",
    "radial_slit_plane",
    "circular_slit_disc",
    "radial_slit_disc",
]
