import flint
import numpy as np
import pytest
from support.enclosed_surfaces import generic_genus_two, generic_torus, triangulated

import igl_periods as ip
from igl_periods.enclosures.triangulation import following


def check(surface):
    for h, t in enumerate(surface.twin):
        assert surface.twin[t] == h != t
        assert surface.edge[t] == surface.edge[h]
        assert surface.sign[t] == -surface.sign[h]
        assert (
            surface.corner_vertex[following(h)] == surface.corner_vertex[t - (t % 3) + (t + 2) % 3]
        )
    for f in range(surface.n_faces):
        values = [surface.value(3 * f + s) for s in range(3)]
        assert not np.any(np.sum(values, axis=0))


@pytest.mark.parametrize("K", [generic_torus(), generic_genus_two()], ids=["torus", "genus 2"])
def test_moves_keep_gluing_closedness_and_genus(K):
    with flint.ctx.workprec(200):
        surface, _ = triangulated(K)
        third = flint.fmpq(1, 3)
        surface.insert(2, (third, third, third))
        flipped = [surface.flip(h) for h in range(0, len(surface.twin), 5)]
        assert any(flipped)
        check(surface)
    again = ip.DeltaComplex.from_gluing(
        surface.lengths_in_floats(), np.array(surface.twin).reshape(-1, 3)
    )
    assert (again.genus, again.n_vertices) == (K.genus, K.n_vertices + 1)


def test_flip_and_back_is_the_identity_on_lengths_and_cochains():
    with flint.ctx.workprec(200):
        surface, _ = triangulated(generic_torus())
        for h in range(len(surface.twin)):
            edge, before = surface.edge[h], surface.lengths[surface.edge[h]]
            values = surface.cochains[edge]
            if not surface.flip(h):
                continue
            there = next(i for i, e in enumerate(surface.edge) if e == edge)
            assert surface.flip(there)
            assert surface.lengths[edge].overlaps(before)
            assert surface.cochains[edge] in (values, tuple(-x for x in values))


def test_face_glued_to_itself_is_not_flipped():
    # Two sides of each triangle are glued to each other: a sphere with two cone points at least.
    K = ip.DeltaComplex.from_gluing([[1.0, 0.8, 0.8], [1.0, 0.8, 0.8]], [[3, 2, 1], [0, 5, 4]])
    surface, _ = triangulated(K)
    assert not surface.flip(1)


def test_inserted_vertex_is_flat():
    with flint.ctx.workprec(200):
        surface, _ = triangulated(generic_torus())
        surface.insert(0, (flint.fmpq(1, 2), flint.fmpq(1, 4), flint.fmpq(1, 4)))
        v = surface.n_vertices - 1
        angle = flint.arb(0)
        for f in range(surface.n_faces):
            for k in range(3):
                if surface.corner_vertex[3 * f + k] == v:
                    a, b, c = (surface.length(3 * f + (k + j) % 3) for j in range(3))
                    angle += ((b * b + c * c - a * a) / (2 * b * c)).acos()
        assert (angle - 2 * flint.arb.pi()).contains(0)
        assert float(angle.rad()) < 1e-50
