"""What a report says about a surface, where it is known otherwise."""

from pathlib import Path
from types import SimpleNamespace

import pytest
from support.random_surfaces import torus_of_revolution

import igl_periods as ip
from igl_periods.reports.findings import invariants, named_surfaces, symmetries
from igl_periods.surfaces import flat_torus

LAWSON = Path(__file__).parents[2] / "data" / "lawson_2_1.off"
SQUARES = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=2)
SPHERE = (
    [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
)


def test_the_square_torus_is_recognised():
    pm = ip.period_matrix(SQUARES).reduced()
    ((name, j),) = invariants(pm)
    assert name == "Klein's j"
    assert float(j) == pytest.approx(1728, abs=1e-6)
    assert dict(symmetries(pm))["γ in Sp(2g, Z) with γ · Π = Π, within the bound"] == "4"
    assert named_surfaces(pm)[0][0] == "square torus"


def test_digits_of_j_are_those_that_are_proved():
    tau = 0.2 + 1.1j
    pm = ip.period_matrix(flat_torus(tau, 8)).reduced()
    ((_, text),) = invariants(pm)
    exact = ip.j_invariant([[tau]])
    assert "i" in text
    real = float(text.split()[0].replace("−", "-"))
    decimals = len(text.split()[0].partition(".")[2])
    assert abs(real - exact.real) <= 1.0 * 10.0**-decimals
    rough = ip.period_matrix(*torus_of_revolution(2.0, 0.7, 6, 4), weights="extrinsic")
    assert "the bound proves no digit" in invariants(rough)[0][1]
    assert "not decided: a period matrix without a certificate" in symmetries(rough)[0][1]


def test_genus_two_has_the_invariants_of_igusa():
    V, F, _ = ip.load_mesh(LAWSON)
    pm = ip.period_matrix(V, F).reduced()
    found = dict(invariants(pm))
    # Of y² = x⁶ − 1, which the smooth surface is.
    exact = {
        "I_2^5 / I_10": 17066666.667,
        "I_2^3 I_4 / I_10": 480000.0,
        "I_2^2 I_6 / I_10": 148000.0,
    }
    assert set(found) == set(exact)
    for name, value in exact.items():
        text = found[name]
        assert "the bound proves no digit" in text
        assert float(text.split()[1]) == pytest.approx(value, rel=0.05)
    assert dict(symmetries(pm))["hyperelliptic"] == "yes"
    (surface, claim), *_ = named_surfaces(pm)
    assert "xi_{2,1}" in surface
    assert "does not prove" in claim


def test_spheres_have_nothing_and_large_genus_is_not_searched():
    sphere = ip.period_matrix(*SPHERE)
    assert invariants(sphere) == symmetries(sphere) == named_surfaces(sphere) == []
    large = SimpleNamespace(genus=6)
    ((_, why),) = symmetries(large)
    assert why == "not searched for beyond genus 5"
    assert invariants(large) == []
