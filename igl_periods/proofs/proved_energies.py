r"""Energies of closed forms in balls, and the period matrices that can be proved from them.

A computation in floating point knows the energies of the harmonic forms in classes c, but these may
be far from orthogonal, and then a small error of the energies is a large one of the period matrix.
So the proof is about other forms: with D = R Rᵀ the energies as computed, those in the classes

.. math:: W c, \qquad W \approx R^{-1},

are orthonormal up to rounding, W any matrix of floating-point numbers, *exact as it is stored*; and
any functions may be added.  Where E are their energies in balls and U is the integer matrix of a
canonical basis U c, the energies in the canonical basis are

.. math:: (U W^{-1})\, E\, (U W^{-1})^T,

computed with as many digits as it takes.  U alone depends on the marking: a change of basis
multiplies integers, and loses nothing, however extreme the new marking is.

The entries of W are rounded to so few bits that sums of integer multiples of them are exact.  So
the values of W c on edges are floating-point numbers, again exactly.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import flint
import numpy as np
from flint import arb_mat
from numpy.typing import NDArray
from scipy.linalg import solve_triangular
from scipy.sparse import csr_array

from igl_periods.arrays import Complexes, Floats, Ints
from igl_periods.errors import ComplexError
from igl_periods.harmonic import Jumps, energy_factor
from igl_periods.symplectic import product

from .midpoint_radius import Balls
from .siegel_radius import BITS, energy_balls, relative_radius


@dataclass(frozen=True, eq=False)
class ProvedEnergies:
    """Energies of closed forms, and a canonical basis in terms of them.

    Attributes
    ----------
    mid, rad : (k, k) float
        The energies are these, up to those: E.
    combination : (k, k) float
        The classes of the forms in terms of some integer cochains: W, exactly.
    basis : (k, k) int
        A canonical basis in terms of the same cochains: U.
    """

    mid: Floats
    rad: Floats
    combination: Floats
    basis: Ints

    def in_basis(self, U: NDArray[np.integer]) -> ProvedEnergies:
        """The same energies with another canonical basis, U times this one.

        Raises
        ------
        OverflowError
            If its coefficients do not fit into 64 bits.
        """
        return replace(self, basis=product(np.asarray(U, dtype=np.int64), self.basis))

    def dirichlet(self) -> Floats:
        """Midpoints of the energies in the canonical basis; (k, k), symmetric."""
        with flint.ctx.workprec(BITS):
            D = self._coordinates * energy_balls(self._energies) * self._coordinates.transpose()
            values = np.array([float(x) for x in D.entries()]).reshape(self.basis.shape)
        return np.asarray(0.5 * (values + values.T), dtype=np.float64)

    def relative_radius(self, Pi: Complexes) -> float:
        """An upper bound of ‖Y^{-1/2} (Π_exact − Π) Y^{-1/2}‖₂, ∞ where nothing is proved."""
        X, Y = np.asarray(Pi.real, np.float64), np.asarray(Pi.imag, np.float64)
        radius = relative_radius(energy_balls(self._energies), X, Y, self._coordinates)
        return float(np.nextafter(float(radius), np.inf)) if radius > 0 else 0.0

    @property
    def spread(self) -> float:
        """The sum of the radii of a row at most: what the radii contribute to a bound, about."""
        return float(self.rad.sum(axis=1).max(initial=0.0))

    @property
    def _energies(self) -> Balls:
        return Balls(self.mid, self.rad)

    @cached_property
    def _coordinates(self) -> arb_mat:
        """The canonical basis in terms of the forms, U W⁻¹."""
        with flint.ctx.workprec(BITS):
            try:
                inverse = arb_mat(self.combination.tolist()).inv()
            except ZeroDivisionError as error:
                raise ComplexError(
                    "nothing can be proved about the period matrix: the energies of the forms are "
                    "singular in double precision. The triangles are too extreme; remesh them."
                ) from error
            return arb_mat([[int(x) for x in row] for row in self.basis.tolist()]) * inverse

    def __getstate__(self) -> dict[str, Any]:
        return {name: getattr(self, name) for name in ("mid", "rad", "combination", "basis")}


def orthonormal_combination(D: Floats, cochains: csr_array) -> Floats:
    """The matrix W for forms of energies D in the classes of integer cochains (k, n_edges).

    Raises
    ------
    ComplexError
        If D is not positive definite.
    """
    k = len(D)
    W = solve_triangular(energy_factor(D), np.eye(k), lower=True)
    largest = int(np.abs(cochains.data).max(initial=1))
    return rounded_rows(W, max(k, 1) * largest)


def rounded_rows(W: Floats, multiples: int) -> Floats:
    """Each row rounded, so that sums of its entries with integer factors are exact.

    Parameters
    ----------
    W : (k, l) float
    multiples : int
        The sum of the absolute values of the factors is at most this.
    """
    bits = 52 - int(np.ceil(np.log2(2 * multiples)))
    largest = np.abs(W).max(axis=1, initial=0.0, keepdims=True)
    unit = np.ldexp(1.0, np.ceil(np.log2(np.where(largest > 0.0, largest, 1.0))).astype(int) - bits)
    return np.asarray(unit * np.rint(W / unit))


@dataclass(frozen=True, eq=False)
class CombinedJumps:
    """The values of W c along sides, for the jumps of integer cochains c.

    Attributes
    ----------
    jumps : Jumps
    combination : (k, k) float
        The matrix W; sums of integer multiples of entries of one row are exact.
    """

    jumps: Jumps
    combination: Floats

    def add_to(self, differences: Floats, start: int, side: int, sign: int) -> None:
        """Add ``sign`` times the values along a side of the faces from ``start`` on, (faces, k)."""
        jumps = self.jumps
        low, high = np.searchsorted(jumps.face, [start, start + len(differences)])
        mine = low + np.flatnonzero(jumps.side[low:high] == side)
        if mine.size == 0:
            return
        faces, row = np.unique(jumps.face[mine], return_inverse=True)
        values = np.zeros((faces.size, self.combination.shape[1]))
        values[row, jumps.cochain[mine]] = sign * jumps.value[mine]
        differences[faces - start] += values @ self.combination.T
