"""Surfaces with cone points, and their forms of high degree."""

import numpy as np
from support.random_surfaces import L_SHAPE, random_gluing, random_lengths

import igl_periods as ip
from igl_periods.elements.least_energy import dirichlet_matrix, high_order_forms
from igl_periods.surfaces.square_tiled import (
    glued_rectangles,
    origami,
)
from igl_periods.symplectic.williamson_form import williamson


def forms_of(K, degree):
    return high_order_forms(K, ip.cohomology_basis(K), degree)


def bound_of(K, degree):
    return williamson(dirichlet_matrix(forms_of(K, degree)))[0][0] - 1.0


def rectangular_L(a, b, c, d):
    """The L-shape glued from rectangles of widths a, b and heights c, d."""
    return glued_rectangles([(a, c), (b, c), (a, d)], L_SHAPE)


RNG = np.random.default_rng(3)


def random_origami(n_squares):
    while True:
        try:
            K = origami(RNG.permutation(n_squares), RNG.permutation(n_squares))
        except ip.ComplexError:
            continue
        if K.genus >= 2:
            return K


def random_cone_surface(n_faces, seed):
    rng = np.random.default_rng(seed)
    while True:
        twin = random_gluing(n_faces, rng)
        K = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin)
        if len(K.components()) == 1 and K.genus:
            return K


ORIGAMIS = [random_origami(n) for n in (5, 6, 7, 8)]


def surface_with_cone(theta, n_faces):
    """A fan of triangles around a point of angle θ, with equilateral triangles on its rim.

    The sides of those that remain free are glued in pairs at random.
    """
    rng = np.random.default_rng(n_faces)
    base = 2 * np.sin(0.5 * theta / n_faces)
    lengths = np.full((2 * n_faces, 3), base)
    lengths[:n_faces, 1:] = 1.0
    i = np.arange(n_faces)
    twin = np.empty(6 * n_faces, dtype=int)
    twin[3 * i], twin[3 * (n_faces + i)] = 3 * (n_faces + i), 3 * i
    twin[3 * i + 1], twin[3 * np.roll(i, -1) + 2] = 3 * np.roll(i, -1) + 2, 3 * i + 1
    free = 3 * (n_faces + np.repeat(i, 2)) + np.tile([1, 2], n_faces)
    while True:
        order = rng.permutation(free)
        twin[order[0::2]], twin[order[1::2]] = order[1::2], order[0::2]
        K = ip.DeltaComplex.from_gluing(lengths, twin.reshape(-1, 3))
        if K.genus >= 1:
            return K
