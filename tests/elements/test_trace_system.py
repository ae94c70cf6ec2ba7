"""The system of traces: arithmetic that breaks down is reported."""

from dataclasses import replace

import numpy as np
import pytest
from support.cone_surfaces import ORIGAMIS, forms_of

import igl_periods as ip
from igl_periods.elements import trace_system as assembly
from igl_periods.elements.placement import choose_elements


def test_arithmetic_that_breaks_down_is_reported(monkeypatch):
    K = ORIGAMIS[0]
    system = assembly.condensed_system(K, ip.cohomology_basis(K), choose_elements(K, 2))
    lost = replace(system, matrix=0.0 * system.matrix)
    with pytest.raises(ip.ComplexError, match="some triangles are too thin for elements of high"):
        assembly.least_traces(lost)

    def singular(elements):
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr(assembly, "condense", singular)
    with pytest.raises(ip.ComplexError, match="not positive definite in floating-point arithmetic"):
        forms_of(K, 2)
