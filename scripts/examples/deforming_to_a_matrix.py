"""
Deforming a mesh to a wanted Π
==============================

Period matrices have derivatives.  So a mesh can be moved, as little as possible, until its surface
has the matrix that one wants.
"""

import matplotlib.pyplot as plt
import numpy as np

import igl_periods as ip
from igl_periods.pictures import checkerboard_scene, render
from igl_periods.surfaces import torus_of_revolution

# %%
# The derivative of Π, compared with a small step.  (The torus has a little noise: where four
# vertices lie on a circle, the Delaunay triangulation may change with every step.)

V, F = torus_of_revolution(2.0, 0.8, 32, 16)
V = V + np.random.default_rng(0).normal(0, 0.01, V.shape)
pm = ip.period_matrix(V, F, keep_forms=True)
dV = 1e-5 * np.sin(3 * V)
step = ip.period_matrix(V + dV, F).matrix - pm.matrix
print(step[0, 0], pm.derivative(vertices=dV)[0, 0])
assert np.allclose(step, pm.derivative(vertices=dV), rtol=1e-3)

# %%
# A target: the square torus, and a skew one, which no torus of revolution is.

tau = pm.reduced().matrix[0, 0]
targets = {"square": 1j, "skew": tau + 0.15}
found = {}
for name, target in targets.items():
    found[name] = ip.deform_to(V, F, [[target]])
    print(name, found[name])
    assert found[name].reached

# %%
# The shapes, with the checkerboard of their holomorphic forms.

figure, axes = plt.subplots(1, 2, figsize=(10, 4))
for axis, (name, result) in zip(axes, found.items()):
    P = ip.parametrize(result.period_matrix, ip.most_even_form(result.period_matrix))
    axis.imshow(render(checkerboard_scene(P), (640, 480), (0.3, 0.2, 1)))
    axis.set_title(f"The {name} torus")
    axis.axis("off")
plt.show()

# %%
# Lengths alone move more freely: no positions are needed, and none come back.

K = ip.DeltaComplex.from_mesh(V, F)
print(ip.lengths_with(K, [[targets["skew"]]]))
