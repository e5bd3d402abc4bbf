"""Keys and labels of points: keys of crossings are numbers, and text when somebody asks for one.

A crossing is called by its two lines, its sense and its birth: ``WL 1 x ST 4 +1``. As text that is
100 bytes and more for each, which all say the names of a few hundred lines again; as the numbers of
the lines, the sense and the birth it is 12. Keys of other points stay as they are. Of labels, which
designers give to few points, only those are held that there are.

Examples
--------
>>> from assoc_hull.model.keys import Keys, crossing_key
>>> keys = Keys([crossing_key("WL 1", "ST 4", 1, 1), "ST 4/1 @ (1.0, 2.0, 3.0)"])
>>> keys[0], len(keys), "ST 4/1 @ (1.0, 2.0, 3.0)" in keys
('WL 1 x ST 4 +1', 2, True)
"""

from __future__ import annotations

import operator
from collections.abc import Iterable, Iterator, Sequence
from typing import Self, SupportsIndex, overload

import attrs
import numpy as np

from assoc_hull.graph.table import ValueColumn

__all__ = ["KeyColumn", "Keys", "LabelColumn", "Labels", "crossing_key", "keys", "labels"]

_MARKS = {1: "+", -1: "-", 0: "o"}
_SENSES = "+-o"
_BETWEEN = " x "
_DIGITS = 8
"""Births of more digits, which no hull has, are left as text; a mark fits into an int32."""

_NONE = 0, -1, 0
"""The key of a new row: the first text, which is empty."""


def crossing_key(a: str, b: str, sign: int, birth: int) -> str:
    """Give the key of a crossing, by the keys of its lines; the sense is nil where they touch."""
    return f"{a}{_BETWEEN}{b} {_MARKS[sign]}{birth}"


def _read(key: str) -> tuple[str, str, int] | None:
    """Take the key of a crossing apart: its lines, and birth and sense as one number; or None.

    The same text comes back, wherever the key of a line says " x " as well.
    """
    lines, _, mark = key.rpartition(" ")
    a, between, b = lines.partition(_BETWEEN)
    digits = mark[1:]
    if not between or mark[:1] not in _SENSES or len(digits) > _DIGITS:
        return None
    if not (digits.isascii() and digits.isdecimal()) or digits[0] == "0":
        return None
    return a, b, 3 * int(digits) + _SENSES.index(mark[0])


class Keys(Sequence[str]):
    """A growing list of keys that takes the room of numbers."""

    def __init__(self, texts: Iterable[str] = ()) -> None:
        self._parts, self._numbers = [""], dict[str, int]()
        self._codes = np.zeros((0, 3), np.int32)
        self._count = 0
        self.extend(texts)

    def copy(self) -> Self:
        """Give a list of the same keys."""
        found = object.__new__(type(self))
        found._parts, found._numbers = self._parts.copy(), self._numbers.copy()
        found._codes, found._count = self._codes.copy(), self._count
        return found

    def for_looks(self, count: int) -> Sequence[str]:
        """Give the same keys for so many looks at single ones: many are faster in a plain list."""
        return self if 2 * count < self._count else list(self)

    def extend(self, texts: Iterable[str]) -> None:
        """Put keys behind the last one."""
        codes = [self._code(text) for text in texts]
        count = self._count + len(codes)
        if count > len(self._codes):
            # Few hulls grow much once they are made: a half more is room enough.
            grown = np.zeros((max(count, self._count + self._count // 2), 3), np.int32)
            grown[: self._count] = self._codes[: self._count]
            self._codes = grown
        self._codes[self._count : count] = np.array(codes, np.int32).reshape(-1, 3)
        self._count = count

    def _code(self, text: str) -> tuple[int, int, int]:
        """Give the numbers of both lines and the mark; or of a text, -1, and nil."""
        if not text:
            return _NONE
        if (found := _read(text)) is not None:
            return self._part(found[0]), self._part(found[1]), found[2]
        self._parts.append(text)
        return len(self._parts) - 1, -1, 0

    def _part(self, line: str) -> int:
        """Give the number of a line."""
        number = self._numbers.get(line)
        if number is None:
            number = len(self._parts)
            # In this order: broken off between the two, the number is given to nobody.
            self._parts.append(line)
            self._numbers[line] = number
        return number

    def _texts(self, codes: np.typing.NDArray[np.int32]) -> Iterator[str]:
        parts = self._parts
        for a, b, mark in codes.tolist():
            if b < 0:
                yield parts[a]
            else:
                yield f"{parts[a]}{_BETWEEN}{parts[b]} {_SENSES[mark % 3]}{mark // 3}"

    def __contains__(self, text: object) -> bool:
        # Texts of all keys would have to be made, to be compared.
        if not isinstance(text, str):
            return False
        mine = self._codes[: self._count]
        if (found := _read(text)) is not None:
            a, b = self._numbers.get(found[0]), self._numbers.get(found[1])
            known = a is not None and b is not None
            return known and bool((mine == np.array([a, b, found[2]])).all(axis=1).any())
        place = -1
        while True:
            try:
                place = self._parts.index(text, place + 1)
            except ValueError:
                return False
            # It may be the key of a line alone, or one that was taken back.
            if ((mine[:, 0] == place) & (mine[:, 1] < 0)).any():
                return True

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[str]:
        return self._texts(self._codes[: self._count])

    @overload
    def __getitem__(self, row: SupportsIndex) -> str: ...

    @overload
    def __getitem__(self, row: slice) -> list[str]: ...

    def __getitem__(self, row: SupportsIndex | slice) -> str | list[str]:
        if isinstance(row, slice):
            return list(self._texts(self._codes[: self._count][row]))
        place, count = operator.index(row), self._count
        if not -count <= place < count:
            raise IndexError(f"row {place} is none of {count}")
        codes: list[int] = self._codes[place if place >= 0 else place + count].tolist()
        a, b, mark = codes
        if b < 0:
            return self._parts[a]
        return f"{self._parts[a]}{_BETWEEN}{self._parts[b]} {_SENSES[mark % 3]}{mark // 3}"

    def __setitem__(self, row: SupportsIndex | slice, text: str | Sequence[str]) -> None:
        mine = self._codes[: self._count]
        if isinstance(text, Keys) and row == slice(None) and len(text) == self._count:
            other = text.copy()
            self._parts, self._numbers, self._codes = other._parts, other._numbers, other._codes
        elif isinstance(text, str):
            mine[row] = self._code(text)
        else:
            mine[row] = np.array([self._code(each) for each in text], np.int32).reshape(-1, 3)

    def __delitem__(self, rows: slice) -> None:
        """Take out the last ones; what is left of them is of no row."""
        if rows.start < self._count:
            self._count = rows.start

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and list(self) == list(other)

    __hash__ = None  # type: ignore[assignment]


class Labels(Sequence[str]):
    """A growing list of texts of which most are empty: only the others take room."""

    def __init__(self, texts: Sequence[str] = ()) -> None:
        self._given, self._count = dict[int, str](), 0
        self.extend(texts)

    def copy(self) -> Self:
        """Give a list of the same texts."""
        found = object.__new__(type(self))
        found._given, found._count = self._given.copy(), self._count
        return found

    def extend(self, texts: Sequence[str]) -> None:
        """Put texts behind the last one."""
        first = self._count
        self._count = first + len(texts)
        self[first:] = texts

    @property
    def given(self) -> dict[int, str]:
        """Those that are not empty, by row."""
        return self._given

    def __len__(self) -> int:
        return self._count

    def __iter__(self) -> Iterator[str]:
        return (self._given.get(row, "") for row in range(self._count))

    @overload
    def __getitem__(self, row: SupportsIndex) -> str: ...

    @overload
    def __getitem__(self, row: slice) -> list[str]: ...

    def __getitem__(self, row: SupportsIndex | slice) -> str | list[str]:
        rows = range(self._count)[row]
        if isinstance(rows, int):
            return self._given.get(rows, "")
        return [self._given.get(each, "") for each in rows]

    def __setitem__(self, row: SupportsIndex | slice, text: str | Sequence[str]) -> None:
        rows = range(self._count)[row]
        if isinstance(rows, int):
            self._set(rows, str(text))
        elif isinstance(text, Labels) and row == slice(None) and len(text) == self._count:
            self._given = text._given.copy()
        else:
            for each, one in zip(rows, text, strict=True):
                self._set(each, one)

    def _set(self, row: int, text: str) -> None:
        if text == "":
            self._given.pop(row, None)
        else:
            self._given[row] = text

    def __delitem__(self, rows: slice) -> None:
        """Take out the last ones."""
        for row in range(rows.start, self._count):
            self._given.pop(row, None)
        self._count = min(self._count, rows.start)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Sequence) and list(self) == list(other)

    __hash__ = None  # type: ignore[assignment]


class LabelColumn(ValueColumn[str]):
    """A column of texts of which most are empty."""

    def __init__(self) -> None:
        super().__init__("")

    @property  # type: ignore[override]  # a list in other columns
    def data(self) -> Labels:
        """The texts."""
        return self._labels

    @data.setter
    def data(self, texts: Sequence[str]) -> None:
        self._labels = texts if isinstance(texts, Labels) else Labels(texts)


def labels() -> LabelColumn:
    """Declare a column of labels; new rows have none."""
    return attrs.field(factory=LabelColumn, init=False)


class KeyColumn(ValueColumn[str]):
    """A column of keys."""

    def __init__(self) -> None:
        super().__init__("")

    @property  # type: ignore[override]  # a list in other columns
    def data(self) -> Keys:
        """The keys, which are texts where they are asked for."""
        return self._keys

    @data.setter
    def data(self, texts: Sequence[str]) -> None:
        self._keys = texts if isinstance(texts, Keys) else Keys(texts)


def keys() -> KeyColumn:
    """Declare a column of keys; those of new rows are empty."""
    return attrs.field(factory=KeyColumn, init=False)
