"""What holds for every period matrix, whatever surface it is of."""

import numpy as np

from igl_periods.symplectic.canonical_basis import standard_form
from igl_periods.topology.cohomology import pairing


def check_result(pm):
    """Bilinear relations, unimodular pairing; with a certificate the bracket as well."""
    g, Pi = pm.genus, pm.matrix
    J = standard_form(g)
    assert np.array_equal(pairing(pm.complex, pm.cocycles, pm.cocycles), J)
    assert np.all(np.isfinite(Pi))
    assert np.array_equal(Pi, Pi.T)
    if pm.certified:
        assert 0 <= pm.bound < np.inf
    else:
        assert pm.bound is None
    if g == 0:
        return
    assert np.linalg.eigvalsh(Pi.imag)[0] > 0
    reduced = pm.reduced()
    scale = np.sqrt(np.diag(reduced.matrix.imag))
    uncertain = reduced.rounding_allowance * np.outer(scale, scale)
    assert np.all(np.abs(reduced.matrix.real) <= 0.5 + 1e-9 + uncertain)
    # The bound does not depend on the marking, up to the rounding that it allows for.
    assert (
        abs(reduced.symplectic_eigenvalues[0] / pm.symplectic_eigenvalues[0] - 1)
        <= 2 * pm.rounding_allowance + 2 * reduced.rounding_allowance
    )
    # d ≥ 1 is the bracket J D⁻¹ Jᵀ ≤ D, up to what the bound allows for rounding.
    assert not pm.certified or pm.symplectic_eigenvalues[-1] >= 1 - pm.rounding_allowance


def check_agreement(pm, other):
    """Two certificates of one surface in one marking overlap, entry by entry."""
    assert np.array_equal(pm.cocycles.toarray(), other.cocycles.toarray())
    apart = np.abs(pm.matrix - other.matrix)
    assert np.all(apart <= pm.entry_bounds + other.entry_bounds), (apart, pm.bound, other.bound)
