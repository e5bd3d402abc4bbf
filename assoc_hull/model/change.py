"""What an edit changed, and no more: enough to take it back and to make it again.

A journal holds every write in turn, and the splines of all curves that followed: good for going
back at once, too much to keep. A change holds the net effect: numbers as the exclusive or of the
bits before and after, which runs both ways, other values as they were and became. Splines are
not kept, as a loft of the same points has the same bits. Positions of crossings along curves are
kept, many curves in one batch, and never computed again.

Examples
--------
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.edit.transaction import Transaction
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.change import apply_change, change_of
>>> from assoc_hull.model.definition.fingerprint import fingerprint
>>> document = Document(wigley())
>>> before, table = fingerprint(document.state), document.state.rows
>>> with Transaction(document, "move") as edit:
...     edit.write(np.array([9]), table.xyz[[9]] * [1.0, 1.01, 1.0], "the move")
>>> change = change_of(document.state, document.history[-1].journal)
>>> apply_change(document.state, change, forward=False)
>>> fingerprint(document.state) == before
True
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator
from typing import Self, TypeVar

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch, freeze
from assoc_hull.geometry.splines.loft import loft_with_signed_zeros
from assoc_hull.graph.journal import Journal, both_parts, distinct, same_value
from assoc_hull.graph.table import AnyColumn, Column, ValueColumn
from assoc_hull.model.births import Births
from assoc_hull.model.kinds import State
from assoc_hull.model.network import curve_data, loft_curves
from assoc_hull.model.tables import TABLES, CurveIntersections, HullState

__all__ = [
    "CrossingPositions",
    "EarlierPositions",
    "TableChange",
    "apply_change",
    "change_of",
    "crossing_positions",
    "net_bits",
    "nothing_lies_elsewhere",
    "positions_against",
    "put_crossing_positions",
    "row_bits",
    "shape_curves",
    "table_columns",
    "with_signed_zeros",
]

# --------------------------------------------------------------------------------------
# Positions of crossings. A crossing lies on each of its curves where the curve intersects the other
# line's plane. A few lie on a curve without such an intersection, as the end of a line on a
# boundary does: these are *stray*. Both together are all that the tables hold of places on curves.

_STRAY = -1
"""Stands for the line of a stray crossing."""


@attrs.frozen(eq=False)
class CrossingPositions:
    """Places of crossings on curves, curve by curve: intersections in their order, then strays.

    Attributes
    ----------
    curve, count : (m,) int
        The curves, and how many places each has.
    line, sign, row : (n,) int
        Of each place: the line whose plane is met (-1 for a stray one), the sense, and the
        crossing (-1 where the other line does not come).
    at : (n, 4), m
        Parameter along the curve, and x, y, z.
    """

    curve: IntArray
    count: IntArray
    line: IntArray
    sign: IntArray
    row: IntArray
    at: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.curve, self.count, self.line, self.sign, self.row, self.at)

    @property
    def owner(self) -> IntArray:
        """Index in `curve` of each place."""
        found: IntArray = np.repeat(np.arange(len(self.curve)), self.count)
        return found

    def take(self, chosen: NDArray[np.bool_]) -> Self:
        """Give some of the curves, by mask."""
        if chosen.all():
            return self
        mine = chosen[self.owner]
        return attrs.evolve(
            self, curve=self.curve[chosen], count=self.count[chosen], line=self.line[mine],
            sign=self.sign[mine], row=self.row[mine], at=self.at[mine],
        )  # fmt: skip

    def alike(self, other: CrossingPositions) -> NDArray[np.bool_]:
        """Tell for each curve whether lines, senses and crossings agree in two batches."""
        found: NDArray[np.bool_] = self.count == other.count
        if found.all() and all(
            np.array_equal(getattr(self, name), getattr(other, name))
            for name in ("line", "sign", "row")
        ):
            return found
        mine, theirs = self.take(found), other.take(found)
        odd = (mine.line != theirs.line) | (mine.sign != theirs.sign) | (mine.row != theirs.row)
        found[np.flatnonzero(found)[np.unique(mine.owner[odd])]] = False
        return found

    def still(self, other: CrossingPositions) -> NDArray[np.bool_]:
        """Tell for each curve whether two batches that are alike agree in every bit."""
        odd = (self.at.view(np.int64) != other.at.view(np.int64)).any(axis=1)
        found = np.ones(len(self.curve), np.bool_)
        found[self.owner[odd]] = False
        return found

    def same_bits(self, other: CrossingPositions) -> bool:
        """Tell whether two batches of the same curves agree in all."""
        return bool(self.alike(other).all() and self.still(other).all())

    @classmethod
    def none(cls) -> CrossingPositions:
        """Give no places."""
        whole = np.zeros(0, np.int64)
        return cls(whole, whole, whole, whole, whole, np.zeros((0, 4)))


def positions_against(before: CrossingPositions, after: CrossingPositions) -> FloatArray:
    """Give positions as the exclusive or with where the same crossing lay on the curve before.

    A line that is added or taken away changes what many curves list, and where nothing of that
    lies: what stayed becomes zeros, which compress. Crossings that were not there before stand as
    they are. Applied twice, it gives back what it took.
    """
    if not len(before.curve):
        return after.at
    found = after.at.copy()
    keys = [_keys(places) for places in (before, after)]
    _, old, new = np.intersect1d(keys[0][:, 0], keys[1][:, 0], return_indices=True)
    old, new = keys[0][old, 1], keys[1][new, 1]
    found[new] = (before.at[old].view(np.int64) ^ found[new].view(np.int64)).view(np.float64)
    return found


def _keys(places: CrossingPositions) -> IntArray:
    """Give a number for each crossing on a curve, and its place in the arrays, (k, 2)."""
    actual = np.flatnonzero(places.row >= 0)
    curve = places.curve[places.owner[actual]]
    return np.column_stack([(curve << 32) + places.row[actual], actual])


@attrs.frozen(eq=False)
class EarlierPositions:
    """What places were taken from before all that a journal holds.

    Attributes
    ----------
    meets : dict of int to CurveIntersections
        Intersections of the curves that had others.
    curve : (rows, 2) int or None
        The curves that all points lay on; None: as now.
    journal : Journal
        What was written since.
    """

    meets: dict[int, CurveIntersections]
    curve: IntArray | None
    journal: Journal


def crossing_positions(
    state: HullState, curves: IntArray, then: EarlierPositions | None = None
) -> CrossingPositions:
    """Give the places on curves (m,), each named once; `then` is the time meant, now if None."""
    known = {} if then is None else then.meets
    meets = [known.get(curve) or state.curves.meets[curve] for curve in curves.tolist()]
    met = _join(meets)
    stray_owner, stray, at = _strays(state, then, curves, met[0], met[3])
    count = np.bincount(met[0], minlength=len(curves)).astype(np.int64)
    if not len(stray):
        return CrossingPositions(curves.copy(), count, met[1], met[2], met[3], met[4])
    owner = np.concatenate([met[0], stray_owner])
    order = np.argsort(owner, kind="stable")
    nothing = np.full(len(stray), _STRAY)
    return CrossingPositions(
        curves.copy(),
        np.bincount(owner, minlength=len(curves)).astype(np.int64),
        np.concatenate([met[1], nothing])[order],
        np.concatenate([met[2], np.zeros_like(nothing)])[order],
        np.concatenate([met[3], stray >> 1])[order],
        np.concatenate([met[4], at])[order],
    )


def _join(
    meets: list[CurveIntersections],
) -> tuple[IntArray, IntArray, IntArray, IntArray, FloatArray]:
    """Concatenate intersections: owner, line, sign, row, and (n, 4), m, parameter and place."""
    whole = np.zeros(0, np.int64)
    owner = np.repeat(np.arange(len(meets)), [len(each.line) for each in meets])
    line = np.concatenate([whole, *[each.line for each in meets]])
    sign = np.concatenate([whole, *[each.sign for each in meets]])
    row = np.concatenate([whole, *[each.row for each in meets]])
    at = np.empty((len(owner), 4))
    at[:, 0] = np.concatenate([np.zeros(0), *[each.parameter for each in meets]])
    at[:, 1:] = np.concatenate([np.zeros((0, 3)), *[each.xyz for each in meets]])
    return owner, line, sign, row, at


def _strays(
    state: HullState,
    then: EarlierPositions | None,
    curves: IntArray,
    owner: IntArray,
    met: IntArray,
) -> tuple[IntArray, IntArray, FloatArray]:
    """Find crossings on curves without an intersection: index of the curve, part, (k, 4) place.

    A part is 2 row + side.
    """
    on: IntArray = state.rows.curve.data if then is None or then.curve is None else then.curve
    whose, part = _stray_parts(state, on, curves, owner, met)
    at = _places_of(state, part, None if then is None else then.journal)
    known = ~np.isnan(at).all(axis=1)
    return whose[known], part[known], at[known]


def _stray_parts(
    state: HullState, on: IntArray, curves: IntArray, owner: IntArray, met: IntArray
) -> tuple[IntArray, IntArray]:
    """Find the points that lie on curves and are no crossing there: index of the curve, part."""
    column = state.rows.curve
    if on is column.data:
        order, first = state.derived(("points on curves",), (column,), lambda: _by_curve(on))
    else:
        order, first = _by_curve(on)
    here = np.minimum(curves, len(first) - 2)  # a curve that no point lies on may lie beyond
    start, count = first[here], np.where(here == curves, first[here + 1] - first[here], 0)
    whose: IntArray = np.repeat(np.arange(len(curves)), count)
    part = order[np.arange(len(whose)) + np.repeat(start - np.cumsum(count) + count, count)]
    actual = met >= 0
    row = met[actual]
    is_met = np.zeros(on.size, np.bool_)
    is_met[2 * row + (on[row, 0] != curves[owner[actual]])] = True
    chosen = ~is_met[part]
    return whose[chosen], part[chosen]


def _places_of(state: HullState, part: IntArray, then: Journal | None) -> FloatArray:
    """Give parameter and place (k, 4) of points on curves, as they are or as they were."""
    row, side, at = part >> 1, part & 1, np.empty((len(part), 4))
    at[:, 0], at[:, 1:] = state.rows.parameter.data[row, side], state.rows.spot.data[row, side]
    if then is not None:
        then.restore(state.rows.parameter, part, at[:, 0])
        then.restore(state.rows.spot, part, at[:, 1:])
    return at


def _by_curve(on: IntArray) -> tuple[IntArray, IntArray]:
    """Give the parts of the rows by the curve that they lie on, and where each curve begins."""
    flat = on.reshape(-1)
    order = np.argsort(flat, kind="stable")
    first = np.searchsorted(flat[order], np.arange(int(flat.max(initial=-1)) + 3))
    return order, first


def put_crossing_positions(state: HullState, places: CrossingPositions) -> None:
    """Put places on curves back; the crossings must know their curves already."""
    starts, curves = np.cumsum(places.count) - places.count, places.curve.tolist()
    meets = list[CurveIntersections]()
    for curve, start, count in zip(curves, starts.tolist(), places.count.tolist(), strict=True):
        span = slice(start, start + count)
        met = int((places.line[span] >= 0).sum())
        span, known = slice(start, start + met), state.curves.meets[curve]
        what = places.line[span].copy(), places.sign[span].astype(np.int8), places.row[span].copy()
        at = places.at[span, 0].copy(), places.at[span, 1:].copy()
        if _has_crossings(known, *what):
            # The very arrays say that the structure stays: no program is made anew.
            meets.append(attrs.evolve(known, parameter=at[0], xyz=at[1]))
        else:
            meets.append(CurveIntersections(*what, *at))
    state.curves.meets.put(curves, meets)
    actual = places.row >= 0
    row, table = places.row[actual], state.rows
    side = (table.curve[row, 0] != places.curve[places.owner[actual]]).astype(np.int64)
    part = 2 * row + side
    table.parameter.put_parts(part, places.at[actual, 0])
    table.spot.put_parts(part, places.at[actual, 1:])


def _has_crossings(
    known: CurveIntersections, line: IntArray, sign: NDArray[np.int8], row: IntArray
) -> bool:
    one = np.array_equal(known.line, line) and np.array_equal(known.sign, sign)
    return one and np.array_equal(known.row, row)


# --------------------------------------------------------------------------------------
# Changes.

_PLACES = ("curves.meets", "rows.spot", "rows.parameter")
_OWN_WAY = (*_PLACES, "curves.spline", "settings.births")
"""Columns that are not kept as they are: places on curves, splines, and counts of births."""

_SHAPE = frozenset(
    {"rows.xyz", "rows.gap", "rows.base", "rows.anchor_from", "rows.anchor_weight", "rows.faired"}
)
"""Columns that an edit of shape changes, besides places on curves, splines and features."""

_S = TypeVar("_S", bound=np.generic)

BirthCounts = dict[tuple[str, str], tuple[int, int]]


@attrs.frozen(eq=False)
class TableChange:
    """The net effect of one edit on the tables.

    Attributes
    ----------
    sizes : dict of str to (int, int)
        Rows of each table that grew, before and after.
    bits : dict of str to (rows, bits)
        By ``"table.column"``: the rows (k,) that changed, and (k, bytes) uint8, the exclusive
        or of the bytes of each row before and after.
    objects : dict of str to (rows, old, new)
        Columns of objects: the rows that changed, and their values before and after.
    births : dict of (str, str) to (int, int)
        How many crossings pairs of lines ever had, before and after.
    moved : (curves, bits)
        Curves (m,) along which the same crossings lie elsewhere, and (n, 32) uint8, curve by
        curve the exclusive or of the bytes of their places, four numbers each.
    before, after : CrossingPositions
        Curves along which other crossings lie, as they were and as they are.
    lofted : (k,) int
        Curves that were lofted.
    kept : (dict, dict)
        Splines of those of them that could not be made and kept their last good shape, before
        and after, by curve.
    met : (curves, bits)
        As `moved`, of curves on which nothing but meetings lies elsewhere: of these alone.
    """

    sizes: dict[str, tuple[int, int]]
    bits: dict[str, tuple[IntArray, NDArray[np.uint8]]]
    objects: dict[str, tuple[IntArray, list[object], list[object]]]
    births: BirthCounts
    moved: tuple[IntArray, NDArray[np.uint8]]
    before: CrossingPositions
    after: CrossingPositions
    lofted: IntArray
    kept: tuple[dict[int, SplineBatch], dict[int, SplineBatch]]
    met: tuple[IntArray, NDArray[np.uint8]] = attrs.field(factory=lambda: nothing_lies_elsewhere())

    def touched(self, table: str) -> IntArray:
        """Give the rows of a table whose own columns changed, ascending, new rows included."""
        old, new = self.sizes.get(table, (0, 0))
        parts = [np.arange(old, new)]
        parts += [rows for name, (rows, _) in self.bits.items() if _table(name) == table]
        parts += [rows for name, (rows, _, _) in self.objects.items() if _table(name) == table]
        return distinct(np.concatenate(parts))

    @property
    def keeps_structure(self) -> bool:
        """Whether all numbers that change are places and shapes; of objects nothing is said."""
        return not (
            self.sizes or self.births or len(self.before.curve) or len(self.after.curve)
            or any(self.kept) or not _SHAPE.issuperset(self.bits)
        )  # fmt: skip

    @property
    def curves(self) -> IntArray:
        """Curves with other places or another shape, ascending."""
        parts = (self.moved[0], self.met[0], self.before.curve, self.lofted)
        return distinct(np.concatenate(parts))


def nothing_lies_elsewhere() -> tuple[IntArray, NDArray[np.uint8]]:
    """Give what a change holds of places where none differs."""
    return np.zeros(0, np.int64), np.zeros((0, 32), np.uint8)


def _table(name: str) -> str:
    return name.partition(".")[0]


def table_columns(state: HullState) -> Iterator[tuple[str, AnyColumn]]:
    """Give all columns of the tables by ``"table.column"``, in their order."""
    for table in TABLES:
        for name, column in getattr(state, table).columns.items():
            yield f"{table}.{name}", column


def change_of(state: HullState, journal: Journal) -> TableChange:
    """Give the net effect of a journal on the tables, right after it has run forward."""
    written = {id(column) for column in journal.columns()}
    columns = {name: column for name, column in table_columns(state) if id(column) in written}
    sizes = {name: journal.sizes(getattr(state, name)) for name in TABLES}
    bits: dict[str, tuple[IntArray, NDArray[np.uint8]]] = {}
    objects: dict[str, tuple[IntArray, list[object], list[object]]] = {}
    for name, column in columns.items():
        if name in _OWN_WAY:
            continue
        if isinstance(column, Column):
            rows, found = net_bits(journal, column)
            if len(rows):
                bits[name] = rows, found
        else:
            held = journal.net(column)
            chosen = [
                i
                for i, (a, b) in enumerate(zip(held.old, held.new, strict=True))
                if not same_value(a, b)
            ]
            if chosen:
                objects[name] = (
                    held.rows[chosen], [held.old[i] for i in chosen], [held.new[i] for i in chosen]
                )  # fmt: skip
    moved, before, after = _places(state, journal, columns)
    lofted, kept = _shapes(state, journal, columns)
    return TableChange(
        {name: size for name, size in sizes.items() if size[0] != size[1]}, bits, objects,
        _births(state, journal, columns), moved, before, after, lofted, kept,
    )  # fmt: skip


def net_bits(journal: Journal, column: Column[np.generic]) -> tuple[IntArray, NDArray[np.uint8]]:
    """Give the rows of a column that a journal has changed in the end, and the bits, by bytes."""
    net = journal.net(column)
    found = row_bits(net.old) ^ row_bits(net.new)
    # A row may have been written with the bits that it had, or taken back.
    odd = _any_bit(found)
    return net.rows[odd], found[odd]


def row_bits(values: NDArray[np.generic]) -> NDArray[np.uint8]:
    """Give each row as bytes, (k, bytes)."""
    width = values.itemsize * math.prod(values.shape[1:])
    return np.frombuffer(values.tobytes(), np.uint8).reshape(len(values), width)


def _any_bit(bits: NDArray[np.uint8]) -> NDArray[np.bool_]:
    """Tell for each row, (k, bytes), whether a bit is set."""
    words = bits.view(np.int64) if bits.shape[1] % 8 == 0 else bits
    return np.asarray(words.any(axis=1))


def _births(state: HullState, journal: Journal, columns: Collection[str]) -> BirthCounts:
    if "settings.births" not in columns:
        return {}
    net = journal.net(state.settings.births)
    old, new = net.old[0] or Births.of({}), net.new[0]
    return {pair: (old.get(pair, 0), new.get(pair, 0)) for pair in old.differing(new)}


def _places(
    state: HullState, journal: Journal, columns: Collection[str]
) -> tuple[tuple[IntArray, NDArray[np.uint8]], CrossingPositions, CrossingPositions]:
    """Compare the places on all curves that may have others than before."""
    then, curves = _columns_before(state, journal, columns)
    none = CrossingPositions.none()
    if then.curve is None and (same := _moved_places(state, curves, then)) is not None:
        return same, none, none
    old, new = crossing_positions(state, curves, then), crossing_positions(state, curves)
    alike = old.alike(new)
    one, two = old.take(alike), new.take(alike)
    still = one.still(two)
    one, two = one.take(~still), two.take(~still)
    apart = row_bits(one.at) ^ row_bits(two.at)
    return (two.curve, apart), old.take(~alike), new.take(~alike)


def _moved_places(
    state: HullState, curves: IntArray, then: EarlierPositions
) -> tuple[IntArray, NDArray[np.uint8]] | None:
    """Compare places on curves that list the same ones as before; None if some do not."""
    new = [state.curves.meets[curve] for curve in curves.tolist()]
    old = [then.meets.get(curve, each) for curve, each in zip(curves.tolist(), new, strict=True)]
    if not all(_same_meetings(one, two) for one, two in zip(old, new, strict=True)):
        return None
    counts = [len(each.line) for each in new]
    owner: IntArray = np.repeat(np.arange(len(new)), counts)
    met = np.concatenate([np.zeros(0, np.int64), *[each.row for each in new]])
    whose, part = _stray_parts(state, state.rows.curve.data, curves, owner, met)
    one, two = _places_of(state, part, then.journal), _places_of(state, part, None)
    known = ~np.isnan(two).all(axis=1)
    if not np.array_equal(known, ~np.isnan(one).all(axis=1)):
        return None
    whose, one, two = whose[known], one[known], two[known]
    bits = np.empty((len(owner) + len(whose), 4), np.int64)
    met_bits = bits[: len(owner)]
    for column, name, width in ((slice(1), "parameter", 1), (slice(1, 4), "xyz", 3)):
        were, are = (
            np.concatenate([np.zeros(0), *[getattr(each, name).ravel() for each in every]])
            for every in (old, new)
        )
        met_bits[:, column] = (were.view(np.int64) ^ are.view(np.int64)).reshape(-1, width)
    bits[len(owner) :] = one.view(np.int64) ^ two.view(np.int64)
    if len(whose):
        owner = np.concatenate([owner, whose])
        order = np.argsort(owner, kind="stable")
        owner, bits = owner[order], bits[order]
    moved = np.zeros(len(curves), np.bool_)
    moved[owner[bits.any(axis=1)]] = True
    if not moved.all():
        bits, curves = bits[moved[owner]], curves[moved]
    return curves, bits.view(np.uint8)


def _same_meetings(one: CurveIntersections, other: CurveIntersections) -> bool:
    """Tell whether two lists of intersections agree in lines, senses and crossings."""
    return one is other or all(
        mine is theirs or np.array_equal(mine, theirs)
        for mine, theirs in (
            (one.line, other.line), (one.sign, other.sign), (one.row, other.row),
        )
    )  # fmt: skip


def _columns_before(
    state: HullState, journal: Journal, columns: Collection[str]
) -> tuple[EarlierPositions, IntArray]:
    """Give what places lay in before, and the curves that may have other places now."""
    table, touched = state.rows, list[IntArray]()
    parts = [journal.parts(table.spot), journal.parts(table.parameter)]
    on, curve = table.curve.data.reshape(-1), None
    if "rows.curve" in columns:
        net = journal.net(table.curve)
        parts.append(both_parts(net.rows))
        curve = table.curve.data.copy()
        curve[net.rows] = net.old
    for part in parts:
        touched.append(on[part])
        if curve is not None:
            touched.append(curve.reshape(-1)[part])
    meets: dict[int, CurveIntersections] = {}
    if "curves.meets" in columns:
        met = journal.net(state.curves.meets)
        meets = dict(zip(met.rows.tolist(), met.old, strict=True))
        touched.append(met.rows)
    # By mask: there are a few dozen curves, and thousands of points on them.
    chosen = np.zeros(state.curves.count + 1, np.bool_)
    for each in touched:
        chosen[each] = True  # -1, for no curve, is the last one
    curves: IntArray = np.flatnonzero(chosen[:-1])
    return EarlierPositions(meets, curve, journal), curves


def _shapes(
    state: HullState, journal: Journal, columns: Collection[str]
) -> tuple[IntArray, tuple[dict[int, SplineBatch], dict[int, SplineBatch]]]:
    """Give the curves that were lofted, and the splines that are no loft of their points."""
    if "curves.spline" not in columns:
        return np.zeros(0, np.int64), ({}, {})
    net = journal.net(state.curves.spline)
    now = state.curves.state.data[net.rows]
    was = now.copy()
    if "curves.state" in columns:
        states = journal.net(state.curves.state)
        place = np.minimum(np.searchsorted(states.rows, net.rows), max(len(states.rows) - 1, 0))
        known = states.rows[place] == net.rows if len(states.rows) else np.zeros(len(now), np.bool_)
        was[known] = states.old[place[known]]
    clean = int(State.CLEAN)
    kept = tuple(
        {
            int(net.rows[i]): spline
            for i in np.flatnonzero(codes != clean).tolist()
            if (spline := splines[i]) is not None
        }
        for codes, splines in ((was, net.old), (now, net.new))
    )
    return net.rows, (kept[0], kept[1])


def apply_change(state: HullState, change: TableChange, *, forward: bool) -> None:
    """Run a change forward or backward over the tables that it was taken from.

    They are as before the edit (forward), or as after it.

    Raises
    ------
    ValueError, IndexError, AssocHullError
        The change is none of these tables, which may be spoilt then.
    """
    if forward:  # new rows must be there before they are written, and go last on the way back
        _resize(state, change, 1)
    _require_fit(state, change)
    alive = state.curves.alive.data.copy()
    columns = dict(table_columns(state))
    for name, (rows, bits) in change.bits.items():
        column = columns[name]
        assert isinstance(column, Column), name
        _flip(name, column, rows, bits)
    for name, (rows, old, new) in change.objects.items():
        held = columns[name]
        assert isinstance(held, ValueColumn), name
        for row, value in zip(rows.tolist(), new if forward else old, strict=True):
            held.store[row] = value
    if change.births:
        counts = {pair: both[forward] for pair, both in change.births.items()}
        state.settings.births.store[0] = state.births.counted(counts)
    # the crossings know their curves now, as both of these need it
    _move(state, change.moved)
    _move_meetings(state, change.met)
    put_crossing_positions(state, change.after if forward else change.before)
    revived = np.flatnonzero(state.curves.alive.data & ~alive)
    if not forward:
        _resize(state, change, 0)
    curves = np.union1d(change.lofted, revived)
    curves = curves[curves < state.curves.count]
    shape_curves(state, curves, change.kept[forward])
    shape = state.curves.spline.data
    for curve in state.live("curves").tolist() if None in shape else ():
        if shape[curve] is None:
            raise ValueError(f"the curve {state.curves.key[curve]!r} would have no shape")


def _resize(state: HullState, change: TableChange, which: int) -> None:
    for name, sizes in change.sizes.items():
        getattr(state, name).resize(sizes[which])


def _require_fit(state: HullState, change: TableChange) -> None:
    """Refuse a change that names what these tables do not have, before anything is written."""
    columns, curves = dict(table_columns(state)), state.curves.count
    for name, (rows, bits) in change.bits.items():
        column = columns[name]
        if not isinstance(column, Column) or name in _OWN_WAY:
            raise ValueError(f"{name} is no column of numbers")
        width = column.dtype.itemsize * math.prod(column.shape)
        if bits.shape != (len(rows), width):
            raise ValueError(f"the bits of {name} are of the shape {bits.shape}")
        _require_rows(name, rows, getattr(state, _table(name)).count)
    for name, (rows, old, new) in change.objects.items():
        held = columns[name]
        if not isinstance(held, ValueColumn) or name in _OWN_WAY:
            raise ValueError(f"{name} is no column of objects")
        if not len(rows) == len(old) == len(new):
            raise ValueError(f"{name} has {len(rows)} rows, {len(old)} and {len(new)} objects")
        _require_rows(name, rows, len(held.data))
    numbered = {"moved": change.moved[0], "met": change.met[0], "lofted": change.lofted}
    numbered |= {"before": change.before.curve, "after": change.after.curve}
    numbered |= {"kept": np.array(sorted({*change.kept[0], *change.kept[1]}), np.int64)}
    for name, rows in numbered.items():
        _require_rows(name, rows, curves)
    for places in (change.before, change.after):
        for name, numbers, count in (
            ("lines", places.line, state.lines.count), ("points", places.row, state.rows.count),
        ):  # fmt: skip
            if numbers.size and not (numbers.min() >= -1 and numbers.max() < count):
                raise ValueError(f"a place on a curve is on none of {count} {name}")
        if not np.isfinite(places.at[places.line >= 0]).all():
            raise ValueError("a meeting of a curve lies nowhere")


def _require_rows(name: str, rows: IntArray, count: int) -> None:
    if rows.size and not (rows[0] >= 0 and rows[-1] < count and (rows[1:] > rows[:-1]).all()):
        raise ValueError(f"the rows of {name} are not among {count}, ascending")


_MAY_BE_NAN = frozenset({"rows.limit", "rows.gap", "lines.offset"})
"""Columns of numbers that hold nan where there is nothing."""


def _flip(name: str, column: Column[np.generic], rows: IntArray, bits: NDArray[np.uint8]) -> None:
    values = column.take(rows)
    flipped = row_bits(values) ^ bits
    found = flipped.view(column.dtype).reshape(values.shape)
    if found.dtype == np.float64 and name not in _MAY_BE_NAN and not np.isfinite(found).all():
        raise ValueError(f"{name} becomes no number")
    if found.dtype == np.bool_ and flipped.max(initial=0) > 1:
        raise ValueError(f"{name} becomes neither true nor false")
    column.put(rows, found)


def _move(state: HullState, moved: tuple[IntArray, NDArray[np.uint8]]) -> None:
    curves, bits = moved
    if len(curves):
        now = crossing_positions(state, curves)
        if bits.shape != (len(now.at), 32):
            raise ValueError(f"{len(bits)} places are moved, and {len(now.at)} are there")
        at = (row_bits(now.at) ^ bits).view(np.float64)
        if not np.isfinite(at[now.line >= 0]).all():
            raise ValueError("a meeting of a curve would lie nowhere")
        put_crossing_positions(state, attrs.evolve(now, at=at))


def _move_meetings(state: HullState, met: tuple[IntArray, NDArray[np.uint8]]) -> None:
    """Move meetings along curves; they stay the meetings that they were."""
    curves, bits = met
    if not len(curves):
        return
    meets = [state.curves.meets[curve] for curve in curves.tolist()]
    owner, _, _, row, at = _join(meets)
    if bits.shape != (len(at), 32):
        raise ValueError(f"{len(bits)} meetings are moved, and {len(at)} are there")
    at = (row_bits(at) ^ bits).view(np.float64)
    if not np.isfinite(at).all():
        raise ValueError("a meeting of a curve would lie nowhere")
    stop = np.cumsum([len(each.line) for each in meets]).tolist()
    moved = [
        attrs.evolve(each, parameter=at[b - len(each.line) : b, 0].copy(),
                     xyz=at[b - len(each.line) : b, 1:].copy())
        for each, b in zip(meets, stop, strict=True)
    ]  # fmt: skip
    state.curves.meets.put(curves.tolist(), moved)
    table, actual = state.rows, row >= 0
    part = 2 * row[actual] + (table.curve[row[actual], 0] != curves[owner[actual]])
    table.parameter.put_parts(part, at[actual, 0])
    table.spot.put_parts(part, at[actual, 1:])


def with_signed_zeros(state: HullState) -> HullState:
    """Give tables of their own whose curves were lofted as files up to version 6 had them."""
    found = state.as_written()
    curves = np.flatnonzero(found.curves.alive.data & (found.curves.state.data == State.CLEAN))
    if len(curves):
        batch = loft_with_signed_zeros(curve_data(found, curves))
        for curve, spline in zip(curves.tolist(), batch.single(), strict=True):
            found.curves.spline.store[curve] = spline
    return found


def shape_curves(state: HullState, curves: IntArray, kept: dict[int, SplineBatch]) -> None:
    """Give curves (k,) their splines: lofted from their points, or as they were kept.

    Dead curves are left as they are; `kept` are the splines of curves that could not be made.
    """
    chosen = state.curves.alive[curves] & (state.curves.state[curves] == State.CLEAN)
    made = curves[chosen]
    if len(made):
        state.curves.spline.put(made.tolist(), loft_curves(state, made).single())
    if kept:
        state.curves.spline.put(list(kept), list(kept.values()))
