"""Surfaces that are deformed to a period matrix."""

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import DeltaComplex
from igl_periods.deformations import smooth_functions
from igl_periods.deformations.crossings import passes_through_itself
from igl_periods.errors import ComplexError, NotASiegelPointError
from igl_periods.surfaces import (
    square_tiled_period_matrix,
    square_tiled_surface,
    thickened_lattice,
    wente_modulus,
)

LAWSON, OCTAGON = (square_tiled_period_matrix(name) for name in ("omega_3", "omega_2"))
COARSE = DeltaComplex.from_mesh(*noisy_torus(10, 8, 0.05, 1))


# --- vertices -----------------------------------------------------------------------------------


def test_eight_gets_the_matrix_of_lawsons_surface(mesh):
    """… and stays embedded."""
    V, F = mesh("eight.off")
    found = ip.deform_to(V, F, LAWSON, smoothing=0.1, embedded=True)
    assert found.reached and found.distance < 1e-10 and found.verdict == ""
    assert ip.siegel_distance(ip.siegel_transform(found.gamma, LAWSON), found.target) < 1e-12
    assert ip.symplectic_isomorphisms(found.period_matrix.matrix, LAWSON, 1e-9)
    assert not passes_through_itself(found.vertices, F)
    # The result is what is computed from its vertices, in the marking of the mesh.
    again = ip.period_matrix(found.vertices, F)
    assert np.abs(again.matrix - found.period_matrix.matrix).max() < 1e-12
    distances = [step.distance for step in found.steps]
    assert distances == sorted(distances, reverse=True)
    # Newton's method: the last steps square the distance.
    assert distances[-1] < 10 * distances[-2] ** 1.5


@pytest.mark.slow
def test_the_exact_matrix_of_the_polyhedral_surface(mesh):
    """With forms of degree 7 the certificate itself is close to the target."""
    V, F = mesh("eight.off")
    found = ip.deform_to(V, F, LAWSON, degree=7)
    assert found.reached and found.distance < 1e-10 and found.certified_distance < 1e-6


@pytest.mark.slow
def test_eight_gets_the_matrix_of_the_octagon(mesh):
    """The surface passes through itself on the way, unless it is kept from it.

    Then it gets stuck at 0.83, and where it repels itself, at about 0.2.
    """
    V, F = mesh("eight.off")
    found = ip.deform_to(V, F, OCTAGON)
    assert found.reached and passes_through_itself(found.vertices, F)
    with pytest.warns(ip.DeformationWarning, match="no step comes nearer"):
        held = ip.deform_to(V, F, OCTAGON, embedded=True)
    assert not passes_through_itself(held.vertices, F)
    assert held.distance < 0.3
    assert len(ip.symplectic_automorphism_group(found.period_matrix.matrix, 1e-8)) == 48


def test_bob_gets_rhombic(mesh):
    """The modulus of Wente's torus: |τ| = 1."""
    V, F = mesh("bob_small.ply")
    found = ip.deform_to(V, F, [[wente_modulus()]])
    assert found.reached
    assert abs(found.period_matrix.reduced().matrix[0, 0]) == pytest.approx(1.0, abs=1e-9)


@pytest.mark.slow
def test_bob_gets_rhombic_and_stays_embedded(mesh):
    """Stuck at 0.30 unless it repels itself."""
    V, F = mesh("bob_small.ply")
    found = ip.deform_to(V, F, [[wente_modulus()]], embedded=True)
    assert found.reached and found.distance < 1e-10
    assert not passes_through_itself(found.vertices, F)


def test_genus_three_gets_hyperelliptic(mesh):
    V, F = mesh("3holes.obj")
    size = np.ptp(V, axis=0).max()
    bent = V + 0.03 * size * np.sin(3 * V[:, [1, 2, 0]] / size)
    pm = ip.period_matrix(bent, F)
    assert not ip.is_hyperelliptic(pm.matrix)
    target = ip.hyperelliptic_point(pm)
    assert ip.siegel_distance(pm, target) > 1e-6
    found = ip.deform_to(bent, F, target, keep_marking=True, tolerance=1e-9)
    assert found.reached and found.distance < 1e-8
    assert ip.is_hyperelliptic(found.period_matrix.matrix)


def test_a_surface_far_from_hyperelliptic_gets_so(mesh):
    """56 vertices with the symmetry of the tetrahedron, at a distance of a half."""
    K = DeltaComplex.from_mesh(*mesh("kq_surface.obj"))
    pm = ip.period_matrix(K)
    target = ip.hyperelliptic_point(pm)
    assert ip.siegel_distance(pm, target) > 0.5 and not ip.is_hyperelliptic(pm.matrix)
    for found in (
        ip.deform_to(K, None, target, keep_marking=True, tolerance=1e-9),
        ip.lengths_with(K, target, keep_marking=True, tolerance=1e-9),
    ):
        assert found.reached and found.distance < 1e-8
        assert ip.is_hyperelliptic(found.period_matrix.matrix)


def test_displacements_within_a_basis(mesh):
    V, F = mesh("eight.off")
    basis = smooth_functions(V, F, count=60)
    near = ip.siegel_exponential(
        ip.period_matrix(V, F).matrix, 0.05 * np.array([[1j, 0.3], [0.3, -0.5]])
    )
    found = ip.deform_to(V, F, near, basis=basis, keep_marking=True)
    assert found.reached
    moved = found.vertices - V
    outside = moved - basis @ np.linalg.lstsq(basis, moved, rcond=None)[0]
    assert np.abs(outside).max() < 1e-10 * np.abs(moved).max()


@pytest.mark.parametrize("smoothing", [0.0, 1.0])
def test_small_steps_are_the_shortest(smoothing):
    """A small displacement lies in the image of N⁻¹Jᵀ, so it is shorter than all others."""
    from igl_periods.deformations.charts import displacement_norm
    from igl_periods.siegel import orthonormal_weights

    pm = ip.period_matrix(COARSE, keep_forms=True)
    near = pm.matrix + 1e-5 * (1 + 2j)
    found = ip.deform_to(COARSE, None, near, smoothing=smoothing, keep_marking=True)
    moved = found.vertices - COARSE.positions
    J = pm.gradient(orthonormal_weights(pm.matrix)).vertices
    force = displacement_norm(COARSE, smoothing) @ moved
    combination = np.linalg.lstsq(J.reshape(2, -1).T, force.ravel(), rcond=None)[0]
    left = force.ravel() - combination @ J.reshape(2, -1)
    assert np.linalg.norm(left) < 1e-2 * np.linalg.norm(force)


# --- lengths ------------------------------------------------------------------------------------


@pytest.mark.parametrize("target", [LAWSON, OCTAGON])
def test_lengths_of_eight(mesh, target):
    K = DeltaComplex.from_mesh(*mesh("eight.off"))
    found = ip.lengths_with(K, target)
    assert found.reached and found.vertices is None
    assert len(found.steps) <= 15
    assert np.array_equal(found.complex.twin, K.twin)
    again = ip.period_matrix(DeltaComplex.from_gluing(found.complex.lengths, K.twin))
    assert ip.symplectic_isomorphisms(again.matrix, target, 1e-9)


def test_lengths_of_a_glued_surface():
    """A surface that lies nowhere in space: the L, made an octagon."""
    K = square_tiled_surface("omega_1", 3)
    found = ip.lengths_with(K, OCTAGON)
    assert found.reached
    assert len(ip.symplectic_automorphism_group(found.period_matrix.matrix, 1e-8)) == 48


def test_surfaces_that_are_there_already():
    pm = ip.period_matrix(COARSE)
    found = ip.lengths_with(COARSE, pm)
    assert found.reached and found.steps == ()
    assert np.array_equal(found.complex.lengths, COARSE.lengths)


def test_targets_in_another_marking():
    pm = ip.period_matrix(COARSE)
    moved = ip.siegel_transform([[2, 1], [3, 2]], pm.matrix)
    found = ip.lengths_with(COARSE, moved)
    assert found.reached and found.steps == ()
    with pytest.warns(ip.DeformationWarning, match="stopped after 1 steps"):
        there = ip.lengths_with(COARSE, moved, keep_marking=True, max_steps=1)
    assert not there.reached and np.array_equal(there.target, moved)


def test_genus_four_beside_the_schottky_locus():
    """A direction in which no surface can move is not followed; what remains is orthogonal."""
    V, F = thickened_lattice((2, 2, 2), 1)
    K = DeltaComplex.from_mesh(V, F)
    g = K.genus
    assert g >= 4
    pm = ip.period_matrix(K)
    rng = np.random.default_rng(0)
    step = rng.normal(size=(g, g)) + 1j * rng.normal(size=(g, g))
    target = ip.siegel_exponential(pm.matrix, 0.02 * (step + step.T))
    with pytest.warns(ip.DeformationWarning, match="the period matrices of no surface"):
        found = ip.lengths_with(K, target, keep_marking=True)
    assert 0 < found.distance < ip.siegel_distance(pm.matrix, target)
    assert "no step comes nearer" in found.verdict


# --- paths --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "g"),
    [
        ("bob_small.ply", 1),
        ("eight.off", 2),
        pytest.param("3holes.obj", 3, marks=pytest.mark.slow),
    ],
)
def test_paths_are_followed(mesh, name, g):
    V, F = mesh(name)
    if g == 3:
        # As it is, the mesh is hyperelliptic to 2e-6, where the derivative of Π has less rank.
        V = V + 0.1 * np.abs(V).max() * np.sin(3 * V[:, [1, 2, 0]] / np.abs(V).max())
    pm = ip.period_matrix(V, F)
    rng = np.random.default_rng(g)
    velocity = rng.normal(size=(g, g)) + 1j * rng.normal(size=(g, g))
    end = ip.siegel_exponential(pm.matrix, 0.02 * (velocity + velocity.T))
    path = ip.moduli_path(pm, end, 3)
    found = ip.deform_along(V, F, path)
    assert [d.reached for d in found] == [True] * 3
    assert found[0].steps == ()
    by_lengths = ip.lengths_along(DeltaComplex.from_mesh(V, F), path)
    for d, e, point in zip(found, by_lengths, path):
        assert max(ip.siegel_distance(x.period_matrix.matrix, point) for x in (d, e)) < 1e-10


# --- bad input ----------------------------------------------------------------------------------


def test_bad_targets():
    with pytest.raises(NotASiegelPointError, match="not positive definite"):
        ip.lengths_with(COARSE, [[-1j]])
    with pytest.raises(ValueError, match="the target has genus 2, the surface has genus 1"):
        ip.lengths_with(COARSE, LAWSON)
    with pytest.raises(ValueError, match="tolerance = 0"):
        ip.lengths_with(COARSE, [[1j]], tolerance=0.0)
    with pytest.raises(ComplexError, match="no positions, only lengths"):
        ip.deform_to(square_tiled_surface("omega_1"), None, LAWSON)


def test_bad_displacements():
    with pytest.raises(ValueError, match=r"shape \(80, k\)"):
        ip.deform_to(COARSE, None, [[1j]], basis=np.ones((3, 2)))
    with pytest.raises(ValueError, match="linearly dependent"):
        ip.deform_to(COARSE, None, [[1j]], basis=np.ones((80, 2)))
    with pytest.raises(ValueError, match="smoothing = -1"):
        ip.deform_to(COARSE, None, [[1j]], smoothing=-1.0)
    with pytest.raises(ValueError, match="of 80 vertices 1 to 79 functions"):
        smooth_functions(COARSE, count=80)


def test_spheres_have_no_moduli(meshes):
    V, F, _ = ip.load_mesh(meshes / "spot_triangulated.obj")
    with pytest.raises(ComplexError, match="genus 0 has no moduli"):
        ip.deform_to(V, F, np.zeros((0, 0)))
