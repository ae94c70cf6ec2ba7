"""What ``enclose`` reaches: polygons, frames, cones of all angles, faces glued to themselves."""

from dataclasses import replace
from itertools import product

import flint
import numpy as np
import pytest
from flint import acb, acb_mat, arb, fmpq
from support.enclosed_surfaces import (
    exact_matrix,
    generic_genus_two,
    l_shape,
    l_shape_matrix,
    matches,
    polygons,
)

import igl_periods as ip
from igl_periods.complexes import by_kind
from igl_periods.enclosures import PeriodEnclosure, computation, enclose
from igl_periods.surfaces import flat_torus
from igl_periods.symplectic import integer_symplectic_basis


def double_pentagon():
    return polygons(5, 2, lambda p, i: (1 - p, i))


def decagon():
    return polygons(10, 1, lambda p, i: (p, (i + 5) % 10))


def fifth_roots_matrix():
    """The period matrix of y² = x⁵ − 1, from the action of the fifth roots of unity.

    The lattice is Z[ζ] with type (ζ, ζ²) and the form Tr(ξ x ȳ), unimodular for some imaginary ξ.
    """
    with flint.ctx.workprec(500):
        zeta = [(2 * k * acb.pi() * acb(0, 1) / 5).exp() for k in range(5)]
        for a, b in product(range(-3, 4), repeat=2):
            xi = [(a * (zeta[s] - zeta[-s]) + b * (zeta[2 * s % 5] - zeta[-2 * s % 5])) / 5
                  for s in (1, 2)]  # fmt: skip
            if not all(x.imag > 0 for x in xi):
                continue
            form = [[2 * sum((x * zeta[s * (i - j) % 5]).real for s, x in zip((1, 2), xi))
                     for j in range(4)] for i in range(4)]  # fmt: skip
            E = np.array([[round(float(x)) for x in row] for row in form])
            if round(np.linalg.det(E)) != 1:
                continue
            T = integer_symplectic_basis(E)
            periods = acb_mat([[zeta[s * k % 5] for s in (1, 2)] for k in range(4)])
            rows = (acb_mat(np.asarray(T).astype(int).tolist()) * periods).table()
            Pi = acb_mat(rows[2:]) * acb_mat(rows[:2]).inv()
            return Pi if Pi[0, 0].imag > 0 else acb_mat(rows[:2]) * acb_mat(rows[2:]).inv()
    raise AssertionError("there is such a form")


def square_frame():
    """The square 4 × 4 without the middle 2 × 2, of unit squares, on both sheets."""
    where = [(x, y) for x in range(4) for y in range(4) if not (x in (1, 2) and y in (1, 2))]
    name = {place: i for i, place in enumerate(where)}
    n, pairs = len(where), []
    step = {0: (0, -1), 1: (1, 0), 2: (0, 1), 3: (-1, 0)}
    mirrored = {0: 0, 1: 3, 2: 2, 3: 1}
    for (x, y), i in name.items():
        for side, (dx, dy) in step.items():
            j = name.get((x + dx, y + dy))
            if j is None:
                pairs.append(((i, side), (n + i, mirrored[side])))
            elif side in (1, 2):
                pairs.append(((i, side), (j, side ^ 2)))
                pairs.append(((n + i, mirrored[side]), (n + j, mirrored[side ^ 2])))
    return ip.DeltaComplex.from_squares(pairs)


def frame_modulus():
    """Bowman's formula: the capacity of the frame is 8 K(k)/K(k')."""
    nome = (-3 * arb.pi()).exp()
    theta_2 = 2 * sum((nome ** (arb(fmpq((2 * j + 1) ** 2, 4))) for j in range(14)), arb(0))
    theta_3 = 1 + 2 * sum((nome ** (j * j) for j in range(1, 14)), arb(0))
    small = (theta_2 / theta_3) ** 2
    large = (1 - small * small).sqrt()
    k = ((large - small) / (large + small)) ** 2
    other = (1 - k * k).sqrt()
    # K(k) = π / (2 agm(1, k')), and the capacity is 2/|τ| in the marking of the two boundaries.
    return acb_mat([[acb(0, 2 / (8 * other.agm(1) ** -1 * k.agm(1)))]])


def l_shape_of(root, arm):
    """L(λ) for an algebraic λ, with its exact lengths."""
    K = l_shape(root)
    lengths = K.lengths.ravel()
    values = sorted({round(x, 9) for x in lengths.tolist()})
    kind = np.array([values.index(round(x, 9)) for x in lengths.tolist()]).reshape(-1, 3)
    known = {
        1.0: lambda: arb(1),
        root - 1: lambda: arm() - 1,
        2**0.5: lambda: arb(2).sqrt(),
        float(np.hypot(1.0, root - 1)): lambda: (1 + (arm() - 1) ** 2).sqrt(),
    }
    formulas = [next(f for x, f in known.items() if abs(x - v) < 1e-8) for v in values]
    return replace(K, exact_lengths=by_kind(K.edge, kind, formulas))


@pytest.mark.parametrize("surface", [double_pentagon, decagon])
@pytest.mark.parametrize("digits", [30, pytest.param(100, marks=pytest.mark.slow)])
def test_fifth_roots_of_unity(surface, digits):
    e = enclose(surface(), digits=digits)
    assert e.digits >= digits
    assert matches(e, fifth_roots_matrix())


@pytest.mark.parametrize("digits", [20, pytest.param(50, marks=pytest.mark.slow)])
def test_the_square_frame_is_elliptic_integrals(digits):
    e = enclose(square_frame(), digits=digits)
    assert e.digits >= digits
    with flint.ctx.workprec(500):
        exact = frame_modulus()
    assert matches(e, exact)


@pytest.mark.parametrize("digits", [20, pytest.param(50, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", ["root", "golden"])
def test_l_shapes_with_algebraic_arms(name, digits):
    arms = {"root": lambda: arb(2).sqrt(), "golden": lambda: (1 + arb(5).sqrt()) / 2}
    arm = arms[name]
    e = enclose(l_shape_of(float(arm()), arm), digits=digits)
    with flint.ctx.workprec(500):
        exact = l_shape_matrix(arm())
    assert e.digits >= digits
    assert matches(e, exact)


@pytest.mark.slow
def test_short_arms_at_many_digits():
    # Coefficients of series grow like 2^K there, and cancel.
    e = enclose(l_shape(1.25), digits=50)
    with flint.ctx.workprec(600):
        exact = l_shape_matrix(arb(1.25))
    assert e.digits >= 50
    assert matches(e, exact)


def test_a_cone_angle_of_18_pi():
    # A 20-gon with opposite sides glued: one vertex has all its angles.
    K = polygons(20, 1, lambda p, i: (p, (i + 10) % 20))
    assert K.n_vertices == 2
    e = enclose(K, digits=12)
    assert e.genus == 5
    assert e.digits >= 12
    assert enclose(K, digits=20).overlaps(e)


def test_faces_glued_to_themselves():
    # A pillow of two triangles, each glued to itself along two sides: a sphere with needles.
    sphere = ip.DeltaComplex.from_gluing([[1.0, 2.0, 2.0], [1.0, 2.0, 2.0]],
                                         [[3, 2, 1], [0, 5, 4]])  # fmt: skip
    e = enclose(sphere)
    assert (e.genus, e.matrix.nrows()) == (0, 0)


def test_needles():
    # A torus of triangles with angles of about a degree.
    tau = 0.328125 + 0.015625j
    e = enclose(flat_torus(tau, 1, 1), digits=12)
    assert e.digits >= 12
    assert matches(e, acb_mat([[acb(tau)]]))


@pytest.mark.slow
def test_a_generic_surface_in_two_triangulations_at_50_digits():
    K = generic_genus_two()
    coarse, fine = enclose(K, digits=50), enclose(_midpoints(K), digits=50)
    assert min(coarse.digits, fine.digits) >= 50
    found = ip.symplectic_isomorphisms(*(x.to_period_matrix().matrix for x in (coarse, fine)), 1e-9)
    assert any(coarse.change_basis(gamma).overlaps(fine) for gamma in found)


def _midpoints(K):
    from igl_periods.complexes import split
    from igl_periods.topology import cochains_and_basis

    return split(K, cochains_and_basis(K)[0])[0]


def test_where_series_prove_nothing_linear_forms_prove_something(monkeypatch):
    K = generic_genus_two()
    exact = enclose(K, digits=12)

    def nothing(*_):
        raise ip.ComplexError("series are useless")

    monkeypatch.setattr(computation, "_energies", nothing)
    with pytest.warns(ip.ToleranceWarning, match="0 digits are proved.*series are useless"):
        e = enclose(K, digits=12)
    assert isinstance(e, PeriodEnclosure)
    assert e.bound < 1
    assert e.contains(exact.matrix)


@pytest.mark.parametrize(
    "digits", [30, *(pytest.param(n, marks=pytest.mark.slow) for n in (50, 100))]
)
def test_the_octagon_with_a_vertex_in_its_centre_is_bolzas_curve(digits):
    e = enclose(polygons(8, 1, lambda p, i: (p, (i + 4) % 8)), digits=digits)
    with flint.ctx.workprec(4 * digits + 200):
        exact = exact_matrix("bolza")
    assert e.digits >= digits
    assert matches(e, exact)


@pytest.mark.slow
@pytest.mark.parametrize(("arm", "digits"), [(1 + 2.0**-5, 30), (1 + 2.0**-8, 30)])
def test_arms_that_almost_vanish(arm, digits):
    e = enclose(l_shape(arm), digits=digits)
    with flint.ctx.workprec(600):
        exact = l_shape_matrix(arb(arm))
    assert e.digits >= digits
    assert matches(e, exact)


@pytest.mark.slow
@pytest.mark.parametrize("height", [2.0**-8, 2.0**-10])
def test_thinner_needles(height):
    tau = 0.328125 + 1j * height
    e = enclose(flat_torus(tau, 1, 1), digits=30)
    assert e.digits >= 30
    assert matches(e, acb_mat([[acb(tau)]]))
