"""Period matrices on several ranks, for the tests of distributed/: ``mpiexec -n N python … FILE``.

What every rank got is written to FILE, by rank 0, as a list with one dictionary for each rank.
"""

import pickle
import sys
import warnings
from pathlib import Path

import numpy as np
from support.random_surfaces import (
    BOLZA,
    L_SHAPE,
    noisy_torus,
    random_gluing,
    random_lengths,
    torus_of_revolution,
)

import igl_periods as ip

SQUARE = [((0, 0), (0, 2)), ((0, 1), (0, 3))]
OCTAHEDRON = np.concatenate([np.eye(3), -np.eye(3)])
OCTAHEDRON_FACES = [[0, 1, 2], [1, 0, 5], [2, 1, 3], [0, 2, 4], [5, 0, 4], [4, 2, 3], [3, 1, 5],
                    [5, 4, 3]]  # fmt: skip


def random_surface(seed, n_faces):
    """The largest component of a random gluing: loops, multi-edges, faces glued to themselves."""
    rng = np.random.default_rng(seed)
    twin = random_gluing(n_faces, rng)
    parts = ip.DeltaComplex.from_gluing(random_lengths(twin, rng), twin).components()
    return max(parts, key=lambda part: part.n_faces)


def pinched_torus():
    """Two vertices that nearly coincide: needles, which no flip removes."""
    V, F = torus_of_revolution(2.0, 0.7, 8, 6)
    V[1] = V[0] + 1e-5 * (V[1] - V[0])
    return ip.DeltaComplex.from_mesh(V, F)


SURFACES = {
    "one vertex": ip.DeltaComplex.from_squares(L_SHAPE),
    "more ranks than faces": ip.DeltaComplex.from_squares(SQUARE),
    "more ranks than vertices": random_surface(19, 12),
    "sphere": ip.DeltaComplex.from_mesh(OCTAHEDRON, OCTAHEDRON_FACES),
    "L": ip.DeltaComplex.from_squares(L_SHAPE, 6),
    "Bolza": ip.DeltaComplex.from_squares(BOLZA, 3),
    "torus": ip.DeltaComplex.from_mesh(*noisy_torus(9, 7, 0.2, 1)),
    "coarse torus": ip.DeltaComplex.from_mesh(*noisy_torus(4, 3, 0.3, 4)),
    "needles": pinched_torus(),
    "random": random_surface(3, 30),
}
OPTIONS = {
    "tight": {"rtol": 1e-11},
    "no flips": {"rtol": 1e-11, "delaunay": False},
    "loose": {"rtol": 0.1},
    "unsolved": {"max_iterations": 1},
}
OPEN = (np.eye(3), [[0, 1, 2]])


def results(comm):
    from igl_periods.distributed import period_matrix

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        found = {
            (name, how): period_matrix(K if comm.rank == 0 else None, comm=comm, **options)
            for name, K in SURFACES.items()
            for how, options in OPTIONS.items()
        }
    found["warnings"] = [(warning.category, str(warning.message)) for warning in caught]
    try:
        period_matrix(*(OPEN if comm.rank == 0 else ()))
    except ip.ComplexError as error:
        found["open"] = str(error)
    return found


def main():
    from mpi4py import MPI

    comm = MPI.COMM_WORLD
    gathered = comm.gather(results(comm))
    if comm.rank == 0:
        Path(sys.argv[1]).write_bytes(pickle.dumps(gathered))


if __name__ == "__main__":
    main()
