"""Docstrings as reStructuredText: absolute values and stars of the mathematics are not markup.

``|ζ|`` would be a substitution and ``*ω`` the beginning of an emphasis.  Both are escaped where
they are text; literals, formulas, examples and real emphasis stay.
"""

import re

# What is left as it is, within a line: literals, roles, emphasis and strong emphasis.
_KEPT = re.compile(
    r"``.*?``|:\w[\w:]*:`[^`]*`|`[^`]*`_*|(?<![\w\\])\*\*?[^\s*][^*]*?\*?\*(?!\w)|\\."
)
_BLOCK = re.compile(r"^(\s*)(?:\.\. (?:math|code-block)::|.*::$)")


def escaped(line):
    """A line of text with its bars and stars escaped."""
    pieces, end = [], 0
    for kept in _KEPT.finditer(line):
        pieces += [re.sub(r"[|*]", r"\\\g<0>", line[end : kept.start()]), kept.group()]
        end = kept.end()
    return "".join(pieces) + re.sub(r"[|*]", r"\\\g<0>", line[end:])


def escaped_lines(lines):
    """The lines of a docstring; blocks of formulas, literals and examples are left alone."""
    inside, example = None, False
    for line in lines:
        indent = len(line) - len(line.lstrip())
        if inside is not None and line.strip() and indent <= inside:
            inside = None
        example = bool(line.strip()) and (example or line.lstrip().startswith(">>>"))
        if inside is not None or example:
            yield line
            continue
        block = _BLOCK.match(line)
        if block:
            inside = len(block.group(1))
        yield line if block and line.lstrip().startswith("..") else escaped(line)


def without_roles(text):
    """References as literals, for places where they have no context."""
    return re.sub(r":[\w:]+:`~?\.?([^`<]+?)`", r"``\1``", text)
