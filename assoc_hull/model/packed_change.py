"""What an edit changed, small: for a history that holds thousands of steps in memory.

A change packs to a few kilobytes: of the bits only words that are not nil, byte by byte of all of
them, so that those alike lie side by side and can be compressed. What runs of a program have
changed their numbers tell; what other edits have, `assoc_hull.model.change.change_of`.

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
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import cast

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.journal import distinct, each_once
from assoc_hull.model.change import (
    CrossingPositions,
    TableChange,
    crossing_positions,
    nothing_lies_elsewhere,
    positions_against,
)
from assoc_hull.model.program.run_program import ProgramRun, RunProgram
from assoc_hull.model.program.structure import Values
from assoc_hull.model.tables import HullState

__all__ = ["PackedArrays", "PackedChange", "change_of_shape", "joined_shapes", "with_strays"]

_Array = NDArray[np.generic]

# --------------------------------------------------------------------------------------
# Arrays in few bytes.

_LEVEL = 1
"""How hard is compressed: more takes longer than the edit, and gains little."""

_WORD = 8

_NOISE = 5
"""So many of the lower bytes of a word are as good as random: to compress them is a waste."""


@attrs.frozen(eq=False)
class PackedArrays:
    """Arrays in two pieces of bytes: numbers and what else can be compressed, and noise."""

    _kinds: tuple[tuple[str, tuple[int, ...]], ...]
    _data: bytes
    _noise: bytes

    @classmethod
    def of(cls, arrays: Sequence[_Array]) -> PackedArrays:
        """Pack arrays; integers of eight bytes must fit in four."""
        numbers, words, plain = list[bytes](), list[bytes](), list[bytes]()
        for each in arrays:
            where = plain if _in_words(each.dtype, each.shape) == 0 else words
            (numbers if each.dtype == np.int64 else where).append(each.tobytes())
        number = np.frombuffer(b"".join(numbers), np.int64).astype(np.int32)
        word = np.frombuffer(b"".join(words), np.int64)
        there = word != 0
        planes = np.ascontiguousarray(word[there].view(np.uint8).reshape(-1, _WORD).T)
        high = planes[_NOISE:].tobytes()
        data = b"".join((number.tobytes(), np.packbits(there).tobytes(), high, *plain))
        kinds = tuple([(each.dtype.str, each.shape) for each in arrays])
        return cls(kinds, zlib.compress(data, _LEVEL), planes[:_NOISE].tobytes())

    def unpack(self) -> list[NDArray[np.generic]]:
        """Give the arrays."""
        kinds = [(np.dtype(kind), shape) for kind, shape in self._kinds]
        numbers = sum(math.prod(shape) for kind, shape in kinds if kind == np.int64)
        words = sum(_in_words(kind, shape) for kind, shape in kinds)
        data = memoryview(zlib.decompress(self._data))
        number = np.frombuffer(data, np.int32, numbers).astype(np.int64)
        begin = 4 * numbers
        there = np.unpackbits(np.frombuffer(data[begin:], np.uint8, -(-words // 8)), count=words)
        begin += -(-words // 8)
        count = len(self._noise) // _NOISE
        stop = begin + (_WORD - _NOISE) * count
        planes = np.frombuffer(self._noise + data[begin:stop], np.uint8).reshape(_WORD, count)
        word = np.zeros(words, np.int64)
        word[there.view(np.bool_)] = np.ascontiguousarray(planes.T).view(np.int64)[:, 0]
        found, a, b = list[_Array](), 0, 0
        for kind, shape in kinds:
            size = math.prod(shape)
            if kind == np.int64:
                found.append(number[a : a + size].reshape(shape))
                a += size
            elif size := _in_words(kind, shape):
                found.append(word[b : b + size].view(kind).reshape(shape))
                b += size
            else:
                found.append(np.frombuffer(data[stop:], kind, math.prod(shape)).reshape(shape))
                stop += kind.itemsize * math.prod(shape)
        return found


def _in_words(kind: np.dtype[np.generic], shape: tuple[int, ...]) -> int:
    """Give as how many words an array is packed; 0 if it is not."""
    size = kind.itemsize * math.prod(shape)
    return size // _WORD if kind.kind in "uf" and size % _WORD == 0 else 0


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


def change_of_shape(
    runner: RunProgram, before: Values, after: Values, runs: Sequence[ProgramRun], ridden: IntArray
) -> TableChange:
    """Give the net effect of runs that took the numbers of a net from some to others.

    `ridden` (k,) are points that ride from elsewhere than before. Where points lie on curves their
    meetings tell.
    """
    program = runner.program
    local = each_once([each.curves for each in runs])
    curves = program.number.take(local)
    order = np.argsort(curves)
    lofted, local = curves.take(order), local.take(order)
    watched = each_once([each.watched for each in runs])
    crossings = program.watch.take(watched)
    rows = distinct(np.concatenate([crossings, *(each.rows for each in runs)]))
    found = runner.compare(after, before, rows, watched, local)
    bits = {
        "rows.xyz": (found.rows, found.xyz.view(np.uint8)),
        "rows.gap": (program.watch.take(found.watched), found.gap.view(np.uint8)),
        "rows.anchor_from": _differing(before.anchor_from, after.anchor_from, ridden),
        "rows.base": _differing(before.base, after.base, ridden),
    }
    return attrs.evolve(
        _NOTHING,
        bits={name: each for name, each in bits.items() if len(each[0])},
        met=(program.number.take(found.curves), found.met.view(np.uint8)), lofted=lofted,
    )  # fmt: skip


def joined_shapes(state: HullState, changes: Iterable[TableChange]) -> TableChange:
    """Give what changes that keep the structure of tables, one behind the other, do together.

    An exclusive or runs both ways and in any order, so that the curves need be lofted but once.
    """
    bits: dict[str, tuple[list[IntArray], list[_Words]]] = {}
    met, moved = _ByCurve(partial(_meetings, state)), _ByCurve(partial(_places, state))
    lofted = [np.zeros(0, np.int64)]
    for change in changes:
        for name, (rows, bit) in change.bits.items():
            every = bits.setdefault(name, ([], []))
            every[0].append(rows)
            every[1].append(_words(bit))
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


_Words = NDArray[np.int64]


def _words(values: _Array) -> _Words:
    """Give the bits of each row as words, (k, words)."""
    width = values.itemsize * math.prod(values.shape[1:]) // _WORD
    return np.ascontiguousarray(values).view(np.int64).reshape(len(values), width)


def _taken_together(
    rows: Sequence[IntArray], bits: Sequence[_Words]
) -> tuple[IntArray, NDArray[np.uint8]]:
    """Join what several writes changed: the rows that differ in the end, ascending, and bytes."""
    row, bit = np.concatenate(rows), np.concatenate(bits)
    if not (row[1:] > row[:-1]).all():
        order = np.argsort(row, kind="stable")
        row, bit = row[order], bit[order]
        first = np.flatnonzero(np.concatenate([[True], row[1:] != row[:-1]]))
        if len(first) < len(row):
            row, bit = row[first], np.bitwise_xor.reduceat(bit, first, axis=0)
    odd = bit.any(axis=1)
    return row[odd], bit[odd].view(np.uint8)


def _differing(
    before: FloatArray, after: FloatArray, rows: IntArray
) -> tuple[IntArray, NDArray[np.uint8]]:
    """Compare rows of two arrays: those that differ, and the bits."""
    if not len(rows):
        return rows, np.zeros((0, 0), np.uint8)
    bits = _words(before.take(rows, axis=0)) ^ _words(after.take(rows, axis=0))
    odd = bits.any(axis=1)
    return rows[odd], bits[odd].view(np.uint8)


def with_strays(state: HullState, change: TableChange) -> TableChange:
    """Give a change as `change_of` does, with all places on curves, right before it or after it."""
    curves, bits = change.met
    if not len(curves):
        return change
    found = crossing_positions(state, curves)
    every = np.zeros((len(found.line), bits.shape[1]), np.uint8)
    every[found.line >= 0] = bits
    return attrs.evolve(change, moved=(curves, every), met=nothing_lies_elsewhere())
