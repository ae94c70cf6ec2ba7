r"""Surfaces glued from Euclidean triangles, and the moves that carry cochains.

A surface is a *Δ-complex with edge lengths*: triangles whose sides are glued in pairs, each pair of
one length.  Multi-edges, loops and faces glued to themselves are allowed, since an intrinsic
Delaunay triangulation has them; so **an edge is an index**, never a pair of vertices.

* **Side s of face f lies opposite its corner s** and runs from corner s + 1 to corner s + 2 (mod
  3). ``lengths[f, s]`` is its length; ``twin[f, s] = 3 f' + s'`` the half-edge glued to it,
  reversed, or −1 on the boundary.
* The weight of an edge is :math:`\rho(e) = \tfrac12 (\cot\alpha + \cot\beta)`, α and β the angles
  opposite it.  :math:`\sum_e \rho(e)\, (f(y) - f(x))^2` is the Dirichlet energy of the piecewise
  linear function f, on the surface itself.
* A *cochain* is a number for every edge, in its direction; it is *closed* if the signed sum around
  every face is 0.  Closed integer cochains are the marking: the classes of cohomology.

Every geometric step has one shape, **(K, cochains) → (K′, cochains′)**: flips, midpoints,
barycentres, the double.  The surface stays what it is, and the classes go along.

========================  =====================================================================
``triangles``             areas, angles and cotangents from three lengths; mollification
``checked_arrays``        positions, faces and lengths as callers hand them over
``gluings``               which side is glued to which: twins, vertices, components
``exact_numbers``         rational, algebraic and computable real numbers
``number_readers``        numbers and points of all libraries, as exact ones
``plane_polygons``        orientation, crossings and triangles of polygons
``polygon_gluings``       polygons glued along their sides
``gluing_documents``      surfaces as JSON
``assembly``              what a complex consists of
``glued_squares``         unit squares glued along sides, and grids of them
``lattices``              cells of periodic surfaces, glued by translations
``delta_complex``         the complex itself
``mesh_readers``          readers of meshes that are not arrays
``surface_arguments``     whatever is called a surface, as a complex
``surface_checks``        closed, oriented, connected: what a period matrix needs
``half_edges``            both directions of every edge
``weights``               cotangent and extrinsic weights, cone angles
``cochains``              closed cochains, their values along walks and sides
``marked_complex``        a complex with the cochains that it carries
``diagonals``             the other diagonal of two triangles, and its rounding
``flip_rounds``           rounds of flips, and cochains after them
``delaunay``              intrinsic Delaunay flips
``moved_lengths``         the same triangulation with other lengths or positions
``flipped_lengths``       new lengths by old ones
``midpoint_subdivision``  every face in four, or in n²
``barycentre_insertion``  some faces in three
``doubling``              the complex double
========================  =====================================================================

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 2.
Bobenko, Springborn, "A discrete Laplace–Beltrami operator for simplicial surfaces" (2007).
"""

from .triangles import angles, apexes, cotangents, double_areas, length_sensitivity, slacks
from .checked_arrays import (
    check_equal_when_glued,
    check_finite,
    checked_array,
    checked_corners,
    checked_positions,
)
from .gluings import (
    components_of,
    corner_vertices,
    face_components,
    MOST_TRIANGLES,
    index_type,
    ends_of_sides,
    next_corner,
    orientable_faces,
    reversing_sides,
    sorted_by_rows,
)
from .glued_squares import periodic_grid, squares
from .half_edges import edge_ends, forward_half_edges, half_edge_ends, walk_vertices
from .exact_lengths import (
    ExactLengths,
    LengthsByKind,
    by_kind,
    circumradius,
    lattice_length,
    root_of,
)
from .exact_numbers import (
    ComputedNumber,
    FieldElement,
    Number,
    RealField,
    algebraic_number,
    ball_of,
    cosine_and_sine,
    sign_of,
)
from .number_readers import Point, exact_number, read_point
from .polygon_gluings import GluedPolygons
from .lattices import Cell, LatticeGluing, checked_lattice, lattice_gluing
from .mesh_readers import is_array_like, mesh_reader
from .delta_complex import DeltaComplex
from .surface_arguments import (
    BYTES_A_FACE_FLIPPING,
    SurfaceLike,
    as_complex,
    of_a_surface,
    of_a_surface_or,
)
from .surface_checks import check_closed_and_oriented, check_connected, check_surface, is_orientable
from .weights import cone_angles, cotan_weights, extrinsic_weights
from .cochains import along_sides, primitive
from .marked_complex import MarkedComplex
from .flip_rounds import Flips, transport
from .delaunay import cocircularity_allowance, delaunay_flips, intrinsic_delaunay
from .moved_lengths import edge_directions, edge_lengths, with_edge_lengths, with_positions
from .flipped_lengths import FlipDerivative, flip_derivatives, pull_back, push_forward
from .midpoint_subdivision import split
from .barycentre_insertion import Barycentres, insert_barycentres, is_divisible
from .doubling import Involution, double, involution, lift

__all__ = [
    "angles",
    "apexes",
    "cotangents",
    "double_areas",
    "length_sensitivity",
    "slacks",
    "check_equal_when_glued",
    "check_finite",
    "checked_array",
    "checked_corners",
    "checked_positions",
    "components_of",
    "corner_vertices",
    "MOST_TRIANGLES",
    "index_type",
    "next_corner",
    "ends_of_sides",
    "sorted_by_rows",
    "periodic_grid",
    "squares",
    "face_components",
    "orientable_faces",
    "reversing_sides",
    "edge_ends",
    "forward_half_edges",
    "half_edge_ends",
    "walk_vertices",
    "check_closed_and_oriented",
    "check_connected",
    "check_surface",
    "is_orientable",
    "is_array_like",
    "mesh_reader",
    "LatticeGluing",
    "Cell",
    "checked_lattice",
    "lattice_gluing",
    "DeltaComplex",
    "BYTES_A_FACE_FLIPPING",
    "SurfaceLike",
    "as_complex",
    "of_a_surface",
    "of_a_surface_or",
    "ExactLengths",
    "LengthsByKind",
    "by_kind",
    "circumradius",
    "lattice_length",
    "root_of",
    "ComputedNumber",
    "FieldElement",
    "Number",
    "RealField",
    "algebraic_number",
    "ball_of",
    "cosine_and_sine",
    "sign_of",
    "Point",
    "exact_number",
    "read_point",
    "GluedPolygons",
    "cone_angles",
    "cotan_weights",
    "extrinsic_weights",
    "along_sides",
    "primitive",
    "MarkedComplex",
    "cocircularity_allowance",
    "delaunay_flips",
    "Flips",
    "intrinsic_delaunay",
    "transport",
    "FlipDerivative",
    "edge_directions",
    "edge_lengths",
    "with_edge_lengths",
    "with_positions",
    "flip_derivatives",
    "pull_back",
    "push_forward",
    "split",
    "Barycentres",
    "insert_barycentres",
    "is_divisible",
    "double",
    "involution",
    "lift",
    "Involution",
]
