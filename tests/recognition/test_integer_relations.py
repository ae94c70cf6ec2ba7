"""Integer relations by LLL."""

import flint

from igl_periods.recognition import nearest_integer, reduced_relations, scaled_lattice


def test_integers_next_to_the_midpoints_of_balls():
    assert nearest_integer(flint.arb(2.75)) == 3
    assert nearest_integer(flint.arb(-2.75), 1) == -5  # -5.5 is rounded upwards
    assert nearest_integer(flint.arb(3), 100) == 3 << 100


def test_a_relation_is_the_shortest_vector():
    with flint.ctx.workprec(200):
        root = flint.arb(2).sqrt()
        # √2 · √3 = √6
        numbers = [root * flint.arb(3).sqrt(), flint.arb(6).sqrt(), flint.arb(1)]
        first, *others = reduced_relations([[x] for x in numbers], 150)
    assert first in ([1, -1, 0], [-1, 1, 0])
    assert all(max(map(abs, row)) > 1e20 for row in others)


def test_the_basis_stays_a_basis_of_all_integer_vectors():
    with flint.ctx.workprec(200):
        values = [[flint.arb(k).sqrt(), flint.arb(k).log()] for k in range(2, 7)]
        basis = reduced_relations(values, 60)
    assert abs(int(flint.fmpz_mat(basis).det())) == 1


def test_weights_are_taken_out_again():
    values = [[flint.arb(1)], [flint.arb(1000)]]
    assert scaled_lattice(values, 0, [1000, 1]).tolist() == [[1000, 0, 1], [0, 1, 1000]]
    assert abs(int(flint.fmpz_mat(reduced_relations(values, 3, [1000, 1])).det())) == 1
