"""The live drag: what it shows is what the edit would do, and nothing is published meanwhile."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar
from unittest import mock

import attrs
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit.document import Document
from assoc_hull.edit.drag import Drag, Live
from assoc_hull.edit.published_program import LiveNumbers
from assoc_hull.edit.session import Edit
from assoc_hull.errors import (
    BadInputError,
    PointRoleError,
    RefusedEditError,
    UnknownNameError,
    WrongTypeError,
)
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import NumberColumn, Table, numbers
from assoc_hull.model.program.run_program import ProgramRun
from tests.long_forms import draws
from tests.twins import packed, twin

T = TypeVar("T")

POINT = "WL 2.5 x ST 7"
PACK = packed(ah.examples.wigley())
RADIUS = (20.0, 4.0)


def hull() -> ah.Hull:
    """Wigley's hull."""
    made: ah.Hull = twin(PACK)
    return made


def published(ship: ah.Hull) -> tuple[object, ...]:
    """All that anybody can see of a hull."""
    state = ship.state
    return (
        ship.fingerprint, len(ship.history), ship.state_number, dict(state.revision_row),
        dict(state.revision_curve), state.rows.count, state.curves.count,
    )  # fmt: skip


AMOUNTS = st.lists(
    st.one_of(
        st.floats(-0.03, 0.03),
        st.sampled_from([0.0, 0.4, -5.0, 1e9, float("nan"), float("inf")]),
    ),
    min_size=1,
    max_size=4,
)


@settings(max_examples=draws(12), deadline=None)
@given(how=st.sampled_from(["pull", "move"]), amounts=AMOUNTS)
def test_nothing_is_published_and_the_last_step_is_what_is_committed(
    how: str, amounts: list[float]
) -> None:
    """Whatever was shown before, refusals too, the hull is as it was; then it is as by one edit."""
    ship, other = hull(), hull()
    before = published(ship)
    way: dict[str, object] = {"radius": RADIUS} if how == "pull" else {}
    with ship.drag(POINT, how, **way) as drag:  # type: ignore[arg-type]
        for amount in amounts:
            live = drag.to(amount) if how == "pull" else drag.to(y=drag.start[1] + amount)
            assert published(ship) == before
        if live.refused:
            with pytest.raises(ah.AssocHullError):
                drag.commit("it")
            assert published(ship) == before
            return
        if how == "pull" and amounts[-1] == 0.0:
            return
        drag.commit("it")
    with other.edit("it") as edit:
        if how == "pull":
            edit.pull(POINT, amounts[-1], RADIUS)
        else:
            edit.move(POINT, y=float(drag.start[1]) + amounts[-1])
    assert ship.fingerprint == other.fingerprint
    assert np.array_equal(live.spline.xyz, _curves(ship, live))


def _curves(ship: ah.Hull, live: Live) -> np.ndarray:
    shapes = ship.shapes()
    places = np.searchsorted(shapes.curves, live.curves)
    if not len(places):
        return np.zeros((0, 3))
    return np.concatenate([shapes.spline.part(at, at + 1).xyz for at in places.tolist()])


def test_a_hull_file_is_not_touched(tmp_path: Path) -> None:
    """While a point of a saved hull is dragged, no byte of its file changes."""
    ship, path = hull(), tmp_path / "ship.hull"
    ship.save(path)
    before = path.read_bytes()
    with ship.drag(POINT, radius=RADIUS) as drag:
        for d in (0.01, 50.0, 0.02):
            drag.to(d)
            assert path.read_bytes() == before
            assert {each.name for each in tmp_path.iterdir()} <= {
                "ship.hull", "ship.hull-wal", "ship.hull-shm",
            }  # fmt: skip
    ship.close()


@pytest.mark.parametrize("whole", [False, True])
def test_a_watched_crossing_is_told_where_its_curves_would_lie(
    whole: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No edit sets it, and it rides all the same: as the commit leaves it, on either way."""
    ship, name = hull(), "WL 2.5 x ST 8"
    with ship.edit("watch") as edit:
        edit.set_role(name, "watched")
    row = ship.points[name].row
    if whole:
        monkeypatch.setattr(Drag, "_run", lambda self: None)
    with ship.drag(POINT, radius=RADIUS) as drag:
        live = drag.to(0.01)
        assert np.array_equal(live.rows, np.unique(live.rows))
        told = live.xyz[live.rows.searchsorted(row)]
        assert live.rows[live.rows.searchsorted(row)] == row
        before = ship.state.rows.xyz[row]
        drag.commit("it")
    assert np.array_equal(told, ship.state.rows.xyz[row])
    assert np.abs(told - before).max() > 1e-3


def test_what_slides_along_a_curve_has_not_moved(fresh_series60_70: ah.Hull) -> None:
    """A pull of 10 mm moves sections by 10 mm and less; crossings of flat lines slide farther."""
    with fresh_series60_70.drag("WL 0.625 x ST 16", radius=(20.0, 8.0)) as drag:
        live = drag.to(0.010)
    assert live.report is not None
    assert live.report.largest is not None
    section = live.moved[np.isin(live.curves, live.sections)]
    assert 0.0095 < section.max() < 0.0115
    assert live.report.largest.distance > 3.0 * section.max()
    assert live.report.largest_normal is not None
    assert live.report.largest_normal.distance == pytest.approx(0.010, rel=0.1)
    told = str(live.report)
    assert told.index("mm along the normal") < told.index("with slides on the hull")


def test_volume_and_centre_are_about_what_a_preview_says() -> None:
    """Trapezes between the sections give the change within a tenth."""
    ship = hull()
    with ship.drag(POINT, radius=RADIUS) as drag:
        live = drag.to(0.02)
    exact = ship.preview(lambda edit: edit.pull(POINT, 0.02, RADIUS))
    assert exact.volume_change is not None
    assert exact.lcb_change is not None
    assert live.volume_change == pytest.approx(exact.volume_change, rel=0.1)
    assert live.lcb_change == pytest.approx(exact.lcb_change, rel=0.1)
    assert len(live.areas) == len(live.sections) > 0


def test_refusals_are_values_and_wrong_arguments_are_errors() -> None:
    """What cannot be is told; what nobody can have meant is raised."""
    ship = hull()
    with ship.drag(POINT, "move") as drag:
        assert drag.free == ("y",)
        assert "folds" in drag.to(y=90.0).refused[0]
        assert "finite" in drag.to(y=float("nan")).refused[0]
        assert "x" in drag.to(x=1.0).refused[0]
        assert not drag.to(y=drag.start[1]).refused
        with pytest.raises(BadInputError, match="d was given to a drag that moves"):
            drag.to(0.1)
        with pytest.raises(WrongTypeError):
            drag.to(y="3")  # type: ignore[arg-type]
        drag.to(y=90.0)
        with pytest.raises(RefusedEditError):
            drag.commit("too far")
    with pytest.raises(BadInputError, match="it has ended"):
        drag.to(y=4.0)
    with pytest.raises(UnknownNameError):
        ship.drag("WL 2.5 x ST 99")
    with pytest.raises(BadInputError):
        ship.drag(POINT, "push")  # type: ignore[arg-type]


def test_a_drag_ends_with_the_state_that_it_began_on() -> None:
    """An edit made meanwhile, or one that is open, is told: start and normal are true no more."""
    ship = hull()
    with ship.drag(POINT) as drag:
        with pytest.raises(BadInputError, match="nothing was asked for"):
            drag.commit("nothing")
        with ship.edit("other") as edit:
            with pytest.raises(BadInputError, match="open"):
                drag.to(0.01)
            edit.move(POINT, y=float(drag.start[1]) + 0.005)
        with pytest.raises(BadInputError, match="changed since the drag began"):
            drag.to(0.01)


def test_a_computed_point_may_be_pulled_and_not_moved(fresh_series60_70: ah.Hull) -> None:
    """A computed point has no freedom: a move tells who drives it, a pull adopts a point."""
    ship = fresh_series60_70
    before, driven = published(ship), "BTK 0.76 x ST 16"
    with ship.drag(driven, "move") as drag:
        assert drag.free == ()
        assert "watched" in drag.to(z=4.0).refused[0]
        with pytest.raises(PointRoleError):
            drag.commit("no")
    with ship.drag(driven, radius=(20.0, 8.0)) as drag:
        live = drag.to(0.01)
        again = drag.to(0.01)
        assert (again.born, again.refused) == (live.born, live.refused)
        assert live.refused or live.born
    assert published(ship) == before


def test_a_step_is_stopped_from_another_thread() -> None:
    """A long pull ends with a refusal before its next sub-step; the next one runs."""
    ship = hull()
    before = published(ship)
    with ship.drag(POINT, radius=RADIUS) as drag:
        done = threading.Event()

        def stop() -> None:
            while not done.wait(0.002):
                drag.stop()

        thread = threading.Thread(target=stop)
        thread.start()
        try:
            live = drag.to(0.4)
        finally:
            done.set()
            thread.join()
        assert live.refused == ("it was stopped",)
        assert published(ship) == before
        assert not drag.to(0.01).refused


def test_a_hull_that_edits_have_made_begins_with_state_0() -> None:
    """Those are not in its history; else the number would fall with the first edit."""
    ship = ah.examples.series60(cb=0.7)
    seen = ship.state_number
    assert seen == 0
    ship.vary(set={"breadth": 17.6}, in_place=True)
    assert ship.state_number == 1
    assert ship.since(seen).curves.size > 0


def test_what_has_changed_since_a_state_is_told() -> None:
    """The number of the state rises with edit, undo and redo, and each tells its curves."""
    ship = hull()
    assert ship.state_number == 0
    y = float(ship.drag(POINT).start[1]) + 0.005
    report = ship.apply("a", [{"op": "move", "point": POINT, "y": y}])
    assert report is not None
    first = ship.since(0)
    assert len(first.curves) == len(report.relofted)
    ship.undo()
    assert ship.state_number == 2
    assert ship.since(1).curves.tolist() == first.curves.tolist()
    assert ship.since(2).curves.size == 0
    ship.redo()
    assert ship.since(0).rows.tolist() == first.rows.tolist()
    assert not ship.since(0).structural
    with pytest.raises(BadInputError, match="from 0 to 3"):
        ship.since(4)


def test_shapes_are_all_curves_in_one_batch() -> None:
    """Each curve of the batch is the one of its number, to the bit."""
    ship = hull()
    shapes = ship.shapes()
    assert shapes.curves.tolist() == ship.state.live("curves").tolist()
    for place, curve in enumerate(shapes.curves.tolist()):
        assert np.array_equal(
            shapes.spline.part(place, place + 1).xyz, ship.state.spline(curve).xyz
        )


@attrs.frozen(eq=False)
class Towers(Table):
    """Two columns of numbers."""

    height: NumberColumn[np.float64] = numbers(np.float64)
    side: NumberColumn[np.float64] = numbers(np.float64)


@given(st.lists(st.sampled_from(["put", "grow", "undo"]), max_size=12))
def test_the_number_of_a_write_comes_back_with_its_content(acts: list[str]) -> None:
    """A number of writes that was seen before stands for the same content, at any time."""
    table = Towers()
    seen = dict[int, bytes]()
    journal, marks = Journal(), [0]
    for turn, act in enumerate(acts):
        if act == "undo":
            journal.undo(keep=marks.pop() if len(marks) > 1 else 0)
        elif act == "grow" or not table.count:
            marks.append(len(journal.entries))
            journal.grow(table, 2)
        else:
            marks.append(len(journal.entries))
            journal.put(table.height, [turn % table.count], [float(turn)])
        content = table.height.data.tobytes()
        assert seen.setdefault(table.height.writes, content) == content


# --------------------------------------------------------------------------------------
# Broken off, by several threads at once, and wrong arguments.


@pytest.mark.parametrize("how", ["pull", "move"])
def test_a_step_that_is_broken_off_leaves_the_next_one_right(
    how: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also one that asks for the same again: nothing of what was written stands."""
    ship = hull()
    asked = {"d": 0.015} if how == "pull" else {"y": ship.points[POINT].y + 0.015}
    drag, fresh = (ship.drag(POINT, how=how, radius=None) for _ in range(2))  # type: ignore[arg-type]
    right = fresh.to(**asked)
    run = LiveNumbers.run

    def broken(self: LiveNumbers, rows: object, held: object) -> ProgramRun:
        run(self, rows, held)  # type: ignore[arg-type]
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(LiveNumbers, "run", broken)
        with pytest.raises(KeyboardInterrupt):
            drag.to(**asked)
    again = drag.to(**asked)
    assert again.curves.tolist() == right.curves.tolist()
    assert len(again.curves)
    assert again.spline.xyz.tobytes() == right.spline.xyz.tobytes()


def test_threads_that_share_a_drag_take_turns() -> None:
    """Each gets the answer to what it asked for."""
    ship = hull()
    drag, amounts = ship.drag(POINT, radius=RADIUS), (0.005, 0.011, 0.017, 0.02)
    right = {d: drag.to(d).spline.xyz.tobytes() for d in amounts}
    wrong = list[float]()

    def ask(d: float) -> None:
        wrong.extend(d for _ in range(15) if drag.to(d).spline.xyz.tobytes() != right[d])

    threads = [threading.Thread(target=ask, args=(d,)) for d in amounts]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


def test_a_drag_begins_on_the_published_hull_while_another_thread_tries_something() -> None:
    """What a preview writes in between is nobody else's."""
    ship = hull()
    start = ship.points[POINT].position.tobytes()
    seen, over = set[bytes](), threading.Event()

    def look() -> None:
        while not over.is_set():
            seen.add(ship.drag(POINT, how="move").start.tobytes())
            seen.add(ship.points[POINT].position.tobytes())

    thread = threading.Thread(target=look)
    thread.start()
    for step in range(12):
        ship.preview([{"op": "move", "point": POINT, "y": 2.9 + 0.004 * step}], measure=False)
    over.set()
    thread.join()
    assert seen == {start}


def test_a_report_asked_for_while_another_thread_tries_something_comes_later() -> None:
    """The hull has not changed: only then is there none for good."""
    ship = ah.examples.wigley()
    with ship.drag(POINT) as drag:
        live = drag.to(d=0.004)
    begun, over = threading.Event(), threading.Event()

    def look(_: object) -> None:
        begun.set()
        over.wait(20.0)

    thread = threading.Thread(target=lambda: ship.preview(look, measure=False))
    thread.start()
    begun.wait(20.0)
    assert live.report is None
    over.set()
    thread.join()
    assert live.report is not None
    assert live.report is live.report


@pytest.mark.parametrize("d", [1e150, -1e308, 2e6], ids=["no square", "largest", "no length"])
def test_a_pull_beyond_what_an_edit_takes_is_refused_without_a_word_of_numpy(d: float) -> None:
    """As the edit refuses it; a warning is an error here."""
    with ah.examples.wigley().drag(POINT, radius=(20.0, 4.0)) as drag:
        assert "give a finite number up to 1e+06 m" in drag.to(d=d).refused[0]


@pytest.mark.parametrize("name", ["", "a\nb", 3.5, None, b"x"])
def test_commit_takes_names_as_an_edit_does(name: object) -> None:
    """Nothing is published under another."""
    ship = hull()
    before = published(ship)
    drag = ship.drag(POINT)
    drag.to(0.01)
    with pytest.raises(BadInputError, match="name"):
        drag.commit(name)  # type: ignore[arg-type]
    assert published(ship) == before
    drag.commit("pull")
    assert [each.name for each in ship.history] == ["pull"]


def test_numbers_too_large_for_one_are_refused_and_other_kinds_are_errors() -> None:
    """As infinity is; an angle, a time or a complex number is no distance."""
    drag = hull().drag(POINT)
    assert drag.to(10**400).refused == drag.to(float("inf")).refused
    assert drag.to(-(10**400)).refused
    for wrong in (np.timedelta64(1, "s"), np.complex128(0.01), "0.01", True):
        with pytest.raises(WrongTypeError, match="give a number"):
            drag.to(wrong)  # type: ignore[arg-type]


@pytest.mark.parametrize("radius", ["ab", (1.0, 2.0, 3.0), -1.0, (0.0, 1.0), (np.nan, 1.0)])
def test_a_wrong_radius_is_told_at_once(radius: object) -> None:
    """Not at every step as a refusal."""
    with pytest.raises(BadInputError, match="radius"):
        hull().drag(POINT, radius=radius)  # type: ignore[arg-type]


def test_a_drag_that_moves_takes_no_radius() -> None:
    """Nothing that was given is dropped in silence."""
    with pytest.raises(BadInputError, match="leave it out, or pull"):
        hull().drag(POINT, how="move", radius=RADIUS)


def test_a_radius_that_is_changed_later_changes_nothing() -> None:
    """It is taken as it was."""
    radius = [20.0, 4.0]
    drag = hull().drag(POINT, radius=radius)  # type: ignore[arg-type]
    first = drag.to(0.01)
    radius[0] = 5.0
    again = drag.to(0.01)
    assert again.spline.xyz.tobytes() == first.spline.xyz.tobytes()
    assert first.report is not None
    assert len(first.curves) == len(first.report.relofted)


def in_another_thread(act: Callable[[], T]) -> T:
    """What an act gives there."""
    found = list[T]()
    thread = threading.Thread(target=lambda: found.append(act()))
    thread.start()
    thread.join()
    assert found, "it has raised"
    return found[0]


def test_a_drag_begun_while_another_thread_changes_the_structure_has_the_published_net() -> None:
    """Tables and look-ups are both those of the published state, whatever is half written."""
    ship = hull()

    def drawn() -> tuple[bytes, bytes]:
        drag = ship.drag(POINT, radius=RADIUS)
        quick = drag._quick
        assert quick is not None
        written = quick.written({"d": 0.01})
        assert written is not None
        with quick.tried(*written, 0.01) as run:
            assert run is not None
            return run.rows.tobytes(), quick.numbers.values.xyz.tobytes()

    before, seen = drawn(), list[tuple[bytes, bytes]]()
    trial = Edit(ship.document, "lines", look=lambda step: seen.append(in_another_thread(drawn)))
    with trial:
        trial.remove_line("ST 7")
        trial.add_line("waterlines", 2.9)
        trial.set_role("WL 5 x ST 9", "watched")
    assert seen == [before]
    assert drawn() == before


def test_the_number_of_the_state_is_that_of_the_published_one() -> None:
    """A step that is in the history counts from when it is published."""
    ship, seen = hull(), list[tuple[int, int]]()
    agree = Document._agree

    def told(self: Document) -> None:
        agree(self)
        seen.append(in_another_thread(lambda: (ship.state_number, len(ship.since(0).rows))))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Document, "_agree", told)
        with ship.edit("move") as edit:
            edit.move(POINT, y=2.95)
    assert seen == [(0, 0)]
    assert ship.state_number == 1
    assert len(ship.since(0).rows)


def test_a_pull_tells_how_far_it_is_felt(fresh_series60_70: ah.Hull) -> None:
    """What was given, else three spacings of the points; nothing of a move or on a flat."""
    hull, point = fresh_series60_70, "WL 0.625 x ST 16"
    assert hull.drag(point, radius=(20.0, 8.0)).radius == (20.0, 8.0)
    usual = hull.drag(point).radius
    assert usual is not None
    assert 1.0 < usual[0] < 5.0
    assert hull.drag(point, "move").radius is None
    flat = next(name for name in hull.points if name.startswith("ST 10 x flat of bottom"))
    with hull.drag(flat) as drag:
        (reason,) = drag.to(d=0.01).refused
    assert drag.radius is None
    assert reason.startswith(hull.points[flat].crossing.name)  # type: ignore[union-attr]


def test_a_drag_goes_on_after_a_commit_that_was_refused() -> None:
    """It lets go of the hull to commit, and takes it again: steps are what they were."""
    ship, twin = hull(), hull()
    with ship.drag(POINT, radius=RADIUS) as drag, twin.drag(POINT, radius=RADIUS) as other:
        wanted = other.to(0.012)
        drag.to(0.004)
        assert drag.to(9.0).refused
        with pytest.raises(ah.errors.AssocHullError):
            drag.commit("too far")
        again = drag.to(0.012)
        assert again.curves.tolist() == wanted.curves.tolist()
        assert again.spline.xyz.tobytes() == wanted.spline.xyz.tobytes()
        drag.commit("it")
        other.commit("it")
    assert ship.fingerprint == twin.fingerprint


def test_a_drag_beside_another_has_numbers_of_its_own() -> None:
    """What one gives back when it ends is not what the other one works on."""
    ship = hull()
    with ship.drag(POINT, radius=RADIUS) as first:
        wanted = first.to(0.012).spline.xyz.tobytes()
        with ship.drag(POINT, radius=RADIUS) as second:
            assert second.to(0.012).spline.xyz.tobytes() == wanted
        for d in (0.003, 0.012):
            found = first.to(d)
        assert found.spline.xyz.tobytes() == wanted
        with ship.drag(POINT, radius=RADIUS) as third:
            third.to(0.006)
            third.commit("six")
        with pytest.raises(BadInputError, match="changed since the drag began"):
            first.to(0.012)
    assert ship.verify() == ()


def test_a_drag_that_is_over_leaves_its_numbers_to_the_next() -> None:
    """Numbers as large as the hull are not copied anew for each drag."""
    ship = ah.examples.wigley()
    with ship.drag("WL 2.5 x ST 7", radius=(20.0, 4.0)) as drag:
        drag.to(0.012)
        assert ship.document.program.spare is None
    left = ship.document.program.spare
    assert left is not None
    with (
        mock.patch.object(LiveNumbers, "of", side_effect=AssertionError("copied")),
        ship.drag("WL 2.5 x ST 7", radius=(20.0, 4.0)) as again,
    ):
        again.to(0.012)
    assert ship.document.program.spare is left
