"""How lines lie off what they were, drawn many times as large along the hull's normal.

A line that moved by a few millimetres coincides on paper with what it was. So from the old line
teeth are drawn as combs are: as long as the movement along the hull's normal, times a factor, in
one colour where the hull came out and in another where it went in.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.arguments import positive
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.splines.evaluation import sample
from assoc_hull.plot.lines_plan.drawing import Drawing, PlotLine
from assoc_hull.plot.sheet.paper import TINT, Pen
from assoc_hull.plot.sheet.sheet_figure import Sheet
from assoc_hull.plot.sheet.view import View

__all__ = ["ExaggeratedMovement", "exaggerated", "steps_from"]

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
