"""Folders of meshes, and the matrix of a row."""

from pathlib import Path

import igl
import numpy as np
from support.random_surfaces import noisy_torus, torus_of_revolution

TETRAHEDRON = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n"


def write_tori(folder: Path, n: int, prefix: str = "") -> None:
    folder.mkdir(parents=True, exist_ok=True)
    for k in range(n):
        path = folder / f"{prefix}torus_{k:02d}.off"
        igl.write_triangle_mesh(str(path), *noisy_torus(7 + k % 3, 6, 0.1, k))


def two_tori(folder: Path) -> Path:
    V, F = torus_of_revolution(2.0, 0.8, 12, 8)
    W, G = noisy_torus(7, 6, 0.1, 2)
    path = folder / "two.off"
    igl.write_triangle_mesh(
        str(path), np.concatenate([W + 9.0, V]), np.concatenate([G, F + len(W)])
    )
    return path


def matrix(row) -> np.ndarray:
    g = row["genus"]
    return np.reshape(row["matrix_real"], (g, g)) + 1j * np.reshape(row["matrix_imag"], (g, g))
