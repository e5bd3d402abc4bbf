"""The page in a notebook: `widget` shows a hull below a cell, where it is faired by hand.

The cell's hull is the one that is edited: what a hand does in the widget is a step of its history,
and what a cell does is seen in the widget. Widgets of one hull share its session, as two windows
of the page do.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING
from weakref import WeakKeyDictionary

from assoc_hull.arguments import instance, integer, text
from assoc_hull.errors import AssocHullError, BadInputError, MissingExtraError
from assoc_hull.hull.hull import Hull
from assoc_hull.page.messages import Hello, parse
from assoc_hull.page.server import user_name
from assoc_hull.page.session import Session
from assoc_hull.page.wire import VERSION

if TYPE_CHECKING:
    from collections.abc import Callable

    from assoc_hull.page.notebook_widget import HullWidget

__all__ = ["SharedSession", "View", "widget"]

_SESSIONS: WeakKeyDictionary[Hull, SharedSession] = WeakKeyDictionary()


def widget(hull: Hull, *, height: int = 720, author: str | None = None) -> HullWidget:
    """Show a hull in a notebook, and edit it there by hand.

    Views, tools and keys are those of the fairing page. Each drag is an edit of this hull; edits in
    cells are shown. A saved notebook keeps the three views as a picture, without a kernel.

    Parameters
    ----------
    hull : Hull
        The hull.
    height : int
        Of the widget, pixels of the browser, from 200 to 5,000.
    author : str or None
        Who signs the edits made in it; the name of the user if None.

    Returns
    -------
    HullWidget
        What a notebook shows at the end of a cell. `selection` is the point that is chosen in it;
        `close` ends it.

    Raises
    ------
    MissingExtraError
        The extra `jupyter` is not installed.
    BadInputError, WrongTypeError
        No hull, no such height, no name.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> shown = ah.widget(ah.examples.wigley(), height=500)  # doctest: +SKIP
    """
    instance(hull, Hull, "hull", "in widget")
    integer(height, "height", "in widget", least=200, most=5000)
    name = user_name() if author is None else text(author, "author", "in widget")
    try:
        from assoc_hull.page.notebook_widget import HullWidget as Made
    except ImportError as error:
        raise MissingExtraError(error.name or "anywidget", "jupyter") from None
    return Made(hull, height=height, author=name)


class SharedSession:
    """The session of a hull, for as long as a widget shows it."""

    def __init__(self, hull: Hull) -> None:
        self.session = Session(hull)
        self._users = 0

    @classmethod
    def take(cls, hull: Hull) -> SharedSession:
        """Give the session of a hull, which is begun for the first widget."""
        found = _SESSIONS.get(hull)
        if found is None:
            found = _SESSIONS[hull] = cls(hull)
        found._users += 1
        return found

    def give_back(self) -> None:
        """End it with the last widget."""
        self._users -= 1
        if self._users == 0:
            _SESSIONS.pop(self.session.hull, None)
            self.session.close()


class View:
    """One place where a widget is shown; a `Client` of the session."""

    def __init__(
        self, name: str, session: Session, send: Callable[[dict[str, object], list[bytes]], None]
    ) -> None:
        self.author = ""
        self._name, self._session, self._send = name, session, send

    def tell(self, message: str | bytes) -> None:
        """Send a message; from any thread, without waiting."""
        if isinstance(message, str):
            self._send({"view": self._name, "text": message}, [])
        else:
            self._send({"view": self._name}, [message])

    def take(self, given: object) -> None:
        """Take a message of the page; one that is none is answered by a sentence."""
        try:
            message = parse(given if isinstance(given, str) else "")
            if isinstance(message, Hello) and message.version != VERSION:
                raise BadInputError(
                    "the widget is of another version", "in hello", "run the cell again"
                )
        except AssocHullError as error:
            told = {"t": "problem", "id": 0, "gesture": 0, "text": str(error)}
            self.tell(json.dumps(told))
        else:
            self._session.submit(self, message)

    def leave(self) -> None:
        """Forget what it holds."""
        self._session.leave(self)
