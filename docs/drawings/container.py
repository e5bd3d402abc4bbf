"""The created container ship: its lines, its bulb, its body plan beside those of other ships."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.plot.lines_plan.plan import lines_plan
from assoc_hull.shipped.container_ship_225m import container_ship_225m_design
from drawings.common import ACCENT, INK, PALE, SHARED, ship
from drawings.dtc import dtc_ship

__all__ = ["container_ship_225m", "container_ship_225m_bodies", "container_ship_225m_bulb"]

_MADE: list[ah.Hull] = []


def _ship() -> ah.Hull:
    if not _MADE:
        _MADE.append(ah.examples.container_ship_225m())
    return _MADE[0]


def container_ship_225m() -> Figure:
    """Draw the lines plan."""
    return lines_plan(_ship(), paper="A4")


def container_ship_225m_bulb() -> Figure:
    """Draw the sections of the bow with their necks, and the areas they are made of."""
    design = container_ship_225m_design()
    forms = Forms.of(design.definitions, design.particulars)
    figure, (plan, areas) = plt.subplots(
        1, 2, figsize=(8.6, 4.6), width_ratios=(1.0, 1.35), layout="constrained"
    )
    for line in _ship()["sections"].lines.values():
        for curve in line.curves:
            x, y, z = np.array(curve.polyline(16)).T
            if x[0] > 190.0:
                plan.plot(y, z, color=ACCENT if x[0] >= 225.0 else INK, linewidth=0.9)
    x = np.linspace(198.0, 224.4, 200)
    neck = [forms.value(use, x) for use in ("bulb_neck", "bulb_height")]
    plan.plot(*neck, color=SHARED, linewidth=1.6, label="necks")
    plan.axhline(10.8, color=PALE, linewidth=0.8)
    plan.set(xlim=(0.0, 8.0), ylim=(-0.3, 14.0), xlabel="y (m)", ylabel="z (m)", aspect="equal")
    plan.legend(frameon=False, loc="lower right")
    x = np.linspace(180.0, 231.0, 500)
    areas.plot(x, forms.value("sectional_area", x), color=INK, label="sections, to FP")
    areas.plot(x, forms.value("bulb_area", x), color=SHARED, label="up to the neck, or bulb")
    areas.axvline(225.0, color=PALE, linewidth=0.8)
    areas.set(xlabel="x from AP (m)", ylabel="area (m2)", ylim=(0.0, None))
    areas.legend(frameon=False)
    return figure


def container_ship_225m_bodies() -> Figure:
    """Draw its body plan beside those of the Duisburg Test Case and of Series 60."""
    figure, axes = plt.subplots(1, 3, figsize=(9.4, 2.6), layout="constrained")
    for each, hull, title, aft, fore in (
        (axes[0], _ship(), "created", -5.0, 240.0),
        (axes[1], dtc_ship(), "Duisburg Test Case", -10.0, 380.0),
        (axes[2], ship(), "Series 60, CB 0.70", -10.0, 130.0),
    ):
        _body_plan(each, hull, 0.5 * (aft + fore))
        each.set_title(title, fontsize=10)
    return figure


def _body_plan(axes: Axes, hull: ah.Hull, middle: float) -> None:
    """Draw sections in parts of the breadth; those abaft the middle to the left."""
    breadth = hull.particulars.breadth
    for line in hull["sections"].lines.values():
        for curve in line.curves:
            x, y, z = np.array(curve.polyline(12)).T / breadth
            side = -1.0 if x[0] * breadth < middle else 1.0
            axes.plot(side * y, z, color=INK, linewidth=0.6)
    draught = hull.particulars.draught / breadth
    axes.axhline(draught, color=ACCENT, linewidth=0.7)
    axes.axvline(0.0, color=PALE, linewidth=0.7)
    axes.set(aspect="equal", xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
