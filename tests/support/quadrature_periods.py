r"""Period matrices of cyclic covers yⁿ = ∏ (x − e_i)^{m_i} by quadrature; nothing of the library.

The x-sphere is triangulated: a Delaunay triangulation of the branch points and a polygon round
them, and ∞ joined to the polygon by rays.  No triangle has a branch point inside, so log(x − e_i)
has branches on it; n copies of it are glued where y continues.  The holomorphic forms

    ∏ (x − e_i)^{−{b m_i / n}} x^j dx,    0 < b < n,   0 ≤ j < Σ_i {b m_i / n} − 1,

({·} the fractional part) are integrated along the sides by Gauss–Jacobi rules that have the
singularities at both ends as weights.  That makes closed cochains; the integer cohomology of the
same complex comes from a tree and a cotree, and Π = A⁻¹B with A = ∫ ω ∧ β, B = −∫ ω ∧ α.

Checks on the way: cochains closed, number of forms = genus by Euler's formula, Π symmetric.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import eigh_tridiagonal
from scipy.spatial import Delaunay
from scipy.special import beta as euler_beta

NODES = 200
INFINITY = -1


@dataclass(frozen=True)
class Curve:
    n: int
    e: np.ndarray
    m: np.ndarray

    @property
    def forms(self):
        """Pairs (b, j); the fractional parts {b m_i / n} are exact integers over n."""
        pairs = []
        for b in range(1, self.n):
            total = int(np.sum(b * self.m % self.n))
            pairs += [(b, j) for j in range(self.e.size) if (j + 1) * self.n < total]
        return pairs


def period_matrix(n, branch_points, multiplicities=None):
    e = np.asarray(branch_points, dtype=complex)
    m = np.ones(e.size, dtype=int) if multiplicities is None else np.asarray(multiplicities)
    curve = Curve(n, e, m % n)
    points, triangles, centres = triangulation(e)
    logs = np.log(centres[:, None] - e)
    twin, change = gluing(curve, points, triangles, centres, logs)
    forms = side_integrals(curve, points, triangles, centres, logs)
    m_cover, cover_twin = n * len(triangles), lifted(twin, change, n)
    # On sheet k the form with character b is multiplied by exp(−2πi b k / n).
    b = np.array([b for b, _ in curve.forms])
    characters = np.exp(-2j * np.pi * np.outer(np.arange(n), b) / n)
    omega = (characters[:, None, :] * forms.reshape(1, -1, len(b))).reshape(-1, len(b))
    size = np.abs(omega).max()
    assert np.abs(omega + omega[cover_twin]).max() < 1e-12 * size
    assert np.abs(omega.reshape(m_cover, 3, -1).sum(axis=1)).max() < 1e-12 * size
    integer = cohomology(cover_twin)
    assert integer.shape[1] == 2 * len(b)
    T = symplectic_basis(np.rint(pairing(integer, integer)).astype(int))
    A, B = np.split(pairing(omega, integer @ T.T), 2, axis=1)[::-1]
    Pi = -np.linalg.solve(A, B)
    assert np.abs(Pi - Pi.T).max() < 1e-10 and np.linalg.eigvalsh(Pi.imag).min() > 0
    return 0.5 * (Pi + Pi.T)


def triangulation(e):
    """Points (branch points first), triangles counterclockwise, and a point inside each."""
    middle = e.mean()
    radius = 1.7 * np.abs(e - middle).max()
    polygon = middle + radius * np.exp(2j * np.pi * (np.arange(8) + 0.19) / 8)
    points = np.concatenate([e, polygon])
    finite = Delaunay(np.stack([points.real, points.imag], axis=1)).simplices
    a, b, c = points[finite.T]
    finite[((b - a).conj() * (c - a)).imag < 0] = finite[((b - a).conj() * (c - a)).imag < 0, ::-1]
    ring = e.size + np.arange(8)
    outer = np.stack([np.roll(ring, -1), ring, np.full(8, INFINITY)], axis=1)
    outside = middle + 1.5 * (polygon + np.roll(polygon, -1) - 2 * middle) / 2
    return (
        points,
        np.concatenate([finite, outer]),
        np.concatenate([points[finite].mean(1), outside]),
    )


def side_ends(triangles):
    """Start and end of side s, which runs from corner s + 1 to corner s + 2; (3 m,) each."""
    return np.roll(triangles, -1, 1).ravel(), np.roll(triangles, 1, 1).ravel()


def along(points, start, end, t):
    """Points of a side at 0 < t < 1, which may end at ∞."""
    middle = points[-8:].mean()
    if end == INFINITY:
        return middle + (points[start] - middle) / (1 - t)
    if start == INFINITY:
        return middle + (points[end] - middle) / t
    return points[start] + t * (points[end] - points[start])


def gluing(curve, points, triangles, centres, logs):
    """Twins of half-edges, and by how many sheets one moves across each."""
    start, end = side_ends(triangles)
    number = {(p, q): h for h, (p, q) in enumerate(zip(start, end, strict=True))}
    twin = np.array([number[q, p] for p, q in zip(start, end, strict=True)])
    change = np.zeros(twin.size, dtype=int)
    for h, other in enumerate(twin):
        x = along(points, start[h], end[h], 0.5)
        here, there = (
            logs[t] + np.log((x - curve.e) / (centres[t] - curve.e)) for t in (h // 3, other // 3)
        )
        change[h] = np.rint((here - there).imag / (2 * np.pi)) @ curve.m
    return twin, change % curve.n


def side_integrals(curve, points, triangles, centres, logs):
    """Integrals of the forms on sheet 0 along each side; (3 m, g)."""
    start, end = side_ends(triangles)
    values = np.zeros((start.size, len(curve.forms)), dtype=complex)
    for h, (p, q) in enumerate(zip(start, end, strict=True)):
        t = h // 3
        for f, (b, j) in enumerate(curve.forms):
            fraction = (b * curve.m % curve.n) / curve.n
            if p == INFINITY:
                values[h, f] = -to_infinity(curve, points, q, centres[t], logs[t], fraction, j)
            elif q == INFINITY:
                values[h, f] = to_infinity(curve, points, p, centres[t], logs[t], fraction, j)
            else:
                values[h, f] = straight(curve, points, p, q, centres[t], logs[t], fraction, j)
    return values


def straight(curve, points, p, q, centre, log, fraction, j):
    exponents = [-fraction[v] if v < curve.e.size else 0.0 for v in (p, q)]
    t, weight = gauss_jacobi(exponents[1], exponents[0])
    half = (points[q] - points[p]) / 2
    x = points[p] + half * (1 + t)
    away = x[:, None] - curve.e
    # The weight takes |1 + t|^… and |1 − t|^… out of the factors that vanish at the ends.
    if p < curve.e.size:
        away[:, p] = half
    if q < curve.e.size:
        away[:, q] = -half
    logarithms = log + np.log(away / (centre - curve.e))
    power = ((x - points[-8:].mean()) / abs(points[-1] - points[-8:].mean())) ** j
    return half * np.sum(weight * power * np.exp(-logarithms @ fraction))


def to_infinity(curve, points, p, centre, log, fraction, j):
    """Along x = middle + (p − middle)/s, 0 < s ≤ 1; the form is s^{Σ{·} − j − 2} × analytic."""
    middle = points[-8:].mean()
    ray = points[p] - middle
    exponent = fraction.sum() - j - 2
    node, weight = gauss_jacobi(0.0, exponent)
    s = (1 + node) / 2
    x = middle + ray / s
    logarithms = log + np.log((x[:, None] - curve.e) / (centre - curve.e)) + np.log(s)[:, None]
    power = (ray / abs(points[-1] - middle)) ** j
    return ray * power * np.sum(weight * np.exp(-logarithms @ fraction)) / 2 ** (exponent + 1)


@lru_cache
def gauss_jacobi(alpha, beta):
    """Nodes and weights for (1 − t)^α (1 + t)^β by Golub and Welsch (1969).

    scipy's roots_jacobi divides by zero where α + β = −1, and its weights are off by up to 1e-12.
    """
    k = np.arange(1, NODES)
    total = alpha + beta
    centre = np.zeros(NODES)
    centre[0] = (beta - alpha) / (total + 2)
    centre[1:] = (beta**2 - alpha**2) / ((2 * k + total) * (2 * k + total + 2))
    square = np.empty(NODES - 1)
    square[0] = 4 * (1 + alpha) * (1 + beta) / ((2 + total) ** 2 * (3 + total))
    k, twice = k[1:], 2 * k[1:] + total
    square[1:] = 4 * k * (k + alpha) * (k + beta) * (k + total)
    square[1:] /= twice**2 * (twice + 1) * (twice - 1)
    node, vector = eigh_tridiagonal(centre, np.sqrt(square))
    return node, 2 ** (total + 1) * euler_beta(alpha + 1, beta + 1) * vector[0] ** 2


def lifted(twin, change, n):
    sheet = np.arange(n)[:, None]
    return (twin + twin.size * ((sheet + change) % n)).ravel()


def cohomology(twin):
    """Closed integer cochains, a basis of cohomology, as values of half-edges; (3 m, 2g)."""
    half_edges = np.arange(twin.size)
    after = half_edges - half_edges % 3 + (half_edges + 1) % 3
    vertex = np.full(twin.size, -1)
    for start in half_edges:
        h, label = start, vertex.max() + 1
        while vertex[h] < 0:  # turn about the vertex at which the half-edge starts
            vertex[h], h = label, after[twin[h]]
    head = vertex[after]
    in_tree = np.zeros(twin.size, dtype=bool)
    reached, found = {int(vertex[0])}, [int(vertex[0])]
    for v in found:
        for h in half_edges[vertex == v]:
            if int(head[h]) not in reached:
                reached.add(int(head[h]))
                found.append(int(head[h]))
                in_tree[h] = in_tree[twin[h]] = True
    parent = np.full(twin.size // 3, -1)
    order, seen = [0], {0}
    for f in order:
        for h in range(3 * f, 3 * f + 3):
            if not in_tree[h] and int(twin[h]) // 3 not in seen:
                seen.add(int(twin[h]) // 3)
                order.append(int(twin[h]) // 3)
                parent[twin[h] // 3] = twin[h]
    in_cotree = np.zeros(twin.size, dtype=bool)
    in_cotree[parent[parent >= 0]] = in_cotree[twin[parent[parent >= 0]]] = True
    left = half_edges[~in_tree & ~in_cotree & (half_edges < twin)]
    cochains = np.zeros((twin.size, left.size), dtype=int)
    cochains[left, np.arange(left.size)] = 1
    cochains[twin[left], np.arange(left.size)] = -1
    for f in order[:0:-1]:
        value = -cochains[3 * f : 3 * f + 3].sum(axis=0)
        cochains[parent[f]], cochains[twin[parent[f]]] = value, -value
    assert not cochains.reshape(-1, 3, left.size).sum(axis=1).any()
    return cochains


def pairing(alpha, beta):
    """∫ α ∧ β from values on half-edges; sides 2 and 0 are the steps 01 and 12 of a triangle."""
    return 0.5 * (alpha[2::3].T @ beta[0::3] - alpha[0::3].T @ beta[2::3])


def symplectic_basis(M):
    """Integer T with T M Tᵀ = [[0, 1], [−1, 0]], by Gram–Schmidt with Euclid's algorithm."""
    rest = np.eye(len(M), dtype=int)
    first, second = [], []
    while len(rest):
        a, rest = rest[0], rest[1:]
        while np.count_nonzero(products := rest @ M.T @ a) > 1 or abs(products).max() > 1:
            least = np.argmin(np.where(products == 0, np.iinfo(int).max, abs(products)))
            quotient = products // products[least]
            quotient[least] = 0
            rest = rest - np.outer(quotient, rest[least])
        k = np.flatnonzero(products)[0]
        b = rest[k] * int(a @ M @ rest[k])
        rest = np.delete(rest, k, axis=0)
        rest = rest - np.outer(rest @ M @ b, a) + np.outer(rest @ M @ a, b)
        first.append(a)
        second.append(b)
    T = np.array(first + second)
    J = np.kron([[0, 1], [-1, 0]], np.eye(len(first), dtype=int))
    assert np.array_equal(T @ M @ T.T, J)
    return T
