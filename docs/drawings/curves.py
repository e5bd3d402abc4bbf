"""Curves: the composite spline, and what the Series 60 table was completed with."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from assoc_hull.geometry.curves import CurveData
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.io.offsets.complete_table import centre_profile, end_contours, flat_of_bottom
from assoc_hull.shipped.series60 import todd_table
from drawings.common import DRIVEN, FAINT, FIXED, INK, PALE, SHARED, arrow, bare, curve, ship

__all__ = ["completions", "knuckle_end"]


def knuckle_end() -> Figure:
    """Draw the interval behind a knuckle with its vertices, and all three kinds of points."""
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(9.4, 3.9), width_ratios=(1.15, 1.0), layout="constrained"
    )
    _four_vertices(left)
    _three_kinds(right)
    return figure


def _four_vertices(axes: Axes) -> None:
    first, last = np.zeros(2), np.array([3.0, 1.0])
    along = np.array([np.cos(np.radians(40.0)), np.sin(np.radians(40.0))])
    reach = float(last @ along) / 3.0
    third = last - reach * along
    second = 0.5 * (first + third)
    polygon = np.array([first, second, third, last])
    t = np.linspace(0.0, 1.0, 60)[:, None]
    bezier = (
        (1 - t) ** 3 * first
        + 3 * t * (1 - t) ** 2 * second
        + 3 * t * t * (1 - t) * third
        + t**3 * last
    )
    axes.plot(*polygon.T, "o--", color=DRIVEN, linewidth=1.0, markersize=5)
    axes.plot(*bezier.T, color=SHARED, linewidth=2.0)
    arrow(axes, last, last + 0.75 * along, color=INK)
    words = (
        (first, (-0.1, 0.3), "$V_1=P_k$, the knuckle", "left"),
        (second, (0.0, -0.2), r"$V_2=\frac{1}{2}(V_1+V_3)$", "left"),
        (third, (0.02, -0.2), r"$V_3=V_4-\lambda\,e$", "left"),
        (last, (-0.1, 0.12), r"$V_4=P_j$", "right"),
        (last + 0.75 * along, (0.05, 0.0), r"$e$", "left"),
    )
    for place, shift, text, side in words:
        axes.text(*(place + shift), text, ha=side, color=INK)
    axes.set(xlim=(-0.2, 4.0), ylim=(-0.55, 1.8), title="the interval behind a knuckle")
    axes.set_aspect("equal")
    bare(axes)


def _three_kinds(axes: Axes) -> None:
    points = np.array(
        [[0, 0], [5.0, 0], [6.7, 0.5], [7.5, 1.9], [7.7, 3.6], [7.7, 6.0], [7.2, 7.4], [7.4, 9.2]]
    )
    xyz = np.column_stack([np.zeros(len(points)), points])
    kind = np.array([0, 1, 0, 0, 1, 1, 2, 0])
    direction = np.zeros((len(points), 3))
    direction[1] = (0, 1, 0)
    direction[[4, 5]] = (0, 0, 1)
    spline = loft(CurveData.single(xyz, kind, direction))
    axes.plot(*sample(spline, 20)[1][:, 1:].T, color=SHARED, linewidth=2.0)
    style = {0: ("o", SHARED, "smooth"), 1: ("s", FIXED, "tangent"), 2: ("D", DRIVEN, "knuckle")}
    for code, (mark, color, name) in style.items():
        chosen = kind == code
        axes.plot(*points[chosen].T, mark, color=color, markersize=6, linestyle="", label=name)
    axes.legend(loc="center left", frameon=False)
    axes.set(
        xlabel="y (m)",
        ylabel="z (m)",
        xlim=(-0.3, 8.6),
        ylim=(-0.4, 9.6),
        title="three kinds of points",
    )
    axes.set_aspect("equal")


def completions() -> Figure:
    """Draw what the Series 60 table leaves open, and what it was completed with."""
    table = todd_table(0.70)[0]
    stern, stem = end_contours(table)
    profile = curve(ship(), "profile")
    side, bottom = ship()["flat of side"].curves[0], flat_of_bottom(table)
    marks = np.array([point.position for point in side.defining])
    points = centre_profile(table)[0]
    figure, (above, below) = plt.subplots(
        2, 1, figsize=(9.4, 5.4), layout="constrained", height_ratios=(1.25, 1)
    )
    above.plot(profile[:, 0], profile[:, 2], color=INK, linewidth=1.6, label="centre-line profile")
    above.plot(
        stern, table.z, "o", color=DRIVEN, markersize=4.5, label="waterline ends found or assumed"
    )
    above.plot(stem, table.z, "o", color=DRIVEN, markersize=4.5)
    above.plot(*side.polyline(8)[:, [0, 2]].T, color=FIXED, linewidth=1.2)
    above.plot(
        marks[:, 0],
        marks[:, 2],
        ".-",
        color=FIXED,
        linewidth=0.0,
        label="border of the flat of side",
    )
    above.axhline(table.draught, color=SHARED, linewidth=0.8, linestyle="--")
    above.text(25.0, table.draught + 0.15, "T", color=SHARED)
    above.plot(points[[0, -1], 0], points[[0, -1], 2], color=PALE, linewidth=1.2, zorder=0)
    above.text(61.0, points[0, 2] + 0.25, "deck edge, level at 1.5 T", color=PALE, ha="center")
    above.set(ylabel="z (m)", ylim=(-0.6, 12.2), xlim=(-7, 127))
    for x in table.x.tolist():
        below.axvline(x, color=FAINT, linewidth=0.6, zorder=0)
    deck = curve(ship(), "deck edge")
    below.plot(deck[:, 0], deck[:, 1], color=PALE, linewidth=1.2, label="deck edge")
    below.plot(
        bottom[:, 0],
        bottom[:, 1],
        ".-",
        color=SHARED,
        linewidth=1.2,
        label="border of the flat of bottom (WL 0)",
    )
    below.set(
        xlabel="x (m, from AP); thin lines: the stations of the table",
        ylabel="y (m)",
        xlim=(-7, 127),
        ylim=(-0.4, 9.4),
    )
    above.legend(loc="lower right", bbox_to_anchor=(0.94, 0.12), frameon=False, fontsize=9)
    below.legend(loc="center", bbox_to_anchor=(0.52, 0.3), frameon=False, fontsize=9)
    return figure
