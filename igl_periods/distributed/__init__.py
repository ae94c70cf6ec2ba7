r"""One mesh on many ranks: the period matrix with MPI and PETSc.

    mpiexec -n 64 python -m igl_periods.distributed MESH
    mpiexec -n 64 python -m mpi4py script.py        # that calls period_matrix, below

    from igl_periods.distributed import period_matrix
    pm = period_matrix(V, F)        # on rank 0, where V and F are; on the others period_matrix()

What has the size of the mesh and is more than its topology is divided: Delaunay flips, inside the
parts and then along their seams (:mod:`.flips`, :mod:`.pieces`), the Laplace equations, their
solutions, and the Gram matrix D of the gradients of the forms c + df (:mod:`.partition`,
:mod:`.potentials`).  Each rank holds the potentials at the vertices of its own faces, the same
values as its neighbours have there; so its forms are those of the whole surface on its faces, and

.. math:: D_{ij} = \sum_{\text{ranks}} \; \sum_{\text{their faces}} \int \omega_i \wedge *\omega_j

is the energy matrix of closed forms whatever f is.  It is summed from these squares and never from
right-hand sides and solutions: by Dirichlet's principle it is never below the exact one, and a
solution that is stopped early costs sharpness of the bound and not its truth.

**What stays on rank 0.**  Reading, gluing and marking are integer work on the whole mesh, and rank
0 does it alone; the parts are then cut out and sent one after the other, so that no other rank ever
holds the mesh.  Rank 0 needs 175 bytes a triangle to glue and 245 to mark, whether edges have to be
flipped or not, and 1.3 µs on four ranks, with 0.1 to 0.3 µs more whenever N doubles; after that it
keeps the surface, 115 bytes a triangle, for the result, and its own part.  At most
:math:`2^{31}/3`, 715 million, triangles go through SciPy's graph searches, which count half-edges
in 32 bits; PETSc with 32-bit integers goes up to 4 · 10⁹.

**Flips.**  Marching cubes leave every fifth edge to be flipped.  That takes 1.6 µs for a triangle
of a rank (2.7 with both cores busy), and 600 bytes while it lasts, the part included.  One round
along the seams was enough for 2 to 16 parts; its strips have :math:`16 \sqrt{nN}` triangles, which
rank 0 flips alone.

**Weak scaling.**  Measured with ``scripts/measure/weak_scaling.py`` for genus 2 and residuals of
1e-8, on surfaces of 10⁴ or 5 · 10⁴ up to 6 · 10⁵ vertices (n vertices, N ranks, 2g solutions of k
iterations each):

========================  ==========================  ========================================
what                      Lawson's surface, Delaunay  marching cubes, flipped
========================  ==========================  ========================================
iterations k              9 to 10                     18 to 20
of each, per vertex       0.10 µs                     0.13 µs (0.14, 0.18 with both cores busy)
multigrid, per vertex     2.6 µs                      4.0 µs
another rank, per vertex  1100 bytes                  1320 bytes
========================  ==========================  ========================================

of which 16g bytes are the potentials.  k grows by one, if at all, for a factor of ten in n.  A
part has about six neighbours and :math:`3\sqrt{n/N}` ghosts (2.5 on the average, 9 at most).  In
each iteration a rank sends on each of the :math:`\log_{20} n` levels some six times a
message to each neighbour, 8 bytes a ghost on the finest, and takes part in three sums over all:

.. math:: t = 2 g k \left( 0.13\,\mu s\; \frac nN
          + \lambda \log_{20} n\, (36 + 3 \log_2 N) \right) + 4\,\mu s\; \frac nN

with λ = 2 µs for a message.  For 10⁹ triangles (n = 5 · 10⁸, g = 2, k = 22 expected) like those
of marching cubes, were they divided already:

======  ================  ==============  =============  ==================  ================
N       vertices a rank   memory a rank   ghosts         an iteration        multigrid and all
======  ================  ==============  =============  ==================  ================
64      7.8 million       10 GB           8,400 (67 kB)  1.0 s + 0.7 ms      2 minutes
256     2.0 million       2.6 GB          4,200 (34 kB)  0.25 s + 0.8 ms     30 s
1,024   0.49 million      0.64 GB         2,100 (17 kB)  63 ms + 0.9 ms      7.5 s
4,096   0.12 million      0.16 GB         1,000 (8 kB)   16 ms + 1.0 ms      1.9 s
======  ================  ==============  =============  ==================  ================

Flips add 27 s on 64 ranks and less than a second on 4,096; their strips, 10 million triangles on
1,024 ranks, are 1 % of the mesh.  Messages do not matter before some ten thousand ranks.  What does
is rank 0: half an hour to an hour of integer work, with 245 GB, before the others have anything to
do. So flips and *solution* are divided, and the topology is not.  On one machine its factor takes
2.5 n log₂ n numbers at the least, 290 GB more, and a time like :math:`n^{3/2}`: from 1.7 s for 6 ·
10⁵ vertices, eleven hours.

References
----------
Balay et al., "PETSc/TAO Users Manual".
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 3.
"""

from .pipeline import period_matrix

__all__ = ["period_matrix"]
