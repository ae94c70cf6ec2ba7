"""
One mesh under MPI
==================

Every rank runs this script.  Rank 0 has the mesh and gets the result; equations and energies are
divided among all ranks.

    mpiexec -n 4 python -m mpi4py scripts/examples/one_mesh_under_mpi.py [MESH]

It needs MPI and PETSc: ``scripts/setup --distributed``.
"""

import sys

from mpi4py import MPI

import igl_periods as ip
from igl_periods.distributed import period_matrix

# %%
# Rank 0 reads.  The others call without a mesh.

if MPI.COMM_WORLD.rank == 0:
    path = sys.argv[1] if len(sys.argv) > 1 else ip.sample_files()["lawson_2_1"]
    V, F, _ = ip.load_mesh(path)
    pm = period_matrix(V, F, rtol=1e-8)
else:
    pm = period_matrix(rtol=1e-8)

# %%
# The bound is certified whatever the tolerance of the solver: a solution that stops early makes it
# larger, never wrong.

if MPI.COMM_WORLD.rank == 0:
    print(pm.reduced())
    print(f"{MPI.COMM_WORLD.size} ranks, relative error at most {pm.bound:.2g}")
