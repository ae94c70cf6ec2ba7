"""Period matrices in balls that tests make themselves: closed forms, equations by quadrature."""

import flint
import numpy as np

from igl_periods.siegel import midpoint


def l_shape_matrix(x):
    """Π of the L-shape of arms x − 1, x an arb."""
    a, b, factor = 2 * x * x - 2 * x + 1, -2 * x * (x - 1), flint.acb(0, 1) / (2 * x - 1)
    return flint.acb_mat([[factor * a, factor * b], [factor * b, factor * a]])


def silhol_matrix():
    """((1 + i)/2) [[2, 1, 1], [1, 2, 1], [1, 1, 2]]."""
    half = flint.acb(1, 1) / 2
    return flint.acb_mat([[half * x for x in row] for row in ([2, 1, 1], [1, 2, 1], [1, 1, 2])])


def real_branch_points_matrix(points):
    """Π of y² = ∏ (x − e_k), e_1 < … < e_{2g+1} exact integers, ∞ the last branch point.

    ω_j = x^{j−1} dx / y.  Between neighbouring branch points y is real or imaginary, and with
    x = (e_k + e_{k+1})/2 + (e_{k+1} − e_k)/2 · sin t the integrand is analytic.  a_i goes round
    e_{2i−1}, e_{2i}; b_i round e_{2i}, …, e_{2g+1}: sums of twice the integrals over gaps.
    """
    e = [flint.arb(p) for p in points]
    g = (len(e) - 1) // 2
    over_gap = [[_gap_integral(e, k, j) for k in range(2 * g)] for j in range(g)]
    A = flint.acb_mat([[2 * over_gap[j][2 * i] for i in range(g)] for j in range(g)])
    tails = [
        [sum((2 * gaps[k] for k in range(2 * i + 1, 2 * g, 2)), flint.acb(0)) for i in range(g)]
        for gaps in over_gap
    ]
    Pi = A.solve(flint.acb_mat(tails))
    if float(Pi[0, 0].imag.mid()) < 0:
        Pi = -1 * Pi
    assert all((Pi[i, j] - Pi[j, i]).contains(0) for i in range(g) for j in range(g))
    assert np.linalg.eigvalsh(midpoint(Pi).imag)[0] > 0
    return (Pi + Pi.transpose()) / 2


def _gap_integral(e, k, j):
    """∫ x^j dx / y over (e_k, e_{k+1}), on the upper side of the real axis."""
    middle, half = (e[k] + e[k + 1]) / 2, (e[k + 1] - e[k]) / 2
    others = [p for n, p in enumerate(e) if n not in (k, k + 1)]
    # √(x − p) on the upper side is i √(p − x) for every branch point to the right of the gap.
    phase = flint.acb(0, 1) ** (len(e) - 1 - k)

    def integrand(t, analytic):
        x = middle + half * t.sin()
        product = flint.acb(1)
        for p in others:
            product *= ((x - p) if p < middle else (p - x)).sqrt(analytic=analytic)
        return x**j / product

    quarter = flint.arb.pi() / 2
    return flint.acb.integral(integrand, -quarter, quarter) / phase
