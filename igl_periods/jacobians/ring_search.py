"""The ring of endomorphisms of whatever a period matrix is known by."""

from __future__ import annotations

import math
from typing import Any

import flint
import numpy as np
from numpy.typing import ArrayLike

from igl_periods.arrays import Ints
from igl_periods.enclosures import PeriodEnclosure, enclose
from igl_periods.siegel import balls_of, bits_of, check_siegel_point, siegel_reduce, to_flint
from igl_periods.symplectic import form_action, unimodular_inverse

from .commuting_matrices import commuting_matrices
from .endomorphism_ring import EndomorphismRing, RingEvidence, closed_ring
from .integer_lattices import MatrixLattice
from .rational_representation import in_first_marking

LARGEST_GENUS = 7
"""LLL on 4g² unknowns: seconds at genus 5, minutes at genus 7."""

_LOG10_2 = math.log10(2.0)
# What a plain array, or a period matrix without a certificate, is taken to be right to.
_ARRAY_ERROR = 1e-12


def endomorphisms(
    Pi: ArrayLike | PeriodEnclosure | flint.acb_mat,
    *,
    check_digits: int | None = None,
    max_genus: int = LARGEST_GENUS,
) -> EndomorphismRing:
    """Find the ring of endomorphisms of a Jacobian.

    Parameters
    ----------
    Pi : PeriodEnclosure, acb_mat, PeriodMatrix or (g, g) array-like
        An array, or a matrix without a certificate, is taken to be right to 1e-12.
    check_digits : int, optional
        Of a PeriodEnclosure: enclose its surface again with so many digits, and check all
        endomorphisms there.
    max_genus : int
        The largest genus that is tried: seconds at genus 4, minutes at 6 and 7.

    Returns
    -------
    EndomorphismRing
        Recognised, not proved.  What is proved is in its ``evidence.excluded``: that there are no
        other endomorphisms below some size.

    Raises
    ------
    NotASiegelPointError
        If Π is not a point of the Siegel upper half-space.
    ValueError
        If too few digits are known, the genus is 0 or above ``max_genus``, digits are to be checked
        of anything but a PeriodEnclosure, or the check excludes an endomorphism.

    References
    ----------
    Costa, Mascot, Sijsling, Voight, "Rigorous computation of the endomorphism ring of a Jacobian"
    (2019).

    Examples
    --------
    >>> ring = endomorphisms([[1j]])
    >>> ring.rank, ring.name, ring.discriminant
    (2, 'Q(i)', -4)
    """
    if check_digits is not None and not isinstance(Pi, PeriodEnclosure):
        raise ValueError("check_digits needs a PeriodEnclosure: only its surface can give more")
    g = len(check_siegel_point(Pi))
    if not 1 <= g <= max_genus:
        raise ValueError(
            f"endomorphisms are searched for from genus 1 to {max_genus}, not {g}: the time grows "
            f"like a high power of g. max_genus={g} does it nevertheless"
        )
    balls = _balls(Pi)
    bits = bits_of(Pi) if balls_of(Pi) is not None else bits_of(balls)
    with flint.ctx.workprec(bits):
        ring = _searched(balls, bits)
    return ring if check_digits is None else _rechecked(ring, Pi, check_digits)


def _balls(Pi: Any) -> flint.acb_mat:
    known = balls_of(Pi)
    if known is not None:
        return known
    if getattr(Pi, "bound", None) is not None:
        return to_flint(Pi)
    matrix = check_siegel_point(Pi)
    error = flint.arb(0, _ARRAY_ERROR * max(1.0, float(np.abs(matrix).max())))
    return flint.acb_mat(
        [[flint.acb(z) + flint.acb(error, error) for z in row] for row in matrix.tolist()]
    )


def _searched(Pi: flint.acb_mat, bits: int) -> EndomorphismRing:
    reduced = siegel_reduce(Pi)
    known = known_bits(reduced.matrix, bits)
    found = commuting_matrices(reduced.matrix, known)
    N_inverse = [in_first_marking(M, reduced.gamma) for M in found.basis]
    lattice = closed_ring(np.stack(N_inverse)) if len(N_inverse) else _scalars(Pi.nrows())
    digits = _LOG10_2 * known_bits(Pi, bits)
    evidence = RingEvidence(
        _LOG10_2 * found.bits, digits, found.left_over, found.random_height, found.excluded
    )
    return EndomorphismRing(lattice, Pi, bits, evidence).checked(Pi, bits, digits)


def _scalars(g: int) -> MatrixLattice:
    return MatrixLattice(np.eye(2 * g, dtype=np.int64)[None].copy())


def known_bits(Pi: flint.acb_mat, bits: int) -> int:
    """What is known of the entries of a matrix of balls, relative to the largest one, in bits."""
    radius = max(max(z.real.rad(), z.imag.rad()) for z in Pi.entries())
    size = max(z.mid().abs_upper() for z in Pi.entries())
    if radius == 0:
        return bits
    return min(bits, int(float((size / radius).log() / flint.arb(2).log())))


def _rechecked(ring: EndomorphismRing, first: Any, digits: int) -> EndomorphismRing:
    again = in_marking_of(enclose(first.complex, digits=digits), first)
    return ring.checked(again.matrix, again.bits, float(again.digits))


def in_marking_of(again: PeriodEnclosure, first: PeriodEnclosure) -> PeriodEnclosure:
    """An enclosure of the same surface in the marking of another one.

    The cochains of both are integer combinations of each other, up to coboundaries of none: an
    enclosure is made in the marking of the complex, and changes of it act on the same cochains.
    """
    if (again.cocycles != first.cocycles).nnz == 0:
        return again
    U = _integer_change(again.cocycles.toarray(), first.cocycles.toarray())
    return again.change_basis(form_action(U))


def _integer_change(basis: Ints, other: Ints) -> Ints:
    """The integer U with U · basis = other."""
    solution = np.linalg.lstsq(basis.T.astype(np.float64), other.T.astype(np.float64), rcond=None)[
        0
    ]
    U = np.rint(solution.T).astype(np.int64)
    if not np.array_equal(U @ basis, other):
        raise ValueError("the two enclosures do not have the same cochains up to a change of basis")
    unimodular_inverse(U)
    return U
