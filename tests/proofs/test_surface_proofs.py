"""The steps of a proof: triangulations with lengths in balls, energies in portions."""

import numpy as np
import pytest
from support.delaunay_surfaces import distorted
from support.random_surfaces import L_SHAPE, random_gluing, random_lengths

import igl_periods as ip
from igl_periods.elements import high_order_forms
from igl_periods.harmonic import factored
from igl_periods.proofs import midpoint_radius
from igl_periods.proofs.surface_proofs import (
    EnclosedTriangulation,
    high_order_proof,
    linear_problem,
    linear_proof,
)
from igl_periods.topology import mark


def test_divided_faces_keep_the_proof():
    K = distorted(L_SHAPE, 1, 0.2, 3)
    where = EnclosedTriangulation.of(mark(K)).flipped()
    bounds = []
    for _ in range(4):
        where = where.divided(np.arange(where.complex.n_faces))
        assert np.all(np.abs(where.lengths.mid[where.complex.edge] - where.complex.lengths) < 1e-12)
        laplacian, problem = linear_problem(where)
        energies = linear_proof(problem, factored(laplacian))
        bounds.append(energies.relative_radius(ip.period_matrix(K, degree=8).matrix))
    assert np.all(np.diff(bounds) < 0)


def test_portions_give_the_same_proof():
    rng = np.random.default_rng(4)
    twin = random_gluing(80, rng)
    parts = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()
    K = max(parts, key=lambda part: part.n_faces)
    where = EnclosedTriangulation.of(mark(K)).flipped()
    assert where.rank > 32
    laplacian, problem = linear_problem(where)
    factor = factored(laplacian)
    whole, portions = linear_proof(problem, factor), linear_proof(problem, factor, 1.0)
    assert np.array_equal(portions.combination, np.eye(where.rank))
    Pi = ip.period_matrix(K).matrix
    one, other = whole.relative_radius(Pi), portions.relative_radius(Pi)
    assert other == pytest.approx(one, rel=1e-9)
    assert np.allclose(whole.dirichlet(), portions.dirichlet(), rtol=0, atol=1e-11)


def test_arithmetic_that_proves_nothing_is_refused(monkeypatch):
    monkeypatch.setattr(midpoint_radius, "UNIT", 2.0**-52)
    with pytest.raises(ArithmeticError, match="nothing can be proved"):
        ip.period_matrix(distorted(L_SHAPE, 1, 0.1, 0), rigorous=True)


@pytest.mark.parametrize("degree", [2, 4])
def test_forms_on_the_divided_complex_have_the_same_proof(degree):
    # Whether faces are divided at midpoints by the forms, or before, lengths are halved exactly.
    where = EnclosedTriangulation.of(mark(distorted(L_SHAPE, 1, 0.1, 0)))
    forms = high_order_forms(where.complex, where.cochains, degree)
    assert forms.complex is not where.complex
    energies = high_order_proof(where, forms)
    divided = EnclosedTriangulation.of(mark(forms.complex))
    again = high_order_forms(divided.complex, divided.cochains, degree)
    assert again.complex is divided.complex
    other = high_order_proof(divided, again)
    Pi = ip.period_matrix(where.complex, degree=degree).matrix
    # In another marking, so that bounds are compared in the one of the first.
    assert energies.relative_radius(Pi) < 0.1
    assert np.allclose(
        np.linalg.eigvalsh(energies.mid), np.linalg.eigvalsh(other.mid), rtol=0, atol=1e-12
    )
    assert energies.rad.max() < 1e-13
    assert other.rad.max() < 1e-13
