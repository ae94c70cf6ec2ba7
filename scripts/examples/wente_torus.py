"""
Wente's torus
=============

A torus of constant mean curvature that passes through itself.  Its conformal type is known by
elliptic integrals, and found again from its triangles.
"""

import matplotlib.pyplot as plt

import igl_periods as ip
from igl_periods.pictures import checkerboard_scene, render
from igl_periods.surfaces import wente_modulus, wente_torus

# %%
# The modulus of the smooth torus.

exact = wente_modulus()
print(exact)

# %%
# Meshes on its conformal coordinates.  The bound is about each polyhedral torus; the distance is
# that to the smooth one.

for N in (10, 20, 40):
    pm = ip.period_matrix(*wente_torus(N))
    distance = ip.moduli_distance(pm, [[exact]], tolerance=0.6)
    print(f"{N:3} x {N}: bound {pm.bound:.4f}, distance {distance:.6f}")

# %%
# That it is immersed and not embedded does not matter: only lengths are used.  The checkerboard
# shows how the surface passes through itself.

P = ip.parametrize(pm, ip.most_even_form(pm))
plt.imshow(render(checkerboard_scene(P), (800, 600), (0.3, 0.2, 1.0)))
plt.title("A holomorphic form on Wente's torus")
plt.axis("off")
plt.show()

# %%
# Other tori of the family have other lobes.

for lobes, winding in ((3, 2), (4, 1), (5, 2)):
    print(lobes, winding, wente_modulus(lobes, winding))
