"""Balls inside tuples and dictionaries as integers and back, for pickles."""

from __future__ import annotations

from typing import Any

import flint

from igl_periods.enclosures import from_integers, to_integers

_BALL = "complex ball"


def stored(value: Any) -> Any:
    """The same with every acb as a tuple of integers."""
    if isinstance(value, flint.acb):
        return _BALL, to_integers(value.real), to_integers(value.imag)
    if isinstance(value, dict):
        return {key: stored(x) for key, x in value.items()}
    return tuple(stored(x) for x in value) if isinstance(value, tuple) else value


def restored(value: Any) -> Any:
    """What was stored; the balls contain those that were."""
    if isinstance(value, dict):
        return {key: restored(x) for key, x in value.items()}
    if not isinstance(value, tuple):
        return value
    if value and isinstance(value[0], str) and value[0] == _BALL:
        return flint.acb(from_integers(*value[1]), from_integers(*value[2]))
    return tuple(restored(x) for x in value)
