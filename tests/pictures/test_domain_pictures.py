"""Pictures of domains: level lines, loops in their colours, both nets."""

import numpy as np
import pytest
from support.random_domains import frame, square
from support.random_surfaces import noisy_torus
from support.rendered_pictures import count_near

import igl_periods as ip
from igl_periods.domains import (
    boundary_loops,
    circular_slit_map,
    harmonic_measures,
    parallel_slit_plane,
)
from igl_periods.pictures.domain_pictures import level_lines, measure_picture, slit_map_picture
from igl_periods.pictures.scenes import cycle_colour
from igl_periods.surfaces import planar_domain


def test_level_lines_of_a_linear_function():
    V, F = planar_domain(square(0, 0, 1), area=0.01)
    z = (V @ [1, 1j])[F]
    lines = level_lines(z.real + 0.5 * z.imag, z, 0.25 / 3)
    on = lines.real + 0.5 * lines.imag
    assert np.abs(on / (0.25 / 3) - np.rint(on / (0.25 / 3))).max() < 1e-9
    # Each line x + y/2 = c from side to side: together their lengths are those of the square.
    length = np.abs(np.diff(lines, axis=1)).sum()
    levels = np.arange(1, 18) * 0.25 / 3
    x = np.linspace(0, 1, 100001)
    exact = sum(np.ptp(x[(2 * (c - x) >= 0) & (2 * (c - x) <= 1)]) for c in levels) * np.sqrt(5)
    assert length == pytest.approx(exact, rel=1e-3)
    assert level_lines(np.full((3, 3), 0.3), z[:3], 1.0).shape == (0, 2)


def test_maps_and_measures_are_drawn():
    pytest.importorskip("matplotlib")
    K = ip.DeltaComplex.from_mesh(*planar_domain(square(0, 0, 4), [square(1, 1, 2)], area=0.1))
    measure = measure_picture(K, harmonic_measures(K, 2)[1], boundary_loops(K), (300, 240))
    assert measure.shape == (240, 300, 3)
    for m in (circular_slit_map(K, degree=2), parallel_slit_plane(K, 0.5 + 0.5j, degree=2)):
        picture = slit_map_picture(m, (400, 240))
        assert picture.shape == (240, 400, 3)
        for k in range(2):
            for half in (picture[:, :200], picture[:, 200:]):
                assert count_near(half, cycle_colour(k, 2)) > 20
        assert picture.std() > 5
    # Violet where it is 0, yellow where it is 1.
    assert count_near(measure, (0.27, 0.0, 0.33)) > 20
    assert count_near(measure, (0.99, 0.91, 0.14)) > 20


def test_surfaces_in_space_are_refused():
    V, F = noisy_torus(9, 8, 0.1, 1)
    K = ip.DeltaComplex.from_mesh(V, np.delete(F, [0, 60], axis=0))
    with pytest.raises(ip.ComplexError, match="does not lie in the plane"):
        measure_picture(K, np.zeros(K.n_vertices), boundary_loops(K))
    assert frame(4, 2)[0].shape[1] == 2
