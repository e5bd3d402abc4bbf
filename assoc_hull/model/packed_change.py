"""What an edit changed, small: for a history that holds thousands of steps in memory.

A change packs to a few kilobytes: of the bits only words that are not nil, byte by byte of all of
them, so that those alike lie side by side, and all of it compressed. A journal of places, splines
and meetings gives its change at any later time, as it holds what was written; that of other edits
is to be taken right after the edit, by `assoc_hull.model.change.change_of`.

Examples
--------
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.edit.transaction import Transaction
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.change import apply_change, change_of
>>> from assoc_hull.model.definition.fingerprint import fingerprint
>>> from assoc_hull.model.packed_change import PackedChange
>>> document = Document(wigley())
>>> before, table = fingerprint(document.state), document.state.rows
>>> with Transaction(document, "move") as edit:
...     edit.write(np.array([9]), table.xyz[[9]] * [1.0, 1.01, 1.0], "the move")
>>> packed = PackedChange.of(change_of(document.state, document.history[-1].journal))
>>> apply_change(document.state, packed.unpack(), forward=False)
>>> fingerprint(document.state) == before
True
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial
from typing import cast

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal, distinct
from assoc_hull.model.change import (
    CrossingPositions,
    TableChange,
    crossing_positions,
    nothing_lies_elsewhere,
    positions_against,
    row_bits,
    table_columns,
)
from assoc_hull.model.tables import CurveIntersections, HullState

__all__ = ["PackedArrays", "PackedChange", "change_of_shape", "joined_shapes", "with_strays"]

_Array = NDArray[np.generic]

# --------------------------------------------------------------------------------------
# Arrays in few bytes.

_LEVEL = 1
"""How hard is compressed: more takes longer than the edit, and gains little."""

_WORD = 8


@attrs.frozen(eq=False)
class PackedArrays:
    """Arrays in one piece of bytes, in the order in which they were given."""

    _kinds: tuple[tuple[str, tuple[int, ...]], ...]
    _data: bytes

    @classmethod
    def of(cls, arrays: Sequence[_Array]) -> PackedArrays:
        """Pack arrays; integers of eight bytes must fit in four."""
        pieces = [piece for each in arrays for piece in _pieces(each)]
        kinds = tuple((each.dtype.str, each.shape) for each in arrays)
        return cls(kinds, zlib.compress(b"".join(pieces), _LEVEL))

    def unpack(self) -> list[NDArray[np.generic]]:
        """Give the arrays."""
        data, at, found = memoryview(zlib.decompress(self._data)), 0, list[_Array]()
        for kind, shape in self._kinds:
            array, at = _read(data, at, np.dtype(kind), shape)
            found.append(array)
        return found


def _in_words(kind: np.dtype[np.generic], shape: tuple[int, ...]) -> int:
    """Give as how many words an array is packed; 0 if it is not."""
    size = kind.itemsize * math.prod(shape)
    return size // _WORD if kind.kind in "uf" and size % _WORD == 0 else 0


def _pieces(array: _Array) -> Iterator[bytes]:
    if array.dtype == np.int64:
        yield array.astype(np.int32).tobytes()
    elif _in_words(array.dtype, array.shape):
        words = np.frombuffer(array.tobytes(), np.int64)
        there = words != 0
        yield np.packbits(there).tobytes()
        yield words[there].view(np.uint8).reshape(-1, _WORD).T.tobytes()
    else:
        yield array.tobytes()


def _read(
    data: memoryview, at: int, kind: np.dtype[np.generic], shape: tuple[int, ...]
) -> tuple[_Array, int]:
    """Give an array that begins at a byte, and the byte behind it."""
    size = math.prod(shape)
    if kind == np.int64:
        stop = at + 4 * size
        return np.frombuffer(data[at:stop], np.int32).astype(np.int64).reshape(shape), stop
    count = _in_words(kind, shape)
    if not count:
        stop = at + kind.itemsize * size
        return np.frombuffer(data[at:stop], kind).reshape(shape), stop
    begin = at + -(-count // 8)
    there = np.unpackbits(np.frombuffer(data[at:begin], np.uint8), count=count).view(np.bool_)
    stop = begin + _WORD * int(np.count_nonzero(there))
    shuffled = np.frombuffer(data[begin:stop], np.uint8).reshape(_WORD, -1)
    words = np.zeros(count, np.int64)
    words[there] = np.ascontiguousarray(shuffled.T).view(np.int64)[:, 0]
    return words.view(kind).reshape(shape), stop


# --------------------------------------------------------------------------------------
# Changes.

_PLACES = ("curve", "count", "line", "sign", "row")
_OF_SHAPE = frozenset({"rows.xyz", "rows.gap", "rows.base", "rows.anchor_from", "rows.faired"})
"""Columns of numbers that tell nothing of the structure."""


def _nothing() -> TableChange:
    whole, none = np.zeros(0, np.int64), CrossingPositions.none()
    return TableChange({}, {}, {}, {}, nothing_lies_elsewhere(), none, none, whole, ({}, {}))


_NOTHING = _nothing()


@attrs.frozen(eq=False)
class PackedChange:
    """A change of which the arrays are packed.

    `of_shape`: several of them in a row can be run as one, see `joined_shapes`.
    """

    of_shape: bool
    _rest: TableChange
    _columns: tuple[str, ...]
    _arrays: PackedArrays

    @classmethod
    def of(cls, change: TableChange) -> PackedChange:
        """Pack a change."""
        arrays: list[_Array] = [change.lofted, *change.met]
        for rows, bits in change.bits.values():
            arrays += [rows, bits]
        before, after = change.before, change.after
        plain = not (change.sizes or change.objects or change.births or any(change.kept))
        plain = plain and not (len(before.curve) or len(after.curve))
        of_shape, columns = plain and _OF_SHAPE.issuperset(change.bits), tuple(change.bits)
        if plain and not len(change.moved[0]):
            return cls(of_shape, _NOTHING, columns, PackedArrays.of(arrays))
        for places, at in ((before, before.at), (after, positions_against(before, after))):
            arrays += [getattr(places, name) for name in _PLACES] + [at]
        rest = attrs.evolve(
            _NOTHING, sizes=change.sizes, objects=change.objects, births=change.births,
            kept=change.kept,
        )  # fmt: skip
        return cls(of_shape, rest, columns, PackedArrays.of([*arrays, *change.moved]))

    def unpack(self) -> TableChange:
        """Give the change."""
        lofted, *pairs = self._arrays.unpack()
        met, *bits = (
            _rows_and_bits(*pairs[i : i + 2]) for i in range(0, 2 * len(self._columns) + 2, 2)
        )
        found = attrs.evolve(
            self._rest, lofted=cast("IntArray", lofted), met=met,
            bits=dict(zip(self._columns, bits, strict=True)),
        )  # fmt: skip
        more = pairs[2 * len(self._columns) + 2 :]
        if not more:
            return found
        count = len(_PLACES) + 1
        before = CrossingPositions(*more[:count])  # type: ignore[arg-type]  # as they were packed
        after = CrossingPositions(*more[count : 2 * count])  # type: ignore[arg-type]  # the same
        after = attrs.evolve(after, at=positions_against(before, after))
        moved = _rows_and_bits(*more[2 * count :])
        return attrs.evolve(found, moved=moved, before=before, after=after)


def _rows_and_bits(rows: _Array, bits: _Array) -> tuple[IntArray, NDArray[np.uint8]]:
    """Say of what type two arrays were when they were packed."""
    return cast("IntArray", rows), cast("NDArray[np.uint8]", bits)


def change_of_shape(state: HullState, journal: Journal) -> TableChange:
    """Give the net effect of a journal, at any later time.

    It has written places of points, gaps, and splines and meetings of curves, no more; and where
    points lie on curves as their meetings say, which therefore tell it.
    """
    written: dict[int, tuple[list[IntArray], list[NDArray[np.uint8]]]] = {}
    for column, rows, old, new in journal.array_writes():
        places, bits = written.setdefault(id(column), ([], []))
        places.append(rows)
        bits.append(row_bits(old) ^ row_bits(new))
    net = {
        name: _taken_together(*written[id(column)])
        for name, column in table_columns(state) if id(column) in written
    }  # fmt: skip
    met = journal.first_and_last(state.curves.meets)
    return attrs.evolve(
        _NOTHING,
        bits={name: found for name, found in net.items() if len(found[0])},
        met=_apart(met.rows, met.old, met.new),
        lofted=journal.first_and_last(state.curves.spline).rows,
    )


def joined_shapes(state: HullState, changes: Iterable[TableChange]) -> TableChange:
    """Give what changes that keep the structure of tables, one behind the other, do together.

    An exclusive or runs both ways and in any order, so that the curves need be lofted but once.
    """
    bits: dict[str, tuple[list[IntArray], list[NDArray[np.uint8]]]] = {}
    met, moved = _ByCurve(partial(_meetings, state)), _ByCurve(partial(_places, state))
    lofted = [np.zeros(0, np.int64)]
    for change in changes:
        for name, (rows, bit) in change.bits.items():
            every = bits.setdefault(name, ([], []))
            every[0].append(rows)
            every[1].append(bit)
        met.join(*change.met)
        moved.join(*change.moved)
        lofted.append(change.lofted)
    return attrs.evolve(
        _NOTHING,
        bits={name: _taken_together(*every) for name, every in bits.items()},
        met=met.together(), moved=moved.together(), lofted=distinct(np.concatenate(lofted)),
    )  # fmt: skip


def _meetings(state: HullState, curve: int) -> int:
    """Give how many meetings a curve has."""
    return len(state.curves.meets[curve].line)


def _places(state: HullState, curve: int) -> int:
    """Give how many places lie on a curve."""
    return len(crossing_positions(state, np.array([curve])).line)


@attrs.define(eq=False)
class _ByCurve:
    """Bits of places on curves, joined curve by curve; `count` tells how many places each has."""

    count: Callable[[int], int]
    known: dict[int, int] = attrs.field(factory=dict)
    bits: dict[int, NDArray[np.uint8]] = attrs.field(factory=dict)

    def join(self, curves: IntArray, bits: NDArray[np.uint8]) -> None:
        """Take up what one change does."""
        start, joined = 0, self.bits
        for curve in curves.tolist():
            if curve not in self.known:
                self.known[curve] = self.count(curve)
            stop = start + self.known[curve]
            apart = bits[start:stop]
            joined[curve] = joined[curve] ^ apart if curve in joined else apart
            start = stop
        if start != len(bits):
            raise ValueError(f"{len(bits)} places on curves are moved, and {start} are there")

    def together(self) -> tuple[IntArray, NDArray[np.uint8]]:
        """Give what all of them do."""
        curves = sorted(self.bits)
        every = [nothing_lies_elsewhere()[1], *(self.bits[curve] for curve in curves)]
        return np.array(curves, np.int64), np.concatenate(every)


def _taken_together(
    rows: Sequence[IntArray], bits: Sequence[NDArray[np.uint8]]
) -> tuple[IntArray, NDArray[np.uint8]]:
    """Join what several writes changed, (k, bytes): the rows that differ in the end, ascending."""
    row, bit = np.concatenate(rows), np.concatenate(bits)
    order = np.argsort(row, kind="stable")
    row, bit = row[order], bit[order]
    first = np.flatnonzero(np.diff(row, prepend=-1))
    if len(first) < len(row):
        row, bit = row[first], np.bitwise_xor.reduceat(bit, first, axis=0)
    odd = bit.any(axis=1)
    return row[odd], bit[odd]


def _apart(
    curves: IntArray, old: Sequence[CurveIntersections], new: Sequence[CurveIntersections]
) -> tuple[IntArray, NDArray[np.uint8]]:
    """Compare meetings of curves; curves with the very same ones are left out."""
    if not len(curves):
        return nothing_lies_elsewhere()
    counts = [len(each.line) for each in new]
    bits = np.empty((sum(counts), 4), np.int64)
    for part, name in ((slice(1), "parameter"), (slice(1, 4), "xyz")):
        were, are = (
            np.concatenate([getattr(each, name).ravel() for each in every]).view(np.int64)
            for every in (old, new)
        )
        bits[:, part] = (were ^ are).reshape(len(bits), -1)
    owner: IntArray = np.repeat(np.arange(len(counts)), counts)
    moved = np.zeros(len(counts), np.bool_)
    moved[owner[bits.any(axis=1)]] = True
    return curves[moved], bits[moved[owner]].view(np.uint8)


def with_strays(state: HullState, change: TableChange) -> TableChange:
    """Give a change as `change_of` does, with all places on curves, right before it or after it."""
    curves, bits = change.met
    if not len(curves):
        return change
    found = crossing_positions(state, curves)
    every = np.zeros((len(found.line), bits.shape[1]), np.uint8)
    every[found.line >= 0] = bits
    return attrs.evolve(change, moved=(curves, every), met=nothing_lies_elsewhere())
