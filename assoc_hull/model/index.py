"""Look-ups derived from the tables: planes to cut with, who drives whom, levels.

Made anew whenever the structure of a hull changes (a line, a role, a birth); an edit of
shape only reads it.
"""

from __future__ import annotations

from collections import defaultdict

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.graph.run_update import levels
from assoc_hull.model.address import AddressBook
from assoc_hull.model.forms.generate_points import definitions_read
from assoc_hull.model.generated_curves import attached_curves
from assoc_hull.model.tables import HullState

__all__ = ["Index", "PlaneSet", "build_index", "driven_levels", "index_columns"]


@attrs.frozen(eq=False)
class PlaneSet:
    """Parallel planes of the lines of one group.

    Attributes
    ----------
    normal : (3,)
        Unit normal.
    offsets : (p,), m
        Ascending.
    lines : (p,) int
        The line in each plane.
    """

    normal: FloatArray
    offsets: FloatArray
    lines: IntArray


@attrs.frozen(eq=False)
class Index:
    """Derived look-ups of a hull.

    Attributes
    ----------
    partners : dict of int to tuple of PlaneSet
        For a group, the planes its curves are cut with, in the order of the group names.
    drives : dict of int to (k,) int
        For a curve, the rows computed from it, ascending.
    riders : dict of int to (k,) int
        For a row, the adopted points that ride with it.
    level : (c,) int
        Level of each curve in the graph of driven links.
    makes : dict of int to (k,) int
        For a point at the end of a generated curve, the points made with it.
    forms : dict of int to (k,) int
        For a definition, the points made of it.
    guess : (r, 2) int32
        In which segment of its two curves each crossing was last found; never relied upon.
    generated : bool
        Whether points of a curve come from definitions.
    """

    partners: dict[int, tuple[PlaneSet, ...]]
    drives: dict[int, IntArray]
    riders: dict[int, IntArray]
    level: IntArray
    makes: dict[int, IntArray]
    forms: dict[int, IntArray]
    guess: np.typing.NDArray[np.int32]
    generated: bool


def index_columns(state: HullState) -> tuple[object, ...]:
    """Give the columns that look-ups are derived from."""
    rows, curves, lines, groups = state.rows, state.curves, state.lines, state.groups
    return (
        rows.alive, rows.sort, rows.curve, rows.reader, rows.driver, rows.anchor,
        curves.alive, curves.line, curves.rows, lines.alive, lines.planar, lines.normal,
        lines.offset, lines.group, groups.alive, groups.name, groups.family,
        state.settings.associations, state.formed.alive, state.formed.definition,
        state.produced.alive, state.produced.curve,
    )  # fmt: skip


def build_index(state: HullState) -> Index:
    """Derive the look-ups.

    Raises
    ------
    RingError
        If driven links run in a ring; the path names the curves.
    """
    rows = state.rows
    driver = np.where(rows.alive.data, rows.driver.data, -1)
    driven = np.flatnonzero(driver >= 0)
    drives, guess = _by_value(driver[driven], driven), np.zeros((rows.count, 2), np.int32)
    makes, forms = _generating(state)
    return Index(
        _partners(state), drives, _riders(state), driven_levels(state), makes, forms, guess,
        generated=bool(attached_curves(state)),
    )  # fmt: skip


def driven_levels(state: HullState) -> IntArray:
    """Give the level of each curve in the graph of driven links, (c,) int.

    Raises
    ------
    RingError
        If driven links run in a ring; the path names the curves.
    """
    rows = state.rows
    driver = np.where(rows.alive.data, rows.driver.data, -1)
    reader = np.where(rows.reader[:, 0] >= 0, rows.reader[:, 0], rows.reader[:, 1])
    link = np.flatnonzero((driver >= 0) & (reader >= 0))
    return levels(state.curves.count, driver[link], reader[link], AddressBook(state).curve_name)


def _by_value(values: IntArray, items: IntArray) -> dict[int, IntArray]:
    order = np.argsort(values, kind="stable")
    keys, first = np.unique(values[order], return_index=True)
    parts = np.split(items[order], first[1:]) if len(keys) else []
    return dict(zip(keys.tolist(), parts, strict=True))


def _riders(state: HullState) -> dict[int, IntArray]:
    found: defaultdict[int, list[int]] = defaultdict(list)
    anchors = state.rows.anchor.data
    riding = np.flatnonzero(state.rows.alive.data & (anchors >= 0).any(axis=1))
    for row, pair in zip(riding.tolist(), anchors[riding].tolist(), strict=True):
        for anchor in sorted(set(pair) - {-1}):
            found[anchor].append(row)
    return {anchor: np.array(riders, np.int64) for anchor, riders in found.items()}


def _generating(state: HullState) -> tuple[dict[int, IntArray], dict[int, IntArray]]:
    """Give the generated points by the ends, and by the definitions, that they are made of."""
    ends, forms = defaultdict[int, list[int]](list), defaultdict[int, list[int]](list)
    number = {state.formed.definition[i].use: i for i in state.live("formed").tolist()}
    for curve, made in attached_curves(state).items():
        for use in definitions_read(made):
            if use in number:
                forms[number[use]] += made.rows
        if made.reads_ends:
            for row in set(state.curves.rows[curve][[0, -1]].tolist()):
                ends[row] += made.rows
    return tuple(  # type: ignore[return-value]
        {each: np.array(sorted(rows), np.int64) for each, rows in found.items()}
        for found in (ends, forms)
    )


def _partners(state: HullState) -> dict[int, tuple[PlaneSet, ...]]:
    names = state.groups.name.data
    number = {name: group for group, name in enumerate(names)}
    pairs: defaultdict[int, set[str]] = defaultdict(set)
    for link in state.associations:
        pairs[number[link.a]].add(link.b)
        pairs[number[link.b]].add(link.a)
    planes = {name: _planes(state, group) for name, group in number.items()}
    return {
        group: tuple(part for name in sorted(others) for part in planes[name])
        for group, others in sorted(pairs.items())
    }


def _planes(state: HullState, group: int) -> tuple[PlaneSet, ...]:
    """Group a family's planes by normal; boundary curves cut nothing, they are contacts."""
    if state.groups.family[group] == "boundary":
        return ()
    lines = state.lines
    mine = np.flatnonzero(lines.alive.data & lines.planar.data & (lines.group.data == group))
    found: list[PlaneSet] = []
    for normal in sorted({tuple(row) for row in lines.normal[mine].tolist()}):
        chosen = mine[(lines.normal[mine] == normal).all(axis=1)]
        chosen = chosen[np.argsort(lines.offset[chosen], kind="stable")]
        found.append(PlaneSet(np.array(normal), lines.offset[chosen].copy(), chosen))
    return tuple(found)
