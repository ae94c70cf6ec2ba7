r"""Capacity matrices in balls, to as many digits as are asked for.

With Π = X + iY of the double in balls, the exact Dirichlet matrix is

.. math:: D = \begin{pmatrix} Y + X Y^{-1} X & -X Y^{-1} \\ -Y^{-1} X & Y^{-1} \end{pmatrix},

and the capacity matrix :math:`C = 2 B D B^T` as in :mod:`~igl_periods.domains.capacities`.

A mesh in space is taken as it is stored: its positions are exact, and lengths are square roots.
What is proved about a plane domain is about the polygons with the stored corners, if all points
that were added to their sides lie on them exactly: triangulate it with ``angle=0``, or check.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import flint

from igl_periods.arrays import Ints
from igl_periods.complexes import DeltaComplex, of_a_surface
from igl_periods.enclosures import PeriodEnclosure, distances, enclose
from igl_periods.errors import ComplexError
from igl_periods.symplectic import standard_form
from igl_periods.topology import pairing

from .boundary_classes import BoundaryLoop, boundary_loops, doubled_with_classes


@dataclass(frozen=True, eq=False, repr=False)
class CapacityEnclosure:
    """The capacity matrix of boundary loops in balls that provably contain the exact one.

    Attributes
    ----------
    period_enclosure : PeriodEnclosure
        Of the double.
    coefficients : (n, 2g) int
        The classes of the loops in its marking.
    loops : list of BoundaryLoop

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.planar_domain([0, 4, 4 + 4j, 4j], [[1 + 1j, 3 + 1j, 3 + 3j, 1 + 3j]])
    >>> C = ip.enclosed_capacities(V, F, digits=10)
    >>> C.matrix.nrows(), C.digits >= 10
    (2, True)
    """

    period_enclosure: PeriodEnclosure
    coefficients: Ints
    loops: list[BoundaryLoop]

    @cached_property
    def matrix(self) -> flint.arb_mat:
        """The capacity matrix; (n, n), every entry contains the exact one."""
        n = len(self.loops)
        if n == 1:
            return flint.arb_mat(1, 1)
        with flint.ctx.workprec(self.period_enclosure.bits):
            B = flint.arb_mat(self.coefficients.tolist())
            return 2 * (B * _dirichlet(self.period_enclosure.matrix) * B.transpose())

    @property
    def digits(self) -> int:
        """Proved decimal digits of the period matrix of the double."""
        return self.period_enclosure.digits

    def __repr__(self) -> str:
        text = f"CapacityEnclosure of {len(self.loops)} loops, {self.digits} digits proved"
        return f"{text}\n{self.matrix.str(max(self.digits, 1), radius=False)}"


@of_a_surface
def enclosed_capacities(
    K: DeltaComplex, *, digits: int = 30, max_seconds: float | None = None
) -> CapacityEnclosure:
    """The capacity matrix of the boundary loops of a surface in balls.

    Parameters
    ----------
    K : surface
        As for :func:`capacity_matrix`.
    digits, max_seconds
        As for :func:`~igl_periods.enclose`.

    Returns
    -------
    CapacityEnclosure

    Raises
    ------
    ComplexError
        If the surface has no boundary, is not connected, or orientations of faces disagree.

    Warns
    -----
    ToleranceWarning
        If fewer digits were proved than wanted.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.planar_domain([0, 4, 4 + 4j, 4j], [[1 + 1j, 3 + 1j, 3 + 3j, 1 + 3j]])
    >>> ip.enclosed_capacities(V, F, digits=10).digits >= 10
    True
    """
    loops = boundary_loops(K)
    if not loops:
        raise ComplexError("the surface has no boundary: capacities are those of boundary loops.")
    L, classes = doubled_with_classes(K, loops)
    if K.positions is not None and K.mollification == 0.0:
        L = replace(L, exact_lengths=distances(K.positions, _named_as(L, K)))
    e = enclose(L, digits=digits, max_seconds=max_seconds)
    B = pairing(L, classes, e.cocycles) @ -standard_form(e.genus)
    return CapacityEnclosure(e, B, loops)


def _named_as(L: DeltaComplex, K: DeltaComplex) -> DeltaComplex:
    """The double, its vertices labelled by the vertices of the surface that they lie over."""
    labels = L.labels.copy()
    labels[L.corner_vertex[: K.n_faces]] = K.corner_vertex
    labels[L.corner_vertex[K.n_faces :]] = K.corner_vertex[:, [0, 2, 1]]
    return replace(L, labels=labels)


def _dirichlet(Pi: flint.acb_mat) -> flint.arb_mat:
    """D of an exact period matrix, in balls."""
    X, Y = _part(Pi, "real"), _part(Pi, "imag")
    inverse = Y.inv()
    XY = X * inverse
    g = Pi.nrows()
    D = flint.arb_mat(2 * g, 2 * g)
    blocks = ((Y + XY * X, -XY), (-(inverse * X), inverse))
    for i in range(2 * g):
        for j in range(2 * g):
            D[i, j] = blocks[i // g][j // g][i % g, j % g]
    return D


def _part(Pi: flint.acb_mat, name: str) -> flint.arb_mat:
    entries = [getattr(z, name) for z in Pi.entries()]
    return flint.arb_mat(Pi.nrows(), Pi.ncols(), entries)
