r"""Koebe's slit domains with a normalisation at points: slit planes and slit discs.

==========================  ==================================================  ==================
map                         normalisation                                       loops become
==========================  ==================================================  ==================
``parallel_slit_plane``     :math:`w = 1/(z - a) + 0 + O(z - a)`                segments of one
                                                                                direction
``circular_slit_plane``     w(a) = 0, :math:`w = 1/(z - b) + O(1)`              arcs around 0
``radial_slit_plane``       the same                                            pieces of rays
``circular_slit_disc``      w(a) = 0, w'(a) > 0, C_1 the unit circle            arcs around 0
``radial_slit_disc``        the same                                            pieces of rays
==========================  ==================================================  ==================

Each of them is unique.  w, or log w, is a function with a pole or with logarithms whose real or
imaginary part is constant on every loop (:mod:`~igl_periods.domains.functions_with_poles`).  Of all
univalent functions with the normalisation the parallel one, of the angle θ, has the largest
:math:`\operatorname{Re} e^{-2i\theta} c_1`, :math:`w = 1/(z-a) + c_1 (z - a) + …`, and

.. math:: w_\theta = e^{i\theta} (\cos\theta\, w_0 - i \sin\theta\, w_{\pi/2}).

References
----------
Nehari, "Conformal mapping" (1952), chapter VII.
Koebe, "Abhandlungen zur Theorie der konformen Abbildung IV", Acta Math. 41 (1918).
"""

from __future__ import annotations

import numpy as np

from igl_periods.arrays import Complexes
from igl_periods.complexes import DeltaComplex, of_a_surface

from .boundary_classes import boundary_loops
from .functions_with_poles import Singularity, function_with_poles
from .slit_maps import SlitMap, check_planar


@of_a_surface
def parallel_slit_plane(
    K: DeltaComplex, pole: complex, *, angle: float = 0.0, degree: int = 6
) -> SlitMap:
    """Map a domain onto the plane with parallel slits.

    Parameters
    ----------
    K : surface
        A mesh in the plane, counterclockwise, with one boundary loop at least.
    pole : complex
        The point a of the domain that goes to infinity.
    angle : float
        The direction of the slits against the real axis.
    degree : int
        Degree of the trial functions.

    Returns
    -------
    SlitMap

    Raises
    ------
    ComplexError
        If the surface has handles, is not in the plane, oriented and connected, or the point is not
        inside, or too close to the boundary for the mesh.
    """
    loops = boundary_loops(K)
    check_planar(K, loops)
    turn = np.exp(-1j * angle)
    part = Singularity(complex(pole), complex(turn), logarithm=False)
    f, (at_pole,) = function_with_poles(K, loops, [part], [False] * len(loops), degree)
    z = _points(K)
    with np.errstate(divide="ignore", invalid="ignore"):
        w = 1 / (z - pole) + (f - at_pole) / turn
    return SlitMap(np.where(z == pole, np.inf, w), K, loops, polar=False, is_bounded=False)


@of_a_surface
def circular_slit_plane(
    K: DeltaComplex, zero: complex, pole: complex, *, degree: int = 6
) -> SlitMap:
    """Map a domain onto the plane with slits along circles around 0.

    Parameters
    ----------
    K, degree
        As for :func:`parallel_slit_plane`.
    zero, pole : complex
        The points of the domain that go to 0 and to infinity.

    Raises
    ------
    ComplexError
        As for :func:`parallel_slit_plane`.
    """
    return _slit_plane(K, complex(zero), complex(pole), True, degree)


@of_a_surface
def radial_slit_plane(K: DeltaComplex, zero: complex, pole: complex, *, degree: int = 6) -> SlitMap:
    """Map a domain onto the plane with slits along rays from 0.

    Parameters, Raises
        As for :func:`circular_slit_plane`.
    """
    return _slit_plane(K, complex(zero), complex(pole), False, degree)


@of_a_surface
def circular_slit_disc(K: DeltaComplex, zero: complex, *, degree: int = 6) -> SlitMap:
    """Map a domain onto the unit disc with slits along circles around 0.

    The first loop becomes the unit circle.

    Parameters
    ----------
    K, degree
        As for :func:`parallel_slit_plane`.
    zero : complex
        The point a of the domain that goes to 0; the derivative is positive there.

    Raises
    ------
    ComplexError
        As for :func:`parallel_slit_plane`.
    """
    return _slit_disc(K, complex(zero), True, degree)


@of_a_surface
def radial_slit_disc(K: DeltaComplex, zero: complex, *, degree: int = 6) -> SlitMap:
    """Map a domain onto the unit disc with slits along rays from 0.

    Parameters, Raises
        As for :func:`circular_slit_disc`.
    """
    return _slit_disc(K, complex(zero), False, degree)


def _slit_plane(
    K: DeltaComplex, zero: complex, pole: complex, circular: bool, degree: int
) -> SlitMap:
    loops = boundary_loops(K)
    check_planar(K, loops)
    parts = [Singularity(zero, 1.0, logarithm=True), Singularity(pole, -1.0, logarithm=True)]
    f, (_, at_pole) = function_with_poles(K, loops, parts, [circular] * len(loops), degree)
    z = _points(K)
    # Near the pole w is (b − a) e^{f(b)} / (z − b).
    with np.errstate(divide="ignore", invalid="ignore"):
        w = (z - zero) / (z - pole) * np.exp(f - at_pole) / (pole - zero)
    return SlitMap(np.where(z == pole, np.inf, w), K, loops, polar=True, is_bounded=False)


def _slit_disc(K: DeltaComplex, zero: complex, circular: bool, degree: int) -> SlitMap:
    loops = boundary_loops(K)
    check_planar(K, loops)
    real = [True, *[circular] * (len(loops) - 1)]
    part = Singularity(zero, 1.0, logarithm=True)
    f, (at_zero,) = function_with_poles(K, loops, [part], real, degree)
    w = (_points(K) - zero) * np.exp(f - 1j * at_zero.imag)
    # |w| = 1 on the first loop.
    return SlitMap(w / np.abs(w[loops[0].vertices[0]]), K, loops, polar=True)


def _points(K: DeltaComplex) -> Complexes:
    assert K.positions is not None
    return np.asarray(K.positions[:, 0] + 1j * K.positions[:, 1])
