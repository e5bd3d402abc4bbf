"""Sections that definitions generate: their pieces and points."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from assoc_hull.model.form_definition import GeneratedCurve
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.generate_points import generated_points, marks_for
from assoc_hull.model.forms.line_layout import layout_at
from assoc_hull.model.forms.sections import section_shape
from assoc_hull.shipped.plain_ship import plain_ship_design
from drawings.common import ACCENT, DRIVEN, FIXED, INK, PALE, SHARED, WATCHED

COLOURS = {
    "level": SHARED, "arc": FIXED, "upright": SHARED, "curve": ACCENT, "topside": DRIVEN,
    "wall": WATCHED,
}  # fmt: skip
STATIONS = (
    (3.0, -1.0, 0.7), (18.0, -1.0, 0.3), (60.0, 1.0, -3.0), (96.0, 1.0, 0.3), (114.0, 1.0, 0.2),
)  # fmt: skip
"""Places, sides, and how far (m) above the deck edge they are named."""


def generated_sections() -> Figure:
    """Draw five sections of the plain ship, each piece in its colour, with its points."""
    design = plain_ship_design()
    forms = Forms.of(design.definitions, design.particulars)
    figure, axes = plt.subplots(figsize=(8.0, 4.6), layout="constrained")
    for x, side, up in STATIONS:
        _draw(axes, forms, x, side, up)
    axes.axhline(design.particulars.draught, color=PALE, linewidth=0.8, zorder=0)
    axes.text(-9.6, design.particulars.draught + 0.1, "draught", color=PALE, fontsize=9)
    axes.axvline(0.0, color=PALE, linewidth=0.8, zorder=0)
    for name, colour in COLOURS.items():
        if name != "wall":
            axes.plot([], [], color=colour, linewidth=2.0, label=name)
    axes.legend(loc="lower left", frameon=False, fontsize=9)
    axes.set_aspect("equal")
    axes.set_xlabel("y, m: aft to the left, forward to the right")
    axes.set_ylabel("z, m")
    return figure


def _draw(axes: Axes, forms: Forms, x: float, side: float, up: float) -> None:
    """Draw one section."""
    y, z = (float(forms.value(use, x)[0]) for use in ("deck_side", "deck_height"))
    ends = np.array([[x, 0.0, forms.contour(x)[0]], [x, y, z]])
    layout, place = layout_at(forms, "section", x), np.array([x])
    shape = section_shape(forms, layout, place, ends[None])
    t = np.linspace(0.0, 4.0, 101)
    for number, token in enumerate(layout.split("+")):
        one = shape.at(np.zeros(101, np.int64), np.full(101, number), t)
        axes.plot(side * one[:, 1], one[:, 2], color=COLOURS[token], linewidth=2.0)
    marks = marks_for(forms, "section", layout, x, ends)[0]
    made = GeneratedCurve("", 0, "section", layout, (), marks)
    (points,) = generated_points(forms, [made], place, ends[None])
    axes.plot(side * points[:, 1], points[:, 2], ".", color=INK, markersize=4)
    axes.plot(side * ends[:, 1], ends[:, 2], "o", color=INK, markersize=4, fillstyle="none")
    align = "left" if up < 0.0 else "center"
    axes.annotate(f" x = {x:g} m", (side * ends[1, 1], ends[1, 2] + up), ha=align, fontsize=9)
