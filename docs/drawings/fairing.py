"""A stern made unfair and fair again: where it is unfair, and what fairing moved."""

from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.plot.lines_plan.comparison import comparison_plan
from assoc_hull.plot.lines_plan.curvature_combs import curvature_combs

__all__ = ["stern_faired", "stern_heat", "stern_line"]

_STERN = (-5.5, 45.0)


def noisy_stern() -> ah.Hull:
    """Give the bulk carrier as the task page has it: read off to 20 mm abaft ST 3."""
    hull = ah.examples.bulk_carrier_207k()
    with hull.edit("read off to 20 mm") as edit:
        for crossing in hull.crossings.values():
            point, groups = crossing.points[0], {crossing.a.line.group.name, crossing.b.line.group.name}
            if groups == {"sections", "waterlines"} and crossing.role == "shared" and point.x < 45.0:
                edit.move(point, y=round(point.y * 50) / 50)
    return hull


def stern_heat() -> Figure:
    """Colour the lines of the stern by how far battens spring."""
    return noisy_stern().plot.lines_plan(heat="residual", x=_STERN, paper="A4")


def stern_faired() -> Figure:
    """Draw what fairing moved, 50 times as large."""
    hull = noisy_stern()
    before = hull.plot.snapshot()
    hull.fair()
    return comparison_plan(before, hull, paper="A4", exaggerate=50, x=_STERN)


def stern_line() -> Figure:
    """Draw the combs of a waterline before and after."""
    hull = noisy_stern()
    return curvature_combs(hull, ["WL 9"], heat="residual", x=_STERN, paper="A4")
