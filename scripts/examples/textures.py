"""
Textures of a surface of genus 4
================================

A holomorphic form makes a surface flat, but for 2g − 2 zeros.  Its integral gives texture
coordinates that are conformal; the texture jumps across seams by periods.  The mesh goes to Blender
as binary glTF.
"""

import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import igl_periods as ip
from igl_periods.pictures import checkerboard_scene, cut_scene, render, write_glb
from igl_periods.surfaces import lawson_surface, stereographic

# %%
# Lawson's surface ξ_{2,2} has genus 4.  It is a minimal surface of S³, here projected to space.

V, F = lawson_surface(2, 2, 8)
V = stereographic(V, 2, 2)
pm = ip.period_matrix(V, F).reduced()
print(pm.genus, pm.bound)

# %%
# The form of most even length.  Its coefficients are those in the basis ζ_1..ζ_4.

form = ip.most_even_form(pm)
P = ip.parametrize(pm, form)
print(P)

# %%
# Zeros: a form on genus 4 has 6 of them, counted with multiplicity.  A zero at a vertex winds the
# image of its triangles round more than once; one inside a triangle turns its image over.

at_vertices = {int(v): int(P.index[v]) for v in np.flatnonzero(P.index)}
in_faces = np.flatnonzero(P.reversed_faces)
print("at vertices:", at_vertices, "in faces:", in_faces)
assert sum(at_vertices.values()) + len(in_faces) == 2 * pm.genus - 2

# %%
# Seams: across each of them z jumps by a sum of periods of the form, exactly.

print("edges of the cut:", P.seams.size)
print("different jumps:", np.unique(np.round(P.seam_jumps, 6)).size)

# %%
# Two pictures: the checkerboard with the zeros, and the cut.

figure, axes = plt.subplots(1, 2, figsize=(10, 4))
for axis, scene, title in zip(
    axes, (checkerboard_scene(P), cut_scene(P)), ("Checkerboard and zeros", "The cut")
):
    axis.imshow(render(scene, (640, 480), (1, 0.6, 0.5)))
    axis.set_title(title)
    axis.axis("off")
plt.show()

# %%
# A file for Blender: *File, Import, glTF 2.0*.  The texture is inside.

with tempfile.TemporaryDirectory() as folder:
    (glb,) = write_glb(Path(folder, "genus_4.glb"), P)
    print(glb.name, glb.stat().st_size, "bytes")
