"""What a period matrix needs of a surface: it is closed, oriented and connected."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from igl_periods.display import counted
from igl_periods.errors import ComplexError

from .gluings import face_components, orientable_faces, reversing_sides

if TYPE_CHECKING:
    from .delta_complex import DeltaComplex


# Faces up to which a complex says more than its size when it is shown.
_QUICKLY_SHOWN = 200_000


def check_surface(K: DeltaComplex) -> None:
    """Raise unless ``K`` is closed, oriented and connected, as a period matrix needs.

    Raises
    ------
    ComplexError
        Saying which of the three fails, at how many edges, and what to do.
    """
    check_closed_and_oriented(K)
    check_connected(K)


def check_closed_and_oriented(K: DeltaComplex) -> None:
    """The first two thirds of :func:`check_surface`."""
    if K.n_boundary_edges:
        raise ComplexError(
            f"the surface is not closed: it has {K.n_boundary_edges} boundary edges. "
            "Where the file repeats vertices they are seams: weld them first (load_mesh(…, "
            "repair=True), --repair). Holes can be filled (largest_hole=SIZE, --fill-holes SIZE), "
            "and a surface with a true boundary has a double, which is closed "
            "(igl_periods.double, --double)."
        )
    if K.n_reversing_edges:
        if is_orientable(K):
            raise ComplexError(
                f"the faces are not oriented consistently: across {K.n_reversing_edges} edges the "
                "two faces run the same way. The surface is orientable: turn faces over until "
                "they agree (igl.bfs_orient, load_mesh(…, repair=True), --repair)."
            )
        raise ComplexError(
            "the surface is not orientable: however its faces are turned, orientations disagree "
            f"somewhere (now across {K.n_reversing_edges} edges). It has no period matrix; its "
            "double has one (igl_periods.double, --double)."
        )


def check_connected(K: DeltaComplex) -> None:
    """The last third of :func:`check_surface`."""
    n, label = face_components(K.twin)
    if n > 1:
        sizes = ", ".join(str(size) for size in np.sort(np.bincount(label))[::-1][:5])
        more = ", …" if n > 5 else ""
        raise ComplexError(
            f"the surface has {n} components (of {sizes}{more} faces). Each has a period matrix of "
            "its own: take them one by one (K.components(), --component)."
        )


def is_orientable(K: DeltaComplex) -> bool:
    """Whether faces can be turned so that orientations agree."""
    return bool(orientable_faces(K.twin, reversing_sides(K.twin, K.sign)).all())


def topology_in_words(K: DeltaComplex) -> list[str]:
    """The genus, or what keeps the complex from having one; nothing where that takes long."""
    if K.n_faces > _QUICKLY_SHOWN:
        return []
    n_components, _ = face_components(K.twin)
    words = [f"{n_components} components"] if n_components != 1 else []
    if K.n_boundary_edges:
        words.append(counted(K.n_boundary_edges, "boundary edge", "boundary edges"))
    if K.n_reversing_edges:
        words.append("not oriented consistently" if is_orientable(K) else "not orientable")
    return words or [f"genus {K.genus}"]
