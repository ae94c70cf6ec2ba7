"""FBX, which only Open3D reads.

It is not used for other formats, because it drops polygons, rounds coordinates to single precision
and splits vertices along seams of textures.
"""

from __future__ import annotations

import tempfile

import numpy as np

from igl_periods.errors import MeshError

from .mesh_file import MeshFile, mesh_of_triangles


def mesh_from_fbx(data: bytes) -> MeshFile:
    """The mesh in an FBX file."""
    try:
        import open3d
    except ImportError as error:
        raise MeshError(
            "FBX is read by Open3D, which is not installed: pip install 'igl_periods[pictures]'."
        ) from error
    with tempfile.NamedTemporaryFile(suffix=".fbx") as copy:
        copy.write(data)
        copy.flush()
        with open3d.utility.VerbosityContextManager(open3d.utility.VerbosityLevel.Error):
            mesh = open3d.io.read_triangle_mesh(copy.name)
    V, F = np.array(mesh.vertices), np.array(mesh.triangles, dtype=np.int64)
    if len(F) == 0:
        raise MeshError("Open3D reads no triangles from this file: it is corrupt or no mesh.")
    return mesh_of_triangles(V, F)
