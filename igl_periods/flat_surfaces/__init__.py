"""A flat surface → stratum, holonomy, area, the form dz and its periods.

Translation surfaces and their kin as geometers of Teichmüller space use them.  The surfaces are
complexes like all others; where they were glued from polygons with exact coordinates, everything
here is decided exactly.

======================  =====================================================================
``developments``        frames of the faces, rotations across the edges
``flat_report``         stratum, cone angles, holonomy, area, dz as a cohomology class
``flatsurf_exchange``   surfaces of sage-flatsurf, without Sage
======================  =====================================================================

References
----------
Zorich, "Flat surfaces" (2006).
"""

from .flat_report import FlatSurfaceReport, flat_surface_report
from .flatsurf_exchange import from_flatsurf, to_flatsurf_dict

__all__ = [
    "FlatSurfaceReport",
    "flat_surface_report",
    "from_flatsurf",
    "to_flatsurf_dict",
]
