"""What is made of the columns of tables and kept while they stay, behind a lock of its own.

A lock for a few statements, which an interrupt at any of them leaves open.

A ``with`` block of a lock has a place, between its last statement and the release, at which an
interrupt leaves the lock taken: every other thread would wait for ever.

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
>>> from assoc_hull.graph.derived import Gate
>>> Gate().alone(lambda: 1 + 1)
2
"""

from __future__ import annotations

import threading
from collections.abc import (
    Callable,
    Hashable,
    Mapping,
    Sequence,
)
from functools import partial
from operator import is_
from typing import TypeVar, cast

import attrs

from assoc_hull.graph.table import Column, ValueColumn

__all__ = ["Derived", "Gate", "Key", "Marked", "Objects", "same_objects"]

T = TypeVar("T")


@attrs.frozen(eq=False)
class Gate:
    """Lets one thread in at a time; what is done inside must not come to the gate again."""

    # A lock of this kind alone refuses to be released by a thread that has not taken it.
    _lock: threading.RLock = attrs.field(factory=threading.RLock, init=False)

    def __reduce__(self) -> tuple[type[Gate], tuple[()]]:
        # In another process, or in a copy, nobody is inside.
        return Gate, ()

    def alone(self, act: Callable[[], T]) -> T:
        """Do something while no other thread is inside."""
        try:
            with self._lock:
                return act()
        finally:
            try:  # noqa: SIM105  # `suppress` takes three times as long, thirty times an edit
                self._lock.release()
            except RuntimeError:  # it has been given back: the usual case
                pass


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


Marked = Mapping[Hashable, dict[Key, _Entry]]
"""All that was kept at one time."""

_NOTHING: dict[Key, _Entry] = {}


@attrs.frozen(eq=False)
class Derived:
    """Things by kind and key, the last one of each, those that were asked for last at the end.

    Several threads may ask; what two ask for at once may be made twice. The things of one kind
    stand in a dict that is never changed, so that marks and other tables share it.
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
        stamp, kind = _stamp(depends_on), self._kinds.get(key[0], _NOTHING)
        entry = kind.get(key)
        if entry is None or entry.stamp != stamp:
            entry = _Entry(depends_on, stamp, make())
        elif kind[next(reversed(kind))] is entry:
            return cast("T", entry.value)  # it is the last of its kind already
        self._gate.alone(partial(self._put, key, entry, most))
        # One kind is made by one function, so its type is that of `make`.
        return cast("T", entry.value)

    def _put(self, key: Key, entry: _Entry, most: int) -> None:
        """Keep an entry as the last of its kind."""
        kind = dict(self._kinds.get(key[0], _NOTHING))
        kind.pop(key, None)
        kind[key] = entry
        self._most[key[0]] = most
        self._kinds[key[0]] = self._trimmed(key[0], kind)

    def _trimmed(self, name: Hashable, kind: dict[Key, _Entry]) -> dict[Key, _Entry]:
        """Let go of what was not asked for longest, where there is more of a kind than is kept."""
        most = self._most.get(name, len(kind))
        return dict(tuple(kind.items())[-most:]) if len(kind) > most else kind

    def mark(self) -> Marked:
        """Give all that is kept now, for `restore`."""
        return self._gate.alone(self._kinds.copy)

    def add(self, other: Derived) -> None:
        """Keep what another one does as well; it is true where the columns are the same."""
        self._gate.alone(partial(self._add, other.mark(), dict(other._most)))

    def add_some(self, other: Derived, kinds: Sequence[Hashable]) -> None:
        """Keep of some kinds what another one does, where the columns have the same content."""
        known = {kind: entries for kind, entries in other.mark().items() if kind in kinds}
        self._gate.alone(partial(self._add, known, dict(other._most)))

    def _add(self, known: Marked, most: Mapping[Hashable, int]) -> None:
        self._most.update(most)
        for kind, entries in known.items():
            mine = self._kinds.get(kind)
            if mine is None:
                self._kinds[kind] = entries
            elif mine is not entries and not entries.keys() <= mine.keys():
                both = {**mine, **{k: entries[k] for k in entries if k not in mine}}
                # Else what states hand on from one to the next would pile up.
                self._kinds[kind] = self._trimmed(kind, both)

    def restore(self, mark: Marked) -> None:
        """Bring back what was kept, as the columns are again what they were then.

        What was made meanwhile stays if it is true now: what was kept may have been out of date.
        """
        self._gate.alone(partial(self._restore, mark))

    def _restore(self, mark: Marked) -> None:
        for kind, entries in tuple(self._kinds.items()):
            before = mark.get(kind, _NOTHING)
            if entries is not before:
                self._kinds[kind] = {
                    key: entry for key, entry in entries.items()
                    if entry is before.get(key) or entry.holds()
                }  # fmt: skip
        self._add(mark, {})
