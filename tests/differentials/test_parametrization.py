"""Parametrization: exact identities, known flat tori, convergence."""

from dataclasses import replace

import numpy as np
import pytest
from support.flat_surfaces import flat_strip
from support.parametrized_surfaces import NAMES, check_seams, random_coefficients
from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.differentials.even_form import evenness, most_even_form
from igl_periods.differentials.jacobian import abel_jacobi
from igl_periods.differentials.parametrization import parametrize
from igl_periods.differentials.prescribed_periods import form_of_periods, form_of_real_periods
from igl_periods.harmonic.constant_forms import linear_parts
from igl_periods.pictures.textured_meshes import write_obj
from igl_periods.surfaces import flat_torus


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("seed", range(5))
def test_reversed_faces_and_indices_add_up(surfaces, name, seed):
    pm = surfaces[name]
    P = parametrize(pm, random_coefficients(pm.genus, seed))
    assert np.count_nonzero(P.reversed_faces) + P.index.sum() == 2 * pm.genus - 2
    # The indices are integers: Θ_v is a multiple of 2π.
    theta = np.zeros(P.complex.n_vertices)
    np.add.at(theta, P.complex.corner_vertex, P._signed_angles())
    np.testing.assert_allclose(theta / (2 * np.pi), P.index + 1, rtol=0, atol=1e-9)
    p, q = np.abs(linear_parts(P.complex, P.form))
    degenerate = np.abs(p - q) < 1e-12 * (p + q)
    assert np.array_equal(P.reversed_faces[~degenerate], (p < q)[~degenerate])


def test_the_identity_survives_edges_and_faces_of_size_zero():
    # dx has the value 0 on a third of the edges of a square grid, and every face has area 0.
    P = parametrize(ip.period_matrix(flat_torus(1j, 4)), [1.0])
    flat = replace(P, form=np.round(P.form.real, 12) + 0j)
    assert np.count_nonzero(flat.form == 0) == 16
    assert np.count_nonzero(flat.reversed_faces) + flat.index.sum() == 0
    assert np.isinf(flat.dilatation).all()


@pytest.mark.parametrize("name", NAMES)
def test_seam_jumps_are_periods(surfaces, name):
    pm = surfaces[name]
    P = parametrize(pm, random_coefficients(pm.genus, 2))
    check_seams(P)
    # The loops across the seams generate the homology of the surface.
    assert np.linalg.matrix_rank(P.crossings) == 2 * pm.genus


@pytest.mark.parametrize("seed", range(3))
def test_flat_tori_are_mapped_isometrically(seed):
    K = flat_strip(1.3, 0.9, 5, 6, "straight", "straight", seed)
    pm = ip.period_matrix(K)
    s = random_coefficients(1, seed)
    P = parametrize(pm, s)
    z = P.corner_uv
    sides = np.abs(np.roll(z, 1, axis=1) - np.roll(z, -1, axis=1))
    ratio = sides / K.lengths
    assert ratio.max() / ratio.min() - 1 < 1e-10
    assert P.dilatation.max() - 1 < 1e-10
    assert not P.reversed_faces.any()
    assert not P.index.any()
    assert evenness(pm, s) == pytest.approx(1, abs=1e-12)
    np.testing.assert_allclose(np.abs(most_even_form(pm)), 1 / ratio[0, 0] * np.abs(s), rtol=1e-9)


def test_dilatation_is_the_ratio_of_singular_values(surfaces):
    pm = surfaces["genus 3"]
    P = parametrize(pm, random_coefficients(3, 4))
    V, F = P.complex.positions, P.complex.corner_vertex
    z = P.corner_uv
    for f in range(0, len(F), 7):
        e, h = V[F[f, 1]] - V[F[f, 0]], V[F[f, 2]] - V[F[f, 0]]
        frame = np.linalg.qr(np.stack([e, h], axis=1))[0]
        source = frame.T @ np.stack([e, h], axis=1)
        image = np.array([[(w - z[f, 0]).real, (w - z[f, 0]).imag] for w in z[f, 1:]]).T
        sigma = np.linalg.svd(image @ np.linalg.inv(source))[1]
        assert 1 / P.dilatation[f] == pytest.approx(sigma[1] / sigma[0], rel=1e-9, abs=1e-12)
        assert P.density[f] == pytest.approx((sigma**2).sum() / 2, rel=1e-9)


def test_the_conformal_map_of_a_torus_of_revolution():
    # |ζ| is proportional to 1 / (R + r cos φ), the inverse distance from the axis, and the map is
    # conformal in the limit: distortion falls with the first power of the size of triangles.
    spread, distortion = [], []
    for n in (16, 32, 64):
        K = ip.DeltaComplex.from_mesh(*torus_of_revolution(2.0, 0.7, 2 * n, n))
        P = parametrize(ip.period_matrix(K), [1.0])
        axis = np.linalg.norm(K.positions[K.corner_vertex].mean(axis=1)[:, :2], axis=1)
        product = np.sqrt(P.density) * axis
        spread.append(product.std() / product.mean())
        distortion.append(np.percentile(P.dilatation - 1, [50, 99]))
    assert np.all(np.diff(np.log2(spread)) < -0.9)
    assert np.all(np.diff(np.log2(distortion), axis=0) < -0.9)


def test_forms_that_do_not_exist_are_refused(surfaces):
    pm = surfaces["genus 3"]
    for wrong in ([1.0, 2.0], [0.0, 0.0, 0.0], [1.0, np.inf, 0.0]):
        with pytest.raises(ValueError, match="coefficients must be 3 finite numbers"):
            parametrize(pm, wrong)
    with pytest.raises(ValueError, match="periods must be 6 numbers"):
        form_of_periods(pm, [1.0])
    with pytest.raises(ValueError, match="all periods are free"):
        form_of_periods(pm, np.full(6, np.nan))
    with pytest.raises(ValueError, match="must all be finite"):
        form_of_real_periods(pm, np.full(6, np.nan))
    with pytest.raises(ValueError, match="there is no vertex -1"):
        abel_jacobi(pm, -1)


def test_the_smallest_triangulation_of_a_torus():
    P = parametrize(ip.period_matrix(flat_torus(0.2 + 1.1j, 1)), [1.0])
    assert (len(P.vertex), P.seams.size) == (4, 2)
    check_seams(P)


def test_surfaces_that_have_no_parametrization_are_refused(tmp_path):
    sphere = ip.DeltaComplex.from_lengths(
        np.ones((4, 3)), [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]]
    )
    for refused in (lambda pm: parametrize(pm, []), most_even_form):
        with pytest.raises(ip.ComplexError, match="a sphere"):
            refused(ip.period_matrix(sphere))
    P = parametrize(ip.period_matrix(flat_torus(1j, 4)), [1.0])
    with pytest.raises(ip.ComplexError, match="no positions in space"):
        write_obj(tmp_path / "torus.obj", P)
