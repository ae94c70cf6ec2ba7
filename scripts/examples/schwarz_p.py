"""
Schwarz's P surface, a periodic mesh
====================================

A triply periodic surface is a cell, and three translations that glue it.  Modulo translations
Schwarz's P, his D and Schoen's gyroid are closed surfaces of genus 3, and one Riemann surface.
"""

import matplotlib.pyplot as plt
import numpy as np

import igl_periods as ip
from igl_periods.surfaces import triply_periodic_minimal_surface

# %%
# A cell of P, and the complex that its translations glue.

V, F, lattice = triply_periodic_minimal_surface("P", 3)
K = ip.DeltaComplex.from_mesh(V, F, lattice=lattice)
print(K)
assert K.genus == 3

# %%
# The cell, and its neighbour.

figure = plt.figure()
axis = figure.add_subplot(projection="3d")
for shift, colour in ((np.zeros(3), "#3b7dd8"), (lattice[0], "#d8973b")):
    X = V + shift
    axis.plot_trisurf(X[:, 0], X[:, 1], X[:, 2], triangles=F, color=colour, edgecolor="none")
axis.set_box_aspect(np.ptp(np.concatenate([V, V + lattice[0]]), axis=0))
axis.set_axis_off()
plt.title("Two cells of Schwarz's P surface")
plt.show()

# %%
# The three surfaces have the same period matrix, up to the marking, though their shapes differ.

matrices = {}
for name in ("P", "D", "G"):
    V, F, lattice = triply_periodic_minimal_surface(name, 2)
    matrices[name] = ip.period_matrix(
        ip.DeltaComplex.from_mesh(V, F, lattice=lattice), tolerance=1e-4
    )
    print(name, matrices[name].bound)
for name in ("D", "G"):
    assert ip.symplectic_isomorphisms(matrices["P"], matrices[name])

# %%
# It is hyperelliptic: y² = x⁸ + 14 x⁴ + 1.  The catalogue knows it by name.

print(ip.identify(matrices["P"]))
