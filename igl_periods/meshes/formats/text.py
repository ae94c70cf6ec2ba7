"""Text files of meshes, line by line: what a line of a vertex or a face may look like.

Readers written in C stop at what they do not understand, or read something else.  So every line is
matched against its pattern before it is handed on.
"""

from __future__ import annotations

import re

from igl_periods.errors import MeshError

# libigl takes a longer line for two.
_LONGEST_LINE = 2000
# No two ways to match the same digits: or lines that do not match would take for ever.
NUMBER = rb"[-+]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][-+]?\d+)?"
VERTEX = re.compile(rb"(?:v\s+)?%b(?:\s+%b){2,}" % (NUMBER, NUMBER))
FACE = re.compile(rb"(?:f\s+)?-?\d{1,9}(?:/-?\d*){0,2}(?:\s+-?\d{1,9}(?:/-?\d*){0,2})*")
COUNT = re.compile(rb"\d{1,18}")


def text_lines(data: bytes) -> list[bytes]:
    """Lines without comments and blank ones, continued ones joined."""
    if b"\0" in data:
        raise MeshError("the file is binary, where text is expected.")
    joined = data.removeprefix(b"\xef\xbb\xbf").replace(b"\\\r\n", b" ").replace(b"\\\n", b" ")
    stripped = (line.split(b"#", 1)[0].strip() for line in joined.splitlines())
    return [line for line in stripped if line]


def check_lines(rows: list[bytes], pattern: re.Pattern[bytes], what: str) -> None:
    """Raise MeshError unless all lines match and none is too long."""
    for row in rows:
        if len(row) > _LONGEST_LINE:
            raise MeshError(
                f"a {what} has a line of {len(row)} characters, and libigl takes up to "
                f"{_LONGEST_LINE}. Triangulate faces with hundreds of corners first."
            )
        if not pattern.fullmatch(row):
            shown = row[:60].decode(errors="replace")
            raise MeshError(f"this line is no {what}, which is made of finite numbers: {shown!r}.")
