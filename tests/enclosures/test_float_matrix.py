"""Derivatives of period matrices in balls."""

import numpy as np
import pytest
from support.enclosed_surfaces import generic_genus_two, in_floats

import igl_periods as ip
from igl_periods.complexes import edge_lengths, with_edge_lengths

K = generic_genus_two()
DL = np.random.default_rng(0).normal(size=K.n_edges) * edge_lengths(K)


@pytest.fixture(scope="module")
def enclosed():
    return ip.enclose(K, digits=18)


def test_derivatives_are_those_of_the_balls(enclosed):
    """Differences of fourth order of enclosures; the error falls with the degree."""
    h = 1e-3

    def value(t):
        moved = with_edge_lengths(K, edge_lengths(K) + t * DL)
        return in_floats(ip.enclose(moved, digits=14).matrix)

    near, far = (value(t) - value(-t) for t in (h, 2 * h))
    exact = (8 * near - far) / (12 * h)
    errors = [
        np.abs(enclosed.derivative(lengths=DL, degree=p) - exact).max() / np.abs(exact).max()
        for p in (2, 4, 8)
    ]
    assert errors[0] > 5 * errors[1] > 25 * errors[2] and errors[2] < 1e-7


def test_gradients_are_the_transpose_also_in_other_markings(enclosed):
    gamma = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.eye(2), np.zeros((2, 2))]]).astype(int)
    W = np.array([[1.0, 2j], [0.5, 1.0]])
    for e in (enclosed, enclosed.change_basis(gamma)):
        pm = e.to_period_matrix(degree=6)
        there = np.sum(W.conj() * e.derivative(lengths=DL, degree=6)).real
        assert e.gradient(W, degree=6).lengths @ DL == pytest.approx(there, rel=1e-10)
        assert pm.gradient(W).lengths @ DL == pytest.approx(there, rel=1e-10)
        assert pm.bound == e.to_period_matrix().bound
    Q = np.linalg.inv(-pm.matrix)  # the second one is −Π⁻¹ of the first
    moved = Q.T @ pm.derivative(lengths=DL) @ Q
    assert np.allclose(moved, enclosed.derivative(lengths=DL, degree=6), rtol=1e-8)


def test_bad_input(enclosed):
    with pytest.raises(ValueError, match="trial functions have degree 1 at least"):
        enclosed.derivative(lengths=DL, degree=0)
    with pytest.raises(ValueError, match="either lengths=dl or vertices=dV"):
        enclosed.derivative(degree=1)
    with pytest.raises(ValueError, match=r"W has the shape of the period matrix, \(2, 2\)"):
        enclosed.gradient(np.eye(3), degree=1)
