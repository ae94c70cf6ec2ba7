"""
What a bound says, and what it does not
=======================================

The bound of a period matrix is about the *polyhedral* surface: these triangles, glued.  It is not
about a smooth surface that their vertices lie on.
"""

import matplotlib.pyplot as plt
import numpy as np

import igl_periods as ip
from igl_periods.surfaces import torus_of_revolution, torus_of_revolution_modulus

# %%
# A torus of revolution has a known modulus.  Its meshes are other surfaces, with other moduli.

exact = np.array([[torus_of_revolution_modulus(2.0, 1.0)]])
sizes = [8, 16, 32, 64]
bounds, errors = [], []
for n in sizes:
    mesh = torus_of_revolution(2.0, 1.0, 2 * n, n)
    pm = ip.period_matrix(*mesh, tolerance=1e-8)
    bounds.append(pm.bound)
    errors.append(ip.moduli_distance(pm, exact, tolerance=0.6))
    print(f"{n:3}: bound {bounds[-1]:.1e}, distance to the smooth torus {errors[-1]:.1e}")

# %%
# The bound is as small as one likes on each of them.  The smooth torus is approached by finer
# meshes alone, with the square of their size.

plt.loglog(sizes, errors, "o-", label="distance to the smooth torus")
plt.loglog(sizes, bounds, "s-", label="bound")
plt.xlabel("vertices around the tube")
plt.title("The bound knows the triangles, not the smooth surface")
plt.legend()
plt.show()

# %%
# For smooth surfaces there is extrapolation, with an estimate, and without a certificate.

print(ip.richardson(lambda n: torus_of_revolution(2.0, 1.0, 2 * n, n), [8, 16, 32]))

# %%
# Rounding is part of the bound, as an allowance.  With ``rigorous`` every rounding is covered.

pm = ip.period_matrix(*mesh, tolerance=1e-8, rigorous=True)
assert pm.rigorous

# %%
# Weights that come from no geometry have no bound.  Nothing is claimed where nothing is known.

pm = ip.period_matrix(*mesh, weights="extrinsic", delaunay=False)
assert pm.bound is None

# %%
# Two bounds can prove a difference: no change of marking leads from one torus to the other.

thin = ip.period_matrix(*torus_of_revolution(2.0, 0.5, 64, 32))
assert not ip.symplectic_isomorphisms(ip.period_matrix(*mesh), thin)
