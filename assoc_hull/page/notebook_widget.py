"""The widget of a hull: what a notebook shows, and messages between its page and the session."""

from __future__ import annotations

import weakref
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import anywidget
import traitlets

from assoc_hull.hull.hull import Hull
from assoc_hull.model.objects import Point
from assoc_hull.page.app import family_colours
from assoc_hull.page.joined import joined_modules, scoped_styles
from assoc_hull.page.widget_views import WidgetViews

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["HullWidget"]

_STATIC = files("assoc_hull.page").joinpath("static")
_LONGEST_NAME = 40
_STILL = "assoc-hull-still"


def _script() -> str:
    modules = {
        each.name.removesuffix(".js"): each.read_text("utf-8")
        for each in _STATIC.iterdir()
        if each.name.endswith(".js")
    }
    return joined_modules(modules, "widget", ("render",))


def _styles() -> str:
    sheet = _STATIC.joinpath("page.css").read_text("utf-8") + family_colours()
    # While the widget lives it stands in the place of the picture that is kept with the notebook.
    hidden = f".jp-OutputArea:has(.assoc-hull-widget) .{_STILL} {{ display: none; }}\n"
    return scoped_styles(sheet, "assoc-hull-widget") + hidden


def _sender(widget: HullWidget) -> Callable[[dict[str, object], list[bytes]], None]:
    """Give what sends to a widget and does not keep it alive."""
    known = weakref.ref(widget)

    def send(content: dict[str, object], buffers: list[bytes]) -> None:
        found = known()
        if found is not None:
            found.tell(content, buffers)

    return send


class HullWidget(anywidget.AnyWidget):
    """A hull in a notebook; `assoc_hull.widget` makes it.

    Attributes
    ----------
    hull : Hull
        What it shows and edits.
    """

    _esm = _script()
    _css = _styles()
    _height = traitlets.Int(720).tag(sync=True)
    _author = traitlets.Unicode("").tag(sync=True)
    _open = False

    def __init__(self, hull: Hull, *, height: int, author: str) -> None:
        super().__init__(_height=height, _author=author)
        self.hull = hull
        self._views = WidgetViews(hull)
        # A kernel that ends, and the collector, close what nobody closed.
        self._end = weakref.finalize(self, self._views.end)
        self._row: int | None = None
        self._open = True
        self.on_msg(self._take)

    @property
    def selection(self) -> Point | None:
        """The point that was chosen last; None where none is, or it is gone."""
        rows = self.hull.state.rows
        if (
            not self._open
            or self._row is None
            or self._row >= rows.count
            or not rows.alive[self._row]
        ):
            return None
        return Point.of(self.hull.state, self._row)

    def _take(self, _: object, content: Any, buffers: object) -> None:
        """Take what a view says; views are known by the names that they give themselves."""
        del buffers
        if not self._open or not isinstance(content, dict):
            return
        name = content.get("view")
        if not isinstance(name, str) or not 0 < len(name) <= _LONGEST_NAME:
            return
        if "row" in content:
            row = content["row"]
            self._row = row if type(row) is int and row >= 0 else None
        elif content.get("gone"):
            self._views.leave(name)
        else:
            self._views.take(name, content.get("text"), _sender(self))

    def tell(self, content: dict[str, object], buffers: list[bytes]) -> None:
        """Send a message to its view; from any thread."""
        try:
            self.send(content, buffers=buffers or None)
        except Exception:  # whatever a kernel raises that is going: nobody hears this view any more
            self._views.drop(str(content.get("view")))

    def close(self) -> None:
        """End the widget; the hull stays as it is."""
        if self._open:
            self._open = False
            self._end()
        super().close()

    def _ipython_display_(self) -> None:
        """Show a picture that a saved notebook keeps, and the living widget in its place."""
        from IPython.display import display

        if not self._open:
            display(self.hull)  # type: ignore[no-untyped-call]
            return
        still = self.hull._repr_mimebundle_()
        told = {
            "text/plain": still["text/plain"],
            "text/html": f'<div class="{_STILL}">{still["text/html"]}</div>',
        }
        display(told, raw=True)  # type: ignore[no-untyped-call]
        found = self._repr_mimebundle_()
        display(found[0] if isinstance(found, tuple) else found, raw=True)  # type: ignore[no-untyped-call]
