"""
Lattice models: weights only
============================

In statistical mechanics a surface is a gluing of triangles with a coupling on each edge, and no
lengths.  Such weights have a period matrix, too; they have no bound, since nothing stands behind
them that it could be about.
"""

import matplotlib.pyplot as plt
import numpy as np

import igl_periods as ip

# %%
# A triangular lattice of a × b cells on a torus: which side is glued to which.  Side s is opposite
# corner s; half-edge 3 f + s is side s of triangle f.


def lattice(a, b):
    i, j = np.meshgrid(np.arange(a), np.arange(b), indexing="ij")
    lower = lambda i, j: 2 * (i % a * b + j % b)  # noqa: E731  corners (0,0), (1,0), (0,1)
    twin = np.empty((2 * a * b, 3), dtype=np.int64)
    below = lower(i, j).ravel()
    above = below + 1  # corners (1,1), (0,1), (1,0)
    twin[below] = np.stack([3 * above, 3 * lower(i - 1, j).ravel() + 4,
                            3 * lower(i, j - 1).ravel() + 5], axis=1)  # fmt: skip
    twin[above] = np.stack([3 * below, 3 * lower(i + 1, j).ravel() + 1,
                            3 * lower(i, j + 1).ravel() + 2], axis=1)  # fmt: skip
    return twin


# %%
# Three couplings, one for each direction.  The modulus follows from them.

couplings = np.array([0.3, 0.5, 0.9])
pm = ip.period_matrix_from_weights(np.tile(couplings, (2 * 8 * 6, 1)), lattice(8, 6))
print(pm.matrix, pm.bound)
assert pm.bound is None

# %%
# Theory says: as a quadratic form of the two directions the energy has the determinant
# ρ₁ρ₂ + ρ₂ρ₃ + ρ₃ρ₁.  If it is 1 (the star–triangle relation) the couplings are cotangents of
# angles of a triangle, and the lattice is a Delaunay triangulation of a flat torus.

angles = np.radians([50.0, 60.0, 70.0])
cotangents = 1 / np.tan(angles)
assert np.isclose(sum(cotangents * np.roll(cotangents, 1)), 1)
sides = np.sin(angles)
twin = lattice(8, 6)
flat = ip.period_matrix(ip.DeltaComplex.from_gluing(np.tile(sides, (len(twin), 1)), twin))
weights = ip.period_matrix_from_weights(np.tile(cotangents, (len(twin), 1)), twin)
assert np.allclose(flat.matrix, weights.matrix)

# %%
# Disorder: random couplings move the modulus a little.

rng = np.random.default_rng(0)
moduli = []
for _ in range(200):
    noise = rng.uniform(0.5, 1.5, twin.shape)
    noise = np.minimum(noise.ravel(), noise.ravel()[twin.ravel()]).reshape(twin.shape)
    moduli.append(ip.period_matrix_from_weights(noise * cotangents, twin).matrix[0, 0])
moduli = np.array(moduli)
plt.plot(moduli.real, moduli.imag, ".", label="disorder")
plt.plot(flat.matrix.real, flat.matrix.imag, "k+", markersize=12, label="order")
plt.xlabel("Re τ")
plt.ylabel("Im τ")
plt.title("Moduli of disordered lattices")
plt.legend()
plt.show()
