r"""Schwarz's surfaces P and D, and Schoen's gyroid: one Riemann surface, three lattices.

The Gauss map of all three is the two-sheeted cover of the sphere that is branched at the eight
corners of a cube, :math:`y^2 = w^8 + 14 w^4 + 1`, of genus 3.  Their Weierstrass representation

.. math:: X = \operatorname{Re}\, e^{i\theta} \int \big(1 - w^2,\; i (1 + w^2),\; 2w\big)
          \frac{dw}{y}

differs by the *Bonnet angle* θ alone, so that they are isometric, and locally bent into each other.
The real periods are those of a lattice Λ of rank 3 for three angles (and those that symmetries make
of them): P, with a primitive cubic lattice, at θ = 0; D, with a face-centred one, at θ = π/2; and
between the two the gyroid, with a body-centred one, at

.. math:: \tan\theta = K(\tfrac34) / K(\tfrac14)

(parameters m of the complete elliptic integral), 51.985°.  M/Λ ⊂ R³/Λ has genus 3.

The mesh: a triangulation of the sphere, symmetric under the rotations of the cube, lifted to both
sheets; its edges become the chords of X.  All 48 symmetries of the curve stay: rotations of the
sphere turn chords, and the exchange of the sheets reverses them.  No other curve of genus 3 has
these, so that every one of the polyhedral surfaces, coarse or fine, P, D or G, *has* the period
matrix of the smooth one.

In homogeneous coordinates w = a/b the integrand has degree 0: a spinor (a, b) for each vertex and
segments between spinors do without a point at infinity.  The branch of y is continued along paths.

References
----------
Schwarz, "Gesammelte mathematische Abhandlungen" I (1890).
Schoen, "Infinite periodic minimal surfaces without self-intersections", NASA TN D-5541 (1970).
Große-Brauckmann, Wohlgemuth, "The gyroid is embedded and has constant mean curvature companions",
Calc. Var. 4 (1996).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order
from scipy.special import ellipk

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.complexes import DeltaComplex
from igl_periods.errors import MeshError

_BONNET = {"P": 0.0, "G": float(np.arctan2(ellipk(0.75), ellipk(0.25))), "D": np.pi / 2}
_NODES = 24
# The steps in which a branch of y is followed through a triangle.
_STEPS = 32
# Vectors of the lattice among which its shortest ones are looked for.
_KEPT = 60


class PeriodicMesh(NamedTuple):
    """A cell of a periodic surface, and its translations.

    Attributes
    ----------
    V : (n, 3) float
    F : (m, 3) int
    lattice : (3, 3) float
        A basis, as rows.
    """

    V: Floats
    F: Ints
    lattice: Floats


def triply_periodic_minimal_surface(name: str, n: int = 2) -> PeriodicMesh:
    """A cell of Schwarz's P or D surface or of the gyroid, inscribed, of 48 n² triangles.

    Parameters
    ----------
    name : {"P", "D", "G"}
    n : int
        Each of the 24 triangles between corners and middles of the faces of a cube, on either
        sheet of the Gauss map, is divided into n².

    Returns
    -------
    PeriodicMesh
        V, F and the lattice: arguments of :meth:`DeltaComplex.from_mesh`.

    Raises
    ------
    MeshError
        If there is no such name, or n < 1.

    Examples
    --------
    >>> V, F, lattice = triply_periodic_minimal_surface("G", 1)
    >>> DeltaComplex.from_mesh(V, F, lattice=lattice).genus
    3
    """
    if name not in _BONNET:
        raise MeshError(f'name = {name!r}: the surfaces are "P", "D" and "G" (gyroid).')
    if n < 1:
        raise MeshError(f"n = {n}: triangles are divided into n² with n >= 1.")
    P, F = _cube_sphere(n)
    chords, roots = _chords(P, F)
    twin = _lifted(DeltaComplex.from_mesh(P, F).twin, roots)
    real = np.real(np.exp(1j * _BONNET[name]) * chords)
    return _unfolded(np.concatenate([real, -real]), twin)


def _cube_sphere(n: int) -> tuple[Floats, Ints]:
    """The sphere in 24 n² triangles, with the corners of the cube among their corners."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    middles = np.vstack([np.eye(3), -np.eye(3)])
    V = np.vstack([corners, middles])
    F = []
    for k, middle in enumerate(middles):
        around = np.flatnonzero(corners @ middle > 0)
        u = corners[around[0]] - middle
        v = np.cross(middle, u)
        angle = np.arctan2((corners[around] - middle) @ v, (corners[around] - middle) @ u)
        ring = around[np.argsort(angle)]
        F += [[8 + k, ring[i], ring[(i + 1) % 4]] for i in range(4)]
    i, j = (index.ravel() for index in np.meshgrid(np.arange(n + 1), np.arange(n + 1)))
    i, j = i[i + j <= n], j[i + j <= n]
    weights = np.stack([n - i - j, i, j], axis=1) / n
    number = {pair: k for k, pair in enumerate(zip(i.tolist(), j.tolist()))}
    up = [[number[a, b], number[a + 1, b], number[a, b + 1]] for a, b in number if a + b < n]
    down = [[number[a + 1, b + 1], number[a, b + 1], number[a + 1, b]]
            for a, b in number if a + b < n - 1]  # fmt: skip
    points = np.einsum("pc,fck->fpk", weights, V[np.array(F)])
    local = np.array(up + down)[None] + len(i) * np.arange(len(F))[:, None, None]
    _, first, name = np.unique(
        np.rint(1e9 * points).reshape(-1, 3), axis=0, return_index=True, return_inverse=True
    )
    P = points.reshape(-1, 3)[first]
    return P / np.linalg.norm(P, axis=1)[:, None], name.ravel()[local].reshape(-1, 3)


def _spinors(P: Floats) -> Complexes:
    """Unit vectors (a, b) with a/b the stereographic projection of a point from (0, 0, 1)."""
    x, y, z = P.T
    from_above = np.stack([x + 1j * y, 1 - z + 0j], axis=1)
    from_below = np.stack([1 + z + 0j, x - 1j * y], axis=1)
    spinor = np.where((z < 0)[:, None], from_above, from_below)
    return np.asarray(spinor / np.linalg.norm(spinor, axis=1)[:, None])


def _square(s: Complexes) -> Complexes:
    """y² = a⁸ + 14 a⁴ b⁴ + b⁸."""
    a, b = s[..., 0] ** 4, s[..., 1] ** 4
    return np.asarray(a * a + 14 * a * b + b * b)


def _followed(start: Complexes, squares: Complexes) -> Complexes:
    """Roots along the first axis, each the closer one to its predecessor, beginning at a root."""
    root = np.sqrt(squares)
    before = np.concatenate([start[None], root[:-1]])
    turned = np.real(root * np.conj(before)) < 0
    return np.asarray(root * np.cumprod(1.0 - 2.0 * turned, axis=0))


def _chords(P: Floats, F: Ints) -> tuple[Complexes, Complexes]:
    """Integrals of the three forms along the sides of faces, and the branch of y they are taken on.

    Returns
    -------
    chords : (m, 3, 3) complex
        For each side.
    roots : (m, 3) complex
        y at the middle of each side.  The two faces of an edge speak of the same spinor there, so
        that their roots agree, or differ by the sign.
    """
    tail, head = np.roll(F, -1, axis=1), np.roll(F, 1, axis=1)
    spinors = _spinors(P)
    begin = spinors[np.minimum(tail, head)]
    end = _in_phase(begin, spinors[np.maximum(tail, head)])
    middle = 0.5 * (begin + end)
    root = _roots_at_middles(P, F, middle)
    nodes, gauss = np.polynomial.legendre.leggauss(_NODES)
    r, weights = 0.5 * (1.0 - nodes), 0.5 * gauss
    # On the segment b da − a db is constant; each half is run through from the middle, r = 1, in
    # t = r², so that the square root at a branch point is smooth.
    det = begin[..., 1] * end[..., 0] - begin[..., 0] * end[..., 1]
    total = np.zeros((*F.shape, 3), dtype=np.complex128)
    for target in (begin, end):
        spinor = target + r[:, None, None, None] ** 2 * (middle - target)
        y = _followed(root, _square(spinor))
        a, b = spinor[..., 0], spinor[..., 1]
        forms = np.stack([b * b - a * a, 1j * (b * b + a * a), 2 * a * b], axis=-1)
        total += np.einsum("q,q...->...", weights * r, forms / y[..., None]) * det[..., None]
    return total * np.where(tail < head, 1.0, -1.0)[..., None], root


def _in_phase(one: Complexes, other: Complexes) -> Complexes:
    """``other`` times the phase that makes its product with ``one`` positive."""
    product = np.einsum("...k,...k->...", np.conj(one), other)
    return np.asarray(other * (np.conj(product) / np.abs(product))[..., None])


def _roots_at_middles(P: Floats, F: Ints, middle: Complexes) -> Complexes:
    """Roots y at the middles of the sides, continued from the centre of each face; (m, 3)."""
    mean = P[F].mean(axis=1)
    centre = _spinors(mean / np.linalg.norm(mean, axis=1)[:, None])[:, None]
    near = _in_phase(centre, middle)
    t = np.linspace(0, 1, _STEPS)[:, None, None, None]
    path = _square((1 - t) * centre + t * near)
    root = _followed(np.sqrt(path[0]), path)[-1]
    # y has degree 4 in the spinor.
    phase = np.einsum("...k,...k->...", np.conj(near), middle)
    return np.asarray(root * (phase / np.abs(phase)) ** 4)


def _lifted(twin: Ints, roots: Complexes) -> Ints:
    """The gluing of both sheets: to the same one where roots agree; (2 m, 3)."""
    other, flat = twin.ravel(), roots.ravel()
    same = np.real(flat * np.conj(flat[other])) > 0
    size = other.size
    first = np.where(same, other, other + size)
    second = np.where(same, other + size, other)
    return np.concatenate([first, second]).reshape(-1, 3)


def _unfolded(sides: Floats, twin: Ints) -> PeriodicMesh:
    """The faces laid out in space along a tree, and the translations that are left.

    Parameters
    ----------
    sides : (m, 3, 3) float
        The vector of each side.
    twin : (m, 3) int
    """
    # Corner 1 is where side 2 leads from corner 0; side 1 leads from corner 2 to corner 0.
    corners = np.stack([np.zeros_like(sides[:, 0]), sides[:, 2], -sides[:, 1]], axis=1)
    half_edge = np.arange(twin.size)
    # Side s begins at corner s + 1, and where the other face has its end: at corner s' + 2.
    here = corners[half_edge // 3, (half_edge + 1) % 3]
    other = twin.ravel()
    there = corners[other // 3, (other % 3 + 2) % 3]
    step = here - there
    graph = coo_array((np.ones(other.size), (half_edge // 3, other // 3))).tocsr()
    order, before = breadth_first_order(graph, 0, directed=False)
    crossing = {(int(h) // 3, int(g) // 3): int(h) for h, g in zip(half_edge, other)}
    offset = np.zeros((len(twin), 3))
    for face in order[1:].tolist():
        offset[face] = offset[before[face]] + step[crossing[int(before[face]), face]]
    corners += offset[:, None]
    translations = offset[half_edge // 3] + step - offset[other // 3]
    lattice = _basis(translations)
    K = DeltaComplex.from_gluing(np.linalg.norm(sides, axis=2), twin)
    point = K.corner_vertex.ravel()
    flat = corners.reshape(-1, 3)
    _, first = np.unique(point, return_index=True)
    cell = np.rint((flat - flat[first[point]]) @ np.linalg.inv(lattice)).astype(np.int64)
    _, rows, F = np.unique(
        np.column_stack([point, cell]), axis=0, return_index=True, return_inverse=True
    )
    return PeriodicMesh(flat[rows], F.reshape(-1, 3).astype(np.int64), lattice)


def _basis(translations: Floats) -> Floats:
    """Shortest independent vectors of the lattice that is generated, which are a basis in R³."""
    size = float(np.linalg.norm(translations, axis=1).max())
    found = _shortest(np.vstack([translations, -translations]), size)
    while True:
        longer = _shortest(np.vstack([found, (found[:, None] - found[None]).reshape(-1, 3)]), size)
        if longer.shape == found.shape and np.allclose(longer, found, atol=1e-6 * size):
            break
        found = longer
    basis: list[Floats] = []
    for vector in found:
        if np.linalg.matrix_rank(np.array([*basis, vector]), tol=1e-3 * size) > len(basis):
            basis.append(vector)
    return np.array(basis[:3])


def _shortest(vectors: Floats, size: float) -> Floats:
    """The shortest different vectors that are not 0, in a fixed order."""
    rounded = np.rint(vectors / size * 1e6)
    _, first = np.unique(rounded, axis=0, return_index=True)
    different = vectors[first]
    norms = np.linalg.norm(different, axis=1)
    order = np.lexsort([*(-rounded[first].T), np.rint(norms / size * 1e6)])
    kept = order[norms[order] > 1e-4 * size][:_KEPT]
    return np.asarray(different[kept])
