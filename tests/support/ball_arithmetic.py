"""The whole computation of D in ball arithmetic, one flip after the other: slow and rigorous.

Nothing is shared with the library but the input, the order of flips and the cochains.
"""

import flint
import numpy as np
from flint import arb, arb_mat

BITS = 300


def half_edges(K):
    """next, twin, edge, sign and start vertex of every half-edge as lists, and exact lengths."""
    n = 3 * K.n_faces
    following = [h - h % 3 + (h + 1) % 3 for h in range(n)]
    start = np.roll(K.corner_vertex, -1, 1).ravel().tolist()
    lengths = [arb(0)] * K.n_edges
    for edge, length in zip(K.edge.ravel(), K.lengths.ravel(), strict=True):
        lengths[edge] = arb(float(length))
    lists = (K.twin.ravel().tolist(), K.edge.ravel().tolist(), K.sign.ravel().tolist())
    return following, *lists, start, lengths


def area(a, b, c):
    s = (a + b + c) / 2
    return (s * (s - a) * (s - b) * (s - c)).sqrt()


class Surface:
    """A triangulation that is flipped edge by edge, with the values of cochains on edges."""

    def __init__(self, K, cochains):
        self.next, self.twin, self.edge, self.sign, self.start, self.lengths = half_edges(K)
        self.cochains = cochains.toarray().T.tolist()
        self.n_vertices = K.n_vertices

    def length(self, h):
        return self.lengths[self.edge[h]]

    def value(self, h, k):
        return self.sign[h] * self.cochains[self.edge[h]][k]

    def flip(self, edge):
        h = next(i for i in range(len(self.edge)) if self.edge[i] == edge and self.sign[i] > 0)
        t = self.twin[h]
        bp, aq = self.next[h], self.next[t]
        pa, qb = self.next[bp], self.next[aq]
        base = self.length(h)
        foot_p = (base**2 + self.length(pa) ** 2 - self.length(bp) ** 2) / (2 * base)
        foot_q = (base**2 + self.length(aq) ** 2 - self.length(qb) ** 2) / (2 * base)
        height = 2 * area(base, self.length(bp), self.length(pa)) / base
        height += 2 * area(base, self.length(aq), self.length(qb)) / base
        value = [-self.value(aq, k) - self.value(pa, k) for k in range(len(self.cochains[0]))]
        self.lengths[edge] = ((foot_p - foot_q) ** 2 + height**2).sqrt()
        self.cochains[edge] = value
        # h becomes q → p in the face p a q, t becomes p → q in the face q b p.
        p, q = self.start[pa], self.start[qb]
        for a, b, c in ((pa, aq, h), (qb, bp, t)):
            self.next[a], self.next[b], self.next[c] = b, c, a
        self.start[h], self.start[t] = q, p

    def dirichlet(self):
        k = len(self.cochains[0])
        weights = [arb(0)] * len(self.lengths)
        for h in range(len(self.edge)):
            a, b = self.length(h), self.length(self.next[h])
            c = self.length(self.next[self.next[h]])
            weights[self.edge[h]] += (b * b + c * c - a * a) / (8 * area(a, b, c))
        ends = [(0, 0)] * len(self.lengths)
        for h in range(len(self.edge)):
            if self.sign[h] > 0:
                ends[self.edge[h]] = (self.start[h], self.start[self.next[h]])
        n = self.n_vertices - 1
        L = [[arb(0)] * n for _ in range(n)]
        b = [[arb(0)] * k for _ in range(n)]
        for (u, v), w, c in zip(ends, weights, self.cochains, strict=True):
            for x, s in ((u - 1, -1), (v - 1, 1)):
                for y, r in ((u - 1, -1), (v - 1, 1)):
                    if x >= 0 and y >= 0:
                        L[x][y] += s * r * w
                if x >= 0:
                    for j in range(k):
                        b[x][j] -= s * w * c[j]
        f = arb_mat(L).solve(arb_mat(b)).table() if n else []
        f = [[arb(0)] * k, *f]
        D = [[arb(0)] * k for _ in range(k)]
        for (u, v), w, c in zip(ends, weights, self.cochains, strict=True):
            form = [c[j] + f[v][j] - f[u][j] for j in range(k)]
            for i in range(k):
                for j in range(k):
                    D[i][j] += w * form[i] * form[j]
        return arb_mat(D)


def dirichlet_matrix(K, cochains, rounds):
    """D of the flipped surface as a ball matrix; ``rounds`` as ``delaunay_flips`` returns them."""
    flint.ctx.prec = BITS
    surface = Surface(K, cochains)
    for flips in rounds:
        for edge in flips.edge.tolist():
            surface.flip(edge)
    return surface.dirichlet()


def distance_from_the_mean(D, Pi):
    """How far Π is from the symplectic mean of D, ‖Y^{-1/2} (Π − Π(D)) Y^{-1/2}‖₂.

    The complex structure T⁻¹ J T of D = Tᵀ diag(d, d) T is the limit of Newton's iteration
    X ← ½ (X − X⁻¹) from J D; the mean is −J times it.
    """
    flint.ctx.prec = BITS
    g = len(Pi)
    J = arb_mat(np.block([[np.zeros((g, g)), np.eye(g)], [-np.eye(g), np.zeros((g, g))]]).tolist())
    X = J * arb_mat(D.tolist())
    for _ in range(12):
        X = _middle((X - X.inv()) * arb(0.5))
    assert max(float(abs(x).mid()) for x in (X * X + J.inv() * J).entries()) < 1e-20
    G = (J * X * arb(-1)).table()
    bb, ab = (arb_mat([row[g:] for row in part]) for part in (G[g:], G[:g]))
    error_of_X = arb_mat(Pi.real.tolist()) + ab * bb.inv()
    error_of_Y = arb_mat(Pi.imag.tolist()) - bb.inv()
    # With bb = R Rᵀ, Rᵀ is an inverse root of Y up to rotations.
    R = _cholesky(bb)
    parts = (R.transpose() * error * R for error in (error_of_X, error_of_Y))
    re, im = (np.array([[float(x.mid()) for x in row] for row in A.table()]) for A in parts)
    return np.linalg.norm(re + 1j * im, 2)


def _middle(A):
    return arb_mat([[x.mid() for x in row] for row in A.table()])


def _cholesky(A):
    n = A.nrows()
    R = [[arb(0)] * n for _ in range(n)]
    for i in range(n):
        for j in range(i + 1):
            rest = A[i, j] - sum((R[i][k] * R[j][k] for k in range(j)), arb(0))
            R[i][j] = rest.sqrt() if i == j else rest / R[j][j]
    return arb_mat(R)
