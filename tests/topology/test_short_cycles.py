"""Short cycles in the classes of the marking."""

import numpy as np

import igl_periods as ip
from igl_periods.complexes.cochains import walk_cochain
from igl_periods.surfaces import flat_torus
from igl_periods.topology.cycles import homology_basis
from igl_periods.topology.short_cycles import canonical_cycles


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
