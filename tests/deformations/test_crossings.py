"""Where a mesh passes through itself."""

import numpy as np
import pytest

import igl_periods as ip
from igl_periods.deformations.crossings import passes_through_itself
from igl_periods.surfaces import torus_of_revolution

V, F = torus_of_revolution(2.0, 0.8, 24, 12)


@pytest.mark.parametrize("seed", range(4))
def test_two_tori(seed):
    """Beside each other, linked, and through each other; in any position."""
    turn = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    found = []
    beside, through, aside = np.array([[5.7, 0, 0], [1.0, 0.1, 0], [2.0, 0, 0]])
    for second in (V + beside, V[:, [0, 2, 1]] + aside, V + through):
        both = np.concatenate([V, second]) @ turn
        found.append(passes_through_itself(both, np.concatenate([F, F + len(V)])))
    assert found == [False, False, True]


def test_wentes_torus_is_immersed(mesh):
    assert passes_through_itself(*mesh("wente_torus02.obj"))
    assert not passes_through_itself(*mesh("eight.off"))


def test_what_is_not_embedded_does_not_stay_so():
    assert not passes_through_itself(V, F)
    crossed = V.copy()
    crossed[:12] -= [2.0, 0.0, 0.0]  # one meridian, across the hole
    with pytest.raises(ValueError, match="the surface passes through itself"):
        ip.deform_to(crossed, F, [[1j]], embedded=True)
    with pytest.raises(ValueError, match="for surfaces in R³"):
        ip.deform_to(np.hstack([V, V[:, :1]]), F, [[1j]], embedded=True)
