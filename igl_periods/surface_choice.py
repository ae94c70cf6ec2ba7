"""Which surface of a mesh is meant: its double, or one of its components."""

from __future__ import annotations

from .delta_complex import DeltaComplex
from .double import double
from .errors import ComplexError


def surface_of(
    K: DeltaComplex, doubled: bool = False, component: int | None = None
) -> DeltaComplex:
    """The double or the complex itself, all of it or one component.

    Parameters
    ----------
    K : DeltaComplex
    doubled : bool
    component : int, optional
        Counted from 1, in the order of :func:`components_by_genus`.

    Raises
    ------
    ComplexError
        If there is no such component.
    """
    surface = double(K) if doubled else K
    if component is None:
        return surface
    parts = components_by_genus(surface)
    if not 1 <= component <= len(parts):
        raise ComplexError(f"there is no component {component}: there are {len(parts)}.")
    return parts[component - 1]


def components_by_genus(K: DeltaComplex) -> list[DeltaComplex]:
    """The connected components: closed ones first, of these those of large genus, of many faces."""

    def rank(part: DeltaComplex) -> tuple[bool, int, int]:
        return part.n_boundary_edges > 0, part.euler_characteristic, -part.n_faces

    return sorted(K.components(), key=rank)
