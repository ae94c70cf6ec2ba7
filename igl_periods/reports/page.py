"""A page about a surface: pictures, its period matrix and what is known about it, its mesh.

The page is one HTML file that needs nothing else: pictures are in it, and it runs no script.
"""

from __future__ import annotations

import base64
import io
import json
import logging
import os
from collections.abc import Iterator, Sequence
from html import escape
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from string import Template

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats
from igl_periods.complexes import Cell
from igl_periods.differentials import Parametrization, most_even_form, parametrize
from igl_periods.display import LARGEST_SHOWN, matrix_html
from igl_periods.errors import ComplexError, RenderError
from igl_periods.machine import check_output, require
from igl_periods.meshes import MeshReport
from igl_periods.periods import MeshQuality, PeriodMatrix, mesh_quality
from igl_periods.pictures import (
    Scene,
    checkerboard_scene,
    cut_scene,
    cycles_scene,
    density_scene,
    periodic_copies,
    plain_scene,
    quality_scene,
    render,
    with_legend,
)

from .json_document import period_matrix_to_json
from .words import advice, bound_in_words, parametrization_in_words

logger = logging.getLogger("igl_periods")
_CITATION = (
    "A. I. Bobenko, C. Mercat, M. Schmies, Period matrices of polyhedral surfaces, in: A. I. "
    "Bobenko, C. Klein (eds.), Computational Approach to Riemann Surfaces, Lecture Notes in "
    "Mathematics 2013, Springer (2011)."
)


def write_report(
    path: str | os.PathLike[str],
    pm: PeriodMatrix,
    *,
    name: str,
    mesh: MeshReport | None = None,
    remarks: Sequence[str] = (),
    size: tuple[int, int] = (900, 640),
    copies: Sequence[int] = (1,),
) -> None:
    """Write a self-contained HTML page about a surface and its period matrix.

    Pictures are left out, and the page says why, if the surface has no positions in space or this
    machine cannot draw.

    Parameters
    ----------
    path : path-like
    pm : PeriodMatrix
        Best in a Siegel-reduced marking, ``pm.reduced()``: the matrix is printed in the marking
        of ``pm``, and its cycles are those of the pictures.
    name : str
        What the surface is called.
    mesh : MeshReport, optional
        What :func:`~igl_periods.load_mesh` found in its file.
    remarks : sequence of str
        Sentences about the surface and the computation that the page shall say at its beginning:
        :func:`~igl_periods.reports.method_in_words`.
    size : (int, int)
        Width and height of the pictures in pixels.
    copies : sequence of int
        How many copies of the cell of a periodic surface they show, along each translation.

    Raises
    ------
    MissingExtraError
        If matplotlib, Open3D or Pillow are not installed.
    OSError
        If the file cannot be written, before anything is drawn.
    """
    check_output(path)
    require("a report", "matplotlib", "open3d", "PIL")
    quality = mesh_quality(pm.complex)
    P = parametrize(pm, most_even_form(pm)) if pm.genus else None
    page = Template(files(__package__).joinpath("page.html").read_text("utf-8"))
    text = page.substitute(
        title=escape(name),
        facts=_facts(pm),
        remarks=_paragraphs(list(remarks)),
        pictures=_pictures(pm.complex.cell, copies, _scenes(pm, quality, P), size),
        matrix=_matrix(pm),
        mesh=f"<pre>{escape(str(mesh))}</pre>" if mesh else "<p>No mesh file was read.</p>",
        advice=_paragraphs(advice(quality) + (parametrization_in_words(P) if P else [])),
        histograms="\n".join(_histograms(pm, quality, P)),
        citation=_paragraphs([_CITATION, f"igl_periods {version('igl_periods')}."]),
        version=version("igl_periods"),
    )
    Path(path).write_text(text, encoding="utf-8")


def _facts(pm: PeriodMatrix) -> str:
    K = pm.complex
    return (
        f"A closed surface of genus {pm.genus}, made of {K.n_faces} triangles with {K.n_edges} "
        f"edges and {K.n_vertices} vertices."
    )


def _paragraphs(sentences: list[str]) -> str:
    return "\n".join(f"<p>{escape(sentence)}</p>" for sentence in sentences)


# ---- Pictures ----


def _scenes(pm: PeriodMatrix, quality: MeshQuality, P: Parametrization | None) -> Iterator[Scene]:
    if P is None:
        yield plain_scene(pm.complex)
        return
    yield cycles_scene(pm)
    yield checkerboard_scene(P)
    yield density_scene(P)
    yield quality_scene(pm.complex, quality)
    yield cut_scene(P)


def _pictures(
    cell: Cell | None, copies: Sequence[int], scenes: Iterator[Scene], size: tuple[int, int]
) -> str:
    try:
        figures = [
            _figure(with_legend(render(scene, size), scene), scene.caption)
            for scene in (periodic_copies(scene, cell, copies) for scene in scenes)
        ]
    except (RenderError, ComplexError) as error:
        logger.warning("no pictures: %s", error)
        return f"<p>There are no pictures: {escape(str(error))}</p>"
    return '<div class="pictures">\n' + "\n".join(figures) + "\n</div>"


def _figure(picture: NDArray[np.uint8], caption: str) -> str:
    from PIL import Image

    stream = io.BytesIO()
    Image.fromarray(picture).save(stream, format="PNG", optimize=True)
    return _embedded(stream.getvalue(), "image/png", caption)


def _embedded(data: bytes, kind: str, caption: str) -> str:
    source = f"data:{kind};base64,{base64.b64encode(data).decode()}"
    text = escape(caption, quote=True)
    return f'<figure><img src="{source}" alt="{text}"><figcaption>{text}</figcaption></figure>'


# ---- The matrix ----


def _matrix(pm: PeriodMatrix) -> str:
    if pm.genus == 0:
        return "<p>The surface is a sphere: its period matrix is empty, there are no periods.</p>"
    parts = [
        "<p>Π in the marking of the pictures: "
        "Π<sub>kl</sub> is the integral along b<sub>l</sub> of the holomorphic form ζ<sub>k</sub> "
        "whose integrals along a<sub>1</sub> … a<sub>g</sub> are 0, but for 1 along a<sub>k</sub>."
        "</p>",
        _table(pm),
        f'<p class="bound">{escape(bound_in_words(pm))}</p>',
        _download(pm),
    ]
    return "\n".join(parts)


def _table(pm: PeriodMatrix) -> str:
    if pm.genus > LARGEST_SHOWN:
        return f"<p>{pm.genus} × {pm.genus} entries; all of them are in the file below.</p>"
    return f'<div class="scroll">{matrix_html(pm.matrix, pm.entry_bounds)}</div>'


def _download(pm: PeriodMatrix) -> str:
    data = base64.b64encode(json.dumps(period_matrix_to_json(pm)).encode()).decode()
    return (
        '<p><a download="period_matrix.json" href="data:application/json;base64,'
        f'{data}">period_matrix.json</a>: the matrix to full precision, all estimates, bounds.</p>'
    )


# ---- Histograms ----


def _histograms(pm: PeriodMatrix, quality: MeshQuality, P: Parametrization | None) -> Iterator[str]:
    yield _histogram(
        np.degrees(quality.angles.ravel()), "angle (degrees)", "Angles of the mesh.", (0.0, 180.0)
    )
    yield _histogram(
        np.degrees(quality.delaunay_angles.ravel()),
        "angle (degrees)",
        f"Angles after {quality.flips} intrinsic Delaunay flips.",
        (0.0, 180.0),
    )
    yield _histogram(
        quality.weights,
        "weight",
        f"Cotangent weights; {quality.non_delaunay_edges} edges have negative ones.",
    )
    yield _histogram(
        np.degrees(quality.cone_angles),
        "angle (degrees)",
        "Total angles at the vertices; the surface is flat at 360°.",
    )
    if P is not None:
        share = quality.excess / max(float(quality.excess.max()), 1e-300)
        yield _histogram(
            np.log10(np.maximum(share, 1e-9)),
            "log₁₀ of the share, relative to the largest",
            f"Shares of the triangles in the bound; half of it originates in "
            f"{quality.half_of_the_bound} of {quality.excess.size}.",
        )
        yield _histogram(
            P.dilatation,
            "ratio of stretches",
            "Conformal distortion of the checkerboard; 1 is conformal.",
        )


def _histogram(
    values: Floats, label: str, caption: str, limits: tuple[float, float] | None = None
) -> str:
    """A histogram, without the extreme half percent at both ends unless limits are given."""
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    finite = values[np.isfinite(values)]
    low, high = limits or np.percentile(finite, [0.5, 99.5])
    if high - low < 1e-9 * max(1.0, abs(high)):
        low, high = low - 0.5, high + 0.5
    with rc_context({"svg.hashsalt": label, "font.size": 9, "axes.spines.top": False,
                     "axes.spines.right": False}):  # fmt: skip
        figure = Figure(figsize=(4.4, 2.2), layout="constrained")
        axes = figure.subplots()
        axes.hist(finite, bins=60, range=(float(low), float(high)), color="#29508a")
        axes.set_xlabel(label)
        axes.set_yticks([])
        axes.spines["left"].set_visible(False)
        stream = io.BytesIO()
        figure.savefig(stream, format="svg", metadata={"Date": None})
    return _embedded(stream.getvalue(), "image/svg+xml", caption)
