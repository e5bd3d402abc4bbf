"""Sections of Series 60 shifted: by how much, and the curve of areas before and after."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.section_areas import area_curve
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.variation.shifts.closed_form import closed_form
from assoc_hull.variation.shifts.shift_hull import ShiftWork
from assoc_hull.variation.shifts.shift_terms import ShiftRequest
from drawings.common import DRIVEN, FAINT, INK, PALE, SHARED, ship

__all__ = ["section_shifts"]

_SHAPES = {"lackenby": PALE, "c1": DRIVEN, "c2": SHARED}


def section_shifts() -> Figure:
    """Draw CB +.02 and LCB +.5 % Lpp together: delta(x) of three shapes, and areas by `c2`."""
    state = ship().state
    draught = FloatingPlanes(np.array([state.particulars.draught]), np.zeros(1), np.zeros(1))
    areas = area_curve(flotation(state), draught)
    x = np.linspace(areas.low, areas.high, 801)
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.4, 3.8), layout="constrained")
    for shape, colour in _SHAPES.items():
        asked = ShiftRequest.of(by={"cb": 0.02, "lcb_percent": 0.5}, shape=shape)
        work = ShiftWork.of(state, asked)
        found = closed_form(work.task, work.terms)
        left.plot(x, found.moved(x), color=colour, linewidth=1.8, label=shape)
        if shape == "c2":
            right.plot(x, areas.at(x), color=PALE, linewidth=1.8, label="Series 60 .70")
            right.plot(x + found.moved(x), areas.at(x), color=SHARED, linewidth=1.8,
                       label="sections shifted")  # fmt: skip
            stations = np.linspace(0.0, state.particulars.length, 21)
            moved = found.moved(stations)
            for place, by, area in zip(stations, moved, areas.at(stations), strict=True):
                right.plot([place, place + by], [area, area], color=INK, linewidth=0.9)
    for axes in (left, right):
        for place in work.terms.terminals.places.tolist():
            axes.axvline(place, color=FAINT, linewidth=0.8, zorder=0)
        axes.set_xlabel("x from AP, m")
    left.axhline(0.0, color=FAINT, linewidth=0.8, zorder=0)
    left.set_ylabel("delta, m, + forward")
    right.set_ylabel("sectional area, m2")
    left.legend(frameon=False, fontsize=9, loc="upper left")
    right.legend(frameon=False, fontsize=9, loc="lower center")
    return figure
