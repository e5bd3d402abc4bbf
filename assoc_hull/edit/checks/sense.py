"""Whether curves still pass, at the crossings they are made through, in the sense they did.

A crossing is one meeting and keeps its sign: the curve enters the half space of its partner
there, or leaves it. A curve bent so far that it passes there the other way, or not at all,
is another topology: its meeting of that sign lies elsewhere now, and the crossing would
stand for two places at once.
"""

from __future__ import annotations

from collections.abc import Iterator

import attrs
import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import Sort
from assoc_hull.model.state import HullState, Meets

__all__ = ["Turned", "find_sense", "find_turned", "turned"]


@attrs.frozen(eq=False)
class Turned:
    """Crossings at which a curve made through them does not pass as it did.

    Attributes
    ----------
    row, curve : (k,) int
        The crossing, and the curve.
    apart : (k,), m
        How far from the crossing the curve passes in the old sense; inf if nowhere.
    """

    row: IntArray
    curve: IntArray
    apart: FloatArray


def turned(state: HullState, curves: IntArray) -> Turned:
    """Find the crossings of curves that are not their meetings where they lie.

    A meeting has the sign its crossing was born with, so one that lies where the crossing
    does, within the length below which two points are one, says that the sense is kept. Left
    out is where a line ends, turns or leaves a flat; and a boundary curve may run in the
    plane of a line that ends on it.
    """
    if not len(curves):
        return Turned(curves, curves, np.zeros(0))
    table, defining = state.rows, [state.curves.rows.data[curve] for curve in curves.tolist()]
    row, owner = np.concatenate(defining), np.repeat(curves, [len(each) for each in defining])
    part = _parts(state, row, owner)
    met, place = _met(state, curves)
    contact, hit = table.contact.data[row], _positions(met, part)
    needed = (table.sort.data[row] == Sort.CROSSING) & ~(contact & ((part & 1 == 1) | (hit < 0)))
    row, owner, hit = row[needed], owner[needed], hit[needed]
    apart, found = np.full(len(row), np.inf), hit >= 0
    apart[found] = np.abs(place[hit[found]] - table.xyz.data[row[found]]).max(axis=1, initial=0.0)
    wrong = apart > state.tolerances.coincident
    return Turned(row[wrong], owner[wrong], apart[wrong])


def _positions(known: IntArray, wanted: IntArray) -> IntArray:
    """Give where each wanted number stands among the known ones; -1 where it does not."""
    if not len(known):
        return np.full(len(wanted), -1)
    order = np.argsort(known, kind="stable")
    place = np.minimum(np.searchsorted(known, wanted, sorter=order), len(known) - 1)
    found: IntArray = order[place]
    return np.where(known[found] == wanted, found, -1)


def _parts(state: HullState, row: IntArray, curve: IntArray) -> IntArray:
    """Give twice the point, plus the side on which the curve stands."""
    found: IntArray = 2 * row + (state.rows.curve.data[row, 0] != curve)
    return found


def _met(state: HullState, curves: IntArray) -> tuple[IntArray, FloatArray]:
    """Give the crossings that meetings of curves are, as parts, and where these lie."""
    meets: list[Meets] = [state.curves.meets.data[curve] for curve in curves.tolist()]
    row = np.concatenate([each.row for each in meets])
    owner = np.repeat(curves, [len(each.row) for each in meets])
    actual = row >= 0
    place = np.concatenate([each.xyz for each in meets])
    return _parts(state, row[actual], owner[actual]), place[actual]


def find_turned(state: HullState, curves: IntArray) -> tuple[str, ...]:
    """Say where curves pass a plane in another sense than their crossing there has."""
    found = turned(state, curves)
    if not len(found.row):
        return ()
    book = AddressBook(state)
    return tuple(
        f"{book.address(row)}: {_text(state, book, row, curve, apart)}: make the move smaller, "
        "or move the neighbouring points too"
        for row, curve, apart in _each(found)
    )


def find_sense(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give the findings of this kind on a whole hull."""
    live = state.live("curves")
    lofted = [state.curves.spline.data[curve] is not None for curve in live.tolist()]
    for row, curve, apart in _each(turned(state, live[lofted])):
        text = f"{_text(state, book, row, curve, apart)}: undo the edit, or move the points beside"
        yield row_finding(state, book, row, "sense", text, apart)


def _each(found: Turned) -> Iterator[tuple[int, int, float]]:
    return zip(found.row.tolist(), found.curve.tolist(), found.apart.tolist(), strict=True)


def _text(state: HullState, book: AddressBook, row: int, curve: int, apart: float) -> str:
    """Say how a curve passes at a crossing, and where it passes as it did."""
    a, b = state.rows.curve.data[row].tolist()
    partner = state.line_of(b if curve == a else a)
    x, y, z = state.rows.xyz.data[row].tolist()
    sine = float((_slope(state, row, curve) * state.lines.normal.data[partner]).sum())
    angle = float(np.degrees(np.arcsin(np.clip(sine, -1.0, 1.0))))
    there = f"{apart:.3g} m away" if np.isfinite(apart) else "nowhere near"
    return (
        f"{book.curve_name(curve)} folds through the plane of {book.line_name(partner)} at "
        f"({x:.3f}, {y:.3f}, {z:.3f}) m, it makes {angle:.1f} degrees with it there and passes "
        f"in the sense of this crossing {there}"
    )


def _slope(state: HullState, row: int, curve: int) -> FloatArray:
    """Give the unit tangent of a curve where it goes on from a point, at its end as it comes."""
    spline: SplineBatch = state.spline(curve)
    place: FloatArray = state.rows.xyz.data[row]
    knot = int(np.argmin(np.abs(spline.xyz - place).max(axis=1)))
    slope: FloatArray = spline.arrive[knot] if knot == len(spline.knot) - 1 else spline.leave[knot]
    size = float(np.sqrt((slope * slope).sum()))
    unit: FloatArray = slope / (size or 1.0)
    return unit
