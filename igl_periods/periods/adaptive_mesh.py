r"""Finer triangulations of the same surface, where the certificate asks for them.

A face gets a new vertex at its barycentre, which divides it into three.  The surface is flat
there, and no point of it moves: so a refined triangulation has the same period matrix, and a
closed cochain passes to it without a choice but for its values on the new edges: here the edge
from the new vertex to corner 0 gets the value 0, and closedness gives the others.

Delaunay flips are to follow.  On a region of equilateral triangles the two together are
√3-subdivision (Kobbelt 2000).

.. code-block:: text

            2
           /|\                  Child s has the corners of its parent, but for corner s, which is
          / | \                 the new vertex; so its side s is that of the parent.  Child 0 keeps
         /  |  \                the index of the parent.
        / 1 * 0 \
       / .     . \
      0-----------1
            2
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from scipy.sparse import csr_array

from igl_periods.arrays import Floats, ReadOnlyArrays
from igl_periods.complexes import (
    DeltaComplex,
    cotan_weights,
    insert_barycentres,
    intrinsic_delaunay,
    of_a_surface,
    split,
)
from igl_periods.display import facts_html, rounded_up
from igl_periods.harmonic import (
    dirichlet_matrix,
    energy_excess,
    geometric_allowance,
    harmonic_potentials,
)
from igl_periods.options import checked_integer, checked_number, checked_switch
from igl_periods.run_log import stage
from igl_periods.topology import cohomology_basis

from .marking import marked_faces
from .matrix import PeriodMatrix
from .rounding import LEAST_ALLOWANCE

# The faces that are refined hold this part of the excess of energy (Dörfler's marking).
_MARKED_PART = 0.5


@dataclass(frozen=True, eq=False)
class Refined(ReadOnlyArrays):
    """A refined triangulation and the period matrix it gives.

    Attributes
    ----------
    period_matrix : PeriodMatrix
        In the marking of the surface as it was given, which is its ``complex``.
    complex : DeltaComplex
        The refined intrinsic Delaunay triangulation.
    cochains : (2g, n_edges) sparse int
        The marking on it.
    steps : tuple of (int, float)
        Number of faces and bound, before and after every step.
    """

    period_matrix: PeriodMatrix
    complex: DeltaComplex
    cochains: csr_array
    steps: tuple[tuple[int, float], ...]

    def __repr__(self) -> str:
        (first, before), (last, after) = self.steps[0], self.steps[-1]
        return (
            f"Refined({first} to {last} faces, bound {rounded_up(before, 3)} to "
            f"{rounded_up(after, 3)})"
        )

    def _repr_html_(self) -> str:
        rows = [(f"{n} faces", f"bound {rounded_up(bound, 3)}") for n, bound in self.steps]
        return facts_html("Refined", rows)


@of_a_surface
def refined_period_matrix(
    K: DeltaComplex, bound: float, *, largest: int = 200_000, local: bool = True
) -> Refined:
    """Refine intrinsically until the period matrix has a wanted bound.

    Parameters
    ----------
    K : surface
        As for :func:`~igl_periods.period_matrix`: closed, oriented, connected.
    bound : float
        The wanted bound, > 0.
    largest : int
        No triangulation with more faces is made; where the bound is not reached by then, or all
        faces that hold it are too thin to be divided, the last result is returned.
    local : bool
        Refine where the bound comes from (:mod:`igl_periods.harmonic.excess`), or divide every face
        into four each time.

    Raises
    ------
    ValueError
        If ``bound`` is not positive, ``largest`` no integer or ``local`` neither True nor False.
    ComplexError
        If the surface is not closed, oriented and connected.

    Examples
    --------
    >>> import igl_periods as ip
    >>> K = ip.surfaces.square_tiled_surface("omega_1", n=2)
    >>> refined = ip.refined_period_matrix(K, 0.05)
    >>> refined.period_matrix.bound <= 0.05
    True
    """
    bound = checked_number("the wanted bound", bound)
    if not bound > 0:
        raise ValueError(f"the wanted bound must be positive, not {bound}.")
    largest, local = checked_integer("largest", largest), checked_switch("local", local)
    cocycles = cohomology_basis(K)
    L, cochains = intrinsic_delaunay(K, cocycles)
    steps: list[tuple[int, float]] = []
    while True:
        potentials = harmonic_potentials(L, cotan_weights(L), cochains)
        pm = _period_matrix(K, cocycles, L, cochains, potentials)
        steps.append((L.n_faces, float(pm.bound or 0.0)))
        room = largest - L.n_faces
        if steps[-1][1] <= bound or room < (2 if local else 3 * L.n_faces):
            return Refined(pm, L, cochains, tuple(steps))
        with stage(f"refining {L.n_faces} faces"):
            if local:
                excess = energy_excess(L, cochains, potentials, pm.dirichlet).sum(axis=0)
                marked = marked_faces(L, excess, _MARKED_PART)[: room // 2]
                if marked.size == 0:
                    return Refined(pm, L, cochains, tuple(steps))
                finer = insert_barycentres(L, cochains, marked)
            else:
                finer = split(L, cochains)
            L, cochains = intrinsic_delaunay(*finer)


def _period_matrix(
    K: DeltaComplex,
    cocycles: csr_array,
    L: DeltaComplex,
    cochains: csr_array,
    potentials: Floats,
) -> PeriodMatrix:
    """The period matrix of K, by forms on its refinement L."""
    D = dirichlet_matrix(L, cochains, potentials)
    rounding = geometric_allowance(L, D, partial(dirichlet_matrix, L, cochains, potentials))
    return PeriodMatrix(D, True, cocycles, K, max(LEAST_ALLOWANCE, rounding))
