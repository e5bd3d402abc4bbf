"""Check a whole hull: what is wrong, each finding with its place and number.

`check` runs every look in a fixed order. `find_tables` comes first: where it finds damage, a
later look that fails over it is reported as unfinished; on a sound hull such a failure is raised.
The looks of one page stand here too; those on links, shapes and tables have modules of their own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import attrs
import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.edit.checks.link_findings import find_associations, find_links, find_roles
from assoc_hull.edit.checks.shape_findings import bounded, find_sense, find_shape
from assoc_hull.edit.checks.table_findings import find_tables
from assoc_hull.edit.checks.tunnel_findings import find_lost_tunnels
from assoc_hull.errors import RingError
from assoc_hull.model.address import AddressBook
from assoc_hull.model.feature_geometry import line_numbers, places_off, rounding_of
from assoc_hull.model.features import Feature
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.index import driven_levels
from assoc_hull.model.kinds import State
from assoc_hull.model.tables import HullState

__all__ = [
    "check",
    "find_detached",
    "find_off_features",
]


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
