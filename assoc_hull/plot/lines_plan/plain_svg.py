"""Three views of the lines as plain SVG, for a notebook: without matplotlib, in milliseconds.

Cubic segments of the curves are Bezier curves of SVG as they are, so nothing is sampled. What a
view shows as a straight line on the grid (a section in the profile) is left out of it.

Examples
--------
>>> from assoc_hull.plot.lines_plan.plain_svg import plain_svg
>>> from assoc_hull.shipped.wigley import wigley
>>> plain_svg(wigley())[:22]
'<svg viewBox="0 0 9600'
"""

from __future__ import annotations

from xml.sax.saxutils import escape

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, IntArray, SplineBatch
from assoc_hull.geometry.splines.segments import segment_start
from assoc_hull.model.tables import HullState

__all__ = ["plain_svg"]

_WIDTH, _MARGIN, _GAP = 9600.0, 120.0, 260.0
"""Units of the picture, whole ones of which are written: its width, what stays free around it, and
between two views."""

_COLOURS = {
    "boundary": "#7a7f87", "sections": "#2f7fd1", "waterlines": "#2a9d8f", "buttocks": "#c0702b",
    "diagonals": "#9467bd", "frames": "#2f7fd1",
}  # fmt: skip
"""They are seen on light and on dark ground."""

_LEVEL = 1e-9
"""m: what leads no farther along an axis is a line of the grid, or a point."""

_BODY = 0.3
"""Part of the width that the body plan has: it is drawn larger than the other two."""

_ACROSS, _ALONG, _UP = 1, 0, 2


@attrs.frozen
class _View:
    """A view: which axes go to the right and up, and where its origin lies on paper."""

    right: int
    up: int
    x: float
    y: float
    scale: float

    def points(self, xyz: FloatArray, mirror: FloatArray) -> FloatArray:
        """Give places on paper, (..., 2); `mirror` (...) is -1 where the first axis is turned."""
        right = self.x + self.scale * mirror * xyz[..., self.right]
        return np.stack([right, self.y - self.scale * xyz[..., self.up]], axis=-1)


def plain_svg(state: HullState) -> str:
    """Draw profile and half-breadth plan of a hull on one scale, and the body plan larger beside.

    The bow is to the right, the aft body on the left of the body plan.

    Parameters
    ----------
    state : HullState
        A published hull. Its name becomes the title that screen readers tell.

    Returns
    -------
    str
        The picture; colours tell the groups of lines.
    """
    curves = [each for each in state.live("curves").tolist() if state.curves.spline.data[each]]
    if not curves:
        return f'<svg viewBox="0 0 {_WIDTH:g} 400" role="img"></svg>'
    families = [state.family(state.line_of(each)).name for each in curves]
    splines = [state.spline(each) for each in curves]
    places = np.concatenate([each.xyz for each in splines])
    low, high = places.min(axis=0), places.max(axis=0)
    views, height = _laid_out(low, high)
    middle = 0.5 * state.particulars.length
    parts = list[str]()
    for family, colour in _COLOURS.items():
        mine = [one for one, other in zip(splines, families, strict=True) if other == family]
        whole = family == "boundary"
        drawn = "".join(_path(view, each, middle, whole) for each in mine for view in views)
        if drawn:
            parts.append(f'<path stroke="{colour}" d="{drawn}"/>')
    name = escape(state.particulars.name)
    return (
        f'<svg viewBox="0 0 {_WIDTH:g} {height:.0f}" role="img" fill="none" '
        f'style="max-width:100%;height:auto" xmlns="http://www.w3.org/2000/svg">'
        f"<title>{name}: profile, body plan and half-breadth plan</title>"
        f'<g stroke-width="10" stroke-linejoin="round">{"".join(parts)}</g></svg>'
    )


def _laid_out(low: FloatArray, high: FloatArray) -> tuple[tuple[_View, ...], float]:
    """Put the views on paper: the profile above the half-breadth plan, the body plan beside."""
    length, breadth, depth = high[_ALONG] - low[_ALONG], high[_ACROSS], high[_UP] - low[_UP]
    body = _BODY * (_WIDTH - 2.0 * _MARGIN - _GAP)
    large = body / (2.0 * breadth)
    small = (_WIDTH - 2.0 * _MARGIN - _GAP - body) / length
    tall = max(large * depth, small * (depth + breadth) + _GAP)
    left = _MARGIN - small * low[_ALONG]
    views = (
        _View(_ALONG, _UP, left, _MARGIN + small * high[_UP], small),
        _View(_ALONG, _ACROSS, left, _MARGIN + small * (depth + breadth) + _GAP, small),
        _View(
            _ACROSS, _UP, _WIDTH - _MARGIN - 0.5 * body,
            _MARGIN + 0.5 * (tall - large * depth) + large * high[_UP], large,
        ),
    )  # fmt: skip
    return views, float(tall + 2.0 * _MARGIN)


def _path(view: _View, spline: SplineBatch, middle: float, whole: bool) -> str:
    """Give the path of a curve in a view; none of a line of the grid, unless it is `whole`."""
    level = np.ptp(spline.xyz[:, [view.right, view.up]], axis=0) < _LEVEL
    if level.all() or (level.any() and not whole):
        return ""
    first = segment_start(spline)
    last = first + 1
    third = (spline.knot[last] - spline.knot[first])[:, None] / 3.0
    control = np.stack(
        [
            spline.xyz[first],
            spline.xyz[first] + third * spline.leave[first],
            spline.xyz[last] - third * spline.arrive[last],
            spline.xyz[last],
        ],
        axis=1,
    )
    # The aft body stands on the left of the body plan.
    aft = (view.right == _ACROSS) & (control[:, :, _ALONG].mean(axis=1) < middle)
    mirror = np.where(aft, -1.0, 1.0)[:, None]
    placed = np.rint(view.points(control, mirror)).astype(np.int64)
    runs = np.split(placed, np.flatnonzero(np.diff(aft)) + 1)
    return "".join(map(_run, runs))


def _run(placed: IntArray) -> str:
    """Write segments (s, 4, 2) that follow one another, by steps from where each begins."""
    begin, steps = placed[0, 0].tolist(), (placed[:, 1:] - placed[:, :1]).reshape(-1).tolist()
    return f"M{begin[0]} {begin[1]}c" + " ".join(map(str, steps))
