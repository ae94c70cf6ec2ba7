"""What there is to see of a surface: one sheet of a double, the cell of a periodic surface."""

import numpy as np
import pytest
from support.random_surfaces import noisy_torus

import igl_periods as ip
from igl_periods.complexes import edge_ends, half_edge_ends
from igl_periods.complexes.doubling import double
from igl_periods.pictures.sheets import Sheet, surface_in_space
from igl_periods.surfaces import double_polygon, flat_torus, triply_periodic_minimal_surface
from igl_periods.topology import canonical_cycles


def quotient(name="G", n=2):
    V, F, lattice = triply_periodic_minimal_surface(name, n)
    return V, F, ip.DeltaComplex.from_mesh(V, F, lattice=lattice)


def check(sheet, K):
    """Half-edges have their lengths, and lead between the vertices they lead between in K."""
    half_edges = np.arange(3 * K.n_faces)
    ends = sheet.ends(half_edges)
    assert np.allclose(
        np.linalg.norm(sheet.V[ends[1]] - sheet.V[ends[0]], axis=1), K.lengths.ravel(), rtol=1e-9
    )
    return ends


def test_a_cell_is_seen_as_it_was_given():
    V, F, K = quotient()
    W, G = surface_in_space(K)
    assert np.array_equal(W[G], V[F])
    sheet = Sheet.of(K)
    tail, head = half_edge_ends(K)
    ends = check(sheet, K)
    assert np.array_equal(sheet.source[ends[0]], tail)
    assert np.array_equal(sheet.source[ends[1]], head)


def test_a_double_is_seen_once():
    V, F = noisy_torus(9, 8, 0.1, 1)
    K = double(ip.DeltaComplex.from_mesh(V, np.delete(F, [0, 60], axis=0)))
    sheet = Sheet.of(K)
    assert len(sheet.F) == K.n_faces // 2
    ends = check(sheet, K)
    assert len(np.unique(sheet.V[ends[0]], axis=0)) == len(V)
    assert Sheet.of(ip.DeltaComplex.from_mesh(V, F)).F is not None


def test_the_double_of_a_periodic_surface_is_seen_once():
    V, F, lattice = triply_periodic_minimal_surface("P", 2)
    open_surface = ip.DeltaComplex.from_mesh(V, F[3:], lattice=lattice)
    K = double(open_surface)
    sheet = Sheet.of(K)
    assert np.array_equal(sheet.V[sheet.F], V[F[3:]])
    check(sheet, K)


def test_cells_stay_with_their_faces():
    _, _, K = quotient("P", 1)
    refined, _ = ip.complexes.split(K, ip.cohomology_basis(K))
    check(Sheet.of(refined), refined)
    tail, _ = edge_ends(refined)
    assert tail.size == refined.n_edges
    V = np.array([[0.0, 0], [1, 0], [4, 1], [3, 1]])
    thin = ip.DeltaComplex.from_mesh(V, [[0, 1, 2], [0, 2, 3]], lattice=[[1, 0], [3, 1]])
    flipped, rounds = ip.complexes.delaunay_flips(thin)
    assert rounds
    assert flipped.cell is None
    assert repr(K.cell) == "Cell(48 faces, 3 translations)"


def test_components_of_a_cell_keep_their_places():
    V, F, lattice = triply_periodic_minimal_surface("P", 1)
    # The surface and a parallel copy of it, elsewhere in the cell.
    both = np.vstack([V, V + 0.123]), np.vstack([F, F + len(V)])
    parts = ip.DeltaComplex.from_mesh(*both, lattice=lattice).components()
    assert [part.genus for part in parts] == [3, 3]
    for part, moved in zip(parts, (0.0, 0.123)):
        assert np.allclose(part.cell.corners, V[F] + moved)
        check(Sheet.of(part), part)


def test_surfaces_without_a_place_are_refused():
    K = ip.DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))])
    with pytest.raises(ip.ComplexError, match="no positions in space"):
        Sheet.of(K)


def test_polygons_lie_in_the_plane_as_they_were_given():
    octagon = double_polygon(5)
    sheet = Sheet.of(octagon)
    assert sheet.unfolded
    assert octagon.polygons is not None
    corners = np.concatenate(octagon.polygons.xy)
    assert len(sheet.V) == len(corners)
    assert np.array_equal(sheet.source[sheet.F], octagon.corner_vertex)
    V = sheet.V[sheet.F]
    sides = np.linalg.norm(np.roll(V, -1, axis=1) - np.roll(V, 1, axis=1), axis=2)
    np.testing.assert_allclose(sides, octagon.lengths, rtol=1e-12)


def test_walks_in_the_plane_come_in_pieces_that_hang_together():
    pm = ip.period_matrix(flat_torus(0.3 + 0.9j, 3))
    sheet = Sheet.developed(ip.parametrize(pm, [1.0]))
    for walk in canonical_cycles(pm.complex, pm.cocycles):
        pieces = sheet.pieces(walk)
        start, end = sheet.ends(walk)
        assert np.concatenate([piece[:-1] for piece in pieces]).tolist() == start.tolist()
        assert np.concatenate([piece[1:] for piece in pieces]).tolist() == end.tolist()
