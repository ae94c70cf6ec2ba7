"""The ring of endomorphisms."""

import pickle

import flint
import numpy as np
import pytest
from support.enclosed_surfaces import l_shape_matrix
from support.jacobian_points import fifth_roots, quaternionic, random_point, silhol

import igl_periods as ip
from igl_periods.jacobians.endomorphism_ring import closed_ring
from igl_periods.surfaces.exact_matrices import klein

POINTS = {
    "golden L": lambda: l_shape_matrix((1 + flint.arb(5).sqrt()) / 2),
    "Klein": klein,
    "fifth roots": fifth_roots,
    "quaternions": lambda: quaternionic(flint.acb(0.3, flint.arb.pi())),
}


@pytest.fixture(params=POINTS, scope="module")
def ring(request):
    with flint.ctx.workdps(50):
        return ip.endomorphisms(POINTS[request.param]())


def test_it_is_a_ring_with_an_involution(ring):
    one = np.eye(2 * ring.genus, dtype=np.int64)
    assert ring.contains(one)
    for M in ring:
        assert ring.contains(ring.rosati(M))
        assert np.trace(M @ ring.rosati(M)) > 0
        assert all(ring.contains(M @ N) for N in ring)
    assert not ring.contains(np.diag(np.arange(2 * ring.genus)))


def test_the_trace_form_with_the_involution_is_positive_definite(ring):
    form = [[int(np.trace(M @ ring.rosati(N))) for N in ring] for M in ring]
    assert np.linalg.eigvalsh(np.array(form, dtype=float))[0] > 0


def test_symmetric_endomorphisms_have_real_eigenvalues(ring):
    for s in ring.symmetric.basis:
        assert np.abs(np.linalg.eigvals(s).imag).max() < 1e-6


def test_the_ring_does_not_depend_on_the_marking(ring):
    g = ring.genus
    gamma = np.kron(np.array([[0, 1], [-1, 1]]), np.eye(g, dtype=np.int64))
    from igl_periods.siegel import moved_balls

    with flint.ctx.workdps(50):
        moved = ip.endomorphisms(moved_balls(gamma, ring.matrix, flint.ctx.prec))
    assert (moved.rank, moved.name, moved.discriminant) == (ring.rank, ring.name, ring.discriminant)
    assert abs(moved.trace_discriminant) == abs(ring.trace_discriminant)


def test_the_fifth_roots_of_unity():
    """End = Z[ζ], of discriminant 125, with real multiplication by Z[(1 + √5)/2]."""
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(fifth_roots())
    assert ring.discriminant == 125
    assert [str(field) for field in ring.real_fields] == ["Q(√5)"]
    assert ring.is_commutative
    assert ring.has_complex_multiplication
    assert "discriminant 125" in repr(ring)
    assert "recognised, not proved" in ring._repr_html_()


def test_golden_l_has_real_multiplication_by_the_root_of_5():
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(POINTS["golden L"]())
    assert "Q(√5)" in map(str, ring.real_fields)
    assert ring.field is None
    assert ring.discriminant is None


def test_quaternions_contain_only_fields_in_which_2_and_3_do_not_split():
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(POINTS["quaternions"]())
    for field in ring.real_fields:
        d = -field.polynomial[0]
        assert d % 8 != 1
        assert d % 3 != 1


def test_more_digits_confirm_or_exclude():
    with flint.ctx.workdps(20):
        ring = ip.endomorphisms(POINTS["golden L"]())
    with flint.ctx.workdps(100):
        better = ring.checked(POINTS["golden L"](), 340, 100.0)
        assert better.evidence.checked_digits == 100.0
        near = l_shape_matrix((1 + flint.arb(5).sqrt()) / 2 + flint.arb(10) ** -60)
        with pytest.raises(ValueError, match="are not endomorphisms"):
            ring.checked(near, 340, 100.0)


def test_a_sequence():
    ring = ip.endomorphisms(silhol())
    assert len(ring) == 18
    assert len(ring[:3]) == 3
    assert ring.analytic(ring[0]).nrows() == 3


def test_products_are_added_until_it_is_a_ring():
    M = np.array([[0, 1], [-1, 0]])
    assert closed_ring(np.array([M])).rank == 2
    shear = np.eye(4, dtype=np.int64)
    shear[0, 1], shear[3, 2] = 1, 0
    generated = closed_ring(shear[None])
    assert all(generated.contains(M @ N) for M in generated.basis for N in generated.basis)
    assert generated.rank == 3


def test_evidence():
    with flint.ctx.workdps(50):
        generic = ip.endomorphisms(random_point(2, 9)).evidence
        special = ip.endomorphisms(POINTS["golden L"]()).evidence
    for evidence in (generic, special):
        assert evidence.left_over > 100
        assert evidence.checked_digits > 45
        assert evidence.excluded > 15


def test_results_pickle():
    with flint.ctx.workdps(50):
        ring = ip.endomorphisms(POINTS["golden L"]())
    _ = ring.name, ring.symmetric.rows
    again = pickle.loads(pickle.dumps(ring))
    assert again.matrix.contains(ring.matrix)
    assert np.array_equal(again.basis, ring.basis)
    assert again.name == ring.name
    assert again.evidence == ring.evidence
