"""
A first period matrix, from a scan
==================================

A scan is seldom a surface: patches are not joined, triangles occur twice, some are missing.  Here a
damaged file is read, repaired, judged, and its period matrix computed to certified digits.
"""

import tempfile
from pathlib import Path

import igl
import matplotlib.pyplot as plt
import numpy as np

import igl_periods as ip
from igl_periods.pictures import quality_scene, render, with_legend

# %%
# A damaged file.  No triangle has a vertex in common with another one: each has its own three.  Two
# triangles are missing, one occurs twice, and one is turned round.

V, F, _ = ip.load_mesh(ip.sample_files()["lawson_2_1"])
F = np.concatenate([F[2:], F[10:11]])
F[100] = F[100, ::-1]
folder = tempfile.TemporaryDirectory()
scan = Path(folder.name, "scan.off")
igl.write_triangle_mesh(str(scan), V[F].reshape(-1, 3), np.arange(F.size).reshape(-1, 3))

# %%
# Reading it shows what is wrong.  Without repair this is not a closed surface.

print(ip.load_mesh(scan)[2])

# %%
# Repair is done on request, and counted.  Holes of at most 6 edges are filled.

V, F, report = ip.load_mesh(scan, repair=True, largest_hole=6)
print(report)

# %%
# The period matrix has a bound, which is a theorem about these triangles.

pm = ip.period_matrix(V, F)
print(pm.reduced())
print(f"relative error at most {pm.bound:.2g}")

# %%
# Where does the bound come from?  The quality of the mesh says so, and the picture shows it.

quality = ip.mesh_quality(V, F)
print(quality)
scene = quality_scene(pm.complex, quality)
plt.imshow(with_legend(render(scene, (800, 600), (1, 1, 0.5)), scene))
plt.title("Where the bound comes from")
plt.axis("off")
plt.show()

# %%
# More digits need no finer mesh.  The degree of the trial functions rises until the bound is met.

pm = ip.period_matrix(V, F, tolerance=1e-6)
print(pm.reduced())
assert pm.bound <= 1e-6
folder.cleanup()
