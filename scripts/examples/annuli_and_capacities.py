"""
Annuli and capacities
=====================

The capacity of a condenser, and the modulus of an annulus, are the period matrix of the double seen
otherwise.  Both sides of its certificate bound them.
"""

import matplotlib.pyplot as plt
import numpy as np

import igl_periods as ip
from igl_periods.domains import harmonic_measures
from igl_periods.surfaces import planar_domain


def circle(radius, centre=0, n=96):
    return centre + radius * np.exp(2j * np.pi * np.arange(n) / n)


# %%
# The annulus between circles of radii 1 and 2 has the capacity 2π / log 2.  Polygons stand for
# circles, and the capacity is theirs.

V, F = planar_domain(circle(2), [circle(1)])
C = ip.capacity_matrix(V, F, tolerance=1e-6)
print(C)
print("of circles:", 2 * np.pi / np.log(2))

# %%
# A plate with two holes, no symmetry: a 3 × 3 matrix, every entry between proved bounds.

outer = np.array([0, 5, 5 + 3j, 2 + 4j, 3j])
holes = [circle(0.5, 1.2 + 1.2j, 12), np.array([3 + 0.4j, 4 + 0.5j, 3.7 + 1.8j, 3 + 1.5j])]
V, F = planar_domain(outer, holes)
C = ip.capacity_matrix(V, F, tolerance=1e-6)
lower, upper = C.entry_bounds
print(C)
assert np.all(lower <= upper)
assert np.allclose(C.matrix.sum(axis=1), 0, atol=1e-5)

# %%
# The potential that is 1 on the first hole and 0 on the rest of the boundary.

K = ip.DeltaComplex.from_mesh(V, F)
u = harmonic_measures(K)[1]
plt.tripcolor(V[:, 0], V[:, 1], F, u[: len(V)], shading="gouraud")
plt.colorbar(label="potential")
plt.gca().set_aspect("equal")
plt.title("Potential of one conductor")
plt.show()

# %%
# Extremal length of a quadrilateral: the resistance between its first side and the opposite one.
# Of a rectangle it is their distance over their length.

V, F = planar_domain([0, 3, 3 + 1j, 1j])
print(ip.extremal_length(V, F, [0, 1, 2, 3]))
