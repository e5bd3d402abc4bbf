"""Cross curves of stability: KN over the displacement, a curve for each heel."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.analysis.stability.cross_curves import CrossCurves
from assoc_hull.arguments import instance
from assoc_hull.errors import BadInputError
from assoc_hull.plot.sheet.chart import block_of, chart_on, levels, scale_to, smooth, uprights
from assoc_hull.plot.sheet.labels import Lettered, label_above, label_lines
from assoc_hull.plot.sheet.paper import PaperName, Pen
from assoc_hull.plot.sheet.sheet import Path_, Sheet, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

__all__ = ["cross_curve_picture"]

_WHERE = "in a picture of cross curves"
_COLOURS = ("#0b3c6f", "#c8102e", "#0a7d55", "#7a3b9a", "#a8570f", "#2a7f9e")


def cross_curve_picture(
    found: CrossCurves, path: Path_ | None = None, *, paper: PaperName = "A3"
) -> Figure:
    """Draw KN over the displacement, a curve for each heel.

    Parameters
    ----------
    found : CrossCurves
        Two displacements or more.
    path : path, optional
        Where to write it; the ending says whether PDF, SVG or PNG.
    paper : "A3", "A1" or "A4"
        Size of the sheet, landscape.

    Raises
    ------
    BadInputError
        A single displacement, an unknown paper or ending.
    MissingExtraError
        Matplotlib is not installed.
    """
    instance(found, CrossCurves, "found", _WHERE)
    if len(found.conditions) < 2 or not np.isfinite(found.kn).any():
        what = f"{len(found.conditions)} displacement(s)"
        raise BadInputError(what, _WHERE, "give two or more at which she floats heeled")
    sheet = Sheet(paper)
    chart, weight = chart_on(sheet, 14.0), found.displacement
    along = scale_to(float(weight[0]), float(weight[-1]), chart.left, chart.wide, 14, whole=False)
    low, high = float(np.nanmin(found.kn)), float(np.nanmax(found.kn))
    up = scale_to(min(low, 0.0), max(high, 1e-3), chart.low, chart.tall, 20)
    levels(chart, up, "KN, m")
    uprights(chart, along, "displacement, t")
    chart.border()
    lines = []
    for k, (heel, kn) in enumerate(zip(found.heel_deg.tolist(), found.kn.T, strict=True)):
        known = np.isfinite(kn)
        if known.sum() < 2:
            continue
        course = smooth(weight[known], kn[known])
        points = np.column_stack([along.at(course[:, 0]), up.at(course[:, 1])])
        sheet.line(points, Pen(0.3, _COLOURS[k % len(_COLOURS)], over=3.0), f"curve/{heel:g}")
        lines.append(Lettered(f"{heel:g}°", points, f"{heel:g}°"))
    block_of(sheet, found, "CROSS CURVES OF STABILITY", _rows(found))
    edge = 4.0 * sheet.paper.factor
    ends = chart.left + edge, chart.right - edge
    written = label_lines(sheet, lines, *ends, axis=0, name="label/curve")
    missing = {line.label for line in lines} - written
    label_above(sheet, lines, missing, chart.top + 1.0 * sheet.paper.factor, "label/curve")
    if path is not None:
        save(sheet.figure, path)
    return sheet.figure


def _rows(found: CrossCurves) -> list[tuple[str, str]]:
    draughts = found.draught
    trim = found.conditions[0].upright.trim_by_stern + 0.0
    kg = found.header.kg
    rows = [
        ("Trim as she heels", found.trim),
        ("Trim upright, + by the stern", f"{trim:.3f} m"),
        ("Mean draughts upright", f"{draughts[0]:.3f} to {draughts[-1]:.3f} m"),
        ("Curves", "KN for heels in degrees"),
        ("GZ at no trim", "KN - KG sin(heel)"),
    ]
    if found.trim == "free":
        high = "that of the centre of buoyancy" if kg is None else f"{kg:g} m"
        rows.append(("KG for the trim", high))
    return rows
