"""Period matrices that keep their forms."""

import numpy as np
from support.random_surfaces import noisy_torus

from igl_periods.complexes import Barycentres, DeltaComplex, Flips
from igl_periods.elements import high_order_forms
from igl_periods.periods.certificate import WithAllowance
from igl_periods.periods.keeping import Keeping
from igl_periods.topology import mark

GIVEN = mark(DeltaComplex.from_mesh(*noisy_torus(7, 6, 0.15, 2)))
FACES = np.array([4, 20, 31])


def triangulations(method):
    where = method.triangulation(True)
    return where, method.divided(where, FACES)


def test_triangulations_are_those_of_the_method_that_keeps_nothing():
    for found, expected in zip(
        triangulations(Keeping(GIVEN)), triangulations(WithAllowance(GIVEN))
    ):
        assert np.array_equal(found.complex.lengths, expected.complex.lengths)
        assert (found.cochains != expected.cochains).nnz == 0


def test_moves_are_written_down_in_their_order():
    flipped, divided = triangulations(Keeping(GIVEN))
    assert Keeping(GIVEN).triangulation(False).moves == ()
    assert flipped.moves and all(isinstance(move, Flips) for move in flipped.moves)
    assert divided.moves[: len(flipped.moves)] == flipped.moves
    assert isinstance(divided.moves[len(flipped.moves)], Barycentres)


def test_derivatives_do_not_depend_on_the_triangulation():
    """Of the surface as given, flipped or divided: the derivative of the one exact matrix."""
    method, dl = Keeping(GIVEN), np.random.default_rng(0).normal(size=GIVEN.complex.n_edges)
    found = []
    for where in (GIVEN, *triangulations(method)):
        where = method.triangulation(False) if where is GIVEN else where
        forms = high_order_forms(where.complex, where.cochains, 7)
        found.append(method.high_order(where, forms).derivative(lengths=dl))
    assert np.abs(np.diff(found, axis=0)).max() < 1e-5 * np.abs(found).max()
