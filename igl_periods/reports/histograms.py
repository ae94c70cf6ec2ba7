"""How angles, weights and errors of a mesh are distributed, as pictures."""

from __future__ import annotations

import io
from collections.abc import Iterator
from typing import Any

import numpy as np

from igl_periods.arrays import Floats
from igl_periods.differentials import Parametrization
from igl_periods.periods import MeshQuality

from .typesetting import figure

_BINS = 60
_STYLE: dict[Any, Any] = {
    "svg.fonttype": "none",
    "font.family": "sans-serif",
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
}


def histograms(quality: MeshQuality, P: Parametrization | None) -> Iterator[str]:
    """Figures about a mesh; with a form also of its parametrization."""
    angle, straight = "angle (degrees)", (0.0, 180.0)
    yield _histogram(
        np.degrees(quality.angles.ravel()), (angle, "angles"), "Angles of the mesh.", straight
    )
    yield _histogram(
        np.degrees(quality.delaunay_angles.ravel()),
        (angle, "angles"),
        f"Angles after {quality.flips} intrinsic Delaunay flips.",
        straight,
    )
    yield _histogram(
        quality.weights,
        ("weight", "edges"),
        f"Cotangent weights; {quality.non_delaunay_edges} edges have negative ones.",
    )
    yield _histogram(
        np.degrees(quality.cone_angles),
        (angle, "vertices"),
        "Total angles at the vertices; the surface is flat at 360°.",
    )
    if P is not None:
        share = quality.excess / max(float(quality.excess.max()), 1e-300)
        yield _histogram(
            np.log10(np.maximum(share, 1e-9)),
            ("log₁₀ of the share, relative to the largest", "triangles"),
            f"Shares of the triangles in the bound; half of it originates in "
            f"{quality.half_of_the_bound} of {quality.excess.size}.",
        )
        yield _histogram(
            P.dilatation,
            ("ratio of stretches", "triangles"),
            "Conformal distortion of the checkerboard; 1 is conformal.",
        )


def _histogram(
    values: Floats,
    labels: tuple[str, str],
    caption: str,
    limits: tuple[float, float] | None = None,
) -> str:
    """A histogram, without the extreme half percent at both ends unless limits are given."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    finite = values[np.isfinite(values)]
    low, high = limits or np.percentile(finite, [0.5, 99.5])
    if high - low < 1e-9 * max(1.0, abs(high)):
        low, high = low - 0.5, high + 0.5
    counts, edges = np.histogram(finite, bins=_BINS, range=(float(low), float(high)))
    with rc_context({**_STYLE, "svg.hashsalt": caption}):
        drawing = Figure(figsize=(4.4, 2.4))
        axes = drawing.add_axes((0.14, 0.20, 0.83, 0.75))
        axes.bar(edges[:-1], counts, np.diff(edges), align="edge", color="#29508a")
        axes.set_xlim(float(low), float(high))
        axes.set_xlabel(labels[0])
        axes.set_ylabel(labels[1])
        axes.locator_params(axis="y", nbins=4, integer=True)
        stream = io.BytesIO()
        drawing.savefig(stream, format="svg", metadata={"Date": None})
    return figure(stream.getvalue(), "image/svg+xml", caption)
