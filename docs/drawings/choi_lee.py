"""The two examples of Choi and Lee: two buttocks lead, and a larger bossing; before and after."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import assoc_hull as ah
from drawings.common import ACCENT, FAINT, INK, PALE, SHARED, Floats

__all__ = ["example_bossing", "example_ends"]

_WIDE = 6.3
"""Inches: 756 pixels at the resolution that pictures are kept in."""

_TIMES = 50.0
_BUTTOCKS = {"BTK 0.5": SHARED, "BTK 1": ACCENT}
_ENDS = ("WL 12", "WL 13.5", "WL 15", "WL 16.5", "WL 18")
_LOW = {"WL 5": "#1a7f37", "WL 6": SHARED, "WL 7": ACCENT, "WL 8": "#8b1a8b"}
_CLOSE = {"BTK 0.5": (0.83, 0.07), "BTK 1": (0.62, 0.5)}


def _parts(hull: ah.Hull, name: str) -> list[Floats]:
    return [np.array(curve.polyline(48)) for curve in hull.lines[name].curves]


def _lines(hull: ah.Hull, names: tuple[str, ...]) -> dict[str, list[Floats]]:
    return {name: _parts(hull, name) for name in names}


def example_ends() -> Figure:
    """Draw the first example: buttocks in profile and ends of waterlines, true and magnified."""
    hull = ah.examples.bulk_carrier_207k()
    names = (*_BUTTOCKS, *_ENDS)
    before = _lines(hull, (*names, "profile"))
    with hull.edit("the waterline first") as edit:
        point = hull["WL 0.5 x ST 4"]
        edit.move(point, y=point.y + 0.002)
    asked = {}
    for name in _BUTTOCKS:
        x, y, z = hull[f"{name} x ST 0"].position
        (met,) = hull.lines[name].meet(((1, 0, 0), 2.2))
        asked[name] = [(f"{name} x ST 0", (x, y, z + 0.020)), np.add(met, (0, 0, 0.025))]
    with hull.edit("two buttocks lead") as edit:
        for name, points in asked.items():
            edit.lead(name, points)
    after = _lines(hull, names)
    figure, axes = plt.subplots(
        2, 2, figsize=(_WIDE, 4.4), sharex=True, sharey="row", layout="constrained"
    )
    for column, times in enumerate((1.0, _TIMES)):
        profile, plan = axes[0, column], axes[1, column]
        profile.set_title("true scale" if column == 0 else "movements magnified 50 times")
        for part in before["profile"]:
            profile.plot(part[:, 0], part[:, 2], color=INK, linewidth=1.4)
        _moved(profile, (before, after), tuple(_BUTTOCKS), (0, 2), times)
        _moved(plan, (before, after), _ENDS, (0, 1), times)
        for name, ((_, a), b) in asked.items():
            for text, place in (("A", a), ("B", b)):
                rise = (0.020 if text == "A" else 0.025) * (times - 1.0)
                profile.plot(place[0], place[2] + rise, "o", color=_BUTTOCKS[name], markersize=4)
                profile.annotate(
                    text, (place[0], place[2] + rise), color=INK, fontsize=10,
                    xytext=(4, 4) if name == "BTK 1" else (-11, -12), textcoords="offset points",
                )  # fmt: skip
        plan.set_xlabel("x (m)")
    axes[0, 0].set(ylabel="z (m)", xlim=(-5.5, 9.0), ylim=(11.5, 19.5))
    axes[1, 0].set(ylabel="y (m)", ylim=(0.0, 6.5))
    for each in axes.flat:
        each.set_aspect("equal", adjustable="box")
    for name in _ENDS:
        part = before[name][0]
        aft = part[(part[:, 0] < 12.0)]
        place = aft[int(np.argmin(np.abs(aft[:, 1] - 2.6)))]
        axes[1, 0].annotate(
            name.split()[1], place[:2], fontsize=8, color=INK, rotation=40, ha="center",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
        )  # fmt: skip
    return figure


def _moved(
    axes: Axes, hulls: tuple[dict[str, list[Floats]], ...], names: tuple[str, ...],
    view: tuple[int, int], times: float,
) -> None:  # fmt: skip
    """Draw lines as they were, dashed, and as they are with their movement magnified."""
    before, after = hulls
    for name in names:
        for part, now in zip(before[name], after[name], strict=True):
            old, after_it = _aft(part), _aft(now)
            if not len(old) or not len(after_it):
                continue
            # buttocks move along z at one x, waterlines along x at one y
            at, along = (0, 2) if name in _BUTTOCKS else (1, 0)
            order = np.argsort(after_it[:, at])
            there = np.interp(old[:, at], after_it[order, at], after_it[order, along])
            new = old.copy()
            new[:, along] += times * (there - old[:, along])
            axes.plot(*old[:, list(view)].T, color=PALE, linewidth=1.0, linestyle="--")
            axes.plot(
                *new[:, list(view)].T, color=_BUTTOCKS.get(name, INK), linewidth=1.2, zorder=3
            )


def _aft(part: Floats) -> Floats:
    """Give what lies in the picture."""
    return part[(part[:, 0] < 12.0) & (part[:, 2] > 8.0)]


def example_bossing() -> Figure:
    """Draw the second example: profile before and after, ends of waterlines, the bossing."""
    parent = ah.examples.bulk_carrier_207k()
    variant = parent.vary(set={"shaft_height": 6.0, "bossing_radius": 1.0}, fair=True).hull
    figure, axes = plt.subplots(2, 2, figsize=(_WIDE, 6.6), layout="constrained")
    for side, hull, title in zip(axes[0], (parent, variant), ("before", "after"), strict=True):
        _side(side, hull)
        side.set(title=title, xlabel="x (m)", xlim=(3.0, 20.0), ylim=(0.0, 12.6))
    _side(axes[1, 1], variant)
    for name, place in _CLOSE.items():
        axes[1, 1].annotate(
            name, place, xycoords="axes fraction", fontsize=9, color=_BUTTOCKS[name]
        )
    for x in (6.75, 7.5, 9.3):
        axes[1, 1].axvline(x, color=PALE, linewidth=0.7, linestyle=":", zorder=0)
    axes[1, 1].set(title="the bossing after", xlabel="x (m)", xlim=(5.6, 12.0), ylim=(4.2, 8.4))
    for name, color in _LOW.items():
        for hull, style, wide in ((parent, "--", 0.9), (variant, "-", 1.3)):
            for part in _parts(hull, name):
                axes[1, 0].plot(
                    part[:, 0], part[:, 1], color=color, linestyle=style, linewidth=wide
                )
    axes[1, 0].set(
        title="ends of waterlines", xlabel="x (m)", ylabel="y (m)", xlim=(5.6, 14.0), ylim=(0, 3.2)
    )
    axes[0, 0].set_ylabel("z (m)")
    for each in axes.flat:
        each.set_aspect("equal", adjustable="box")
    return figure


def _side(axes: Axes, hull: ah.Hull) -> None:
    """Draw profile, end of the bossing and two buttocks of a hull."""
    for name in ("profile", "bossing end", *_BUTTOCKS):
        for part in _parts(hull, name):
            color = _BUTTOCKS.get(name, INK)
            axes.plot(part[:, 0], part[:, 2], color=color, linewidth=1.4)
    for z in range(1, 13):
        axes.axhline(z, color=FAINT, linewidth=0.5, zorder=0)
