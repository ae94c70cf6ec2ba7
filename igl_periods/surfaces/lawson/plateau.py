r"""Minimal patches in the 3-sphere, bounded by geodesics: two Newton iterations.

A patch is a triangulated disc in S³ ⊂ R⁴ whose corners are fixed and whose sides lie on great
circles.

*Harmonic map.*  Minimise ½ tr xᵀLx over maps from the surface glued of unit equilateral triangles
(L has the weight cot 60° / 2 per triangle and side), with the vertices of a side free to slide
along it.  Where the glued surface is conformal to the minimal one, this map is conformal, hence
minimal, and its triangles are nearly equilateral.  Unknowns are three tangential displacements of
an inner vertex and one angle of a vertex on a side.

*Minimal surface.*  Minimise the area over displacements along the normals of the inner vertices,
the boundary being fixed.  Normal displacements alone leave the parametrisation, and so the shape of
the triangles, as the first stage made it, and they make the second derivative of the area regular.

Both use second derivatives on the sphere, where a geodesic x(s) has x'' = −x: the Hessian of an
energy is that of R⁴ minus ⟨x, ∂E/∂x⟩ on the diagonal.

References
----------
Pinkall, Polthier, "Computing discrete minimal surfaces and their conjugates" (1993).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import block_diag, coo_array, csc_array, diags_array
from scipy.sparse.linalg import splu

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import cotangents
from igl_periods.display import arrays_repr
from igl_periods.errors import MeshError

_MAX_ITERATIONS = 60
_MAX_NORMAL_STEP = 0.3
_FULL_NEWTON_BELOW = 1e-2


@dataclass(frozen=True)
class Patch:
    """A triangulated disc in S³: the corners first, then the vertices of the sides, then the rest.

    Attributes
    ----------
    x : (n, 4) float
        Unit vectors.
    faces : (m, 3) int
    ends : (n_sides, 2, 4) float
        The orthogonal unit vectors p, q that each side joins.
    angles : (n_sides, r) float
        Angles t of the vertices p cos t + q sin t of each side.
    n_corners : int
    """

    __repr__ = arrays_repr

    x: Floats
    faces: Ints
    ends: Floats
    angles: Floats
    n_corners: int

    @property
    def n_boundary(self) -> int:
        """Number of corners and vertices of sides."""
        return self.n_corners + self.angles.size


def on_sides(ends: Floats, angles: Floats) -> Floats:
    """The points p cos t + q sin t of the sides; (n_sides r, 4)."""
    points = (
        np.cos(angles)[..., None] * ends[:, None, 0] + np.sin(angles)[..., None] * ends[:, None, 1]
    )
    return points.reshape(-1, 4)


def harmonic(patch: Patch) -> Patch:
    """Move the vertices to the harmonic map of the equilateral surface with sliding boundary.

    Raises
    ------
    MeshError
        If the iteration does not converge.
    """
    L = laplacian(patch.faces, np.full(patch.faces.shape, 1 / np.sqrt(3)), len(patch.x))
    least = np.inf
    for _ in range(_MAX_ITERATIONS):
        T = _tangents(patch)
        Lx = L @ patch.x
        gradient = T.T @ Lx.ravel()
        size = np.abs(gradient).max(initial=0.0)
        if _is_converged(size, least):
            return patch
        least = min(least, size)
        curvature = np.einsum("id,id->i", patch.x, Lx) * (size < _FULL_NEWTON_BELOW)
        hessian = _kron4(L - diags_array(curvature))
        step = -_solve(T.T @ hessian @ T, gradient)
        patch = _line_search(patch, L, step)
    raise MeshError(f"the harmonic patch did not converge: its gradient is still {size:.3g}.")


def minimal(patch: Patch) -> Patch:
    """Move the inner vertices along their normals until the area is stationary.

    Raises
    ------
    MeshError
        If the iteration does not converge.
    """
    inner = np.arange(patch.n_boundary, len(patch.x))
    x = patch.x.copy()
    least = np.inf
    for _ in range(_MAX_ITERATIONS):
        normal = np.zeros_like(x)
        normal[inner] = vertex_normals(x, patch.faces)[inner]
        gradient, hessian = _area_derivatives(x, patch.faces, normal)
        size = np.abs(gradient).max(initial=0.0)
        if _is_converged(size, least):
            return replace(patch, x=x)
        least = min(least, size)
        step = -_solve(hessian[inner][:, inner], gradient[inner])
        step = np.clip(step, -_MAX_NORMAL_STEP, _MAX_NORMAL_STEP)[:, None]
        x[inner] = np.cos(step) * x[inner] + np.sin(step) * normal[inner]
    raise MeshError(
        f"the minimal patch did not converge: the derivative of its area is still {size:.3g}."
    )


def laplacian(faces: Ints, cotangent: Floats, n: int) -> csc_array:
    """The positive Laplacian with weights (cot α + cot β)/2; (n, n) sparse."""
    tail, head = np.roll(faces, -1, 1).ravel(), np.roll(faces, 1, 1).ravel()
    W = coo_array((0.5 * cotangent.ravel(), (tail, head)), shape=(n, n)).tocsc()
    W = W + W.T
    return csc_array(diags_array(W.sum(axis=0)) - W)


def vertex_normals(x: Floats, faces: Ints) -> Floats:
    """Unit normals in S³, the sums of those of the faces weighted by volume; (n, 4)."""
    corners = x[faces]
    minors = np.stack([np.delete(corners, i, axis=2) for i in range(4)], axis=1)
    cross = np.linalg.det(minors) * np.array([-1.0, 1.0, -1.0, 1.0])
    total = np.zeros_like(x)
    np.add.at(total, faces.ravel(), np.repeat(cross, 3, axis=0))
    return total / np.linalg.norm(total, axis=1, keepdims=True)


def _solve(A: csc_array, b: Floats) -> Floats:
    """Solve a symmetric system, pivoting on the diagonal; Newton's iteration mends the loss."""
    options = {"SymmetricMode": True}
    factor = splu(csc_array(A), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options)
    return np.asarray(factor.solve(b))


def _dirichlet_energy(L: csc_array, x: Floats) -> float:
    return 0.5 * float(np.vdot(x, L @ x))


def _tangents(patch: Patch) -> csc_array:
    """Admissible displacements: none at corners, along the side, all tangential ones inside."""
    corners = csc_array((4 * patch.n_corners, 0))
    p, q = patch.ends[:, None, 0], patch.ends[:, None, 1]
    t = patch.angles[..., None]
    along = (np.cos(t) * q - np.sin(t) * p).reshape(-1, 4)
    inner = _tangent_bases(patch.x[patch.n_boundary :])
    blocks = [corners, _block_columns(along[:, :, None]), _block_columns(inner)]
    return csc_array(block_diag([b for b in blocks if b.shape[0]], format="csc"))


def _block_columns(blocks: Floats) -> csc_array:
    """The block diagonal matrix of (n, 4, c) dense blocks."""
    n, rows, columns = blocks.shape
    i, j, k = np.meshgrid(np.arange(n), np.arange(rows), np.arange(columns), indexing="ij")
    place = ((rows * i + j).ravel(), (columns * i + k).ravel())
    return coo_array((blocks.ravel(), place), shape=(rows * n, columns * n)).tocsc()


def _tangent_bases(x: Floats) -> Floats:
    """Orthonormal bases of x⊥, the last columns of Householder reflections; (n, 4, 3)."""
    v = x.copy()
    v[:, 0] += np.where(x[:, 0] < 0, -1.0, 1.0)
    v /= np.linalg.norm(v, axis=1, keepdims=True)
    return np.asarray(np.eye(4)[:, 1:] - 2 * v[:, :, None] * v[:, None, 1:])


def _kron4(A: csc_array) -> csc_array:
    """A ⊗ I₄, which acts on positions stored row by row."""
    A = A.tocoo()
    four = np.arange(4)
    place = ((4 * A.row[:, None] + four).ravel(), (4 * A.col[:, None] + four).ravel())
    return coo_array((np.repeat(A.data, 4), place), shape=(4 * A.shape[0],) * 2).tocsc()


def _line_search(patch: Patch, L: csc_array, step: Floats) -> Patch:
    """The step, halved while it increases the energy by more than rounding."""
    limit = _dirichlet_energy(L, patch.x) * (1 + 1e-13)
    for _ in range(30):
        moved = _retracted(patch, step)
        if _dirichlet_energy(L, moved.x) <= limit:
            break
        step = 0.5 * step
    return moved


def _is_converged(size: float, least: float) -> bool:
    """Whether a gradient is zero up to rounding: tiny, or small and no longer decreasing."""
    return size < 1e-14 or (size < 1e-10 and size >= least)


def _retracted(patch: Patch, step: Floats) -> Patch:
    angles = patch.angles + step[: patch.angles.size].reshape(patch.angles.shape)
    x = patch.x.copy()
    x[patch.n_corners : patch.n_boundary] = on_sides(patch.ends, angles)
    bases = _tangent_bases(x[patch.n_boundary :])
    inner = x[patch.n_boundary :]
    inner += np.einsum("idc,ic->id", bases, step[patch.angles.size :].reshape(-1, 3))
    inner /= np.linalg.norm(inner, axis=1, keepdims=True)
    return replace(patch, x=x, angles=angles)


def _area_derivatives(x: Floats, faces: Ints, normal: Floats) -> tuple[Floats, csc_array]:
    """First and second derivatives of the area by displacements along ``normal``, on S³.

    With u, v two sides of a triangle, its area is ½√G, G = ⟨u,u⟩⟨v,v⟩ − ⟨u,v⟩².
    """
    a, b, c = x[faces[:, 0]], x[faces[:, 1]], x[faces[:, 2]]
    u, v = b - a, c - a
    n = normal[faces]
    zero = np.zeros_like(u)
    du = np.stack([-n[:, 0], n[:, 1], zero], axis=1)
    dv = np.stack([-n[:, 0], zero, n[:, 2]], axis=1)
    E, F, H = _dot(u, u), _dot(u, v), _dot(v, v)
    E1 = 2 * np.einsum("fd,fkd->fk", u, du)
    H1 = 2 * np.einsum("fd,fkd->fk", v, dv)
    F1 = np.einsum("fkd,fd->fk", du, v) + np.einsum("fd,fkd->fk", u, dv)
    E2 = 2 * np.einsum("fkd,fld->fkl", du, du)
    H2 = 2 * np.einsum("fkd,fld->fkl", dv, dv)
    mixed = np.einsum("fkd,fld->fkl", du, dv)
    F2 = mixed + np.swapaxes(mixed, 1, 2)
    G = E * H - F * F
    G1 = E1 * H[:, None] + E[:, None] * H1 - 2 * F[:, None] * F1
    crossed = _outer(E1, H1)
    G2 = E2 * H[:, None, None] + E[:, None, None] * H2 + crossed + np.swapaxes(crossed, 1, 2)
    G2 -= 2 * _outer(F1, F1) + 2 * F[:, None, None] * F2
    root = np.sqrt(G)
    A1 = G1 / (4 * root[:, None])
    A2 = G2 / (4 * root[:, None, None]) - _outer(G1, G1) / (8 * (G * root)[:, None, None])
    gradient = np.zeros(len(x))
    np.add.at(gradient, faces, A1)
    rows, columns = np.repeat(faces, 3, axis=1), np.tile(faces, 3)
    hessian = coo_array((A2.ravel(), (rows.ravel(), columns.ravel())), shape=(len(x),) * 2)
    lengths = np.sqrt(np.stack([_dot(c - b, c - b), H, E], axis=1))
    Lx = laplacian(faces, cotangents(lengths), len(x)) @ x
    return gradient, csc_array(hessian.tocsc() - diags_array(_dot(x, Lx)))


def _dot(a: Floats, b: Floats) -> Floats:
    return np.einsum("id,id->i", a, b)


def _outer(a: Floats, b: Floats) -> Floats:
    return a[:, :, None] * b[:, None, :]
