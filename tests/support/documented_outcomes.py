"""What becomes of a file, a mesh or a gluing: results that are checked, or a documented error."""

import contextlib
import json
import math
import warnings
from collections import Counter
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from support.modular_words import random_word
from support.result_checks import check_agreement, check_result
from support.second_readers import READERS

import igl_periods as ip
from igl_periods.meshes.gluing_file import read_gluing
from igl_periods.meshes.repair import repair_mesh
from igl_periods.periods.matrix import siegel_reduced
from igl_periods.reports.json_document import result_to_json

MOST_FACES = 4_000


def verdict(kind, example):
    """What an example of some kind comes to, in a word."""
    return _VERDICTS[kind](*example)


def _on_file(file, repair, largest_hole):
    extension, content = file
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"mesh{extension}"
        path.write_bytes(content)
        if extension == ".json":
            return _on_complex(read_gluing(path))
        with warnings.catch_warnings():
            # Of what is odd about a file.
            warnings.simplefilter("ignore", UserWarning)
            V, F, report = ip.load_mesh(path, repair=repair, largest_hole=largest_hole)
        str(report), report.as_dict()
        if not repair and extension in READERS and not report.warnings:
            _check_reading(extension, content, V, F)
    assert V.dtype == np.float64 and F.dtype == np.int64
    assert np.isfinite(V[F]).all()
    if len(F) > MOST_FACES:
        return "too large"
    return _on_complex(ip.DeltaComplex.from_mesh(V, F))


def _check_reading(extension, content, V, F):
    try:
        positions, polygons = READERS[extension](content)
    except (ValueError, LookupError, TypeError, StopIteration):
        # A dialect that the simple reader does not know has no second opinion.
        return
    if polygons and all(len(p) == 3 for p in polygons):
        expected = np.array(positions, dtype=float)[np.array(polygons)]
        assert np.array_equal(V[F], expected), np.abs(V[F] - expected).max()
    # However polygons are divided, the boundary of the triangles is that of the polygons.
    points = np.array(positions, dtype=float)
    assert not polygons or _chain(V, F) == _chain(points, polygons)


def _chain(V, polygons):
    """The sum of the sides of polygons, those in opposite directions cancelled."""
    sides = Counter()
    for p in polygons:
        corners = [tuple(V[i]) for i in p]
        for a, b in zip(corners, [*corners[1:], corners[0]]):
            if a != b:
                sides[max((a, b), (b, a))] += 1 if a < b else -1
    return {side: n for side, n in sides.items() if n}


def _on_mesh(V, F):
    return _on_complex(ip.DeltaComplex.from_mesh(V, F))


def _on_lengths(lengths, F):
    return _on_complex(ip.DeltaComplex.from_lengths(lengths, F))


def _on_gluing(lengths, twin, same):
    return _on_complex(ip.DeltaComplex.from_gluing(lengths, twin, same))


def _on_weights(rho, twin, same):
    pm = ip.period_matrix_from_weights(rho, twin)
    check_result(pm)
    return f"genus {min(pm.genus, 3)}"


def _on_squares(gluing, n):
    return _on_complex(ip.DeltaComplex.from_squares(gluing, n))


def _on_repair(mesh, largest_hole):
    V, F, _ = repair_mesh(*mesh, largest_hole=largest_hole)
    return _on_mesh(V, F)


def _on_complex(K):
    """Every component, with every option; of what is not closed or oriented the double."""
    if K.n_boundary_edges or K.n_reversing_edges:
        doubled = ip.double(K)
        for part in doubled.components()[:3]:
            _check_all_options(part)
        return "doubled"
    genera = [_check_all_options(part) for part in K.components()[:3]]
    return f"genus {min(max(genera), 3)}"


def _check_all_options(K):
    pm = ip.period_matrix(K)
    check_result(pm)
    coarse = ip.period_matrix(K, delaunay=False)
    check_result(coarse)
    check_agreement(pm, coarse)
    fine = ip.period_matrix(K, degree=2)
    check_result(fine)
    check_agreement(pm, fine)
    check_agreement(coarse, fine)
    _check_scale(K, pm)
    _check_marking(pm, 3 * K.n_faces)
    if K.positions is not None:
        check_result(ip.period_matrix(K, weights="extrinsic"))
    str(ip.mesh_quality(K))
    json.dumps(result_to_json(pm, *siegel_reduced(pm)), allow_nan=False)
    return pm.genus


def _check_marking(pm, seed):
    """In another marking the same surface, or no digits would be left."""
    if pm.genus == 0:
        return
    rng = np.random.default_rng(seed)
    gamma = random_word(pm.genus, 30, rng, largest=10 ** int(rng.integers(1, 12)))
    with contextlib.suppress(ip.ComplexError):  # no digits of the energies would be left
        moved = pm.change_basis(gamma)
        _check_moved(pm, gamma, moved)


def _check_moved(pm, gamma, moved):
    check_result(moved)
    scale = np.sqrt(np.diag(moved.matrix.imag))
    allowed = (pm.rounding_allowance + moved.rounding_allowance) * np.outer(scale, scale)
    assert np.all(np.abs(moved.matrix - ip.siegel_transform(gamma, pm)) <= allowed)


def _check_scale(K, pm):
    """Powers of two change nothing, not even a bit."""
    factor = math.ldexp(1.0, -math.frexp(float(K.lengths.max()))[1])
    scaled = replace(K, lengths=K.lengths * factor)
    assert np.array_equal(ip.period_matrix(scaled).dirichlet, pm.dirichlet)


_VERDICTS = {
    "file": _on_file,
    "scene file": _on_file,
    "mesh": _on_mesh,
    "repair": _on_repair,
    "lengths": _on_lengths,
    "gluing": _on_gluing,
    "needles": _on_gluing,
    "weights": _on_weights,
    "squares": _on_squares,
}
