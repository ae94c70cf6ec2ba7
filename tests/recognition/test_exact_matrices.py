"""Matrices of recognised numbers."""

import pickle

import flint
import pytest

from igl_periods.recognition import recognise_matrix


def bolza():
    root = flint.acb(-2).sqrt()
    return flint.acb_mat(
        [[(2 * root - 2) / 3, (1 - root) / 3], [(1 - root) / 3, (2 * root - 2) / 3]]
    )


def test_the_matrix_of_the_surface_of_bolza():
    with flint.ctx.workdps(40):
        found = recognise_matrix(bolza())
    assert found.complete
    assert found.shape == (2, 2)
    assert (found.degree, found.height) == (2, 4)
    assert str(found.field) == "Q(i√2)"
    assert found.left_over > 60
    with flint.ctx.workdps(200):
        assert found.ball(700).overlaps(bolza())
    assert "(-2 + 2i√2)/3" in str(found)
    assert found.latex().startswith(r"\begin{pmatrix} \frac{-2 + 2\mathrm{i}\sqrt{2}}{3}")
    assert "Q(i√2)" in found._repr_html_()


def test_what_is_not_recognised_is_left_out():
    with flint.ctx.workdps(40):
        found = recognise_matrix(flint.acb_mat([[flint.acb(flint.arb.pi()), flint.acb(1)]]))
    assert found[0, 0] is None
    assert found[0, 1].polynomial == (-1, 1)
    assert not found.complete
    assert found.field is None
    assert "?" in str(found)
    assert "?" in found.latex()
    with pytest.raises(ValueError, match="not recognised"):
        found.ball(100)


def test_no_entries():
    assert recognise_matrix(flint.acb_mat(0, 0)).complete


def test_results_pickle():
    with flint.ctx.workdps(40):
        found = recognise_matrix(bolza())
    assert pickle.loads(pickle.dumps(found)) == found
