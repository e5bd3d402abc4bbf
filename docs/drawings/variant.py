"""A parent and a ship with 2 % more displacement: sections, areas, stern and all lines."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

import assoc_hull as ah
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.section_areas import section_areas
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.plot.lines_plan.comparison import comparison_plan
from drawings.common import ACCENT, FAINT, INK, PALE, Floats

__all__ = ["variant_areas", "variant_plan"]

_STERN = ("profile", "bossing end", "BTK 1", "BTK 4", "BTK 8.5")
_MADE: list[tuple[ah.Hull, ah.Hull]] = []


def _hulls() -> tuple[ah.Hull, ah.Hull]:
    """Give parent and variant, made once."""
    if not _MADE:
        parent = ah.examples.bulk_carrier_207k()
        old = parent.hydrostatics(estimate=False)
        variant = parent.vary(
            set={"shaft_height": 6.0},
            reach={"volume": 1.02 * old.volume, "lcb": old.lcb - 0.9},
            free=["breadth", "fore_shift", "aft_shift"],
        )
        _MADE.append((parent, variant.hull))
    return _MADE[0]


def variant_plan() -> Figure:
    """Draw both lines plans over one another."""
    parent, variant = _hulls()
    return comparison_plan(parent, variant, paper="A4", found=parent.compare(variant))


def variant_areas() -> Figure:
    """Draw the curves of sectional areas, and the stern in profile, of parent and variant."""
    figure, (areas, stern) = plt.subplots(
        1, 2, figsize=(9.4, 4.2), width_ratios=(1.5, 1.0), layout="constrained"
    )
    for hull, colour, wide in zip(_hulls(), (PALE, ACCENT), (1.2, 1.3), strict=True):
        x, area = _areas(hull)
        areas.plot(x, area, color=colour, linewidth=wide)
        centre = hull.hydrostatics(estimate=False).lcb
        height = float(np.interp(centre, x, area))
        areas.plot([centre, centre], [0.0, height], color=colour, linewidth=wide, linestyle="--")
        for line in _STERN:
            for curve in hull.lines[line].curves:
                part = np.array(curve.polyline(24))
                stern.plot(part[:, 0], part[:, 2], color=colour, linewidth=wide)
    areas.set(
        xlabel="x (m)", ylabel="A (m²)", title="sectional areas up to 18 m; dashed: LCB",
        xlim=(-5.0, 308.0), ylim=(0.0, 1000.0),
    )  # fmt: skip
    _stern(stern)
    handles = [
        Line2D([], [], color=colour, label=name)
        for colour, name in ((PALE, "parent"), (ACCENT, "variant"))
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=2, frameon=False)
    return figure


def _areas(hull: ah.Hull) -> tuple[Floats, Floats]:
    """Give areas of sections along the hull at the design draught, m and m2."""
    x = np.linspace(-5.0, 306.5, 624)
    planes = FloatingPlanes(np.array([hull.particulars.draught]), np.zeros(1), np.zeros(1))
    area = section_areas(flotation(hull.state), x, planes)[0]
    known = np.isfinite(area)  # not where the raked ends begin
    return x[known], area[known]


def _stern(axes: Axes) -> None:
    axes.set(xlabel="x (m)", ylabel="z (m)", title="profile and buttocks aft", xlim=(-6.0, 30.0),
             ylim=(0.0, 24.0))  # fmt: skip
    axes.set_aspect("equal")
    for z in (5.0, 6.0):
        axes.axhline(z, color=FAINT, linewidth=0.6, zorder=0)
        axes.annotate(f"shaft {z:g} m", (-5.5, z), color=INK, fontsize=7, va="bottom",
                      xytext=(0, -1), textcoords="offset points")  # fmt: skip
