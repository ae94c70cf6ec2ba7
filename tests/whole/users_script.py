"""What a user writes: every main public call, with the types that it is said to have."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import igl_periods as ip
from igl_periods import surfaces
from igl_periods.batch import BatchOptions, BatchResult, find_files, rows_of, run_batch
from igl_periods.complexes import intrinsic_delaunay
from igl_periods.differentials import AbelJacobi, Parametrization
from igl_periods.forms import HodgeDecomposition, d0, dirichlet_energy, hodge_star, scalar_product
from igl_periods.periods import MeshQuality, Refined
from igl_periods.topology import FundamentalPolygon

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Complexes = NDArray[np.complex128]


class Tetrahedron:
    """A mesh object of the user's own."""

    def __init__(self) -> None:
        self.vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        self.faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]


def ways_to_name_a_surface(path: Path, V: Floats, F: Ints) -> list[int]:
    K = ip.DeltaComplex.from_mesh(V, F)
    loaded = ip.load_mesh(path)
    from_lists: ip.PeriodMatrix = ip.period_matrix(V.tolist(), F.tolist())
    matrices = [
        from_lists,
        ip.period_matrix(V, F, tolerance=1e-3),
        ip.period_matrix(K, weights="extrinsic"),
        ip.period_matrix((V, F), degree=2),
        ip.period_matrix(path),
        ip.period_matrix(str(path)),
        ip.period_matrix(loaded),
        ip.period_matrix(Tetrahedron()),
    ]
    return [pm.genus for pm in matrices]


def topology(V: Floats, F: Ints) -> tuple[Any, list[Ints]]:
    K: ip.DeltaComplex = ip.DeltaComplex.from_mesh((V, F))
    cycles: list[Ints] = ip.homology_basis(V, F)
    same: list[Ints] = ip.homology_basis(K, root=0)
    dual: list[Ints] = ip.dual_homology_basis((V, F), 0)
    loops: list[Ints] = ip.shortest_loops(V, F, root=1)
    polygon: FundamentalPolygon = ip.fundamental_polygon(K)
    word: Ints = polygon.word
    cocycles: Any = ip.cohomology_basis(V, F)
    doubled: ip.DeltaComplex = ip.double(V, F)
    assert len(cycles) == len(same) == len(dual) == len(loops) == word.size // 2
    assert len(doubled.components()) == 2
    return cocycles, cycles


def forms(V: Floats, F: Ints, cocycles: Any) -> Complexes:
    K = ip.DeltaComplex.from_mesh(V, F)
    omega: Floats = ip.harmonic_forms(K, cocycles)
    blocks: list[Floats] = list(ip.harmonic_form_blocks(V, F, rows=1))
    assert sum(len(block) for block in blocks) == len(omega)
    L, carried = intrinsic_delaunay(K, cocycles)
    graph: ip.DoubleGraph = ip.double_graph(L)
    zeta: Complexes = ip.holomorphic_forms(graph)
    mean: Complexes = ip.symplectic_mean_forms(L, carried)
    df = d0(graph, np.arange(float(graph.n_vertices)))
    parts: HodgeDecomposition = ip.hodge_decomposition(graph, df)
    assert np.allclose(dirichlet_energy(graph, parts.exact), dirichlet_energy(graph, df))
    assert np.allclose(scalar_product(graph, df, hodge_star(graph, parts.coexact)), 0.0)
    assert mean.shape == zeta.shape
    return zeta


def what_is_known(pm: ip.PeriodMatrix) -> float:
    Pi: Complexes = pm.matrix
    eigenvalues: Floats = pm.symplectic_eigenvalues
    bounds: Floats | None = pm.entry_bounds
    bound: float | None = pm.bound
    reduced: ip.PeriodMatrix = pm.reduced()
    changed: ip.PeriodMatrix = pm.change_basis(np.eye(2 * pm.genus, dtype=np.int64))
    estimates: list[Complexes] = [pm.primal, pm.dual, pm.mean, pm.riemann_matrix, np.asarray(pm)]
    assert all(estimate.shape == Pi.shape for estimate in estimates)
    assert bounds is not None and bounds.shape == changed.matrix.shape
    assert eigenvalues.shape == (reduced.genus,)
    return 0.0 if bound is None else bound


def moduli(pm: ip.PeriodMatrix) -> list[str]:
    matrix, gamma = ip.siegel_reduce(pm)
    moved: Complexes = ip.siegel_transform(gamma, pm)
    distance: float = ip.siegel_distance(moved, matrix)
    nearest: float = ip.moduli_distance(pm, matrix, tolerance=0.5)
    found: ip.Isomorphisms = ip.symplectic_isomorphisms(pm, matrix, limit=1)
    first: Ints = found[0]
    group: ip.SymplecticGroup = ip.symplectic_automorphism_group(pm)
    generators: list[Ints] = group.generators
    identified: ip.Identification = ip.identify(pm, tolerance=0.01)
    names: list[str] = [match.surface.name for match in identified]
    assert distance < 1e-6 and nearest < 1e-6
    assert first.shape == gamma.shape and group.order >= len(generators)
    return names + [surface.name for surface in ip.catalogue(pm.genus)]


def on_the_mesh(pm: ip.PeriodMatrix) -> Floats:
    coefficients: Complexes = ip.most_even_form(pm)
    P: Parametrization = ip.parametrize(pm, coefficients)
    uv: Complexes = P.corner_uv
    image: AbelJacobi = ip.abel_jacobi(pm, base=0)
    dilatation: Floats = P.dilatation
    assert uv.shape == (pm.complex.n_faces, 3) and len(image.points) == pm.complex.n_vertices
    return dilatation


def accuracy(V: Floats, F: Ints) -> float:
    quality: MeshQuality = ip.mesh_quality(V, F)
    refined: Refined = ip.refined_period_matrix(V, F, bound=0.9 * quality.bound)
    limit: ip.Extrapolation = ip.richardson(
        lambda n: surfaces.torus_of_revolution(2.0, 1.0, n, n), (8, 12, 16)
    )
    order: float | None = limit.order
    assert order is not None and refined.period_matrix.bound is not None
    return refined.period_matrix.bound


def many(folder: Path) -> BatchResult:
    options = BatchOptions(tolerance=1e-2)
    files = find_files(folder)
    name, path = next(iter(files.items()))
    rows = rows_of(path, options, name)
    result = run_batch({}, folder / "results.parquet", options)
    assert rows[0]["genus"] == 1
    return result


def say(*words: object) -> None:
    sys.stdout.write(" ".join(map(str, words)) + "\n")


def main(path: Path, with_batch: bool) -> None:
    V, F, report = ip.load_mesh(path)
    pm = ip.period_matrix(V, F)
    cocycles, _ = topology(V, F)
    ways = ways_to_name_a_surface(path, V, F)
    zeta = forms(V, F, cocycles)
    bound = what_is_known(pm)
    names = moduli(pm)
    stretched = on_the_mesh(pm)
    better = accuracy(V, F)
    if with_batch:
        many(path.parent)
    say(ways, zeta.shape, bound > better, bool(names), stretched.size, report.faces)
    try:
        ip.period_matrix(V, F[:-1])
    except ip.ComplexError as error:
        say(error)


if __name__ == "__main__":
    main(Path(sys.argv[1]), len(sys.argv) > 2)
