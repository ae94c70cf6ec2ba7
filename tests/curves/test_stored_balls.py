"""Balls as integers and back."""

import flint

from igl_periods.curves.stored_balls import restored, stored


def test_what_is_restored_contains_what_was_stored():
    flint.ctx.dps = 50
    z = flint.acb(flint.arb(2).sqrt(), flint.arb(3).log())
    tree = {"a": (z, (1, "text", None)), "b": {(1, 2): z}, "c": [3]}
    there = restored(stored(tree))
    assert there["a"][0].contains(z)
    assert there["b"][1, 2].contains(z)
    assert there["a"][1] == (1, "text", None)
    assert there["c"] == [3]
