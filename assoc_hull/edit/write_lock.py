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

    def waits_beside(self, other: Activity) -> bool:
        """Tell whether the loop that runs the other one runs this task as well, if it goes on."""
        one, two = self.task, other.task
        if one is None or two is None or one is two or one.done():
            return False
        return one.get_loop() is two.get_loop()


@attrs.frozen(eq=False)
class _Turn:
    holder: object
    whose: Activity
    what: str
    author: str
    awaits: bool = False
    """Whether it was lined up: then the loop of its task runs on while it waits."""

    def comes_after(self, first: _Turn, silent: float) -> bool:
        """Tell whether it lets another one that waits go first, which has not looked so long, s."""
        if first.whose.thread != self.whose.thread:
            return silent < _GONE
        # One of this thread can look only when the thread is free again, and then does so surely:
        # in the meantime who waits without the loop would stop it, and who awaits does not.
        return self.awaits and first.awaits and first.whose.waits_beside(self.whose)


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
        begin, new = time.monotonic(), holder not in self._line
        own = _Turn(holder, Activity.here(), what, author, awaits=not new)
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
        turn = _Turn(holder, Activity.here(), what, author, awaits=True)
        self._line[holder] = turn, time.monotonic()

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
            if own.comes_after(first, now - seen):
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
