r"""A complex with the cochains that it carries: the marking goes where the surface goes.

Every geometric step is a map (K, c) → (K′, c′): Delaunay flips, midpoints, barycentres.  It changes
the triangulation and carries closed cochains c along; the classes stay the same, and so does the
integer matrix T for which T c is a canonical basis of cohomology.  So T is chosen once, on the
surface as it is given.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array

from igl_periods.arrays import ReadOnlyArrays
from igl_periods.display import arrays_repr

from .delta_complex import DeltaComplex

Move = Callable[[DeltaComplex, csr_array], tuple[DeltaComplex, csr_array]]


@dataclass(frozen=True, eq=False)
class MarkedComplex(ReadOnlyArrays):
    """A triangulation with closed cochains, and what makes a canonical basis of them.

    Attributes
    ----------
    complex : DeltaComplex
    cochains : (2g, n_edges) sparse int
        Closed: a basis of integer cohomology, sparse.
    basis : (2g, 2g) int
        The matrix T for which T cochains is a canonical basis.
    """

    complex: DeltaComplex
    cochains: csr_array
    basis: NDArray[np.signedinteger]

    __repr__ = arrays_repr

    @property
    def rank(self) -> int:
        """The rank 2g of the first cohomology."""
        return len(self.basis)

    def after(self, move: Move) -> MarkedComplex:
        """The surface and its marking after a move, such as ``intrinsic_delaunay``."""
        return MarkedComplex(*move(self.complex, self.cochains), self.basis)

    def cocycles(self) -> csr_array:
        """The canonical basis T c; (2g, n_edges) sparse int."""
        return csr_array(csr_array(self.basis.astype(np.int64)) @ self.cochains)
