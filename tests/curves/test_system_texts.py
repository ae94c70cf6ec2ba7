"""Texts for other systems, read back."""

import re
from types import SimpleNamespace

import flint
import numpy as np
import pytest
from support.curve_periods import l_shape_matrix, silhol_matrix

import igl_periods as ip
from igl_periods.recognition import recognise_number
from igl_periods.surfaces import exact_matrices

GENERIC = flint.acb_mat([[0.2 + 1.1j, 0.3 - 0.25j], [0.3 - 0.25j, -0.125 + 1.4j]])


def generic():
    return GENERIC * (flint.acb(2).sqrt() * flint.acb(1, flint.arb(0, 1e-30)))


def read_in_sage(text):
    """The Python of Sage: assignments, and a last expression."""
    lines = text.replace("R.<x> = PolynomialRing(CBF)", "x = X").split("\n", 2)
    scope = {
        "RealBallField": lambda bits: flint.arb,
        "ComplexBallField": lambda bits: flint.acb,
        "matrix": lambda ring, rows: flint.acb_mat(rows),
        "X": flint.acb_poly([0, 1]),
    }
    exec("\n".join(lines[:2]), scope)
    rest = lines[2].replace("^", "**")
    if rest.startswith("x = X"):
        exec(rest, scope)
        return scope["f"]
    return eval(rest, scope)


def test_sage_reads_balls_that_contain_the_matrix():
    flint.ctx.dps = 40
    Pi = generic()
    there = read_in_sage(ip.to_sage(Pi))
    assert there.contains(Pi)
    assert all(a.rel_accuracy_bits() > 80 for a in there.entries())


def test_sage_reads_the_balls_of_a_curve():
    flint.ctx.dps = 40
    curve = ip.curve(l_shape_matrix(flint.arb(2).sqrt()))
    there = read_in_sage(ip.to_sage(curve))
    for (k,), c in curve.coefficients.items():
        assert there[k].contains(c)


def numbers_in(text, unit):
    """m + unit*(n), as Magma and PARI write them."""
    pattern = rf"(-?[\d.e+-]+) \+ {unit}\*\((-?[\d.e+-]+)\)"
    return [flint.acb(flint.arb(a), flint.arb(b)) for a, b in re.findall(pattern, text)]


@pytest.mark.parametrize(("write", "unit"), [(ip.to_magma, "i"), (ip.to_pari, "I")])
def test_midpoints_and_radius(write, unit):
    flint.ctx.dps = 40
    Pi = generic()
    text = write(Pi)
    radius = flint.arb(re.search(r"radius ([\d.e+-]+)", text).group(1))
    entries = numbers_in(text, unit)
    assert len(entries) == 4
    for z, there in zip(Pi.entries(), entries, strict=True):
        ball = there + flint.acb(flint.arb(0, radius * 1.01), flint.arb(0, radius * 1.01))
        assert ball.contains(z)


def test_curves_over_q_and_over_a_quadratic_field():
    flint.ctx.dps = 60
    bolza = ip.curve(exact_matrices.bolza())
    assert "PolynomialRing(QQ)\nf = x^5 - x\nC = HyperellipticCurve(f)" in ip.to_sage(bolza)
    assert "PolynomialRing(Rationals());\nf := x^5 - x;" in ip.to_magma(bolza)
    assert ip.to_pari(bolza) == "f = x^5 - x;\n"
    assert ip.to_latex(bolza) == "y^2 = x^{5} - x"
    quartic = ip.curve(silhol_matrix())
    assert ip.to_latex(quartic) == "x^{4} + y^{4} + z^{4} = 0"
    assert "PolynomialRing(QQ)\nF = x^4 + y^4 + z^4\nC = Curve(F)" in ip.to_sage(quartic)
    assert "Curve(A, x^4 + y^4 + z^4)" in ip.to_magma(quartic)
    field = ip.curve(l_shape_matrix(flint.arb(1.5)))
    assert "NumberField(t^2 - 2)" in ip.to_sage(field)
    assert "K<a> := NumberField(t^2 - 2)" in ip.to_magma(field)
    assert "a = Mod(t, t^2 - 2)" in ip.to_pari(field)
    # The polynomial over the field is the recognised one.
    text = ip.to_sage(field).split("f = ")[1].split("\n")[0]
    a, x = 2**0.5, 0.7
    value = eval(text.replace("^", "**"), {"a": a, "x": x})
    assert abs(value - sum(complex(c) * x**k for (k,), c in field.coefficients.items())) < 1e-12


def test_latex_of_numbers_and_matrices():
    assert ip.to_latex(flint.acb(0, 1)) == r"\mathrm{i}"
    assert ip.to_latex(flint.acb(2, -1)) == r"2-\mathrm{i}"
    flint.ctx.dps = 20
    text = ip.to_latex(flint.acb_mat([[flint.acb(1) / 3, 0], [0, 1]]))
    assert text.startswith(r"\begin{pmatrix} 0.3333333333333333")
    number = recognise_number(flint.acb(flint.arb(3).sqrt() / 2))
    assert ip.to_latex(number) == r"\frac{\sqrt{3}}{2}"
    assert "3" in ip.to_sage(number)
    assert "ComplexField" in ip.to_magma(number)
    assert "polroots" in ip.to_pari(number)


def test_arrays_and_period_matrices():
    Pi = np.array([[0.5 + 1j]])
    assert "0.5" in ip.to_latex(Pi)
    assert read_in_sage(ip.to_sage(Pi)).contains(flint.acb_mat(Pi.tolist()))
    pm = ip.period_matrix(ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=4))
    assert read_in_sage(ip.to_sage(pm))[0, 0].contains(flint.acb(1j))


def test_refused():
    for write in (ip.to_latex, ip.to_sage, ip.to_magma, ip.to_pari):
        with pytest.raises(TypeError, match="a number, a matrix or a curve"):
            write(SimpleNamespace())


def test_latex_has_all_digits_that_are_known():
    with flint.ctx.workdps(60):
        z = flint.acb(flint.arb(2).sqrt(), flint.arb(3).sqrt())
    assert "1.4142135623730950488016887242096980785696718753769" in ip.to_latex(z)
