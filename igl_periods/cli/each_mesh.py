"""Several meshes, one after the other: each has its section, or its JSON document, or a refusal."""

from __future__ import annotations

import argparse
import json
import sys
import warnings
from collections.abc import Callable
from typing import Any, TypeAlias

from igl_periods.errors import MissingExtraError, PeriodsError
from igl_periods.reports import document_to_json, refusal_to_json

from .terminal import about, refused, say, warn

# What is said of one mesh: a section in words, or with ``--json`` what its document holds.
Answer: TypeAlias = "str | dict[str, Any]"
# Characters of a document up to which people may want to read it.
_READABLE = 50_000


def answer_each(options: argparse.Namespace, answer: Callable[[argparse.Namespace], Answer]) -> int:
    """Print the answer for each of ``options.meshes``; returns the exit code.

    ``answer`` is called with the same options and one ``mesh``.  What refuses one mesh does not
    keep the others from being answered, but from exit code 0.
    """
    code = 0
    for k, mesh in enumerate(options.meshes):
        if k and not options.json:
            say("")
        code |= _answered(argparse.Namespace(**{**vars(options), "mesh": mesh}), answer)
    return code


def _answered(options: argparse.Namespace, answer: Callable[[argparse.Namespace], Answer]) -> int:
    mesh, several = options.mesh, len(options.meshes) > 1
    refusal: Exception | None = None
    result: Answer = ""
    with warnings.catch_warnings(record=True) as caught:
        try:
            result = answer(options)
        except (BrokenPipeError, MissingExtraError):
            raise
        except (ValueError, OSError, PeriodsError) as error:
            refusal = error
    if options.json:
        body = refusal_to_json(refusal) if refusal else result
        assert isinstance(body, dict)
        say(_dumped(document_to_json(mesh, body, [w.message for w in caught]), not several))
    elif refusal is None:
        say(str(result).rstrip("\n"))
    # On a terminal both come to the same place: in this order they are about the same mesh.
    sys.stdout.flush()
    warn(about(mesh, w.message) if several else w.message for w in caught)
    return refused(about(mesh, refusal)) if refusal else 0


def _dumped(document: dict[str, Any], readable: bool) -> str:
    """One line; more for people, if there are few numbers and no other document."""
    text = json.dumps(document)
    return json.dumps(document, indent=1) if readable and len(text) < _READABLE else text
