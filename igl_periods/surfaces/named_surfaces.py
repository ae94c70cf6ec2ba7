r"""Named surfaces with exact period matrices.

An entry stands for a Riemann surface and lists all the names under which it occurs.  Beside single
surfaces there are three families in every genus,

* the curves y² = xⁿ − 1, of genus g = ⌊(n − 1)/2⌋; for odd n they are regular 2n-gons with
  opposite sides glued, and two regular n-gons glued along parallel sides;
* the curves y² = x^{2g+1} − x, the regular 4g-gons with opposite sides glued;
* Lawson's minimal surfaces ξ_{m,k}, of genus mk; ξ_{m,1} is y² = x^{2m+2} − 1.

The rotation x ↦ ζx, ζ = e^{2πi/n}, of y² = xⁿ − 1 moves a closed curve round two neighbouring
branch points to the next one; 2g of these curves c_0, …, c_{2g−1} are a basis of homology with
c_k · c_{k+1} = 1 and no other intersections, and the form x^{j−1} dx/y, multiplied by ζ^j under the
rotation, has the periods const · ζ^{jk}.  So Π = A⁻¹B follows without any integral.  The 2g sides
c_k of a 4g-gon, with c_i · c_k = 1 for i < k, are a basis too, and the rotation by 2π/4g = 2π/m
takes c_k to c_{k+1}, so that the periods of the g forms are exp(2πi (2j − 1) k / m).

References
----------
Bobenko, Mercat, Schmies, "Period matrices of polyhedral surfaces", section 4.
Bujalance, Costa, Gamboa, Riera, "Period matrices of Accola-Maclachlan and Kulkarni surfaces"
(2000).
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import flint
import numpy as np

from igl_periods.arrays import Complexes, Ints
from igl_periods.options import checked_integer
from igl_periods.symplectic import integer_symplectic_basis

from . import exact_matrices as exact
from .named_surface import NamedSurface

_LARGEST_GENUS = 1_000_000


def catalogue(genus: int | None = None) -> list[NamedSurface]:
    """Named surfaces, no two of them conformally equivalent.

    Parameters
    ----------
    genus : int, optional
        All of this genus; by default all up to genus 4, beyond which there are only those of the
        three families.

    Raises
    ------
    ValueError
        If the genus is not an integer, negative, or beyond a million.

    Examples
    --------
    >>> len(catalogue())
    21
    >>> [surface.name for surface in catalogue(2)][:3]
    ['Omega_1', 'golden L', 'L(3/2)']
    """
    if genus is None:
        largest = max(surface.genus for surface in _SINGLE)
        return [surface for g in range(1, largest + 1) for surface in catalogue(g)]
    genus = checked_integer("genus", genus)
    if not 0 <= genus <= _LARGEST_GENUS:
        raise ValueError(f"genus = {genus}: surfaces of genus 0 to {_LARGEST_GENUS} have names.")
    single = [surface for surface in _SINGLE if surface.genus == genus]
    return single + list(_families(genus))


def binomial_period_matrix(n: int) -> Complexes:
    """The period matrix of y² = xⁿ − 1, of genus ⌊(n − 1)/2⌋.

    Raises
    ------
    ValueError
        If n < 3.

    Examples
    --------
    >>> binomial_period_matrix(4).round(12)
    array([[0.+1.j]])
    """
    if n < 3:
        raise ValueError(f"y^2 = x^{n} - 1 is rational: take n >= 3")
    g = (n - 1) // 2
    exponents = np.outer(np.arange(1, g + 1), np.arange(2 * g))
    periods = np.exp(2j * np.pi * (exponents % n) / n)
    a, b = np.hsplit(periods @ _binomial_basis(g).T, 2)
    Pi = np.asarray(np.linalg.solve(a, b), dtype=np.complex128)
    return 0.5 * (Pi + Pi.T)


def _binomial_basis(g: int) -> Ints:
    """A canonical basis in terms of the curves c_0, …, c_{2g−1}."""
    intersections = np.eye(2 * g, k=1, dtype=np.int64) - np.eye(2 * g, k=-1, dtype=np.int64)
    return integer_symplectic_basis(intersections).astype(np.int64)


def _binomial_balls(n: int) -> flint.acb_mat:
    """The same as :func:`binomial_period_matrix` in balls."""
    return exact.binomial(n, _binomial_basis((n - 1) // 2))


def _families(genus: int) -> Iterator[NamedSurface]:
    if genus >= 3:
        yield _regular_polygon(genus)
    if genus >= 2:
        yield _binomial(2 * genus + 1)
        yield _binomial(2 * genus + 2)
    for k in range(2, genus + 1):
        if genus % k == 0 and genus // k >= k:
            yield _lawson(genus // k, k)


def _binomial(n: int) -> NamedSurface:
    genus, equation = (n - 1) // 2, f"y^2 = x^{n} - 1"
    polygons = [f"regular {2 * n}-gon", f"double {n}-gon"]
    names = [equation, *polygons] if n % 2 else [f"Lawson xi_{{{genus},1}}", equation]
    if n == 6:
        names += ["Omega_3", "six-square surface {4,6}"]
    return NamedSurface(
        names[0],
        tuple(names[1:]),
        genus,
        "periods are powers of roots of unity; Bujalance, Costa, Gamboa, Riera (2000)",
        partial(binomial_period_matrix, n),
        partial(_binomial_balls, n),
    )


def polygon_period_matrix(genus: int) -> Complexes:
    """The period matrix of y² = x^{2g+1} − x, the regular 4g-gon with opposite sides glued.

    Raises
    ------
    ValueError
        If the genus is less than 1.

    Examples
    --------
    >>> polygon_period_matrix(1).round(12)
    array([[0.+1.j]])
    """
    if genus < 1:
        raise ValueError(f"genus = {genus}: a 4g-gon has a genus g >= 1")
    odd = 2 * np.arange(1, genus + 1) - 1
    periods = np.exp(2j * np.pi * np.outer(odd, np.arange(2 * genus)) / (4 * genus))
    a, b = np.hsplit(periods @ _polygon_basis(genus).T, 2)
    Pi = np.asarray(np.linalg.solve(a, b), dtype=np.complex128)
    return 0.5 * (Pi + Pi.T)


def _polygon_basis(g: int) -> Ints:
    """A canonical basis in terms of the sides c_0, …, c_{2g−1} of the 4g-gon."""
    upper = np.triu(np.ones((2 * g, 2 * g), dtype=np.int64), 1)
    return integer_symplectic_basis(upper - upper.T).astype(np.int64)


def _polygon_balls(genus: int) -> flint.acb_mat:
    """The same as :func:`polygon_period_matrix` in balls."""
    return exact.polygon(genus, _polygon_basis(genus))


def _regular_polygon(genus: int) -> NamedSurface:
    return NamedSurface(
        f"y^2 = x^{2 * genus + 1} - x",
        (f"regular {4 * genus}-gon",),
        genus,
        "periods are powers of roots of unity; Veech (1989) for the polygons",
        partial(polygon_period_matrix, genus),
        partial(_polygon_balls, genus),
    )


def _lawson(m: int, k: int) -> NamedSurface:
    curve = f"y^{k + 1} = (x^{m + 1} - 1)/(x^{m + 1} + 1)"
    source = "periods as beta and hypergeometric functions; Lawson (1970) for the surface"
    return NamedSurface(
        f"Lawson xi_{{{m},{k}}}",
        (curve,),
        m * k,
        source,
        partial(_exact_lawson, m, k),
        partial(_lawson_balls, m, k),
    )


# Functions of the module, which can be pickled; what they import is slow, and seldom needed.


def _exact_lawson(m: int, k: int) -> Complexes:
    from .lawson.periods import lawson_period_matrix

    return lawson_period_matrix(m, k)


def _lawson_balls(m: int, k: int) -> flint.acb_mat:
    from .lawson.periods import lawson_period_matrix_in_balls

    return lawson_period_matrix_in_balls(m, k)


def _l_shape(x: float) -> Complexes:
    a, b = 2 * x * x - 2 * x + 1, -2 * x * (x - 1)
    return 1j / (2 * x - 1) * np.array([[a, b], [b, a]])


def _square_tiled(name: str) -> Complexes:
    from .square_tiled import square_tiled_period_matrix

    return square_tiled_period_matrix(name)


def _regular_map(name: str) -> Complexes:
    from .regular_maps import regular_map_period_matrix

    return regular_map_period_matrix(name)


def _wente() -> Complexes:
    from .wente import wente_modulus

    return np.array([[wente_modulus()]])


_SINGLE = (
    NamedSurface(
        "square torus",
        ("y^2 = x^3 - x", "y^2 = x^4 - 1", "Clifford torus", "Lawson xi_{1,1}"),
        1,
        "tau = i",
        partial(np.array, [[1j]]),
        exact.square_torus,
    ),
    NamedSurface(
        "hexagonal torus",
        ("y^2 = x^3 - 1", "y^2 = x^3 + 1", "Fermat cubic"),
        1,
        "tau = exp(i pi/3)",
        partial(np.array, [[0.5 + 0.5j * np.sqrt(3)]]),
        exact.hexagonal_torus,
    ),
    NamedSurface(
        "Wente torus",
        ("three-lobed torus of constant mean curvature",),
        1,
        "elliptic integrals; Abresch (1987), Walter (1987)",
        _wente,
    ),
    NamedSurface(
        "Omega_1",
        ("L-shaped origami of three squares", "L(2)", "y^2 = 3 x^5 + 7 x^3 + 4 x"),
        2,
        "Bobenko, Mercat, Schmies, section 4.1, after Silhol",
        partial(_square_tiled, "omega_1"),
        exact.omega_1,
    ),
    NamedSurface(
        "golden L",
        ("L((1 + sqrt 5)/2)", "y^2 = x^5 + 5 x^3 + 5 x"),
        2,
        "closed form of L(x), a unit square with arms x - 1; McMullen (2003) for the surface",
        partial(_l_shape, (1.0 + 5.0**0.5) / 2.0),
        exact.golden_l,
    ),
    NamedSurface(
        "L(3/2)",
        ("y^2 = x^6 + c x^4 + c x^2 + 1, c = 33 (4 + 3 sqrt 2)/8",),
        2,
        "closed form of L(x), a unit square with arms x - 1",
        partial(_l_shape, 1.5),
        partial(exact.rational_l, 3, 2),
    ),
    NamedSurface(
        "L(3)",
        ("L-shaped origami of five squares", "y^2 = 135 x^5 + 161 x^3 + 48 x"),
        2,
        "closed form of L(x), a unit square with arms x - 1",
        partial(_l_shape, 3.0),
        partial(exact.rational_l, 3, 1),
    ),
    NamedSurface(
        "Bolza curve",
        (
            "y^2 = x^5 - x",
            "Omega_2",
            "regular map {3,8} of genus 2",
            "four-square surface {4,8}",
            "regular 8-gon",
        ),
        2,
        "Bobenko, Mercat, Schmies, section 4.1, after Silhol; Bolza (1887)",
        partial(_square_tiled, "omega_2"),
        exact.bolza,
    ),
    NamedSurface(
        "Klein quartic",
        ("x^3 y + y^3 z + z^3 x = 0", "regular map {3,7}", "Hurwitz surface of genus 3"),
        3,
        "Braden, Northover (2010)",
        partial(_regular_map, "klein"),
        exact.klein,
    ),
    NamedSurface(
        "Fermat quartic",
        (
            "x^4 + y^4 + z^4 = 0",
            "Dyck surface",
            "regular map {3,8} of genus 3",
            "quaternion origami",
            "surface of the period matrix (1 + i)/2 [[2, 1, 1], [1, 2, 1], [1, 1, 2]]",
            "eierlegende Wollmilchsau",
        ),
        3,
        "Gaussian multiples of K(1/sqrt 2)/2; recognised in the periods of abelfunctions; "
        "Herrlich, Schmithüsen (2008) for the origami",
        partial(_regular_map, "fermat"),
        exact.fermat,
    ),
    NamedSurface(
        "Schwarz P and D surfaces and gyroid",
        ("y^2 = x^8 + 14 x^4 + 1", "Schwarz D surface", "gyroid", "regular map {4,6} of genus 3"),
        3,
        "Gauss-Chebyshev quadrature, 15 digits",
        partial(_regular_map, "schwarz_p"),
    ),
    NamedSurface(
        "Bring curve",
        ("sum x_i = sum x_i^2 = sum x_i^3 = 0", "regular map {4,5} of genus 4"),
        4,
        "Braden, Northover (2012), after Riera, Rodriguez (1992)",
        partial(_regular_map, "bring"),
        exact.bring,
    ),
)
