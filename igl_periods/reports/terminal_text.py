"""A period matrix in words, for people who see one for the first time."""

from __future__ import annotations

import textwrap
from typing import Any

import numpy as np
from numpy.typing import NDArray

from igl_periods.display import LARGEST_SHOWN, integer_lines, matrix_lines
from igl_periods.periods import PeriodMatrix
from igl_periods.siegel import SIEGEL_GENUS_LIMIT

from .words import bound_in_words

_WIDTH = 92
LARGEST_PRINTED = LARGEST_SHOWN  # genus up to which matrices are printed


def summary(pm: PeriodMatrix, reduced: PeriodMatrix | None, gamma: NDArray[np.int64] | None) -> str:
    """What was computed, the reduced matrix, its transformation, and how far it can be off.

    Parameters
    ----------
    pm, reduced : PeriodMatrix
        In the marking of the mesh, and Siegel reduced, or None if it was not.
    gamma : (2g, 2g) int
        The transformation between them, or None.
    """
    if pm.genus == 0:
        return (
            "The surface is a sphere (genus 0): its period matrix is empty, there are no periods."
        )
    shown = pm if reduced is None else reduced
    parts = [
        f"Period matrix Π of genus {pm.genus}, {_marking_in_words(pm, reduced)}:",
        _indented(_complex_rows(shown)),
        "How far it can be off:",
        _indented(textwrap.wrap(bound_in_words(shown), _WIDTH)),
    ]
    if gamma is not None:
        parts += [
            "Π = (a Π₀ + b)(c Π₀ + d)⁻¹, Π₀ in the marking of the mesh, [[a, b], [c, d]] =",
            _indented(_integer_rows(gamma)),
        ]
    if pm.complex.mollification:
        parts.append(
            f"Degenerate triangles: {pm.complex.mollification:.3g} was added to the length of "
            "every edge, and the matrix and its bound are those of that surface."
        )
    return "\n".join(parts)


def _marking_in_words(pm: PeriodMatrix, reduced: PeriodMatrix | None) -> str:
    if reduced is not None:
        return "Siegel reduced"
    words = "in the marking of the mesh, not Siegel reduced"
    if pm.genus > SIEGEL_GENUS_LIMIT:
        words += (
            f"\n(that takes a minute and more above genus {SIEGEL_GENUS_LIMIT}; --reduce does it "
            "nevertheless)"
        )
    return words


def _complex_rows(pm: PeriodMatrix) -> list[str]:
    """Rows with as many digits as are known."""
    if pm.genus > LARGEST_PRINTED:
        return [f"{pm.genus} × {pm.genus} entries; --json prints all of them"]
    return matrix_lines(pm.matrix, pm.entry_bounds)


def _integer_rows(gamma: NDArray[np.int64]) -> list[str]:
    if len(gamma) > 2 * LARGEST_PRINTED:
        return [f"{len(gamma)} × {len(gamma)} integers; --json prints all of them"]
    return integer_lines(gamma)


def _indented(lines: list[Any]) -> str:
    return "\n" + "\n".join(f"    {line}" for line in lines) + "\n"
