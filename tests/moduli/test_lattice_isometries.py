"""The search for isometries of lattices: against brute force, and where it is given up."""

import numpy as np
from support.brute_force_equivalence import isomorphisms
from support.symmetric_matrices import SYMMETRIC, keys

from igl_periods.moduli import lattice_isometries as isometries
from igl_periods.moduli.equivalence import symplectic_isomorphisms

# --- automorphism groups -----------------------------------------------------------------------


def test_the_search_agrees_with_brute_force():
    for name in ("Omega_1", "Bolza", "Omega_3", "y^2 = x^5 - 1"):
        Pi = SYMMETRIC[name][0]
        found = symplectic_isomorphisms(Pi, Pi)
        assert max(np.abs(gamma).max() for gamma in found) <= 2
        assert keys(found) == keys(isomorphisms(Pi, Pi, 1e-8))


# --- isomorphisms ------------------------------------------------------------------------------


def test_backtracking_is_given_up(monkeypatch):
    monkeypatch.setattr(isometries, "SEARCH_LIMIT", 10)
    Pi = SYMMETRIC["Bolza"][0]
    found = symplectic_isomorphisms(Pi, Pi)
    assert found.verdict == "undecided: the search was given up (more than 10 images tried)"
