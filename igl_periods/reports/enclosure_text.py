"""A period matrix in balls, for the terminal: exactly the digits that are proved."""

from __future__ import annotations

import textwrap

from igl_periods.complexes import DeltaComplex
from igl_periods.display import LARGEST_SHOWN, ball_matrix_lines
from igl_periods.enclosures import PeriodEnclosure

_WIDTH = 92


def enclosure_summary(enclosed: PeriodEnclosure, wanted: int) -> str:
    """What is proved, the digits, and about which surface.

    Parameters
    ----------
    enclosed : PeriodEnclosure
        Best Siegel reduced.
    wanted : int
        Digits that were asked for; as many are shown, if as many are proved.
    """
    if enclosed.genus == 0:
        return (
            "The surface is a sphere (genus 0): its period matrix is empty, there are no periods."
        )
    proved = (
        f"{enclosed.digits} digits are proved, relative to √(Y_ii Y_jj), Y the imaginary part: "
        "each number is off by 1 in its last digit at most. This is a theorem, computed in ball "
        "arithmetic, and nothing in it is an estimate."
    )
    return "\n".join(
        [
            f"Period matrix Π of genus {enclosed.genus}, Siegel reduced:",
            _indented(_rows(enclosed, min(wanted, enclosed.digits))),
            "What is proved:",
            _indented(textwrap.wrap(proved, _WIDTH)),
            "Which surface is meant:",
            _indented(textwrap.wrap(lengths_in_words(enclosed.complex), _WIDTH)),
        ]
    )


def lengths_in_words(K: DeltaComplex) -> str:
    """Which lengths an enclosure of a complex is about."""
    if K.mollification:
        return (
            f"Some triangles are degenerate: {K.mollification:.3g} was added to the length of "
            "every edge. The surface is the one with these changed lengths, each of them the "
            "double that is stored, exactly."
        )
    if K.exact_lengths is None:
        return (
            "The lengths of the edges are the doubles that are stored, exactly: each is a binary "
            "fraction, also where √2 may have been meant."
        )
    if K.positions is None:
        return "The lengths of the edges are exact numbers, square roots for instance."
    return (
        "The vertices are exactly where the file says, in double precision, and the lengths of "
        "the edges are their exact distances. A smooth surface that the mesh samples is another "
        "one, and nothing is said about it."
    )


def _rows(enclosed: PeriodEnclosure, digits: int) -> list[str]:
    g = enclosed.genus
    if g > LARGEST_SHOWN:
        return [f"{g} × {g} entries; --json prints all of them"]
    return ball_matrix_lines(enclosed.matrix, digits)


def _indented(lines: list[str]) -> str:
    return "\n" + "\n".join(f"    {line}" for line in lines) + "\n"
