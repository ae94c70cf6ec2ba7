r"""Tori: flat ones with any modulus, and tori of revolution.

The torus C/(Z + Zτ) with its grid of parallelograms is flat everywhere, the holomorphic form dz is
linear on every triangle, and the period matrix is (τ) to rounding, on any grid.

The torus of revolution with radii R > r > 0 has the metric (R + r cos v)² du² + r² dv².  With
dw = r dv / (R + r cos v) it is conformal to du² + dw², and w grows by 2π r / √(R² − r²) along a
meridian.  So τ = i r / √(R² − r²) in the marking (parallel, meridian), and an inscribed mesh
converges to it with order 2.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import partial

import numpy as np

from igl_periods.arrays import Floats, Ints
from igl_periods.complexes import DeltaComplex, by_kind, lattice_length, periodic_grid, squares
from igl_periods.errors import ComplexError, MeshError


def flat_torus(tau: complex, n: int = 4, m: int | None = None) -> DeltaComplex:
    """Glue the flat torus C / (Z + Zτ) from n × m parallelograms cut along shorter diagonals.

    Parameters
    ----------
    tau : complex
        The modulus, Im τ > 0.  It is the period matrix, up to SL(2, Z).
    n, m : int
        Numbers of parallelograms along 1 and along τ; ``m = n`` if it is not given.

    Raises
    ------
    ComplexError
        If τ is not in the upper half-plane, or ``n < 1`` or ``m < 1``.

    Examples
    --------
    >>> flat_torus(0.3 + 0.8j, 2, 3).n_vertices
    6
    """
    modulus, rows = complex(tau), n if m is None else m
    if not (np.isfinite(modulus) and modulus.imag > 0):
        raise ComplexError(f"tau = {tau} is not in the upper half-plane: Im tau > 0 is needed.")
    if min(n, rows) < 1:
        raise ComplexError(f"a grid of {n} x {rows} parallelograms: both numbers must be >= 1.")
    cell = np.arange(n * rows).reshape(n, rows)
    right, up = np.roll(cell, -1, 0).ravel(), np.roll(cell, -1, 1).ravel()
    e, f = complex(1 / n), modulus / rows
    # The same as p + q τ, exactly.
    a, b = (Fraction(1, n), Fraction(0)), (Fraction(0), Fraction(1, rows))
    if abs(e + f) > abs(e - f):
        a, b = b, (-a[0], Fraction(0))
        # Turned by a quarter, the cells have sides f and -e, and the diagonal f - e.
        right, up, e, f = up, np.roll(cell, 1, 0).ravel(), f, -e
    k = cell.ravel().tolist()
    pairs = [((a, 1), (b, 3)) for a, b in zip(k, right.tolist(), strict=True)]
    pairs += [((a, 2), (b, 0)) for a, b in zip(k, up.tolist(), strict=True)]
    _, twin = squares(pairs, 1)
    lengths = np.empty(twin.shape)
    lengths[0::2] = abs(f), abs(e + f), abs(e)
    lengths[1::2] = abs(e), abs(f), abs(e + f)
    K = DeltaComplex.from_gluing(lengths, twin)
    kind = np.empty(twin.shape, dtype=np.int64)
    kind[0::2], kind[1::2] = (1, 2, 0), (0, 1, 2)
    formulas = [
        partial(lattice_length, modulus, p, q) for p, q in (a, b, (a[0] + b[0], a[1] + b[1]))
    ]
    return replace(K, exact_lengths=by_kind(K.edge, kind, formulas))


def torus_of_revolution(R: float, r: float, n: int = 32, m: int = 16) -> tuple[Floats, Ints]:
    """Triangulate the torus of revolution, normals outward.

    Parameters
    ----------
    R, r : float
        Distance of the tube from the axis, and its radius; R > r > 0.
    n, m : int
        Numbers of vertices along a parallel and along a meridian, at equal angles; both ≥ 3.

    Returns
    -------
    V : (n m, 3) float
    F : (2 n m, 3) int

    Raises
    ------
    MeshError
        Unless R > r > 0, n ≥ 3 and m ≥ 3.
    """
    _check_radii(R, r)
    if min(n, m) < 3:
        raise MeshError(
            f"a torus mesh of {n} x {m} vertices is not simplicial; take at least 3 x 3."
        )
    u, v = np.meshgrid(2 * np.pi * np.arange(n) / n, 2 * np.pi * np.arange(m) / m, indexing="ij")
    distance = R + r * np.cos(v)
    V = np.stack([distance * np.cos(u), distance * np.sin(u), r * np.sin(v)], axis=-1)
    return V.reshape(-1, 3), periodic_grid(n, m)


def torus_of_revolution_modulus(R: float, r: float) -> complex:
    """Return τ = i r / √(R² − r²), the modulus of the smooth torus of revolution.

    Raises
    ------
    MeshError
        Unless R > r > 0.
    """
    _check_radii(R, r)
    return 1j * r / np.sqrt((R - r) * (R + r))


def _check_radii(R: float, r: float) -> None:
    if not 0 < r < R < np.inf:
        raise MeshError(f"radii R = {R}, r = {r}: a torus of revolution needs R > r > 0.")
