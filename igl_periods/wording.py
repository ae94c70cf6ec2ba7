"""Numbers with their nouns, as messages use them."""

from __future__ import annotations


def counted(count: int, one: str, many: str) -> str:
    """``1 edge``, ``3 edges``."""
    return f"{count} {one if count == 1 else many}"
