"""Wente's tori: closed, of constant mean curvature, and the paper's table with our values."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes.half_edges import half_edge_ends
from igl_periods.complexes.weights import cone_angles, cotan_weights
from igl_periods.surfaces import wente_immersion, wente_modulus, wente_periods, wente_torus

FAMILIES = [(3, 1), (2, 1), (4, 1), (5, 1), (5, 2), (5, 3), (7, 3), (9, 8)]


# Distances |τ − τ_w| in the marking of the grid: mean, symplectic mean, primal, dual.
# Regression values of an independent computation on the same meshes.
INTRINSIC = {
    10: ["1.22e-02", "7.46e-03", "1.04e-01", "1.24e-01"],
    20: ["1.87e-03", "1.58e-03", "3.04e-02", "3.28e-02"],
    40: ["3.57e-04", "3.41e-04", "7.94e-03", "8.30e-03"],
    80: ["8.21e-05", "8.11e-05", "2.01e-03", "2.08e-03"],
    160: ["2.01e-05", "2.00e-05", "5.04e-04", "5.20e-04"],
}


EXTRINSIC = {
    10: ["1.33e-02", "1.08e-02", "8.22e-02", "9.98e-02"],
    20: ["5.80e-03", "5.69e-03", "1.96e-02", "2.46e-02"],
    40: ["1.69e-03", "1.69e-03", "4.74e-03", "6.10e-03"],
    80: ["4.41e-04", "4.41e-04", "1.17e-03", "1.52e-03"],
    160: ["1.11e-04", "1.11e-04", "2.92e-04", "3.80e-04"],
}


def sampled(f, n=200, seed=0, reach=8.0):
    """The immersion at random points of the plane."""
    points = np.random.default_rng(seed).uniform(-reach, reach, (n, 2))
    return points, f(points)


def immersion(lobes, winding):
    return lambda p: wente_immersion(p[..., 0], p[..., 1], lobes, winding)


def test_modulus_of_the_torus_with_three_lobes():
    # 40-digit evaluation of exp(2i arctan(X / 3Y)).
    exact = 0.4130498234902273223282384484494553069415 + 0.9107084293640265045753058459624106316521j
    assert abs(wente_modulus() - exact) < 1e-14
    assert abs(abs(wente_modulus()) - 1) < 1e-15


def test_reference_points():
    # 40-digit evaluation of the closed formulas.
    for (x, y), point in {
        (0.0, 0.0): (0, -3.59348220594417, 0),
        (0.3, 0.7): (1.8183632391777776867, -1.5336340466871037227, 0.6562558323379705651),
        (1.9, -2.2): (-0.91192131291132129092, -0.41728526723396357505, -0.30895626634632352729),
        (-3.1, 4.05): (-0.89573663974948992225, -0.87605463784064354055, 0.087293151403323119901),
    }.items():
        assert np.abs(wente_immersion(x, y) - point).max() < 1e-14


@pytest.mark.parametrize(("lobes", "winding"), FAMILIES)
def test_the_immersion_closes(lobes, winding):
    f = immersion(lobes, winding)
    points, values = sampled(f)
    for period in wente_periods(lobes, winding):
        assert np.abs(f(points + period) - values).max() < 1e-12


@pytest.mark.parametrize(("lobes", "winding"), [(3, 1), (4, 1), (5, 2), (5, 3)])
def test_the_lattice_of_periods_is_not_larger(lobes, winding):
    f = immersion(lobes, winding)
    points, values = sampled(f, 20)
    a, b = wente_periods(lobes, winding)
    fractions = np.arange(2 * lobes) / (2 * lobes)
    for s in fractions:
        for t in fractions:
            if s or t:
                assert np.abs(f(points + s * a + t * b) - values).max() > 1e-2


# Without (9, 8), whose metric varies by a factor 1e4 within a few steps of the differences.
@pytest.mark.parametrize(("lobes", "winding"), FAMILIES[:-1])
def test_the_immersion_is_conformal_of_mean_curvature_one_half(lobes, winding):
    f = immersion(lobes, winding)
    h, points = 1 / 128, np.random.default_rng(1).uniform(-5, 5, (60, 2))
    first = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}  # eighth-order differences
    second = {0: -205 / 72, 1: 8 / 5, 2: -1 / 5, 3: 8 / 315, 4: -1 / 560}
    steps = np.eye(2) * h
    fx, fy = (
        sum(c * (f(points + k * e) - f(points - k * e)) for k, c in first.items()) / h
        for e in steps
    )
    fxx, fyy = (
        sum(c * (f(points + k * e) + f(points - k * e)) for k, c in second.items() if k) / h**2
        + second[0] * f(points) / h**2
        for e in steps
    )
    E, F, G = (np.sum(u * v, axis=1) for u, v in ((fx, fx), (fx, fy), (fy, fy)))
    assert np.abs(E / G - 1).max() < 1e-8
    assert np.abs(F / E).max() < 1e-8
    N = np.cross(fx, fy) / E[:, None]
    H = np.sum((fxx + fyy) * N, axis=1) / (2 * E)
    assert np.abs(H - 0.5).max() < 1e-6


def test_symmetries():
    X, Y = 2 * wente_periods()[0, 0], wente_periods()[0, 1] * 2 / 3
    points, values = sampled(immersion(3, 1), 50)

    def turned(angle):
        c, s = np.cos(angle), np.sin(angle)
        return values @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])

    f = immersion(3, 1)
    assert np.abs(f(points + np.array([X / 2, Y / 2])) - turned(4 * np.pi / 3)).max() < 1e-12
    assert np.abs(f(points + np.array([0, Y])) - turned(2 * np.pi / 3)).max() < 1e-12
    assert np.abs(f(points * [-1, 1]) - values * [1, 1, -1]).max() < 1e-12
    assert np.abs(f(points * [1, -1]) - values * [-1, 1, 1]).max() < 1e-12


def test_elliptic_integrals_where_scipy_is_wrong():
    # On the 80 × 80 grid, x = 0.09375 X meets an argument at which scipy.special.ellipeinc is off
    # by 0.14: the height would jump.
    x = np.array([0.0937, 0.09375, 0.0938]) * 2 * wente_periods()[0, 0]
    z = wente_immersion(x, 0.3)[:, 2]
    assert abs(z[1] - (z[0] + z[2]) / 2) < 1e-6


def in_grid_marking(pm, N):
    """The result in the basis of cycles a (i grows) and b (j grows) of the grid."""
    tail, head = half_edge_ends(pm.complex)
    number = {(p, q): h for h, (p, q) in enumerate(zip(tail.tolist(), head.tolist(), strict=True))}
    steps = np.arange(N)
    periods = []
    for walk in (N * np.append(steps, 0), np.append(steps, 0)):
        h = [number[p, q] for p, q in zip(walk[:-1].tolist(), walk[1:].tolist(), strict=True)]
        edges, signs = pm.complex.edge.ravel()[h], pm.complex.sign.ravel()[h].astype(int)
        periods.append(pm.cocycles.toarray()[:, edges] @ signs)
    U = np.rint(np.linalg.inv(np.array(periods).T)).astype(int)
    K = np.diag([1, -1])
    return pm.change_basis(K @ U @ K)


@pytest.mark.parametrize(("weights", "table"), [("intrinsic", INTRINSIC), ("extrinsic", EXTRINSIC)])
def test_table_of_errors(weights, table):
    for N, expected in table.items():
        pm = in_grid_marking(ip.period_matrix(*wente_torus(N), weights=weights), N)
        estimates = [pm.mean, pm.matrix, pm.primal, pm.dual]
        errors = [f"{abs(Pi[0, 0] - wente_modulus()):.2e}" for Pi in estimates]
        assert errors == expected, N


def test_dirichlet_matrices():
    # M₁₁ = M₂₂ and M₁₂: regression values of an independent computation.
    for N, weights, diagonal, off in (
        (10, "intrinsic", 1.2391217567436923, -0.5033855869390428),
        (20, "intrinsic", 1.1359270312050738, -0.46755912920975806),
        (10, "extrinsic", 1.2060665775614001, -0.4862787246756093),
        (40, "extrinsic", 1.1034812545861685, -0.4540962760175405),
    ):
        pm = in_grid_marking(ip.period_matrix(*wente_torus(N), weights=weights), N)
        expected = [[diagonal, off], [off, diagonal]]
        assert np.abs(pm.dirichlet - expected).max() < 1e-12


def test_other_lobes_converge_to_their_moduli():
    for lobes, winding in ((4, 1), (5, 1), (5, 3)):
        tau = wente_modulus(lobes, winding)
        errors = [
            abs(in_grid_marking(ip.period_matrix(*wente_torus(N, lobes, winding)), N).matrix - tau)
            for N in (40, 80)
        ]
        assert np.log2(errors[0] / errors[1]).item() == pytest.approx(2, abs=0.15)


@pytest.mark.parametrize("N", [9, 20, 40])
def test_the_mesh_is_a_delaunay_torus(N):
    V, F = wente_torus(N)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert (K.n_vertices, K.genus) == (N * N, 1)
    assert cotan_weights(K).min() > 0
    assert np.sum(cone_angles(K) - 2 * np.pi) == pytest.approx(0, abs=1e-9)


def test_area_and_extent():
    # Smooth area for H = ½, and a bounding box, from the 40-digit evaluation.
    areas = []
    for N in (80, 160):
        V, F = wente_torus(N)
        a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
        areas.append(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2)
    assert (4 * areas[1] - areas[0]) / 3 == pytest.approx(160.94372033299982, rel=2e-5)
    assert np.abs(V).max(axis=0) == pytest.approx([3.37179339, 3.59348221, 2.07748836], abs=4e-3)


@pytest.mark.parametrize(("lobes", "winding"), [(1, 1), (4, 2), (3, 0), (3, 3), (3, 4), (6, 3)])
def test_lobes_that_do_not_close_are_refused(lobes, winding):
    message = f"{lobes} lobes that wind {winding} times round the axis do not close"
    for call in (wente_periods, wente_modulus):
        with pytest.raises(ip.MeshError, match=message):
            call(lobes, winding)
    with pytest.raises(ip.MeshError, match=message):
        wente_torus(10, lobes, winding)
    with pytest.raises(ip.MeshError, match=message):
        wente_immersion(0, 0, lobes, winding)


def test_too_coarse_a_grid_is_refused():
    with pytest.raises(ip.MeshError, match="take N >= 3"):
        wente_torus(2)
