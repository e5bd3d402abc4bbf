"""Curvature combs of lines, each in its own plane, with the inflections marked."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fairness.combs import combs
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.geometry.splines.evaluation import evaluate
from assoc_hull.plot.lines_plan.drawing import DrawnLine, Sketchable, drawing
from assoc_hull.plot.sheet.paper import PaperName, Pen
from assoc_hull.plot.sheet.pens import HEAVY, TINT
from assoc_hull.plot.sheet.sheet import Path_, Sheet, save
from assoc_hull.plot.sheet.view import scale_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["curvature_combs"]

_TEETH = 8
_HIGH = 0.2  # part of a panel's height that a usual tooth takes
_CUT = 1.6  # times that: the longest tooth
_USUAL = 95.0  # per cent of the teeth are no longer than that
_MARGIN, _HEAD = 12.0, 11.0  # mm at A3

_TOOTH = Pen(0.06, "#4a86b8", over=1.5)
_TIPS = Pen(0.12, "#0b5fa5", over=1.8)
_STEPS = (1.0, 2.0, 5.0, 10.0)


@attrs.frozen(eq=False)
class _Comb:
    """A line with its comb in axes of its plane: m, teeth in 1/m along them, (., 2)."""

    line: DrawnLine
    courses: tuple[FloatArray, ...]
    base: FloatArray
    tooth: FloatArray
    inflections: FloatArray

    @property
    def size(self) -> FloatArray:
        """Extent in both axes, m."""
        found: FloatArray = np.ptp(np.concatenate(self.courses), axis=0)
        return found


def curvature_combs(
    hull: Sketchable,
    lines: Sequence[str],
    path: Path_ | None = None,
    *,
    scale: float | None = None,
    paper: PaperName = "A3",
) -> Figure:
    """Draw curvature combs: the teeth stand on the outside of the curve.

    Parameters
    ----------
    hull : Hull, HullState or Drawing
        The hull.
    lines : sequence of str
        Names of the lines; one panel each, one below the other.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    scale : float, optional
        Curvature (1/m) that a tooth of 10 mm on paper stands for, at all lines; by default
        chosen line by line so that 95 % of the teeth fit; how many longer ones are cut is told.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The picture; scales are stated at each panel.

    Raises
    ------
    BadInputError
        No line, a line that lies in no plane, a scale that is not positive.
    UnknownNameError
        A line that does not exist.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.plot import curvature_combs
    >>> figure = curvature_combs(wigley(), ["WL 2.5", "ST 7"])
    """
    if not lines or not (scale is None or scale > 0.0):
        raise BadInputError(
            f"{len(lines)} lines and a scale of {scale}", "in curvature combs",
            "name a line or more, and give a scale above 0",
        )  # fmt: skip
    plan = drawing(hull)
    found = [_comb(plan.line(name)) for name in lines]
    sheet = Sheet(paper)
    tall = (sheet.paper.height - 2.0 * _MARGIN * sheet.paper.factor) / len(found)
    for i, comb in enumerate(found):
        top = sheet.paper.height - _MARGIN * sheet.paper.factor - i * tall
        _panel(sheet, comb, top, tall, scale)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _comb(line: DrawnLine) -> _Comb:
    """Take the curvature of a line, in axes of its plane: along the ship first, then up."""
    if np.isnan(line.normal).any():
        raise BadInputError("a space curve has no comb in a plane", line.name, "choose plane lines")
    axes = _axes(line.normal)
    base, tooth, bends = [], [], []
    for spline in line.splines:
        foot, tip = combs(spline, line.normal, _TEETH, -1.0)
        base.append(foot.reshape(-1, 3) @ axes)
        tooth.append(np.nan_to_num((tip - foot).reshape(-1, 3) @ axes))
        places = inflections(spline, line.normal)[1]
        bends.append(evaluate(spline, places.curve, places.t) @ axes)
    courses = tuple(points @ axes for points in line.polylines)
    return _Comb(line, courses, *(np.concatenate(each) for each in (base, tooth, bends)))


def _axes(normal: FloatArray) -> FloatArray:
    """Give two unit vectors of a plane, (3, 2): forward or outward, and across to it."""
    first = np.array([1.0, 0.0, 0.0]) if abs(normal[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    first = first - (first @ normal) * normal
    first /= np.sqrt(first @ first)
    second = np.cross(normal, first)
    upward = second[2] if abs(second[2]) > 1e-9 else second[1]
    return np.column_stack([first, second if upward > 0.0 else -second])


def _panel(sheet: Sheet, comb: _Comb, top: float, tall: float, given: float | None) -> None:
    """Draw one comb; the curve and its teeth have scales of their own, both stated."""
    factor = sheet.paper.factor
    wide = sheet.paper.width - 2.0 * _MARGIN * factor
    room = tall - _HEAD * factor
    denominator = max(
        scale_of(float(comb.size[0]), wide - 2.0 * _HIGH * room),
        scale_of(float(comb.size[1]), (1.0 - 2.0 * _HIGH) * room),
    )
    length = np.sqrt((comb.tooth * comb.tooth).sum(axis=1))
    per_ten = given or _round(10.0 * float(np.percentile(length, _USUAL)) / (_HIGH * room))
    unit, high = 1e3 / denominator, 10.0 / per_ten
    low = np.concatenate(comb.courses).min(axis=0)
    centre = np.array([0.5 * sheet.paper.width, top - _HEAD * factor - 0.5 * room])
    origin = centre - unit * (low + 0.5 * comb.size)
    cut = _draw(sheet, comb, origin, unit, high, _CUT * _HIGH * room)
    bends = len(comb.inflections)
    words = (
        f"1:{denominator:g};  tooth of 10 mm: curvature {per_ten:g} 1/m, "
        f"radius {1.0 / per_ten:.4g} m;  {bends} inflection{'' if bends == 1 else 's'} (dots)"
        + (f";  {cut} longer teeth are cut" if cut else "")
    )
    left = _MARGIN * factor
    name = comb.line.name
    title = sheet.text(
        (left, top - 2.0 * factor),
        name,
        size=1.5,
        bold=True,
        across="left",
        up="top",
        name=f"label/{name}",
    )
    beside = sheet.box(title)[2] + 4.0 * factor
    sheet.text(
        (beside, top - 2.6 * factor),
        words,
        size=1.1,
        across="left",
        up="top",
        name=f"label/scale/{name}",
    )


def _round(value: float) -> float:
    """Give the next 1, 2 or 5 times a power of ten above a value; 1 for nil."""
    if value <= 0.0:
        return 1.0
    power = 10.0 ** np.floor(np.log10(value))
    return float(f"{next(step for step in _STEPS if step * power >= value) * power:.6g}")


def _draw(
    sheet: Sheet, comb: _Comb, origin: FloatArray, unit: float, high: float, most: float
) -> int:
    """Draw curve, teeth and their tips; give how many teeth were cut at `most` mm."""
    name = comb.line.name
    base = origin + unit * comb.base
    length = high * np.sqrt((comb.tooth * comb.tooth).sum(axis=1))
    long = length > most
    short = np.where(long, most / np.where(long, length, 1.0), 1.0)
    tip = base + high * short[:, None] * comb.tooth
    teeth = np.full((3 * len(base), 2), np.nan)
    teeth[0::3], teeth[1::3] = base, tip
    sheet.line(teeth, _TOOTH, f"teeth/{name}")
    edge, count = np.where(long[:, None], np.nan, tip), 0
    for spline in comb.line.splines:
        size = (len(spline.knot) - 1) * _TEETH
        sheet.line(edge[count : count + size], _TIPS, f"tips/{name}")
        count += size
    for course in comb.courses:
        sheet.line(origin + unit * course, HEAVY, f"line/{name}")
    sheet.dots(origin + unit * comb.inflections, TINT, 1.3, f"inflections/{name}")
    return int(long.sum())
