"""Integer matrices of any size: products and inverses are exact."""

import numpy as np
import pytest

from igl_periods.symplectic.integer_matrices import product, unimodular_inverse


# Integers
@pytest.mark.parametrize("largest", [3, 10**6, 6 * 10**7, 10**8])
def test_products_are_exact(largest):
    rng = np.random.default_rng(largest)
    A, B = rng.integers(-largest, largest + 1, (2, 40, 40))
    exact = A.astype(object) @ B.astype(object)
    assert np.array_equal(product(A, B), exact)


def test_products_beyond_64_bits():
    A = np.full((2, 2), 2**40)
    with pytest.raises(OverflowError):
        product(A, A)


@pytest.mark.parametrize("size", [1, 30])
@pytest.mark.parametrize("largest", [1, 40])
def test_inverses_are_exact(size, largest):
    # Triangular factors: of determinant −1, and of inverses with huge entries.
    rng = np.random.default_rng(size)
    for _ in range(3):
        L = np.tril(rng.integers(-largest, largest + 1, (size, size)), -1)
        L[:, size // 3 + 1 :] = 0
        U = (L + np.eye(size, dtype=np.int64))[::-1]
        inverse = unimodular_inverse(U)
        assert np.array_equal(inverse.astype(object) @ U.astype(object), np.eye(size))
    assert unimodular_inverse(np.zeros((0, 0), dtype=np.int64)).shape == (0, 0)
