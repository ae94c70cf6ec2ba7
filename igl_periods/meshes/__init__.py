"""From files to vertex positions and triangles: reading, facts, repair.

A mesh is read as it is: double precision, the order of the file, polygons divided into triangles,
and corners of STL files welded where they are equal; both are counted.  Whether it is a surface,
and of which kind, is a matter of fact (``facts``); repair changes it, on request only, and counts
every step.  With V − E + F = 2 − 2g − b for an orientable component of genus g with b boundary
loops, the report says what keeps a mesh from having a period matrix.

==================  ===========================================================================
``load``            the whole way from a path to V, F and a report
``facts``           how faces meet: edges, components, orientability, boundary
``report``          facts and repairs in words and as JSON
``advice``          what to do with what is not a closed surface
``polygons``        polygons divided into triangles, all of them
``outlines``        one that is concave, or has straight corners
``repair``          weld, drop, orient, split, contract, fill
``seams``           boundary edges at the same place
``contraction``     edges without length
``welding``         equal rows, unused vertices
``formats``         OBJ, OFF, PLY, STL, 3MF, glTF
``gluing_file``     triangles glued as a JSON file says
``surface_files``   either of them, its double, its components
``mesh_objects``    meshes of trimesh, Open3D, PyVista, meshio
``samples``         surfaces for a first try, which come with the package
==================  ===========================================================================
"""

from .load import load_mesh, split_components
from .report import MeshReport
from .repair import checked_repair
from .samples import SAMPLES, sample_files
from .advice import way_out
from .seams import WELD
from .surface_files import (
    components_by_genus,
    is_surface_file,
    read_surface,
    SURFACE_EXTENSIONS,
    surface_of,
)
from .mesh_objects import mesh_of_object

__all__ = [
    "load_mesh",
    "MeshReport",
    "checked_repair",
    "SAMPLES",
    "sample_files",
    "way_out",
    "WELD",
    "components_by_genus",
    "is_surface_file",
    "read_surface",
    "SURFACE_EXTENSIONS",
    "surface_of",
    "mesh_of_object",
    "split_components",
]
