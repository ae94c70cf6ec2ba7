"""The command ``igl-periods``: one module, one command.

=====================  ============================================================================
``program``            parse, call, catch: :func:`main` and its exit codes
``arguments``          the arguments of many commands: which surface, how to compute
``picture_arguments``  the arguments of commands that make pictures: which form, which scene
``terminal``           what appears on the terminal: refusals, stages
the others             a command each: its ``add_…`` gives it a parser, whose ``run`` is called
=====================  ============================================================================
"""

from .program import main
from .arguments import add_surface_arguments, read_surfaces
from .terminal import refused, show_stages

__all__ = ["main", "add_surface_arguments", "read_surfaces", "refused", "show_stages"]
