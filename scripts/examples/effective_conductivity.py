"""
Effective conductivities of periodic sheets
===========================================

A torus in space with the period matrix τ conducts like a flat one: as a tensor in the plane of the
lattice, of determinant 1.  Perforated plates have holes that insulate or conduct, and the two are
dual (Keller 1964).  The numbers are proved: lower ≤ σ ≤ upper.
"""

import numpy as np

import igl_periods as ip
from igl_periods.domains import effective_conductivity
from igl_periods.surfaces import planar_domain, triply_periodic_minimal_surface


def corrugated_sheet(n=16):
    """One cell of z = h(x, y), oblique, with bumps of no symmetry."""
    i, j = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    x, y = (i + 0.3 * j).ravel() / n, j.ravel() / n
    s, t = 2 * np.pi * i.ravel() / n, 2 * np.pi * j.ravel() / n
    z = 0.15 * np.sin(s) + 0.1 * np.cos(2 * s + t) + 0.05 * np.sin(2 * t)
    corner = (n + 1) * i[:-1, :-1].ravel() + j[:-1, :-1].ravel()
    a, b, c, d = corner, corner + n + 1, corner + n + 2, corner + 1
    F = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return ip.DeltaComplex.from_mesh(
        np.stack([x, y, z], axis=1), F, lattice=[[1, 0, 0], [0.3, 1, 0]]
    )


def perforated_plate(hole, n=6):
    """The unit cell of a square lattice without a polygon in it, sides divided into n."""
    t = np.arange(n) / n
    outer = np.concatenate([t, 1 + 1j * t, 1 + 1j - t, 1j - 1j * t])
    return ip.DeltaComplex.from_mesh(*planar_domain(outer, [hole], angle=0), lattice=np.eye(2))


def tensor_of(tau):
    """σ of the flat torus C / (Z + τZ) with the conductivity 1, for fields along 1 and τ.

    The energies of the classes that count 1 and τ are |τ|²/Im τ, −Re τ/Im τ and 1/Im τ.
    """
    return np.array([[abs(tau) ** 2, -tau.real], [-tau.real, 1]]) / tau.imag


def main():
    sheet = effective_conductivity(corrugated_sheet(), tolerance=1e-6)
    sigma = sheet.tensor[:2, :2]
    print(f"corrugated sheet\n{sigma}\ndeterminant {np.linalg.det(sigma):.9f}")

    ell = 0.2 + 0.2j + 0.3 * np.array([0, 2, 2 + 1j, 1 + 1j, 1 + 2j, 2j])
    plate = perforated_plate(ell)
    insulating = effective_conductivity(plate)
    conducting = effective_conductivity(plate, conducting_holes=True)
    rotation = np.array([[0, -1], [1, 0]])
    dual = rotation @ np.linalg.inv(conducting.tensor) @ rotation.T
    print(f"plate with insulating holes\n{insulating.tensor}\ndual of conducting ones\n{dual}")

    for name in ("P", "D", "G"):
        V, F, lattice = triply_periodic_minimal_surface(name, 4)
        K = ip.DeltaComplex.from_mesh(V, F, lattice=lattice)
        area = ip.complexes.double_areas(K.lengths).sum() / 2
        surface = effective_conductivity(K, tolerance=1e-4)
        part = 2 / 3 * area / abs(np.linalg.det(lattice))
        print(f"{name}: σ = {surface.tensor[0, 0]:.5f}, 2/3 of the area per volume {part:.5f}")


if __name__ == "__main__":
    main()
