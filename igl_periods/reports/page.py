"""A page about a surface: pictures, its period matrix and what is known about it, its mesh.

The page is one HTML file that needs nothing else: pictures are in it, and so is the surface to turn
(:mod:`igl_periods.pictures.viewer`), which is the only part that runs a script.
"""

from __future__ import annotations

import base64
import json
import logging
import os
from collections.abc import Mapping, Sequence
from html import escape
from importlib.metadata import version
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import Any

from numpy.typing import NDArray

from igl_periods.complexes import DeltaComplex, involution
from igl_periods.differentials import Parametrization, most_even_form, parametrize
from igl_periods.display import LARGEST_SHOWN, matrix_html
from igl_periods.errors import ComplexError, RenderError
from igl_periods.machine import check_output, require
from igl_periods.meshes import MeshReport
from igl_periods.periods import MeshQuality, PeriodMatrix, mesh_quality
from igl_periods.pictures import (
    Scene,
    periodic_copies,
    png_bytes,
    render_all,
    scenes_of_matrix,
    viewer_of_scenes,
)

from .findings import invariants, named_surfaces, symmetries
from .histograms import histograms
from .json_document import period_matrix_to_json
from .typesetting import figure, legend, mathematics, paragraphs, table
from .words import advice, bound_in_words, options_in_words, parametrization_in_words

logger = logging.getLogger("igl_periods")
_CITATION = (
    "A. I. Bobenko, C. Mercat, M. Schmies, Period matrices of polyhedral surfaces, in: A. I. "
    "Bobenko, C. Klein (eds.), Computational Approach to Riemann Surfaces, Lecture Notes in "
    "Mathematics 2013, Springer (2011)."
)
_BIBTEX = """@incollection{BobenkoMercatSchmies2011,
  author    = {Bobenko, Alexander I. and Mercat, Christian and Schmies, Markus},
  title     = {Period Matrices of Polyhedral Surfaces},
  booktitle = {Computational Approach to Riemann Surfaces},
  editor    = {Bobenko, Alexander I. and Klein, Christian},
  series    = {Lecture Notes in Mathematics},
  volume    = {2013},
  publisher = {Springer},
  year      = {2011},
  eprint    = {0909.1305},
  archivePrefix = {arXiv}
}

@software{igl_periods,
  author  = {{the igl\\_periods maintainers}},
  title   = {igl\\_periods: period matrices of triangle meshes and polyhedral surfaces, with
             certified error bounds},
  version = {$version}
}"""
_DEFINITION = (
    "<p>Π in the marking of the pictures: Π<sub><i>kl</i></sub> is the integral along "
    "<i>b</i><sub><i>l</i></sub> of the holomorphic form ζ<sub><i>k</i></sub> whose integrals "
    "along <i>a</i><sub>1</sub>, …, <i>a</i><sub><i>g</i></sub> are 0, but for 1 along "
    "<i>a</i><sub><i>k</i></sub>.</p>"
)
# Of pictures beside a surface that one can turn, and of pictures alone.
_BESIDE, _ALONE = (480, 344), (900, 640)
_HEIGHT = 600
# What the page may do: without a surface to turn no script runs.
_POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
_POLICY_OF_VIEWERS = (
    "default-src 'none'; img-src data: blob:; font-src data:; style-src 'unsafe-inline'; "
    "script-src 'unsafe-inline'; worker-src blob:"
)


def write_report(
    path: str | os.PathLike[str],
    pm: PeriodMatrix,
    *,
    name: str,
    mesh: MeshReport | None = None,
    remarks: Sequence[str] = (),
    options: Mapping[str, Any] | None = None,
    size: tuple[int, int] | None = None,
    copies: Sequence[int] = (1,),
    interactive: bool = True,
) -> None:
    """Write a self-contained HTML page about a surface and its period matrix.

    Pictures are left out, and the page says why, if the surface cannot be drawn in space or in the
    plane, or this machine cannot draw.

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
    options : mapping, optional
        The options of :func:`~igl_periods.period_matrix` that ``pm`` was computed with; what is
        missing is as usual.  Without them the page does not tell options.
    size : (int, int), optional
        Width and height of the pictures in pixels; by default 900 × 640, smaller beside a surface
        that can be turned.
    copies : sequence of int
        How many copies of the cell of a periodic surface they show, along each translation.
    interactive : bool
        Whether there is a surface to turn on the page, which takes 1 MB, and 3 MB for 100,000
        triangles.

    Raises
    ------
    MissingExtraError
        If matplotlib, Open3D, Pillow, or k3d for a surface to turn are not installed.
    OSError
        If the file cannot be written, before anything is drawn.
    """
    check_output(path)
    require("a report", *(["k3d"] if interactive else []), "matplotlib", "open3d", "PIL")
    quality = mesh_quality(pm.complex)
    P = parametrize(pm, most_even_form(pm)) if pm.genus else None
    sections = {
        "facts": table("The surface", _facts(pm)),
        "options": table("Options", options_in_words(options)) if options is not None else "",
        "remarks": paragraphs(remarks),
        "pictures": _pictures(_scenes(pm, P, quality, copies), name, size, interactive),
        "matrix": _matrix(pm),
        "findings": _findings(pm),
        "mesh": _mesh(mesh),
        "advice": paragraphs(advice(quality) + (parametrization_in_words(P) if P else [])),
        "histograms": "\n".join(histograms(quality, P)),
        "citation": paragraphs([_CITATION]),
        "bibtex": escape(Template(_BIBTEX).substitute(version=version("igl_periods"))),
    }
    page = Template(files(__package__).joinpath("page.html").read_text("utf-8"))
    text = page.substitute(
        sections,
        title=escape(name),
        policy=_POLICY_OF_VIEWERS if interactive else _POLICY,
        version=version("igl_periods"),
    )
    Path(path).write_text(text, encoding="utf-8")


def _facts(pm: PeriodMatrix) -> list[tuple[str, str]]:
    K = pm.complex
    facts = [
        ("genus", str(pm.genus)),
        ("triangles", str(K.n_faces)),
        ("edges", str(K.n_edges)),
        ("vertices", str(K.n_vertices)),
    ]
    if _is_double(K):
        facts.append(("double", f"two sheets of {K.n_faces // 2} triangles; pictures show one"))
    if K.polygons is not None:
        facts.append(("glued from", f"{len(K.polygons.vertices)} polygons of the plane"))
    if K.mollification:
        facts.append(("added to the length of every edge", f"{K.mollification:.3g}"))
    return facts


def _is_double(K: DeltaComplex) -> bool:
    try:
        involution(K)
    except ComplexError:
        return False
    return True


def _mesh(mesh: MeshReport | None) -> str:
    """What the report of a mesh says, without the folder that it was in."""
    if mesh is None:
        return "<p>No mesh file was read.</p>"
    text = str(mesh).replace(mesh.file, Path(mesh.file).name)
    return f'<pre tabindex="0" role="region" aria-label="The mesh file">{escape(text)}</pre>'


# ---- Pictures ----


def _scenes(
    pm: PeriodMatrix, P: Parametrization | None, quality: MeshQuality, copies: Sequence[int]
) -> dict[str, Scene] | str:
    """All that there is to see, or why there is nothing."""
    try:
        scenes = scenes_of_matrix(pm, P, quality)
    except ComplexError as error:
        return str(error)
    cell = pm.complex.cell
    return {name: periodic_copies(scene, cell, copies) for name, scene in scenes.items()}


def _pictures(
    scenes: dict[str, Scene] | str, name: str, size: tuple[int, int] | None, interactive: bool
) -> str:
    if isinstance(scenes, str):
        return _no_pictures(scenes)
    parts = []
    if interactive:
        viewer = viewer_of_scenes(scenes, title=f"{name}, to turn")
        parts.append(f'<div class="viewer">{viewer.frame(_HEIGHT)}</div>')
    try:
        drawn = render_all(scenes.values(), size or (_BESIDE if interactive else _ALONE))
    except RenderError as error:
        return "\n".join([*parts, _no_pictures(str(error))])
    figures = [
        figure(png_bytes(picture), "image/png", scene.caption, legend(scene.legend))
        for picture, scene in zip(drawn, scenes.values())
    ]
    return "\n".join([*parts, '<div class="pictures">', *figures, "</div>"])


def _no_pictures(why: str) -> str:
    logger.warning("no pictures: %s", why)
    return f"<p>There are no pictures: {mathematics(why)}</p>"


# ---- The matrix ----


def _matrix(pm: PeriodMatrix) -> str:
    if pm.genus == 0:
        return "<p>The surface is a sphere: its period matrix is empty, there are no periods.</p>"
    return "\n".join(
        [
            _DEFINITION,
            _shown(pm, pm.matrix, "Π"),
            f'<p class="bound">{mathematics(bound_in_words(pm))}</p>',
            "<details><summary>Its real and its imaginary part</summary>",
            _shown(pm, pm.matrix.real, "Re Π"),
            _shown(pm, pm.matrix.imag, "Im Π"),
            "</details>",
            _download(pm),
        ]
    )


def _shown(pm: PeriodMatrix, matrix: NDArray[Any], name: str) -> str:
    """A matrix with the digits that are known: bounds of entries are bounds of their parts too."""
    if pm.genus > LARGEST_SHOWN:
        return f"<p>{name}: {pm.genus} × {pm.genus} entries; all of them are in the file below.</p>"
    return (
        f'<div class="scroll" role="region" tabindex="0" aria-label="{name}">'
        f"<p>{name} =</p>{matrix_html(matrix, pm.entry_bounds)}</div>"
    )


def _download(pm: PeriodMatrix) -> str:
    data = base64.b64encode(json.dumps(period_matrix_to_json(pm)).encode()).decode()
    return (
        '<p><a download="period_matrix.json" href="data:application/json;base64,'
        f'{data}">period_matrix.json</a>: the matrix to full precision, all estimates, bounds.</p>'
    )


def _findings(pm: PeriodMatrix) -> str:
    """What Π says about the surface, in tables."""
    tables = {
        "Named surfaces near Π": named_surfaces(pm),
        "Invariants": invariants(pm),
        "Symmetries": symmetries(pm),
    }
    found = [table(caption, rows) for caption, rows in tables.items() if rows]
    return "\n".join(found) or "<p>A sphere has no moduli.</p>"
