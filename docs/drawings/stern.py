"""The lines plan of the bulk carrier, her combs, and her stern as the tutorial fairs it."""

import numpy as np
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.geometry.splines.plane_intersections import intersect_planes
from assoc_hull.plot import combs_plan
from assoc_hull.plot.lines_plan.comparison import comparison_plan
from assoc_hull.plot.lines_plan.plan import lines_plan

__all__ = ["bulk_carrier", "carrier_combs", "counter", "led_buttocks", "stern_faired", "stern_heat"]

_STERN = (-5.5, 45.0)
_NOISE = 0.020 / 12**0.5
_AHEAD, _UP = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])


def bulk_carrier() -> Figure:
    """Draw the lines plan."""
    return lines_plan(ah.examples.bulk_carrier_207k(), paper="A4")


def carrier_combs() -> Figure:
    """Draw all lines with their curvature combs."""
    return combs_plan(ah.examples.bulk_carrier_207k())


def stern_heat() -> Figure:
    """Colour the lines of the stern, as it was read off, by how far battens spring."""
    return _read_off().plot.lines_plan(heat="residual", x=_STERN)


def stern_faired() -> Figure:
    """Draw what fairing moved."""
    hull = _read_off()
    before = hull.plot.snapshot()
    _fair(hull)
    return comparison_plan(before, hull, exaggerate=100, x=_STERN)


def counter() -> Figure:
    """Draw what moved when two buttocks were re-shaped."""
    hull = _read_off()
    _fair(hull)
    before = hull.plot.snapshot()
    with hull.edit("raise the counter") as edit:
        for name in ("BTK 0.5", "BTK 1"):
            curve = next(each for each in hull.lines[name].curves if each.points[0].x < 0.0)
            a = next(point for point in curve.points if point.x == 0.0).position
            b = intersect_planes(curve.spline, _AHEAD, np.array([2.2])).xyz[0]
            shape = [a + 0.020 * _UP, b + 0.025 * _UP]
            edit.reshape(curve, points=shape, span=(-3.75, 30.0), fair=True)
    return comparison_plan(before, hull, exaggerate=50, x=(-5.5, 20.0))


def led_buttocks() -> Figure:
    """Draw what moved when two buttocks led: the first example of Choi and Lee."""
    hull = ah.examples.bulk_carrier_207k()
    before = hull.plot.snapshot()
    asked = {}
    for name in ("BTK 0.5", "BTK 1"):
        at = hull[f"{name} x ST 0"].position
        (met,) = hull.lines[name].meet(((1, 0, 0), 2.2))
        asked[name] = [(f"{name} x ST 0", at + 0.020 * _UP), met + 0.025 * _UP]
    with hull.edit("two buttocks lead") as edit:
        for name, points in asked.items():
            edit.lead(name, points)
    return comparison_plan(before, hull, exaggerate=50, x=(-5.5, 20.0))


def _read_off() -> ah.Hull:
    """Give the carrier with half-breadths to 20 mm abaft station 3."""
    hull = ah.examples.bulk_carrier_207k()
    with hull.edit("read off a print") as edit:
        for crossing in hull.crossings.values():
            point = crossing.points[0]
            groups = {crossing.a.line.group.name, crossing.b.line.group.name}
            shared = groups == {"sections", "waterlines"} and crossing.role == "shared"
            if shared and 0.0 <= point.x <= 45.0 and point.y > 1.0:
                edit.move(point, y=round(point.y * 50) / 50)
    return hull


def _fair(hull: ah.Hull) -> None:
    at, radius = (22.5, 10.0, 10.0), (90.0, 60.0)
    hull.fair(at=at, radius=radius, noise=_NOISE, hold=["volume", "lcb"])
