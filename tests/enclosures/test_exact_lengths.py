import pickle
from dataclasses import replace
from fractions import Fraction

import flint
import numpy as np
import pytest
from flint import arb

import igl_periods as ip
from igl_periods.enclosures.exact_lengths import checked_balls, distances, lengths_of
from igl_periods.surfaces import flat_torus, regular_map, regular_map_surface, square_tiled_surface

SURFACES = {
    "squares": square_tiled_surface("omega_2", 3),
    "triangles": regular_map_surface("klein", 2),
    "pentagons": regular_map([1, 2, 3, 4, 0], [1, 0, 3, 2, 4], 2),
    "torus": flat_torus(0.3 + 0.7j, 3, 2),
    "turned torus": flat_torus(-0.4 + 0.7j, 3, 2),
    "rectangles": ip.surfaces.glued_rectangles([[1, 0.3]], [((0, 0), (0, 2)), ((0, 1), (0, 3))], 2),
}


@pytest.mark.parametrize("name", SURFACES)
def test_exact_lengths_shrink_around_the_stored_ones(name):
    K = pickle.loads(pickle.dumps(SURFACES[name]))
    for bits in (64, 300):
        balls = checked_balls(lengths_of(K), K, bits)
        assert all(x.rel_accuracy_bits() > bits - 8 for x in balls)
        stored = np.empty(K.n_edges)
        stored[K.edge.ravel()] = K.lengths.ravel()
        assert np.allclose([float(x) for x in balls], stored, rtol=1e-15)


def test_stored_lengths_are_exact_numbers():
    K = ip.DeltaComplex.from_gluing(SURFACES["torus"].lengths, SURFACES["torus"].twin)
    assert K.exact_lengths is None
    assert all(x.is_exact() for x in lengths_of(K)(100))


def test_positions_are_taken_as_they_are():
    V = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, Fraction(1, 3)]]
    F = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    K = ip.DeltaComplex.from_mesh(np.array(V, dtype=float), F)
    lengths = checked_balls(distances(np.array(V, dtype=object), K), K, 200)
    with flint.ctx.workprec(300):
        wanted = [arb(1), arb(2).sqrt(), arb(1) / 3, arb(flint.fmpq(10, 9)).sqrt()]
        assert all(any(x.overlaps(y) for y in wanted) for x in lengths)


def test_moves_drop_exact_lengths():
    from igl_periods.complexes import insert_barycentres, split
    from igl_periods.topology import cochains_and_basis

    K = flat_torus(0.49 + 0.3j, 2, 3)
    cochains, _ = cochains_and_basis(K)
    assert split(K, cochains)[0].exact_lengths is None
    assert insert_barycentres(K, cochains, np.array([0]))[0].exact_lengths is None


def test_lengths_of_another_surface_are_refused():
    K = SURFACES["torus"]
    other = replace(K, exact_lengths=SURFACES["squares"].exact_lengths)
    with pytest.raises(ip.ComplexError, match="lengths for"):
        checked_balls(lengths_of(other), other, 64)
    longer = replace(K, exact_lengths=lambda bits: [2 * x for x in K.exact_lengths(bits)])
    with pytest.raises(ip.ComplexError, match="different surfaces"):
        checked_balls(lengths_of(longer), longer, 64)
