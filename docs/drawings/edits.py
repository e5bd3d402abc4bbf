"""Edits: what a pull moves, and a drag beside a pull."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

import assoc_hull as ah
from drawings.common import ACCENT, DRIVEN, FAINT, INK, PALE, SHARED, Floats, curve, ship

__all__ = ["pinned_or_field", "pull"]


def pull() -> Figure:
    """Draw body plan and half-breadth plan of the fore body before and after a pull of 200 mm."""
    hull = ship()
    fore = [f"ST {number:g}" for number in (12, 13, 14, 15, 16, 17, 18, 18.5, 19, 19.5, 20)]
    water = [f"WL {part:g}" for part in (0.075, 0.25, 0.5, 0.75, 1.0, 1.25)]
    before = {name: curve(hull, name) for name in (*fore, *water)}
    with hull.edit("pull") as edit:
        edit.pull("WL 0.75 x ST 17", d=0.2, radius=(20.0, 5.0))
    after = {name: curve(hull, name) for name in before}
    place = hull["WL 0.75 x ST 17"].position
    hull.undo()
    figure, (body, plan) = plt.subplots(
        1, 2, figsize=(9.4, 4.7), width_ratios=(1.0, 1.35), layout="constrained"
    )
    _tinted(body, before, after, fore, (1, 2))
    _tinted(plan, before, after, water, (0, 1))
    body.plot(place[1], place[2], "o", color=ACCENT, markersize=5)
    plan.plot(place[0], place[1], "o", color=ACCENT, markersize=5)
    body.set_aspect("equal")
    body.set(
        xlabel="y (m)", ylabel="z (m)", title="fore body, sections", xlim=(0, 9), ylim=(0, 10.6)
    )
    plan.set(
        xlabel="x (m)",
        ylabel="y (m)",
        title="half-breadth plan, six waterlines",
        xlim=(82, 124),
        ylim=(0, 9),
    )
    handles = [
        Line2D([], [], color=ACCENT, label="moved by more than 1 mm, after"),
        Line2D([], [], color=PALE, label="before, and what did not move"),
        Line2D([], [], color=ACCENT, marker="o", linestyle="", label="the point that was pulled"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False)
    return figure


def _tinted(
    axes: Axes,
    before: dict[str, Floats],
    after: dict[str, Floats],
    names: list[str],
    view: tuple[int, int],
) -> None:
    for name in names:
        old, new = before[name], after[name]
        axes.plot(*old[:, view].T, color=PALE, linewidth=0.7, zorder=1)
        if len(old) != len(new):
            axes.plot(*new[:, view].T, color=ACCENT, linewidth=1.2, zorder=2)
            continue
        gone = np.sqrt(((new - old) ** 2).sum(axis=1))
        part = np.where((gone > 1e-3)[:, None], new[:, view], np.nan)
        axes.plot(*part.T, color=ACCENT, linewidth=1.2, zorder=2)


def pinned_or_field() -> Figure:
    """Draw 20 mm at one point, as a drag and as a pull, along a waterline and a section."""
    hull = ship()
    point = "WL 0.5 x ST 16"
    here = hull.find(point).position
    xs, zs = np.linspace(75.0, 120.0, 451), np.linspace(0.2, 10.0, 246)
    ground, share = _breadths(hull, xs, zs), _normal_share(hull, point)
    shapes: list[tuple[str, str, tuple[Floats, Floats]]] = []
    for title, color in (("drag (pinned)", DRIVEN), ("pull, radii 20 m and 8 m (field)", SHARED)):
        with hull.edit(title) as edit:
            if title.startswith("drag"):
                edit.move(point, y=float(here[1]) + 0.02)
            else:
                edit.pull(point, d=0.02 * share, radius=(20.0, 8.0))
        shapes.append((title, color, _breadths(hull, xs, zs)))
        hull.undo()
    figure, (left, right) = plt.subplots(
        1, 2, figsize=(9.4, 3.6), width_ratios=(1.6, 1.0), layout="constrained"
    )
    for title, color, (along, girth) in shapes:
        left.plot(xs, 1e3 * (along - ground[0]), color=color, label=title)
        right.plot(1e3 * (girth - ground[1]), zs, color=color)
    left.set(xlabel="x along WL 0.5 (m)", ylabel="change of half-breadth (mm)", ylim=(-5, 25))
    right.set(xlabel="change of half-breadth (mm)", ylabel="z on ST 16 (m)", xlim=(-5, 25))
    for axes in (left, right):
        axes.grid(color=FAINT, linewidth=0.6)
    left.plot(here[0], 20.0, "o", color=INK, markersize=4)
    right.plot(20.0, here[2], "o", color=INK, markersize=4)
    figure.legend(loc="outside lower center", ncols=2, frameon=False)
    return figure


def _normal_share(hull: ah.Hull, point: str) -> float:
    """How much of a metre in y is normal displacement at a point: a pull by it moves y by 1 m."""
    start = hull.find(point).position[1]
    with hull.edit("try") as edit:
        edit.pull(point, d=0.02, radius=(20.0, 8.0))
    gone = hull.find(point).position[1] - start
    hull.undo()
    return float(0.02 / gone)


def _breadths(hull: ah.Hull, xs: Floats, zs: Floats) -> tuple[Floats, Floats]:
    """Half-breadths of WL 0.5 at xs and of ST 16 at zs, m."""
    water, section = hull["WL 0.5"], hull["ST 16"]
    along = [water.meet(((1.0, 0.0, 0.0), x))[0, 1] for x in xs.tolist()]
    girth = [section.meet(((0.0, 0.0, 1.0), z))[0, 1] for z in zs.tolist()]
    return np.array(along), np.array(girth)
