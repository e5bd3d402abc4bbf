"""The counter of the bulk carrier before and after its buttocks were re-shaped."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

import assoc_hull as ah
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.plot import combs_plan
from assoc_hull.plot.lines_plan.plan import lines_plan
from drawings.common import ACCENT, INK, PALE, SHARED, Floats

__all__ = ["bulk_carrier", "carrier_combs", "counter"]

_SCALE = 10.0
_NAMES = {"BTK 0.5": (10.0, 0.4), "BTK 1": (10.0, 2.5)}
_WATER = ("WL 12", "WL 13.5", "WL 15", "WL 16.5", "WL 18")
_AHEAD, _UP = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])


def bulk_carrier() -> Figure:
    """Draw the lines plan."""
    return lines_plan(ah.examples.bulk_carrier_207k(), paper="A4")


def carrier_combs() -> Figure:
    """Draw all lines with their curvature combs."""
    return combs_plan(ah.examples.bulk_carrier_207k())


def counter() -> Figure:
    """Draw two buttocks and five waterlines; what they moved is drawn ten times as large."""
    hull = ah.examples.bulk_carrier_207k()
    old = {name: _aft(hull, name) for name in (*_NAMES, *_WATER)}
    given = _raise(hull)
    new = {name: _aft(hull, name) for name in old}
    figure, (profile, plan) = plt.subplots(
        1, 2, figsize=(9.4, 4.6), width_ratios=(1.25, 1.0), layout="constrained"
    )
    for name in _NAMES:
        x = np.linspace(-5.0, 9.0, 300)
        was, now = (np.interp(x, part[name][:, 0], part[name][:, 2]) for part in (old, new))
        profile.plot(x, was, color=PALE, linewidth=0.9)
        profile.plot(x, was + _SCALE * (now - was), color=ACCENT, linewidth=1.3)
        profile.annotate(
            name, (x[-1], was[-1]), color=INK, xytext=(4, 0), textcoords="offset points"
        )
    for name in _WATER:
        y = np.linspace(0.0, 5.0, 300)
        was, now = (np.interp(y, part[name][:, 1], part[name][:, 0]) for part in (old, new))
        plan.plot(was, y, color=PALE, linewidth=0.9)
        plan.plot(was + _SCALE * (now - was), y, color=SHARED, linewidth=1.3)
        plan.annotate(name, (was[-1], 5.0), color=INK, xytext=(0, 3), textcoords="offset points")
        profile.axhline(float(name.split()[1]), color=PALE, linewidth=0.4, zorder=0)
    for x, y, z, rise in given:
        profile.plot(x, z + _SCALE * rise, "o", color=ACCENT, markersize=5)
        plan.axhline(y, color=PALE, linewidth=0.4, zorder=0)
    profile.set(xlabel="x (m)", ylabel="z (m)", title="buttocks", xlim=(-5, 10.5), ylim=(9.2, 19))
    plan.set(xlabel="x (m)", ylabel="y (m)", title="waterlines", xlim=(-5, 14), ylim=(0, 5.6))
    handles = [
        Line2D([], [], color=PALE, label="before"),
        Line2D([], [], color=ACCENT, label="re-shaped"),
        Line2D([], [], color=SHARED, label="followed"),
        Line2D([], [], color=ACCENT, marker="o", linestyle="", label="A and B"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=4, frameon=False)
    figure.suptitle(f"all movements drawn {_SCALE:g} times as large", fontsize=10)
    return figure


def _raise(hull: ah.Hull) -> list[tuple[float, float, float, float]]:
    """Re-shape the buttocks as the tutorial does; give x, y, z and rise of A and B of each."""
    given = []
    with hull.edit("raise the counter") as edit:
        for name, fade in _NAMES.items():
            curve = next(each for each in hull.lines[name].curves if each.points[0].x < 0.0)
            a = next(point for point in curve.points if point.x == 0.0).position
            b = intersect_planes(curve.spline, _AHEAD, np.array([2.2])).xyz[0]
            shape = [a + 0.020 * _UP, b + 0.025 * _UP]
            edit.reshape(curve, points=shape, span=(-4.8, 6.6), fade=fade)
            given += [(*a, 0.020), (*b, 0.025)]
    return given


def _aft(hull: ah.Hull, name: str) -> Floats:
    """Give places along the curve that begins aft, as far as x or y rises, (n, 3), m."""
    curve = min(hull.lines[name].curves, key=lambda each: each.points[0].x)
    places = np.array(curve.polyline(24))
    rising = 0 if name.startswith("BTK") else 1
    return places[: int(np.argmax(np.diff(places[:, rising]) < 0.0)) + 1]
