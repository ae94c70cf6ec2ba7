"""Sentences and tables as HTML: letters with indices, powers and small numbers as mathematics."""

from __future__ import annotations

import base64
import re
from collections.abc import Iterable
from html import escape

# What plain sentences write, and how it is set; in this order.
_RULES = (
    (r"\bI_(\d+)\^(\d+)", r"<i>I</i><sub>\1</sub><sup>\2</sup>"),
    (r"\bI_(\d+)", r"<i>I</i><sub>\1</sub>"),
    (r"\bxi_\{(\d+),(\d+)\}", r"<i>ξ</i><sub>\1,\2</sub>"),
    (r"\b([ab])_?(\d+|[ijklg])\b", r"<i>\1</i><sub>\2</sub>"),
    (r"ζ_(\d+|[ijkl])", r"ζ<sub>\1</sub>"),
    (r"\bh\^(\d+(?:\.\d+)?)", r"<i>h</i><sup>\1</sup>"),
    (r"(?<![\w.])1e([+-])0*(\d+)\b", r"10<sup>\1\2</sup>"),
    (r"(?<![\w.])(\d+(?:\.\d+)?)e([+-])0*(\d+)\b", r"\1·10<sup>\2\3</sup>"),
    (r"<sup>\+", "<sup>"),
    (r"<sup>-", "<sup>−"),
    (r"\b2g − 2\b", "2<i>g</i> − 2"),
    (r"\bsize h\b", "size <i>h</i>"),
)


def mathematics(text: str) -> str:
    """Plain text as HTML.

    Examples
    --------
    >>> mathematics("a_1 within 2e-05, like h^2")
    '<i>a</i><sub>1</sub> within 2·10<sup>−5</sup>, like <i>h</i><sup>2</sup>'
    """
    html = escape(text)
    for pattern, replacement in _RULES:
        html = re.sub(pattern, replacement, html)
    return html


def paragraphs(sentences: Iterable[str]) -> str:
    """Sentences as paragraphs."""
    return "\n".join(f"<p>{mathematics(sentence)}</p>" for sentence in sentences)


def table(caption: str, rows: Iterable[tuple[str, str]]) -> str:
    """Names and values, both plain text, as a table whose first column is headers."""
    body = "\n".join(
        f'<tr><th scope="row">{mathematics(name)}</th><td>{mathematics(value)}</td></tr>'
        for name, value in rows
    )
    return f'<table class="facts"><caption>{escape(caption)}</caption>\n{body}\n</table>'


def figure(data: bytes, kind: str, caption: str, legend: str = "") -> str:
    """A picture in the page, with what is to be seen in words for those who do not see it."""
    source = f"data:{kind};base64,{base64.b64encode(data).decode()}"
    return (
        f'<figure><img src="{source}" alt="{escape(caption, quote=True)}">'
        f"<figcaption>{mathematics(caption)}{legend}</figcaption></figure>"
    )


def legend(entries: Iterable[tuple[str, tuple[float, float, float]]]) -> str:
    """What colours mean, below a picture."""
    items = "".join(
        f'<li><span style="background:#{_hexadecimal(colour)}"></span>{mathematics(name)}</li>'
        for name, colour in entries
    )
    return f'<ul class="legend">{items}</ul>' if items else ""


def _hexadecimal(colour: tuple[float, float, float]) -> str:
    return "".join(f"{round(255 * part):02x}" for part in colour)
