"""
Pipelines with libigl, trimesh, Open3D and PyVista
==================================================

Every function of a surface takes arrays, or a mesh of another library, as it is.
"""

import igl
import matplotlib.pyplot as plt
import numpy as np
import open3d
import pyvista
import trimesh

import igl_periods as ip

# %%
# **libigl**: arrays in, arrays out.

path = str(ip.sample_files()["wente_20x20"])
V, F = igl.read_triangle_mesh(path)
tau = ip.period_matrix(V, F).matrix[0, 0]
print(tau)

# %%
# **trimesh**: a mesh is made, smoothed, and handed over.

mesh = trimesh.creation.torus(major_radius=2.0, minor_radius=0.7, major_sections=24)
before = ip.period_matrix(mesh)
trimesh.smoothing.filter_taubin(mesh, iterations=3)
after = ip.period_matrix(mesh)
print(before.matrix, after.matrix)

# %%
# **Open3D**: also a legacy mesh after subdivision.  The midpoints of edges change no surface.

legacy = open3d.geometry.TriangleMesh.create_torus(2.0, 0.7, 12, 8)
finer = legacy.subdivide_midpoint(1)
one, other = (ip.period_matrix(mesh, tolerance=1e-6) for mesh in (legacy, finer))
assert ip.moduli_distance(one, other, tolerance=1e-5) < 1e-5

# %%
# **PyVista**: the density of ζ as an array of cells.  ``poly.plot(scalars="density")`` shows it.

poly = pyvista.PolyData.from_regular_faces(V, F)
pm = ip.period_matrix(poly)
P = ip.parametrize(pm, ip.most_even_form(pm))
poly.cell_data["density"] = P.density
print(poly.cell_data)

# %%
# And any of them through matplotlib: the density in the plane of z = ∫ζ.

z = P.uv
plt.tripcolor(z.real, z.imag, P.corner, facecolors=np.log10(P.density))
plt.colorbar(label="log |ζ|²")
plt.gca().set_aspect("equal")
plt.title("Wente's torus in the plane of z = ∫ζ")
plt.show()
