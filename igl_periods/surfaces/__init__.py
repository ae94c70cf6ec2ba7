"""Reference surfaces: meshes and gluings whose period matrices are known exactly or to quadrature.

Each function returns a pair ``(V, F)`` or a :class:`~igl_periods.DeltaComplex`, as
:func:`~igl_periods.period_matrix` takes them; exact period matrices have their own functions, in
some marking, so that they agree with computed ones up to the action of Sp(2g, Z).

===========================  ======================================================================
glued squares                ``square_tiled_surface``, ``origami``, ``glued_rectangles``
regular maps                 ``regular_map_surface``, ``regular_map``
tori                         ``flat_torus``, ``torus_of_revolution``
Wente's tori                 ``wente_torus``
Lawson's minimal surfaces    ``lawson_surface``, ``lawson_surface_jittered``,
                             ``lawson_surface_voronoi``, ``lawson_surface_poor``, ``stereographic``
cyclic covers of the sphere  ``cyclic_cover``
very high genus              ``thickened_lattice``, ``menger_sponge``, ``voxel_surface``
===========================  ======================================================================
"""

from .cyclic_covers import cyclic_cover as cyclic_cover
from .lattices import menger_sponge as menger_sponge
from .lattices import thickened_lattice as thickened_lattice
from .lawson import lawson_sides as lawson_sides
from .lawson import lawson_surface as lawson_surface
from .lawson import stereographic as stereographic
from .lawson_periods import lawson_period_matrix as lawson_period_matrix
from .lawson_periods import lawson_period_matrix_in as lawson_period_matrix_in
from .lawson_unstructured import lawson_segments as lawson_segments
from .lawson_unstructured import lawson_surface_jittered as lawson_surface_jittered
from .lawson_unstructured import lawson_surface_poor as lawson_surface_poor
from .lawson_unstructured import lawson_surface_voronoi as lawson_surface_voronoi
from .regular_maps import regular_map as regular_map
from .regular_maps import regular_map_period_matrix as regular_map_period_matrix
from .regular_maps import regular_map_surface as regular_map_surface
from .square_tiled import glued_rectangles as glued_rectangles
from .square_tiled import origami as origami
from .square_tiled import square_tiled_period_matrix as square_tiled_period_matrix
from .square_tiled import square_tiled_surface as square_tiled_surface
from .subdivision import subdivide as subdivide
from .tori import flat_torus as flat_torus
from .tori import torus_of_revolution as torus_of_revolution
from .tori import torus_of_revolution_modulus as torus_of_revolution_modulus
from .voxels import voxel_surface as voxel_surface
from .wente import wente_immersion as wente_immersion
from .wente import wente_modulus as wente_modulus
from .wente import wente_periods as wente_periods
from .wente import wente_torus as wente_torus
