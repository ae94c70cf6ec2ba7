"""A surface is recognised by its period matrix."""

import igl_periods as ip
from igl_periods.periods import matrix_of_complex
from igl_periods.surfaces import matrix_of, square_tiled_surface


def test_the_matrix_of_a_complex_is_its_period_matrix():
    K = square_tiled_surface("omega_1", n=4)
    assert matrix_of.dispatch(ip.DeltaComplex) is matrix_of_complex
    assert abs(matrix_of(K).matrix - ip.period_matrix(K).matrix).max() == 0.0
    assert ip.identify(K)[0].surface.name == ip.identify(ip.period_matrix(K))[0].surface.name
