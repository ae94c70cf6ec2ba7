r"""The jumps across the interfaces, made small by least squares, factored once in double precision.

At the nodes of an interface, weighted by the roots of the Gauss weights, three numbers should
vanish: [u] − J, the jump of the value minus that of the cochain, and with G = dF/ds on each side
the real and the imaginary part of the sum of the two G, the jumps of both derivatives (the sides
run in opposite directions).

Gram matrices of single cells are factored first, A_cᵀ A_c = R_cᵀ R_c.  In the coordinates R_c a_c
the normal equations have identities on the diagonal, the coupling of neighbours beside it, and a
condition number of a few tens, so that the Cholesky factor in double precision reduces a residual
by 13 to 14 digits however many digits the residual itself is known to.

Nothing here is rigorous, and nothing needs to be: any coefficients give closed forms.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.linalg
from scipy import sparse
from scipy.sparse import csc_matrix

from igl_periods.arrays import Complexes, Floats
from igl_periods.errors import NotPositiveDefiniteError
from igl_periods.harmonic import CholeskyFactor, factor, solve

from .limits import check_time
from .trial_functions import TrialFunctions


@dataclass(frozen=True, eq=False)
class LeastSquares:
    """A factored least-squares problem.

    Attributes
    ----------
    trial : TrialFunctions
    inverses : list of float
        R_c⁻¹ of each cell.
    normal : CholeskyFactor
        Of the normal equations in the coordinates R_c a_c.
    """

    trial: TrialFunctions
    inverses: list[Floats]
    normal: CholeskyFactor

    @property
    def n_unknowns(self) -> int:
        """Number of real unknowns."""
        return int((2 * self.trial.size - 1).sum())

    def solve(self, values: Floats, slopes: Complexes) -> list[Complexes]:
        """Coefficients for which the jumps are closest to given ones.

        Parameters
        ----------
        values : (rows, k) float
            Wanted [u] at the nodes, in the rows of first sides and, negative, of second sides.
        slopes : (rows, k) complex
            Wanted G_first + G_second, in the rows of both sides.

        Returns
        -------
        list of (K, k) complex
            For each cell; the first coefficient is real.
        """
        trial, start = self.trial, self.trial.nodes.start
        weight = trial.nodes.weight[:, None]
        values, slopes = weight * values, weight * slopes
        parts = []
        for cell, inverse in enumerate(self.inverses):
            rows = slice(start[cell], start[cell + 1])
            gradient = trial.values[cell].conj().T @ values[rows]
            gradient += trial.slopes[cell].conj().T @ slopes[rows]
            parts.append(inverse.T @ _real(gradient))
        solution = solve(self.normal, np.concatenate(parts))
        ends = np.cumsum(2 * trial.size - 1)
        return [
            _complex(inverse @ part)
            for inverse, part in zip(self.inverses, np.split(solution, ends[:-1]))
        ]


def least_squares(trial: TrialFunctions) -> LeastSquares:
    """Set up and factor the least-squares problem of the jumps."""
    weighted = _Weighted(trial)
    inverses = [_inverse_root(gram) for gram in _gram_matrices(weighted)]
    return LeastSquares(trial, inverses, _factor(_normal_equations(weighted, inverses)))


def _factor(normal: csc_matrix) -> CholeskyFactor:
    """The factor of the normal equations, or of slightly larger ones where rounding spoils them."""
    shift = 0.0
    while True:
        try:
            return factor(normal)
        except NotPositiveDefiniteError:
            larger = max(100.0 * shift, 1e-14)
            normal = csc_matrix(normal + (larger - shift) * sparse.eye(normal.shape[0]))
            shift = larger


class _Weighted:
    """Values and slopes of the trial functions on the sides, times the roots of the weights."""

    def __init__(self, trial: TrialFunctions) -> None:
        self.trial, self.nodes = trial, trial.nodes
        self.root = np.sqrt(trial.nodes.weight)

    def cell(self, cell: int) -> tuple[Complexes, Complexes]:
        root = self.root[self.nodes.start[cell] : self.nodes.start[cell + 1], None]
        return root * self.trial.values[cell], root * self.trial.slopes[cell]

    def side(self, i: int, side: int) -> tuple[Complexes, Complexes]:
        cell = self.nodes.cells.cell[i, side]
        rows = self.nodes.rows(i, side)
        root = self.root[rows, None]
        rows = slice(rows.start - self.nodes.start[cell], rows.stop - self.nodes.start[cell])
        return root * self.trial.values[cell][rows], root * self.trial.slopes[cell][rows]

    def coupling(self, i: int) -> Floats:
        """Products of the functions on the two sides of an interface."""
        (values, slopes), (others, other_slopes) = self.side(i, 0), self.side(i, 1)
        return _products(-values, slopes, others, other_slopes)


def _products(
    values: Complexes, slopes: Complexes, others: Complexes, other_slopes: Complexes
) -> Floats:
    """AᵀB of the real columns Re a_0, Re a_k, …, Im a_k, … of two sets of functions."""
    product = np.empty((2 * values.shape[1] - 1, 2 * others.shape[1] - 1))
    K, L = values.shape[1], others.shape[1]
    # As real numbers: Re u·Re v and the other three, from one product of matrices each.
    here = np.concatenate([values.real, values.imag], axis=1)
    there = np.concatenate([others.real, others.imag], axis=1)
    P, C = here.T @ there, slopes.conj().T @ other_slopes
    product[:K, :L] = P[:K, :L] + C.real
    product[:K, L:] = -P[:K, L + 1 :] - C.imag[:, 1:]
    product[K:, :L] = -P[K + 1 :, :L] + C.imag[1:]
    product[K:, L:] = P[K + 1 :, L + 1 :] + C.real[1:, 1:]
    return product


def _real(a: Complexes) -> Floats:
    return np.concatenate([a.real, a.imag[1:]])


def _complex(x: Floats) -> Complexes:
    K = (len(x) + 1) // 2
    a = x[:K].astype(np.complex128)
    a[1:] += 1j * x[K:]
    return a


def _gram_matrices(weighted: _Weighted) -> Iterator[Floats]:
    """The products of the functions of each cell with each other."""
    cells = weighted.nodes.cells
    alone: dict[int, list[int]] = {}
    for alike in np.flatnonzero(cells.cell[:, 0] == cells.cell[:, 1]).tolist():
        alone.setdefault(int(cells.cell[alike, 0]), []).append(alike)
    for cell in range(cells.n_cells):
        check_time()
        values, slopes = weighted.cell(cell)
        gram = _products(values, slopes, values, slopes)
        for i in alone.get(cell, []):
            coupling = weighted.coupling(i)
            gram += coupling + coupling.T
        if cell == 0:
            # A constant on the whole surface jumps nowhere: one more equation says that it is 0.
            gram[0, 0] += 1.0
        yield gram


def _inverse_root(gram: Floats) -> Floats:
    """R⁻¹ with RᵀR = gram, of a matrix that may be singular to rounding."""
    size = np.sqrt(np.diag(gram))
    scaled, shift = gram / np.outer(size, size), 0.0
    while True:
        try:
            root = scipy.linalg.cholesky(scaled + shift * np.eye(len(gram)), check_finite=False)
            break
        except scipy.linalg.LinAlgError:
            shift = max(10.0 * shift, 1e-15)
    inverse, _ = scipy.linalg.lapack.dtrtri(root)
    return np.asarray(inverse / size[:, None], dtype=np.float64)


def _normal_equations(weighted: _Weighted, inverses: list[Floats]) -> csc_matrix:
    """The lower triangle of the normal equations in the coordinates R_c a_c."""
    cells, size = weighted.nodes.cells, 2 * weighted.trial.size - 1
    first = np.cumsum(size) - size
    below: list[dict[int, Floats]] = [{} for _ in inverses]
    for i, (a, b) in enumerate(cells.cell.tolist()):
        check_time()
        if a == b:
            continue
        block = inverses[a].T @ weighted.coupling(i) @ inverses[b]
        row, column = (b, a) if a < b else (a, b)
        block = block.T if a < b else block
        blocks = below[column]
        blocks[row] = blocks[row] + block if row in blocks else block
    data, indices, counts = [], [], []
    for column, blocks in enumerate(below):
        n, rows = int(size[column]), sorted(blocks)
        column_blocks = np.concatenate([np.eye(n), *(blocks[row] for row in rows)])
        where = [np.arange(first[r], first[r] + size[r]) for r in (column, *rows)]
        data.append(column_blocks.ravel(order="F"))
        indices.append(np.tile(np.concatenate(where), n))
        counts.append(np.full(n, len(column_blocks)))
        blocks.clear()
    indptr = np.concatenate([[0], np.cumsum(np.concatenate(counts))])
    total = int(size.sum())
    return csc_matrix((np.concatenate(data), np.concatenate(indices), indptr), shape=(total, total))
