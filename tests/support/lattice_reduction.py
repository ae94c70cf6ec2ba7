"""The definition of LLL-reduced bases, in floating point and in ball arithmetic."""

import flint
import numpy as np


def assert_lll_reduced(Y: np.ndarray) -> None:
    """By the definition, on the Gram–Schmidt coefficients of the Cholesky factor."""
    R = np.linalg.cholesky(Y)
    mu, height = R / np.diag(R), np.diag(R) ** 2
    assert np.abs(np.tril(mu, -1)).max(initial=0) <= 0.51 + 1e-6
    for i in range(1, len(Y)):
        assert height[i] >= (0.99 - mu[i, i - 1] ** 2) * height[i - 1] * (1 - 1e-6)


def exactly_lll_reduced(U: np.ndarray, Y: np.ndarray) -> bool:
    """The definition for U Y Uᵀ, by Gram–Schmidt in ball arithmetic of 200 bits."""
    with flint.ctx.workprec(200):
        basis = flint.arb_mat(U.tolist())
        gram = (basis * flint.arb_mat(Y.tolist()) * basis.transpose()).tolist()
        r, mu = [], []
        for i, row in enumerate(gram):
            r.append([])
            mu.append([])
            for j in range(i + 1):
                r[i].append(row[j] - sum((mu[j][k] * r[i][k] for k in range(j)), flint.arb(0)))
                if j < i:
                    mu[i].append(r[i][j] / r[j][j])
        height = [r[i][i] for i in range(len(Y))]
        lovasz = (height[i] >= (0.99 - mu[i][i - 1] ** 2) * height[i - 1] for i in range(1, len(Y)))
        return all(abs(m) <= 0.51 for row in mu for m in row) and all(lovasz)
