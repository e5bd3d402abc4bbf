"""Biarcs: one bend, an inflection, what stands in for a rule, a chain."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from assoc_hull.geometry.classical.biarc_chain import biarc_chain
from assoc_hull.geometry.classical.biarcs import BiarcRule, Biarcs, biarcs, free_biarcs
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from drawings.common import DRIVEN, FIXED, INK, PALE, SHARED, WATCHED, Floats, arrow, bare

__all__ = ["biarc_kinds"]


def biarc_kinds() -> Figure:
    """Draw four pictures: C, S, fallback and least radius, a chain with its comb."""
    figure, axes = plt.subplots(
        2, 2, figsize=(9.6, 5.2), height_ratios=(1.0, 1.25), layout="constrained"
    )
    _one_bend(axes[0, 0])
    _inflection(axes[0, 1])
    _fallback(axes[1, 0])
    _chain(axes[1, 1])
    return figure


def _over_ten(alpha: float, beta: float, rule: BiarcRule = "inverse", least: float = 0.0) -> Biarcs:
    one, two = np.radians([alpha]), np.radians([beta])
    return biarcs([[0, 0]], one, [[10, 0]], two, rule=rule, least_radius=least)


def _places(arcs: PlaneArcs, arc: int) -> Floats:
    t = np.linspace(0.0, float(arcs.length[arc]), 80)
    return arcs.at(np.full(len(t), arc), t)


def _draw(axes: Axes, found: Biarcs, color: str, text: str, width: float = 2.2) -> None:
    for arc in (0, 1):
        style = "-" if arc == 0 else (0, (5, 1))
        line = axes.plot(*_places(found.arcs, arc).T, color=color, linewidth=width, linestyle=style)
        if arc == 0:
            line[0].set_label(text)
    axes.plot(*found.joins[0], "o", color=color, markersize=5, zorder=5)


def _ends(axes: Axes, alpha: float, beta: float) -> None:
    axes.plot([0, 10], [0, 0], color=PALE, linewidth=0.8)
    axes.plot([0, 10], [0, 0], "s", color=INK, markersize=4, zorder=6)
    for x, angle in ((0.0, alpha), (10.0, beta)):
        way = 1.8 * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
        arrow(axes, np.array([x, 0.0]), np.array([x, 0.0]) + way, color=INK)


def _finish(axes: Axes, title: str, columns: int) -> None:
    axes.set_title(title, fontsize=10)
    axes.legend(
        frameon=False, fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.02), ncols=columns
    )
    axes.set_aspect("equal")
    axes.margins(0.04, 0.06)
    bare(axes)


def _one_bend(axes: Axes) -> None:
    _ends(axes, 60.0, -30.0)
    one, two = np.radians([60.0]), np.radians([-30.0])
    shares = np.linspace(0.02, 0.64, 60)
    many = len(shares)
    joins = free_biarcs(
        np.zeros((many, 2)), np.repeat(one, many), np.tile([10.0, 0.0], (many, 1)),
        np.repeat(two, many), shares,
    ).joins  # fmt: skip
    axes.plot(*joins.T, ":", color=WATCHED, linewidth=1.4, label="all joins")
    _draw(axes, _over_ten(60.0, -30.0), SHARED, "$R_1-R_2$ stationary")
    _draw(axes, _over_ten(60.0, -30.0, "equal_chord"), DRIVEN, "equal chords", 1.3)
    _finish(axes, "one bend (C): 60 and 30 degrees", 3)


def _inflection(axes: Axes) -> None:
    _ends(axes, 40.0, 20.0)
    for rule, color, text in (
        ("inverse", SHARED, "inverse to the angles"),
        ("as_printed", DRIVEN, "as printed"),
        ("min_jump", FIXED, "least jump"),
    ):
        _draw(axes, _over_ten(40.0, 20.0, rule), color, text, 1.6)  # type: ignore[arg-type]
    _finish(axes, "an inflection (S): 40 and 20 degrees", 3)


def _fallback(axes: Axes) -> None:
    _ends(axes, 60.0, -15.0)
    _draw(axes, _over_ten(60.0, -15.0), SHARED, "no least radius: equal chords")
    _draw(axes, _over_ten(60.0, -15.0, least=1.0), DRIVEN, "least radius 1", 1.4)
    _finish(axes, "one angle four times the other", 2)


def _chain(axes: Axes) -> None:
    points = [[0, 0], [1, 0.8], [2.5, 1.5], [4, 1.7], [6, 1.2], [7.5, 0.9], [9, 1.6]]
    chain = biarc_chain(points)
    s = np.linspace(0.0, chain.length, 160)
    at, way = chain.at(s), chain.direction(s)
    ends = np.cumsum(chain.arcs.length)
    bend = chain.arcs.curvature[np.minimum(np.searchsorted(ends, s), len(ends) - 1)]
    normal = np.stack([-np.sin(way), np.cos(way)], axis=1)
    comb = at - 2.2 * bend[:, None] * normal
    for place, tip in zip(at, comb, strict=True):
        axes.plot(*np.stack([place, tip]).T, color=PALE, linewidth=0.5)
    axes.plot(*comb.T, color=PALE, linewidth=0.8, label="curvature: it jumps")
    for arc in range(len(chain.arcs)):
        color = SHARED if arc % 2 == 0 else DRIVEN
        axes.plot(*_places(chain.arcs, arc).T, color=color, linewidth=2.2)
    axes.plot(*chain.biarcs.joins.T, "o", color=DRIVEN, markersize=4, label="joins")
    axes.plot(*chain.points.T, "s", color=INK, markersize=4, zorder=6, label="points")
    _finish(axes, "a chain through seven points", 3)
