"""The body plan before and after an edit, and movements drawn many times as large.

A movement is told along the normal of the hull, so that a point that slides along it does not
count. Lines that moved are tinted, the old ones grey; the largest movement is named. A
`snapshot` is a drawing that stays as it is while the hull is edited.

How lines lie off what they were, drawn many times as large along the hull's normal.

A line that moved by a few millimetres coincides on paper with what it was. So from the old line
teeth are drawn as combs are: as long as the movement along the hull's normal, times a factor, in
one colour where the hull came out and in another where it went in.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.arguments import positive
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.plot.lines_plan.drawing import (
    Drawable,
    Drawing,
    PlotCrossings,
    PlotLine,
    drawing,
    zoomed,
)
from assoc_hull.plot.lines_plan.plan import window_rows
from assoc_hull.plot.lines_plan.three_views import (
    Views,
    body_halves,
    body_sides,
    extent,
    scale_of_body,
)
from assoc_hull.plot.sheet.paper import BEFORE, MARGIN, TINT, PaperName, Pen, View, scale_of
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import (
    BLOCK,
    caption,
    frame,
    title_block,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = [
    "LEAST",
    "ExaggeratedMovement",
    "LineMovement",
    "before_after",
    "exaggerated",
    "moved_parts",
    "movements",
    "overlay",
    "pairs_of",
    "same_shape",
    "snapshot",
    "steps_from",
]

_FINE = 64
"""Chords per segment of the line as it was, against which distances are taken."""

_IN = "#0b5fa5"
_TIPS = {True: Pen(0.24, TINT, over=3.0), False: Pen(0.24, _IN, over=3.0)}
_TEETH = {True: Pen(0.05, "#e59aa6", over=1.6), False: Pen(0.05, "#93bbdd", over=1.6)}


def exaggerated(now: Drawing, factor: float | None) -> ExaggeratedMovement | None:
    """Give what draws movements so many times as large; None where it is not wanted.

    Raises
    ------
    BadInputError
        A factor not above 0.
    """
    if factor is None:
        return None
    return ExaggeratedMovement(now, positive(factor, "exaggerate", "in a picture"))


def steps_from(line: PlotLine, points: FloatArray) -> FloatArray:
    """Give the steps to points (k, 3) from the nearest places of a line, (k, 3), m."""
    every = np.stack([_steps(spline, points) for spline in dict.fromkeys(line.splines)])
    nearest = np.argmin((every * every).sum(axis=2), axis=0)
    found: FloatArray = every[nearest, np.arange(len(points))]
    return found


def _steps(spline: SplineBatch, points: FloatArray) -> FloatArray:
    from scipy.spatial import cKDTree

    course = sample(spline, _FINE)[1]
    nearest = cKDTree(course).query(points)[1]
    last = len(course) - 1
    before = _from_chord(course[np.maximum(nearest - 1, 0)], course[nearest], points)
    after = _from_chord(course[nearest], course[np.minimum(nearest + 1, last)], points)
    shorter = (before * before).sum(axis=1) <= (after * after).sum(axis=1)
    return np.where(shorter[:, None], before, after)


def _from_chord(start: FloatArray, end: FloatArray, points: FloatArray) -> FloatArray:
    along, step = end - start, points - start
    square = (along * along).sum(axis=1)
    part = (step * along).sum(axis=1) / np.where(square > 0.0, square, 1.0)
    off: FloatArray = step - np.clip(part, 0.0, 1.0)[:, None] * along
    return off


@attrs.frozen(eq=False)
class ExaggeratedMovement:
    """Draws how far lines lie off what they were.

    Attributes
    ----------
    now : Drawing
        The lines as they are, with the normals of the hull at their crossings.
    factor : float
        How many times as large movements are drawn.
    least : float, m
        Smaller ones are not drawn.
    """

    now: Drawing
    factor: float
    least: float = 1e-4

    def words(self, view: View) -> str:
        """Tell the scale of movements in a view, to follow its own scale."""
        per = view.denominator / self.factor
        return f";  movement {self.factor:g} times: 1 mm on paper for {per:.3g} mm"

    @property
    def note(self) -> str:
        """What the colours are."""
        return (
            f"Off the line as it was, along the hull's normal, {self.factor:g} times: red out, "
            "blue in."
        )

    def draw(self, sheet: Sheet, view: View, was: PlotLine, now: PlotLine) -> None:
        """Draw the teeth of a line, and a line along their tips."""
        for points in now.polylines:
            step = steps_from(was, points)
            normal = self._normals(now, points, step)
            amount = (step * normal).sum(axis=1)
            shown = np.abs(amount) >= self.least
            if not shown.any():
                continue
            flat = np.where(np.isfinite(now.normal), now.normal, 0.0)
            along = normal - (normal @ flat)[:, None] * flat
            foot = points - step
            tip = view.on_paper(foot + self.factor * amount[:, None] * along)
            foot = view.on_paper(foot)
            for out in (True, False):
                mine = np.flatnonzero(shown & ((amount > 0.0) == out))
                if not len(mine):
                    continue
                teeth = np.full((3 * len(mine), 2), np.nan)
                teeth[0::3], teeth[1::3] = foot[mine], tip[mine]
                name = f"{view.name}/{'out' if out else 'in'}"
                sheet.line(teeth, _TEETH[out], f"{name}/teeth/{now.name}")
                # on to where it ends, a place beyond
                near = np.zeros(len(points), np.bool_)
                near[np.unique(np.clip(mine[:, None] + [-1, 0, 1], 0, len(points) - 1))] = True
                near &= (amount > 0.0) == out
                line = np.where(near[:, None], tip, np.nan)
                sheet.line(line, _TIPS[out], f"{name}/{now.name}")

    def _normals(self, line: PlotLine, points: FloatArray, step: FloatArray) -> FloatArray:
        """Give the outward normals of the hull along a line, between those at its crossings."""
        from scipy.spatial import cKDTree

        crossings = self.now.crossings
        mine = np.array([line.name in each for each in crossings.line], np.bool_)
        place, normal = crossings.xyz[mine], crossings.normal[mine]
        away, at = cKDTree(points).query(place.reshape(-1, 3))
        away, at = np.atleast_1d(away), np.atleast_1d(at)
        # crossings of another piece of the line are farther off than points lie apart
        chord = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1)).max()
        on = np.flatnonzero(away <= chord)
        if not len(on):
            length = np.sqrt((step * step).sum(axis=1))
            own: FloatArray = step / np.where(length > 0.0, length, 1.0)[:, None]
            return own
        on = on[np.argsort(at[on], kind="stable")]
        index = np.arange(len(points))
        found = np.column_stack([np.interp(index, at[on], normal[on, k]) for k in range(3)])
        size = np.sqrt((found * found).sum(axis=1))
        turned: FloatArray = found / np.where(size > 0.0, size, 1.0)[:, None]
        return turned


# --------------------------------------------------------------------------------------
# How far lines lie from where they were.

LEAST = 5e-4
"""Movements below this (m) are not shown."""


@attrs.frozen
class LineMovement:
    """How far a line lies from where it was.

    Attributes
    ----------
    line : str
        Its name.
    distance : float, m
        The largest movement along the hull's normal; nan for a new line.
    place : (float, float, float), m
        Where that is now.
    """

    line: str
    distance: float
    place: tuple[float, float, float]


def movements(before: Drawing, after: Drawing, least: float = LEAST) -> tuple[LineMovement, ...]:
    """Give the lines that moved by `least`, m, the farthest first, then those that are new.

    Movement is taken at the crossings, along the hull's normal there; for a line without
    crossings it is the distance between the line and what it was.
    """
    old = {line.name: line for line in before.lines}
    at_crossings = _at_crossings(before.crossings, after.crossings)
    found = []
    for line in after.lines:
        if line.name not in old:
            found.append(LineMovement(line.name, float("nan"), _place(line.points[0])))
        elif not same_shape(old[line.name], line):
            moved = at_crossings.get(line.name) or _moved(old[line.name], line)
            found += [moved] if moved.distance > least else []
    return tuple(
        sorted(found, key=lambda each: (np.isnan(each.distance), -each.distance, each.line))
    )


def same_shape(old: PlotLine, new: PlotLine) -> bool:
    """Tell whether a line is the same, to the bit."""
    return len(old.polylines) == len(new.polylines) and all(
        np.array_equal(a, b) for a, b in zip(old.polylines, new.polylines, strict=True)
    )


def moved_parts(old: PlotLine | None, new: PlotLine) -> Iterator[FloatArray]:
    """Give the stretches of a line that lie away from what it was, (k, 3), m."""
    for points in new.polylines:
        if old is None or not old.splines:
            yield points
            continue
        away = _from_all(old, points) > LEAST
        begins = np.flatnonzero(away & ~np.concatenate([[False], away[:-1]]))
        ends = np.flatnonzero(away & ~np.concatenate([away[1:], [False]]))
        for begin, end in zip(begins.tolist(), ends.tolist(), strict=True):
            yield points[max(begin - 1, 0) : end + 2]


def _at_crossings(old: PlotCrossings, new: PlotCrossings) -> dict[str, LineMovement]:
    """Give for each line the largest movement along the normal of any of its crossings.

    With the mean of the normals before and after, sliding along a curved hull counts in the
    third order only.
    """
    where = {key: i for i, key in enumerate(old.key)}
    pairs = [(where[key], i) for i, key in enumerate(new.key) if key in where]
    then, now = np.array(pairs, np.int64).reshape(-1, 2).T
    sense = np.sign((old.normal[then] * new.normal[now]).sum(axis=1))
    normal = 0.5 * (new.normal[now] + sense[:, None] * old.normal[then])
    distance = np.abs(((new.xyz[now] - old.xyz[then]) * normal).sum(axis=1))
    found: dict[str, LineMovement] = {}
    for i in np.argsort(distance, kind="stable").tolist():
        row = int(now[i])
        for line in new.line[row]:
            found[line] = LineMovement(line, float(distance[i]), _place(new.xyz[row]))
    return found


def _moved(old: PlotLine, new: PlotLine) -> LineMovement:
    points = new.points
    distance = _from_all(old, points)
    worst = int(np.argmax(distance))
    return LineMovement(new.name, float(distance[worst]), _place(points[worst]))


def _place(point: FloatArray) -> tuple[float, float, float]:
    x, y, z = point.tolist()
    return x, y, z


def _from_all(line: PlotLine, points: FloatArray) -> FloatArray:
    """Give the distance of points (k, 3) from a line, (k,), m."""
    step = steps_from(line, points)
    found: FloatArray = np.sqrt((step * step).sum(axis=1))
    return found


# --------------------------------------------------------------------------------------
# The body plan before and after an edit, with the lines that moved tinted.

_SIDE = 38.0  # mm at A3, for the words at the arrow
_ABOVE, _BELOW = 16.0, 20.0
_SHARE = 0.35  # of the height of the sheet, for the half-breadth plan of a stretch
_TOLD = 12
"""At most so many movements are listed."""

_AFTER = Pen(0.22, TINT, over=3.0)
_ARROW = Pen(0.2, TINT, over=4.0)

Pair = tuple[PlotLine | None, PlotLine | None]


def snapshot(hull: Drawable) -> Drawing:
    """Keep the lines of a hull as they are now, for `before_after`."""
    return drawing(hull)


def before_after(
    before: Drawable,
    after: Drawable,
    path: Path_ | None = None,
    *,
    paper: PaperName = "A3",
    title: str | None = None,
    half_breadth: bool = False,
    exaggerate: float | None = None,
    x: tuple[float, float] | None = None,
) -> Figure:
    """Draw the body plan before and after an edit.

    Lines are tinted where they moved, over what they were, in grey. The largest movement is
    named where it is. It is that along the hull's normal: neither a point that slides along
    the hull counts, nor that a small change moves a line of a grazing plane far.

    Parameters
    ----------
    before, after : Hull, HullState or Drawing
        A hull before (see `snapshot`) and after.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.
    title : str, optional
        Instead of the name of the ship.
    half_breadth : bool
        Whether to draw the half-breadth plan below.
    exaggerate : float, optional
        How many times as large movements are drawn: in place of two lines that coincide on
        paper, teeth of the movement along the hull's normal, red out, blue in.
    x : (float, float), m, optional
        Draw only what lies between these stations, larger.

    Returns
    -------
    matplotlib.figure.Figure
        The picture.

    Raises
    ------
    MissingExtraError
        Matplotlib is not installed.
    BadInputError
        An unknown paper or ending; no line between the stations; a factor not above 0.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot import before_after, snapshot
    >>> hull = wigley()
    >>> figure = before_after(snapshot(hull), hull)
    """
    old, new = zoomed(drawing(before), x), zoomed(drawing(after), x)
    large = exaggerated(new, exaggerate)
    moved = movements(old, new, LEAST if large is None else large.least)
    sheet = Sheet(paper)
    frame(sheet, MARGIN * sheet.paper.factor)
    _block(sheet, title or new.particulars.name, old, new, moved, large)
    views = Views(sheet, new, *extent(old, new))
    base = _half(views, old, large) if half_breadth else MARGIN * sheet.paper.factor
    _body(views, old, base, moved, large)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _block(
    sheet: Sheet, title: str, old: Drawing, new: Drawing, moved: Sequence[LineMovement],
    large: ExaggeratedMovement | None,
) -> None:  # fmt: skip
    """Write what moved, the farthest first."""
    factor = sheet.paper.factor
    corner = (sheet.paper.width - MARGIN * factor, sheet.paper.height - MARGIN * factor)
    rows = [*window_rows(new.window), *((each.line, _amount(each)) for each in moved[:_TOLD])]
    if len(moved) > _TOLD:
        rows.append((f"and {len(moved) - _TOLD} more", ""))
    gone = sorted({line.name for line in old.lines} - {line.name for line in new.lines})
    notes = [
        f"{len(moved)} of {len(new.lines)} lines moved, by these amounts along the hull's normal.",
        f"Red: where by more than {1e3 * LEAST:g} mm. Grey: before."
        if large is None
        else large.note,
    ]
    notes += [f"Removed: {', '.join(gone[:4])}{' ...' if len(gone) > 4 else ''}"] if gone else []
    title_block(sheet, corner, BLOCK * factor, title, rows, notes)


def _amount(moved: LineMovement) -> str:
    return "new" if np.isnan(moved.distance) else f"{1e3 * moved.distance:.1f} mm"


def _half(views: Views, old: Drawing, large: ExaggeratedMovement | None) -> float:
    """Draw the half-breadth plan at the foot of the sheet; give the height it ends at, mm."""
    paper, (low, high) = views.sheet.paper, (views.low, views.high)
    factor = paper.factor
    length = float(high[0] - low[0])
    scale = scale_of(length, paper.width - 2.0 * (MARGIN + 17.0) * factor)
    if views.drawing.window is not None:
        # a short stretch is as high as it is long
        scale = max(scale, scale_of(float(high[1]), _SHARE * paper.height))
    x = 0.5 * (paper.width - 1e3 / scale * length) - 1e3 / scale * float(low[0])
    view = View("half-breadth", (0, 1), scale, (x, (MARGIN + 20.0) * factor))
    views.half_breadth(view)
    pairs = pairs_of(old.of("waterlines"), views.drawing.of("waterlines"))
    overlay(views.sheet, view, pairs, large=large)
    words = f"HALF-BREADTH PLAN  1:{scale:g}" + ("" if large is None else large.words(view))
    place = (view.across(views.drawing.middle), view.up(0.0) - 11.0 * factor)
    caption(views.sheet, place, words)
    return view.up(float(high[1])) + 12.0 * factor


def pairs_of(old: Sequence[PlotLine], new: Sequence[PlotLine]) -> Iterator[Pair]:
    """Give lines before and after by name, each once; None where there is none."""
    was, now = ({line.name: line for line in lines} for lines in (old, new))
    yield from ((was.get(name), now.get(name)) for name in dict.fromkeys((*was, *now)))


def overlay(
    sheet: Sheet, view: View, pairs: Iterable[Pair], pen: Pen = BEFORE,
    large: ExaggeratedMovement | None = None,
) -> None:  # fmt: skip
    """Draw lines as they were, in grey or another pen, and in red where they moved.

    With `large`, a line of both has its movement drawn in place of the two.
    """
    for was, now in pairs:
        if was is not None and now is not None:
            if same_shape(was, now):
                continue
            if large is not None:
                large.draw(sheet, view, was, now)
                continue
        if was is not None:
            for points in was.polylines:
                sheet.line(view.on_paper(points), pen, f"{view.name}/before/{was.name}")
        if now is not None:
            for part in moved_parts(was, now):
                sheet.line(view.on_paper(part), _AFTER, f"{view.name}/moved/{now.name}")


def _body(
    views: Views, old: Drawing, base: float, moved: Sequence[LineMovement],
    large: ExaggeratedMovement | None,
) -> None:  # fmt: skip
    paper, (low, high) = views.sheet.paper, (views.low, views.high)
    factor = paper.factor
    width = paper.width - (2.0 * MARGIN + BLOCK + 2.0 * _SIDE) * factor
    room = paper.height - MARGIN * factor - base - (_ABOVE + _BELOW) * factor
    height = float(high[2] - low[2])
    breadth, sides = float(high[1]), body_sides(views.drawing)
    scale = scale_of_body(0.5 * len(sides) * breadth, height, (width, room))
    spare = room - height * 1e3 / scale
    up = base + _BELOW * factor + 0.5 * spare - float(low[2]) * 1e3 / scale
    middle = 0.5 * (paper.width - BLOCK * factor) - 0.5 * sum(sides) * breadth * 1e3 / scale
    view = View("body", (1, 2), scale, (middle, up))
    views.body(view)
    sections = Views(views.sheet, old, low, high).sections
    halves = (body_halves(lines, views.middle) for lines in (sections, views.sections))
    for half, was, now in zip((view.mirrored(), view), *halves, strict=True):
        overlay(views.sheet, half, pairs_of(was, now), large=large)
    foot = view.up(float(low[2])) - 9.0 * factor
    words = f"BODY PLAN  1:{scale:g}" + ("" if large is None else large.words(view))
    caption(views.sheet, (view.across(0.5 * sum(sides) * breadth), foot), words)
    if moved and not np.isnan((largest := moved[0]).distance):
        _arrow(views, view, largest)


def _arrow(views: Views, view: View, largest: LineMovement) -> None:
    """Name the largest movement beside the body plan, with an arrow to its place."""
    sheet, factor = views.sheet, views.sheet.paper.factor
    aft = largest.place[0] < views.middle
    half = view.mirrored() if aft else view
    tip = half.on_paper(np.array([largest.place]))[0]
    edge = half.across(float(views.high[1])) + half.sign * 19.0 * factor
    x, y, z = largest.place
    amount = f"{1e3 * largest.distance:.1f} mm"
    # One coordinate a line: the words stand between the view and the frame of the sheet.
    words = f"{amount}\n{largest.line}\nx {x:.3f} m\ny {y:.3f} m\nz {z:.3f} m"
    middle = 0.5 * float(views.low[2] + views.high[2])
    level = float(tip[1]) + (7.0 if z < middle else -7.0) * factor
    text = sheet.text(
        (edge, level), words, across="right" if aft else "left", colour=TINT, name="label/largest"
    )
    sheet.take(text)
    start = (edge - half.sign * 1.0 * factor, level)
    sheet.arrow(start, (float(tip[0]), float(tip[1])), _ARROW, "arrow/largest")
