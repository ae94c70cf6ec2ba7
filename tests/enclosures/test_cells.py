import flint
import numpy as np
import pytest
from support.enclosed_surfaces import cut, generic_genus_two, generic_torus

import igl_periods as ip
from igl_periods.surfaces import regular_map_surface, square_tiled_surface

SURFACES = {
    "one vertex": square_tiled_surface("omega_1"),
    "torus": generic_torus(),
    "genus 2": generic_genus_two(),
    "klein": regular_map_surface("klein"),
}


@pytest.mark.parametrize("name", SURFACES)
def test_areas_of_cells_add_up_to_the_area_of_the_surface(name):
    K = SURFACES[name]
    with flint.ctx.workprec(200):
        surface, cells, _ = cut(K)
        area = flint.arb(0)
        for starts, ends in zip(cells.start, cells.end):
            for a, b in zip(starts, ends):
                area += (a.conjugate() * b).imag / 2
        whole = flint.arb(0)
        for f in range(surface.n_faces):
            a, b, c = (surface.length(3 * f + s) for s in range(3))
            s = (a + b + c) / 2
            whole += (s * (s - a) * (s - b) * (s - c)).sqrt()
        assert area.overlaps(whole)
        assert float(area.rad()) < 1e-50


@pytest.mark.parametrize("name", SURFACES)
def test_boundaries_of_cells_are_closed_in_w(name):
    with flint.ctx.workprec(200):
        _, cells, _ = cut(SURFACES[name])
        for i in range(cells.n_chords):
            # Where a chord ends, seen from the star, another one starts.
            star = cells.cell[i, 1]
            ends = [_w(cells, i, cells.end[i][1])]
            starts = [
                _w(cells, j, cells.start[j][1])
                for j in range(cells.n_chords)
                if cells.cell[j, 1] == star
            ]
            assert sum(ends[0].overlaps(z) for z in starts) == 1


def _w(cells, i, zeta):
    star = int(cells.cell[i, 1])
    return ((zeta.log() + flint.acb(0, cells.turn[i])) * cells.exponent[star]).exp()


@pytest.mark.parametrize("name", SURFACES)
def test_both_sides_of_an_interface_have_the_same_length(name):
    _, cells, _ = cut(SURFACES[name])
    lengths = np.abs(cells.ends[:, :, 1] - cells.ends[:, :, 0])
    assert np.allclose(lengths[:, 0], lengths[:, 1], rtol=1e-14)


def test_cone_angles_are_known_exactly():
    with flint.ctx.workprec(200):
        _, cells, _ = cut(square_tiled_surface("omega_1"))
        assert cells.exponent[0].contains(flint.arb(flint.fmpq(1, 3)))
        _, cells, _ = cut(square_tiled_surface("omega_3"))
        assert all(k.contains(flint.arb(flint.fmpq(2, 3))) for k in cells.exponent)


def test_euler_characteristic_by_the_cone_angles():
    with flint.ctx.workprec(200):
        _, cells, _ = cut(generic_genus_two())
        assert sum((1 - 1 / k for k in cells.exponent), flint.arb(0)).contains(-2)


def test_lengths_known_badly_are_refused():
    from dataclasses import replace

    K = square_tiled_surface("omega_1")
    wide = replace(K, exact_lengths=Wide(K.exact_lengths))
    with pytest.raises(ip.ComplexError, match=r"balls that do not shrink|form no triangle"):
        ip.enclosures.enclose(wide, digits=10)


class Wide:
    def __init__(self, exact):
        self.exact = exact

    def __call__(self, bits):
        return [x + flint.arb(0, 1e-9) for x in self.exact(bits)]
