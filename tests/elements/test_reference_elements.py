"""Reference elements: what they span, and their traces."""

import numpy as np
import pytest
from support.cone_surfaces import forms_of
from support.random_surfaces import BOLZA, HEXAGON, L_SHAPE

import igl_periods as ip
from igl_periods.elements.reference_elements import conical_element, flat_element


# The reference elements.
@pytest.mark.parametrize("degree", [1, 2, 5, 9])
def test_flat_element_spans_the_polynomials(degree):
    rng = np.random.default_rng(0)
    s, t = rng.uniform(size=(2, 300))
    values, by_t, by_s = flat_element(degree).tabulate(s, t)
    assert values.shape[1] == (degree + 1) * (degree + 2) // 2
    x, y = t * (1 - s), t * s
    monomials = np.stack([x**i * y**j for i in range(degree + 1) for j in range(degree + 1 - i)], 1)
    solution, *_ = np.linalg.lstsq(values, monomials, rcond=None)
    assert np.abs(values @ solution - monomials).max() < 1e-11
    # The derivatives belong to the values: u_t and u_s / t of every monomial.
    assert np.abs(by_t @ solution * t[:, None] - (x * (d := _slopes(degree, x, y))[0].T
                  + y * d[1].T).T).max() < 1e-10  # fmt: skip
    assert np.abs(by_s @ solution - (d[1] - d[0])).max() < 1e-10


def _slopes(degree, x, y):
    powers = [(i, j) for i in range(degree + 1) for j in range(degree + 1 - i)]
    by_x = np.stack([i * x ** max(i - 1, 0) * y**j for i, j in powers], axis=1)
    by_y = np.stack([j * x**i * y ** max(j - 1, 0) for i, j in powers], axis=1)
    return by_x, by_y


@pytest.mark.parametrize("degree", [1, 2, 5])
def test_conical_element_spans_degree_p_in_both(degree):
    s, tau = np.random.default_rng(0).uniform(size=(2, 300))
    values, _, _ = conical_element(degree).tabulate(s, tau)
    assert values.shape[1] == degree * (degree + 1) + 1
    products = [tau**i * s**j for i in range(1, degree + 1) for j in range(degree + 1)]
    wanted = np.stack([np.ones_like(s), *products], axis=1)
    solution, *_ = np.linalg.lstsq(values, wanted, rcond=None)
    assert np.abs(values @ solution - wanted).max() < 1e-11


@pytest.mark.parametrize("element", [flat_element, conical_element])
def test_traces_of_both_elements_are_the_same(element):
    degree, x = 6, np.linspace(0.0, 1.0, 23)
    along = conical_element(degree).tabulate(x, np.ones_like(x))[0][
        :, [1, 2, *range(3, degree + 2)]
    ]
    n = 3 * degree
    sides = {  # the side, its coordinates (s, τ) at x, and its functions in the order of ``along``
        0: (x, np.ones_like(x), [1, 2, *range(3, degree + 2)]),
        1: (np.ones_like(x), 1 - x, [2, 0, *range(degree + 2, 2 * degree + 1)]),
        2: (np.zeros_like(x), x, [0, 1, *range(2 * degree + 1, n)]),
    }
    for s, tau, functions in sides.values():
        values = element(degree).tabulate(s, tau)[0]
        assert np.abs(values[:, functions] - along).max() < 1e-14
        others = np.setdiff1d(np.arange(values.shape[1]), functions)
        assert np.abs(values[:, others]).max() < 1e-14


def test_symmetric_forms_of_three_gluings_use_all_elements():
    # n = 2 has flat and conical faces, n = 1 of the L only conical ones after the division.
    kinds = {
        tuple(e.reference for e in forms_of(ip.DeltaComplex.from_squares(g, n), 3).elements)
        for g in (L_SHAPE, BOLZA, HEXAGON)
        for n in (1, 2)
    }
    assert kinds == {(flat_element(3), conical_element(3))}
