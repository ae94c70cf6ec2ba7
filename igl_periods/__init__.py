"""Period matrices of triangle meshes and polyhedral surfaces, with certified error bounds.

``V, F`` in, a point of the Siegel upper half-space out, with a proof of how far it can be off.

>>> import igl_periods as ip
>>> K = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=4)
>>> ip.period_matrix(K).genus
1
"""

from importlib.metadata import version as _version

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
)
from .moduli import (
    Isomorphisms,
    SymplecticGroup,
    moduli_distance,
    symplectic_automorphism_group,
    symplectic_isomorphisms,
)
from .surfaces import Identification, catalogue, identify
from .complexes import DeltaComplex, double
from .differentials import abel_jacobi, most_even_form, parametrize
from .forms import (
    DoubleGraph,
    double_graph,
    hodge_decomposition,
    holomorphic_forms,
    symplectic_mean_forms,
)
from .topology import (
    cohomology_basis,
    dual_homology_basis,
    fundamental_polygon,
    homology_basis,
    shortest_loops,
)
from .errors import ComplexError, MemoryLimitError, MeshError, NotASiegelPointError
from .siegel import (
    SIEGEL_GENUS_LIMIT,
    SiegelReduction,
    siegel_distance,
    siegel_reduce,
    siegel_transform,
    to_flint,
)
from .harmonic import harmonic_form_blocks, harmonic_forms
from .meshes import MeshReport, load_mesh

__version__ = _version("igl_periods")

__all__ = [
    "abel_jacobi",
    "catalogue",
    "cohomology_basis",
    "ComplexError",
    "DeltaComplex",
    "double",
    "double_graph",
    "DoubleGraph",
    "dual_homology_basis",
    "Extrapolation",
    "fundamental_polygon",
    "harmonic_form_blocks",
    "harmonic_forms",
    "hodge_decomposition",
    "holomorphic_forms",
    "homology_basis",
    "Identification",
    "identify",
    "Isomorphisms",
    "load_mesh",
    "MemoryLimitError",
    "mesh_quality",
    "MeshError",
    "MeshReport",
    "moduli_distance",
    "most_even_form",
    "NotASiegelPointError",
    "parametrize",
    "period_matrix",
    "period_matrix_from_weights",
    "PeriodMatrix",
    "real_structure",
    "refined_period_matrix",
    "richardson",
    "shortest_loops",
    "siegel_distance",
    "SIEGEL_GENUS_LIMIT",
    "siegel_reduce",
    "siegel_transform",
    "SiegelReduction",
    "symplectic_automorphism_group",
    "symplectic_isomorphisms",
    "symplectic_mean_forms",
    "SymplecticGroup",
    "to_flint",
    "ToleranceWarning",
]
