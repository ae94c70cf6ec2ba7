"""The iteration towards a period matrix."""

from functools import partial

import numpy as np
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import DeltaComplex
from igl_periods.deformations.charts import LengthChart
from igl_periods.deformations.gauss_newton import GaussNewton

K = DeltaComplex.from_mesh(*noisy_torus(8, 6, 0.05, 1))
compute = partial(ip.period_matrix, keep_forms=True)


def search(target):
    return GaussNewton(LengthChart(K), compute, np.asarray(target))


def test_convergence_is_quadratic():
    target = ip.siegel_exponential(compute(K).matrix, [[0.3 + 0.2j]])
    _, _, steps, verdict = search(target).run(np.zeros(K.n_edges), 1e-13, 30)
    distances = np.array([step.distance for step in steps])
    assert verdict == ""
    tail = distances[distances < 0.1][:3]
    assert (tail[1:] < 10 * tail[:-1] ** 2 + 1e-13).all()


def test_strain_is_limited_and_distances_fall():
    target = ip.siegel_exponential(compute(K).matrix, [[1.0 + 1.0j]])
    _, pm, steps, verdict = search(target).run(np.zeros(K.n_edges), 1e-10, 60)
    assert verdict == "" and ip.siegel_distance(pm.matrix, target) < 1e-10
    assert max(step.strain for step in steps) < 0.2 + 1e-12
    assert (np.diff([step.distance for step in steps]) < 0).all()


def test_the_end_is_said_in_words():
    far = ip.siegel_exponential(compute(K).matrix, [[1.0 + 1.0j]])
    _, _, steps, verdict = search(far).run(np.zeros(K.n_edges), 1e-10, 2)
    assert len(steps) == 2 and verdict.startswith("stopped after 2 steps at a distance of")
