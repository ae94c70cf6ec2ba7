"""Period matrices of triangle meshes and polyhedral surfaces, with certified error bounds.

``V, F`` in, a point of the Siegel upper half-space out, with a proof of how far it can be off.

>>> import igl_periods as ip
>>> K = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=4)
>>> ip.period_matrix(K).genus
1

The folders are the chapters of the mathematics, each with its conventions and formulas on the first
page.  In reading order:

=================  ============================================================================
``meshes``         a file → V, F
``complexes``      V, F → K, and the moves (K, c) → (K′, c′)
``topology``       K → integer cochains, cycles
``flat_surfaces``  a flat surface → stratum, holonomy, area, dz and its periods
``harmonic``       K, cochains → D, by linear functions
``elements``       K, cochains → D, by functions of high degree, conical at cone points
``proofs``         the same energies in midpoint–radius arithmetic
``periods``        D → Π and its bound
``enclosures``     Π in balls, to as many digits as are asked for
``symplectic``     J, integer bases, the Williamson form: what D and Π have in common
``recognition``    numbers in balls → algebraic numbers, with the evidence
``siegel``         Π → γ·Π reduced
``moduli``         Π₁, Π₂ → equivalence, symmetries, invariants
``riemann_theta``  θ(z, Π) with characteristics, spin structures
``forms``          the discrete theory of the paper on Λ = Γ ⊕ Γ*
``deformations``   Π* → a surface that has it
``curves``         Π in balls → invariants, the equation of the curve
``differentials``  Π on the mesh → holomorphic forms, parametrization, Abel–Jacobi
``jacobians``      Π → endomorphisms of the Jacobian, and its factors
``domains``        domains with holes → capacities and extremal lengths
``surfaces``       reference surfaces, their exact Π, and which of them a Π is
``pictures``, ``reports``, ``cli``, ``batch``, ``distributed``, ``machine``
=================  ============================================================================
"""

from .interrupts import end_quietly_while_importing as _end_quietly_while_importing

_end_quietly_while_importing()

from importlib.metadata import version as _version
from typing import Any as _Any

from . import forms, genus_two, surfaces
from .errors import (
    BatchError,
    ComplexError,
    CurveError,
    EnumerationLimitError,
    MemoryLimitError,
    MeshError,
    MissingExtraError,
    NotASiegelPointError,
    PeriodsError,
    RenderError,
)
from .meshes import MeshReport, load_mesh, sample_files, split_components
from .complexes import DeltaComplex, algebraic_number, double, intrinsic_delaunay
from .recognition import (
    AlgebraicNumber,
    NumberField,
    RecognisedMatrix,
    recognize,
)
from .topology import (
    cohomology_basis,
    dual_homology_basis,
    fundamental_polygon,
    homology_basis,
    shortest_loops,
)
from .flat_surfaces import (
    FlatSurfaceReport,
    flat_surface_report,
    from_flatsurf,
    to_flatsurf_dict,
)
from .harmonic import harmonic_form_blocks, harmonic_forms
from .periods import (
    Extrapolation,
    PeriodMatrix,
    ToleranceWarning,
    mesh_quality,
    period_matrix,
    period_matrix_from_weights,
    real_structure,
    refined_period_matrix,
    richardson,
    sampled_torus,
)
from .enclosures import PeriodEnclosure, enclose
from .siegel import (
    SIEGEL_GENUS_LIMIT,
    SiegelReduction,
    moduli_path,
    siegel_distance,
    siegel_exponential,
    siegel_logarithm,
    siegel_reduce,
    siegel_transform,
    to_flint,
)
from .moduli import (
    Isomorphisms,
    SymplecticGroup,
    hyperelliptic_point,
    is_hyperelliptic,
    j_derivative,
    j_invariant,
    moduli_distance,
    nearest_marking,
    recognise_entries,
    recognise_quadratic,
    symplectic_automorphism_group,
    symplectic_isomorphisms,
    theta_constants,
    theta_derivatives,
)
from .riemann_theta import SpinStructure, spin_structures, theta
from .forms import (
    DoubleGraph,
    double_graph,
    hodge_decomposition,
    holomorphic_forms,
    symplectic_mean_forms,
)
from .differentials import (
    FormZeros,
    abel_jacobi,
    divisor_class,
    evenness,
    form_of_periods,
    form_of_real_periods,
    form_zeros,
    most_even_form,
    parametrize,
)
from .jacobians import (
    EigenformRing,
    EndomorphismRing,
    JacobianFactors,
    eigenform_ring,
    endomorphisms,
    jacobian_factors,
)
from .curves import (
    AlgebraicCurve,
    curve,
    curve_of_form,
    to_latex,
    to_magma,
    to_pari,
    to_sage,
)
from .domains import (
    CapacityEnclosure,
    CapacityMatrix,
    EffectiveConductivity,
    EnergyBlocks,
    ExtremalLength,
    capacity_matrix,
    effective_conductivity,
    enclosed_capacities,
    energy_blocks,
    extremal_length,
    read_domain,
)
from .deformations import (
    Deformation,
    DeformationWarning,
    deform_along,
    deform_to,
    lengths_along,
    lengths_with,
    smooth_functions,
)
from .surfaces import Identification, catalogue, identify

__version__ = _version("igl_periods")


def _viewer(surface: PeriodMatrix | DeltaComplex, title: str) -> _Any:
    """The page of a surface; pictures are imported when one is asked for."""
    from .pictures import interactive

    return interactive(surface, title=title)


DeltaComplex.shown_by(_viewer)
PeriodMatrix.shown_by(_viewer)

__all__ = [
    # meshes and complexes
    "load_mesh",
    "split_components",
    "sample_files",
    "MeshReport",
    "DeltaComplex",
    "algebraic_number",
    "double",
    "intrinsic_delaunay",
    # topology
    "cohomology_basis",
    "homology_basis",
    "dual_homology_basis",
    "fundamental_polygon",
    "shortest_loops",
    # flat surfaces
    "flat_surface_report",
    "FlatSurfaceReport",
    "from_flatsurf",
    "to_flatsurf_dict",
    # period matrices
    "period_matrix",
    "period_matrix_from_weights",
    "PeriodMatrix",
    "enclose",
    "PeriodEnclosure",
    "ToleranceWarning",
    "mesh_quality",
    "refined_period_matrix",
    "richardson",
    "sampled_torus",
    "Extrapolation",
    "real_structure",
    # domains with holes
    "capacity_matrix",
    "CapacityMatrix",
    "enclosed_capacities",
    "CapacityEnclosure",
    "extremal_length",
    "ExtremalLength",
    "energy_blocks",
    "EnergyBlocks",
    "effective_conductivity",
    "EffectiveConductivity",
    "read_domain",
    # the Siegel upper half-space
    "siegel_reduce",
    "siegel_transform",
    "siegel_distance",
    "siegel_logarithm",
    "siegel_exponential",
    "moduli_path",
    "SiegelReduction",
    "SIEGEL_GENUS_LIMIT",
    "to_flint",
    # moduli
    "symplectic_isomorphisms",
    "Isomorphisms",
    "moduli_distance",
    "nearest_marking",
    "symplectic_automorphism_group",
    "SymplecticGroup",
    "j_invariant",
    "j_derivative",
    "genus_two",
    "theta_constants",
    "theta_derivatives",
    "hyperelliptic_point",
    "is_hyperelliptic",
    "curve",
    "curve_of_form",
    "AlgebraicCurve",
    "to_latex",
    "to_sage",
    "to_magma",
    "to_pari",
    "theta",
    "SpinStructure",
    "spin_structures",
    "recognize",
    "AlgebraicNumber",
    "RecognisedMatrix",
    "NumberField",
    "recognise_quadratic",
    "recognise_entries",
    "identify",
    "Identification",
    "catalogue",
    "surfaces",
    # Jacobians
    "endomorphisms",
    "EndomorphismRing",
    "eigenform_ring",
    "EigenformRing",
    "jacobian_factors",
    "JacobianFactors",
    # surfaces with the period matrix that one wants
    "deform_to",
    "lengths_with",
    "deform_along",
    "lengths_along",
    "smooth_functions",
    "Deformation",
    "DeformationWarning",
    # forms
    "harmonic_forms",
    "harmonic_form_blocks",
    "forms",
    "double_graph",
    "DoubleGraph",
    "hodge_decomposition",
    "holomorphic_forms",
    "symplectic_mean_forms",
    "abel_jacobi",
    "divisor_class",
    "form_zeros",
    "FormZeros",
    "form_of_periods",
    "form_of_real_periods",
    "most_even_form",
    "evenness",
    "parametrize",
    # errors
    "PeriodsError",
    "MeshError",
    "ComplexError",
    "CurveError",
    "NotASiegelPointError",
    "MemoryLimitError",
    "MissingExtraError",
    "EnumerationLimitError",
    "RenderError",
    "BatchError",
]


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
