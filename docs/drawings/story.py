"""The acceptance story: shaft raised and bossing widened on the bulk carrier, before and after."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

import assoc_hull as ah
from drawings.common import ACCENT, FAINT, INK, PALE, SHARED, Floats

__all__ = ["bossing_lines", "bossing_profile"]

_ASKED = {"shaft_height": 6.0, "bossing_radius": 1.0}
_BUTTOCKS = {"BTK 0.5": SHARED, "BTK 1": ACCENT}
_SECTIONS = ("ST 0.5", "ST 0.62", "ST 0.75", "ST 1", "ST 1.25", "ST 1.5", "ST 2")
_WATER = ("WL 4", "WL 5", "WL 6", "WL 7", "WL 8")
_MADE: list[tuple[ah.Hull, ah.Hull]] = []


def _hulls() -> tuple[ah.Hull, ah.Hull]:
    """Give parent and variant, made once."""
    if not _MADE:
        parent = ah.examples.bulk_carrier_207k()
        _MADE.append((parent, parent.vary(set=_ASKED, fair=True).hull))
    return _MADE[0]


def _parts(hull: ah.Hull, name: str) -> list[Floats]:
    return [np.array(curve.polyline(24)) for curve in hull.lines[name].curves]


def bossing_profile() -> Figure:
    """Draw the stern in profile: what is the buttock at 1.0 m to the bossing, and what was it."""
    parent, variant = _hulls()
    figure, both = plt.subplots(
        1, 2, figsize=(9.4, 4.4), sharex=True, sharey=True, layout="constrained"
    )
    for axes, hull, title in zip(
        both, (parent, variant), ("parent: shaft 5.0 m, radius 0.725 m",
                                  "variant: shaft 6.0 m, radius 1.0 m"), strict=True
    ):  # fmt: skip
        _profile(axes, hull, parent)
        axes.set(xlabel="x (m)", title=title, xlim=(2.0, 20.0), ylim=(0.0, 12.6))
        axes.title.set_fontsize(10)
        axes.set_aspect("equal")
    both[0].set_ylabel("z (m)")
    _note(both[0], "the 1.0 m buttock turns\nforward of the bossing", _nose(parent), (1.3, 0.6))
    _note(both[1], "it meets the circle\nin a knuckle", np.array([6.0, 6.0]), (-3.6, -3.2))
    handles = [
        Line2D([], [], color=INK, linewidth=1.6, label="profile and end of the bossing"),
        *(
            Line2D([], [], color=color, label=f"buttock {name.split()[1]} m")
            for name, color in _BUTTOCKS.items()
        ),
        Line2D([], [], color=PALE, linewidth=0.8, linestyle="--", label="parent"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, frameon=False)
    return figure


def _profile(axes: Axes, hull: ah.Hull, parent: ah.Hull) -> None:
    """Draw profile, bossing and two buttocks of a hull; behind them those of the parent."""
    for name in ("profile", "bossing end", *_BUTTOCKS):
        wide = 1.3 if name in _BUTTOCKS else 1.6
        for part in _parts(hull, name):
            axes.plot(part[:, 0], part[:, 2], color=_BUTTOCKS.get(name, INK), linewidth=wide)
        for part in _parts(parent, name) if hull is not parent else []:
            axes.plot(part[:, 0], part[:, 2], color=PALE, linewidth=0.8, linestyle="--", zorder=1)
    centre = float(np.mean(_parts(hull, "bossing end")[0][[0, -1], 2]))
    axes.plot([2.0, 10.0], [centre, centre], color=INK, linewidth=0.6, linestyle=(0, (9, 3, 2, 3)))
    axes.annotate(
        "shaft", (2.2, centre), color=INK, fontsize=8, xytext=(0, 3), textcoords="offset points"
    )
    for z in range(1, 13):
        axes.axhline(z, color=FAINT, linewidth=0.5, zorder=0)


def _nose(hull: ah.Hull) -> Floats:
    """Give the aftmost place of the lower part of the 1.0 m buttock, x and z, m."""
    places = np.concatenate(_parts(hull, "BTK 1"))
    low = places[(places[:, 2] < 7.0) & (places[:, 0] < 30.0)]
    found: Floats = low[int(low[:, 0].argmin())][[0, 2]]
    return found


def _note(axes: Axes, text: str, place: Floats, away: tuple[float, float]) -> None:
    axes.annotate(
        text, place, (place[0] + away[0], place[1] + away[1]), color=INK, fontsize=9, va="center",
        arrowprops={"arrowstyle": "-|>", "color": INK, "linewidth": 0.9, "shrinkB": 3},
    )  # fmt: skip


def bossing_lines() -> Figure:
    """Draw the sections and waterlines at the bossing, as they were and as they are."""
    hulls = _hulls()
    figure, (body, plan) = plt.subplots(
        1, 2, figsize=(9.4, 5.2), width_ratios=(1.0, 1.55), layout="constrained"
    )
    for hull, color, wide in zip(hulls, (PALE, ACCENT), (0.8, 1.3), strict=True):
        for name in _SECTIONS:
            for part in _parts(hull, name):
                body.plot(part[:, 1], part[:, 2], color=color, linewidth=wide)
        for name in _WATER:
            for part in _parts(hull, name):
                plan.plot(part[:, 0], part[:, 1], color=color, linewidth=wide)
        circle = _parts(hull, "bossing end")[0]
        edge = INK if color == ACCENT else PALE
        body.plot(circle[:, 1], circle[:, 2], color=edge, linewidth=2.0 * wide)
        widest = float(circle[:, 1].max())
        plan.plot([6.0, 6.0], [0.0, widest], color=edge, linewidth=2.0 * wide)
    _label(body, hulls[1], _SECTIONS[3:], (1, 2), (1, 7.4))
    _label(plan, hulls[1], _WATER, (0, 1), (0, 24.0))
    body.set_aspect("equal")
    body.set(xlabel="y (m)", ylabel="z (m)", title="sections", xlim=(0, 7.4), ylim=(0, 12.6))
    plan.set(xlabel="x (m)", ylabel="y (m)", title="waterlines", xlim=(5, 24), ylim=(0, 7.6))
    handles = [
        Line2D([], [], color=PALE, label="parent"),
        Line2D([], [], color=ACCENT, label="variant"),
        Line2D([], [], color=INK, linewidth=2.6, label="end of the bossing"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=3, frameon=False)
    return figure


def _label(
    axes: Axes, hull: ah.Hull, names: tuple[str, ...], view: tuple[int, int],
    edge: tuple[int, float],
) -> None:  # fmt: skip
    """Write the names of lines where they pass an edge of the view."""
    axis, at = edge
    for name in names:
        part = max(_parts(hull, name), key=len)
        after = np.flatnonzero(np.diff(part[:, axis] > at))
        place = part[int(after[0])] if len(after) else part[-1]
        axes.annotate(
            name, place[list(view)], color=INK, fontsize=8, ha="left", va="center",
            xytext=(3, 0), textcoords="offset points", annotation_clip=False,
        )  # fmt: skip
