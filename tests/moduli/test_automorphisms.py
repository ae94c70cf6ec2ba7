"""Automorphism groups: orders that are known, orientation-reversing symmetries, certificates."""

import numpy as np
import pytest
from support.modular_words import random_point
from support.symmetric_matrices import SYMMETRIC, keys, reflected

import igl_periods as ip
from igl_periods.moduli.automorphisms import symplectic_automorphism_group
from igl_periods.siegel.half_space import siegel_distance, siegel_transform
from igl_periods.surfaces import (
    square_tiled_surface,
)
from igl_periods.symplectic.canonical_basis import standard_form

# --- automorphism groups -----------------------------------------------------------------------


@pytest.mark.parametrize("name", SYMMETRIC)
def test_automorphism_groups_of_named_surfaces(name):
    Pi, order, surface_orders = SYMMETRIC[name]
    g = len(Pi)
    group = symplectic_automorphism_group(Pi)
    assert group.order == len(group) == order
    assert group.surface_orders == surface_orders
    J = standard_form(g)
    assert all(np.array_equal(gamma @ J @ gamma.T, J) for gamma in group)
    assert max(siegel_distance(siegel_transform(gamma, Pi), Pi) for gamma in group) < 1e-10
    # A group: the identity comes first, −1 is there, and it is closed; its generators generate it.
    assert np.array_equal(group[0], np.eye(2 * g, dtype=np.int64))
    members = keys(group)
    assert (-group[0]).tobytes() in members
    assert keys(gamma @ generator for gamma in group for generator in group.generators) == members
    assert len(group.generators) <= 4
    reached = [group[0]]
    for gamma in reached:
        for generator in group.generators:
            if (gamma @ generator).tobytes() not in keys(reached):
                reached.append(gamma @ generator)
    assert keys(reached) == members


@pytest.mark.parametrize("name", SYMMETRIC)
def test_reversing_symmetries_are_the_other_coset(name):
    Pi, order, _ = SYMMETRIC[name]
    group = symplectic_automorphism_group(Pi)
    assert len(group.reversing) == order  # all these surfaces have real structures
    J = standard_form(len(Pi))
    assert all(np.array_equal(sigma @ J @ sigma.T, -J) for sigma in group.reversing)
    assert max(siegel_distance(reflected(s, Pi), Pi) for s in group.reversing) < 1e-10
    assert keys(group.reversing[0] @ gamma for gamma in group) == keys(group.reversing)
    structures = group.real_structures
    assert structures
    assert all(np.array_equal(s @ s, np.eye(2 * len(Pi), dtype=np.int64)) for s in structures)
    assert keys(structures) == keys(-sigma for sigma in structures)


def test_real_structures_of_klein_and_bring():
    # Those of Klein's quartic are the 28 outer involutions of PGL(2, 7); those of Bring's curve
    # conjugation after one of the 1 + 10 + 15 permutations of order at most 2 of 5 coordinates.
    assert len(symplectic_automorphism_group(SYMMETRIC["Klein"][0]).real_structures) == 2 * 28
    assert len(symplectic_automorphism_group(SYMMETRIC["Bring"][0]).real_structures) == 2 * 26


@pytest.mark.parametrize(
    ("tau", "order", "n_reversing"),
    [
        (1j, 4, 4),
        (np.exp(1j * np.pi / 3), 6, 6),
        (2j, 2, 2),
        (np.exp(1.3j), 2, 2),
        (0.2 + 1.3j, 2, 0),
    ],
)
def test_symmetries_of_tori(tau, order, n_reversing):
    group = symplectic_automorphism_group([[tau]])
    assert group.order == order
    assert len(group.reversing) == n_reversing
    assert group.surface_orders == (order,)


@pytest.mark.parametrize("g", [2, 3, 5, 8])
def test_generic_surfaces_have_no_symmetry(g):
    Pi = random_point(g, np.random.default_rng(g))
    group = symplectic_automorphism_group(Pi)
    assert keys(group) == keys([np.eye(2 * g, dtype=np.int64), -np.eye(2 * g, dtype=np.int64)])
    assert len(group.reversing) == 0
    assert group.real_structures == []


def test_near_symmetries_need_not_form_a_group():
    # Two rotations of nearly square and nearly hexagonal lattices do not compose.
    Pi = [[0.25 + 0.97j]]
    group = symplectic_automorphism_group(Pi, tolerance=0.6)
    assert group.order > 2
    with pytest.raises(ValueError, match="do not form a group"):
        _ = group.generators


# --- certificates ------------------------------------------------------------------------------


def test_certified_group_contains_the_symmetries():
    group = symplectic_automorphism_group(ip.period_matrix(square_tiled_surface("omega_3", 4)))
    assert group.elements.certified
    assert group.order == 24
