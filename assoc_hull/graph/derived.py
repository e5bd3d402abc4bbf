"""What was made of the columns of tables, kept as long as nothing is written that it depends on.

Examples
--------
>>> import numpy as np
>>> from assoc_hull.graph.derived import Derived
>>> from assoc_hull.graph.table import NumberColumn
>>> height, derived = NumberColumn(np.float64, (), 0.0), Derived()
>>> derived.give(("sum",), (height,), lambda: [float(height.data.sum())])
[0.0]
>>> height.resize(3)
>>> derived.give(("sum",), (height,), lambda: [float(height.data.sum()), 3])
[0.0, 3]
>>> derived.give(("sum",), (height,), lambda: [])
[0.0, 3]
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from functools import partial
from operator import is_
from typing import TypeVar, cast

import attrs

from assoc_hull.graph.gate import Gate
from assoc_hull.graph.table import Column, ValueColumn

__all__ = ["Derived", "Key", "Marked", "Objects", "same_objects"]

T = TypeVar("T")

Key = tuple[Hashable, ...]
"""What is asked for: of which kind, and whatever else tells one thing of the kind from another."""


def same_objects(one: Sequence[object], other: Sequence[object]) -> bool:
    """Tell whether two sequences hold the very same objects."""
    return len(one) == len(other) and all(map(is_, one, other))


@attrs.frozen(eq=False)
class Objects:
    """Some objects, equal only to the very same ones: something that a thing depends on."""

    items: Sequence[object]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Objects) and same_objects(self.items, other.items)

    def __hash__(self) -> int:
        return hash(tuple(map(id, self.items)))


@attrs.frozen(eq=False)
class _Entry:
    depends_on: tuple[object, ...]
    stamp: tuple[object, ...]
    value: object

    def holds(self) -> bool:
        """Tell whether the columns that it depends on are as they were."""
        return _stamp(self.depends_on) == self.stamp


def _stamp(depends_on: tuple[object, ...]) -> tuple[object, ...]:
    """Give what differs as soon as something is written that a thing depends on."""
    return tuple(map(_state_of, depends_on))


def _state_of(part: object) -> object:
    return part.writes if isinstance(part, Column | ValueColumn) else part


Marked = Mapping[Hashable, Mapping[Key, _Entry]]
"""All that was kept at one time."""


@attrs.frozen(eq=False)
class Derived:
    """Things by kind and key, the last one of each, those that were asked for last at the end.

    Several threads may ask; what two ask for at once may be made twice.
    """

    _kinds: dict[Hashable, dict[Key, _Entry]] = attrs.field(factory=dict, init=False)
    _most: dict[Hashable, int] = attrs.field(factory=dict, init=False)
    _gate: Gate = attrs.field(factory=Gate, init=False)

    def __reduce__(self) -> tuple[type[Derived], tuple[()]]:
        # In another process all is made anew.
        return Derived, ()

    def give(
        self, key: Key, depends_on: tuple[object, ...], make: Callable[[], T], most: int = 64
    ) -> T:
        """Give what was made last for a key, if nothing that it depends on has changed since.

        Parameters
        ----------
        key : tuple
            The kind, then what else tells the thing from others of the kind.
        depends_on : tuple
            Columns, `Objects`, and other values that are compared.
        make : callable
            Makes it anew; always of one type for one kind. It must not be changed by who gets it.
        most : int
            So many of a kind are kept; the one that was not asked for longest goes.
        """
        stamp = _stamp(depends_on)
        entry = self._kinds.get(key[0], {}).get(key)
        if entry is None or entry.stamp != stamp:
            entry = _Entry(depends_on, stamp, make())
        self._gate.alone(partial(self._put, key, entry, most))
        # One kind is made by one function, so its type is that of `make`.
        return cast("T", entry.value)

    def _put(self, key: Key, entry: _Entry, most: int) -> None:
        """Keep an entry as the last of its kind."""
        kind = self._kinds.setdefault(key[0], {})
        kind.pop(key, None)
        kind[key] = entry
        self._most[key[0]] = most
        self._trim(key[0])

    def _trim(self, name: Hashable) -> None:
        """Let go of what was not asked for longest, where there is more of a kind than is kept."""
        kind, most = self._kinds[name], self._most.get(name)
        while most is not None and len(kind) > most:
            del kind[next(iter(kind))]

    def mark(self) -> Marked:
        """Give all that is kept now, for `restore`."""
        return self._gate.alone(
            lambda: {kind: dict(entries) for kind, entries in self._kinds.items()}
        )

    def add(self, other: Derived) -> None:
        """Keep what another one does as well; it is true where the columns are the same."""
        self._gate.alone(partial(self._add, other.mark(), dict(other._most)))

    def _add(self, known: Marked, most: Mapping[Hashable, int]) -> None:
        self._most.update(most)
        for kind, entries in known.items():
            mine = self._kinds.setdefault(kind, {})
            for key, entry in entries.items():
                mine.setdefault(key, entry)
            # Else what states hand on from one to the next would pile up.
            self._trim(kind)

    def restore(self, mark: Marked) -> None:
        """Bring back what was kept, as the columns are again what they were then.

        What was made meanwhile stays if it is true now: what was kept may have been out of date.
        """
        self._gate.alone(partial(self._restore, mark))

    def _restore(self, mark: Marked) -> None:
        for kind, entries in self._kinds.items():
            before = mark.get(kind, {})
            for key, entry in tuple(entries.items()):
                if entry is not before.get(key) and not entry.holds():
                    del entries[key]
        for kind, known in mark.items():
            kept = self._kinds.setdefault(kind, {})
            for key, entry in known.items():
                kept.setdefault(key, entry)
            self._trim(kind)
