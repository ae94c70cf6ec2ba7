r"""Polyhedral surfaces as Δ-complexes with edge lengths.

A polyhedral surface is a set of Euclidean triangles glued along sides of equal length.  The
gluing need not be a simplicial complex: two triangles may share two sides, a side may join a
vertex to itself, a triangle may be glued to itself.  Intrinsic Delaunay triangulations of real
meshes contain all of these, and a square-tiled surface may have a single vertex.  Therefore an
edge is an *index* here, never a pair of vertices.

Side ``s`` of face ``f`` lies opposite corner ``s`` and runs from corner ``s + 1`` to corner
``s + 2`` (mod 3), which is libigl's order of the columns of ``igl.edge_lengths``.  The half-edge
``h = 3 f + s`` is that side seen from that face.  An edge runs the way of its first half-edge;
``sign`` is +1 on the half-edges that run with their edge, -1 on those that run against it.
Across an edge of an oriented surface the two signs are opposite; where they agree, the gluing
reverses the orientation.

A 1-cochain ``c`` is a number per edge.  Its value along side ``s`` of face ``f`` is
``sign[f, s] * c[edge[f, s]]``, and it is closed iff the three values of every face add up to 0.

The weight of an edge is the paper's ratio ρ(e): the distance of the circumcentres of the two
neighbouring triangles over the length of the edge.  Measured on the surface itself it is

.. math:: \rho(e) = \tfrac12 (\cot\alpha + \cot\beta),

α and β the angles opposite the edge; measured in the ambient space it is the *extrinsic* weight.

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 2.
Pinkall, Polthier, "Computing discrete minimal surfaces and their conjugates" (1993).
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import igl
import numpy as np
from numpy.typing import ArrayLike, NDArray

from igl_periods.arrays import Floats, Ints, ReadOnlyArrays
from igl_periods.display import Shown, counted, facts_html
from igl_periods.errors import MeshError
from igl_periods.run_log import logger

from .assembly import assembled, parts_of
from .checked_arrays import check_finite, checked_faces, checked_lengths, checked_positions
from .exact_lengths import ExactLengths, by_kind, root_of
from .glued_squares import squares
from .gluing_documents import document_of, surface_in_document
from .gluings import (
    check_fans,
    checked_same,
    checked_twin,
    compressed,
    reversing_sides,
    twins_of_faces,
)
from .lattices import Cell, lattice_gluing
from .mesh_readers import vertices_and_faces
from .polygon_gluings import GluedPolygons, glued_polygons, lengths_of_polygons
from .surface_checks import check_surface, topology_in_words

if TYPE_CHECKING:
    from .surface_arguments import SurfaceLike


@dataclass(frozen=True, eq=False, repr=False)
class DeltaComplex(Shown, ReadOnlyArrays):
    """Euclidean triangles glued along their sides.

    Build one with :meth:`from_mesh`, :meth:`from_lengths`, :meth:`from_gluing`,
    :meth:`from_squares` or :meth:`from_polygons`, which check every invariant; the plain
    constructor checks nothing.
    A complex may have a boundary or disagreeing orientations; :func:`check_surface` refuses
    those, as everything that computes a period matrix does.

    Attributes
    ----------
    lengths : (m, 3) float
        Length of each side; equal on the two halves of an edge.
    twin : (m, 3) int
        The half-edge ``3 f' + s'`` glued to side ``s`` of face ``f``, or -1 on a boundary.
    edge : (m, 3) int
        Index of the edge of each side.
    sign : (m, 3) int8
        +1 where the side runs with its edge, -1 where it runs against it.
    corner_vertex : (m, 3) int
        Index of the vertex at each corner.
    n_vertices, n_edges : int
        Numbers of vertices and edges.
    labels : (n_vertices,) int
        Row of each vertex in the ``V`` the complex was made from (rows that no face uses are no
        vertices); ``0, 1, 2, …`` where there was no ``V``.
    positions : (n_vertices, d) float or None
        Coordinates of the vertices, where the complex comes from a mesh.
    mollification : float
        Length that was added to every side to make all triangle inequalities strict.
    distortion : (m,) float or None
        How much rounding may have changed the metric of each face since the complex was given,
        relative to it and in units of 2⁻⁵⁰; None where nothing was changed.
    exact_lengths : function or None
        The lengths of the edges as balls, for a precision in bits, where the doubles in ``lengths``
        are rounded (:mod:`igl_periods.complexes.exact_lengths`); what is proved is proved about
        these.  Where there is no such function, the doubles are the lengths, exactly.
    cell : Cell or None
        Where the faces of the quotient of a periodic surface lie in space.
    polygons : GluedPolygons or None
        The polygons of the plane that the surface was glued from, whose triangles the faces are.
    """

    lengths: Floats
    twin: Ints
    edge: Ints
    sign: NDArray[np.int8]
    corner_vertex: Ints
    n_vertices: int
    n_edges: int
    labels: Ints
    positions: Floats | None = None
    mollification: float = 0.0
    distortion: Floats | None = None
    exact_lengths: ExactLengths | None = None
    cell: Cell | None = None
    polygons: GluedPolygons | None = None

    def __repr__(self) -> str:
        sizes = [
            counted(self.n_vertices, "vertex", "vertices"),
            counted(self.n_edges, "edge", "edges"),
            counted(self.n_faces, "face", "faces"),
        ]
        topology = ", ".join(topology_in_words(self))
        return f"DeltaComplex({', '.join(sizes)}{'; ' if topology else ''}{topology})"

    def _repr_html_(self) -> str:
        sizes = [("vertices", self.n_vertices), ("edges", self.n_edges), ("faces", self.n_faces)]
        facts = [*sizes, ("surface", ", ".join(topology_in_words(self)))]
        if self.mollification:
            facts.append(("mollification", f"{self.mollification:.3g}"))
        return facts_html("DeltaComplex", facts)

    @classmethod
    def from_mesh(
        cls,
        V: SurfaceLike | ArrayLike,
        F: ArrayLike | None = None,
        *,
        lattice: ArrayLike | None = None,
        tolerance: float = 1e-6,
    ) -> DeltaComplex:
        """Make the polyhedral surface of a triangle mesh.

        Parameters
        ----------
        V : (n, d) array-like
            Vertex positions in R^d, d ≥ 2; or, without F, one object that is a mesh
            (:func:`~igl_periods.complexes.as_complex`).
        F : (m, 3) array-like of int
            Corners of each triangle, as rows of ``V``.  Two faces are glued where they share two
            corners.
        lattice : (k, d) array-like, optional
            One to three translations: the mesh is a cell of a periodic surface, and the complex the
            quotient (:mod:`igl_periods.complexes.lattices`), whose vertices have no positions.
        tolerance : float
            How far corners may be from being translates, in parts of the shortest translation.

        Raises
        ------
        MeshError
            If the arrays have a wrong shape or type, coordinates are not finite, an index is out
            of range, a face repeats a vertex, an edge has more than two faces, the faces at a
            vertex form more than one fan, or the lattice glues nothing.
        ComplexError
            If a triangle is degenerate beyond what mollification mends.
        """
        mesh = V if isinstance(V, DeltaComplex) else vertices_and_faces(V, F)
        if isinstance(mesh, DeltaComplex):
            if lattice is not None:
                raise MeshError("a lattice glues a mesh with positions, V and F, not a complex.")
            return mesh
        positions = checked_positions(mesh[0])
        faces = checked_faces(mesh[1], len(positions))
        check_finite(positions, faces)
        if lattice is not None:
            return _quotient(positions, faces, lattice, tolerance)
        lengths = igl.edge_lengths(positions, faces)
        return _from_simplicial(lengths, faces, positions)

    @classmethod
    def from_lengths(cls, lengths: ArrayLike, F: ArrayLike) -> DeltaComplex:
        """Make a surface from a simplicial complex and the lengths of its sides.

        Parameters
        ----------
        lengths : (m, 3) array-like
            ``lengths[f, s]`` is the length of the side of face ``f`` opposite corner ``s``
            (as ``igl.edge_lengths`` returns it).
        F : (m, 3) array-like of int
            Corners of each triangle.  Two faces are glued where they share two corners.

        Raises
        ------
        MeshError
            If the faces form no surface, as in :meth:`from_mesh`.
        ComplexError
            If lengths are not positive and finite, differ by more than 1e-9 (relative) on glued
            sides, or miss a triangle inequality beyond what mollification mends.
        """
        faces = checked_faces(F, None)
        return _from_simplicial(checked_lengths(lengths, len(faces)), faces, None)

    @classmethod
    def from_gluing(
        cls, lengths: ArrayLike, twin: ArrayLike, same: ArrayLike | None = None
    ) -> DeltaComplex:
        """Make a surface from triangles and the gluing of their sides.

        Parameters
        ----------
        lengths : (m, 3) array-like
            Side lengths.
        twin : (m, 3) array-like of int
            ``twin[f, s] = 3 f' + s'`` glues side ``s`` of ``f`` to side ``s'`` of ``f'``, running
            in opposite directions; -1 leaves a side free.
        same : (m, 3) array-like of bool, optional
            Sides that are glued running in the same direction instead, so that the orientations
            of the two faces disagree.

        Raises
        ------
        ComplexError
            If ``twin`` is not an involution without fixed points, ``same`` differs on glued
            sides, lengths are not positive and finite, differ by more than 1e-9 (relative) on
            glued sides, or miss a triangle inequality beyond what mollification mends.
        """
        glued = checked_twin(twin)
        alike = checked_same(np.zeros(glued.shape, dtype=bool) if same is None else same, glued)
        return cls(**assembled(checked_lengths(lengths, len(glued)), glued, alike))

    @classmethod
    def from_squares(cls, gluing: Iterable[Sequence[Sequence[int]]], n: int = 1) -> DeltaComplex:
        """Glue unit squares, each divided into n × n squares of two right triangles.

        The weights are those of the square lattice: 1 on sides, 0 on diagonals.

        Parameters
        ----------
        gluing : iterable of ((square, side), (square, side))
            Pairs of glued sides.  The sides of a square are 0 bottom, 1 right, 2 top, 3 left,
            counterclockwise; glued sides run in opposite directions.
        n : int

        Raises
        ------
        ComplexError
            If a side does not exist or is not glued exactly once, to another side, or ``n < 1``.

        Examples
        --------
        >>> torus = DeltaComplex.from_squares([((0, 0), (0, 2)), ((0, 1), (0, 3))], n=2)
        >>> torus.n_vertices, torus.n_edges, torus.n_faces, torus.genus
        (4, 12, 8, 1)
        """
        lengths, twin = squares(gluing, n)
        K = cls(**assembled(lengths, twin, np.zeros(twin.shape, dtype=bool)))
        diagonal = (K.lengths > 1.2 / n).astype(np.int64)
        squared = [root_of(Fraction(1, n * n)), root_of(Fraction(2, n * n))]
        return replace(K, exact_lengths=by_kind(K.edge, diagonal, squared))

    @classmethod
    def from_polygons(
        cls, polygons: Iterable[Any], gluing: Iterable[Any], *, edges: bool = False
    ) -> DeltaComplex:
        """Glue polygons of the plane along their sides, by rotations and translations.

        Parameters
        ----------
        polygons : iterable of lists of points
            The vertices of each simple polygon, convex or not: complex numbers or pairs (x, y) of
            what :mod:`igl_periods.complexes.number_readers` reads.  Clockwise ones are turned
            round: side k is the one from vertex k to k + 1 as they were listed.
        gluing : iterable of ((polygon, side), (polygon, side))
        edges : bool
            The points are not vertices but the sides, as vectors one after the other.

        Raises
        ------
        ComplexError
            If a polygon crosses or touches itself, has no area or does not close; a side is glued
            twice, to itself, or not at all; glued sides have different lengths (exactly; by more
            than 1e-9, relative, where coordinates are doubles); the surface is not connected.

        Examples
        --------
        >>> from igl_periods import algebraic_number
        >>> t = algebraic_number([-1, -1, 1], 1.6)
        >>> L = DeltaComplex.from_polygons(
        ...     [[0, 1, t, (t, 1), (1, 1), (1, t), (0, t), (0, 1)]],
        ...     [((0, 0), (0, 5)), ((0, 1), (0, 3)), ((0, 2), (0, 7)), ((0, 4), (0, 6))])
        >>> L.genus
        2
        """
        glued, lengths, twin = glued_polygons(polygons, gluing, edges)
        K = cls(**assembled(lengths, twin, np.zeros(twin.shape, dtype=bool)), polygons=glued)
        return replace(K, exact_lengths=lengths_of_polygons(glued, K.edge))

    @classmethod
    def from_json(cls, text: str | Mapping[str, Any]) -> DeltaComplex:
        """Read a surface that :meth:`to_json` wrote, or any ``{"lengths": …, "twin": …}``.

        Raises
        ------
        MeshError
            If the text is no JSON of that form.
        ComplexError
            If the gluing is none.
        """
        return surface_in_document(cls, text)

    def to_json(self) -> str:
        """Write the gluing, with exact lengths and polygons, as JSON text.

        Exact numbers are strings; numbers that are functions of the precision are balls of 200
        digits.
        """
        return json.dumps(document_of(self))

    @property
    def n_faces(self) -> int:
        """Number of triangles."""
        return len(self.lengths)

    @property
    def euler_characteristic(self) -> int:
        """V − E + F."""
        return self.n_vertices - self.n_edges + self.n_faces

    @property
    def n_boundary_edges(self) -> int:
        """Number of sides that are glued to nothing."""
        return int(np.count_nonzero(self.twin < 0))

    @property
    def n_reversing_edges(self) -> int:
        """Number of edges across which the orientations of the two faces disagree."""
        return int(np.count_nonzero(reversing_sides(self.twin, self.sign))) // 2

    @property
    def genus(self) -> int:
        """Genus of a closed, oriented, connected complex (others raise, :func:`check_surface`)."""
        check_surface(self)
        return (2 - self.euler_characteristic) // 2

    def components(self) -> list[DeltaComplex]:
        """The connected components, in the order of their first faces."""
        return parts_of(self)


def _from_simplicial(lengths: Floats, faces: Ints, positions: Floats | None) -> DeltaComplex:
    labels, corner_vertex = compressed(faces)
    twin, same = twins_of_faces(corner_vertex, labels)
    check_fans(twin, same, corner_vertex, labels)
    K = DeltaComplex(**assembled(lengths, twin, same, corner_vertex))
    return replace(K, labels=labels, positions=None if positions is None else positions[labels])


def _quotient(V: Floats, F: Ints, lattice: ArrayLike, tolerance: float) -> DeltaComplex:
    glued = lattice_gluing(V, F, lattice, tolerance)
    logger.info("the lattice glued %d edges, gap %.2g", glued.n_glued, glued.gap)
    K = DeltaComplex(**assembled(glued.lengths, glued.twin, glued.same))
    labels = np.full(K.n_vertices, len(V), dtype=np.int64)
    np.minimum.at(labels, K.corner_vertex, F)
    return replace(K, labels=labels, cell=glued.cell)
