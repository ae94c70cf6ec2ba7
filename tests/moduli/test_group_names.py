"""Names of small groups."""

import math

import pytest

import igl_periods as ip
from igl_periods.moduli import direct_product, group_name
from igl_periods.moduli.group_names import (
    _candidates,
    cyclic,
    dicyclic,
    hyperelliptic_group,
    permutation_group,
    semidirect,
    symmetric,
)

NAMES = {
    "1": lambda: cyclic(1),
    "C2 x C6": lambda: direct_product(cyclic(2), direct_product(cyclic(2), cyclic(3))),
    "C4 x C4": lambda: direct_product(cyclic(4), cyclic(4)),
    "C2 x C2 x C2": lambda: direct_product(cyclic(2), direct_product(cyclic(2), cyclic(2))),
    "S3": lambda: permutation_group((1, 2, 0), (1, 0, 2)),
    "D4": lambda: hyperelliptic_group(2),
    "Q8": lambda: dicyclic(2),
    "Dic3": lambda: dicyclic(3),
    "S3 x C2": lambda: semidirect(6, 2, 5),
    "D5": lambda: semidirect(5, 2, 4),
    "SD16": lambda: semidirect(8, 2, 3),
    "C7:C3 (r=2)": lambda: semidirect(7, 3, 4),
    "S4 x C2": lambda: direct_product(cyclic(2), symmetric(4)),
    "S3 x S3": lambda: direct_product(symmetric(3), symmetric(3)),
}


@pytest.mark.parametrize("name", NAMES)
def test_names(name):
    assert group_name(NAMES[name]()) == name


@pytest.mark.parametrize("order", [6, 8, 12, 16, 18, 20, 24, 32, 36, 48, 72])
def test_every_candidate_has_the_order_that_its_name_says(order):
    for _, build in _candidates(order):
        assert build().order == order


def test_the_number_of_named_groups_of_small_order():
    """All groups of these orders have a name: 5 of order 8, 5 of order 12, 14 of order 16 …"""
    known = {6: 1, 8: 2, 10: 1, 12: 3, 14: 1, 18: 2, 20: 3}  # not abelian
    for order, count in known.items():
        names = {group_name(build()) for _, build in _candidates(order)}
        assert len(names) == count
        assert None not in names


SURFACES = {
    "omega_2": (ip.surfaces.square_tiled_period_matrix, "GL(2,3)", "GL(2,3)"),
    "omega_1": (ip.surfaces.square_tiled_period_matrix, "D4", "D4"),
    "omega_3": (ip.surfaces.square_tiled_period_matrix, "C3:D4", "C3:D4"),
    "klein": (ip.surfaces.regular_map_period_matrix, "PSL(2,7) x C2", "PSL(2,7)"),
    "fermat": (ip.surfaces.regular_map_period_matrix, "C4^2:S3 x C2", "C4^2:S3"),
    "bring": (ip.surfaces.regular_map_period_matrix, "S5 x C2", None),
    "schwarz_p": (ip.surfaces.regular_map_period_matrix, "S4 x C2", "S4 x C2"),
}


@pytest.mark.parametrize("name", SURFACES)
def test_groups_of_surfaces(name):
    matrix, whole, of_surface = SURFACES[name]
    group = ip.symplectic_automorphism_group(matrix(name))
    assert group.name == whole
    assert group.surface_name == of_surface
    assert whole in repr(group)


def test_large_or_strange_groups_have_no_name():
    strange = direct_product(semidirect(7, 3, 2), semidirect(7, 3, 2))
    assert group_name(strange) is None
    assert math.prod([21, 21]) == strange.order
