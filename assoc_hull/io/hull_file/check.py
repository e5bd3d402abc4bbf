"""Whether tables read from a file lead somewhere: what everything else takes for granted.

`assoc_hull.edit.checks.hull_findings.check` finds all of this and more, object by object; this is
the short look that every opening can afford.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.io.hull_file.check import require_sound_tables
>>> require_sound_tables(wigley())
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from assoc_hull.edit.document import Document, Label
from assoc_hull.edit.step import Step
from assoc_hull.geometry.curves import IntArray, PointKind
from assoc_hull.model.attachments import ATTACHMENTS
from assoc_hull.model.form_definition import GENERATED
from assoc_hull.model.kinds import FAMILIES, OWN, BoundaryKind, Role, Sort, State
from assoc_hull.model.tables import HullState

__all__ = ["require_sound_tables", "require_whole_history"]

_REFERENCES = (
    ("rows", "curve", "curves"), ("rows", "reader", "curves"), ("rows", "driver", "curves"),
    ("rows", "anchor", "rows"), ("curves", "line", "lines"), ("lines", "group", "groups"),
)  # fmt: skip
_CODES = (
    ("rows", "sort", Sort), ("rows", "role", Role), ("rows", "kind", PointKind),
    ("rows", "state", State), ("curves", "state", State),
)  # fmt: skip


def require_sound_tables(state: HullState) -> None:
    """Refuse tables in which a number leads nowhere, a code means nothing or a text is none.

    Raises
    ------
    ValueError
        With the first thing that is wrong.
    """
    for fault in _faults(state):
        raise ValueError(fault)


def _faults(state: HullState) -> Iterator[str]:
    yield from _texts(state)
    for table, column, target in _REFERENCES:
        least = 0 if (table, column) in (("curves", "line"), ("lines", "group")) else -1
        yield from _beyond(state, table, column, target, least)
    for table, column, codes in _CODES:
        found = _live(state, table, column)
        if not np.isin(found, list(codes)).all():
            yield f"a {column} of the {table} means nothing"
    for column, said in (("override", "an override"), ("first_role", "a first role")):
        if not np.isin(_live(state, "rows", column), [-1, *Role]).all():
            yield f"{said} means nothing"
    alone = _live(state, "rows", "sort") != Sort.CROSSING
    for column, nothing in (
        ("override", -1), ("first_role", -1), ("contact", 0), ("sign", 0),
    ):  # fmt: skip
        if (_live(state, "rows", column)[alone] != nothing).any():
            yield f"a point that is no crossing has the {column} of one"
    if not np.isin(_live(state, "lines", "boundary"), [-1, *BoundaryKind]).all():
        yield "a kind of boundary means nothing"
    yield from _lists(state)
    yield from _settings(state)
    yield from _features(state)
    yield from _generated(state)


def _live(state: HullState, table: str, column: str) -> Any:
    return getattr(getattr(state, table), column).data[state.live(table)]


def _beyond(state: HullState, table: str, column: str, target: str, least: int) -> Iterator[str]:
    found, count = _live(state, table, column), getattr(state, target).count
    if found.size and (found.min() < least or found.max() >= count):
        yield f"a {column} of the {table} leads to none of {count} {target}"


def _lists(state: HullState) -> Iterator[str]:
    """Look at what curves and lines list."""
    curves, lines = state.live("curves").tolist(), state.live("lines").tolist()
    count = state.rows.count
    meets = [state.curves.meets[curve] for curve in curves]
    for what, parts, most in (
        ("a point of a curve", [state.curves.rows[curve] for curve in curves], count),
        ("a crossing of a curve", [each.row for each in meets], count),
        ("a line met by a curve", [each.line for each in meets], state.lines.count),
        ("a curve of a line", [state.lines.curves[line] for line in lines],
         state.curves.count),
    ):  # fmt: skip
        if not _within(parts, -1 if what == "a crossing of a curve" else 0, most):
            yield f"{what} does not exist"
    for curve in curves:
        if state.curves.spline[curve] is None or len(state.curves.rows[curve]) < 2:
            yield f"the curve {state.curves.key[curve]!r} has no shape"


def _within(parts: Iterable[Any], least: int, most: int) -> bool:
    found: IntArray = np.concatenate([np.zeros(0, np.int64), *parts]).astype(np.int64)
    return not found.size or bool(found.min() >= least and found.max() < most)


def _texts(state: HullState) -> Iterator[str]:
    """Keys and names are texts, those of live objects not empty, and keys stand once."""
    for table in ("groups", "lines", "curves", "rows"):
        column = getattr(state, table).name if table == "groups" else getattr(state, table).key
        keys = [column.data[number] for number in state.live(table).tolist()]
        if not _names(column.data) or not all(keys):
            yield f"a key of the {table} is no text"
        elif len(set(keys)) < len(keys):
            yield f"a key of the {table} stands there twice"
    for texts in (state.lines.name.data, state.lines.note.data, state.rows.label.data,
                  state.rows.stands_for.data):  # fmt: skip
        if not _names(texts):
            yield "a name is no text"
    if not all(state.lines.name[line] for line in state.live("lines").tolist()):
        yield "a line has no name"
    if not set(state.groups.family.data) <= {*FAMILIES, OWN}:
        yield "a family does not exist"


def _names(values: Iterable[object]) -> bool:
    return all(isinstance(each, str) for each in values)


def _features(state: HullState) -> Iterator[str]:
    """Features own points and lie on lines that there are; keys and names stand once."""
    features, live = state.features, set(state.live("rows").tolist())
    lines = {state.lines.key[line] for line in state.live("lines").tolist()}
    if len({each.key for each in features}) < len(features):
        yield "a key of the features stands there twice"
    for each in features:
        if not (live.issuperset(each.points) and lines.issuperset(each.lines)):
            yield f"the feature {each.name!r} owns a point or lies on a line that is not there"


def _generated(state: HullState) -> Iterator[str]:
    """Look whether generated curves are there, and the points of attached ones."""
    forms, made = state.definitions, state.generated
    if len({each.use for each in forms}) < len(forms):
        yield "a use of the definitions stands there twice"
    curves, live = set(state.live("curves").tolist()), set(state.live("rows").tolist())
    if len({each.curve for each in made}) < len(made):
        yield "a generated curve stands there twice"
    for each in made:
        if each.curve not in curves or state.curves.key[each.curve] != each.key:
            yield f"the generated curve {each.key!r} does not exist"
        if each.what not in GENERATED:
            yield f"the generated curve {each.key!r} is of no known sort"
        there = live if each.attached else range(state.rows.count)
        if len(each.marks) != len(each.rows) or any(row not in there for row in each.rows):
            yield f"the generated curve {each.key!r} lacks points"


def _settings(state: HullState) -> Iterator[str]:
    groups = {state.groups.name[group] for group in state.live("groups").tolist()}
    for link in state.associations:
        if not {link.a, link.b} <= groups:
            yield f"{link.a!r} and {link.b!r} are associated, and are no groups"
    keys = groups | {state.lines.key[line] for line in state.live("lines").tolist()}
    for group in state.live("groups").tolist():
        if not set(state.groups.members[group]) <= keys:
            yield f"the group {state.groups.name[group]!r} holds what is not there"
    for each in state.rulings:
        if not {each.a, each.b} <= keys:
            yield f"{each.a!r} and {each.b!r} rule by a box, and are no groups or lines"
    # Bodies of version 11 could be called as a group is.
    for kind, others in zip(ATTACHMENTS, (groups, set[str]()), strict=True):
        names = [each.name for each in kind.of(state)[0]]
        if not all(names) or len({*names, *others}) < len(names) + len(others):
            yield f"a {kind.word} has no name, or one that something else has"
    if not all(count > 0 for count in state.births.values()):
        yield "a pair of lines bore no crossing"
    if not set(state.failed) <= set(state.live("curves").tolist()):
        yield "a curve that failed does not exist"
    key, table, births = state.lines.key.data, state.rows, dict(state.births.items())
    rows = state.live("rows")
    rows = rows[table.sort[rows] == Sort.CROSSING]
    both = table.curve[rows]
    if (both < 0).any():
        yield "a crossing lies on one curve only"
        return
    for pair, birth in zip(state.curves.line[both].tolist(), table.birth[rows].tolist(),
                           strict=True):  # fmt: skip
        if not 0 < birth <= births.get((key[pair[0]], key[pair[1]]), 0):
            a, b = (str(state.lines.name[line]) for line in pair)
            yield f"{a!r} and {b!r} bore fewer crossings than they have"


def require_whole_history(
    document: Document, new: Sequence[Step], labels: Sequence[Label], stand: tuple[int, int]
) -> None:
    """Refuse a history whose steps are not numbered on, or that is named where it is not.

    A step that lies on no way to the tip or to a name is let be: it does no harm, and an interrupt
    in `Document.go` of a hull in memory leaves one.

    Raises
    ------
    ValueError
        With the first thing that is wrong.
    """
    known = len(document.steps)
    for number, step in enumerate(new, start=known + 1):
        if step.number != number or not 0 <= step.parent < number:
            raise ValueError(f"step {step.number} stands after step {number - 1}")
    most = known + len(new)
    if not all(0 <= number <= most for number in (*stand, *(each.step for each in labels))):
        raise ValueError(f"there is a name for a step beyond the {most} that there are")
    if not _names([*(each.name for each in new), *(each.name for each in labels)]):
        raise ValueError("the name of a step or of a state is no text")
    steps = {**document.steps, **{step.number: step for step in new}}
    way = stand[1]
    while way > stand[0]:
        way = steps[way].parent
    if way != stand[0]:
        raise ValueError(f"step {stand[0]} is not on the way to step {stand[1]}")
