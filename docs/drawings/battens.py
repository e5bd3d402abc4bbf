"""The classical splines through the same points, and their curvature."""

from itertools import pairwise

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.interpolate import CubicSpline

from assoc_hull.geometry.classical.chord_spline import ChordSpline
from assoc_hull.geometry.classical.elastica import Elastica, fit_elastica
from drawings.common import DRIVEN, FIXED, INK, PALE, SHARED

__all__ = ["classical_splines"]

POINTS = np.array([(0.0, 0.0), (3.4, 0.1), (4.9, 1.0), (5.2, 2.6), (5.3, 5.0)])


def classical_splines() -> Figure:
    """Draw a bilge through five points by three splines, and the curvature of each."""
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(9.4, 4.4), width_ratios=(1.15, 1.0), layout="constrained"
    )
    batten = ChordSpline.through(POINTS)
    graph = CubicSpline(*POINTS.T, bc_type="natural")
    rods = _rods(batten)
    _shapes(left, batten, graph, rods)
    _curvatures(right, batten, rods)
    return figure


def _rods(batten: ChordSpline) -> list[Elastica]:
    """Elastica from point to point, in the directions of the batten."""
    found = []
    for i, (one, two) in enumerate(pairwise(POINTS)):
        chord = np.arctan2(*(two - one)[::-1])
        found.append(fit_elastica(one, two, *(batten.angles[i : i + 2] - chord)))
    return found


def _shapes(axes: Axes, batten: ChordSpline, graph: CubicSpline, rods: list[Elastica]) -> None:
    x = np.linspace(POINTS[0, 0], POINTS[-1, 0], 1500)
    axes.plot(x, graph(x), color=PALE, linewidth=1.6, label="y(x), or truncated powers")
    axes.plot(
        *batten.at(np.linspace(0.0, batten.knots[-1], 400)).T, color=SHARED, linewidth=2.0,
        label="mechanical spline",
    )  # fmt: skip
    for i, rod in enumerate(rods):
        places = rod.at(np.linspace(0.0, rod.length, 40))
        axes.plot(
            *places.T, color=DRIVEN, linewidth=1.2, linestyle=(0, (4, 3)),
            label=None if i else "elastica of free length",
        )  # fmt: skip
    axes.plot(*POINTS.T, "o", color=INK, markersize=4)
    axes.set(xlim=(-0.3, 6.0), ylim=(-1.1, 5.5), xlabel="half-breadth, m", ylabel="height, m")
    axes.set_aspect("equal")
    axes.legend(frameon=False, loc="upper left", fontsize=8)


def _curvatures(axes: Axes, batten: ChordSpline, rods: list[Elastica]) -> None:
    rough = ChordSpline.through(POINTS, mode="moment")
    for spline, colour, label in (
        (rough, FIXED, "mechanical, moments continuous"),
        (batten, SHARED, "mechanical, curvature continuous"),
    ):
        s = 0.0
        for i, (low, high) in enumerate(pairwise(spline.knots)):
            t = np.linspace(low + 1e-9, high - 1e-9, 60)
            size = np.hypot(*np.diff(spline.at(t), axis=0).T)
            along = s + np.concatenate([[0.0], np.cumsum(size)])
            axes.plot(
                along, spline.curvature(t), color=colour, linewidth=1.6,
                label=None if i else label,
            )  # fmt: skip
            s = along[-1]
    s = 0.0
    for i, rod in enumerate(rods):
        along = np.linspace(0.0, rod.length, 60)
        axes.plot(
            s + along, rod.curvature(along), color=DRIVEN, linewidth=1.2, linestyle=(0, (4, 3)),
            label=None if i else "elastica, tangents continuous",
        )  # fmt: skip
        s += rod.length
    axes.axhline(0.0, color=INK, linewidth=0.5)
    axes.set(xlabel="along the curve, m", ylabel="curvature, 1/m")
    axes.set_ylim(top=1.05)
    axes.legend(frameon=False, loc="upper right", fontsize=8)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
