"""The index of the meshes made by others, and how facts are compared with it."""

from collections import Counter

# The INDEX.md of the folder of meshes: vertices, triangles, bad edges, bad vertices,
# inconsistently oriented edges, and components as (genus or crosscaps, boundary loops): number.
INDEX = {
    "spot_triangulated.obj": (2930, 5856, 0, 0, 0, {(0, 0): 1}),
    "Csaszar.ply": (7, 14, 0, 0, 0, {(1, 0): 1}),
    "bob_small.ply": (250, 500, 0, 0, 0, {(1, 0): 1}),
    "rocker-arm.obj": (10044, 20088, 0, 0, 0, {(1, 0): 1}),
    "wente_torus02.obj": (1240, 2480, 0, 0, 0, {(1, 0): 1}),
    "eight.off": (766, 1536, 0, 0, 0, {(2, 0): 1}),
    "3holes.obj": (1987, 3982, 0, 0, 0, {(3, 0): 1}),
    "kq_surface.obj": (56, 120, 0, 0, 0, {(3, 0): 1}),
    "fertility.off": (4494, 9000, 0, 0, 0, {(4, 0): 1}),
    "botijo.obj": (41158, 82332, 0, 0, 0, {(5, 0): 1}),
    "scaffolding.ply": (640, 1388, 0, 0, 0, {(28, 0): 1}),
    "buckyball.obj": (5221, 10562, 0, 0, 0, {(31, 0): 1}),
    "punctured-torus.obj": (4599, 9184, 0, 0, 0, {(1, 1): 1}),
    "moebius.obj": (280, 448, 0, 0, 4, {(1, 1): 1}),
    "klein_zero_coords.off": (9, 18, 0, 0, 21, {(2, 0): 1}),
    "hourglass_ico.obj": (23, 40, 0, 1, 0, {(0, 0): 2}),
    "triple_vierbein.obj": (75, 108, 20, 21, 3, {(0, 1): 6}),
    "two-tori.obj": (1152, 2304, 0, 0, 0, {(1, 0): 2}),
    "conrod.off": (3223, 6442, 3, 6, 5149, {(0, 1): 3, (0, 3): 1}),
    "featuretype.ply": (
        *(5096, 3476, 0, 0, 0),
        {(0, 1): 838, (0, 2): 11, (0, 3): 1, (0, 9): 1, (0, 11): 1},
    ),
    "bunny2.ply": (1623, 1000, 0, 1, 0, {(0, 4): 1}),
}


def kinds(facts) -> dict[tuple[int, int], int]:
    return dict(Counter((part.genus, part.boundary_loops) for part in facts.components))
