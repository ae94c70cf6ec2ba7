r"""Descent to the least energy where rounding keeps the solver away from it.

On a needle whose height is a fraction λ of its length, energies are of the size 1/λ, and so are
the entries of its matrix S; their rounding, ε/λ, is all that is left of what a function costs
that changes only across the needle.  The solution of the assembled system is then as far from the
least energy as S̃, what was assembled, is from S.  But the derivative of the energy itself can be
evaluated with all its digits, through the gradients of the functions:

.. math::  E(f) = \sum_i |X_i (c + f)|^2, \qquad \tfrac12 E'(f) = \sum_i X_i^T\, X_i (c + f),

a sum of products of small numbers where the energy is small.  So the energy is minimised by
conjugate gradients, preconditioned by the factor of S̃ and restarted from the true derivative at
each step.  As S̃ is close to S, few steps do.  No step raises the energy of any form.

References
----------
Nocedal, Wright, "Numerical optimization" (2006), sections 5.1 and 5.2.
Golub, Ye, "Inexact preconditioned conjugate gradient method with inner–outer iteration" (1999).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import length_sensitivity
from igl_periods.harmonic import CholeskyFactor, solve

from .condensation import scaled_gradients, transposed_gradients
from .placement import Elements
from .trace_system import unknowns
from .trial_forms import HighOrderForms, coefficients_on, function_coefficients

# Triangles up to this sensitivity to rounding lose nothing: the error of the energy is of the order
# of the square of ε times it.
_ORDINARY = 1e6
_MOST_STEPS = 30
# Steps that lower no energy by more than this part of it are the last.
_NEGLIGIBLE = 1e-14


def descended(forms: HighOrderForms, factor: CholeskyFactor) -> HighOrderForms:
    """The forms, with less energy where there are extremely thin triangles.

    Parameters
    ----------
    forms : HighOrderForms
        The solution of the system of equations, up to rounding.
    factor : CholeskyFactor
        Of the matrix of the system.
    """
    if not forms.traces.size or length_sensitivity(forms.complex.lengths).max() < _ORDINARY:
        return forms
    traces = forms.traces.copy()
    k = traces.shape[1]
    before, direction, gain = np.zeros_like(traces), np.zeros_like(traces), np.zeros(k)
    for _ in range(_MOST_STEPS):
        energy, slope = _energy_and_slope(replace(forms, traces=traces))
        steepest = np.zeros_like(slope)
        solve(factor, -slope[1:], out=steepest[1:])
        # Polak and Ribière: conjugate also if the preconditioner is not quite the same.
        turned = np.maximum(-np.sum((steepest - before) * slope, axis=0), 0.0)
        direction = (
            steepest + np.divide(turned, gain, out=np.zeros(k), where=gain > 0.0) * direction
        )
        before, gain = steepest, -np.sum(steepest * slope, axis=0)
        step, lowered = _best_step(forms, direction, slope)
        traces += step * direction
        if np.all(lowered <= _NEGLIGIBLE * energy):
            break
    return replace(forms, traces=traces)


def _best_step(forms: HighOrderForms, direction: Floats, slope: Floats) -> tuple[Floats, Floats]:
    """How far to go along the direction for each form, and by how much the energy falls; (k,)."""
    curvature = np.zeros(direction.shape[1])
    for elements, extension, block in _blocks(forms):
        u = function_coefficients(forms, direction, elements, extension, block)
        for X in scaled_gradients(elements, block, u):
            curvature += np.sum(X * X, axis=(0, 1))
    downhill = np.maximum(-np.sum(direction * slope, axis=0), 0.0)
    step = np.where(downhill > 0.0, downhill / np.where(curvature > 0.0, curvature, np.inf), 0.0)
    return step, step * downhill


def _energy_and_slope(forms: HighOrderForms) -> tuple[Floats, Floats]:
    """The energies of the forms, (k,), and half the derivatives by the traces, (n, k)."""
    energy, slope = np.zeros(forms.traces.shape[1]), np.zeros_like(forms.traces)
    by_edge = forms.cochains.T.tocsr()
    for elements, extension, block in _blocks(forms):
        u = coefficients_on(forms, by_edge, elements, extension, block)
        along, down = scaled_gradients(elements, block, u)
        energy += np.sum(along * along, axis=(0, 1)) + np.sum(down * down, axis=(0, 1))
        back = transposed_gradients(elements, block, along, down).transpose(1, 0, 2)
        n = elements.reference.n_traces
        traces = back[:, :n] + extension[block].transpose(0, 2, 1) @ back[:, n:]
        # Values count from the apex, which therefore gets the opposite of both other corners.
        traces[:, 0] = -traces[:, 1] - traces[:, 2]
        index, sign = unknowns(forms.complex, elements, block)
        np.add.at(slope, index, sign[:, :, None] * traces)
    return energy, slope


def _blocks(forms: HighOrderForms) -> list[tuple[Elements, Floats, Ints]]:
    k = forms.traces.shape[1]
    return [
        (elements, extension, block)
        for elements, extension in zip(forms.elements, forms.extensions, strict=True)
        for block in elements.blocks(2 * k * elements.reference.quadrature.nodes.size)
    ]
