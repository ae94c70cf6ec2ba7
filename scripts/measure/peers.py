"""Peers side by side: the same task by other libraries and by this one, in one run.

    OPENBLAS_NUM_THREADS=1 python scripts/measure/peers.py --json data/measurements/peers.json

Four tasks, on surfaces of genus 2 from marching cubes, of which every fifth edge has to be flipped:

* the intrinsic Delaunay triangulation and its cotangent Laplacian: libigl; robust-laplacian, which
  is geometry-central, and has a mass matrix in its time;
* the cotangent Laplacian of the triangles as they are: libigl; potpourri3d, which has no other;
* energies of 2g harmonic forms, from vertices and faces: a textbook in NumPy and SciPy, below;
* 2g Laplace equations alone, on the Delaunay triangulation: SciPy's SuperLU and ``spsolve``, and
  PyAMG's Ruge–Stüben multigrid with conjugate gradients.

SuperLU is left out above 200,000 faces.  robust-laplacian, potpourri3d and pyamg are no
dependencies; those that are missing are named and left out.  Seconds are those of the processor,
medians of runs in turn.  Each result is compared with ours: Laplacians relative to their diagonals,
energies as D = A D′ Aᵀ with the integer matrix A of determinant ±1 that takes our classes to those
of the peer, potentials relative to the largest.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import statistics
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import igl
import numpy as np
from benchmark_surfaces import marching_cubes_surface
from scipy import sparse
from scipy.sparse.csgraph import breadth_first_order
from scipy.sparse.linalg import splu, spsolve
from threadpoolctl import threadpool_limits

import igl_periods as ip
from igl_periods.complexes import cotan_weights, intrinsic_delaunay
from igl_periods.harmonic import factored, harmonic_problem, laplacian, linear_energies, solve
from igl_periods.topology import mark

FACES = (10_000, 100_000, 1_000_000)
RESIDUAL = 1e-10  # of PyAMG: it leaves about as much of the potentials
MODULES = {
    "robust-laplacian": "robust_laplacian",
    "potpourri3d": "potpourri3d",
    "PyAMG, conjugate gradients": "pyamg",
}


@dataclass(frozen=True)
class Task:
    """What is to be done, by whom, how far a result is from ours; the first of them is ours."""

    name: str
    ways: dict[str, Callable[[], Any]]
    difference: Callable[[Any, Any], float]
    most_faces: dict[str, int]


def delaunay_task(V, F):
    import_of = importlib.import_module

    def ours():
        K = ip.DeltaComplex.from_mesh(V, F)
        flipped, _ = intrinsic_delaunay(K, sparse.csr_array((0, K.n_edges)))
        return laplacian(flipped, cotan_weights(flipped))

    ways = {
        "igl_periods": ours,
        "libigl": lambda: -igl.intrinsic_delaunay_cotmatrix(V, F)[0],
        "robust-laplacian": lambda: import_of("robust_laplacian").mesh_laplacian(V, F, 0.0)[0],
    }
    return Task("intrinsic Delaunay, Laplacian", ways, between_laplacians, {})


def laplacian_task(V, F):
    def ours():
        K = ip.DeltaComplex.from_mesh(V, F)
        return laplacian(K, cotan_weights(K))

    ways = {
        "igl_periods": ours,
        "libigl": lambda: -igl.cotmatrix(V, F),
        "potpourri3d": lambda: importlib.import_module("potpourri3d").cotan_laplacian(V, F),
    }
    return Task("Laplacian without flips", ways, between_laplacians, {})


def forms_task(V, F):
    def ours():
        marked = mark(ip.DeltaComplex.from_mesh(V, F))
        K, cochains = marked.complex, marked.cochains
        D, _ = linear_energies(K, cochains)
        return D, lambda: [K.sign * form[K.edge] for form in cochains.toarray()]

    ways = {"igl_periods": ours, "textbook, NumPy and SciPy": lambda: textbook_forms(V, F)}
    few = {"textbook, NumPy and SciPy": 200_000}
    return Task("energies of 2g harmonic forms", ways, between_energies, few)


def equations_task(V, F):
    given = mark(ip.DeltaComplex.from_mesh(V, F))
    flipped = given.after(intrinsic_delaunay)
    lower, problem = harmonic_problem(flipped.complex, flipped.cochains)
    full = sparse.csc_matrix(lower + sparse.tril(lower, -1).T)
    load = problem.sources[1:].toarray(order="F")

    def multigrid():
        hierarchy = importlib.import_module("pyamg").ruge_stuben_solver(full.tocsr())
        columns = [hierarchy.solve(b, tol=RESIDUAL, accel="cg") for b in load.T]
        return np.stack(columns, axis=1)

    symmetric = {"permc_spec": "MMD_AT_PLUS_A", "options": {"SymmetricMode": True}}
    ways = {
        "igl_periods, CHOLMOD": lambda: solve(factored(lower), load),
        "SciPy's SuperLU, symmetric order": lambda: splu(full, **symmetric).solve(load),
        "SciPy's spsolve": lambda: spsolve(full, load),
        "PyAMG, conjugate gradients": multigrid,
    }
    few = dict.fromkeys(("SciPy's SuperLU, symmetric order", "SciPy's spsolve"), 200_000)
    return Task("2g Laplace equations", ways, relative_difference, few)


def textbook_forms(V, F):
    """Tree–cotree, closed forms that cross it, potentials by ``splu``; energies, and the forms.

    The lines that a course on discrete differential geometry would write: Erickson and Whittlesey
    for the generators, Pinkall and Polthier for the Laplacian.  On the triangles as they are.

    Returns
    -------
    D : (2g, 2g) float
    forms : callable
        Makes a list of closed forms, (m, 3) int: by side, which lies opposite its corner.
    """
    n, m = len(V), len(F)
    sides = np.stack([np.roll(F, -1, 1), np.roll(F, 1, 1)], axis=-1).reshape(-1, 2)
    sign = np.where(sides[:, 0] < sides[:, 1], 1, -1)
    ends, edge = np.unique(np.sort(sides, axis=1), axis=0, return_inverse=True)
    edge = edge.ravel()
    left, right = np.empty((2, len(ends)), dtype=np.int64)
    left[edge[sign > 0]], right[edge[sign < 0]] = (np.flatnonzero(sign == s) // 3 for s in (1, -1))

    numbers = np.arange(len(ends))
    tree = spanning_tree(n, ends, np.ones(len(ends), dtype=bool))
    cotree = spanning_tree(m, np.stack([left, right], axis=1), ~np.isin(numbers, tree))
    free = np.setdiff1d(numbers, np.concatenate([tree, cotree]))
    # Of each free edge the dual cycle through the cotree; what crosses it is a closed form.
    boundary = sparse.csc_array(
        (np.repeat([1.0, -1.0], len(ends)), (np.r_[left, right], np.tile(numbers, 2))),
        shape=(m, len(ends)),
    )
    inner = splu(sparse.csc_matrix(boundary[1:, cotree]))
    forms = np.zeros((len(free), len(ends)))
    forms[:, cotree] = -np.rint(inner.solve(boundary[1:, free].toarray())).T
    forms[np.arange(len(free)), free] = 1

    corners = V[F]
    one, other = np.roll(corners, -1, 1) - corners, np.roll(corners, 1, 1) - corners
    cot = (one * other).sum(-1) / np.linalg.norm(np.cross(one, other), axis=-1)
    rho = np.bincount(edge, 0.5 * cot.ravel(), len(ends))
    d = sparse.csc_array(
        (np.tile([-1.0, 1.0], len(ends)), (np.repeat(numbers, 2), ends.ravel())),
        shape=(len(ends), n),
    )
    L = d.T @ sparse.diags_array(rho) @ d
    f = np.zeros((n, len(free)))
    f[1:] = splu(sparse.csc_matrix(L[1:, 1:])).solve(-(d.T @ (rho[:, None] * forms.T))[1:])
    harmonic = forms + (d @ f).T
    D = (harmonic * rho) @ harmonic.T
    return D, lambda: [(sign * form[edge]).reshape(-1, 3) for form in forms]


def spanning_tree(n, ends, allowed):
    """The edges of a spanning tree, by breadth-first search among those allowed."""
    numbers = np.flatnonzero(allowed)
    tail, head = ends[numbers].T
    # Two edges can join the same ends: the one with the least number stands for both.
    first = np.unique(np.minimum(tail, head) * n + np.maximum(tail, head), return_index=True)[1]
    tail, head, numbers = tail[first], head[first], numbers[first]
    graph = sparse.csr_array((numbers + 1, (tail, head)), shape=(n, n))
    _, before = breadth_first_order(graph, 0, directed=False)
    child = np.flatnonzero(before >= 0)
    both = sparse.csr_array(graph + graph.T)
    return np.asarray(both[child, before[child]]).ravel().astype(np.int64) - 1


def between_laplacians(ours, peer):
    """The largest difference of two entries over the root of the product of their diagonals."""
    scale = 1.0 / np.sqrt(ours.diagonal())
    difference = sparse.coo_array(peer - ours)
    relative = difference.data * scale[difference.row] * scale[difference.col]
    return float(np.abs(relative).max(initial=0.0))


def between_energies(ours, peer):
    """How far D is from A D′ Aᵀ, relative to D, for the integer A between the two bases."""
    (D, make), (D_peer, make_peer) = ours, peer
    forms, forms_peer = make(), make_peer()
    own = np.array([[intersection(a, b) for b in forms] for a in forms])
    mixed = np.array([[intersection(a, b) for b in forms] for a in forms_peer])
    A = np.linalg.solve(own.T, mixed.T).T
    integer = np.rint(A)
    if np.abs(A - integer).max() > 1e-9 or abs(abs(np.linalg.det(integer)) - 1.0) > 1e-9:
        raise ValueError("the classes of the peer are no integer basis of cohomology")
    return float(np.abs(integer @ D @ integer.T - D_peer).max() / np.abs(D_peer).max())


def intersection(a, b):
    """∫ a ∧ b of closed forms, constant on faces: half a determinant on each."""
    return 0.5 * float(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]))


def relative_difference(ours, peer):
    return float(np.abs(peer - ours).max() / np.abs(ours).max())


def side_by_side(task, n_faces, repeats):
    """A row for each way: processor seconds, over ours, and the difference to our result."""
    wanted = {
        way: function
        for way, function in task.ways.items()
        if way not in missing() and n_faces <= task.most_faces.get(way, n_faces)
    }
    ours = next(iter(wanted.values()))()
    differences = {way: task.difference(ours, function()) for way, function in wanted.items()}
    seconds = {way: [] for way in wanted}
    for _ in range(repeats):
        for way, function in wanted.items():
            start = time.process_time()
            function()
            seconds[way].append(time.process_time() - start)
    own = statistics.median(next(iter(seconds.values())))
    for way, times in seconds.items():
        median = statistics.median(times)
        row = {
            "task": task.name,
            "by": way,
            "faces": n_faces,
            "seconds": median,
            "over_ours": median / own,
            "difference": differences[way],
        }
        print(
            f"{task.name:<32} {way:<34} {n_faces:>9,} faces {median:8.3f} s "
            f"{row['over_ours']:6.2f}   off by {row['difference']:.1e}",
            flush=True,
        )
        yield row


def missing():
    """The peers that are not installed."""
    return [way for way, module in MODULES.items() if importlib.util.find_spec(module) is None]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--faces", type=int, nargs="+", default=FACES)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--json", type=Path)
    options = parser.parse_args()
    for way in missing():
        print(f"missing, left out: {way} (module {MODULES[way]})", file=sys.stderr)
    rows = []
    with threadpool_limits(1):
        for wanted in options.faces:
            V, F = marching_cubes_surface(wanted / 2)
            V, F = np.ascontiguousarray(V), np.ascontiguousarray(F, dtype=np.int64)
            for make in (delaunay_task, laplacian_task, forms_task, equations_task):
                rows += side_by_side(make(V, F), len(F), options.repeats)
            if options.json is not None:
                text = json.dumps({"peers": rows}, indent=1)
                options.json.write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
