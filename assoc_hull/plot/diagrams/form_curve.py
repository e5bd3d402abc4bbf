"""A form-parameter curve: its vertices, its curvature comb, the centroid of its area."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.arguments import instance
from assoc_hull.creation.form_curve import FormCurve
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.chain import FormChain
from assoc_hull.plot.sheet.chart import Chart, ChartScale, level_grid, scale_to, upright_grid
from assoc_hull.plot.sheet.paper import HEAVY, MARGIN, TINT, PaperName, Pen
from assoc_hull.plot.sheet.sheet_figure import Path_, Sheet, save
from assoc_hull.plot.sheet.title_block import BLOCK, frame, title_block

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["form_curve_picture"]

_STEPS = 24
"""Teeth of a segment."""
_HIGH, _CUT, _USUAL = 16.0, 26.0, 90.0
"""A usual tooth and the longest one, mm at A3; per cent of the teeth that are no longer."""
_BESIDE, _BELOW, _ABOVE = 20.0, 15.0, 12.0
_MARKS = 8
_NIL = 1e-14
"""Of the size of a curve: a smaller number is written as 0."""

_POLYGON = Pen(0.13, "#8a8a8a", (2.0, 1.0), 1.8)
_AREA = "#eef3f8"
_TOOTH, _TIPS = Pen(0.06, "#4a86b8", over=1.5), Pen(0.12, "#0b5fa5", over=1.8)
_CENTROID = "#0a7d55"
_NAMES = {
    "x": "x", "y": "y", "angle_deg": "angle, deg", "curvature": "curvature", "tangent": "tangent",
    "stretch": "stretch",
}  # fmt: skip


def form_curve_picture(
    curve: FormCurve, path: Path_ | None = None, *, title: str = "", paper: PaperName = "A4"
) -> Figure:
    """Draw a form-parameter curve as true as its two axes are alike: both have one scale.

    Parameters
    ----------
    curve : FormCurve
        The curve.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    title : str
        What stands above the parameters.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Returns
    -------
    matplotlib.figure.Figure
        The curve over the area under it, its polygon of vertices (dashed), its curvature comb on
        the outside, its inflections (red dots) and the centroid (green).

    Raises
    ------
    BadInputError
        No curve, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.

    Examples
    --------
    >>> import assoc_hull as ah
    >>> from assoc_hull.plot.diagrams.form_curve import form_curve_picture
    >>> curve = ah.creation.FormCurve.of((0, 0), (10, 8), start_angle_deg=62, finish_angle_deg=0)
    >>> figure = form_curve_picture(curve)
    """
    instance(curve, FormCurve, "the curve", "in a picture")
    sheet = Sheet(paper)
    frame(sheet, MARGIN * sheet.paper.factor)
    field = _field(sheet, curve)
    comb = _comb(curve)
    _area(field, curve)
    _teeth(field, comb)
    course = field.at(FormChain(curve.vertices[None]).at(0, np.linspace(0.0, 4.0, 401)))
    sheet.line(course, HEAVY, "curve")
    _vertices(field, curve)
    sheet.dots(field.at(_inflections(curve)), TINT, 1.5, "inflections")
    _centroid(field, curve)
    _block(sheet, curve, comb, title)
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


@attrs.frozen(eq=False)
class _Field:
    """The field of the picture, with its scales."""

    chart: Chart
    along: ChartScale
    up: ChartScale

    def at(self, points: FloatArray) -> FloatArray:
        """Give places on paper, mm."""
        x, y = points.reshape(-1, 2).T
        return np.column_stack([self.along.at(x), self.up.at(y)])


@attrs.frozen(eq=False)
class _Comb:
    """Feet of the teeth, in the plane of the curve, and the teeth with their true directions."""

    foot: FloatArray
    tooth: FloatArray

    @property
    def usual(self) -> float:
        """A curvature that most teeth do not exceed."""
        size = np.sqrt((self.tooth * self.tooth).sum(axis=1))
        return float(np.percentile(size, _USUAL))


def _field(sheet: Sheet, curve: FormCurve) -> _Field:
    """Lay the plane out: vertices, curve and axis within the field, one scale for both axes."""
    factor, margin = sheet.paper.factor, MARGIN * sheet.paper.factor
    left, low = margin + _BESIDE * factor, margin + _BELOW * factor
    wide = sheet.paper.width - margin - (BLOCK + _HIGH) * factor - left
    tall = sheet.paper.height - margin - _ABOVE * factor - low
    least, most = curve.vertices.min(axis=0), curve.vertices.max(axis=0)
    least[1], most[1] = min(least[1], 0.0), max(most[1], 0.0)
    span = np.maximum(most - least, 1e-9 * max(1.0, float(np.abs(curve.vertices).max())))
    room = _HIGH * factor
    unit = min((wide - 2.0 * room) / span[0], (tall - 2.0 * room) / span[1])
    middle = 0.5 * (least + most)
    ends = [
        (float(middle[k] - 0.5 * size / unit), float(middle[k] + 0.5 * size / unit))
        for k, size in enumerate((wide, tall))
    ]
    along = scale_to(*ends[0], left, wide, _MARKS, whole=False)
    up = scale_to(*ends[1], low, tall, _MARKS, whole=False)
    chart = Chart(sheet, left, low, wide, tall)
    level_grid(chart, up, "y")
    upright_grid(chart, along, "x")
    chart.border()
    return _Field(chart, along, up)


def _comb(curve: FormCurve) -> _Comb:
    """Take the curvature at even parameters; a tooth stands on the outside of its bend."""
    chain = FormChain(curve.vertices[None])
    t = np.linspace(0.0, 4.0, 4 * _STEPS + 1)
    pace = chain.tangent(0, t)
    length = np.sqrt((pace * pace).sum(axis=1))
    with np.errstate(divide="ignore", invalid="ignore"):
        outward = np.column_stack([pace[:, 1], -pace[:, 0]]) / length[:, None]
        tooth = chain.bend(0, t)[:, None] * outward
    return _Comb(chain.at(0, t), np.where(np.isfinite(tooth), tooth, 0.0))


def _area(field: _Field, curve: FormCurve) -> None:
    """Tint the area under the curve."""
    points = FormChain(curve.vertices[None]).at(0, np.linspace(0.0, 4.0, 201))
    feet = np.column_stack([points[[-1, 0], 0], [0.0, 0.0]])
    x, y = field.at(np.concatenate([points, feet])).T
    field.chart.sheet.axes.fill(x, y, color=_AREA, linewidth=0.0, zorder=0.5, gid="area")


def _teeth(field: _Field, comb: _Comb) -> None:
    """Draw the comb, the longest teeth cut."""
    sheet, factor = field.chart.sheet, field.chart.sheet.paper.factor
    foot = field.at(comb.foot)
    tooth = comb.tooth * (_HIGH * factor / max(comb.usual, 1e-300))
    length = np.sqrt((tooth * tooth).sum(axis=1))
    most = _CUT * factor
    long = length > most
    tip = foot + tooth * np.where(long, most / np.where(long, length, 1.0), 1.0)[:, None]
    teeth = np.full((3 * len(foot), 2), np.nan)
    teeth[0::3], teeth[1::3] = foot, tip
    sheet.line(teeth, _TOOTH, "teeth")
    sheet.line(np.where(long[:, None], np.nan, tip), _TIPS, "tips")


def _vertices(field: _Field, curve: FormCurve) -> None:
    """Draw the polygon of the vertices, and name them."""
    sheet, factor = field.chart.sheet, field.chart.sheet.paper.factor
    places = field.at(curve.vertices)
    sheet.line(places, _POLYGON, "polygon")
    sheet.dots(places, _POLYGON.colour, 1.4, "vertices")
    for k, (x, y) in enumerate(places.tolist()):
        place = (x + 1.2 * factor, y + 1.2 * factor)
        text = sheet.text(place, f"P{k}", size=1.1, across="left", up="bottom", halo=True,
                          colour="0.3", name=f"label/P{k}")  # fmt: skip
        sheet.take(text)


def _inflections(curve: FormCurve) -> FloatArray:
    return np.array([curve.at(t) for t in curve.inflections]).reshape(-1, 2)


def _centroid(field: _Field, curve: FormCurve) -> None:
    """Mark the centroid of the area, if there is one."""
    found = np.array([[curve.centroid, curve.centroid_height]])
    if not np.isfinite(found).all():
        return
    sheet, factor = field.chart.sheet, field.chart.sheet.paper.factor
    place = field.at(found)
    sheet.dots(place, _CENTROID, 2.0, "centroid")
    at = (float(place[0, 0]) + 1.8 * factor, float(place[0, 1]))
    words = f"A {curve.area:.6g}, centroid {curve.centroid:.6g}"
    sheet.text(at, words, size=1.1, across="left", colour=_CENTROID, halo=True,
               name="label/centroid")  # fmt: skip


def _block(sheet: Sheet, curve: FormCurve, comb: _Comb, title: str) -> None:
    """Write the parameters, and what is to be said of the curve."""
    margin = MARGIN * sheet.paper.factor
    size = max(1.0, float(np.abs(curve.vertices).max()))
    p = {n: each if abs(each) > _NIL * size else 0.0 for n, each in curve.parameters.items()}
    rows = [("Start, finish", "")]
    rows += [
        (words, f"{p[f'start_{name}']:.8g},  {p[f'finish_{name}']:.8g}")
        for name, words in _NAMES.items()
    ]
    rows.append(("Area", f"{p['area']:.10g}"))
    name = "centroid" if "centroid" in p else "moment"
    rows.append((name.capitalize(), f"{p[name]:.10g}"))
    rows.append(("Length", f"{curve.length:.8g}"))
    rows.append(("E3", f"{curve.energy():.6g}"))
    tooth = f"Tooth of {_HIGH:g} mm at A3: curvature {comb.usual:.3g}."
    notes = [tooth, *_wrapped([str(each) for each in curve.messages], 74)]
    corner = (sheet.paper.width - margin, sheet.paper.height - margin)
    title_block(sheet, corner, BLOCK * sheet.paper.factor, title or "Form curve", rows, notes)


def _wrapped(texts: Sequence[str], width: int) -> list[str]:
    """Break texts into lines."""
    import textwrap

    return [line for text in texts for line in textwrap.wrap(text, width)]
