"""A complex with its marking: moves carry the classes, the basis stays."""

from functools import partial

import numpy as np
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import insert_barycentres, intrinsic_delaunay, split
from igl_periods.symplectic import standard_form
from igl_periods.topology import mark, pairing

ASYMMETRIC = ip.DeltaComplex.from_mesh(*noisy_torus(7, 5, 0.3, 3))


def test_the_basis_makes_the_cochains_canonical():
    marked = mark(ASYMMETRIC)
    cocycles = marked.cocycles()
    assert (cocycles != ip.cohomology_basis(ASYMMETRIC)).nnz == 0
    assert np.array_equal(pairing(ASYMMETRIC, cocycles, cocycles), standard_form(1))


def test_moves_one_after_the_other_keep_the_marking():
    marked = mark(ASYMMETRIC)
    faces = np.array([2, 5, 11])
    moved = (
        marked.after(intrinsic_delaunay)
        .after(partial(insert_barycentres, faces=faces))
        .after(intrinsic_delaunay)
        .after(split)
    )
    assert moved.rank == marked.rank == 2
    assert moved.basis is marked.basis
    assert moved.complex.n_faces == 4 * (ASYMMETRIC.n_faces + 2 * faces.size)
    pairs = pairing(moved.complex, moved.cochains, moved.cochains)
    assert np.array_equal(pairs, pairing(ASYMMETRIC, marked.cochains, marked.cochains))
    cocycles = moved.cocycles()
    assert np.array_equal(pairing(moved.complex, cocycles, cocycles), standard_form(1))
    # The refined surface has the same period matrix in the same marking, as far as both are known.
    coarse = ip.period_matrix(ASYMMETRIC)
    fine = ip.period_matrix(moved.complex)
    assert ip.symplectic_isomorphisms(coarse, fine)
