"""The errors of the library: all of them are :class:`PeriodsError`.

.. code-block:: text

    PeriodsError
    ├── MeshError                  handed over was no triangulated surface              ValueError
    ├── ComplexError               … no surface with a period matrix                    ValueError
    ├── NotASiegelPointError       … no point of the Siegel upper half-space            ValueError
    ├── CurveError                 … no Jacobian of a curve that is found here          ValueError
    ├── NotPositiveDefiniteError   … no positive definite matrix                        ValueError
    ├── MemoryLimitError           it would take more memory than there may be          ValueError
    ├── MissingExtraError          packages of an extra are missing          ImportError, ValueError
    ├── EnumerationLimitError      a search of a lattice was given up                   RuntimeError
    ├── RenderError                this machine cannot draw                             RuntimeError
    └── BatchError                 a cluster cannot be used                             RuntimeError

Those about what was handed over are ``ValueError`` too, those about what happened ``RuntimeError``.
A message says what failed, with numbers, the likely cause, and what to do about it.  Each module
speaks of what it knows: a lattice reduction of a quadratic form, its caller of the half-space.
"""

from __future__ import annotations


class PeriodsError(Exception):
    """Whatever the library refuses to do, or had to give up."""


class MeshError(PeriodsError, ValueError):
    """The arrays or the file handed over describe no triangulated surface."""


class ComplexError(PeriodsError, ValueError):
    """A gluing, its lengths or its weights do not describe a surface with a period matrix."""


class NotASiegelPointError(PeriodsError, ValueError):
    """A matrix outside the Siegel upper half-space: asymmetric, or Im not positive definite."""


class CurveError(PeriodsError, ValueError):
    """A period matrix of no curve, a product for instance, or of none that is known well enough."""


class NotPositiveDefiniteError(PeriodsError, ValueError):
    """A symmetric matrix that is not positive definite, as far as double precision tells."""


class MemoryLimitError(PeriodsError, ValueError):
    """A computation that would take more memory than there is, or than it was allowed."""


class MissingExtraError(PeriodsError, ImportError, ValueError):
    """Packages of an extra of the installation are missing; the message ends with the command."""


class EnumerationLimitError(PeriodsError, RuntimeError):
    """An enumeration of short vectors passed its work limit and was given up."""


class RenderError(PeriodsError, RuntimeError):
    """Open3D cannot draw on this machine; the message names what is missing."""


class BatchError(PeriodsError, RuntimeError):
    """A cluster cannot be used, or not any longer; the message says what to do."""
