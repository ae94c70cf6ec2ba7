"""Certificates on refinements and on real meshes, and energies too inexact for one."""

import numpy as np
import pytest
from support.brute_force_equivalence import isomorphisms, mobius
from support.random_surfaces import noisy_torus

import igl_periods as ip


@pytest.mark.parametrize("seed", range(5))
def test_refining_stays_inside_the_certificate(seed):
    # The polyhedral surface is the same: split each face into four by hand and compare.
    V, F = noisy_torus(6, 5, 0.25, seed)
    coarse = ip.period_matrix(V, F)
    edges = np.unique(np.sort(F[:, [[1, 2], [2, 0], [0, 1]]].reshape(-1, 2), axis=1), axis=0)
    index = {tuple(edge): len(V) + k for k, edge in enumerate(edges)}
    mid = np.array([[index[tuple(sorted((f[s - 2], f[s - 1])))] for s in range(3)] for f in F])
    fine_F = np.concatenate(
        [np.stack([F[:, s], mid[:, s - 1], mid[:, s - 2]], axis=1) for s in range(3)] + [mid]
    )
    fine = ip.period_matrix(np.concatenate([V, V[edges].mean(axis=1)]), fine_F)
    assert fine.bound < 0.6 * coarse.bound
    near = isomorphisms(fine.reduced().matrix, coarse.reduced().matrix, tolerance=0.5)
    moved = [mobius(gamma, fine.reduced().matrix) for gamma in near]
    off = min(abs(Pi[0, 0] - coarse.reduced().matrix[0, 0]) for Pi in moved)
    Y = coarse.reduced().matrix.imag[0, 0]
    assert off / Y <= coarse.bound + 1.1 * fine.bound


@pytest.mark.parametrize(
    ("name", "bound"),
    [
        # Measured by two independent programs.
        ("eight.off", "6.39e-03"),
        ("fertility.off", "6.38e-03"),
        ("3holes.obj", "4.29e-03"),
        ("rocker-arm.obj", "7.51e-04"),
        ("bob_small.ply", "2.19e-02"),
    ],
)
def test_bounds_on_real_meshes(computed, name, bound):
    assert f"{computed(name).bound:.2e}" == bound


def test_energies_that_rounding_could_double_are_refused():
    K = ip.DeltaComplex.from_gluing(
        [[9.356351770539189e-38, 3.994167267331267e-30, 3.994167181555089e-30]] * 2,
        [[3, 4, 5], [0, 1, 2]],
    )
    with pytest.raises(ip.ComplexError, match=r"energies of the forms by a factor \d.*too extreme"):
        ip.period_matrix(K, delaunay=False)
