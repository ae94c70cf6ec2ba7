"""One vertex very far away: the allowance covers what 300 bits say of the energies of the forms."""

import numpy as np
import pytest
from flint import arb, arb_mat
from support.energies_in_300_bits import flipped_surface, linear_energies, polynomial_energies

import igl_periods as ip
from igl_periods.complexes import cotan_weights, delaunay_flips, intrinsic_delaunay
from igl_periods.elements import dirichlet_matrix, high_order_forms, rounding_allowance
from igl_periods.harmonic import dirichlet_matrix as linear_matrix
from igl_periods.harmonic import geometric_allowance, harmonic_potentials
from igl_periods.topology import cochains_and_basis

HEIGHTS = [1e3, 1e5, 1e7, 1e8, 3e8]


def spiked_torus(height, seed, n=4):
    """A flat torus in R^4 with one vertex far away."""
    a, b = np.meshgrid(*(2 * [2 * np.pi * np.arange(n) / n]), indexing="ij")
    V = np.stack([np.cos(a), np.sin(a), np.cos(b), np.sin(b)], axis=-1).reshape(-1, 4)
    far = np.random.default_rng(seed).normal(size=4)
    V[5] += height * far / np.linalg.norm(far)
    corner = np.arange(n * n).reshape(n, n)
    right, up = np.roll(corner, -1, 0), np.roll(corner, -1, 1)
    both = np.roll(right, -1, 1)
    F = np.stack([corner, right, both, corner, both, up], axis=-1).reshape(-1, 3)
    return ip.DeltaComplex.from_mesh(V, F)


def relative_error(computed, exact):
    """How far D is below the energies of its own forms at most, and how far off at all."""
    D = computed.tolist()
    n = len(D)
    difference = [[float((exact[i, j] - arb(D[i][j])).mid()) for j in range(n)] for i in range(n)]
    whiten = np.linalg.inv(np.linalg.cholesky(computed))
    below = np.linalg.eigvalsh(whiten @ np.array(difference) @ whiten.T)
    return below[-1], np.abs(below).max()


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("height", HEIGHTS)
def test_linear_energies_on_a_spike(height, seed):
    K = spiked_torus(height, seed)
    cochains, _ = cochains_and_basis(K)
    L, carried = intrinsic_delaunay(K, cochains)
    assert L is not K
    f = harmonic_potentials(L, cotan_weights(L), carried)
    D = linear_matrix(L, carried, f)
    surface = flipped_surface(K, cochains, delaunay_flips(K)[1])
    below, error = relative_error(D, linear_energies(surface, f, np.eye(2)))
    allowance = geometric_allowance(L, D, lambda weights: linear_matrix(L, carried, f, weights))
    assert below <= allowance
    # Not only allowed for: feet that were right to an ulp of the long side were off by 3e-9.
    assert error < 1e-14
    assert allowance < 1e-9


def exact_coefficients(forms):
    """The coefficients that the stored numbers stand for: differences and jumps are not rounded."""
    K, cochains, p = forms.complex, forms.cochains.toarray(), forms.degree

    def on_face(elements, m):
        face, apex = int(elements.face[m]), int(elements.apex[m])
        corner = [(apex + i) % 3 for i in range(3)]
        f = forms.traces[K.corner_vertex[face, corner]]
        values = [c * s for c, s in zip(cochains[:, K.edge[face]].T, K.sign[face], strict=True)]
        jumps = values[corner[2]], -values[corner[1]]
        rows = [[arb(0)] * len(cochains)]
        for i, jump in enumerate(jumps, start=1):
            entries = zip(f[0], f[i], jump, strict=True)
            rows.append([arb(float(y)) - arb(float(x)) + arb(float(z)) for x, y, z in entries])
        stored = [np.zeros_like(f[0]), f[1] - f[0] + jumps[0], f[2] - f[0] + jumps[1]]
        for side in corner:
            for k in range(p - 1):
                sign = K.sign[face, side] if k % 2 else 1
                stored.append(sign * forms.traces[K.n_vertices + (p - 1) * K.edge[face, side] + k])
        # Coefficients of bubbles are whatever the extension makes of the rounded ones.
        extension = forms.extensions[forms.elements.index(elements)][m]
        bubbles = (extension[None] @ np.array(stored)[None])[0]
        rows += [[arb(float(x)) for x in row] for row in (*stored[3:], *bubbles)]
        return arb_mat(rows)

    return on_face


@pytest.mark.parametrize("height", HEIGHTS)
@pytest.mark.parametrize(
    "degree", [2, 3, *(pytest.param(p, marks=pytest.mark.slow) for p in (4, 6, 8, 10, 12, 14))]
)
def test_energies_of_high_degree_on_a_spike(height, degree):
    K = spiked_torus(height, 1)
    cochains, _ = cochains_and_basis(K)
    L, carried = intrinsic_delaunay(K, cochains)
    forms = high_order_forms(L, carried, degree)
    surface = flipped_surface(K, cochains, delaunay_flips(K)[1])
    divided = forms.complex is not L

    def lengths(face):
        parent, factor = (face // 4, 2) if divided else (face, 1)
        return [surface.lengths[edge] / factor for edge in L.edge[parent].tolist()]

    D = dirichlet_matrix(forms)
    exact = polynomial_energies(forms, exact_coefficients(forms), lengths)
    below, error = relative_error(D, exact)
    assert below <= rounding_allowance(forms, D)
    assert error < 1e-10
