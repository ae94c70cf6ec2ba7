"""Formats that only Open3D reads: glTF and FBX.

It is not used for the others, because it drops polygons, rounds coordinates to single precision and
splits vertices along seams of textures.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from igl_periods.errors import MeshError
from igl_periods.extras import missing_library, require

from .mesh_file import MeshFile


def mesh_from_open3d(file: Path) -> MeshFile:
    """The mesh in a file that Open3D reads.

    Raises
    ------
    MissingExtraError
        If Open3D is not installed.
    MeshError
        If it reads no triangles, or a system library that it needs is missing.
    """
    require(f"reading {file.suffix.lower()} files", "open3d")
    try:
        import open3d
    except (ImportError, OSError) as error:
        raise MeshError(
            f"Open3D, which reads such files, cannot start: {missing_library(error)}"
        ) from error

    with open3d.utility.VerbosityContextManager(open3d.utility.VerbosityLevel.Error):
        mesh = open3d.io.read_triangle_mesh(file)
    V, F = np.array(mesh.vertices), np.array(mesh.triangles, dtype=np.int64)
    if len(F) == 0:
        raise MeshError("Open3D reads no triangles from this file: it is corrupt or no mesh.")
    return MeshFile(V, F, len(F), 0)
