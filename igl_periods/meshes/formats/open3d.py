"""Formats that only Open3D reads: glTF and FBX.

It is not used for the others, because it drops polygons, rounds coordinates to single precision and
splits vertices along seams of textures.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from igl_periods.errors import MeshError

from .mesh_file import MeshFile


def mesh_from_open3d(file: Path) -> MeshFile:
    """The mesh in a file that Open3D reads."""
    import open3d

    with open3d.utility.VerbosityContextManager(open3d.utility.VerbosityLevel.Error):
        mesh = open3d.io.read_triangle_mesh(str(file))
    V, F = np.array(mesh.vertices), np.array(mesh.triangles, dtype=np.int64)
    if len(F) == 0:
        raise MeshError("Open3D reads no triangles from this file: it is corrupt or no mesh.")
    return MeshFile(V, F, len(F), 0)
