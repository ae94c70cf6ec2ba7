r"""The normalised holomorphic differentials on the triangulation of the mesh.

Let α_1..α_g, β_1..β_g be the harmonic forms, linear on the triangles as given, in the classes of
the marking of a period matrix Π.  The normalised holomorphic differentials

.. math:: \zeta_k = \alpha_k + \sum_l \Pi_{kl}\, \beta_l

have :math:`\oint_{a_l} \zeta_k = \delta_{kl}` and :math:`\oint_{b_l} \zeta_k = \Pi_{kl}` exactly,
for the Π that was computed, by whatever method.  Their real and imaginary parts are harmonic in
the discrete sense, and ζ_k is holomorphic up to the error of discretisation, which shows in how
far the map z = ∫ζ is from being conformal on each triangle.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
"""

from __future__ import annotations

from igl_periods.arrays import Complexes, Floats
from igl_periods.harmonic import harmonic_forms
from igl_periods.periods import PeriodMatrix
from igl_periods.run_log import stage


def normalised_differentials(pm: PeriodMatrix) -> Complexes:
    """The differentials ζ_1..ζ_g with periods δ and Π, along all edges; (g, n_edges) complex.

    Parameters
    ----------
    pm : PeriodMatrix
        Its ``complex`` and ``cocycles`` say on which triangulation and in which marking.

    Raises
    ------
    ComplexError
        If the triangles are so thin that their Laplacian is singular to rounding.
    """
    forms = harmonic_forms_on_edges(pm)
    zeta: Complexes = forms[: pm.genus] + pm.matrix @ forms[pm.genus :]
    return zeta


def harmonic_forms_on_edges(pm: PeriodMatrix) -> Floats:
    """α_1..α_g, β_1..β_g on the triangulation as given; (2g, n_edges)."""
    with stage("harmonic forms on the mesh"):
        return harmonic_forms(pm.complex, pm.cocycles)
