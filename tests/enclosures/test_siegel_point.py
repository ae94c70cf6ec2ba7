import flint
import numpy as np
import pytest
from flint import arb, arb_mat

import igl_periods as ip
from igl_periods.enclosures.siegel_point import cholesky, siegel_ball, symplectic_mean
from igl_periods.symplectic import energy_matrix, siegel_point, williamson


def random_energies(g, seed, excess):
    """D = (a matrix above the exact one), and the exact point."""
    rng = np.random.default_rng(seed)
    A, X = rng.normal(size=(g, g)), rng.normal(size=(g, g))
    exact = energy_matrix(X + X.T + 1j * (A @ A.T + 0.5 * np.eye(g)))
    B = rng.normal(size=(2 * g, 2 * g))
    return exact, exact + excess * B @ B.T


@pytest.mark.parametrize("g", [1, 2, 3, 5])
@pytest.mark.parametrize("excess", [1e-1, 1e-3, 1e-8])
def test_bound_is_the_largest_symplectic_eigenvalue_and_holds(g, excess):
    exact, D = random_energies(g, 7 * g, excess)
    with flint.ctx.workprec(200):
        ball = siegel_ball(arb_mat(D.tolist()))
        d, _ = williamson(D)
        assert float(ball.bound) == pytest.approx(d[0] - 1, rel=0.1, abs=1e-11)
        # Widened by the rounding of the exact matrix in this test.
        error = np.array([complex(z.mid()) for z in ball.matrix().entries()]).reshape(
            g, g
        ) - siegel_point(exact)
        scale = np.sqrt(np.diag(siegel_point(exact).imag))
        assert (np.abs(error) / np.outer(scale, scale)).max() < float(ball.bound) * 1.3 + 1e-11


def test_mean_is_the_one_of_the_williamson_form():
    _, D = random_energies(3, 1, 0.3)
    with flint.ctx.workprec(100):
        X, Y = symplectic_mean(arb_mat(D.tolist()))
    Pi = siegel_point(williamson(D)[1])
    assert np.allclose([float(x) for x in X.entries()], Pi.real.ravel(), atol=1e-9)
    assert np.allclose([float(y) for y in Y.entries()], Pi.imag.ravel(), atol=1e-9)


def test_matrix_that_is_not_certainly_definite_has_no_factor():
    assert cholesky(arb_mat([[1, 2], [2, 1]])) is None
    assert cholesky(arb_mat([[arb(1, 2)]])) is None


def test_useless_balls_are_refused():
    D = arb_mat([[arb(1, 5), 0], [0, arb(1, 5)]])
    with flint.ctx.workprec(100):
        assert siegel_ball(D).bound > 1
    nan = arb_mat([[arb.nan(), 0], [0, 1]])
    with pytest.raises(ip.ComplexError, match="known too badly"):
        siegel_ball(nan)
