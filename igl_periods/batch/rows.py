r"""What one file becomes in a table of many: a row for each component, or a row with an error.

Every surface has its row, also one that is refused: then ``error`` says why, ``error_kind`` is the
name of the exception, and what could not be computed is None.  A file that cannot be read at all
has a single row, and so has one that is torn into pieces along its seams, whose pieces mean
nothing.  Nothing but the file and the options decides what a row holds, except for
``seconds``, as long as there is enough memory; so a table does not depend on who computed which
part of it.

Matrices are flat, row by row: Π is ``reshape(matrix_real, (g, g)) + 1j * reshape(matrix_imag,
(g, g))``, Siegel reduced unless ``reduced`` is False.  It is known up to the marking only, and two
matrices are compared with :func:`~igl_periods.symplectic_isomorphisms`, not entry by
entry.  Invariants of Π do not depend on the marking:

* g = 1: Klein's j in ball arithmetic, with a certified radius where Π has a bound;
* g = 2: the absolute invariants :math:`(I_2^5, I_2^3 I_4, I_2^2 I_6) / I_{10}` of the curve, in
  floating point, without any certificate;
* g = 2, 3: how many even theta constants may vanish within the bound.  If none does, a surface of
  genus 3 is certainly not hyperelliptic, and one of genus 2 no product of elliptic curves.
"""

from __future__ import annotations

import hashlib
import json
import os
import threading
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, fields, replace
from importlib.metadata import version
from os import PathLike
from typing import Any

from igl_periods.complexes import DeltaComplex, as_complex
from igl_periods.errors import ComplexError
from igl_periods.machine import one_thread
from igl_periods.meshes import (
    WELD,
    MeshReport,
    checked_repair,
    components_by_genus,
    read_surface,
    surface_of,
    way_out,
)
from igl_periods.moduli import (
    absolute_igusa_invariants,
    certified_j_invariant,
    vanishing_even_characteristics,
)
from igl_periods.options import checked_switch
from igl_periods.periods import (
    PeriodMatrix,
    ToleranceWarning,
    checked_limits,
    checked_options,
    period_matrix,
    reduced_if_feasible,
)

Row = dict[str, Any]
# The columns in their order; every value may be None, except for the file.
COLUMNS: dict[str, Any] = {
    "file": str,  # as it was found, relative to the folder that was searched
    "component": int,  # counted from 1; None if the file as a whole is refused
    "hash": str,  # SHA-256 of the bytes of the file; None if they cannot be read
    "genus": int,
    "vertices": int,
    "faces": int,
    "reduced": bool,  # False above SIEGEL_GENUS_LIMIT, or beyond double precision: mesh marking
    "matrix_real": list[float],
    "matrix_imag": list[float],
    "bound": float,  # None without a certificate, as is the next one
    "entry_bound": float,  # no entry of the matrix is off by more
    "symplectic_eigenvalues": list[float],
    "j_real": float,
    "j_imag": float,
    "j_error": float,  # certified; None without a certificate
    "igusa_real": list[float],
    "igusa_imag": list[float],
    "vanishing_thetas": int,
    "hyperelliptic": bool,  # None where it is not proved
    "mollification": float,
    "mesh_report": str,  # JSON; in the first row of a file
    "options": str,  # JSON
    "version": str,
    "seconds": float,  # reading the file counts for its first row
    "warning": str,
    "error": str,
    "error_kind": str,
}
# The kind of error of a file on which workers died.
DIED = "WorkerDied"
_SWITCHES = ("repair", "double", "delaunay", "rigorous")
_OF_MESH = ("repair", "weld", "largest_hole")
_BYTES_AT_ONCE = 2**20


@dataclass(frozen=True)
class BatchOptions:
    """What is done to every file: as the options of ``igl-periods compute``.

    Attributes
    ----------
    repair, weld, largest_hole
        As in :func:`~igl_periods.load_mesh`.
    double : bool
        Take the doubles of the surfaces.
    weights, delaunay, degree, tolerance, rigorous, max_memory
        As in :func:`~igl_periods.period_matrix`; the limit is that of one file, and where none is
        given a file is refused when the memory that is free at the time does not suffice.

    Raises
    ------
    ValueError
        If an option has no such value, or options contradict each other.
    """

    repair: bool = False
    weld: float = WELD
    largest_hole: int = 0
    double: bool = False
    weights: str = "intrinsic"
    delaunay: bool = True
    degree: int = 1
    tolerance: float | None = None
    rigorous: bool = False
    max_memory: float | None = None

    def __post_init__(self) -> None:
        degree, tolerance = checked_options(
            self.weights, self.degree, self.tolerance, self.rigorous
        )
        weld, largest_hole = checked_repair(self.weld, self.largest_hole)
        _, max_memory = checked_limits(None, self.max_memory)
        checked = {
            **{name: checked_switch(name, getattr(self, name)) for name in _SWITCHES},
            "weld": weld,
            "largest_hole": largest_hole,
            "degree": degree,
            "tolerance": tolerance,
            "max_memory": max_memory,
        }
        for name, value in checked.items():
            object.__setattr__(self, name, value)

    def __repr__(self) -> str:
        default = {f.name: f.default for f in fields(self)}
        chosen = {k: v for k, v in asdict(self).items() if v != default[k]}
        return f"BatchOptions({', '.join(f'{k}={v!r}' for k, v in chosen.items())})"

    def as_json(self) -> str:
        """All options, in one order."""
        return json.dumps(asdict(self))

    def of_mesh(self) -> dict[str, Any]:
        """The keywords of :func:`~igl_periods.load_mesh`."""
        return {name: getattr(self, name) for name in _OF_MESH}

    def of_period_matrix(self) -> dict[str, Any]:
        """The keywords of :func:`~igl_periods.period_matrix`."""
        return {k: v for k, v in asdict(self).items() if k not in (*_OF_MESH, "double")}


def rows_of(
    path: str | PathLike[str], options: BatchOptions | None = None, name: str | None = None
) -> list[Row]:
    """The rows of one file, computed here and now with one thread of linear algebra.

    Parameters
    ----------
    path : path-like
        A mesh, or a gluing of triangles (.json).
    options : BatchOptions, optional
    name : str, optional
        What the column ``file`` says; default: the path.

    Returns
    -------
    list of dict
        With the keys ``COLUMNS``: one for each component, in the order of ``--component``, or one
        for all of the file if it is refused as a whole.  Whatever a file raises is in its row.

    Examples
    --------
    >>> (row,) = rows_of("no-such-mesh.off")
    >>> row["error_kind"], row["error"]
    ('FileNotFoundError', "there is no mesh file 'no-such-mesh.off'")
    """
    options = options or BatchOptions()
    lap = _stopwatch()
    name = str(path) if name is None else name
    common = _common(name, path, options)
    with one_thread():
        return [{**row, **common} for row in _computed(path, options, name, lap)]


def refused_row(name: str, path: str | PathLike[str], options: BatchOptions, **error: str) -> Row:
    """The row of a file of which nothing is known but an error."""
    return _row(**_common(name, path, options), **error)


def file_hash(path: str | PathLike[str]) -> str | None:
    """SHA-256 of the bytes of a file in hexadecimal digits; None if they cannot be read."""
    digest = hashlib.sha256()
    if not os.path.isfile(path):
        return None
    try:
        with open(path, "rb") as file:
            while block := file.read(_BYTES_AT_ONCE):
                digest.update(block)
    except OSError:
        return None
    return digest.hexdigest()


def _common(name: str, path: str | PathLike[str], options: BatchOptions) -> Row:
    return {
        "file": name,
        "hash": file_hash(path),
        "options": options.as_json(),
        "version": version("igl_periods"),
    }


def _row(**values: Any) -> Row:
    return {**dict.fromkeys(COLUMNS), **values}


def _computed(
    path: str | PathLike[str], options: BatchOptions, name: str, lap: Callable[[], float]
) -> Iterator[Row]:
    """The rows without what is common to them."""
    first: Row = {}
    try:
        surface, report = read_surface(path, **options.of_mesh())
        first["mesh_report"] = report and _report_as_json(report, name)
        parts = components_by_genus(surface_of(as_complex(*surface), options.double))
        _check_pieces(parts, report)
    except Exception as error:
        yield _row(**first, **_refusal(error, path), seconds=lap())
        return
    for k, K in enumerate(parts):
        row = _row(**first, component=k + 1, vertices=K.n_vertices, faces=K.n_faces)
        first = {}
        try:
            row |= _period_columns(K, options)
        except Exception as error:
            row |= _refusal(error, path)
        yield {**row, "mollification": K.mollification, "seconds": lap()}


def _check_pieces(parts: list[DeltaComplex], report: MeshReport | None) -> None:
    """Refuse a file as a whole that has nothing but pieces of a torn surface."""
    if not report or not report.result.seam_edges or len(parts) == 1:
        return
    if all(part.n_boundary_edges for part in parts):
        raise ComplexError(f"the surface is torn into {len(parts)} pieces. {way_out(report)}")


def _refusal(error: Exception, path: str | PathLike[str]) -> Row:
    message = str(error).removeprefix(f"{path}: ")
    return {"error": message or type(error).__name__, "error_kind": type(error).__name__}


def _report_as_json(report: MeshReport, name: str) -> str:
    return json.dumps(replace(report, file=name).as_dict())


def _period_columns(K: DeltaComplex, options: BatchOptions) -> Row:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        pm = period_matrix(K, **options.of_period_matrix())
        reduced, _ = reduced_if_feasible(pm)
    pm = pm if reduced is None else reduced
    told = [str(w.message) for w in caught if issubclass(w.category, ToleranceWarning)]
    bounds = pm.entry_bounds
    return {
        "genus": pm.genus,
        "reduced": reduced is not None,
        "matrix_real": pm.matrix.real.ravel().tolist(),
        "matrix_imag": pm.matrix.imag.ravel().tolist(),
        "bound": pm.bound,
        "entry_bound": None if bounds is None else float(bounds.max(initial=0.0)),
        "symplectic_eigenvalues": pm.symplectic_eigenvalues.tolist(),
        "warning": " ".join(told) or None,
        **_invariants(pm),
    }


def _invariants(pm: PeriodMatrix) -> Row:
    """What is quick and known of the invariants of a reduced matrix."""
    if pm.genus == 1:
        found = certified_j_invariant(pm)
        if found is None:
            return {}
        j, error = found
        return {"j_real": j.real, "j_imag": j.imag, "j_error": error if pm.certified else None}
    if pm.genus not in (2, 3) or not pm.certified:
        return {}
    vanishing = vanishing_even_characteristics(pm)
    if vanishing is None:
        return {"hyperelliptic": True} if pm.genus == 2 else {}
    known: Row = {"vanishing_thetas": len(vanishing)}
    if pm.genus == 3:
        return known if vanishing else {**known, "hyperelliptic": False}
    igusa = None if vanishing else absolute_igusa_invariants(pm)
    if igusa is None:
        return {**known, "hyperelliptic": True}
    columns = {"igusa_real": igusa.real.tolist(), "igusa_imag": igusa.imag.tolist()}
    return {**known, "hyperelliptic": True, **columns}


def _stopwatch() -> Callable[[], float]:
    """A function that returns the seconds since it was called last, or made."""
    last = time.perf_counter()

    def lap() -> float:
        nonlocal last
        before, last = last, time.perf_counter()
        return last - before

    return lap


_alone = threading.Lock()


def compute_file(path: str, name: str, options: BatchOptions) -> list[Row]:
    """:func:`rows_of`, waiting until this process computes nothing else."""
    with _alone:
        return rows_of(path, options, name)
