"""The order of the tutorials in the gallery: that of the guide, and then the rest by name."""

ORDER = (
    "first_period_matrix",
    "what_a_bound_says",
    "other_libraries",
    "textures",
    "translation_surface",
    "lawson_recognised",
    "wente_torus",
    "lattice_models",
    "annuli_and_capacities",
    "deforming_to_a_matrix",
    "schwarz_p",
    "effective_conductivity",
    "many_meshes",
    "one_mesh_under_mpi",
)


def by_number(filename):
    name = str(filename).rpartition("/")[2].removesuffix(".py")
    return (ORDER.index(name) if name in ORDER else len(ORDER), name)
