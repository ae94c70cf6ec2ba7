"""The tables of a PLY file: columns of numbers and of lists, in text or binary.

Rows of equal size, the usual case, are one structured NumPy array over the bytes of the file; only
tables with lists of different lengths are walked through row by row.
"""

from __future__ import annotations

import itertools
import struct
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from igl_periods.arrays import Floats, Ints
from igl_periods.errors import MeshError

from .text import indices, numbers, whole

_INTEGERS = {"i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8"}
_STRUCT = dict(zip(["i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f4", "f8"], "bBhHiIqQfd"))


@dataclass(frozen=True)
class Property:
    """A column: its name, the type of its numbers, and that of the lengths of lists."""

    name: str
    kind: str
    count: str | None = None


@dataclass(frozen=True)
class Element:
    """A table as the header declares it."""

    name: str
    size: int
    properties: tuple[Property, ...]


@dataclass(frozen=True, eq=False)
class Column:
    """The values of a column, numbers or words, and how many of them each row has."""

    kind: str
    values: NDArray[Any] | list[bytes]
    lengths: Ints

    def floats(self) -> Floats:
        """The numbers, rounded to the type that the header declares."""
        if isinstance(self.values, np.ndarray):
            with np.errstate(invalid="ignore"):
                return self.values.astype(np.float64)
        # What is too large for single precision becomes infinite.
        with np.errstate(over="ignore"):
            return _floats(self.values).astype(self.kind).astype(np.float64)

    def integers(self) -> Ints:
        """The numbers, which have to be whole ones; ValueError if one is none."""
        if not isinstance(self.values, np.ndarray):
            found = indices(self.values)
            if self.kind in _INTEGERS and found.size:
                limits = np.iinfo(self.kind)
                if not limits.min <= found.min() <= found.max() <= limits.max:
                    raise ValueError("a number is too large for its type")
            return found
        if self.kind in _INTEGERS:
            return self.values.astype(np.int64)
        return whole(self.floats())


def _floats(words: list[bytes]) -> Floats:
    try:
        return numbers(words)
    except MeshError:
        raise
    except ValueError:
        # Infinite values and NaN, at vertices that no face uses.
        if any(b"_" in word for word in words):
            raise
        return np.array([float(word) for word in words])


def binary_tables(data: bytes, elements: list[Element], order: str) -> list[dict[str, Column]]:
    """The columns of all elements, by their names."""
    tables, offset = [], 0
    for element in elements:
        try:
            columns, offset = _binary(data, offset, element, order)
        except (struct.error, ValueError, OverflowError, IndexError, MemoryError) as error:
            raise ends_early(element) from error
        tables.append(columns)
    return tables


def text_tables(data: bytes, elements: list[Element]) -> list[dict[str, Column]]:
    """The columns of all elements, one row a line, or wherever its lines are broken."""
    lines = iter([line.split() for line in data.splitlines() if line.strip()])
    words = iter(data.split())
    try:
        return [_text(list(itertools.islice(lines, e.size)), e) for e in elements]
    except (MeshError, ValueError) as error:
        try:
            tables = [_text(list(_rows_of_words(words, e)), e) for e in elements]
        except ValueError:
            tables = []
        if not tables or next(words, None) is not None:
            raise error
        return tables


def ends_early(element: Element) -> MeshError:
    """What is wrong with a table that is too short, or no table."""
    return MeshError(
        f"the table of {element.size} {element.name} rows ends early or holds no numbers "
        "that its header declares: the file is truncated or corrupt."
    )


def _rows_of_words(words: Iterator[bytes], element: Element) -> Iterator[list[bytes]]:
    for _ in range(element.size):
        row: list[bytes] = []
        for p in element.properties:
            length = 1
            if p.count is not None:
                row += itertools.islice(words, 1)
                length = _length(row)
            before = len(row)
            row += itertools.islice(words, length)
            if len(row) - before < length:
                raise ValueError("no words are left")
        yield row


def _length(words: list[bytes]) -> int:
    if not words or not words[-1].isdigit() or len(words[-1]) > 12:
        raise ValueError("no length of a list")
    return int(words[-1])


def _text(rows: list[list[bytes]], element: Element) -> dict[str, Column]:
    try:
        if len(rows) < element.size:
            raise ValueError(f"{len(rows)} rows")
        return _columns_of_words(rows, element)
    except (ValueError, IndexError) as error:
        raise ends_early(element) from error


def _columns_of_words(rows: list[list[bytes]], element: Element) -> dict[str, Column]:
    columns: dict[str, Column] = {}
    at = np.zeros(len(rows), dtype=np.int64)
    for p in element.properties:
        if p.count is None:
            lengths: Ints = np.ones(len(rows), dtype=np.int64)
        else:
            lengths = np.array([_length(row[i : i + 1]) for row, i in zip(rows, at)], np.int64)
            at += 1
        tokens = [row[i : i + n] for row, i, n in zip(rows, at, lengths)]
        flat = list(itertools.chain.from_iterable(tokens))
        if len(flat) != lengths.sum():
            raise ValueError("a row is too short")
        columns[p.name] = Column(p.kind, flat, lengths)
        at += lengths
    return columns


def _binary(
    data: bytes, offset: int, element: Element, order: str
) -> tuple[dict[str, Column], int]:
    """The columns of one table and where the next one begins."""
    if element.size == 0:
        empty = np.zeros(0, dtype=np.int64)
        return {p.name: Column("i8", empty, empty) for p in element.properties}, offset
    first, _ = _row(data, offset, element, order)
    fields: list[tuple[Any, ...]] = []
    for k, (p, values) in enumerate(zip(element.properties, first)):
        if p.count is not None:
            fields.append((f"n{k}", order + p.count))
        fields.append((f"v{k}", order + p.kind, (len(values),)))
    dtype = np.dtype(fields)
    end = offset + element.size * dtype.itemsize
    if end <= len(data):
        table = np.frombuffer(data, dtype, element.size, offset)
        lengths = [name for name in dtype.names or () if name.startswith("n")]
        if all((table[name] == table[name][0]).all() for name in lengths):
            return {
                p.name: _uniform(p, table[f"v{k}"]) for k, p in enumerate(element.properties)
            }, end
    return _walked(data, offset, element, order)


def _uniform(p: Property, values: NDArray[Any]) -> Column:
    return Column(p.kind, values.ravel(), np.full(len(values), values.shape[1]))


def _walked(
    data: bytes, offset: int, element: Element, order: str
) -> tuple[dict[str, Column], int]:
    rows = []
    for _ in range(element.size):
        row, offset = _row(data, offset, element, order)
        rows.append(row)
    columns: dict[str, Column] = {}
    for k, p in enumerate(element.properties):
        lengths = np.array([len(row[k]) for row in rows], dtype=np.int64)
        values = np.array(list(itertools.chain.from_iterable(r[k] for r in rows)), dtype=p.kind)
        columns[p.name] = Column(p.kind, values, lengths)
    return columns, offset


def _row(
    data: bytes, offset: int, element: Element, order: str
) -> tuple[list[tuple[float, ...]], int]:
    """One row, a tuple of numbers for each property, and where the next row begins."""
    row: list[tuple[float, ...]] = []
    for p in element.properties:
        n = 1
        if p.count is not None:
            (n,) = struct.unpack_from(order + _STRUCT[p.count], data, offset)
            offset += struct.calcsize(order + _STRUCT[p.count])
        layout = f"{order}{n}{_STRUCT[p.kind]}"
        row.append(struct.unpack_from(layout, data, offset))
        offset += struct.calcsize(layout)
    return row, offset
