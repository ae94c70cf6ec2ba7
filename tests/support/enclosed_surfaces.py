"""Surfaces cut into stars and faces, and period matrices that are known exactly."""

from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import product

import flint
import numpy as np
from flint import acb, acb_mat, arb

import igl_periods as ip
from igl_periods.complexes import by_kind, circumradius, root_of
from igl_periods.enclosures.cells import cells_of
from igl_periods.enclosures.delaunay_moves import make_delaunay
from igl_periods.enclosures.exact_lengths import checked_balls, lengths_of
from igl_periods.enclosures.triangulation import Triangulation
from igl_periods.topology import cochains_and_basis


def triangulated(K, bits=200):
    """The triangulation of a complex, not flipped, and the basis of its cochains."""
    cochains, T = cochains_and_basis(K)
    return Triangulation.of(K, checked_balls(lengths_of(K), K, bits), cochains), T


def cut(K, bits=200):
    """The Delaunay triangulation of a complex, its cells and its basis."""
    surface, T = triangulated(K, bits)
    make_delaunay(surface)
    return surface, cells_of(surface), T


def generic_torus(seed=3):
    """A torus with cone points and no symmetry: flat, with lengths disturbed."""
    rng = np.random.default_rng(seed)
    K = ip.surfaces.flat_torus(0.31 + 0.83j, 2, 2)
    of_edge = rng.uniform(0.93, 1.07, K.n_edges)
    return ip.DeltaComplex.from_gluing(K.lengths * of_edge[K.edge], K.twin)


def generic_genus_two(seed=5):
    """Bolza's triangles with lengths that have no symmetry."""
    rng = np.random.default_rng(seed)
    K = ip.surfaces.regular_map_surface("bolza")
    of_edge = rng.uniform(0.9, 1.1, K.n_edges)
    return ip.DeltaComplex.from_gluing(K.lengths * of_edge[K.edge], K.twin)


def polygons(k, n, partner):
    """n regular k-gons with sides of length 1 and vertices at their centres."""
    twin = np.empty((n * k, 3), dtype=np.int64)
    for p, i in product(range(n), range(k)):
        face = p * k + i
        q, j = partner(p, i)
        # Side 0 is that of the polygon; side 1 leads to the centre, side 2 from it.
        twin[face, 0] = 3 * (q * k + j)
        twin[face, 1] = 3 * (p * k + (i + 1) % k) + 2
        twin[face, 2] = 3 * (p * k + (i - 1) % k) + 1
    radius = 0.5 / np.sin(np.pi / k)
    K = ip.DeltaComplex.from_gluing(np.tile([1.0, radius, radius], (n * k, 1)), twin)
    kind = np.tile([0, 1, 1], (n * k, 1))
    formulas = (root_of(Fraction(1)), partial(circumradius, k, 1))
    return replace(K, exact_lengths=by_kind(K.edge, kind, formulas))


def l_shape(arm):
    """L(λ): a unit square with two arms of length λ − 1."""
    gluing = [
        ((0, 1), (1, 3)), ((1, 1), (0, 3)), ((0, 2), (2, 0)),
        ((2, 2), (0, 0)), ((1, 2), (1, 0)), ((2, 1), (2, 3)),
    ]  # fmt: skip
    return ip.surfaces.glued_rectangles([[1, 1], [arm - 1, 1], [1, arm - 1]], gluing)


def l_shape_matrix(arm):
    """The period matrix of L(λ), for a ball λ."""
    a, b = 2 * arm * arm - 2 * arm + 1, -2 * arm * (arm - 1)
    return acb_mat([[acb(0, x / (2 * arm - 1)) for x in row] for row in ((a, b), (b, a))])


def exact_matrix(name):
    """Period matrices of named surfaces, at the working precision."""
    third, root_2, root_3, root_7 = arb(1) / 3, arb(2).sqrt(), arb(3).sqrt(), arb(7).sqrt()
    if name == "omega_1":
        return _complex(None, [[5 * third, -4 * third], [-4 * third, 5 * third]])
    if name in ("omega_2", "bolza"):
        real = [[-2 * third, third], [third, -2 * third]]
        return _complex(real, [[2 * root_2 / 3, -root_2 / 3], [-root_2 / 3, 2 * root_2 / 3]])
    if name == "omega_3":
        return _complex(None, [[2 / root_3, -1 / root_3], [-1 / root_3, 2 / root_3]])
    if name == "klein":
        real = [[arb(-0.25 if i == j else 0.5) for j in range(3)] for i in range(3)]
        return _complex(real, [[root_7 / 4 * (i == j) for j in range(3)] for i in range(3)])
    half = arb(0.5)
    return _complex(
        [[1, -half, 0], [-half, half, half], [0, half, 0]],
        [[1, -half, 0], [-half, 1, -half], [0, -half, 1]],
    )


def _complex(real, imag):
    g = len(imag)
    return acb_mat(
        [[acb(real[i][j] if real else 0, imag[i][j]) for j in range(g)] for i in range(g)]
    )


def in_floats(Pi):
    """The midpoint of a matrix of balls."""
    return np.array([complex(z.mid()) for z in Pi.entries()]).reshape(Pi.nrows(), -1)


def matches(e, exact):
    """Whether the balls of an enclosure contain an exact matrix, in some marking.

    The exact matrix is given in balls that are much smaller.
    """
    found = ip.symplectic_isomorphisms(in_floats(e.matrix), in_floats(exact), 1e-6, limit=1)
    with flint.ctx.workprec(e.bits + 64):
        return e.change_basis(found[0]).contains(exact)
