"""Period matrices that are known in balls: what is proved about them, and what is not."""

import pickle

import flint
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from support.modular_words import random_point, random_word
from support.points_in_balls import Enclosed, with_radius
from support.symmetric_matrices import keys

import igl_periods as ip
from igl_periods.moduli import reduced_balls, vanishing_even_characteristics
from igl_periods.siegel import moved_balls
from igl_periods.symplectic import standard_form

cases = st.tuples(st.integers(1, 4), st.integers(0, 2**32 - 1), st.integers(0, 20))


def exact(name, genus, digits=50):
    return next(s for s in ip.catalogue(genus) if s.name == name).matrix_in_balls(digits)


@settings(max_examples=30, deadline=None)
@given(cases)
def test_words_are_found_to_all_digits(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi, word = random_point(g, rng), random_word(g, length, rng, 20)
    balls = with_radius(Pi, 60)
    moved = moved_balls(word, balls, 500)
    found = ip.symplectic_isomorphisms(balls, Enclosed(moved, 500))
    assert {word.tobytes(), (-word).tobytes()} <= keys(found)
    assert found.certified and found.in_balls and found.complete
    assert found.digits >= 40
    assert f"consistent to {found.digits} digits, which does not prove equality" in found.verdict
    for gamma in found:
        assert ip.siegel_transform(gamma, balls).overlaps(moved)


@settings(max_examples=30, deadline=None)
@given(cases)
def test_differences_in_the_thirtieth_digit_are_proved(case):
    g, seed, length = case
    rng = np.random.default_rng(seed)
    Pi, word = random_point(g, rng), random_word(g, length, rng, 20)
    here = with_radius(Pi, 50)
    with flint.ctx.workprec(300):
        shift = flint.acb_mat(g, g, [flint.acb(0, flint.arb(10) ** -30)] * (g * g))
        moved = moved_balls(word, here + shift, 500)
    found = ip.symplectic_isomorphisms(here, moved)
    assert found == []
    assert found.verdict == "proved in balls: the two surfaces are not conformally equivalent"
    # Floating point, with its tolerance, cannot tell.
    assert len(ip.symplectic_isomorphisms(here, moved, 1e-8)) >= 2


@pytest.mark.parametrize("seed", range(4))
def test_orientation_reversal_is_found(seed):
    rng = np.random.default_rng(seed)
    Pi, word = random_point(2, rng), random_word(2, 10, rng, 20)
    here = with_radius(Pi, 50)
    with flint.ctx.workprec(300):
        there = -1 * moved_balls(word, here, 300).conjugate()
    found = ip.symplectic_isomorphisms(here, there, reversing=True)
    J = standard_form(2)
    assert len(found) >= 2
    assert found.digits >= 40
    assert all(np.array_equal(gamma @ J @ gamma.T, -J) for gamma in found)
    assert ip.symplectic_isomorphisms(here, there) == []


@pytest.mark.parametrize(
    ("name", "genus", "order", "hyperelliptic"),
    [
        ("square torus", 1, 4, True),
        ("Bolza curve", 2, 48, True),
        ("Klein quartic", 3, 336, False),
        ("Fermat quartic", 3, 192, False),
        ("Lawson xi_{3,1}", 3, 32, True),
    ],
)
def test_groups_of_exact_matrices(name, genus, order, hyperelliptic):
    group = ip.symplectic_automorphism_group(exact(name, genus))
    assert group.order == order
    assert group.hyperelliptic is hyperelliptic
    assert group.real_structures
    assert len(group.generators) <= 5
    assert ip.is_hyperelliptic(exact(name, genus)) is hyperelliptic
    assert (vanishing_even_characteristics(exact(name, genus)) == []) == (
        not hyperelliptic or genus < 3
    )


def test_an_array_is_right_to_its_eight_digits():
    here = exact("Omega_1", 2)
    found = ip.symplectic_isomorphisms(ip.surfaces.square_tiled_period_matrix("omega_1"), here)
    assert found and found.in_balls and not found.certified
    other = ip.symplectic_isomorphisms(ip.surfaces.square_tiled_period_matrix("omega_2"), here)
    assert other == [] and other.verdict.startswith("no transformation within")


def test_a_period_matrix_has_its_certificate():
    pm = ip.period_matrix(ip.surfaces.square_tiled_surface("omega_1"), degree=6)
    same = ip.symplectic_isomorphisms(pm, exact("Omega_1", 2).mid())
    assert same and not same.in_balls
    with pytest.raises(ValueError, match="without a certificate"):
        ip.symplectic_isomorphisms(
            ip.period_matrix(
                ip.surfaces.torus_of_revolution(2, 1)[0], _faces(), weights="extrinsic"
            ),
            exact("square torus", 1),
        )


def _faces():
    return ip.surfaces.torus_of_revolution(2, 1)[1]


def test_distance_in_moduli_space_beyond_double_precision():
    with flint.ctx.workprec(300):
        one = flint.acb_mat([[flint.acb(0, 2)]])
        two = flint.acb_mat([[flint.acb(7, (1 - flint.arb(10) ** -40) / 2)]])
    distance = ip.moduli_distance(one, two, tolerance=0.1)
    assert distance == pytest.approx(1e-40, rel=1e-9)


def test_invariants_are_balls():
    with flint.ctx.workprec(150):
        j = ip.j_invariant(exact("square torus", 1))
    assert j.contains(1728)
    assert float(j.rad()) < 1e-25
    thetas = ip.theta_constants(exact("square torus", 1))
    with flint.ctx.workprec(200):
        known = flint.arb.pi() ** flint.arb(0.25) / flint.arb(0.75).gamma()
    assert thetas[0, 0].real.overlaps(known)
    assert thetas[1, 1].contains(0)
    with pytest.raises(ValueError, match="genus 1"):
        ip.j_invariant(exact("Omega_1", 2))


def test_genus_zero_and_pickles():
    nothing = flint.acb_mat(0, 0)
    assert len(ip.symplectic_isomorphisms(nothing, nothing)) == 1
    found = ip.symplectic_isomorphisms(exact("Bolza curve", 2), exact("Bolza curve", 2), limit=3)
    assert len(found) == 3 and not found.complete
    assert found.verdict.endswith("and there may be more")
    copy = pickle.loads(pickle.dumps(found))
    assert copy.verdict == found.verdict
    assert reduced_balls(exact("Bolza curve", 2)).genus == 2
    assert "in balls" in found._repr_html_()
