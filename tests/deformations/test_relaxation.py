"""Surfaces that give way while their period matrix stays."""

from functools import partial

import numpy as np
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import DeltaComplex
from igl_periods.deformations.charts import VertexChart
from igl_periods.deformations.crossings import passes_through_itself
from igl_periods.deformations.relaxation import Relaxation

K = DeltaComplex.from_mesh(*noisy_torus(10, 8, 0.08, 1))
CHART = VertexChart.of(K, None, 1.0, embedded=True).repelling()
RELAXATION = Relaxation(CHART, partial(ip.period_matrix, keep_forms=True), 2)


def test_the_energy_falls_and_the_matrix_stays():
    start = RELAXATION.compute(K)
    x, end = RELAXATION.descend(CHART.start(), start, 6, patient=True)
    assert CHART.energy(end.complex)[0] < CHART.energy(K)[0] - 0.1
    moved = x.reshape(K.positions.shape)
    assert np.array_equal(end.complex.positions, K.positions + moved)
    # What the last step changed, to second order, is still there: the way was much longer.
    assert ip.siegel_distance(end, start) < 0.1 * np.linalg.norm(moved, axis=1).max()
    assert not passes_through_itself(end.complex.positions, K.corner_vertex)


def test_directions_are_tangent_to_the_fibre():
    """Along the drift Π stays; the way back leads to the goal."""
    pm = RELAXATION.compute(K)
    goal = pm.matrix + 1e-4 * (1 + 2j)
    drift, back = RELAXATION._directions(pm, goal, CHART.energy(K)[1])
    shape = K.positions.shape
    along = pm.derivative(vertices=drift.reshape(shape))[0, 0]
    free = -CHART.raised(K, CHART.energy(K)[1][None])[0]
    assert abs(along) < 1e-9 * abs(pm.derivative(vertices=free.reshape(shape))[0, 0])
    moved = pm.derivative(vertices=back.reshape(shape))
    assert np.abs(moved - (goal - pm.matrix)).max() < 1e-3 * 1e-4
    assert CHART.energy(K)[1] @ drift < 0
