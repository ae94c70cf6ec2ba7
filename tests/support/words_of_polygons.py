"""What the word of a fundamental polygon says about intersections."""

import numpy as np


def word_pairing(word):
    """The pairings ∫ c_k ∧ c_l of the cochains of the letters, read off the word; (2g, 2g).

    Parameters
    ----------
    word : (4g,) int
        As :class:`FundamentalPolygon` has it: the letters ±1, …, ±2g, each once.
    """
    order = np.argsort(word)
    half = word.size // 2
    inverse, place = order[:half][::-1], order[half:]
    low, high = np.minimum(place, inverse), np.maximum(place, inverse)

    def between(x):
        inside = (low[:, None] < x) & (x < high[:, None])
        return inside.astype(np.int64)

    return np.sign(inverse - place)[:, None] * (between(place) - between(inverse))
