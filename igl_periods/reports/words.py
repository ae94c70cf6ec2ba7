"""Sentences about results: what a bound says, what limits a mesh, how good a map is.

Each is written here once, for the terminal, the page and whoever else shows it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from igl_periods.differentials import Parametrization
from igl_periods.display import counted, rounded_up
from igl_periods.periods import WIDE, MeshQuality, PeriodMatrix


def parametrization_in_words(P: Parametrization) -> list[str]:
    """How good a parametrization is: its distortion, its zeros and its reversed faces."""
    median, tail = np.percentile(P.dilatation, [50.0, 99.0])
    index, reversed_faces = P.index, int(np.count_nonzero(P.reversed_faces))
    zeros, folds = index[index > 0], index[index < 0]
    return [
        f"Triangles are stretched by different factors in different directions, the ratio being "
        f"{median:.3g} in the median and {tail:.3g} at the 99th percentile; 1 is conformal.",
        f"Zeros: {zeros.size} vertices with indices adding up to {zeros.sum()}, "
        f"{reversed_faces} reversed triangles, {folds.size} vertices with negative indices adding "
        f"up to {folds.sum()}; together {index.sum() + reversed_faces} = 2g − 2.",
    ]


# Angles below this count as thin; a vertex above this angle slows the convergence down visibly.
_THIN = np.radians(10.0)
# A part of the bound worth a remark, and of the faces that counts as few.
_REMARKABLE, _FEW = 0.25, 0.05


def advice(quality: MeshQuality) -> list[str]:
    """What limits the accuracy, and what to do about it; one sentence or two each."""
    if quality.symplectic_eigenvalues.size == 0:
        return ["The surface is a sphere: there are no periods, and nothing limits them."]
    lines = [
        "The period matrix of this polyhedral surface is known to within "
        f"{rounded_up(quality.bound)}, relative to its size, from linear functions on its "
        "triangles.",
        *(_causes(quality) or [_no_cause(quality)]),
    ]
    if quality.half_of_the_bound < _FEW * quality.excess.size:
        lines.append(
            f"Half of the bound originates in {quality.half_of_the_bound} of "
            f"{quality.excess.size} triangles: refining just those places will lower it."
        )
    if quality.flips:
        lines.append(
            f"{quality.non_delaunay_edges} of {quality.weights.size} edges of the mesh are not "
            f"Delaunay; {counted(quality.flips, 'flip', 'flips')} mended that, at no cost to the "
            "surface."
        )
    if quality.mollification:
        lines.append(
            f"Some triangles are degenerate: {quality.mollification:.3g} was added to the length "
            "of every edge, and the bound is about that surface."
        )
    return lines


def _causes(quality: MeshQuality) -> list[str]:
    """Thin triangles and wide vertices, where they have a remarkable part in the bound."""
    causes = []
    thin = quality.delaunay_angles.min(axis=1) < _THIN
    if quality.part(thin) > _REMARKABLE:
        causes.append(
            f"{quality.part(thin):.0%} of that comes from "
            f"{counted(int(np.count_nonzero(thin)), 'triangle', 'triangles')} with an angle below "
            "10° in every triangulation on these vertices. Vertices spread more evenly would do "
            "better."
        )
    if quality.part(quality.near_cone) > _REMARKABLE:
        theta = quality.cone_angles
        wide = counted(int(np.count_nonzero(theta > WIDE)), "vertex", "vertices")
        causes.append(
            f"{quality.part(quality.near_cone):.0%} of that comes from around {wide} of total "
            f"angle above 450°, the largest {np.degrees(theta.max()):.0f}°. There the bound falls "
            f"only like h^{_rate(quality):.2g} with the size h of the triangles; local refinement, "
            "or degree ≥ 2 with its conical elements, restores the full order."
        )
    return causes


def _no_cause(quality: MeshQuality) -> str:
    return (
        "Neither thin triangles nor vertices of large total angle are to blame: the mesh is as "
        "coarse as it is. Functions of higher degree lower the bound fastest; it falls like "
        f"h^{_rate(quality):.2g} with the size h of the triangles of a finer triangulation of the "
        "same surface."
    )


def _rate(quality: MeshQuality) -> float:
    """The exponent of h with which the bound falls in the end."""
    return min(2.0, 4.0 * np.pi / float(quality.cone_angles.max()))


def method_in_words(options: Mapping[str, Any], pm: PeriodMatrix | None = None) -> list[str]:
    """What is not usual about a surface and the computation of its period matrix, in sentences.

    Parameters
    ----------
    options : mapping
        ``weights``, ``delaunay``, ``degree``, ``tolerance`` as in
        :func:`~igl_periods.period_matrix`; ``double``, ``component`` and ``repair``.  What is
        missing is as usual.
    pm : PeriodMatrix, optional
        Where it matters: what was achieved.
    """
    words = []
    if options.get("repair"):
        words.append("The mesh was repaired first.")
    if options.get("double"):
        words.append("The surface is the double of the one in the file; pictures show one sheet.")
    if options.get("component") is not None:
        words.append(f"It is component {options['component']} of several.")
    if pm is None:
        return words
    if options.get("weights", "intrinsic") != "intrinsic":
        words.append("Π is computed with extrinsic weights, measured in space: it has no bound.")
    if not options.get("delaunay", True):
        words.append("The triangulation is the given one, not made Delaunay.")
    if options.get("degree", 1) != 1:
        words.append(f"Π is computed with functions of degree {options['degree']}.")
    if options.get("tolerance") is not None:
        words.append(_tolerance_in_words(float(options["tolerance"]), pm))
    return words


def options_in_words(options: Mapping[str, Any]) -> list[tuple[str, str]]:
    """All options of a computation, also those that are as usual; names and values.

    Parameters
    ----------
    options : mapping
        As for :func:`method_in_words`, and ``rigorous``, ``weld``, ``fill_holes``, ``lattice``.
    """
    yes = {True: "yes", False: "no"}
    tolerance = options.get("tolerance")
    words = [
        ("edge weights", str(options.get("weights", "intrinsic"))),
        ("intrinsic Delaunay flips", yes[bool(options.get("delaunay", True))]),
        ("degree of the functions", str(options.get("degree", 1))),
        ("bound asked for", "none" if tolerance is None else f"{tolerance:g}"),
        ("proved in ball arithmetic", yes[bool(options.get("rigorous"))]),
        ("mesh repaired", yes[bool(options.get("repair"))]),
        ("double taken", yes[bool(options.get("double"))]),
    ]
    names = {
        "component": "component",
        "weld": "edges welded within, in diagonals",
        "fill_holes": "holes filled up to, in edges",
        "lattice": "translations",
    }
    given = {key: options.get(key) for key in names}
    return words + [(names[key], str(value)) for key, value in given.items() if value is not None]


def _tolerance_in_words(tolerance: float, pm: PeriodMatrix) -> str:
    assert pm.bound is not None
    more = ", which is more" if pm.bound > tolerance else ""
    return (
        f"A bound of at most {tolerance:g} was asked for; the one reached is "
        f"{rounded_up(pm.bound)}{more}."
    )


def trust_in_words(pm: PeriodMatrix) -> str:
    """What stands behind the bound of a period matrix."""
    if pm.rigorous:
        return "This is proved."
    return "This is a theorem, with an allowance for rounding."


def bound_in_words(pm: PeriodMatrix) -> str:
    """What the bound of a period matrix says, and what it does not."""
    bounds = pm.entry_bounds
    if pm.bound is None or bounds is None:
        return (
            "There is no bound: these weights are not the energy of functions on the surface. "
            "Intrinsic weights (the default) come with one."
        )
    return (
        f"Π of this polyhedral surface is known to within {rounded_up(pm.bound)}, relative to its "
        f"size; no entry is off by more than {rounded_up(float(bounds.max()))}. "
        f"{trust_in_words(pm)} It is about the surface made of these flat triangles: how well they "
        "represent a smooth surface is another question, which the bound does not answer."
    )
