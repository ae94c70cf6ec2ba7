r"""Closed forms c + df of high degree: their coefficients, and those of their functions on a face.

On a face, the form c + df is the differential of one function, which is determined up to a
constant; it is counted from its value at the apex.  Differences of values at corners are taken
before anything else: nearby numbers subtract without error, so that gradients stay accurate where
f is large.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.sparse import csr_array

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex

from .placement import Elements
from .trace_system import jumps, unknowns


@dataclass(frozen=True, eq=False)
class HighOrderForms:
    """Closed forms c + df with f of degree p on every face.

    Attributes
    ----------
    complex : DeltaComplex
        The complex that carries them: the one handed over, or its refinement.
    cochains : (k, n_edges) sparse int
        Their cohomology classes c.
    degree : int
        The degree p.
    elements : tuple of Elements
        The flat elements, and the conical ones, where there are any.
    extensions : tuple of (m, n - 3 p, 3 p) float
        For each of ``elements``: coefficients of bubbles in terms of those of traces.
    traces : (n_vertices + (p - 1) n_edges, k) float
        The functions f: their values at vertices, then their coefficients of ℓ_2 … ℓ_p along
        each edge, in its direction.
    """

    complex: DeltaComplex
    cochains: csr_array
    degree: int
    elements: tuple[Elements, ...]
    extensions: tuple[Floats, ...]
    traces: Floats


def coefficients(forms: HighOrderForms, elements: Elements, block: Ints) -> Floats:
    """Coefficients of potentials of the forms on some elements, 0 at the apex; (n, b, k) float.

    Parameters
    ----------
    elements : Elements
        One of ``forms.elements``.
    block : (b,) int
        Which of them.
    """
    extension = forms.extensions[forms.elements.index(elements)]
    return coefficients_on(forms, forms.cochains.T.tocsr(), elements, extension, block)


def coefficients_on(
    forms: HighOrderForms, by_edge: csr_array, elements: Elements, extension: Floats, block: Ints
) -> Floats:
    """The same, where the cochains are at hand as columns and the extension is known."""
    index, sign = unknowns(forms.complex, elements, block)
    u = _from_apex(sign[:, :, None] * forms.traces[index])
    u[:, 1:3] += jumps(forms.complex, by_edge, elements, block)
    return _extended(u, extension[block])


def function_coefficients(
    forms: HighOrderForms, traces: Floats, elements: Elements, extension: Floats, block: Ints
) -> Floats:
    """Coefficients of functions of other traces on some elements; (n, b, k) float."""
    index, sign = unknowns(forms.complex, elements, block)
    return _extended(_from_apex(sign[:, :, None] * traces[index]), extension[block])


def _from_apex(u: Floats) -> Floats:
    u[:, 1:3] -= u[:, :1]
    u[:, 0] = 0.0
    return u


def _extended(u: Floats, extension: Floats) -> Floats:
    return np.concatenate([u, extension @ u], axis=1).transpose(1, 0, 2)
