"""Period matrices of triangle meshes and polyhedral surfaces, with certified error bounds.

``V, F`` in, a point of the Siegel upper half-space out, with a proof of how far it can be off.

>>> import igl_periods as ip
>>> K = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=4)
>>> ip.period_matrix(K).genus
1
"""

from importlib.metadata import version as _version

from .adaptive import ToleranceWarning as ToleranceWarning
from .automorphisms import SymplecticGroup as SymplecticGroup
from .automorphisms import symplectic_automorphism_group as symplectic_automorphism_group
from .catalogue import catalogue as catalogue
from .delta_complex import DeltaComplex as DeltaComplex
from .differentials import abel_jacobi as abel_jacobi
from .double import double as double
from .double import real_structure as real_structure
from .double_graph import DoubleGraph as DoubleGraph
from .double_graph import double_graph as double_graph
from .dual_cycles import dual_homology_basis as dual_homology_basis
from .equivalence import Isomorphisms as Isomorphisms
from .equivalence import moduli_distance as moduli_distance
from .equivalence import symplectic_isomorphisms as symplectic_isomorphisms
from .errors import ComplexError as ComplexError
from .errors import MemoryLimitError as MemoryLimitError
from .errors import MeshError as MeshError
from .errors import MissingExtraError as MissingExtraError
from .errors import NotASiegelPointError as NotASiegelPointError
from .form_choice import most_even_form as most_even_form
from .half_space import siegel_distance as siegel_distance
from .half_space import siegel_transform as siegel_transform
from .hodge import hodge_decomposition as hodge_decomposition
from .holomorphic import harmonic_form_blocks as harmonic_form_blocks
from .holomorphic import harmonic_forms as harmonic_forms
from .holomorphic import holomorphic_forms as holomorphic_forms
from .holomorphic import symplectic_mean_forms as symplectic_mean_forms
from .homology import cohomology_basis as cohomology_basis
from .homology import homology_basis as homology_basis
from .homotopy import fundamental_polygon as fundamental_polygon
from .homotopy import shortest_loops as shortest_loops
from .identification import Identification as Identification
from .identification import identify as identify
from .invariants import to_flint as to_flint
from .local_refinement import refined_period_matrix as refined_period_matrix
from .mesh import MeshReport as MeshReport
from .mesh import load_mesh as load_mesh
from .parametrization import parametrize as parametrize
from .periods import PeriodMatrix as PeriodMatrix
from .pipeline import period_matrix as period_matrix
from .pipeline import period_matrix_from_weights as period_matrix_from_weights
from .quality import mesh_quality as mesh_quality
from .richardson import Extrapolation as Extrapolation
from .richardson import richardson as richardson
from .samples import sample_files as sample_files
from .siegel import SIEGEL_GENUS_LIMIT as SIEGEL_GENUS_LIMIT
from .siegel import SiegelReduction as SiegelReduction
from .siegel import siegel_reduce as siegel_reduce

__version__ = _version("igl_periods")
