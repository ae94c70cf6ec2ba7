"""Estimates of memory: they grow with size, genus and degree, and just enough is enough."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.elements.least_energy import high_order_forms
from igl_periods.elements.trace_system import count_unknowns
from igl_periods.periods.memory_estimates import high_order_memory, room_for_forms
from igl_periods.surfaces import square_tiled_surface, thickened_lattice
from igl_periods.surfaces.square_tiled import origami

ASYMMETRIC = origami([1, 2, 0, 4, 3], [3, 1, 4, 0, 2])


def test_estimates_of_size():
    K = high_order_forms(ASYMMETRIC, ip.cohomology_basis(ASYMMETRIC), 2).complex
    for degree in (1, 2, 7):
        forms = high_order_forms(K, ip.cohomology_basis(K), degree)
        assert count_unknowns(K, degree) == len(forms.traces)
        held = sum(extension.nbytes for extension in forms.extensions) + forms.traces.nbytes
        assert high_order_memory(K, degree, 4) > held
    assert high_order_memory(K, 12, 4) > 8 * high_order_memory(K, 4, 4)


LATTICE = thickened_lattice((4, 3, 3), 2, jitter=0.1)


def test_high_order_is_refused_too():
    K = square_tiled_surface("omega_1", n=4)
    allowed = 2e6
    assert ip.period_matrix(K, max_memory=allowed).genus == 2
    with pytest.raises(ip.MemoryLimitError, match=r"4 forms of degree 12 on \d+ faces take about"):
        ip.period_matrix(K, degree=12, max_memory=allowed)


def test_just_enough_memory_gives_the_same_matrix():
    # The least that is not refused leaves room for 64 of 80 functions.
    K = ip.DeltaComplex.from_mesh(*LATTICE)
    needed = 1e12 - room_for_forms(K, 1e12)
    least = 1.001 * (needed + 8 * K.n_vertices * 64)
    whole, tight = ip.period_matrix(K), ip.period_matrix(K, max_memory=least)
    assert abs(whole.bound - tight.bound) < 1e-12
    assert np.abs(whole.matrix - tight.matrix).max() < 1e-9
    with pytest.raises(ip.MemoryLimitError):
        ip.period_matrix(K, max_memory=0.9 * needed)


@pytest.mark.parametrize("handles", [0, 40])
def test_estimates_grow_with_size_and_genus(handles):
    small = thickened_lattice((2, 2, 2), 4)
    large = thickened_lattice((2, 2, 2 + handles // 4), 8)
    room = [room_for_forms(ip.DeltaComplex.from_mesh(*mesh), 1e9) for mesh in (small, large)]
    assert room[1] < room[0] < 1e9
