"""The same triangulation with other lengths."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.complexes import (
    edge_directions,
    edge_lengths,
    with_edge_lengths,
    with_positions,
)
from igl_periods.errors import ComplexError
from igl_periods.surfaces import torus_of_revolution

V, F = torus_of_revolution(2.0, 0.8, 8, 6)


@pytest.fixture
def torus():
    return ip.DeltaComplex.from_mesh(V, F)


def test_positions_and_lengths_say_the_same(torus):
    moved = V @ np.diag([1.0, 2.0, 0.5])
    there = with_positions(torus, moved)
    assert np.array_equal(there.lengths, ip.DeltaComplex.from_mesh(moved, F).lengths)
    again = with_edge_lengths(torus, edge_lengths(there))
    assert np.array_equal(again.lengths, there.lengths) and again.positions is None


def test_triangle_inequalities_are_kept(torus):
    lengths = edge_lengths(torus)
    lengths[0] *= 10.0
    with pytest.raises(ComplexError, match="break the triangle inequality of 2 faces; of face 0"):
        with_edge_lengths(torus, lengths)


@pytest.mark.parametrize("lengths", [np.ones(3), -np.ones(144), np.full(144, np.nan)])
def test_bad_lengths_are_refused(torus, lengths):
    with pytest.raises(ComplexError, match=r"a length for each of 144|positive and finite"):
        with_edge_lengths(torus, lengths)


def test_positions_of_another_shape_are_refused(torus):
    with pytest.raises(ComplexError, match=r"positions of shape \(3, 3\)"):
        with_positions(torus, np.zeros((3, 3)))
    with pytest.raises(ComplexError, match="a surface with no positions"):
        with_positions(with_edge_lengths(torus, edge_lengths(torus)), V)


def test_directions_need_positions_that_fit(torus):
    tail, head, unit = edge_directions(torus)
    assert np.allclose(V[tail] + edge_lengths(torus)[:, None] * unit, V[head], atol=1e-14)
    with pytest.raises(ComplexError, match="no positions, only lengths"):
        edge_directions(with_edge_lengths(torus, edge_lengths(torus)))
