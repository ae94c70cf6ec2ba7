from fractions import Fraction

import numpy as np
from flint import arb

import igl_periods as ip
from igl_periods.enclosures.exact_lengths import Distances, StoredLengths
from igl_periods.enclosures.surface_choice import surface_and_lengths

V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
F = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]


def test_positions_give_distances_and_complexes_their_own_lengths():
    for positions in (V, np.array(V, dtype=float), [[Fraction(x, 7) for x in row] for row in V]):
        assert isinstance(surface_and_lengths(positions, F)[1], Distances)
    K = ip.DeltaComplex.from_mesh(V, F)
    assert isinstance(surface_and_lengths(K, None)[1], StoredLengths)
    torus = ip.surfaces.flat_torus(1j)
    assert surface_and_lengths(torus, None)[1] is torus.exact_lengths


def test_large_integers_are_not_rounded():
    big = 2**60 + 1
    K, lengths = surface_and_lengths([[x * big for x in row] for row in V], F)
    assert any(x.overlaps(arb(big)) and x.contains(arb(big)) for x in lengths(200))
    assert not any(x.contains(arb(2**60)) for x in lengths(200))
    assert K.genus == 0


def test_unused_rows_are_no_vertices():
    K, lengths = surface_and_lengths([[9.0, 9.0, 9.0], *V], np.array(F) + 1)
    assert K.n_vertices == 4
    assert sorted(float(x) for x in lengths(100))[:3] == [1.0, 1.0, 1.0]
