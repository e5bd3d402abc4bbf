"""The answer to why an object is as it is: a tree of causes, as lines and as a drawn tree."""

from __future__ import annotations

from collections.abc import Iterator

import attrs

__all__ = ["Why"]

_TOLD = 4
"""So many of the places where a change stopped are named in the text."""

_INDENT = ("  ", "  ", "  ", "  ")
_BRANCH = ("│  ", "   ", "├─ ", "└─ ")
_PLAIN = ("|  ", "   ", "|- ", "`- ")


@attrs.frozen
class Why:
    """The causes of the last change of one object, a tree.

    Attributes
    ----------
    object, name : str
        Key and address of the object.
    edit : str or None
        Name of the edit; None if none has reached the object.
    step : int
        Number of the edit in the history, from 1; 0 if none.
    moved : float or None, m
        By how much the object changed; None where the edit itself set it, or nothing is
        known.
    what : str
        What happened to it.
    causes : tuple of Why
        The objects whose change made this one be evaluated, the one that moved most first.
    stopped : tuple of str
        Where it stopped: objects made from this one that came out as they were.
    """

    object: str
    name: str
    edit: str | None
    step: int
    moved: float | None
    what: str
    causes: tuple[Why, ...] = ()
    stopped: tuple[str, ...] = ()

    def chain(self) -> list[str]:
        """Give the keys from the object back to the edit, by the causes that moved most."""
        found = [self.object]
        link = self
        while link.causes:
            link = link.causes[0]
            found.append(link.object)
        return found

    def __str__(self) -> str:
        return self._text(_INDENT)

    def tree(self, *, plain: bool = False) -> str:
        """Draw the tree of causes, each below what it made change; stops come first.

        Parameters
        ----------
        plain : bool
            Whether to draw with characters of ASCII only.

        Examples
        --------
        >>> from assoc_hull.edit.explain.cause import Why
        >>> point = Why("p", "WL 1 x ST 7", "fair", 1, 0.01, "set by the edit")
        >>> print(Why("c", "ST 7", "fair", 1, None, "followed", (point,), ("WL 2 x ST 7",)).tree())
        edit 1, 'fair':
        ST 7: followed
        ├─ stopped at WL 2 x ST 7: same bits as before
        └─ WL 1 x ST 7: set by the edit, moved 10.000 mm
        """
        return self._text(_PLAIN if plain else _BRANCH)

    def _text(self, marks: tuple[str, str, str, str]) -> str:
        head = [] if self.edit is None else [f"edit {self.step}, {self.edit!r}:"]
        return "\n".join([*head, *self._lines(marks, "", "", set())])

    def _lines(
        self, marks: tuple[str, str, str, str], here: str, below: str, told: set[str]
    ) -> Iterator[str]:
        """Give the lines of this part of the tree.

        `marks` are what goes on beside a branch, below the last one, at a branch, at the
        last one; `here` stands before the first line, `below` before all others.
        """
        amount = "" if self.moved is None else f", moved {1e3 * self.moved:.3f} mm"
        again = self.object in told and bool(self.causes)
        yield f"{here}{self.name}: {self.what}{amount}" + (" (see above)" if again else "")
        if again:
            return
        told.add(self.object)
        beside, after, branch, last = marks
        if self.stopped:
            mark = branch if self.causes else last
            yield f"{below}{mark}stopped at {self._stops()}: same bits as before"
        for cause in self.causes:
            final = cause is self.causes[-1]
            mark, rest = (last, after) if final else (branch, beside)
            yield from cause._lines(marks, below + mark, below + rest, told)

    def _stops(self) -> str:
        more = f" and {len(self.stopped) - _TOLD} more" if len(self.stopped) > _TOLD else ""
        return ", ".join(self.stopped[:_TOLD]) + more
