"""Check a whole hull, its tables first: what is wrong, each finding with its place and number.

`check` runs every look in a fixed order. `find_tables` comes first: where it finds damage, a
later look that fails over it is reported as unfinished; on a sound hull such a failure is raised.
The looks of one page stand here too; those on links, shapes and tables have modules of their own.

Findings on the tables themselves: references that lead nowhere, codes without a meaning.

A hull made and edited here has none. A file may have been changed by other hands; other
looks may then stumble, and these findings say over what.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import attrs
import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.edit.checks.link_findings import find_associations, find_links, find_roles
from assoc_hull.edit.checks.tunnel_findings import find_lost_tunnels
from assoc_hull.edit.checks.update_findings import bounded, find_sense, find_shape
from assoc_hull.errors import RingError
from assoc_hull.geometry.curves import IntArray, PointKind
from assoc_hull.model.address import AddressBook
from assoc_hull.model.feature_geometry import line_numbers, places_off, rounding_of
from assoc_hull.model.features import Feature
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.index import driven_levels
from assoc_hull.model.kinds import (
    FAMILIES,
    OWN,
    BoundaryKind,
    Role,
    Sort,
    State,
)
from assoc_hull.model.tables import HullState

__all__ = ["REMEDY", "check", "find_detached", "find_off_features", "find_tables"]

REMEDY = "undo the edit, or take the hull from a copy"

_REFERENCES = (
    ("rows", "curve", "curves"),
    ("rows", "reader", "curves"),
    ("rows", "driver", "curves"),
    ("rows", "anchor", "rows"),
    ("curves", "line", "lines"),
    ("curves", "rows", "rows"),
    ("lines", "group", "groups"),
    ("lines", "curves", "curves"),
)
_CODES: tuple[tuple[str, str, tuple[int, ...]], ...] = (
    ("rows", "sort", tuple(Sort)),
    ("rows", "role", tuple(Role)),
    ("rows", "override", (-1, *Role)),
    ("rows", "kind", tuple(PointKind)),
    ("rows", "state", tuple(State)),
    ("curves", "state", tuple(State)),
    ("lines", "boundary", (-1, *BoundaryKind)),
)


def find_tables(state: HullState, _: AddressBook) -> Iterator[Finding]:
    """Give all findings on the form of the tables.

    Examples
    --------
    >>> from assoc_hull.edit.checks.hull_findings import find_tables
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> list(find_tables(state, AddressBook(state)))
    []
    """
    for table, column, target in _REFERENCES:
        yield from _beyond(state, table, column, _flat(state, table, column), target)
    live = state.live("curves").tolist()
    for part, target in (("row", "rows"), ("line", "lines")):
        meets = [getattr(state.curves.meets[number], part) for number in live]
        yield from _beyond(state, "curves", f"meets.{part}", _joined(live, meets), target)
    for table, column, known in _CODES:
        numbers, values = _flat(state, table, column)
        wrong = ~np.isin(values, known)
        pairs = zip(numbers[wrong].tolist(), values[wrong].tolist(), strict=True)
        for number, value in sorted(set(pairs)):
            text = f"its {column!r} is {value}, which means nothing: {REMEDY}"
            yield Finding("tables", _key(state, table, number), None, float(value), text)
    yield from _families(state)
    yield from _keys(state)
    yield from _generated(state)


def _flat(state: HullState, table: str, column: str) -> tuple[IntArray, IntArray]:
    """Give all values in a column of the live objects, and the number of each one's object."""
    live, data = state.live(table), getattr(getattr(state, table), column).data
    if not isinstance(data, np.ndarray):
        return _joined(live.tolist(), [data[number] for number in live.tolist()])
    values = data[live].reshape(len(live), -1)
    return np.repeat(live, values.shape[1]), np.asarray(values.ravel(), np.int64)


def _joined(numbers: list[int], cells: Sequence[object]) -> tuple[IntArray, IntArray]:
    flat = [np.atleast_1d(np.asarray(cell, np.int64)).ravel() for cell in cells]
    sizes = [len(each) for each in flat]
    none = np.zeros(0, np.int64)
    return np.repeat(np.array(numbers, np.int64), sizes), np.concatenate([none, *flat])


def _key(state: HullState, table: str, number: int) -> str:
    found = getattr(state, table)
    return str((found.name if table == "groups" else found.key).data[number])


def _beyond(
    state: HullState, table: str, column: str, found: tuple[IntArray, IntArray], target: str
) -> Iterator[Finding]:
    """Tell numbers that no row of the target has; -1 stands for none."""
    numbers, values = found
    count = getattr(state, target).count
    wrong = (values < -1) | (values >= count)
    for number, value in zip(numbers[wrong].tolist(), values[wrong].tolist(), strict=True):
        text = f"its {column!r} leads to number {value} of {count} {target}: {REMEDY}"
        yield Finding("tables", _key(state, table, number), None, float(value), text)


def _families(state: HullState) -> Iterator[Finding]:
    for group in state.live("groups").tolist():
        family = state.groups.family[group]
        if family not in FAMILIES and family != OWN:
            text = f"is of the family {family!r}, which does not exist: {REMEDY}"
            yield Finding("tables", _key(state, "groups", group), None, None, text)


def _generated(state: HullState) -> Iterator[Finding]:
    """Tell generated curves that are not there, or lack points."""
    curves, rows = set(state.live("curves").tolist()), set(state.live("rows").tolist())
    for made in state.generated:
        there = made.curve in curves and state.curves.key[made.curve] == made.key
        if not there or (made.attached and not rows.issuperset(made.rows)):
            text = f"comes from definitions, but it or a point of it is not there: {REMEDY}"
            yield Finding("tables", made.key, None, None, text)


def _keys(state: HullState) -> Iterator[Finding]:
    """Tell keys that two live objects have."""
    for table in ("rows", "curves", "lines", "groups"):
        seen = set[str]()
        for number in state.live(table).tolist():
            key = _key(state, table, number)
            if key in seen:
                text = f"is the key of more than one of the {table}: {REMEDY}"
                yield Finding("tables", key, None, None, text)
            seen.add(key)


def find_off_features(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Report, per feature, the farthest point off it, and references that lead nowhere.

    No edit leaves any behind, as it dissolves what it bends. A file written by another program
    may hold some, and so does a hull between a mapping and the making anew of its features.

    Examples
    --------
    >>> from assoc_hull.edit.checks.hull_findings import find_off_features
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley(stations=5, waterlines=4)
    >>> list(find_off_features(state, AddressBook(state)))
    []
    """
    live = set(state.live("rows").tolist())
    lines = set(line_numbers(state))
    for each in state.features:
        if not (live.issuperset(each.points) and lines.issuperset(each.lines)):
            text = "owns a point or lies on a line that is not there: undo the edit"
            yield Finding("feature", each.name, None, None, text)
            continue
        yield from _off(state, book, each)


def _off(state: HullState, book: AddressBook, feature: Feature) -> Iterator[Finding]:
    off = places_off(feature, state.rows.xyz[list(feature.points)])
    worst = int(np.argmax(off))
    if off[worst] > feature.gap + rounding_of(state):
        text = (
            f"lies {1e3 * off[worst]:.3f} mm off the {feature.kind} {feature.name!r}: make the "
            "feature anew, or undo what bent it"
        )
        yield row_finding(state, book, feature.points[worst], "feature", text, float(off[worst]))


_MOST_DETACHED = 10
"""More detached lines than these are reported in one finding."""

_NAMED_DETACHED = 3
"""So many further lines are named in that finding."""


def find_detached(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Report the lines that are detached from the definitions; many of them in one finding.

    Nothing is wrong with such a line, but whoever changes a definition must know that it stays.

    Examples
    --------
    >>> from assoc_hull.edit.checks.hull_findings import find_detached
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley(stations=5, waterlines=4)
    >>> list(find_detached(state, AddressBook(state)))
    []
    """
    live = set(state.live("curves").tolist())
    lost = [made for made in state.generated if not made.attached and made.curve in live]
    lines = {state.line_of(made.curve) for made in lost}
    names = sorted(book.line_name(line) for line in lines)
    if len(names) > _MOST_DETACHED:
        named = ", ".join(names[1 : 1 + _NAMED_DETACHED])
        text = (
            f"and {len(names) - 1} other lines ({named} ...) are detached from the definitions: "
            "their shape was edited since; edit.reattach returns one"
        )
        yield Finding("detached", names[0], None, float(len(names)), text)
        return
    for name in names:
        text = (
            "is detached from the definitions since its shape was edited: edit.reattach returns it"
        )
        yield Finding("detached", name, None, None, text)


# --------------------------------------------------------------------------------------
# All looks, in their order.


def check(state: HullState, notes: bool = False) -> tuple[Finding, ...]:
    """Report what is wrong with a hull; empty if nothing is.

    Parameters
    ----------
    state : HullState
        The tables of the hull.
    notes : bool
        Whether to report also what is not wrong: crossings that define a curve and that the
        role rule would not choose any more.

    Returns
    -------
    tuple of Finding
        Those on the tables first, then look by look, each sorted by kind and object.

    Examples
    --------
    >>> from assoc_hull.edit.checks.hull_findings import check
    >>> from assoc_hull.shipped.wigley import wigley
    >>> check(wigley())
    ()
    """
    book = AddressBook(state)
    found = list(find_tables(state, book))
    damaged = bool(found)
    for look in (*_LOOKS, *((find_roles,) if notes else ())):
        mine = list[Finding]()
        try:
            mine.extend(look(state, book))
        except _STUMBLES as error:
            if not damaged:
                raise
            mine.append(_left_out(look.__name__, error))
        found += sorted(mine, key=lambda each: (each.kind, each.object))
    return tuple(found)


_STUMBLES = (ArithmeticError, AttributeError, LookupError, TypeError, ValueError)
"""What a look raises over damaged tables."""


def _left_out(look: str, error: Exception) -> Finding:
    """Report that a look could not be finished over the damage that was reported before."""
    title = look.strip("_").removeprefix("find_")
    text = f"could not be checked to the end ({type(error).__name__}): mend the tables first"
    return Finding("tables", title, None, None, text)


def _broken(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Curves that could not be made, and all that is made from them."""
    for curve in state.live("curves").tolist():
        kind = State(int(state.curves.state[curve]))
        if kind is not State.CLEAN:
            yield attrs.evolve(
                _of_curve(state, book, curve), kind=kind.name.lower(), message=_BROKEN[kind]
            )
    rows = state.live("rows")
    for row in rows[state.rows.state[rows] != State.CLEAN].tolist():
        kind = State(int(state.rows.state[row]))
        yield row_finding(state, book, row, kind.name.lower(), _BROKEN[kind])


_BROKEN = {
    State.FAILED: "could not be lofted and keeps its last good shape: undo the edit or mend it",
    State.BLOCKED: "is not up to date, as something it is made from has failed: mend that",
}


def _of_curve(state: HullState, book: AddressBook, curve: int) -> Finding:
    """Make a finding, without kind and message, at the first defining point of a curve."""
    rows = state.curves.rows[curve]
    place = tuple(state.rows.xyz[int(rows[0])].tolist()) if len(rows) else None
    return Finding("", book.curve_name(curve), place, None, "")


def _gaps(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Watched crossings whose curves pass each other farther apart than they may."""
    rows = watched_on(state, state.live("curves"))
    # crossings without places, and damaged splines, are reported by other looks
    rows = rows[np.isfinite(state.rows.parameter[rows]).all(axis=1)]
    lofted = np.array([bounded(spline) for spline in state.curves.spline.data], bool)
    rows = rows[lofted[state.rows.curve[rows]].all(axis=1)]
    gap, limit = gap_at(state, rows), state.rows.limit[rows]
    for i in np.flatnonzero(gap > limit).tolist():
        text = (
            f"its curves pass {1e3 * gap[i]:.2f} mm apart, over the limit of "
            f"{1e3 * limit[i]:.2f} mm: pull here, or place a point on the curve of higher rank"
        )
        yield row_finding(state, book, int(rows[i]), "gap", text, float(gap[i]))


def _rings(state: HullState, _: AddressBook) -> Iterator[Finding]:
    """Driven links that run in a ring."""
    try:
        driven_levels(state)
    except RingError as error:
        yield Finding("ring", error.path[0], None, float(len(error.path) - 1), str(error))


_LOOKS: tuple[Callable[[HullState, AddressBook], Iterator[Finding]], ...] = (
    _broken,
    find_shape,
    find_sense,
    _gaps,
    find_links,
    find_associations,
    find_off_features,
    find_detached,
    find_lost_tunnels,
    _rings,
)
