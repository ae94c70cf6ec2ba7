"""Period matrices and gluings as JSON.

A complex matrix is ``{"real": [[…]], "imag": [[…]]}``.  Every document has a ``schema`` number,
which grows when a reader of the old form would misread the new one.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from igl_periods.complexes import DeltaComplex, walk_vertices
from igl_periods.periods import PeriodMatrix
from igl_periods.topology import homology_basis

SCHEMA = 1


def matrix_to_json(matrix: NDArray[Any]) -> Any:
    """Nested lists of numbers; complex matrices as a pair of real ones."""
    if np.iscomplexobj(matrix):
        return {"real": matrix.real.tolist(), "imag": matrix.imag.tolist()}
    return matrix.tolist()


def period_matrix_to_json(pm: PeriodMatrix) -> dict[str, Any]:
    """All estimates and bounds of a period matrix, in its marking."""
    eigenvalues = pm.symplectic_eigenvalues.tolist()
    return {
        "genus": pm.genus,
        "matrix": matrix_to_json(pm.matrix),
        "certified": pm.certified,
        "bound": pm.bound,
        "rigorous": pm.rigorous,
        "rounding_allowance": pm.rounding_allowance if pm.certified else None,
        "entry_bounds": None if pm.entry_bounds is None else matrix_to_json(pm.entry_bounds),
        "symplectic_eigenvalues": eigenvalues,
        "primal": matrix_to_json(pm.primal),
        "dual": matrix_to_json(pm.dual),
        "mean": matrix_to_json(pm.mean),
        "dirichlet": matrix_to_json(pm.dirichlet),
    }


def cycles_to_json(K: DeltaComplex) -> dict[str, list[list[int]]]:
    """The canonical cycles as closed walks: the vertices passed, as rows of V."""
    walks = [K.labels[walk_vertices(K, walk)].tolist() for walk in homology_basis(K)]
    g = len(walks) // 2
    return {"a": walks[:g], "b": walks[g:]}


def result_to_json(
    pm: PeriodMatrix, reduced: PeriodMatrix | None, gamma: NDArray[Any] | None
) -> dict[str, Any]:
    """One surface: its matrix in the marking of the mesh, and Siegel reduced.

    ``reduced`` is the matrix in the marking ``gamma`` acts to: Π_reduced = (aΠ + b)(cΠ + d)⁻¹.
    Both are None, and ``reduced_marking`` is null, if it was not reduced.
    """
    K, reduced_marking = pm.complex, None
    if reduced is not None and gamma is not None:
        reduced_marking = {**period_matrix_to_json(reduced), "gamma": matrix_to_json(gamma)}
    return {
        "surface": {
            "vertices": K.n_vertices,
            "edges": K.n_edges,
            "faces": K.n_faces,
            "genus": pm.genus,
            "mollification": K.mollification,
        },
        "mesh_marking": {**period_matrix_to_json(pm), "cycles": cycles_to_json(K)},
        "reduced_marking": reduced_marking,
    }
