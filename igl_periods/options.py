"""Options as callers hand them over, checked: numbers, integers and switches.

Numbers of all libraries are welcome, and become those of Python.  What is none gets a sentence that
says what it is.
"""

from __future__ import annotations

import math
from numbers import Real
from typing import Any

import numpy as np


def checked_number(name: str, value: Any) -> float:
    """A real number, infinity included, as a float; ValueError for anything else."""
    number = _scalar(value)
    if isinstance(number, bool) or not isinstance(number, Real):
        raise ValueError(f"{name} must be a number, not {in_words(value)}.")
    try:
        return float(number)
    except OverflowError:
        return math.copysign(math.inf, number)


def checked_integer(name: str, value: Any) -> int:
    """An integer, also as a float without a fraction, as an int; ValueError for anything else."""
    number = _scalar(value)
    if isinstance(number, float) and number.is_integer():
        return int(number)
    if isinstance(number, bool) or not isinstance(number, int):
        raise ValueError(f"{name} must be an integer, not {in_words(value)}.")
    return number


def checked_switch(name: str, value: Any) -> bool:
    """True or False, of Python or NumPy; ValueError for anything else."""
    switch = _scalar(value)
    if not isinstance(switch, bool):
        raise ValueError(f"{name} must be True or False, not {in_words(value)}.")
    return switch


def in_words(value: Any) -> str:
    """A value with its type, where the value alone does not show it."""
    if value is None or isinstance(value, (bool, np.bool_)):
        return str(value)
    if isinstance(value, str):
        return f"the string {value!r}"
    if np.isscalar(value):
        return f"{value!r}"
    return f"an object of type {type(value).__name__}"


def _scalar(value: Any) -> Any:
    """What a scalar or array of NumPy without dimensions stands for; anything else as it is."""
    if (
        isinstance(value, (np.generic, np.ndarray))
        and value.ndim == 0
        and value.dtype.kind in "biuf"
    ):
        return value.item()
    return value
