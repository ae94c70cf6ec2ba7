# PYTHON_ARGCOMPLETE_OK
"""The command ``igl-periods``: one module, one command.

=====================  ============================================================================
``program``            parse, call, catch: :func:`main` and its exit codes
``parser``             wrong command lines: what was meant, options without effect
``arguments``          the arguments of many commands: which surface, how to compute
``picture_arguments``  the arguments of commands that make pictures: which form, which scene
``each_mesh``          commands about several meshes: a section, a document or a refusal each
``terminal``           what appears on the terminal: refusals, warnings, stages, in its encoding
the others             a command each: its ``add_…`` gives it a parser, whose ``run`` is called
=====================  ============================================================================
"""

from .program import main
from .parser import Parser
from .arguments import add_surface_arguments, read_surfaces
from .terminal import refused, show_stages

__all__ = ["main", "Parser", "add_surface_arguments", "read_surfaces", "refused", "show_stages"]
