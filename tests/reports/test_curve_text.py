"""Curves in words and as documents."""

import json

import flint
import pytest
from support.curve_periods import l_shape_matrix

import igl_periods as ip
from igl_periods.recognition import recognise_number
from igl_periods.reports import curve_summary, curve_to_json, invariant_lines, number_to_json
from igl_periods.surfaces import exact_matrices


@pytest.fixture
def bolza():
    flint.ctx.dps = 40
    return ip.curve(exact_matrices.bolza())


def test_what_is_recognised_is_never_called_proved(bolza):
    text = curve_summary(bolza)
    assert "y^2 = x^5 - x" in text
    assert "recognised, not proved" in text
    assert "field of moduli, recognised: Q" in text


def test_invariants_with_their_fractions(bolza):
    lines = invariant_lines(bolza)
    assert lines[0].startswith("I2 = 1")
    assert lines[1] == "I4 = -0.0500000000000, recognised as -1/20"


def test_unrecognised_invariants_and_complex_balls():
    flint.ctx.dps = 30
    curve = ip.curve(flint.acb_mat([[flint.acb(0.3, 1.2)]]) * flint.arb(1.01).exp())
    (line,) = invariant_lines(curve)
    assert line.startswith("j = ")
    assert line.endswith(" i, not recognised")


def test_documents_are_plain_json_whose_balls_contain_the_curve():
    flint.ctx.dps = 40
    curve = ip.curve(l_shape_matrix(flint.arb(2).sqrt()))
    document = json.loads(json.dumps(curve_to_json(curve)))
    assert document["remarks"] == list(curve.remarks)
    for entry in document["coefficients"]:
        ball = flint.acb(*(flint.arb(entry["ball"][part]) for part in ("real", "imag")))
        assert ball.contains(curve.coefficients[tuple(entry["exponents"])])
        assert entry["recognised"] is None


def test_numbers():
    flint.ctx.dps = 30
    number = number_to_json(recognise_number(flint.acb(flint.arb(2).sqrt())))
    assert number["polynomial"] == [-2, 0, 1]
    assert number["text"] == "√2"
    assert number_to_json(None) is None
