"""Zeros of differentials: dz of translation surfaces, and the number of all."""

import numpy as np
import pytest
from support.parametrized_surfaces import NAMES, random_coefficients

import igl_periods as ip
from igl_periods.complexes.cochains import along_sides
from igl_periods.differentials.normalised import normalised_differentials
from igl_periods.differentials.zeros_of_forms import form_zeros


def coefficients_of_dz(pm):
    """Σ s_k ζ_k = dz, by least squares over the sides of all faces, each laid out by its twin."""
    K = pm.complex
    z = laid_out(K)
    sides = np.moveaxis(along_sides(K, normalised_differentials(pm)), 0, -1)
    s, *_ = np.linalg.lstsq(sides.reshape(-1, pm.genus), z.ravel(), rcond=None)
    return s


def laid_out(K):
    """dz along the sides of all faces of a translation surface; (m, 3)."""
    z = np.full((K.n_faces, 3), np.nan, dtype=complex)
    a, b, c = K.lengths[0]
    angle = np.arccos((b * b + c * c - a * a) / (2 * b * c))
    # Corner 0 at 0, corner 1 at c, corner 2 at b e^{i angle}.
    corners = np.array([0, c, b * np.exp(1j * angle)])
    z[0] = [corners[(s + 2) % 3] - corners[(s + 1) % 3] for s in range(3)]
    queue = [0]
    while queue:
        f = queue.pop()
        for s in range(3):
            other, t = divmod(int(K.twin[f, s]), 3)
            if np.isnan(z[other, t]):
                lengths = K.lengths[other]
                first = -z[f, s]
                x, y, w = lengths[t], lengths[(t + 1) % 3], lengths[(t + 2) % 3]
                turn = np.arccos((x * x + y * y - w * w) / (2 * x * y))
                second = -first / x * y * np.exp(-1j * turn)
                z[other, t], z[other, (t + 1) % 3] = first, second
                z[other, (t + 2) % 3] = -first - second
                queue.append(other)
    return z


@pytest.mark.parametrize(
    ("name", "stratum"), [("omega_1", (2,)), ("omega_2", None), ("omega_3", None)]
)
def test_the_l_shaped_origami_is_in_h2(name, stratum):
    pm = ip.period_matrix(ip.surfaces.square_tiled_surface(name, n=3))
    if stratum is None:
        # Half-translation surfaces have no dz: some form has its zeros somewhere.
        assert form_zeros(pm, random_coefficients(pm.genus, 1)).total == 2
        return
    zeros = form_zeros(pm, coefficients_of_dz(pm))
    assert zeros.stratum == stratum
    assert zeros.vertices.size == 1
    assert zeros.total == 2
    assert "H(2,)" in repr(zeros)


@pytest.mark.parametrize("name", NAMES)
def test_orders_add_up(surfaces, name):
    pm = surfaces[name]
    zeros = form_zeros(pm, random_coefficients(pm.genus, 2))
    assert zeros.total == 2 * pm.genus - 2
    assert zeros.stratum is None or sum(zeros.stratum) == zeros.total
    assert not zeros.orders.flags.writeable


def test_refused():
    pm = ip.period_matrix(ip.surfaces.square_tiled_surface("omega_1"))
    with pytest.raises(ValueError, match="2 finite numbers"):
        form_zeros(pm, [1.0])
