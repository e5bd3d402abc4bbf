"""Who may write the tables of a hull: one thread and task at a time, and the others are told.

Another thread may wait for its turn. Another task of the same thread may not: while it waited, the
loop that its predecessor needs to end would stand still.

Examples
--------
>>> from assoc_hull.edit.write_lock import WriteLock
>>> lock, move, pull = WriteLock(), object(), object()
>>> lock.take(move, "the edit 'move'", where="in the edit 'move'")
>>> lock.held_here
True
>>> lock.give_back(pull)
>>> lock.held_by(move)
True
"""

from __future__ import annotations

import asyncio
import threading
import time

import attrs

from assoc_hull.errors import BadInputError, HullBusyError

__all__ = ["LOOK_AGAIN", "PATIENCE", "Activity", "WriteLock"]

PATIENCE = 5.0
"""So long another thread waits for its turn where nothing else is asked for, s."""

LOOK_AGAIN = 0.002
"""After so long it looks whether its turn has come, s."""

_GONE = 0.5
"""Who has not looked for so long is passed over: it may have been broken off, s."""


@attrs.frozen
class Activity:
    """A thread, and the task of it that is running; None outside a loop."""

    thread: int
    task: asyncio.Task[object] | None

    @classmethod
    def here(cls) -> Activity:
        """Give the one that calls."""
        try:
            task = asyncio.current_task()
        except RuntimeError:  # no loop runs in this thread
            task = None
        return cls(threading.get_ident(), task)


@attrs.frozen(eq=False)
class _Turn:
    holder: object
    whose: Activity
    what: str
    author: str


@attrs.frozen(eq=False)
class WriteLock:
    """The right to write the tables of one hull; of those that wait, who came first is next."""

    _turn: dict[str, _Turn] = attrs.field(factory=dict, init=False)
    _line: dict[object, tuple[_Turn, float]] = attrs.field(factory=dict, init=False)
    """Who waits, in the order in which they came, and when each has looked last."""

    @property
    def held(self) -> bool:
        """Whether somebody has it."""
        return bool(self._turn)

    @property
    def held_here(self) -> bool:
        """Whether this thread and task have it."""
        turn = self._turn.get("now")
        return turn is not None and turn.whose == Activity.here()

    def take(
        self, holder: object, what: str, author: str = "", *, where: str, wait: float = PATIENCE
    ) -> None:
        """Take it, after waiting (s) for another thread to give it back if need be.

        Raises
        ------
        BadInputError
            This task has it already, for something else.
        HullBusyError
            Another task of this thread has it, or another thread has not given it back in time.
        """
        own, begin = _Turn(holder, Activity.here(), what, author), time.monotonic()
        new = holder not in self._line
        try:
            while (turn := self._next(own)).holder is not holder:
                if turn.whose == own.whose:
                    raise BadInputError(f"{turn.what} is open", where, "end that one first")
                waited, beside = time.monotonic() - begin, turn.whose.thread == own.whose.thread
                if beside or waited >= wait:
                    raise HullBusyError(turn.what, turn.author, waited, where, beside)
                time.sleep(LOOK_AGAIN)
        finally:
            if new:
                self.leave(holder)

    def line_up(self, holder: object, what: str, author: str = "") -> None:
        """Have a place among those that wait, for one who takes it without waiting there."""
        self._line[holder] = _Turn(holder, Activity.here(), what, author), time.monotonic()

    def leave(self, holder: object) -> None:
        """Give up the place among those that wait, if this has one."""
        self._line.pop(holder, None)

    def _next(self, own: _Turn) -> _Turn:
        """Give whose turn it is: `own` if nobody has it or has come before it."""
        now = time.monotonic()
        self._line[own.holder] = own, now  # at the end, or where it stands already
        for first, seen in list(self._line.values()):
            if first is own or "now" in self._turn:
                break
            # One of this thread cannot look before the thread is free again.
            if now - seen < _GONE and first.whose.thread != own.whose.thread:
                return first
        # At once: of several that come together one gets it.
        return self._turn.setdefault("now", own)

    def held_by(self, holder: object) -> bool:
        """Whether this is who has it."""
        turn = self._turn.get("now")
        return turn is not None and turn.holder is holder

    def give_back(self, holder: object) -> None:
        """Give it back, if this is who has it."""
        if self.held_by(holder):
            self._turn.clear()

    def refuse_others(self, where: str) -> None:
        """Refuse what reads or lets go of what somebody else is writing.

        Raises
        ------
        HullBusyError
            Somebody else is.
        """
        turn = self._turn.get("now")
        if turn is not None and turn.whose != (own := Activity.here()):
            beside = turn.whose.thread == own.thread
            raise HullBusyError(turn.what, turn.author, 0.0, where, beside)
