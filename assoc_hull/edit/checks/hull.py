"""What is wrong with a hull, each finding with its place and number; empty if nothing is."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import attrs
import numpy as np

from assoc_hull.edit.checks.associations import find_associations
from assoc_hull.edit.checks.features import find_off_features
from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.edit.checks.forms import find_detached
from assoc_hull.edit.checks.links import find_links
from assoc_hull.edit.checks.roles import find_roles
from assoc_hull.edit.checks.sense import find_sense
from assoc_hull.edit.checks.shape import bounded, find_shape
from assoc_hull.edit.checks.table_findings import find_tables
from assoc_hull.edit.document import Document
from assoc_hull.errors import RingError
from assoc_hull.model.address import AddressBook
from assoc_hull.model.gaps import gap_at, watched_on
from assoc_hull.model.index import driven_levels
from assoc_hull.model.kinds import State
from assoc_hull.model.state import HullState

__all__ = ["Finding", "check"]


def check(source: Document | HullState, notes: bool = False) -> tuple[Finding, ...]:
    """Look a whole hull over.

    Parameters
    ----------
    source : Document or HullState
        The hull.
    notes : bool
        Whether to tell also what is not wrong: crossings that define a curve and that the
        role rule would not choose any more.

    Returns
    -------
    tuple of Finding
        In the order of their kinds, each kind by the keys of the objects.

    Examples
    --------
    >>> from assoc_hull.edit.checks.hull import check
    >>> from assoc_hull.shipped.wigley import wigley
    >>> check(wigley())
    ()
    """
    state = source.state if isinstance(source, Document) else source
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


def _left_out(look: str, error: Exception) -> Finding:
    """Say that a look could not be finished over the damage that is told before."""
    title = look.strip("_").removeprefix("find_")
    text = f"could not be checked to the end ({type(error).__name__}): mend the tables first"
    return Finding("tables", title, None, None, text)


def _broken(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Curves that could not be made, and all that is made from them."""
    for curve in state.live("curves").tolist():
        kind = State(int(state.curves.state.data[curve]))
        if kind is not State.CLEAN:
            yield attrs.evolve(
                _of_curve(state, book, curve), kind=kind.name.lower(), message=_BROKEN[kind]
            )
    rows = state.live("rows")
    for row in rows[state.rows.state.data[rows] != State.CLEAN].tolist():
        kind = State(int(state.rows.state.data[row]))
        yield row_finding(state, book, row, kind.name.lower(), _BROKEN[kind])


_BROKEN = {
    State.FAILED: "could not be lofted and keeps its last good shape: undo the edit or mend it",
    State.BLOCKED: "is not up to date, as something it is made from has failed: mend that",
}


def _of_curve(state: HullState, book: AddressBook, curve: int) -> Finding:
    rows = state.curves.rows.data[curve]
    place = tuple(state.rows.xyz.data[int(rows[0])].tolist()) if len(rows) else None
    return Finding("", book.curve_name(curve), place, None, "")


def _gaps(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Watched crossings whose curves pass each other farther apart than they may."""
    rows = watched_on(state, state.live("curves"))
    rows = rows[np.isfinite(state.rows.parameter.data[rows]).all(axis=1)]
    lofted = np.array([bounded(spline) for spline in state.curves.spline.data], bool)
    rows = rows[lofted[state.rows.curve.data[rows]].all(axis=1)]
    gap, limit = gap_at(state, rows), state.rows.limit.data[rows]
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
    _rings,
)
