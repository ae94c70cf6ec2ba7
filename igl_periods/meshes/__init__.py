"""From files to vertex positions and triangles: reading, facts, repair.

A mesh is read as it is: double precision, the order of the file, polygons divided into triangles
and corners of STL files welded where they are equal; both are counted.  Whether it is a surface,
and of which kind, is a matter of fact (``facts``); repair changes it, on request only, and counts
every step.  With V − E + F = 2 − 2g − b for an orientable component of genus g with b boundary
loops, the report says what keeps a mesh from having a period matrix.

==================  ===========================================================================
``load``            the whole way from a path to V, F and a report
``facts``           how faces meet: edges, components, orientability, boundary
``report``          facts and repairs in words and as JSON
``repair``          weld, drop, orient, split, fill
``welding``         equal rows, unused vertices
``formats``         OBJ, OFF, PLY, STL, and what Open3D reads
``gluing_file``     triangles glued as a JSON file says
``surface_files``   either of them, its double, its components
==================  ===========================================================================
"""

from .load import load_mesh, split_components
from .report import MeshReport
from .surface_files import SURFACE_EXTENSIONS, components_by_genus, read_surface, surface_of

__all__ = [
    "load_mesh",
    "MeshReport",
    "components_by_genus",
    "read_surface",
    "SURFACE_EXTENSIONS",
    "surface_of",
    "split_components",
]
