"""What a picture shows, and drawing it; textured meshes for other programs.

A *scene* is made of arrays alone: coloured or textured triangles, tubes, points, a caption.  So
what a picture shows is tested without drawing it; Open3D draws scenes, off screen or in a window,
and is not imported before.  That happens in a process of its own, which may abort or hang.

=====================  ========================================================================
``scene``              what a picture is made of
``scenes``             cycles, checkerboard, density, quality, cut
``derivative_scenes``  sensitivity, quadratic differentials
``sheets``             where a surface is drawn: in space or in the plane
``all_scenes``         everything that there is to see of a surface
``cells``              cells of periodic surfaces: cycles through them, several copies
``tubes``              closed walks as smooth tubes
``domain_pictures``    harmonic measures, slit maps
``rendering``          scenes to pixels, in a process with a time limit
``drawing``            what that process does, with Open3D
``drivers``            what Open3D needs of the system
``viewer``             scenes as a page with a surface to turn
``viewer_objects``     what that page draws, with K3D
``textured_meshes``    OBJ with MTL and PNG, and GLB
``polygon_drawing``    flat surfaces as polygons in the plane, SVG
=====================  ========================================================================
"""

from .scene import Scene
from .scenes import (
    checkerboard_scene,
    cut_scene,
    cycles_scene,
    density_scene,
    plain_scene,
    quality_scene,
)
from .sheets import surface_in_space
from .cells import periodic_copies
from .derivative_scenes import quadratic_scene, sensitivity_scene
from .all_scenes import (
    BOUND,
    CHECKERBOARD,
    CUT,
    CYCLES,
    LENGTH,
    PLAIN,
    scenes_of_complex,
    scenes_of_matrix,
)
from .rendering import check_display, render, render_all, save, show, with_legend
from .viewer import Viewer, interactive, viewer_of_scenes
from .viewer_objects import png_bytes
from .domain_pictures import measure_picture, slit_map_picture
from .polygon_drawing import render_polygons
from .textured_meshes import write_glb, write_obj

__all__ = [
    "checkerboard_scene",
    "cut_scene",
    "cycles_scene",
    "density_scene",
    "plain_scene",
    "quality_scene",
    "quadratic_scene",
    "sensitivity_scene",
    "Scene",
    "scenes_of_matrix",
    "scenes_of_complex",
    "CYCLES",
    "CHECKERBOARD",
    "LENGTH",
    "BOUND",
    "CUT",
    "PLAIN",
    "surface_in_space",
    "periodic_copies",
    "check_display",
    "render",
    "render_all",
    "save",
    "show",
    "interactive",
    "viewer_of_scenes",
    "Viewer",
    "png_bytes",
    "render_polygons",
    "with_legend",
    "measure_picture",
    "slit_map_picture",
    "write_glb",
    "write_obj",
]
