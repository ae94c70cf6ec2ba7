"""What a picture shows, and drawing it; textured meshes for other programs.

A *scene* is made of arrays alone: coloured or textured triangles, tubes, points, a caption.  So
what a picture shows is tested without drawing it; Open3D draws scenes, off screen or in a window,
and is not imported before.  That happens in a process of its own, which may abort or hang.

=====================  ========================================================================
``scenes``             cycles, checkerboard, density, quality, cut
``derivative_scenes``  sensitivity, quadratic differentials
``tubes``              closed walks as smooth tubes
``rendering``          scenes to pixels, in a process with a time limit
``drawing``            what that process does, with Open3D
``drivers``            what Open3D needs of the system
``textured_meshes``    OBJ with MTL and PNG, and GLB
``polygon_drawing``    flat surfaces as polygons in the plane, SVG
=====================  ========================================================================
"""

from .scenes import (
    Scene,
    checkerboard_scene,
    cut_scene,
    cycles_scene,
    density_scene,
    plain_scene,
    quality_scene,
    surface_in_space,
)
from .derivative_scenes import quadratic_scene, sensitivity_scene
from .rendering import check_display, render, save, show, with_legend
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
    "surface_in_space",
    "check_display",
    "render",
    "save",
    "show",
    "render_polygons",
    "with_legend",
    "write_glb",
    "write_obj",
]
