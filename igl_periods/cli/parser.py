"""Command lines that are wrong: what was meant, and options that would have no effect.

An argument that is none of those known is answered with the nearest one (:mod:`difflib`), for
options, commands and choices alike.  An option that is known, but has no effect beside the others,
is refused too: the checks of a command see all its options before anything is read or computed.
"""

from __future__ import annotations

import argparse
import difflib
import re
from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeAlias

Check: TypeAlias = "Callable[[Parser, argparse.Namespace], None]"


class Parser(argparse.ArgumentParser):
    """A parser that says what may have been meant, and looks at options together.

    Attributes
    ----------
    checks : list of callable
        Called with this parser and all options; a ValueError is wrong usage.
    """

    def __init__(self, *arguments: Any, **options: Any) -> None:
        super().__init__(*arguments, **options)
        self.checks: list[Check] = []
        # Directions and coefficients may begin with a sign, as numbers do: -1,0,0 or -1+2j.
        self._negative_number_matcher = re.compile(r"-\.?\d")

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse; an option that there is not comes before what is missing without it."""
        for argument in self._own_long_options(args or ()):
            self._check_option(argument.partition("=")[0])
        options, rest = super().parse_known_args(args, namespace)
        try:
            for check in self.checks:
                check(self, options)
        except ValueError as error:
            self.error(str(error))
        return options, rest

    def name_of(self, destination: str) -> str:
        """How an option is written that sets an attribute to something else than its default."""
        actions = (action for action in self._actions if action.dest == destination)
        return next(action.option_strings[-1] for action in actions)

    def _own_long_options(self, arguments: Iterable[str]) -> Iterable[str]:
        """Long options of this parser: what follows a command is parsed by that command."""
        for argument in arguments:
            if argument == "--" or (self._subparsers and not argument.startswith("-")):
                return
            if argument.startswith("--"):
                yield argument

    def _check_option(self, name: str) -> None:
        known = self._option_string_actions
        if not any(option.startswith(name) for option in known):
            self.error(f"there is no option {name}{did_you_mean(name, known)}")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        try:
            super()._check_value(action, value)
        except argparse.ArgumentError as error:
            error.message += did_you_mean(str(value), map(str, action.choices or ()))
            raise


def did_you_mean(word: str, known: Iterable[str]) -> str:
    """The end of a sentence that names the nearest of some words, or nothing.

    Examples
    --------
    >>> did_you_mean("--tolerence", ["--tolerance", "--degree"])
    '; did you mean --tolerance?'
    >>> did_you_mean("--colour", ["--tolerance", "--degree"])
    ''
    """
    near = difflib.get_close_matches(word, list(known), n=1)
    return f"; did you mean {near[0]}?" if near else ""


def refuse_without_effect(
    command: Parser, options: argparse.Namespace, names: Iterable[str], why: str
) -> None:
    """Raise ValueError if one of some options, named by their attributes, was given."""
    for name in names:
        given, default = getattr(options, name), command.get_default(name)
        # Arrays are equal to nothing but arrays, and no default is one.
        if type(given) is not type(default) or given != default:
            raise ValueError(f"{command.name_of(name)} has no effect {why}.")
