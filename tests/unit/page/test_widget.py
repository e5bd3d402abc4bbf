"""The widget of a hull, without a browser: its session, its views, what it refuses."""

import builtins
import gc
import json
import threading
import time
import weakref
from collections.abc import Callable
from typing import Any

import pytest

import assoc_hull as ah
from assoc_hull.errors import AssocHullError, MissingExtraError
from assoc_hull.page.messages import parse
from assoc_hull.page.widget_views import SharedSession, WidgetView, WidgetViews
from assoc_hull.page.wire import VERSION

POINT = "WL 2.5 x ST 7"


class Told:
    """What a view was sent."""

    def __init__(self) -> None:
        self.texts = list[dict[str, Any]]()
        self.frames = 0

    def __call__(self, content: dict[str, object], buffers: list[bytes]) -> None:
        """Take a message."""
        self.frames += len(buffers)
        if "text" in content:
            self.texts.append(json.loads(str(content["text"])))

    def until(self, wanted: Callable[["Told"], bool]) -> None:
        """Wait for what the worker sends."""
        end = time.monotonic() + 20.0
        while not wanted(self):
            assert time.monotonic() < end, [each["t"] for each in self.texts]
            time.sleep(0.01)

    def has(self, kind: str) -> bool:
        """Tell whether a message of a kind came."""
        return any(each["t"] == kind for each in self.texts)


def hello(version: int = VERSION) -> str:
    """The first message of a view."""
    return json.dumps({"t": "hello", "version": version, "token": "none", "author": "anna"})


@pytest.fixture
def hull() -> ah.Hull:
    """A hull of few lines."""
    return ah.examples.wigley(stations=5, waterlines=4)


def test_what_a_cell_does_is_shown_in_a_view(hull: ah.Hull) -> None:
    """The session looks for edits of others; nobody asks it to."""
    shared, told = SharedSession.take(hull), Told()
    view = WidgetView("a", shared.session, told)
    view.take(hello())
    told.until(lambda each: each.has("state"))
    seen = told.frames
    with hull.edit("in a cell") as edit:
        edit.move("WL 4.16667 x ST 2", y=hull.points["WL 4.16667 x ST 2"].y + 0.01)
    told.until(lambda each: each.frames > seen)
    shared.give_back()


def test_widgets_of_one_hull_share_its_session_until_the_last_has_gone(hull: ah.Hull) -> None:
    """As windows of the page do; a widget that comes later begins another one."""
    one, two = SharedSession.take(hull), SharedSession.take(hull)
    assert one is two
    one.give_back()
    assert SharedSession.take(hull) is two
    two.give_back()
    two.give_back()
    other = SharedSession.take(hull)
    assert other is not one
    other.give_back()


@pytest.mark.parametrize("given", [None, 7, "", "{}", '{"t": "undo"', hello(version=99)])
def test_what_is_no_message_is_answered_by_a_sentence(hull: ah.Hull, given: object) -> None:
    """And the view goes on."""
    shared, told = SharedSession.take(hull), Told()
    view = WidgetView("a", shared.session, told)
    view.take(given)
    assert [each["t"] for each in told.texts] == ["problem"]
    assert told.texts[0]["text"]
    view.take(hello())
    told.until(lambda each: each.has("session"))
    shared.give_back()


@pytest.mark.parametrize(
    "given",
    [{"height": 10}, {"height": 600.5}, {"height": "600"}, {"author": ""}, {"author": 7}],
)
def test_bad_arguments_are_errors_of_the_family(hull: ah.Hull, given: dict[str, Any]) -> None:
    """Before anything is made."""
    with pytest.raises(AssocHullError):
        ah.widget(hull, **given)


def test_no_hull_is_an_error_of_the_family() -> None:
    """A path is for the page."""
    with pytest.raises(AssocHullError):
        ah.widget("ship.hull")  # type: ignore[arg-type]


def test_a_missing_extra_is_named(hull: ah.Hull, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the command that installs it."""
    real = builtins.__import__

    def lacking(name: str, *rest: Any) -> Any:
        if name.startswith(("anywidget", "assoc_hull.page.notebook_widget")):
            raise ImportError(name=name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", lacking)
    with pytest.raises(MissingExtraError, match="jupyter"):
        ah.widget(hull)


def test_a_message_of_the_page_is_parsed_as_from_a_socket() -> None:
    """There is one protocol."""
    assert parse(hello()).author == "anna"  # type: ignore[union-attr]


def test_a_widget_ends_and_leaves_the_hull(hull: ah.Hull) -> None:
    """Closed twice is closed once; the hull is edited as before."""
    pytest.importorskip("anywidget")
    shown = ah.widget(hull, height=300, author="anna")
    assert shown.selection is None
    shown.close()
    shown.close()
    with hull.edit("after") as edit:
        edit.move("WL 4.16667 x ST 2", y=hull.points["WL 4.16667 x ST 2"].y + 0.01)
    assert len(hull.history) == 1


def page_threads() -> int:
    """How many threads sessions of pages have."""
    return sum(each.name.startswith("assoc-hull page") for each in threading.enumerate())


def test_the_session_of_views_lasts_as_long_as_a_place_shows_it(hull: ah.Hull) -> None:
    """No thread before the first message, none after the last place has gone, another one later."""
    before, views, told = page_threads(), WidgetViews(hull), Told()
    assert page_threads() == before
    for _ in range(2):
        views.take("a", hello(), told)
        views.take("b", hello(), told)
        told.until(lambda each: each.has("state"))
        assert page_threads() > before
        views.leave("a")
        assert page_threads() > before
        views.leave("b")
        assert page_threads() == before


def test_a_widget_that_nobody_closed_is_ended_by_the_collector(hull: ah.Hull) -> None:
    """Nothing of the session holds the widget: its threads end with it."""
    widgets = pytest.importorskip("ipywidgets")
    pytest.importorskip("anywidget")
    before = page_threads()
    shown = ah.widget(hull, height=300, author="anna")
    shown._take(shown, {"view": "a", "text": hello()}, [])
    assert page_threads() > before
    # As when a kernel forgets a widget: its register of open ones holds it until then.
    widgets.widgets.widget._instances.pop(shown.model_id, None)
    known = weakref.ref(shown)
    shown.comm.close()
    shown.comm = None
    del shown
    gc.collect()
    assert known() is None
    assert page_threads() == before


def test_a_cell_and_a_view_sign_by_their_own_names(hull: ah.Hull) -> None:
    """Also where one waits for the other."""
    hull.author = "cell"
    shared, told = SharedSession.take(hull), Told()
    view = WidgetView("a", shared.session, told)
    view.take(hello())
    told.until(lambda each: each.has("state"))
    ops = [{"op": "move", "point": "WL 4.16667 x ST 1", "y": 1.5}]
    with hull.edit("in a cell") as edit:
        edit.move("WL 4.16667 x ST 2", y=hull.points["WL 4.16667 x ST 2"].y + 0.01)
        view.take(json.dumps({"t": "apply", "id": 5, "name": "by hand", "ops": ops}))
        time.sleep(0.3)
    told.until(lambda each: each.has("done"))
    assert [(step.name, step.author) for step in hull.history] == [
        ("in a cell", "cell"), ("by hand", "anna"),
    ]  # fmt: skip
    assert hull.author == "cell"
    shared.give_back()


def test_who_holds_a_point_is_told_that_a_cell_has_changed_the_hull(hull: ah.Hull) -> None:
    """The point is let go; the page goes on."""
    shared, told = SharedSession.take(hull), Told()
    view, point = WidgetView("a", shared.session, told), hull.points["WL 4.16667 x ST 2"]
    view.take(hello())
    begin = {"t": "begin", "gesture": 1, "row": point.number, "how": "move", "radius": None}
    view.take(json.dumps(begin))
    told.until(lambda each: each.has("grip"))
    with hull.edit("in a cell") as edit:
        edit.move("WL 4.16667 x ST 1", y=1.5)
    told.until(lambda each: each.has("refused"))
    refused = next(each for each in told.texts if each["t"] == "refused")
    assert "changed in another place" in refused["reasons"][0]
    view.take(json.dumps(begin | {"gesture": 2}))
    told.until(lambda each: sum(one["t"] == "grip" for one in each.texts) == 2)
    shared.give_back()


def test_a_view_that_cannot_be_told_does_not_silence_the_others(hull: ah.Hull) -> None:
    """The worker goes on."""

    class Broken(Told):
        def __call__(self, content: dict[str, object], buffers: list[bytes]) -> None:
            raise RuntimeError("the kernel is going")

    shared, told = SharedSession.take(hull), Told()
    WidgetView("a", shared.session, Broken()).take(hello())
    view = WidgetView("b", shared.session, told)
    view.take(hello())
    told.until(lambda each: each.has("state"))
    view.take(json.dumps({"t": "check", "id": 7}))
    told.until(lambda each: each.has("answer"))
    shared.give_back()
