r"""Holomorphic differentials on the mesh, and the maps they make.

On the triangulation as given, in the marking of a period matrix Π, with the harmonic forms α, β,

.. math:: \zeta_k = \alpha_k + \sum_l \Pi_{kl}\, \beta_l, \qquad
          \oint_{a_l} \zeta_k = \delta_{kl}, \quad \oint_{b_l} \zeta_k = \Pi_{kl} .

z = ∫ζ maps the surface, cut to a disk, to the plane: conformally up to the error of discretisation,
with 2g − 2 zeros, and with translations by periods across the cut.

===========================  ==================================================================
``normalised``               ζ_1..ζ_g along all edges
``jacobian``                 the Abel–Jacobi map, of points and divisors
``prescribed_periods``       the form with given periods
``even_form``                the form of most even length
``zeros_of_forms``           the zeros of a form, its stratum
``parametrization``          the map z = ∫ζ, its seams, zeros and distortion
===========================  ==================================================================

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
Farkas, Kra, "Riemann surfaces" (1992), section III.6.
Gu, Yau, "Global conformal surface parameterization" (2003).
"""

from .normalised import normalised_differentials
from .jacobian import AbelJacobi, abel_jacobi, divisor_class
from .even_form import evenness, most_even_form
from .parametrization import Parametrization, parametrize
from .prescribed_periods import form_of_periods, form_of_real_periods
from .zeros_of_forms import FormZeros, form_zeros

__all__ = [
    "normalised_differentials",
    "AbelJacobi",
    "abel_jacobi",
    "divisor_class",
    "FormZeros",
    "form_zeros",
    "form_of_periods",
    "form_of_real_periods",
    "evenness",
    "most_even_form",
    "Parametrization",
    "parametrize",
]
