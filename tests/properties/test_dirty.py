"""What is dirty inside an edit holds all that the edit lofts, and says because of what."""

from __future__ import annotations

import attrs
from hypothesis import given, settings

import assoc_hull as ah
from assoc_hull.edit.step import EditReport
from assoc_hull.errors import AssocHullError
from tests.long_forms import LONG
from tests.net_strategies import SHAPES, STRUCTURE, Act, Task, fresh, hulls, perform, tasks

COUNT = 250 if LONG else 15
"""Examples, each of up to four edits."""


@attrs.frozen
class Seen:
    """What an edit told inside, by keys of curves, and its report."""

    dirty: set[str]
    perhaps: set[str]
    report: EditReport


def carried_out(hull: ah.Hull, task: Task) -> Seen | None:
    """Carry an edit out, and look before its end; None if it was refused."""
    try:
        with hull.edit("task", task.policy, task.gaps) as edit:
            for act in task.acts:
                perform(hull, edit, act)
            dirty = hull.dirty
            curves, perhaps = ({each.id for each in some} for some in (dirty.curves, dirty.perhaps))
            assert all(str(cause).startswith("because of ") for cause in dirty.values())
    except AssocHullError:
        return None
    assert not hull.dirty
    assert edit.report is not None
    return Seen(curves, perhaps, edit.report)


@settings(max_examples=COUNT)
@given(hulls(), tasks((*SHAPES, *STRUCTURE), largest=0.05))
def test_what_is_lofted_was_dirty(hull: ah.Hull, edits: list[Task]) -> None:
    """But for what mends a gap, bears a crossing or draws a feature anew: told as perhaps dirty."""
    for task in edits:
        seen = carried_out(hull, task)
        if seen is None:
            continue
        lofted = set(seen.report.relofted)
        assert lofted <= seen.dirty | seen.perhaps
        drawn = any(note.startswith("features drawn anew") for note in seen.report.notes)
        if not (seen.report.mended or seen.report.born or seen.report.gone or drawn):
            assert lofted <= seen.dirty


def test_what_a_feature_drawn_anew_lofts_was_told_as_perhaps_dirty() -> None:
    """A line rounded in one edit, and bent by a line beside it in the next."""
    hull = fresh(0)
    assert carried_out(hull, Task((Act("round", 5, 26717, 0.0),))) is not None
    seen = carried_out(hull, Task((Act("straighten", 0, 0, 0.0),)))
    assert seen is not None
    assert any(note.startswith("features drawn anew") for note in seen.report.notes)
    beyond = set(seen.report.relofted) - seen.dirty
    assert beyond
    assert beyond <= seen.perhaps
