"""What a widget shares with others of its hull, and the places where it is shown."""

from __future__ import annotations

import json
from collections.abc import Callable
from weakref import WeakKeyDictionary

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.hull.hull import Hull
from assoc_hull.page.messages import Hello, parse
from assoc_hull.page.session import Session
from assoc_hull.page.wire import VERSION

__all__ = ["SharedSession", "WidgetView", "WidgetViews"]

_SESSIONS: WeakKeyDictionary[Hull, SharedSession] = WeakKeyDictionary()


class SharedSession:
    """The session of a hull, for as long as a place shows it."""

    def __init__(self, hull: Hull) -> None:
        self.session = Session(hull)
        self._users = 0

    @classmethod
    def take(cls, hull: Hull) -> SharedSession:
        """Give the session of a hull, which is begun for the first place."""
        found = _SESSIONS.get(hull)
        if found is None:
            found = _SESSIONS[hull] = cls(hull)
        found._users += 1
        return found

    def give_back(self) -> None:
        """End it with the last place."""
        self._users -= 1
        if self._users == 0:
            _SESSIONS.pop(self.session.hull, None)
            self.session.close()


class WidgetView:
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


class WidgetViews:
    """The places where a widget is shown; its session runs while there is one.

    It knows nothing of the widget, so that the collector can take a widget that nobody closed.
    """

    def __init__(self, hull: Hull) -> None:
        self._hull = hull
        self._shared: SharedSession | None = None
        self._views = dict[str, WidgetView]()

    def take(
        self, name: str, given: object, send: Callable[[dict[str, object], list[bytes]], None]
    ) -> None:
        """Take a message of a place, which is begun with its first."""
        if self._shared is None:
            self._shared = SharedSession.take(self._hull)
        view = self._views.get(name)
        if view is None:
            view = self._views[name] = WidgetView(name, self._shared.session, send)
        view.take(given)

    def drop(self, name: str) -> None:
        """Forget a place that hears nothing any more; from any thread."""
        gone = self._views.pop(name, None)
        if gone is not None:
            gone.leave()

    def leave(self, name: str) -> None:
        """Forget a place that has gone; with the last one the session ends."""
        self.drop(name)
        if not self._views:
            self.end()

    def end(self) -> None:
        """End all places, and the session if nobody else needs it."""
        for name in list(self._views):
            self.drop(name)
        shared, self._shared = self._shared, None
        if shared is not None:
            shared.give_back()
