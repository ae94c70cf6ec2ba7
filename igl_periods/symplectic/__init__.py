r"""What energies D and period matrices Π have in common: J, integer bases, the Williamson form.

:math:`J = \begin{pmatrix} 0 & 1 \\ -1 & 0 \end{pmatrix}` in g × g blocks, α first, then β.  A
matrix is symplectic if :math:`T^T J T = J`.  Symmetric positive definite symplectic matrices and
points of the Siegel upper half-space Π = X + iY are the same thing,

.. math::

    G = \begin{pmatrix} Y + X Y^{-1} X & -X Y^{-1} \\ -Y^{-1} X & Y^{-1} \end{pmatrix} .

Any other symmetric positive definite matrix has the Williamson form :math:`D = T^T
\operatorname{diag}(d, d)\, T`, T symplectic; the *symplectic eigenvalues* d say how far it is from
being symplectic, and its *symplectic mean* :math:`G = T^T T` is the geometric mean of D and
:math:`J D^{-1} J^T`.

Sp(2g, Z) acts on Π by γ = [[a, b], [c, d]], Π ↦ (aΠ + b)(cΠ + d)⁻¹, and on bases of forms by
U = KγK, K = diag(1, −1), D ↦ U D Uᵀ.

========================  =====================================================================
``integer_matrices``      integer products and inverses that cannot overflow
``canonical_basis``       canonical bases of an integer skew form, Sp(2g, Z)
``estimate_derivatives``  … and how they change with D
``williamson_form``       D, Π, symplectic eigenvalues and the symplectic mean
========================  =====================================================================

References
----------
de Gosson, "Symplectic geometry and quantum mechanics" (2006), section 8.3.
Bhatia, Jain, "On symplectic eigenvalues of positive definite matrices" (2015).
"""

from .integer_matrices import int_array, product, unimodular_inverse
from .canonical_basis import form_action, integer_symplectic_basis, is_symplectic, standard_form
from .williamson_form import (
    cholesky_factor,
    energy_matrix,
    siegel_point,
    williamson,
    williamson_basis,
    williamson_of_factor,
)

from .estimate_derivatives import EstimateDerivative, estimate_derivative

__all__ = [
    "int_array",
    "product",
    "unimodular_inverse",
    "form_action",
    "integer_symplectic_basis",
    "is_symplectic",
    "standard_form",
    "cholesky_factor",
    "energy_matrix",
    "siegel_point",
    "williamson",
    "williamson_basis",
    "williamson_of_factor",
    "EstimateDerivative",
    "estimate_derivative",
]
