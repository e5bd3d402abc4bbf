"""Arcs for production: a waterline with its arcs, their joints, its comb and theirs."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from drawings.common import DRIVEN, INK, PALE, SHARED, Floats, ship

__all__ = ["production_arcs_picture"]

_NAME = "WL 1"
_WITHIN = 0.002


def production_arcs_picture() -> Figure:
    """Draw the waterline of Series 60 at the draught: the bow to scale, curvature along it."""
    hull = ship()
    line = hull.production_arcs(_NAME, _WITHIN).lines[0]
    spline = hull.lines[_NAME].curves[0]
    t = np.linspace(0.0, spline.span, 4000)
    figure, axes = plt.subplots(2, 1, figsize=(9.6, 5.0), layout="constrained")
    _plan(axes[0], line.arcs, spline.at(t)[:, :2])
    _curvature(axes[1], line.arcs, spline.at(t), spline.curvature(t), spline.tangent(t))
    return figure


def _plan(axes: Axes, arcs: PlaneArcs, places: Floats) -> None:
    axes.plot(*places.T, color=PALE, linewidth=6)
    for arc in range(len(arcs)):
        t = np.linspace(0.0, float(arcs.length[arc]), 40)
        color = SHARED if arcs.curvature[arc] == 0.0 else (INK, DRIVEN)[arc % 2]
        axes.plot(*arcs.at(np.full(40, arc), t).T, color=color, linewidth=1.8)
    axes.plot(*arcs.start.T, "o", color=INK, markersize=3.5)
    axes.set_aspect("equal")
    axes.set_ylim(-0.5, 9.8)
    axes.set_ylabel("y (m)")
    axes.set_title(
        f"{_NAME} of Series 60, within {1e3 * _WITHIN:g} mm: {len(arcs)} arcs and lines",
        fontsize=10,
    )


def _curvature(axes: Axes, arcs: PlaneArcs, places: Floats, bend: Floats, tangent: Floats) -> None:
    signed = tangent[:, 0] * bend[:, 1] - tangent[:, 1] * bend[:, 0]
    axes.plot(places[:, 0], signed, color=PALE, linewidth=3, label="of the line")
    ends = np.concatenate([arcs.start, arcs.ends()[-1:]])[:, 0]
    axes.stairs(
        arcs.curvature, ends, baseline=None, color=DRIVEN, linewidth=1.6, label="of the arcs"
    )
    axes.set_ylim(-0.03, 0.025)
    axes.set_xlabel("x (m)")
    axes.set_ylabel("curvature (1/m)")
    axes.legend(frameon=False, fontsize=8, loc="upper center")
