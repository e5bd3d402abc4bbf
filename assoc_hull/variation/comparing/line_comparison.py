"""The lines of a parent and of a variant side by side: shift, fairness, points.

Lines are the same if they have one name; those left over, if they have one key: then the variant's
has been renamed. A shift is divided into what the plane of the line did, along its normal, and how
far the line lies from the parent's within the plane: the distance of two curves, not of points.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.distance import OwnedCurves, farthest_points, identical_curves
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState
from assoc_hull.variation.comparing.line_fairness import (
    FairnessChange,
    LineFairness,
    measure_fairness,
)

__all__ = [
    "LEAST",
    "LineComparison",
    "LineShift",
    "compare_lines",
    "line_shifts",
]

# --------------------------------------------------------------------------------------
# A line whose plane went along its normal is laid into the parent's plane first, and the curves
# are compared there: of every place of either the nearest of the other, and of these pairs the
# farthest. A line in space, or one whose plane has turned, is compared as it lies. Where nothing
# but ends moved, their distance counts: a line that is longer or shorter has moved.

LEAST = 1e-6
"""A line that lies less than this (m) from the parent's has not moved."""

_TURNED = 1e-9
"""Unit normals that differ by more belong to planes that are not parallel."""

_SIDE = 0.4
"""A coordinate with less than this part of the largest one is not named as a direction."""

_WAYS = (("forward", "aft"), ("out", "in"), ("up", "down"))

Place = tuple[float, float, float]


@attrs.frozen
class LineShift:
    """The largest shift of a line.

    Attributes
    ----------
    before, after : (float, float, float), m
        A place of the parent's line and one of the variant's, each the nearest of the other,
        or of all places of its line the farthest.
    plane : float or None, m
        How far the plane went along its normal (the coordinate that the lines of a family
        share); None for a line in space, or where the plane has turned.
    course : float, m
        The distance of both places within the plane, or in space.
    """

    before: Place
    after: Place
    plane: float | None
    course: float

    @property
    def vector(self) -> Place:
        """From the place before to that after, m: x forward, y out, z up."""
        x, y, z = (b - a for a, b in zip(self.before, self.after, strict=True))
        return x, y, z

    @property
    def length(self) -> float:
        """The distance of both places, m: of plane and course together."""
        return math.hypot(self.plane or 0.0, self.course)

    @property
    def moved(self) -> bool:
        """Tell whether the line has moved at all."""
        return self.length > LEAST

    @property
    def direction(self) -> str:
        """The direction in words, as "out" or "up and forward"; "-" where nothing moved."""
        if not self.moved:
            return "-"
        most = max(map(abs, self.vector))
        told = [
            (abs(part), ways[part < 0.0])
            for part, ways in zip(self.vector, _WAYS, strict=True)
            if abs(part) >= _SIDE * most
        ]
        return " and ".join(word for _, word in sorted(told, key=lambda each: -each[0]))


def line_shifts(
    parent: HullState, variant: HullState, pairs: Sequence[tuple[int, int]]
) -> list[LineShift]:
    """Measure how far lines lie from those of a parent, all in one go.

    Parameters
    ----------
    parent, variant : HullState
        The tables.
    pairs : sequence of (int, int)
        Numbers of a line of the parent and of that of the variant; both have a shape.

    Returns
    -------
    list of LineShift
        Pair by pair.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.comparing.line_comparison import line_shifts
    >>> old, new = wigley(), wigley(breadth=11.0)
    >>> line = old.lines.name.data.index("WL 6.25")
    >>> (shift,) = line_shifts(old, new, [(line, line)])
    >>> shift.direction, [round(part, 9) for part in shift.vector]
    ('out', [0.0, 0.5, 0.0])
    """
    laid = [_Laid.of(parent, old, variant, new) for old, new in pairs]
    shifts = [each.unmoved for each in laid]
    apart = [i for i, each in enumerate(laid) if not identical_curves(each.before, each.after)]
    found = farthest_points(
        OwnedCurves.of([laid[i].before for i in apart]),
        OwnedCurves.of([laid[i].after for i in apart]),
    )
    for i, *places in zip(apart, found.one, found.other, found.distance.tolist(), strict=True):
        shifts[i] = laid[i].shift(*places)
    return shifts


@attrs.frozen(eq=False)
class _Laid:
    """A line of the parent and of the variant, both in the parent's plane.

    Attributes
    ----------
    before, after : list of SplineBatch
        Their curves.
    plane : float or None, m
        How far the plane went along its normal.
    back : (3,), m
        From the parent's plane to the variant's.
    """

    before: list[SplineBatch]
    after: list[SplineBatch]
    plane: float | None
    back: FloatArray

    @classmethod
    def of(cls, parent: HullState, old: int, variant: HullState, new: int) -> _Laid:
        """Take a line of both hulls by its numbers."""
        plane = _plane(parent, old, variant, new)
        back = np.zeros(3) if plane is None else plane * variant.lines.normal[new]
        after = [_moved(spline, -back) for spline in _splines(variant, new)]
        return cls(_splines(parent, old), after, plane, back)

    def shift(self, before: FloatArray, after: FloatArray, course: float) -> LineShift:
        """Tell the shift between two places in the parent's plane."""
        return LineShift(_place(before), _place(after + self.back), self.plane, course)

    @property
    def unmoved(self) -> LineShift:
        """The shift of a line that has the same bits in the parent's plane."""
        start = self.before[0].xyz[0]
        return self.shift(start, start, 0.0)


def _splines(state: HullState, line: int) -> list[SplineBatch]:
    return [state.spline(curve) for curve in state.curves_of(line)]


def _plane(parent: HullState, old: int, variant: HullState, new: int) -> float | None:
    """Give how far a plane went along its normal, m; None if it turned, or there is none."""
    was, now = parent.lines, variant.lines
    if not (was.planar[old] and now.planar[new]):
        return None
    if np.abs(was.normal[old] - now.normal[new]).max() > _TURNED:
        return None
    return float(now.offset[new] - was.offset[old])


def _moved(spline: SplineBatch, by: FloatArray) -> SplineBatch:
    """Give a spline moved by a vector (3,), m; unmoved splines keep their identity."""
    return attrs.evolve(spline, xyz=spline.xyz + by, home=None) if by.any() else spline


def _place(point: FloatArray) -> Place:
    x, y, z = point.tolist()
    return x, y, z


@attrs.frozen(eq=False)
class LineComparison:
    """A line of a parent, of a variant, or of both.

    Attributes
    ----------
    name : str
        In the variant; of a line that went, in the parent.
    was : str or None
        Its name in the parent; None if it came.
    group : str
        The group it belongs to.
    what : {"same", "moved", "came", "went"}
        Whether it lies where it did (to 1e-6 m), elsewhere, or is in one of both only. A line
        that has no shape in one of them is not there.
    shift : LineShift or None
        Its largest shift; None for a line that is in one only.
    before, after : LineFairness or None
        Changes of sign of its curvature, and comb integral, seen in the parent's planes.
    points : (int, int)
        How many points define it, in parent and variant.
    """

    name: str
    was: str | None
    group: str
    what: str
    shift: LineShift | None
    before: LineFairness | None
    after: LineFairness | None
    points: tuple[int, int]

    @property
    def fairness(self) -> FairnessChange | None:
        """Fairness before and after; None for a line that is in one of both only."""
        if self.before is None or self.after is None:
            return None
        return FairnessChange(self.before, self.after)

    @property
    def length(self) -> float:
        """Its largest shift, m; 0 for a line that is in one of both only."""
        return 0.0 if self.shift is None else self.shift.length

    @property
    def course(self) -> float:
        """Its largest shift beside that of its plane, m; 0 if it is in one of both only."""
        return 0.0 if self.shift is None else self.shift.course

    @property
    def added(self) -> int:
        """Changes of sign of curvature that were added; 0 if it is in one of both only."""
        return 0 if self.fairness is None else self.fairness.added

    @property
    def comb_ratio(self) -> float | None:
        """Comb integral after / before; None without one, or where both are straight."""
        if self.fairness is None or np.isnan(self.fairness.comb_ratio):
            return None
        return self.fairness.comb_ratio


def compare_lines(parent: HullState, variant: HullState) -> tuple[LineComparison, ...]:
    """Compare all lines of two hulls, in the order of the variant; those that went come last.

    Parameters
    ----------
    parent, variant : HullState
        The tables.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.comparing.line_comparison import compare_lines
    >>> found = compare_lines(wigley(waterlines=3), wigley(waterlines=5))
    >>> [(each.name, each.what) for each in found if each.was is None]
    [('WL 1.5625', 'came'), ('WL 4.6875', 'came')]
    """
    old, new = _by_name(parent), _by_name(variant)
    both = _pairs(parent, old, variant, new)
    fair_old = measure_fairness(parent, old.values())
    views = {
        _key(variant, new[name]): fair_old[_key(parent, old[was])] for name, was in both.items()
    }
    fair_new = measure_fairness(variant, new.values(), like=views)
    shifts = line_shifts(parent, variant, [(old[was], new[name]) for name, was in both.items()])
    shift = dict(zip(both, shifts, strict=True))
    there = _Side(parent, old, fair_old)
    here = _Side(variant, new, fair_new)
    gone = [was for was in old if was not in set(both.values())]
    return (
        *(_line(name, both.get(name), shift.get(name), there, here) for name in new),
        *(_line(None, was, None, there, here) for was in gone),
    )


@attrs.frozen(eq=False)
class _Side:
    """One of two hulls: its tables, the numbers of its lines by name, their fairness by key."""

    state: HullState
    lines: Mapping[str, int]
    fairness: Mapping[str, LineFairness]

    def points(self, name: str | None) -> int:
        """Count the points that define a line."""
        if name is None:
            return 0
        rows = [self.state.curves.rows[c] for c in self.state.curves_of(self.lines[name])]
        return len(np.unique(np.concatenate(rows)))

    def fair(self, name: str | None) -> LineFairness | None:
        return None if name is None else self.fairness[_key(self.state, self.lines[name])]

    def group(self, name: str) -> str:
        group = int(self.state.lines.group[self.lines[name]])
        return str(self.state.groups.name[group])


def _line(
    name: str | None, was: str | None, shift: LineShift | None, there: _Side, here: _Side
) -> LineComparison:
    """Put together what is known of a line; at least one of its names is given."""
    title, side = (str(was), there) if name is None else (name, here)
    if shift is None:
        what = "went" if name is None else "came"
    else:
        what = "moved" if shift.moved else "same"
    return LineComparison(
        title, was, side.group(title), what, shift, there.fair(was), here.fair(name),
        (there.points(was), here.points(name)),
    )  # fmt: skip


def _by_name(state: HullState) -> dict[str, int]:
    """Give the lines that have a shape, by name."""
    book = AddressBook(state)
    live = state.live("lines").tolist()
    return {book.line_name(line): line for line in live if state.curves_of(line)}


def _key(state: HullState, line: int) -> str:
    return str(state.lines.key[line])


def _pairs(
    parent: HullState, old: Mapping[str, int], variant: HullState, new: Mapping[str, int]
) -> dict[str, str]:
    """Give for lines of the variant the name that they have in the parent."""
    left = {_key(parent, line): name for name, line in old.items() if name not in new}
    found = {}
    for name, line in new.items():
        was = name if name in old else left.get(_key(variant, line))
        if was is not None:
            found[name] = was
    return found
