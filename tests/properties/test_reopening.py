"""A hull file may be closed and opened at any time: a session goes on as if it had not been."""

import random
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory

import attrs
from hypothesis import given, settings
from hypothesis import strategies as st

import assoc_hull as ah
from assoc_hull.edit.script import PolicyName
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import AssocHullError
from assoc_hull.model.objects import Line
from tests.long_forms import draws
from tests.net_strategies import POOL, SHAPES, STRUCTURE, Act, Task, fresh, perform, tasks
from tests.properties.test_changes import picture
from tests.properties.test_i08_atomicity import failing_at

TURNS = ("undo", "redo", "checkpoint", "go", "rename", "edit", "edit", "edit", "fail")


@attrs.frozen
class Turn:
    """What is done to both hulls."""

    what: str
    which: int
    task: Task


def turns() -> st.SearchStrategy[list[Turn]]:
    """Give sessions."""
    task = tasks((*SHAPES, *STRUCTURE), most=1).map(lambda each: each[0])
    turn = st.builds(Turn, st.sampled_from(TURNS), st.integers(0, 2**16), task)
    return st.lists(turn, min_size=3, max_size=8)


def take(hull: ah.Hull, turn: Turn, number: int) -> str:
    """Do it; gives what is said if it is refused."""
    try:
        _take(hull, turn, number)
    except AssocHullError as error:
        return str(error)
    return ""


def _take(hull: ah.Hull, turn: Turn, number: int) -> None:
    if turn.what in ("undo", "redo"):
        steps = hull.history if turn.what == "undo" else hull.undone
        getattr(hull, turn.what)(1 + turn.which % max(len(steps), 1))
    elif turn.what == "checkpoint":
        hull.checkpoint(f"after {number}")
    elif turn.what == "go":
        names = sorted(hull.labels)
        hull.go(names[turn.which % len(names)] if names else "nowhere")
    else:
        _edit(hull, turn, number)


def _edit(hull: ah.Hull, turn: Turn, number: int) -> None:
    curves = hull.state.live("curves").tolist()
    policy: PolicyName = "keep_going" if turn.what == "fail" else "all_or_nothing"
    with ExitStack() as stack:
        if turn.what == "fail":
            stack.enter_context(failing_at("loft", 2 * curves[turn.which % len(curves)] + 1))
        edit = stack.enter_context(hull.edit(f"edit {number}", policy, turn.task.gaps))
        if turn.what == "rename":
            lines = hull.state.live("lines").tolist()
            edit.rename(Line.of(hull.state, lines[turn.which % len(lines)]), f"line {number}")
            return
        for act in turn.task.acts:
            perform(hull, edit, act)


def stand(hull: ah.Hull) -> dict[str, object]:
    """Every bit of the tables, and all that is told of how they became so."""
    found = picture(hull.state)
    found["settings.associations"] = sorted(map(str, hull.state.associations))
    found["history"] = [_plain(report) for report in hull.history]
    found["undone"] = [_plain(report) for report in hull.undone]
    found["labels"] = {name: label.step for name, label in hull.labels.items()}
    found["revisions"] = dict(hull.state.revision_row), dict(hull.state.revision_curve)
    return found


def told(hull: ah.Hull) -> tuple[object, ...]:
    """What is told of causes and findings."""
    why = [str(hull.why(address)) for address in list(hull.points)[::9]]
    return why, sorted(hull.graph(only="changed")) if hull.history else [], hull.check()


def _plain(report: EditReport) -> EditReport:
    return attrs.evolve(report, author="", time="")


def go_on(hull: ah.Hull, session: list[Turn]) -> None:
    """Take each turn on a hull that stays open, and on one that is opened for it."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "ship.hull"
        hull.save(path.with_name("open.hull"))
        hull.save(path)
        hull.close()
        hull = ah.open(path.with_name("open.hull"))
        for number, turn in enumerate(session):
            again = ah.open(path)
            assert take(again, turn, number) == take(hull, turn, number)
            mine, theirs = stand(hull), stand(again)
            assert [name for name in mine if mine[name] != theirs[name]] == []
            again.close()
        again = ah.open(path)
        assert told(again) == told(hull)
        again.close()
        hull.close()


@settings(max_examples=draws(30))
@given(st.integers(0, POOL - 1), turns())
def test_a_session_goes_on_after_reopening_as_if_it_had_stayed_open(
    which: int, session: list[Turn]
) -> None:
    """Edits, failures, undo, redo, names and branches give the same bits, reports and causes."""
    go_on(fresh(which), session)


def test_what_is_made_of_something_blocked_is_blocked_and_made_again_when_it_is_not() -> None:
    """A section that begins to go through a point of a blocked waterline waits with it."""
    task = Task((Act("set_role", 205, 1, 0.0),), "refuse")
    session = [
        Turn("fail", 1944, Task((Act("pull", 1, 0, 0.015625),), "refuse")),
        Turn("edit", 0, task), Turn("undo", 0, task), Turn("redo", 0, task),
    ]  # fmt: skip
    hull = ah.Hull(fresh(7).state)
    for number, turn in enumerate(session):
        assert take(hull, turn, number) == ""
        assert hull.verify() == ()
    section = hull.lines["ST 4"].curves[0]
    assert section.state == "blocked"
    back = Turn("edit", 0, Task((Act("set_role", 205, 4, 0.0),), "report"))
    assert take(hull, back, 4) == ""
    assert hull.verify() == ()
    assert section.state == "clean"
    session.append(back)
    go_on(fresh(7), session)


def test_a_session_on_series_60_goes_on_after_reopening(series60_70: ah.Hull) -> None:
    """The same on a real hull."""
    rng = random.Random(60)
    operations = (*SHAPES, *STRUCTURE)

    def act() -> Act:
        wide = rng.randrange(2**16), rng.randrange(2**16)
        return Act(rng.choice(operations), *wide, rng.uniform(-0.02, 0.02))

    session = [
        Turn(rng.choice(TURNS), rng.randrange(2**16), Task((act(), act()), "report"))
        for _ in range(10)
    ]
    go_on(ah.Hull(series60_70.state), session)
