"""Numbers written with roots: a rational number and rational multiples of roots of such numbers."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import flint


@dataclass(frozen=True)
class Surd:
    """rational + Σ coefficient · (radicand)^{1/index}, principal roots.

    Attributes
    ----------
    rational : Fraction
    terms : tuple of Root
    """

    rational: Fraction
    terms: tuple[Root, ...] = ()

    def ball(self, bits: int) -> flint.acb:
        """The number in a ball, with about so many bits."""
        with flint.ctx.workprec(bits):
            roots = [root.ball(bits) for root in self.terms]
            return sum(roots, flint.acb(_exact(self.rational)))

    def __str__(self) -> str:
        return _joined(self, _PLAIN)

    def latex(self) -> str:
        r"""The number for LaTeX, as in ``\frac{1 + \sqrt{5}}{2}``."""
        return _joined(self, _LATEX)


@dataclass(frozen=True)
class Root:
    """coefficient · (radicand)^{1/index}, the principal root.

    Attributes
    ----------
    coefficient : Fraction
    radicand : Surd
    index : int
    """

    coefficient: Fraction
    radicand: Surd
    index: int = 2

    def ball(self, bits: int) -> flint.acb:
        """The number in a ball, with about so many bits."""
        with flint.ctx.workprec(bits):
            inner = self.radicand.ball(bits)
            root = inner.sqrt() if self.index == 2 else inner.root(self.index)
            return _exact(self.coefficient) * root


def square_part(n: int) -> tuple[int, int]:
    """Write n = s² r with r square-free (0 = 0² · 0).

    Examples
    --------
    >>> square_part(12), square_part(-50)
    ((2, 3), (5, -2))
    """
    s, r = 1, -1 if n < 0 else 1
    for prime, exponent in flint.fmpz(n).factor() if n else []:
        if prime > 0:
            s *= int(prime) ** (exponent // 2)
            r *= int(prime) ** (exponent % 2)
    return (s, r) if n else (0, 0)


def square_root(q: Fraction) -> tuple[Fraction, int]:
    """√q = coefficient · √radicand with a square-free radicand."""
    s, r = square_part(q.numerator * q.denominator)
    return Fraction(s, q.denominator), r


def surd(rational: Fraction, *roots: tuple[Fraction, int]) -> Surd:
    """The number rational + Σ coefficient · √radicand, with equal roots collected."""
    collected: dict[int, Fraction] = {}
    for coefficient, radicand in roots:
        if radicand == 1:
            rational += coefficient
        elif radicand:
            collected[radicand] = collected.get(radicand, Fraction(0)) + coefficient
    by_size = sorted(collected.items(), key=lambda item: (item[0] < 0, abs(item[0])))
    terms = [Root(c, Surd(Fraction(r))) for r, c in by_size if c]
    return Surd(rational, tuple(terms))


@dataclass(frozen=True)
class _Script:
    """How roots and fractions are written."""

    root: str
    radicand: str
    fraction: str
    fraction_of_sum: str
    imaginary: str


_PLAIN = _Script("{name}{radicand}", "({})", "{}/{}", "({})/{}", "i")
_LATEX = _Script(
    "{name}{{{radicand}}}", "{}", r"\frac{{{}}}{{{}}}", r"\frac{{{}}}{{{}}}", r"\mathrm{i}"
)
_SIGNS = {2: "√", 3: "∛", 4: "∜"}
_SUPERSCRIPTS = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def _joined(x: Surd, script: _Script) -> str:
    """All terms over their common denominator."""
    numbers = [x.rational, *(root.coefficient for root in x.terms)]
    denominator = math.lcm(*(q.denominator for q in numbers))
    parts = [(x.rational * denominator, "")] if x.rational or not x.terms else []
    parts += [(root.coefficient * denominator, _root(root, script)) for root in x.terms]
    text = ""
    for number, name in parts:
        size = str(abs(number.numerator))
        size = name if name and size == "1" else size + name
        if not text:
            text = f"-{size}" if number < 0 else size
        else:
            text += f" - {size}" if number < 0 else f" + {size}"
    if denominator == 1:
        return text
    if len(parts) > 1:
        return script.fraction_of_sum.format(text, denominator)
    sign, size = ("-", text[1:]) if text.startswith("-") else ("", text)
    return sign + script.fraction.format(size, denominator)


def _root(root: Root, script: _Script) -> str:
    inner = root.radicand
    if root.index == 2 and not inner.terms and inner.rational < 0:
        if inner.rational == -1:
            return script.imaginary
        positive = Root(Fraction(1), Surd(-inner.rational))
        return script.imaginary + _root(positive, script)
    text = _joined(inner, script)
    if script is _LATEX:
        name = r"\sqrt" if root.index == 2 else rf"\sqrt[{root.index}]"
    else:
        name = _SIGNS.get(root.index) or f"{str(root.index).translate(_SUPERSCRIPTS)}√"
        text = text if text.isdigit() else script.radicand.format(text)
    return script.root.format(name=name, radicand=text)


def _exact(q: Fraction) -> flint.arb:
    return flint.arb(flint.fmpq(q.numerator, q.denominator))
