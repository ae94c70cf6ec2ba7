"""What is seen on a picture."""

import numpy as np

SIZE = (240, 180)


def is_drawn(picture):
    """Mask of what is not background."""
    return (picture < 250).any(axis=2)


def count_near(picture, colour, tolerance=0.06):
    """Number of pixels with the hue and nearly the saturation of a colour, however lit."""
    pixels = picture.reshape(-1, 3) / 255.0
    brightness = np.maximum(pixels.max(axis=1, keepdims=True), 0.25)
    wanted = np.asarray(colour) / max(colour)
    return np.count_nonzero(np.abs(pixels / brightness - wanted).max(axis=1) < 3 * tolerance)
