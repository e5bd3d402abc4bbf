"""The Duisburg Test Case, cut from its mesh: lines plan, and how well it was adopted."""

import os
from functools import cache
from pathlib import Path

from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.plot.lines_plan.adoption_deviations import adoption_deviations
from assoc_hull.plot.lines_plan.plan import lines_plan

__all__ = ["dtc", "dtc_report", "dtc_ship"]

_TITLE = "Duisburg Test Case"


@cache
def dtc_ship() -> ah.Hull:
    """Give the hull, read once."""
    path = Path(os.environ["ASSOC_HULL_DATA"]) / "dtc" / "DTC-scaled.stl.gz"
    return ah.read(path, scale=59.407, length=355.0, draught=14.5)


def dtc() -> Figure:
    """Draw the lines plan."""
    return lines_plan(dtc_ship(), paper="A4", title=_TITLE)


def dtc_report() -> Figure:
    """Draw the deviations of all curves."""
    return adoption_deviations(dtc_ship(), title=_TITLE)
