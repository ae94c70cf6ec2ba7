"""Reference surfaces: meshes and gluings whose period matrices are known exactly or to quadrature.

Each function returns a pair ``(V, F)`` or a :class:`~igl_periods.DeltaComplex`, as
:func:`~igl_periods.period_matrix` takes them; exact period matrices have their own functions, in
some marking, so that they agree with computed ones up to the action of Sp(2g, Z).

===========================  ======================================================================
glued squares                ``square_tiled_surface``, ``origami``,
                             ``quaternion_origami``, ``glued_rectangles``
polygons                     ``regular_polygon``, ``double_polygon``, ``l_shape``,
                             ``l_shape_period_matrix``, ``weierstrass_prototypes``,
                             ``prototype_surface``
billiards                    ``triangle_unfolding``
covers of the pillowcase     ``pillowcase_cover``
regular maps                 ``regular_map_surface``, ``regular_map``
tori                         ``flat_torus``, ``torus_of_revolution``
Wente's tori                 ``wente_torus``
Lawson's minimal surfaces    ``lawson_surface``, ``lawson_surface_jittered``,
                             ``lawson_surface_voronoi``, ``lawson_surface_poor``, ``stereographic``
cyclic covers of the sphere  ``cyclic_cover``
triply periodic surfaces     ``triply_periodic_minimal_surface``
plane domains with holes     ``planar_domain``
very high genus              ``thickened_lattice``, ``menger_sponge``, ``voxel_surface``
===========================  ======================================================================
"""

from .square_tiled import (
    glued_rectangles,
    origami,
    quaternion_origami,
    square_tiled_period_matrix,
    square_tiled_surface,
)
from .veech_surfaces import (
    double_polygon,
    l_shape,
    l_shape_period_matrix,
    prototype_surface,
    regular_polygon,
    weierstrass_prototypes,
)
from .triangle_unfoldings import triangle_unfolding
from .pillowcase_covers import pillowcase_cover
from .regular_maps import regular_map, regular_map_period_matrix, regular_map_surface
from .tori import flat_torus, torus_of_revolution, torus_of_revolution_modulus
from .wente import wente_immersion, wente_modulus, wente_periods, wente_torus
from .lawson.surface import lawson_sides, lawson_surface, stereographic
from .lawson.unstructured import (
    lawson_segments,
    lawson_surface_jittered,
    lawson_surface_poor,
    lawson_surface_voronoi,
)
from .lawson.periods import lawson_period_matrix, lawson_period_matrix_in
from .cyclic_covers import cyclic_cover
from .minimal_periodic import PeriodicMesh, triply_periodic_minimal_surface
from .planar_domains import planar_domain
from .subdivision import subdivide
from .cube_solids import menger_sponge, thickened_lattice
from .voxels import voxel_surface
from .named_surface import NamedSurface
from .named_surfaces import catalogue
from .identification import Identification, Match, identify, matrix_of

__all__ = [
    "glued_rectangles",
    "origami",
    "quaternion_origami",
    "square_tiled_period_matrix",
    "square_tiled_surface",
    "regular_polygon",
    "double_polygon",
    "l_shape",
    "l_shape_period_matrix",
    "weierstrass_prototypes",
    "prototype_surface",
    "triangle_unfolding",
    "pillowcase_cover",
    "regular_map",
    "regular_map_period_matrix",
    "regular_map_surface",
    "flat_torus",
    "torus_of_revolution",
    "torus_of_revolution_modulus",
    "wente_immersion",
    "wente_modulus",
    "wente_periods",
    "wente_torus",
    "lawson_sides",
    "lawson_surface",
    "stereographic",
    "lawson_segments",
    "lawson_surface_jittered",
    "lawson_surface_poor",
    "lawson_surface_voronoi",
    "lawson_period_matrix",
    "lawson_period_matrix_in",
    "cyclic_cover",
    "PeriodicMesh",
    "triply_periodic_minimal_surface",
    "planar_domain",
    "subdivide",
    "menger_sponge",
    "thickened_lattice",
    "voxel_surface",
    "NamedSurface",
    "catalogue",
    "Identification",
    "Match",
    "identify",
    "matrix_of",
]
