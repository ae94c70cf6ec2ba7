"""
Lawson's surface, recognised and more
=====================================

Bobenko, Mercat and Schmies computed the period matrix of Lawson's minimal surface of genus 2 from a
mesh, and recognised in it the surface of six squares.  Five lines do the same.
"""

import matplotlib.pyplot as plt

import igl_periods as ip
from igl_periods.pictures import cycles_scene, render

# %%
# As the paper did: compute both, and compare.

lawson = ip.period_matrix(*ip.load_mesh(ip.sample_files()["lawson_2_1"])[:2])
squares = ip.period_matrix(ip.surfaces.square_tiled_surface("omega_3", n=8))
found = ip.symplectic_isomorphisms(lawson, squares, tolerance=0.05)
print(len(found), "changes of the marking lead from one to the other")
print(ip.identify(lawson, 0.05))

# %%
# The mesh has curved neighbours only in the limit; its own matrix is near, and not the same.
# In S³, with the lengths it has there, the mesh keeps all symmetries of the surface: those
# determine the matrix, and even a coarse mesh has the exact one.

in_sphere = ip.surfaces.lawson_surface(2, 1, 3)
pm = ip.period_matrix(*in_sphere, tolerance=1e-6)
print(pm.reduced())

# %%
# More: the six squares, proved.  Their matrix in balls is recognised, with the evidence.

proved = ip.enclose(ip.surfaces.square_tiled_surface("omega_3", n=1), digits=30).reduced()
print(proved)
print(ip.recognize(proved))

# %%
# All comparisons are possible in balls, too: agreement comes with its digits.

print(ip.identify(proved))
assert ip.symplectic_automorphism_group(squares, tolerance=1e-6).order == 24

# %%
# The canonical cycles of the mesh.

plt.imshow(render(cycles_scene(lawson.reduced()), (800, 600), (1, 1, 0.5)))
plt.title("Canonical cycles on Lawson's surface")
plt.axis("off")
plt.show()
