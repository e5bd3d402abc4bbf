"""Findings on shape: numbers, folds, points too close, crossings off their curves or planes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeGuard

import numpy as np

from assoc_hull.edit.checks.finding import Finding, row_finding
from assoc_hull.geometry.curves import IntArray, SplineBatch
from assoc_hull.geometry.splines.closest import closest_each
from assoc_hull.geometry.splines.curve_order import folds
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.state import HullState

__all__ = ["bounded", "find_shape"]


def find_shape(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Give all findings on the shape of curves and the places of points.

    Examples
    --------
    >>> from assoc_hull.edit.checks.shape import find_shape
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.model.address import AddressBook
    >>> state = wigley()
    >>> list(find_shape(state, AddressBook(state)))
    []
    """
    yield from _unbounded_points(state, book)
    yield from _off_planes(state, book)
    lofted = list[int]()
    for curve in state.live("curves").tolist():
        yield from _close(state, book, curve)
        spline = state.curves.spline.data[curve]
        if not bounded(spline):
            yield _unbounded(state, book, curve)
            continue
        yield from _folds(book, curve, spline)
        lofted.append(curve)
    yield from _off_curves(state, book, lofted)


def _unbounded_points(state: HullState, book: AddressBook) -> Iterator[Finding]:
    rows = state.live("rows")
    for row in rows[~np.isfinite(state.rows.xyz.data[rows]).all(axis=1)].tolist():
        yield row_finding(state, book, row, "not finite", "has no finite place: undo the edit")


def bounded(spline: SplineBatch | None) -> TypeGuard[SplineBatch]:
    """Tell whether a curve has a spline, and all its numbers are finite."""
    return spline is not None and all(
        np.isfinite(part).all() for part in (spline.xyz, spline.leave, spline.arrive)
    )


def _unbounded(state: HullState, book: AddressBook, curve: int) -> Finding:
    name = book.curve_name(curve)
    return Finding("not finite", name, None, None, "has no finite spline: undo the edit")


def _folds(book: AddressBook, curve: int, spline: SplineBatch) -> Iterator[Finding]:
    found = folds(spline)
    for knot, cosine in zip(found.knot.tolist(), found.cosine.tolist(), strict=True):
        x, y, z = spline.xyz[knot].tolist()
        text = f"folds back on itself (cosine {cosine:.2f}): move the points beside it, or undo"
        yield Finding("fold", book.curve_name(curve), (x, y, z), cosine, text)


def _close(state: HullState, book: AddressBook, curve: int) -> Iterator[Finding]:
    """Neighbouring points of one curve, so near that their chord has no direction."""
    rows = state.curves.rows.data[curve]
    step = np.diff(state.rows.xyz.data[rows], axis=0)
    away = np.sqrt((step * step).sum(axis=1))
    for i in np.flatnonzero(away < state.tolerances.coincident).tolist():
        other = book.address(int(rows[i + 1]))
        text = (
            f"lies {away[i]:.3g} m from {other} on {book.curve_name(curve)}, closer than "
            f"{state.tolerances.coincident:g} m: delete one, or give one another role"
        )
        yield row_finding(state, book, int(rows[i]), "close", text, float(away[i]))


def _off_curves(state: HullState, book: AddressBook, curves: list[int]) -> Iterator[Finding]:
    """Points that should lie on a curve and do not."""
    if not curves:
        return
    number = np.full(state.curves.count, -1)
    number[curves] = np.arange(len(curves))
    rows, curve = _points_of(state, number)
    batch = SplineBatch.join([state.spline(each) for each in curves])
    away = closest_each(batch, number[curve], state.rows.xyz.data[rows])[2]
    for i in np.flatnonzero(away > state.tolerances.consistent).tolist():
        text = f"lies {away[i]:.3g} m off {book.curve_name(int(curve[i]))}: undo the edit"
        yield row_finding(state, book, int(rows[i]), "off curve", text, float(away[i]))


def _points_of(state: HullState, number: IntArray) -> tuple[IntArray, IntArray]:
    """Give the points that should lie on curves that have a number, with their curves."""
    rows = state.live("rows")
    watched = (state.rows.sort.data[rows] == Sort.CROSSING) & (
        state.rows.role.data[rows] == Role.WATCHED
    )
    rows = rows[np.isfinite(state.rows.xyz.data[rows]).all(axis=1) & ~watched]
    curve = state.rows.curve.data[rows]
    known = (curve >= 0) & (curve < len(number))
    known[known] = number[curve[known]] >= 0
    known[:, 1] &= curve[:, 1] != curve[:, 0]
    order, side = np.nonzero(known)
    return rows[order], curve[order, side]


def _off_planes(state: HullState, book: AddressBook) -> Iterator[Finding]:
    """Points out of the plane of a curve they lie on: exact where it is a coordinate plane."""
    rows = state.live("rows")
    for side in (0, 1):
        mine = rows[state.rows.curve.data[rows, side] >= 0]
        lines = state.curves.line.data[state.rows.curve.data[mine, side]]
        mine, lines = mine[state.lines.planar.data[lines]], lines[state.lines.planar.data[lines]]
        normal = state.lines.normal.data[lines]
        terms = state.rows.xyz.data[mine] * normal
        off = np.abs(terms[:, 0] + terms[:, 1] + terms[:, 2] - state.lines.offset.data[lines])
        exact = (np.abs(normal) == 1.0).any(axis=1)
        wrong = off > np.where(exact, 0.0, state.tolerances.consistent)
        for i in np.flatnonzero(wrong).tolist():
            name = book.line_name(int(lines[i]))
            text = f"lies {off[i]:.3g} m out of the plane of {name}: undo the edit"
            yield row_finding(state, book, int(mine[i]), "off plane", text, float(off[i]))
