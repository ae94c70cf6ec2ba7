"""Thousands of awkward surfaces: a valid result or a documented error, never anything else."""

import re

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from support.random_surfaces import needle_gluing, noisy_torus, random_gluing, random_lengths
from support.result_checks import check_result

import igl_periods as ip

many = settings(max_examples=300, deadline=None, suppress_health_check=list(HealthCheck))


seeds = st.integers(0, 2**32 - 1)


def check_result_or_refusal(*surface):
    try:
        pm = ip.period_matrix(*surface)
        pm.reduced()
    except ip.ComplexError as error:
        refusal = str(error)
    else:
        check_result(pm)
        return
    assert re.search("is degenerate|too extreme for double precision", refusal)


@many
@given(n_faces=st.integers(1, 12), seed=seeds)
def test_random_gluings(n_faces, seed):
    # Multi-edges, loops, one-vertex surfaces, faces glued to themselves.
    rng = np.random.default_rng(seed)
    twin = random_gluing(2 * n_faces, rng)
    for K in ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components():
        check_result(ip.period_matrix(K))


@many
@given(n_faces=st.integers(1, 8), exponent=st.floats(1, 14), seed=seeds)
def test_random_gluings_of_needles(n_faces, exponent, seed):
    rng = np.random.default_rng(seed)
    K = ip.DeltaComplex.from_gluing(*needle_gluing(2 * n_faces, exponent, rng))
    for part in K.components():
        check_result_or_refusal(part)


@many
@given(n=st.integers(3, 7), m=st.integers(3, 6), noise=st.floats(0, 3), seed=seeds)
def test_coarse_noisy_tori(n, m, noise, seed):
    V, F = noisy_torus(n, m, noise, seed)
    pm = ip.period_matrix(V, F)
    assert pm.genus == 1
    check_result(pm)


@many
@given(n=st.integers(3, 6), seed=seeds, digits=st.integers(0, 3))
def test_tori_on_a_coarse_lattice(n, seed, digits):
    # Rounded coordinates: coinciding vertices, collinear faces, exact ties of Delaunay edges.
    V, F = noisy_torus(n, 4, 0.5, seed)
    check_result_or_refusal(np.round(V, digits), F)


@pytest.mark.slow
@settings(max_examples=10_000, deadline=None, suppress_health_check=list(HealthCheck))
@given(n_faces=st.integers(1, 40), seed=seeds)
def test_ten_thousand_gluings(n_faces, seed):
    rng = np.random.default_rng(seed)
    twin = random_gluing(2 * n_faces, rng)
    for K in ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components():
        check_result(ip.period_matrix(K))
