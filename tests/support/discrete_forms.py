"""Random forms on Λ, equality of forms, and the flat torus with dz."""

import numpy as np
from scipy.sparse import csr_array
from support.delaunay_surfaces import flat_torus

from igl_periods.complexes.delaunay import intrinsic_delaunay
from igl_periods.complexes.half_edges import edge_ends
from igl_periods.forms.graph import double_graph


def complex_normal(rng, *shape):
    return rng.normal(size=shape) + 1j * rng.normal(size=shape)


def random_forms(graph, rng, *batch):
    return complex_normal(rng, *batch, 2, graph.n_edges)


def random_functions(graph, rng, *batch):
    return complex_normal(rng, *batch, graph.n_vertices)


def close(one, other):
    """Equal up to rounding, relative to the largest value."""
    one, other = np.broadcast_arrays(one, other)
    size = max(np.abs(one).max(initial=0), np.abs(other).max(initial=0), 1.0)
    return np.abs(one - other).max(initial=0) < 1e-12 * size


def flat(n=7, m=6, noise=0.12):
    """A Delaunay triangulation of a flat torus without symmetry, and dz on the sides of ◊."""
    K, z = flat_torus(n, m, noise, 1)
    tail, head = edge_ends(K)
    length = np.empty(K.n_edges)
    length[K.edge] = K.lengths
    dz = shortest_lift(z[head] - z[tail], length)
    K, dz = intrinsic_delaunay(K, csr_array(dz[None]))
    return (graph := double_graph(K)), side_differential(graph, dz.toarray()[0])


def shortest_lift(displacement, length, periods=(1.0, 0.3 + 1.1j)):
    """The displacement on the torus that has the given length."""
    shifts = [i * periods[0] + j * periods[1] for i in (-1, 0, 1) for j in (-1, 0, 1)]
    lifts = displacement[:, None] + np.array(shifts)
    best = np.abs(np.abs(lifts) - length[:, None]).argmin(axis=1)
    return lifts[np.arange(len(lifts)), best]


def side_differential(graph, dz):
    """dz from the vertices to the circumcentres of a flat torus, from dz along its edges."""
    K = graph.complex
    side = K.sign * dz[K.edge]
    double_area = (side[:, 2].conj() * side[:, 0]).imag
    # From the middle of a side to the circumcentre: half its length times the cotangent.
    cot = -(np.roll(side, 1, 1).conj() * np.roll(side, -1, 1)).real / double_area[:, None]
    to_centre = np.zeros((2, K.n_edges), dtype=complex)
    to_centre[(K.sign > 0).astype(int), K.edge] = 0.5j * cot * side
    right, left = to_centre[:, graph.edges]
    half = 0.5 * dz[graph.edges]
    form = np.zeros(2 * graph.n_edges, dtype=complex)
    form[graph.sides] = around = np.stack([half + right, right - half, left - half, half + left])
    assert close(form[graph.sides], around)
    return form


def close_after_solving(one, other, tolerance=1e-11):
    one, other = np.broadcast_arrays(one, other)
    size = max(np.abs(one).max(initial=0), np.abs(other).max(initial=0), 1.0)
    return np.abs(one - other).max(initial=0) < tolerance * size


def on_lambda(surface, forms):
    return forms[..., surface.graph.edges]
