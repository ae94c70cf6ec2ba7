"""Bitangents, and the quartic that they determine."""

import flint
import numpy as np
import pytest
from support.points_in_balls import with_radius

from igl_periods import siegel_reduce, spin_structures
from igl_periods.curves.plane_quartics import bitangent, bitangents, plane_quartic
from igl_periods.curves.ternary_forms import (
    DIXMIER_OHNO_WEIGHTS,
    dixmier_ohno_invariants,
    transformed,
)
from igl_periods.curves.weighted_points import same_point
from igl_periods.errors import CurveError
from igl_periods.surfaces import exact_matrices

ONE = flint.fmpq(1)
EQUATIONS = {
    "klein": {(3, 1, 0): ONE, (0, 3, 1): ONE, (1, 0, 3): ONE},
    "fermat": {(4, 0, 0): ONE, (0, 4, 0): ONE, (0, 0, 4): ONE},
}
GENERIC = np.array(
    [
        [0.21 + 1.13j, 0.32 - 0.21j, -0.17 + 0.11j],
        [0.32 - 0.21j, -0.13 + 1.41j, 0.23 + 0.3j],
        [-0.17 + 0.11j, 0.23 + 0.3j, 0.4 + 1.27j],
    ]
)


def restricted(F, line):
    """The binary quartic of F on a line a x + b y + c z = 0, c ≠ 0."""
    a, b, c = line
    # x = c s, y = c t, z = −(a s + b t)
    G = transformed(F, [[c, c * 0, c * 0], [c * 0, c, c * 0], [-a, -b, c * 0]])
    return [G.get((4 - k, k, 0), flint.acb(0)) for k in range(5)]


@pytest.mark.parametrize("name", ["klein", "fermat"])
def test_named_quartics_have_the_invariants_of_their_equations(name):
    flint.ctx.dps = 40
    Pi = siegel_reduce(getattr(exact_matrices, name)()).matrix
    found = dixmier_ohno_invariants(plane_quartic(Pi))
    exact = dixmier_ohno_invariants(EQUATIONS[name])
    assert same_point(found, exact, DIXMIER_OHNO_WEIGHTS)
    other = dixmier_ohno_invariants(EQUATIONS["fermat" if name == "klein" else "klein"])
    assert not same_point(found, other, DIXMIER_OHNO_WEIGHTS)


def test_on_all_bitangents_of_a_generic_surface_the_quartic_is_a_square():
    """e t⁴ + … + a s⁴ is a square iff b² c … : (4ac − b²)² = 64 a³ e and b³ − 4abc + 8a²d = 0."""
    flint.ctx.dps = 30
    Pi = flint.acb_mat(GENERIC.tolist())
    F = plane_quartic(Pi)
    size = max(float(c.abs_upper()) for c in F.values())
    lines = bitangents(Pi)
    assert len(lines) == 28
    for line in lines:
        a, b, c, d, e = restricted(F, line)
        one = b**3 - 4 * a * b * c + 8 * a**2 * d
        two = (4 * a * c - b**2) ** 2 - 64 * a**3 * e
        assert one.contains(0)
        assert two.contains(0)
        assert float(one.abs_upper()) < 1e-15 * size**3 * float(abs(line[2]).upper()) ** 3
        assert not (a * e - b * d).contains(0)


def test_refused():
    flint.ctx.dps = 30
    Pi = flint.acb_mat(GENERIC.tolist())
    with pytest.raises(ValueError, match="odd spin structures"):
        bitangent(Pi, spin_structures(3, "even")[0])
    with pytest.raises(CurveError, match="not known well enough"):
        plane_quartic(with_radius(GENERIC, 2))
