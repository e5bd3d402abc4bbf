"""The hull behind the page: the newest wish wins, and what is committed is the edit itself."""

import json
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import attrs
import numpy as np
import pytest

import assoc_hull as ah
from assoc_hull.edit.document import STOPPED
from assoc_hull.edit.drag import Drag, Live
from assoc_hull.page.ghosts import ghost_of_edits
from assoc_hull.page.messages import (
    Apply,
    AskFairness,
    AskHydrostatics,
    AskPreview,
    AskWhy,
    Begin,
    Cancel,
    Check,
    Commit,
    Hello,
    Message,
    Parameters,
    Redo,
    Sign,
    Stop,
    To,
    Undo,
    Vary,
)
from assoc_hull.page.session import Session
from assoc_hull.page.wire import Frame, FrameKind, unpack
from assoc_hull.variation.plan_choice import choose_plan
from tests.conftest import Shipped

POINT, OTHER = "WL 0.625 x ST 16", "WL 0.5 x ST 15"


@attrs.define(eq=False)
class Page:
    """A page without a browser: it keeps what it is told."""

    session: Session
    author: str = "anna"
    told: list[dict[str, Any] | Frame] = attrs.field(factory=list)
    news: threading.Condition = attrs.field(factory=threading.Condition)

    def tell(self, message: str | bytes) -> None:
        """Keep a message."""
        with self.news:
            self.told.append(json.loads(message) if isinstance(message, str) else unpack(message))
            self.news.notify_all()

    def ask(self, message: Message) -> None:
        """Send a message."""
        self.session.submit(self, message)

    def wait(self, fits: Callable[[Any], bool]) -> Any:
        """Wait for a message, and forget it."""

        def found() -> list[Any]:
            return [each for each in self.told if fits(each)]

        with self.news:
            assert self.news.wait_for(found, 30.0), self.told
            first = found()[0]
            self.told.remove(first)
            return first

    def text(self, kind: str) -> dict[str, Any]:
        """Wait for a text."""
        answer: dict[str, Any] = self.wait(lambda m: isinstance(m, dict) and m["t"] == kind)
        return answer

    def frame(self, kind: FrameKind) -> Frame:
        """Wait for a frame."""
        answer: Frame = self.wait(lambda m: isinstance(m, Frame) and m.kind == kind)
        return answer

    def enter(self) -> "Page":
        """Open it, and wait until the hull is there."""
        self.ask(Hello(1, "token", self.author))
        self.text("session")
        self.frame(FrameKind.NET)
        self.text("state")
        return self

    def grip(self, name: str = POINT, how: str = "pull", gesture: int = 1) -> dict[str, Any]:
        """Take hold of a point."""
        row = self.session.hull.points[name].number
        radius = [20.0, 8.0] if how == "pull" else None
        self.ask(Begin(gesture, row, how, radius))
        return self.text("grip")


@pytest.fixture
def hull(fresh_series60_70: ah.Hull) -> ah.Hull:
    """Series 60, to be edited at will."""
    return fresh_series60_70


@pytest.fixture
def session(hull: ah.Hull) -> Iterator[Session]:
    """The session of it."""
    found = Session(hull)
    yield found
    found.close()


@pytest.fixture
def page(session: Session) -> Page:
    """A page that is open."""
    return Page(session).enter()


def test_a_page_is_told_all_of_the_hull(session: Session, hull: ah.Hull) -> None:
    """Names and roles as the library has them; shapes and places as they are published."""
    page = Page(session)
    page.ask(Hello(1, "token", "anna"))
    net, frame, points = page.text("net"), page.frame(FrameKind.NET), hull.points
    assert frame.state == net["state"] == hull.state_number
    assert net["particulars"]["name"] == hull.particulars.name
    assert [line["name"] for line in net["lines"]] == list(hull.lines)
    assert np.array_equal(frame.spline.xyz, hull.shapes().spline.xyz)
    assert net["points"]["row"] == frame.rows.tolist()
    for index in range(0, len(frame.rows), 97):
        point = points[net["points"]["name"][index]]
        if point.crossing_role != "watched":  # its curves pass one another a little
            assert np.array_equal(frame.xyz[index], point.position)
        computed = point.crossing_role not in (None, "shared")
        assert net["points"]["free"][index] == ("" if computed else "".join(point.free))


def test_what_is_committed_is_the_edit_itself(page: Page, hull: ah.Hull, shipped: Shipped) -> None:
    """Whatever was asked for before; it is signed by who made it, and one step."""
    grip = page.grip()
    assert grip["radius"] == [20.0, 8.0]
    assert grip["start"] == hull.points[POINT].position.tolist()
    before = hull.fingerprint
    for seq, d in enumerate((0.004, -0.009, 0.011), start=1):
        page.ask(To(1, seq, d=d))
        live = page.frame(FrameKind.LIVE)
        assert (live.gesture, live.sequence, live.state) == (1, seq, hull.state_number)
        assert abs(live.normal - abs(d)) < 0.02 * abs(d)
    assert hull.fingerprint == before
    page.ask(Commit(1, 4, d=0.010, name="fuller shoulder"))
    done, published = page.text("done"), page.frame(FrameKind.PUBLISHED)
    assert done["relofted"] == len(published.curves)
    assert [(step.name, step.author) for step in hull.history] == [("fuller shoulder", "anna")]
    twin = shipped("series60_70")
    pull = {"op": "pull", "point": POINT, "d": 0.010, "radius": (20.0, 8.0)}
    twin.apply("fuller shoulder", [pull])
    assert hull.fingerprint == twin.fingerprint
    shapes = hull.shapes()
    for number, curve in zip(published.curves, published.spline.single(), strict=True):
        (at,) = np.flatnonzero(shapes.curves == number)
        assert np.array_equal(curve.xyz, shapes.spline.curve(int(at)).xyz)


def test_only_the_newest_wish_is_carried_out(
    page: Page, hull: ah.Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of 200 places that come while the worker is slow a few are tried, and the last one is."""
    page.grip()
    tried, to, gate = list[float](), Drag.to, threading.Event()

    def slow(self: Drag, d: float | None = None, **more: float) -> Live:
        gate.wait(30.0)
        assert d is not None
        tried.append(d)
        return to(self, d, **more)

    monkeypatch.setattr(Drag, "to", slow)
    for seq in range(200):
        page.ask(To(1, seq, d=1e-5 * seq))
    gate.set()
    page.wait(lambda m: isinstance(m, Frame) and m.sequence == 199)
    assert len(tried) <= 2
    assert tried[-1] == 1e-5 * 199
    page.ask(Commit(1, 200, d=0.002, name="pull"))
    page.text("done")
    assert len(hull.history) == 1


def test_letting_go_stops_what_is_under_way_and_changes_nothing(page: Page, hull: ah.Hull) -> None:
    """No answer comes to a place that was given up, and the next gesture works."""
    before = hull.fingerprint
    page.grip()
    page.ask(To(1, 1, d=0.4))
    page.ask(Cancel(1))
    page.grip(OTHER, gesture=2)
    assert [m for m in page.told if isinstance(m, Frame) and m.gesture == 1] == []
    page.ask(Cancel(2))
    page.ask(Check(5))
    assert page.text("answer") == {"t": "answer", "id": 5, "value": []}
    assert hull.fingerprint == before
    assert hull.history == ()


def test_a_refusal_is_told_with_its_reasons_and_the_drag_goes_on(page: Page, hull: ah.Hull) -> None:
    """At its place, without the head that says which edit it was; then a smaller pull is taken."""
    before = hull.fingerprint
    page.grip()
    page.ask(To(1, 1, d=3.0))
    refused = page.text("refused")
    assert refused["row"] == hull.points[POINT].number
    assert refused["reasons"]
    assert all("hull is unchanged" not in each for each in refused["reasons"])
    page.ask(To(1, 2, d=0.003))
    assert page.frame(FrameKind.LIVE).sequence == 2
    page.ask(Commit(1, 3, d=3.0, name="too far"))
    assert page.text("refused")["seq"] == 3
    assert hull.fingerprint == before


def test_a_computed_point_says_why_it_cannot_be_moved(page: Page, hull: ah.Hull) -> None:
    """As soon as it is taken hold of; it can be pulled."""
    driven = next(each for each in hull.crossings.values() if each.role.startswith("drives"))
    page.ask(Begin(1, driven.number, "move"))
    (reason,) = page.text("refused")["reasons"]
    assert "driven" in reason or "computed" in reason
    page.ask(Begin(2, driven.number, "pull"))
    assert page.text("grip")["free"] == ""


def test_undo_and_redo_are_of_who_asks(session: Session, page: Page, hull: ah.Hull) -> None:
    """An edit of somebody else that lies above is named, and stays."""
    other = Page(session, "bert").enter()
    for number, (who, d) in enumerate([(page, 0.003), (other, 0.002)], start=1):
        who.grip(gesture=number)
        who.ask(Commit(number, 1, d=d, name=f"pull {number}"))
        who.text("done")
    seen = page.wait(lambda m: isinstance(m, dict) and m["t"] == "state" and m["edits"] == 2)
    assert (seen["undo"], seen["above"]) == ("pull 2", "bert")
    page.ask(Undo(7))
    assert "bert" in page.text("problem")["text"]
    other.ask(Undo(8))
    assert other.text("answer")["id"] == 8
    assert [step.name for step in hull.history] == ["pull 1"]
    page.ask(Undo(9))
    page.text("answer")
    assert not hull.history
    page.ask(Redo(10))
    page.text("answer")
    assert [step.name for step in hull.history] == ["pull 1"]


def test_every_page_sees_what_one_has_committed(session: Session, page: Page) -> None:
    """And one that has left holds nothing."""
    other = Page(session, "bert").enter()
    other.grip()
    page.ask(Begin(1, session.hull.points[OTHER].number, "pull", [20.0, 8.0]))
    assert page.text("refused")["reasons"] == [f"bert holds {POINT}; wait until it is let go"]
    y = session.hull.points[OTHER].position[1] + 0.001
    place = Apply(3, "place", [{"op": "move", "point": OTHER, "y": y}])
    acts: list[Message] = [Undo(3), Redo(3), place]
    for act in acts:
        page.ask(act)
        assert page.text("problem")["text"].startswith(f"bert holds {POINT}, in ")
    page.ask(Commit(1, 1, d=0.003, name="too late"))
    assert "let go before" in page.text("problem")["text"]
    assert session.hull.history == ()
    session.leave(other)
    page.grip(OTHER, gesture=2)
    watcher = Page(session, "cora").enter()
    page.ask(Commit(2, 1, d=0.003, name="pull"))
    frames = [each.frame(FrameKind.PUBLISHED) for each in (page, watcher)]
    assert np.array_equal(frames[0].curves, frames[1].curves)
    assert watcher.text("state")["above"] == "anna"
    assert [m for m in other.told if isinstance(m, Frame) and m.kind == FrameKind.PUBLISHED] == []


def test_edits_by_name_are_those_of_the_library(page: Page, hull: ah.Hull) -> None:
    """Each operation with its words and refusals; what changes the structure brings a new net."""
    y = hull.points[POINT].position[1] + 0.002
    page.ask(Apply(1, "place", [{"op": "move", "point": POINT, "y": y}]))
    assert page.text("done")["id"] == 1
    assert hull.points[POINT].position[1] == y
    page.told.clear()
    page.ask(Apply(2, "knuckle", [{"op": "insert", "curve": "ST 16", "at": [97.536, 7.0, 9.0]}]))
    answer = page.wait(lambda m: isinstance(m, dict) and m["t"] in ("done", "problem", "refused"))
    assert answer["id"] == 2
    page.ask(Apply(3, "x", [{"op": "no such thing"}]))
    assert "no such thing" in page.text("problem")["text"]
    page.ask(Apply(4, "far", [{"op": "move", "point": POINT, "y": 400.0}]))
    assert page.wait(lambda m: isinstance(m, dict) and m["t"] == "refused")["id"] == 4


def test_a_point_that_is_not_there_is_told(page: Page) -> None:
    """Also where the number is that of none."""
    page.ask(Begin(1, 10**6, "pull"))
    assert "there is no point 1000000" in page.text("problem")["text"]


def test_a_fault_of_the_program_is_told_and_the_next_act_works(
    page: Page, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    """With a number that stands in the log; the thread lives on."""
    page.grip()
    monkeypatch.setattr(Drag, "to", lambda *_, **__: 1 / 0)
    page.ask(To(1, 1, d=0.001))
    assert "an error of this program (number 1" in page.text("problem")["text"]
    assert "fault 1" in caplog.text
    monkeypatch.undo()
    page.grip(gesture=2)
    page.ask(To(2, 1, d=0.001))
    assert page.frame(FrameKind.LIVE).gesture == 2


def test_what_another_process_has_committed_is_shown_and_nothing_is_overwritten(
    shipped: Shipped, tmp_path: Path
) -> None:
    """The edit that met it is not made, and says so; made again it stands on the new state."""
    path = tmp_path / "ship.hull"
    shipped("series60_70").save(path)
    session = Session(ah.open(path))
    try:
        page = Page(session).enter()
        page.grip()
        other = ah.open(path)
        other.author = "bert"
        other.apply("elsewhere", [{"op": "pull", "point": OTHER, "d": 0.004}])
        page.ask(Commit(1, 1, d=0.005, name="pull"))
        assert "elsewhere" in page.text("problem")["text"]
        page.frame(FrameKind.PUBLISHED)
        assert [step.name for step in session.hull.history] == ["elsewhere"]
        page.grip(gesture=2)
        page.ask(Commit(2, 1, d=0.005, name="pull"))
        page.text("done")
        other.refresh()
        assert [step.author for step in other.history] == ["bert", "anna"]
        other.close()
    finally:
        session.close()
        session.hull.close()


def test_a_session_ends_with_what_it_is_at(hull: ah.Hull) -> None:
    """A commit that runs is made whole; what waits is not begun."""
    session = Session(hull)
    page = Page(session).enter()
    page.grip()
    page.ask(Commit(1, 1, d=0.003, name="pull"))
    begin = time.monotonic()
    session.close()
    assert time.monotonic() - begin < 20.0
    assert len(hull.history) in (0, 1)
    assert hull.verify() == ()


def test_a_name_is_signed_from_then_on(page: Page, hull: ah.Hull) -> None:
    """Undo then is of that name; the hull's own author is as it was."""
    own = hull.author
    page.ask(Sign("Dörte"))
    page.text("state")
    page.grip()
    page.ask(Commit(1, 1, d=0.003, name="pull"))
    page.text("done")
    assert hull.history[-1].author == "Dörte"
    assert hull.author == own


def test_a_variant_is_shown_and_then_made(page: Page, hull: ah.Hull) -> None:
    """The list, a ghost that changes nothing, one signed step that is the variation itself."""
    page.ask(Parameters(1))
    listed = {each["name"]: each for each in page.text("answer")["value"]}
    breadth = hull.particulars.breadth
    assert abs(listed["breadth"]["value"] - breadth) < 1e-9
    before, expected = hull.fingerprint, hull.snapshot()
    expected.vary(set={"breadth": breadth + 0.2}, in_place=True)
    page.ask(Vary(2, {"breadth": breadth + 0.2}))
    ghost, words = page.frame(FrameKind.GHOST), page.text("answer")["value"]
    assert hull.fingerprint == before
    assert not hull.history
    assert ghost.state == hull.state_number
    assert np.array_equal(ghost.spline.xyz[:3], expected.state.spline(int(ghost.curves[0])).xyz[:3])
    assert words["volume"] == expected.hydrostatics().volume
    page.ask(Vary(3, {"breadth": breadth + 0.2}, True))
    assert page.text("done")["id"] == 3
    assert hull.fingerprint == expected.fingerprint
    assert [step.author for step in hull.history] == ["anna"]


def test_a_variant_that_is_being_made_is_stopped(
    page: Page, hull: ah.Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The hull is as it was, one that waits is not made either, and the next is."""
    begun, before = threading.Event(), hull.fingerprint

    def slow(*given: Any) -> Any:
        begun.set()
        deadline = time.monotonic() + 20.0
        while not STOPPED.get()() and time.monotonic() < deadline:
            time.sleep(0.001)
        return choose_plan(*given)

    monkeypatch.setattr("assoc_hull.variation.vary.choose_plan", slow)
    wanted = {"breadth": hull.particulars.breadth + 0.2}
    page.ask(Vary(1, wanted, True))
    assert begun.wait(20.0)
    page.ask(Vary(2, wanted, True))
    page.ask(Stop(2))
    page.ask(Stop(1))
    told = [page.text("refused") for _ in range(2)]
    assert sorted(each["id"] for each in told) == [1, 2]
    assert all("stopped" in " ".join(each["reasons"]) for each in told)
    assert hull.fingerprint == before
    monkeypatch.undo()
    page.ask(Vary(3, wanted, True))
    assert page.text("done")["id"] == 3


def test_values_between_fair_and_possible_can_be_asked(page: Page, hull: ah.Hull) -> None:
    """Both limits are told; one that is not fair is refused, unless it is accepted."""
    page.ask(Parameters(1, "breadth"))
    (told,) = (each for each in page.text("answer")["value"] if each["name"] == "breadth")
    assert told["least"] < told["low"] < told["value"] < told["high"] < 90.0
    assert told["most"] is None or told["most"] > 90.0
    wanted = {"breadth": 90.0}
    page.ask(Vary(2, wanted, apply=True))
    assert "bend more sharply" in page.text("refused")["reasons"][0]
    page.ask(Vary(3, wanted, accept=True))
    page.frame(FrameKind.GHOST)
    page.ask(Vary(4, wanted, apply=True, accept=True))
    assert page.text("done")["id"] == 4


def test_a_variant_that_cannot_be_had_is_one_sentence(page: Page, hull: ah.Hull) -> None:
    """Shown or made: the hull is as it was."""
    before = hull.fingerprint
    for number, apply in enumerate((False, True), start=5):
        page.ask(Vary(number, {"breadth": -3.0}, apply))
        problem = page.text("problem")
        assert problem["id"] == number
        assert "error of this program" not in problem["text"]
    assert hull.fingerprint == before


@pytest.mark.parametrize(
    "edit",
    [{"op": "set_kind", "point": POINT, "kind": "knuckle"},
     {"op": "rename", "obj": "WL 0.5", "name": "WL half"}],
    ids=["kind", "name"],
)  # fmt: skip
def test_what_moves_nothing_is_told_too(session: Session, edit: dict[str, object]) -> None:
    """A new kind and a new name are shown as they are, after an undo as well."""
    page = Page(session).enter()
    page.ask(Apply(1, "an edit that moves nothing", [edit]))
    page.text("done")
    told = page.text("net")
    page.ask(Undo(2))
    page.text("answer")
    assert page.text("net") != told


def test_who_comes_while_a_point_is_held_is_told(session: Session) -> None:
    """A page that is opened in the middle of a gesture of somebody else."""
    anna = Page(session).enter()
    row = anna.grip(POINT)["row"]
    bert = Page(session, "bert").enter()
    told = bert.text("hold")
    assert (told["author"], told["row"]) == ("anna", row)


def test_an_answer_that_takes_long_keeps_no_other_waiting(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A preview that is given up for a newer one is not shown, and hydrostatics come meanwhile."""
    going, seen = threading.Event(), threading.Event()

    def slow(hull: ah.Hull, edits: Any) -> Any:
        if edits[0]["d"] == 0.5:
            seen.set()
            assert going.wait(30.0)
        return ghost_of_edits(hull, edits)

    monkeypatch.setattr("assoc_hull.page.session.ghost_of_edits", slow)
    page = Page(session).enter()
    page.ask(AskPreview(1, [{"op": "pull", "point": POINT, "d": 0.5}]))
    assert seen.wait(30.0)
    page.ask(AskHydrostatics(2))
    assert page.text("answer")["id"] == 2
    page.ask(AskPreview(3, [{"op": "pull", "point": POINT, "d": 0.01}]))
    assert page.text("answer")["id"] == 3
    going.set()
    page.ask(AskPreview(4, [{"op": "pull", "point": POINT, "d": 0.02}]))
    assert page.text("answer")["id"] == 4


def endless(begun: threading.Event, ended: threading.Event) -> Callable[..., Any]:
    """Make an answer that never comes; it tells when it has begun, and when it was ended."""

    def run(*_: Any) -> Any:
        begun.set()
        try:
            while True:
                time.sleep(0.001)
        finally:
            ended.set()

    return run


def test_an_answer_is_stopped_and_others_come(
    session: Session, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The list of the fairing panel is ended while it is made; nothing is told of it."""
    begun, ended = threading.Event(), threading.Event()
    monkeypatch.setattr("assoc_hull.page.session.describe_fairness", endless(begun, ended))
    page = Page(session).enter()
    page.ask(AskFairness(1))
    assert begun.wait(30.0)
    page.ask(AskHydrostatics(2))
    page.ask(Stop(1))
    assert ended.wait(5.0)
    assert page.text("answer")["id"] == 2
    assert all(getattr(each, "sequence", 0) != 1 for each in page.told)


def test_who_leaves_ends_what_was_asked(session: Session, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another page's question does not wait for that of a page that has gone."""
    begun, ended = threading.Event(), threading.Event()
    monkeypatch.setattr("assoc_hull.page.session.describe_fairness", endless(begun, ended))
    anna, bert = Page(session).enter(), Page(session, "bert").enter()
    anna.ask(AskFairness(1))
    assert begun.wait(30.0)
    bert.ask(AskHydrostatics(1))
    session.leave(anna)
    assert ended.wait(5.0)
    assert bert.text("answer")["id"] == 1


def test_a_session_does_not_wait_for_its_answers(
    hull: ah.Hull, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It closes at once, whatever is being computed, and that ends too."""
    begun, ended = threading.Event(), threading.Event()
    monkeypatch.setattr("assoc_hull.page.session.describe_fairness", endless(begun, ended))
    session = Session(hull)
    Page(session).enter().ask(AskFairness(1))
    assert begun.wait(30.0)
    begin = time.monotonic()
    session.close()
    assert time.monotonic() - begin < 2.0
    assert ended.wait(5.0)


def test_why_tells_movement_off_the_hull_apart_from_slides(page: Page, hull: ah.Hull) -> None:
    """Where a pull is felt most points move by what was asked; how far they slid stands beside."""
    hull.apply("fuller", [{"op": "pull", "point": POINT, "d": 0.02, "radius": [15, 5]}])
    page.ask(AskWhy(71, "ST 16"))
    told = page.wait(lambda each: isinstance(each, dict) and each.get("id") == 71)["value"]["tree"]
    first = told["causes"][0]
    assert (first["name"], round(first["moved"], 5)) == (POINT, 0.02)
    assert first["slid"] > 1e-3
    assert round(told["moved"], 5) == 0.02
    assert told["slid"] is None
    moved = [each["moved"] for each in told["causes"]]
    assert moved == sorted(moved, reverse=True)
    assert told["left"] > 0


def test_parameters_are_listed_without_limits_and_one_with_its_own(page: Page) -> None:
    """Limits of all take seconds, the list none."""
    page.ask(Parameters(72))
    listed = page.wait(lambda each: isinstance(each, dict) and each.get("id") == 72)["value"]
    assert {(each["low"], each["high"]) for each in listed} == {(None, None)}
    page.ask(Parameters(73, "breadth"))
    found = page.wait(lambda each: isinstance(each, dict) and each.get("id") == 73)["value"]
    limits = {each["name"]: each["low"] for each in found if each["low"] is not None}
    assert list(limits) == ["breadth"]
