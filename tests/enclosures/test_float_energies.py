import flint
import numpy as np
import pytest
from flint import acb
from support.enclosed_surfaces import cut, generic_genus_two, generic_torus

from igl_periods.enclosures.conforming_forms import dirichlet_enclosure
from igl_periods.enclosures.float_energies import float_dirichlet_enclosure
from igl_periods.enclosures.series import Series
from igl_periods.surfaces import square_tiled_surface


@pytest.mark.parametrize(
    "K", [square_tiled_surface("omega_1"), generic_torus(), generic_genus_two()]
)
@pytest.mark.parametrize(("seed", "decay"), [(0, 0.5), (1, 0.2), (2, 0.9)])
def test_contains_the_energies_of_the_same_series_in_balls_of_any_precision(K, seed, decay):
    rng = np.random.default_rng(seed)
    with flint.ctx.workprec(160):
        surface, cells, _ = cut(K, 160)
        k = cells.jumps.shape[1]
        coefficients = []
        for cell in range(cells.n_cells):
            c = rng.normal(size=(8 + cell % 3, k)) + 1j * rng.normal(size=(8 + cell % 3, k))
            coefficients.append(c * decay ** np.arange(len(c))[:, None])
        found = float_dirichlet_enclosure(surface, cells, coefficients, -40.0)
        series = Series(
            cells, [[[acb(complex(z)) for z in form] for form in c.T] for c in coefficients]
        )
        exact = dirichlet_enclosure(surface, series, -70.0)
        assert found.contains(exact)
        size = max(float(abs(x).upper()) for x in exact.entries())
        assert max(float(x.rad()) for x in found.entries()) < 1e-12 * size
