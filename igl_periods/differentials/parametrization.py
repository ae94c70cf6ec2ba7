r"""Global conformal parametrization: a surface in the plane by the integral of a holomorphic form.

A holomorphic differential ζ makes a surface flat: z = ∫ζ maps it to the plane, conformally, but
for 2g − 2 zeros of ζ (counted with multiplicity) and up to the periods of ζ.  Cut to a disk, the
surface has a map to the plane, and the two sides of each cut differ by a translation, the period
of ζ along a loop that crosses there.

The discrete ζ is closed, so that all of this holds exactly; z is linear on every triangle, and
conformal up to the error of discretisation.  With

.. math:: \mathrm{index}(v) = \frac{\Theta_v}{2\pi} - 1,

Θ_v the sum of the *signed* angles at v of the image triangles, the index is an integer: the order
of the zero at v, negative where triangles fold over.  Every image triangle has the angle sum π, or
−π if its orientation is reversed; summed up over all m faces and n vertices, 2n − m = 4 − 4g,

.. math:: \#\{\text{reversed faces}\} + \sum_v \mathrm{index}(v) = 2g - 2 .

References
----------
Gu, Yau, "Global conformal surface parameterization" (2003).
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 1.
Erickson, Har-Peled, "Optimally cutting a surface into a disk" (2004).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Bools, Complexes, Floats, Ints, ReadOnlyArrays
from igl_periods.complexes import DeltaComplex, along_sides, checked_array, primitive
from igl_periods.display import facts_html
from igl_periods.errors import ComplexError
from igl_periods.harmonic import linear_parts
from igl_periods.options import in_words
from igl_periods.periods import PeriodMatrix, check_period_matrix
from igl_periods.run_log import stage
from igl_periods.topology import cut_to_disk

from .normalised import normalised_differentials


@dataclass(frozen=True, eq=False)
class Parametrization(ReadOnlyArrays):
    """A surface cut to a disk and mapped to the plane by z = ∫ζ.

    Attributes
    ----------
    complex : DeltaComplex
        The surface as it was given.
    form : (n_edges,) complex
        The differential ζ along the edges.
    periods : (2g,) complex
        Its periods along a_1..a_g, b_1..b_g.
    cut : (m, 3) bool
        The sides along which the surface is cut.
    corner : (m, 3) int
        The vertex of the cut surface at each corner.
    vertex : (n,) int
        The vertex of ``complex`` that each vertex of the cut surface is a copy of.
    uv : (n,) complex
        z at the vertices of the cut surface; 0 at vertex 0.
    seams : (k,) int
        The half-edges ``3 f + s`` at which the surface is cut, one of each pair.
    crossings : (k, 2g) int
        Periods of the marking along the loop that goes through the disk from the face of the
        half-edge twinned to each seam to its own face, and closes across the seam.
    """

    complex: DeltaComplex
    form: Complexes
    periods: Complexes
    cut: Bools
    corner: Ints
    vertex: Ints
    uv: Complexes
    seams: Ints
    crossings: Ints

    def __repr__(self) -> str:
        return (
            f"Parametrization(genus {self.periods.size // 2}, {self.cut.shape[0]} faces, "
            f"{self.uv.size} vertices of the disk, cut along {self.seams.size} edges)"
        )

    def _repr_html_(self) -> str:
        index, (median, tail) = self.index, np.percentile(self.dilatation, [50.0, 99.0])
        facts = [
            ("genus", str(self.periods.size // 2)),
            ("faces", str(self.cut.shape[0])),
            ("vertices of the disk", str(self.uv.size)),
            ("cut along", f"{self.seams.size} edges"),
            ("zeros", f"{np.count_nonzero(index > 0)}, of orders {index[index > 0].sum()} in all"),
            ("reversed faces", str(np.count_nonzero(self.reversed_faces))),
            ("dilatation", f"{median:.4g} in the median, {tail:.4g} at the 99th percentile"),
        ]
        return facts_html("Parametrization z = ∫ζ", facts)

    @property
    def corner_uv(self) -> Complexes:
        """Z at the corners of all faces; (m, 3)."""
        return self.uv[self.corner]

    @property
    def seam_jumps(self) -> Complexes:
        """By how much z differs across each seam, a sum of periods of ζ; (k,).

        It is z at the seam as seen from its own face, minus that seen from the face across.
        """
        return self.crossings @ self.periods

    @property
    def reversed_faces(self) -> Bools:
        """Mask of the faces whose image has the reversed orientation; (m,)."""
        return self._signed_angles().sum(axis=1) < 0.0

    @property
    def index(self) -> Ints:
        """Θ_v / 2π − 1 for every vertex, the order of the zero there; (n_vertices,)."""
        K = self.complex
        theta = np.bincount(K.corner_vertex.ravel(), self._signed_angles().ravel(), K.n_vertices)
        return np.rint(theta / (2.0 * np.pi)).astype(np.int64) - 1

    @property
    def dilatation(self) -> Floats:
        """Ratio of the singular values of z on each face, ≥ 1, and 1 iff it is conformal; (m,)."""
        p, q = linear_parts(self.complex, self.form)
        large, small = np.abs(p) + np.abs(q), np.abs(np.abs(p) - np.abs(q))
        return np.divide(large, small, out=np.full_like(large, np.inf), where=small > 0.0)

    @property
    def density(self) -> Floats:
        """The energy density |ζ|² of each face, |p|² + |q|² where ζ = p dz + q dz̄; (m,)."""
        p, q = linear_parts(self.complex, self.form)
        return np.abs(p) ** 2 + np.abs(q) ** 2

    def _signed_angles(self) -> Floats:
        """Angles of the image triangles, negative on reversed ones; (m, 3)."""
        sides = along_sides(self.complex, np.where(self.form == 0.0, 1e-200, self.form))
        # From corner c side c + 2 leads to corner c + 1, and side c + 1 comes from corner c + 2.
        onwards, back = np.roll(sides, 1, axis=1), -np.roll(sides, -1, axis=1)
        return np.angle(back / onwards)


def parametrize(pm: PeriodMatrix, coefficients: ArrayLike) -> Parametrization:
    """The map z = ∫ζ of a surface, cut to a disk, by a holomorphic differential.

    Parameters
    ----------
    pm : PeriodMatrix
        Of a triangle mesh; its marking is that of the coefficients.
    coefficients : (g,) array-like of complex
        The differential is ζ = Σ_k coefficients[k] ζ_k, in the normalised basis.

    Raises
    ------
    ValueError
        If the number of coefficients is not g, or all are 0 or one is not finite.
    ComplexError
        If the surface is a sphere, on which no holomorphic differential lives, or the triangles
        are so thin that their Laplacian is singular to rounding.

    Examples
    --------
    >>> import igl_periods as ip
    >>> V, F = ip.surfaces.torus_of_revolution(2.0, 1.0, 12, 8)
    >>> pm = ip.period_matrix(V, F)
    >>> ip.parametrize(pm, [1.0])
    Parametrization(genus 1, 192 faces, 117 vertices of the disk, cut along 20 edges)
    """
    s = checked_coefficients(pm, coefficients)
    K = pm.complex
    form = s @ normalised_differentials(pm)
    with stage("cutting to a disk"):
        cut, corner, vertex = cut_to_disk(K)
    uv = primitive(corner, along_sides(K, form))
    seams = np.flatnonzero(cut.ravel() & (np.arange(cut.size) < K.twin.ravel()))
    return Parametrization(
        complex=K,
        form=form,
        periods=np.concatenate([s, s @ pm.matrix]),
        cut=cut,
        corner=corner,
        vertex=vertex,
        uv=uv,
        seams=seams,
        crossings=_crossings(pm, corner, seams),
    )


def checked_coefficients(pm: PeriodMatrix, coefficients: ArrayLike) -> Complexes:
    """Coefficients as a complex array of shape (g,), finite, not all 0, or an error."""
    check_period_matrix(pm)
    if pm.genus == 0:
        raise ComplexError("the surface is a sphere (genus 0): it has no holomorphic differential.")
    given = checked_array(coefficients, "coefficients", ValueError)
    if given.dtype.kind not in "iufc":
        raise ValueError(f"coefficients must be complex numbers, not {in_words(coefficients)}.")
    s = np.atleast_1d(given.astype(np.complex128))
    if s.shape != (pm.genus,) or not np.isfinite(s).all() or not s.any():
        raise ValueError(
            f"coefficients must be {pm.genus} finite numbers, one for each ζ_k and not all 0, not "
            f"{np.asarray(coefficients).tolist()}."
        )
    return s


def _crossings(pm: PeriodMatrix, corner: Ints, seams: Ints) -> Ints:
    """Jumps of the integer cocycles' integrals across the seams; (k, 2g)."""
    K = pm.complex
    sides = along_sides(K, pm.cocycles.toarray())
    integrals = primitive(corner, np.moveaxis(sides, 0, -1))
    # Where a seam starts, its twin ends.
    here = np.roll(corner, -1, axis=1).ravel()[seams]
    there = np.roll(corner, 1, axis=1).ravel()[K.twin.ravel()[seams]]
    return np.asarray(np.rint(integrals[here] - integrals[there]), dtype=np.int64)
