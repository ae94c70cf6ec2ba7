"""Plane domains with holes, at random and with well-known capacities."""

import numpy as np

from igl_periods.surfaces import planar_domain

ELL = np.array([0, 2, 2 + 1j, 1 + 1j, 1 + 2j, 2j])
AITCH = np.array([0, 1, 1 + 1j, 2 + 1j, 2, 3, 3 + 3j, 2 + 3j, 2 + 2j, 1 + 2j, 1 + 3j, 3j])


def square(x, y, side):
    return np.array([0, 1, 1 + 1j, 1j]) * side + complex(x, y)


def frame(outer, inner):
    """A square with a square hole in the middle."""
    offset = (outer - inner) / 2
    return planar_domain(square(0, 0, outer), [square(offset, offset, inner)])


def circle(n, radius=1.0, centre=0.0):
    """The regular n-gon inscribed in a circle."""
    return centre + radius * np.exp(2j * np.pi * np.arange(n) / n)


def random_domain(rng):
    """The outer polygon and the holes of a domain: one to three of L, H and stars, all askew."""
    holes = []
    for k in range(rng.integers(1, 4)):
        centre = (k % 2) * 6 + (k // 2) * 6j
        if rng.random() < 0.6:
            shape = ELL - (1 + 1j) if rng.random() < 0.5 else AITCH - 1.5 * (1 + 1j)
        else:
            shape = star(rng, 5)
        turn = np.exp(2j * np.pi * rng.random())
        holes.append(centre + turn * shape * rng.uniform(0.4, 1.1))
    return 3 + 3j + 2 * star(rng, 7) + 12 * star(rng, 7, 0.0), holes


def star(rng, n, unevenness=0.5):
    """A polygon that is star-shaped from 0, of radius about 1."""
    angle = 2 * np.pi * (np.arange(n) + rng.uniform(-0.2, 0.2, n)) / n
    return np.exp(1j * angle) * (1 + unevenness * rng.uniform(-1, 1, n))
