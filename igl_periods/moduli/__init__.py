r"""When two period matrices belong to the same Riemann surface; symmetries and invariants.

By Torelli's theorem two surfaces are isomorphic iff γ·Π₁ = Π₂ for some γ in Sp(2g, Z), that is, in
terms of energies, :math:`U G_1 U^T = G_2` and :math:`U J U^T = J` for an integer U.  The rows of U
are short vectors, of which there are finitely many: they are enumerated, and put together by
backtracking.  If Π₁ and Π₂ are known to within d₁ and d₂, then with c = d₁ d₂ an isomorphism obeys

.. math:: \tfrac1c\, G_2 \le U G_1 U^T \le c\, G_2,

so that a finished search that finds nothing is a proof that the surfaces differ.  γ with Π₁ = Π₂
are the automorphisms, a finite group that contains −1.

Invariants need no search: Klein's j for genus 1, Rosenhain's roots and the invariants of Igusa and
Clebsch for genus 2, vanishing theta constants for genus 3.

=========================  ====================================================================
``lattice_isometries``     integer isometries of quadratic forms, to within a tolerance
``isometries_in_balls``    the same where the forms are known in balls, without a tolerance
``balls_in_comparison``    what is compared there
``equivalence``            γ with γ·Π₁ = Π₂
``marking_search``         γ with γ·Π₁ near Π₂
``automorphisms``          the group of γ with γ·Π = Π
``finite_groups``          multiplication tables, and whether two groups are isomorphic
``group_names``            names of small groups
``theta``                  theta constants, and hyperellipticity
``genus_one``              Klein's j
``genus_two``              roots and invariants of the curve of genus 2
``invariant_derivatives``  how these move with Π
``hyperelliptic_points``   those of genus 3 near a given Π
``quadratic_numbers``      entries that look like quadratic irrationals
=========================  ====================================================================

References
----------
Plesken, Souvignier, "Computing isometries of lattices" (1997).
Mumford, "Tata lectures on theta II" (1984).
"""

from .equivalence import (
    ARRAY_TOLERANCE,
    Isomorphisms,
    LARGEST_TOLERANCE,
    logarithms_found,
    moduli_distance,
    symplectic_isomorphisms,
)
from .balls_in_comparison import ReducedBalls, reduced_balls
from .isometries_in_balls import ball_isometries
from .marking_search import NearestMarking, nearest_marking
from .finite_groups import FiniteGroup, are_isomorphic, direct_product, group_of_matrices
from .group_names import group_name
from .automorphisms import SymplecticGroup, symplectic_automorphism_group
from .theta import is_hyperelliptic, theta_constants, vanishing_even_characteristics
from .genus_two import absolute_igusa_invariants, igusa_clebsch_invariants, rosenhain_roots
from .genus_one import certified_j_invariant, j_invariant
from .invariant_derivatives import (
    igusa_derivatives,
    j_derivative,
    rosenhain_derivatives,
    theta_derivatives,
)
from .hyperelliptic_points import hyperelliptic_point
from .quadratic_numbers import QuadraticGuess, recognise_entries, recognise_quadratic
from .lattice_isometries import isometries

__all__ = [
    "ReducedBalls",
    "reduced_balls",
    "ball_isometries",
    "ARRAY_TOLERANCE",
    "Isomorphisms",
    "LARGEST_TOLERANCE",
    "logarithms_found",
    "moduli_distance",
    "symplectic_isomorphisms",
    "nearest_marking",
    "NearestMarking",
    "FiniteGroup",
    "are_isomorphic",
    "direct_product",
    "group_of_matrices",
    "group_name",
    "symplectic_automorphism_group",
    "SymplecticGroup",
    "vanishing_even_characteristics",
    "igusa_clebsch_invariants",
    "rosenhain_roots",
    "theta_constants",
    "is_hyperelliptic",
    "j_invariant",
    "certified_j_invariant",
    "absolute_igusa_invariants",
    "hyperelliptic_point",
    "theta_derivatives",
    "j_derivative",
    "rosenhain_derivatives",
    "igusa_derivatives",
    "recognise_quadratic",
    "recognise_entries",
    "QuadraticGuess",
    "isometries",
]
