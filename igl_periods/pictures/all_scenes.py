"""Everything that there is to see of a surface, as scenes on one sheet.

A surface with a period matrix has its canonical cycles, a holomorphic form with its checkerboard
and its length, the cut, and the places where the bound originates.  A surface without positions is
drawn in the plane, by its polygons or developed by the form.
"""

from __future__ import annotations

from igl_periods.complexes import DeltaComplex
from igl_periods.differentials import Parametrization, most_even_form, parametrize
from igl_periods.periods import MeshQuality, PeriodMatrix, mesh_quality, period_matrix

from .scene import Scene
from .scenes import (
    checkerboard_scene,
    cut_scene,
    cycles_scene,
    density_scene,
    plain_scene,
    quality_scene,
)
from .sheets import Sheet

CYCLES, CHECKERBOARD, LENGTH = "canonical cycles", "checkerboard", "length |ζ|"
BOUND, CUT, PLAIN = "origin of the bound", "cut", "surface"


def scenes_of_matrix(
    pm: PeriodMatrix, P: Parametrization | None = None, quality: MeshQuality | None = None
) -> dict[str, Scene]:
    """The scenes of a surface with a period matrix, by what they show.

    Parameters
    ----------
    pm : PeriodMatrix
        Its marking is that of the cycles.
    P : Parametrization, optional
        By the form that is shown; by default the form of most even length.
    quality : MeshQuality, optional
        Where it is known: :func:`~igl_periods.mesh_quality` of the surface.

    Raises
    ------
    ComplexError
        If the surface is a sphere without positions, or lies in more than 3 dimensions.
    """
    K = pm.complex
    if pm.genus == 0:
        return {PLAIN: plain_scene(K)}
    if P is None:
        P = parametrize(pm, most_even_form(pm))
    sheet = sheet_of_form(P)
    return {
        CYCLES: cycles_scene(pm, sheet),
        CHECKERBOARD: checkerboard_scene(P, sheet),
        LENGTH: density_scene(P, sheet),
        BOUND: quality_scene(K, quality or mesh_quality(K), sheet),
        CUT: cut_scene(P, sheet),
    }


def scenes_of_complex(K: DeltaComplex) -> dict[str, Scene]:
    """The scenes of a surface alone: as it lies in space or in the plane.

    Raises
    ------
    ComplexError
        If the surface is a sphere without positions, or lies in more than 3 dimensions.
    """
    if _is_abstract(K) and K.euler_characteristic < 2:
        pm = period_matrix(K)
        return {PLAIN: plain_scene(K, Sheet.developed(parametrize(pm, most_even_form(pm))))}
    return {PLAIN: plain_scene(K)}


def sheet_of_form(P: Parametrization) -> Sheet:
    """Where a surface is drawn that has a form: in space, as its polygons, or developed."""
    return Sheet.developed(P) if _is_abstract(P.complex) else Sheet.of(P.complex)


def _is_abstract(K: DeltaComplex) -> bool:
    return K.positions is None and K.polygons is None and K.cell is None
