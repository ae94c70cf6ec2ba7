"""What appears on the terminal: results, refusals, warnings, and stages while they run.

What a terminal cannot show, having another encoding than UTF-8, is written in ASCII: Π as Pi, γ⁻¹
as gamma^-1, ≤ as <=.
"""

from __future__ import annotations

import codecs
import itertools
import logging
import sys
import unicodedata
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from igl_periods.run_log import logger

_CLEARED = "\r\x1b[K"
# Signs that Unicode does not take apart itself.
_SIGNS = {
    "×": "x", "·": "*", "−": "-", "±": "+-", "≤": "<=", "≥": ">=", "≠": "!=", "≈": "~", "→": "->",
    "↦": "->", "⇒": "=>", "∞": "inf", "∫": "int ", "∮": "int ", "√": "sqrt ", "∛": "cbrt ",
    "∜": "root4 ", "∏": "prod ", "∑": "sum ", "°": " deg",
    "–": "-", "—": "-", "’": "'", "‘": "'", "“": '"', "”": '"',
    "…": "...", "∈": "in", "∂": "d", "║": "||", "‖": "||", "⟨": "<", "⟩": ">", "ß": "ss", "æ": "ae",
    "ø": "o", "′": "'", "⋮": ":", "∧": "^", "⊕": "+", "⊗": "x",
}  # fmt: skip


def say(text: str) -> None:
    """Print a result."""
    print(text, flush=True)


def refused(why: object, code: int = 1) -> int:
    """Print why something was not done; returns the exit code."""
    # A stage that did not come to its end has left its line open.
    fresh = _CLEARED if any(map(_is_ours, logger.handlers)) else ""
    print(f"{fresh}igl-periods: {why}", file=sys.stderr, flush=True)
    return code


def about(mesh: str, message: object) -> str:
    """A message that names its mesh."""
    return str(message) if mesh in str(message) else f"{mesh}: {message}"


def warn(messages: Iterable[object]) -> None:
    """Print warnings."""
    for message in messages:
        print(f"igl-periods: warning: {message}", file=sys.stderr, flush=True)


@contextmanager
def warnings_told() -> Iterator[None]:
    """Print warnings when all is done, also if it is refused in the end."""
    with warnings.catch_warnings(record=True) as caught:
        try:
            yield
        finally:
            if not isinstance(sys.exc_info()[1], KeyboardInterrupt):
                warn(warning.message for warning in caught)


# ---- Other encodings ----


def write_readably() -> None:
    """From now on write what has no place in the encoding of the terminal in ASCII."""
    codecs.register_error("igl_periods.readable", _readable)
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="igl_periods.readable")


def in_ascii(text: str) -> str:
    """A text in the letters of ASCII, as readable as they allow.

    Examples
    --------
    >>> in_ascii("‖Π − γΠ₀‖ ≤ 10⁻³, ζ₁, 3 × 3 …, ξ_{2,1}, Poincaré")
    '||Pi - gammaPi_0|| <= 10^-3, zeta_1, 3 x 3 ..., xi_{2,1}, Poincare'
    """
    pieces = itertools.groupby(text, key=_height)
    return "".join(mark + "".join(map(_letter_in_ascii, piece)) for mark, piece in pieces)


def _readable(error: UnicodeError) -> tuple[str, int]:
    assert isinstance(error, UnicodeEncodeError)
    return in_ascii(error.object[error.start : error.end]), error.end


def _height(letter: str) -> str:
    """What stands before letters above or below the line."""
    return {"<super>": "^", "<sub>": "_"}.get(unicodedata.decomposition(letter).split(" ")[0], "")


def _letter_in_ascii(letter: str) -> str:
    if letter.isascii() or unicodedata.combining(letter):
        return letter * letter.isascii()
    plain = unicodedata.normalize("NFKD", letter)
    for text in (_SIGNS.get(letter), _SIGNS.get(plain), _greek(letter), _without_accents(plain)):
        if text:
            return text
    return letter.encode("ascii", "backslashreplace").decode()


def _greek(letter: str) -> str:
    """The name of a Greek letter; capital letters have capital names."""
    words = unicodedata.name(letter, "").split(" ")
    if len(words) < 4 or words[0] != "GREEK" or words[2] != "LETTER":
        return ""
    return words[3].capitalize() if words[1] == "CAPITAL" else words[3].lower()


def _without_accents(plain: str) -> str:
    return "".join(part for part in plain if part.isascii())


# ---- Stages ----


def show_stages() -> None:
    """Show each stage on the terminal while it runs, and its time when it is done."""
    handler = logging.StreamHandler(sys.stderr)
    handler.terminator = ""
    handler.setFormatter(_StageFormatter())
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)


def _is_ours(handler: logging.Handler) -> bool:
    return isinstance(handler.formatter, _StageFormatter)


class _StageFormatter(logging.Formatter):
    """One line for each stage, written over while it runs."""

    def __init__(self) -> None:
        super().__init__()
        self._stage = ""

    def format(self, record: logging.LogRecord) -> str:
        # Back to the start of the line, and clear what is left of a longer one.
        line = f"{_CLEARED}  "
        if hasattr(record, "progress"):
            return f"{line}{self._stage} … {record.getMessage()}"
        if not hasattr(record, "stage"):
            return f"{line}{record.getMessage()}\n"
        self._stage, seconds = record.stage, getattr(record, "seconds", None)
        if seconds is None:
            return f"{line}{self._stage} …"
        return f"{line}{self._stage:<20} {seconds:8.2f} s\n"
