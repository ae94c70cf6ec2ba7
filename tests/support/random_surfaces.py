"""Surfaces for the tests: awkward ones, random ones, and ones whose period matrix is known."""

import numpy as np

# Sides of a unit square: 0 bottom, 1 right, 2 top, 3 left.  The three square-tiled surfaces of
# Bobenko, Mercat, Schmies, section 4.1; the gluings are not printed there, they were found by
# search and are verified by their period matrices.
L_SHAPE = [((0, 1), (1, 3)), ((1, 1), (0, 3)), ((0, 2), (2, 0)),
           ((2, 2), (0, 0)), ((1, 2), (1, 0)), ((2, 1), (2, 3))]  # fmt: skip
BOLZA = [((0, 0), (1, 0)), ((0, 2), (1, 2)), ((2, 0), (3, 0)), ((2, 2), (3, 2)),
         ((0, 1), (2, 1)), ((0, 3), (2, 3)), ((1, 1), (3, 3)), ((1, 3), (3, 1))]  # fmt: skip
HEXAGON = [((k, 1), ((k + 1) % 6, 0)) for k in range(6)] + [
    ((k, 3), ((k + 1) % 6, 2)) for k in range(6)
]

OMEGA_1 = 1j / 3 * np.array([[5, -4], [-4, 5]])
OMEGA_2 = np.array([[-2 + np.sqrt(8) * 1j, 1 - np.sqrt(2) * 1j],
                    [1 - np.sqrt(2) * 1j, -2 + np.sqrt(8) * 1j]]) / 3  # fmt: skip
OMEGA_3 = 1j / np.sqrt(3) * np.array([[2, -1], [-1, 2]])


def torus_grid(n: int, m: int) -> np.ndarray:
    """Faces of an n × m grid of vertices i m + j on a torus, counterclockwise in (i, j)."""
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    a, b = i * m + j, (i + 1) % n * m + j
    c, d = (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
    lower, upper = np.stack([a, b, c], -1), np.stack([a, c, d], -1)
    return np.concatenate([lower.reshape(-1, 3), upper.reshape(-1, 3)])


def torus_of_revolution(R: float, r: float, n: int, m: int) -> tuple[np.ndarray, np.ndarray]:
    """n × m vertices on the torus with radii R > r, conformally uniform in both directions.

    Its modulus is i r / √(R² − r²) up to SL(2, Z): the metric is (R + r cos φ)² (du² + dv²) with
    dv = r dφ / (R + r cos φ).
    """
    u = 2 * np.pi * np.arange(n) / n
    v = 2 * np.pi * np.arange(m) / m
    phi = 2 * np.arctan(np.sqrt((R + r) / (R - r)) * np.tan(v / 2))
    u, phi = np.meshgrid(u, phi, indexing="ij")
    rho = R + r * np.cos(phi)
    V = np.stack([rho * np.cos(u), rho * np.sin(u), r * np.sin(phi)], axis=-1)
    return V.reshape(-1, 3), torus_grid(n, m)


def noisy_torus(n: int, m: int, noise: float, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """A coarse torus with displaced vertices: needles, caps, many edges that are not Delaunay."""
    V, F = torus_of_revolution(2.0, 0.7, n, m)
    return V + noise * np.random.default_rng(seed).normal(size=V.shape), F


def random_gluing(n_faces: int, rng: np.random.Generator) -> np.ndarray:
    """A random involution of the sides of an even number of triangles."""
    order = rng.permutation(3 * n_faces)
    twin = np.empty(3 * n_faces, dtype=np.int64)
    twin[order[0::2]], twin[order[1::2]] = order[1::2], order[0::2]
    return twin.reshape(-1, 3)


def random_lengths(twin: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Lengths equal on glued sides that satisfy all triangle inequalities."""
    lengths = rng.uniform(1.0, 1.98, twin.size)
    return np.minimum(lengths, lengths[twin.ravel()]).reshape(-1, 3)


def needle_gluing(
    n_faces: int, exponent: float, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Lengths and gluing of an even number of isosceles needles, as thin as 10^-exponent.

    One side of every face is free to be tiny: the sides of equal length are glued to each other.
    """
    order = 3 * np.arange(n_faces)
    twin = np.empty(3 * n_faces, dtype=np.int64)
    short = rng.permutation(order)
    twin[short[0::2]], twin[short[1::2]] = short[1::2], short[0::2]
    long = rng.permutation(np.concatenate([order + 1, order + 2]))
    twin[long[0::2]], twin[long[1::2]] = long[1::2], long[0::2]
    lengths = np.ones(3 * n_faces)
    lengths[short] = np.repeat(10.0 ** -rng.uniform(0, exponent, n_faces // 2), 2)
    return lengths.reshape(-1, 3), twin.reshape(-1, 3)
