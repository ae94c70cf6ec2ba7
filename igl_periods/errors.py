"""The errors of the library: all of them are ``ValueError``, so one ``except`` catches them.

A message says what failed, with numbers, the likely cause, and what to do about it.
"""

from __future__ import annotations


class MeshError(ValueError):
    """The arrays or the file handed over describe no triangulated surface."""


class ComplexError(ValueError):
    """A gluing, its lengths or its weights do not describe a surface with a period matrix."""


class NotASiegelPointError(ValueError):
    """A matrix outside the Siegel upper half-space: asymmetric, or Im not positive definite."""


class MemoryLimitError(ValueError):
    """A computation that would take more memory than there is, or than it was allowed."""


class EnumerationLimitError(RuntimeError):
    """An enumeration of short vectors passed its work limit and was given up."""


class RenderError(RuntimeError):
    """Open3D cannot draw on this machine; the message names what is missing."""


class BatchError(RuntimeError):
    """A cluster cannot be used, or not any longer; the message says what to do."""
