r"""Period matrices in balls that provably contain the exact one, to any number of digits.

Any explicit closed forms on a surface have energies D ≥ D_exact, and D_exact is symplectic.  So
where D is known in balls, the period matrix is, whatever solver the forms came from
(:mod:`~igl_periods.enclosures.siegel_point`).

``enclose`` makes forms of power series, since on a flat surface harmonic functions *are* real parts
of power series: in w = (z/R)^κ, κ = 2π/θ, around a vertex of angle θ, in z inside a triangle.  They
converge geometrically, so that 100 digits take a degree of 200 and not a finer mesh.

=====================  ===========================================================================
``exact_lengths``      which surface is meant: lengths as functions of the precision
``triangulation``      triangles with lengths in balls; flips and new vertices carry cochains
``delaunay_moves``     which of these moves are made
``cells``              stars of vertices and what is left of faces; the segments between them
``interface_nodes``    Gauss nodes on these segments
``trial_functions``    Newton bases at Leja points of every cell
``least_squares``      the jumps between cells, factored once in double precision
``refinement``         residuals at any precision, updates in double precision
``degrees``            how many functions each cell needs
``series``             power series in balls, and their traces on segments
``quadrature``         Gauss quadrature with a proved error
``conforming_forms``   closed forms on the whole surface, and their energies in balls
``float_energies``     the same for a few digits, on arrays (``float_traces``)
``float_matrix``       the matrix in floating point, with derivatives
``upper_energies``     bounds of energies in other bases; what linear forms prove
``siegel_point``       from the energies to the period matrix
``limits``             seconds and bytes that it may take
``stages``             solutions with more and more functions
``computation``        the steps, one after the other
``enclosure``          the result
=====================  ===========================================================================
"""

from .surface_choice import with_exact_distances
from .exact_arithmetic import (
    ball_from_text,
    ball_in_text,
    from_integers,
    matrix_from_integers,
    matrix_to_integers,
    to_integers,
)
from .enclosure import PeriodEnclosure
from .exact_lengths import distances
from .computation import MOST_DIGITS, enclose

__all__ = [
    "MOST_DIGITS",
    "distances",
    "PeriodEnclosure",
    "enclose",
    "with_exact_distances",
    "matrix_to_integers",
    "matrix_from_integers",
    "ball_in_text",
    "ball_from_text",
    "to_integers",
    "from_integers",
]
