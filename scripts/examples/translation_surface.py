"""
A translation surface, from polygon to curve
============================================

Sides of a polygon are glued by translations.  Coordinates are exact; so the period matrix can be
proved to 50 digits, and what it is can be recognised.
"""

import matplotlib.pyplot as plt

import igl_periods as ip

# %%
# An L with sides 1 and the golden ratio, which is given by its polynomial t² − t − 1.

t = ip.algebraic_number([-1, -1, 1], near=1.6)
corners = [(0, 0), (1, 0), (t, 0), (t, 1), (1, 1), (1, t), (0, t), (0, 1)]
gluing = [((0, 0), (0, 5)), ((0, 1), (0, 3)), ((0, 2), (0, 7)), ((0, 4), (0, 6))]
L = ip.DeltaComplex.from_polygons([corners], gluing)
print(ip.flat_surface_report(L))

# %%
# The polygon, with a letter for every pair of glued sides.

x, y = ([float(p[k]) for p in [*corners, corners[0]]] for k in (0, 1))
plt.fill(x, y, color="#cde3f5", edgecolor="#234a6b")
for letter, pair in zip("abcd", gluing):
    for _, side in pair:
        plt.text((x[side] + x[side + 1]) / 2, (y[side] + y[side + 1]) / 2, letter, size=14)
plt.gca().set_aspect("equal")
plt.axis("off")
plt.title("Sides with the same letter are glued")
plt.show()

# %%
# The period matrix in balls.  It is proved that they contain the exact one.

proved = ip.enclose(L, digits=50)
print(proved.reduced())
print(proved.reduced().matrix[0, 0].imag.str(50))
assert proved.digits >= 50

# %%
# The curve.  Its invariants are proved within balls; coefficients are recognised, not proved.

C = ip.curve(proved)
print(C)
print(ip.to_sage(C))
