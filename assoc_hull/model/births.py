"""How many crossings each pair of lines has ever had, in arrays.

A net has about as many pairs as crossings. In a dict, a pair of texts and its count take 200 bytes,
which is more than all places of a crossing do; here they take 12.

Examples
--------
>>> from assoc_hull.model.births import Births
>>> births = Births.of({("a", "b"): 1, ("a", "c"): 2})
>>> births = births.counted({("a", "b"): 0, ("c", "b"): 1})
>>> births["a", "c"], births.get(("a", "b"), 0), len(births)
(2, 0, 2)
"""

from __future__ import annotations

from collections.abc import ItemsView, Iterator, Mapping, ValuesView

import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import IntArray

__all__ = ["Births", "Pair"]

Pair = tuple[str, str]
"""The keys of two lines."""

_SHIFT = 32
"""A pair is one number: that of its first line so many bits up, and that of its second."""
_SECOND = (1 << _SHIFT) - 1


class Births(Mapping[Pair, int]):
    """Counts by pairs of lines, by the keys of the lines; it never changes."""

    __slots__ = ("_codes", "_counts", "_keys", "_numbers")

    def __init__(
        self,
        keys: tuple[str, ...],
        numbers: dict[str, int],
        codes: IntArray,
        counts: NDArray[np.int32],
    ) -> None:
        self._keys, self._numbers = keys, numbers
        self._codes, self._counts = codes, counts

    @classmethod
    def of(cls, counts: Mapping[Pair, int]) -> Births:
        """Take counts of pairs."""
        return cls((), {}, np.zeros(0, np.int64), np.zeros(0, np.int32))._with(counts)

    def counted(self, counts: Mapping[Pair, int]) -> Births:
        """Give other counts of some pairs; a count of 0 takes a pair out."""
        found = self._with(counts)
        some = found._counts != 0
        return Births(found._keys, found._numbers, found._codes[some], found._counts[some])

    def _with(self, counts: Mapping[Pair, int]) -> Births:
        numbers = dict(self._numbers)
        given = np.array(
            [
                numbers.setdefault(a, len(numbers)) << _SHIFT | numbers.setdefault(b, len(numbers))
                for a, b in counts
            ],
            np.int64,
        )
        kept = ~np.isin(self._codes, given)
        codes = np.concatenate([self._codes[kept], given])
        values = np.array(list(counts.values()), np.int32)
        every = np.concatenate([self._counts[kept], values])
        order = np.argsort(codes, kind="stable")
        return Births(tuple(numbers), numbers, codes[order], every[order])

    def differing(self, other: Births) -> list[Pair]:
        """Give the pairs that have another count in another one, which was made of this one."""
        if other._keys[: len(self._keys)] != self._keys:
            mine, theirs = dict(self.items()), dict(other.items())
            return sorted(p for p in {*mine, *theirs} if mine.get(p) != theirs.get(p))
        codes = np.concatenate([self._codes, other._codes])
        counts = np.concatenate([self._counts, other._counts])
        # What both have alike stands there twice.
        both = np.stack([codes, counts.astype(np.int64)], axis=1)
        rows, often = np.unique(both, axis=0, return_counts=True)
        return sorted({other._pair(code) for code in rows[often == 1, 0].tolist()})

    def _pair(self, code: int) -> Pair:
        return self._keys[code >> _SHIFT], self._keys[code & _SECOND]

    def _count(self, pair: Pair) -> int:
        """Give the count of a pair, 0 if it has none."""
        first, second = self._numbers.get(pair[0]), self._numbers.get(pair[1])
        if first is None or second is None:
            return 0
        code = first << _SHIFT | second
        place = int(self._codes.searchsorted(code))
        there = place < len(self._codes) and int(self._codes[place]) == code
        return int(self._counts[place]) if there else 0

    def __getitem__(self, pair: Pair) -> int:
        count = self._count(pair)
        if not count:
            raise KeyError(pair)
        return count

    def __iter__(self) -> Iterator[Pair]:
        return map(self._pair, self._codes.tolist())

    def __len__(self) -> int:
        return len(self._codes)

    def values(self) -> ValuesView[int]:
        """Give all counts."""
        return dict(self.items()).values()

    def items(self) -> ItemsView[Pair, int]:
        """Give all at once, which is faster than pair by pair."""
        return dict(zip(self, self._counts.tolist(), strict=True)).items()
