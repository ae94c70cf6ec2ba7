"""Integer matrices as endomorphisms: conventions."""

import flint
import numpy as np
from support.jacobian_points import random_point, silhol

import igl_periods as ip
from igl_periods.jacobians import (
    analytic_representation,
    automorphism_of,
    in_first_marking,
    rosati_adjoint,
)
from igl_periods.jacobians.rational_representation import lattice_change, misses
from igl_periods.siegel import moved_balls
from igl_periods.symplectic import standard_form


def lattice(Pi):
    g = Pi.nrows()
    one = [[flint.acb(int(i == j)) for j in range(g)] for i in range(g)]
    return flint.acb_mat([[*left, *right] for left, right in zip(one, Pi.tolist(), strict=True)])


def balls(M):
    return flint.acb_mat(flint.fmpz_mat(np.asarray(M).tolist()))


def test_the_analytic_representation_acts_on_the_lattice_as_the_integer_matrix():
    Pi = silhol()
    for M in ip.endomorphisms(Pi):
        A = analytic_representation(M, Pi)
        assert (A * lattice(Pi)).overlaps(lattice(Pi) * balls(M))
        trace = complex(A.trace().mid())
        assert np.trace(M) == round(2 * trace.real)


def test_a_change_of_the_marking_changes_the_lattice():
    gamma = np.array([[1, 2, 0, 1], [0, 1, 1, 0], [0, 0, 1, 0], [0, 0, -2, 1]])
    J = standard_form(2)
    gamma = gamma @ J
    assert np.array_equal(gamma @ J @ gamma.T, J)
    with flint.ctx.workdps(40):
        Pi = random_point(2, 3)
        moved = moved_balls(gamma, Pi, flint.ctx.prec)
        c, d = balls(gamma[2:, :2]), balls(gamma[2:, 2:])
        scaled = (c * Pi + d).transpose()
        assert (scaled * lattice(moved)).overlaps(lattice(Pi) * balls(lattice_change(gamma)))


def test_endomorphisms_in_two_markings():
    Pi = silhol()
    gamma = np.kron(np.array([[0, 1], [-1, 0]]), np.eye(3, dtype=np.int64))
    moved = moved_balls(gamma, Pi, 200)
    for M in ip.endomorphisms(moved):
        assert not misses(in_first_marking(M, gamma), Pi)


def test_automorphisms_of_the_period_matrix_are_endomorphisms():
    Pi = silhol()
    ring = ip.endomorphisms(Pi)
    for gamma in list(ip.symplectic_automorphism_group(Pi))[::16]:
        M = automorphism_of(gamma)
        assert ring.contains(M)
        # They keep the polarisation: M' M = 1.
        assert np.array_equal(rosati_adjoint(M) @ M, np.eye(6))


def test_the_adjoint_is_that_of_the_polarisation_and_positive():
    J = standard_form(3)
    ring = ip.endomorphisms(silhol())
    rng = np.random.default_rng(0)
    for M in ring:
        x, y = rng.integers(-9, 10, (2, 6))
        assert (M @ x) @ J @ y == x @ J @ (rosati_adjoint(M) @ y)
        assert np.trace(M @ rosati_adjoint(M)) > 0
        assert np.array_equal(rosati_adjoint(rosati_adjoint(M)), M)
        for N in ring:
            assert np.array_equal(rosati_adjoint(M @ N), rosati_adjoint(N) @ rosati_adjoint(M))


def test_what_is_no_endomorphism_is_excluded():
    assert misses(np.diag([1, 2, 3, 1, 2, 3]), silhol())
    assert not misses(np.eye(6, dtype=np.int64), silhol())
