"""Parametrization: exact identities, known flat tori, convergence, textures read back."""

import json
import struct
from dataclasses import replace

import igl
import numpy as np
import pytest
from flat_surfaces import flat_strip
from random_surfaces import BOLZA, noisy_torus, torus_of_revolution

import igl_periods as ip
from igl_periods.complexes.cochains import along_sides, primitive, walk_cochain
from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.doubling import double
from igl_periods.complexes.midpoint_subdivision import split
from igl_periods.differentials.even_form import evenness, most_even_form
from igl_periods.differentials.jacobian import abel_jacobi
from igl_periods.differentials.normalised import normalised_differentials
from igl_periods.differentials.parametrization import parametrize
from igl_periods.differentials.prescribed_periods import form_of_periods, form_of_real_periods
from igl_periods.harmonic.constant_forms import face_areas, linear_parts
from igl_periods.periods.matrix import PeriodMatrix
from igl_periods.pictures.textured_meshes import write_glb, write_obj
from igl_periods.surfaces import flat_torus
from igl_periods.topology.cycles import homology_basis
from igl_periods.topology.short_cycles import canonical_cycles


def genus_three():
    """A square with two holes has a double of genus 2; with three holes, of genus 3: bent."""
    n = 9
    i, j = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    a = i * (n + 1) + j
    F = np.stack([a, a + n + 1, a + n + 2, a, a + n + 2, a + 1], axis=-1).reshape(n, n, 2, 3)
    keep = np.ones((n, n), dtype=bool)
    for x, y in ((1, 2), (4, 6), (7, 1)):
        keep[x, y] = False
    x, y = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    V = np.stack([x, y, 0.3 * np.sin(x + 0.5 * y)], axis=-1).reshape(-1, 3)
    V = V + 0.2 * np.random.default_rng(5).uniform(-1, 1, V.shape)
    return double(ip.DeltaComplex.from_mesh(V, F[keep].reshape(-1, 3)))


def genus_two():
    """Two tori of different shapes, a triangle of each cut out and joined by a tube."""
    (V, F), (W, G) = noisy_torus(9, 7, 0.15, 3), noisy_torus(7, 8, 0.2, 4)
    W = W * [0.7, -0.8, 0.9] + [4.5, 0.3, 0.2]
    face = int(np.argmax(V[F].mean(axis=1)[:, 0]))
    other = int(np.argmin(W[G].mean(axis=1)[:, 0]))
    a, b, c = F[face]
    # Mirrored, the second torus is turned inside out: its faces are read backwards.
    G = G[:, ::-1] + len(V)
    p, r, q = G[other]
    tube = [[a, b, p], [b, q, p], [b, c, q], [c, r, q], [c, a, r], [a, p, r]]
    F = np.concatenate([np.delete(F, face, 0), np.delete(G, other, 0), tube])
    return ip.DeltaComplex.from_mesh(np.concatenate([V, W]), F)


@pytest.fixture(scope="module")
def surfaces():
    complexes = {
        "noisy torus": ip.DeltaComplex.from_mesh(*noisy_torus(9, 7, 0.15, 3)),
        "torus of revolution": ip.DeltaComplex.from_mesh(*torus_of_revolution(2.0, 0.7, 20, 12)),
        "genus 2": genus_two(),
        "genus 3": genus_three(),
        # Glued squares make a simplicial complex after two divisions.
        "squares": split(*split(ip.DeltaComplex.from_squares(BOLZA, 1), EMPTY))[0],
    }
    return {name: ip.period_matrix(K).reduced() for name, K in complexes.items()}


EMPTY = ip.cohomology_basis(ip.DeltaComplex.from_squares(BOLZA, 1))[:0]
NAMES = ["noisy torus", "torus of revolution", "genus 2", "genus 3", "squares"]


def random_coefficients(g, seed):
    rng = np.random.default_rng(seed)
    return rng.normal(size=g) + 1j * rng.normal(size=g)


@pytest.mark.parametrize("name", NAMES)
def test_periods_are_those_of_the_matrix(surfaces, name):
    pm = surfaces[name]
    zeta = normalised_differentials(pm)
    walks = np.array(
        [walk_cochain(pm.complex, walk) for walk in canonical_cycles(pm.complex, pm.cocycles)]
    )
    expected = np.concatenate([np.eye(pm.genus), pm.matrix], axis=1)
    np.testing.assert_allclose(zeta @ walks.T, expected, rtol=0, atol=1e-12)
    around = along_sides(pm.complex, zeta).sum(axis=-1)
    np.testing.assert_allclose(around, 0, atol=1e-13)


@pytest.mark.parametrize("name", NAMES)
def test_on_delaunay_triangulations_they_are_the_forms_of_the_symplectic_mean(surfaces, name):
    pm = surfaces[name]
    K, cocycles = intrinsic_delaunay(pm.complex, pm.cocycles)
    flipped = PeriodMatrix(pm.dirichlet, True, cocycles, K)
    other = ip.symplectic_mean_forms(K, cocycles)[:, 0]
    np.testing.assert_allclose(normalised_differentials(flipped), other, rtol=0, atol=1e-11)


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
def test_the_cut_surface_is_a_disk_and_the_map_integrates_the_form(surfaces, name):
    pm = surfaces[name]
    P = parametrize(pm, random_coefficients(pm.genus, 1))
    twin = pm.complex.twin.ravel()
    tail, head = (np.roll(P.corner, shift, axis=1).ravel() for shift in (-1, 1))
    whole = ~P.cut.ravel()
    assert np.array_equal(tail[whole], head[twin][whole])
    n_edges = np.count_nonzero(whole) // 2 + np.count_nonzero(P.cut)
    assert len(P.vertex) - n_edges + len(P.corner) == 1
    # One boundary loop: every vertex on the cut has two sides of it.
    assert np.all(np.bincount(tail[~whole], minlength=len(P.vertex)) <= 1)
    assert np.array_equal(P.vertex[P.corner], pm.complex.corner_vertex)
    assert np.array_equal(P.cut.ravel()[pm.complex.twin.ravel()], P.cut.ravel())
    assert 2 * P.seams.size == np.count_nonzero(P.cut)
    z = P.corner_uv
    along = np.roll(z, 1, axis=1) - np.roll(z, -1, axis=1)
    np.testing.assert_allclose(along, along_sides(P.complex, P.form), rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_seam_jumps_are_periods(surfaces, name):
    pm = surfaces[name]
    P = parametrize(pm, random_coefficients(pm.genus, 2))
    check_seams(P)
    # The loops across the seams generate the homology of the surface.
    assert np.linalg.matrix_rank(P.crossings) == 2 * pm.genus


def check_seams(P):
    here, there = P.seams, P.complex.twin.ravel()[P.seams]
    tail, head = (np.roll(P.corner_uv, shift, axis=1).ravel() for shift in (-1, 1))
    np.testing.assert_allclose(tail[here] - head[there], P.seam_jumps, rtol=0, atol=1e-9)
    np.testing.assert_allclose(head[here] - tail[there], P.seam_jumps, rtol=0, atol=1e-9)


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


def test_real_periods_determine_the_form(surfaces):
    pm = surfaces["genus 3"]
    wanted = np.array([1.0, 0, -2, 3, 0, 1])
    s = form_of_real_periods(pm, wanted)
    P = parametrize(pm, s)
    np.testing.assert_allclose(P.periods.real, wanted, rtol=0, atol=1e-12)
    # So the real part of the map has integer jumps: stripes have no seams.
    jumps = P.seam_jumps.real
    np.testing.assert_allclose(jumps, np.rint(jumps), rtol=0, atol=1e-11)
    assert np.abs(jumps).max() > 0.5


def test_periods_that_are_prescribed(surfaces):
    pm = surfaces["genus 3"]
    free = complex("nan")
    wanted = np.array([1.0, 2j, free, free, free, 1 + 1j])
    periods = parametrize(pm, form_of_periods(pm, wanted)).periods
    np.testing.assert_allclose(periods[[0, 1, 5]], wanted[[0, 1, 5]], rtol=0, atol=1e-12)
    # More than g: least squares, so that the residual is orthogonal to all forms.
    wanted = random_coefficients(6, 1)
    s = form_of_periods(pm, wanted)
    matrix = np.concatenate([np.eye(3), pm.matrix])
    np.testing.assert_allclose(matrix.conj().T @ (matrix @ s - wanted), 0, atol=1e-12)
    np.testing.assert_allclose(form_of_periods(pm, matrix @ s), s, rtol=0, atol=1e-12)


@pytest.mark.parametrize("name", ["genus 2", "genus 3", "squares"])
def test_the_most_even_form_is_more_even_than_others(surfaces, name):
    pm = surfaces[name]
    best, g = most_even_form(pm), pm.genus
    others = [evenness(pm, random_coefficients(g, seed)) for seed in range(100)]
    near = [evenness(pm, best + 1e-3 * random_coefficients(g, seed)) for seed in range(20)]
    assert max(near) < evenness(pm, best) < 1
    assert max(others) < evenness(pm, best)
    # The mean of |ζ|² is 1, and the marking does not matter.
    P = parametrize(pm, best)
    area = face_areas(pm.complex)
    assert P.density @ area / area.sum() == pytest.approx(1, rel=1e-12)
    original = ip.period_matrix(pm.complex)
    assert evenness(original, most_even_form(original)) == pytest.approx(
        evenness(pm, best), rel=1e-3
    )


def refined(pm):
    K, cocycles = split(pm.complex, pm.cocycles)
    return PeriodMatrix(pm.dirichlet, True, cocycles, K)


def distortion(P):
    """Median and 99th percentile of the dilatation, and the part of vertices of negative index."""
    return [*(np.percentile(P.dilatation, [50, 99]) - 1), np.mean(P.index < 0)]


def test_distortion_of_the_most_even_form_falls_under_refinement(surfaces):
    pm = surfaces["genus 3"]
    s, found = most_even_form(pm), []
    for _ in range(3):
        P = parametrize(pm, s)
        assert np.count_nonzero(P.reversed_faces) + P.index.sum() == 4
        found.append(distortion(P))
        pm = refined(pm)
    median, tail, folds = np.array(found).T
    # First order in the middle of faces, slower at the corners of angle 3π.
    assert np.all(np.diff(np.log2(median)) < -0.8)
    assert np.all(np.diff(tail) < 0)
    assert np.all(np.diff(folds) <= 0)


@pytest.mark.parametrize(
    ("name", "genus"), [("eight.off", 2), ("fertility.off", 4), ("botijo.obj", 5)]
)
def test_meshes_made_by_others(computed, name, genus):
    pm = computed(name).reduced()
    for s in (most_even_form(pm), random_coefficients(genus, 1)):
        P = parametrize(pm, s)
        assert np.count_nonzero(P.reversed_faces) + P.index.sum() == 2 * genus - 2
        check_seams(P)


@pytest.mark.parametrize("name", ["eight.off", "fertility.off"])
def test_distortion_on_meshes_made_by_others_falls_under_refinement(computed, name):
    pm = computed(name).reduced()
    best = most_even_form(pm)
    before = distortion(parametrize(pm, best))
    after = distortion(parametrize(refined(pm), best))
    assert after[0] < 0.6 * before[0]
    assert after[1] < 0.6 * before[1]
    assert after[2] <= before[2]


@pytest.mark.parametrize("name", NAMES)
def test_abel_jacobi_integrates_the_differentials_modulo_the_lattice(surfaces, name):
    pm = surfaces[name]
    g, K, base = pm.genus, pm.complex, 5
    image = abel_jacobi(pm, base)
    assert np.all(image.coordinates >= 0)
    assert np.all(image.coordinates < 1)
    assert not image.points[base].any()
    x, y = image.coordinates[:, :g], image.coordinates[:, g:]
    np.testing.assert_allclose(image.points, x + y @ pm.matrix.T, rtol=0, atol=1e-14)
    # Along every side the image moves by the integral of ζ, up to an element of Z^g + Π Z^g.
    A = image.points[K.corner_vertex]
    step = np.roll(A, 1, axis=1) - np.roll(A, -1, axis=1)
    sides = np.moveaxis(along_sides(K, normalised_differentials(pm)), 0, -1)
    difference = step - sides
    n = np.linalg.solve(pm.matrix.imag, difference.imag.reshape(-1, g).T)
    m = difference.real.reshape(-1, g).T - pm.matrix.real @ n
    np.testing.assert_allclose(n, np.rint(n), rtol=0, atol=1e-9)
    np.testing.assert_allclose(m, np.rint(m), rtol=0, atol=1e-9)


def test_abel_jacobi_is_an_isomorphism_of_flat_tori():
    # Vertices of an n × n grid go to the n-division points of the Jacobian.
    image = abel_jacobi(ip.period_matrix(flat_torus(0.3 + 1.1j, 4))).coordinates * 4
    np.testing.assert_allclose(image, np.rint(image), rtol=0, atol=1e-12)
    assert len(np.unique(np.rint(image) % 4, axis=0)) == 16


def test_integration_along_a_tree():
    corner = np.array([[0, 1, 2], [2, 1, 3], [3, 1, 4]])
    f = np.array([0, 5, -2, 7, 100])
    sides = f[np.roll(corner, 1, axis=1)] - f[np.roll(corner, -1, axis=1)]
    assert np.array_equal(primitive(corner, sides), f)


def test_cycles_are_short_and_in_their_classes(surfaces):
    for pm in surfaces.values():
        K = pm.complex
        for marking in (pm, ip.period_matrix(K)):
            cycles = canonical_cycles(marking.complex, marking.cocycles)
            periods = marking.cocycles @ np.array([walk_cochain(K, w) for w in cycles]).T
            assert np.array_equal(periods, np.eye(2 * pm.genus))
            for walk in cycles:
                starts = np.roll(K.corner_vertex, -1, axis=1).ravel()[walk]
                ends = np.roll(K.corner_vertex, 1, axis=1).ravel()[walk]
                assert np.array_equal(ends, np.roll(starts, -1))
        length = K.lengths.ravel()
        before = sum(length[w].sum() for w in homology_basis(K))
        assert sum(length[w].sum() for w in canonical_cycles(K, ip.cohomology_basis(K))) <= before


def test_cycles_of_flat_tori_are_shortest_lattice_vectors():
    pm = ip.period_matrix(flat_torus(1.3j, 5, 4)).reduced()
    length = pm.complex.lengths.ravel()
    found = sorted(length[walk].sum() for walk in canonical_cycles(pm.complex, pm.cocycles))
    np.testing.assert_allclose(found, [1.0, 1.3], rtol=1e-12)


def test_obj_read_back_has_the_same_map(surfaces, tmp_path):
    P = parametrize(surfaces["genus 3"], random_coefficients(3, 6))
    files = write_obj(tmp_path / "surface.obj", P, scale=1.0)
    assert [file.name for file in files] == ["surface.obj", "surface.mtl", "surface.png"]
    V, uv, _, F, uv_corner, _ = igl.readOBJ(files[0])
    assert np.array_equal(F, P.complex.corner_vertex)
    assert np.array_equal(V, P.complex.positions)
    z = uv[uv_corner] @ [1, 1j]
    assert np.array_equal(z, P.corner_uv)
    # The seams are those edges at which the two faces have different coordinates.
    here, there = np.arange(z.size), P.complex.twin.ravel()
    tail, head = (np.roll(uv_corner, k, axis=1).ravel() for k in (-1, 1))
    apart = (tail[here] != head[there]) | (head[here] != tail[there])
    assert np.array_equal(apart, P.cut.ravel())
    text = files[0].read_text()
    assert "mtllib surface.mtl" in text
    assert "map_Kd surface.png" in files[1].read_text()


def test_glb_is_well_formed_and_has_the_same_map(surfaces, tmp_path):
    P = parametrize(surfaces["genus 3"], random_coefficients(3, 6))
    (file,) = write_glb(tmp_path / "surface.glb", P, scale=2.0)
    data = file.read_bytes()
    magic, version, size, n_json, kind = struct.unpack("<4sIIII", data[:20])
    assert (magic, version, size, kind) == (b"glTF", 2, len(data), 0x4E4F534A)
    document = json.loads(data[20 : 20 + n_json])
    n_binary, kind = struct.unpack("<II", data[20 + n_json : 28 + n_json])
    binary = data[28 + n_json :]
    assert (kind, n_binary) == (0x004E4942, len(binary))
    assert document["buffers"] == [{"byteLength": n_binary}]

    def accessor(i):
        entry = document["accessors"][i]
        view = document["bufferViews"][entry["bufferView"]]
        assert view["byteOffset"] % 4 == 0
        raw = binary[view["byteOffset"] : view["byteOffset"] + view["byteLength"]]
        array = np.frombuffer(raw, {5126: "<f4", 5125: "<u4"}[entry["componentType"]])
        return array.reshape(entry["count"], -1)

    attributes = document["meshes"][0]["primitives"][0]["attributes"]
    uv, corner = accessor(attributes["TEXCOORD_0"]), accessor(3).reshape(-1, 3)
    assert np.array_equal(corner, P.corner)
    z = (uv[:, 0] + 1j * (1.0 - uv[:, 1])) / 2.0
    np.testing.assert_allclose(z, P.uv, rtol=0, atol=1e-5 * np.abs(P.uv).max())
    positions = accessor(attributes["POSITION"])
    np.testing.assert_allclose(positions, P.complex.positions[P.vertex], rtol=1e-6, atol=1e-6)
    assert document["accessors"][0]["min"] == positions.min(axis=0).tolist()
    view = document["bufferViews"][4]
    assert binary[view["byteOffset"] :][:8] == b"\x89PNG\r\n\x1a\n"


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
