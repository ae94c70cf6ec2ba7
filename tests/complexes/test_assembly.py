"""What a complex consists of: numbers of edges and vertices, pieces."""

import numpy as np
import pytest
from support.random_surfaces import L_SHAPE

import igl_periods as ip
from igl_periods.complexes.assembly import assembled, parts_of
from igl_periods.complexes.glued_squares import squares


def test_edges_run_the_way_of_their_first_half_edges():
    lengths, twin = squares(L_SHAPE, 2)
    fields = assembled(lengths, twin, np.zeros(twin.shape, dtype=bool))
    edge, sign = fields["edge"].ravel(), fields["sign"].ravel()
    assert np.array_equal(np.unique(edge), np.arange(fields["n_edges"]))
    for e in range(fields["n_edges"]):
        h, t = np.flatnonzero(edge == e)
        assert twin.ravel()[h] == t
        assert (sign[h], sign[t]) == (1, -1)
    K = ip.DeltaComplex(**fields)
    assert K.genus == 2


def test_lengths_of_glued_sides_are_averaged():
    lengths, twin = squares(L_SHAPE, 1)
    rng = np.random.default_rng(0)
    rough = lengths * (1 + 1e-12 * rng.uniform(-1, 1, lengths.shape))
    found = assembled(rough, twin, np.zeros(twin.shape, dtype=bool))["lengths"]
    assert np.array_equal(found.ravel(), found.ravel()[twin.ravel()])
    assert np.allclose(found, lengths, rtol=1e-11)
    rough[0, 0] *= 1.1
    with pytest.raises(ip.ComplexError, match="glued sides have different lengths"):
        assembled(rough, twin, np.zeros(twin.shape, dtype=bool))


def test_parts_are_the_complexes_they_were_glued_from():
    one = ip.surfaces.origami("(1,2)", "(1,3)")
    other = ip.surfaces.flat_torus(0.3 + 1.1j, 2, 3)
    twin = np.concatenate([one.twin, other.twin + 3 * one.n_faces])
    K = ip.DeltaComplex.from_gluing(np.concatenate([one.lengths, other.lengths]), twin)
    parts = parts_of(K)
    assert [part.genus for part in parts] == [2, 1]
    for part, whole in zip(parts, (one, other)):
        assert np.array_equal(part.twin, whole.twin)
        assert np.array_equal(part.lengths, whole.lengths)
    assert parts_of(parts[0]) == [parts[0]]
