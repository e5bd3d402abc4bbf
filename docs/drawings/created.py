"""The created bulk carrier: its lines, and what is known of its parent."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.plot.lines_plan.plan import lines_plan
from assoc_hull.shipped.bulk_carrier_180m import (
    VERSLUIS_AREAS,
    VERSLUIS_MOMENTS,
    VERSLUIS_X,
    bulk_carrier_180m_design,
)
from drawings.common import ACCENT, INK, PALE, SHARED

__all__ = ["bulk_carrier_180m", "bulk_carrier_180m_parent"]

_MADE: list[ah.Hull] = []


def _ship() -> ah.Hull:
    if not _MADE:
        _MADE.append(ah.examples.bulk_carrier_180m())
    return _MADE[0]


def bulk_carrier_180m() -> Figure:
    """Draw the lines plan."""
    return lines_plan(_ship(), paper="A4")


def bulk_carrier_180m_parent() -> Figure:
    """Draw the curve of areas and the centroids of sections over those of the parent."""
    design = bulk_carrier_180m_design()
    forms = Forms.of(design.definitions, design.particulars)
    figure, (areas, heights) = plt.subplots(
        2, 1, figsize=(8.6, 5.2), sharex=True, height_ratios=(1.4, 1.0), layout="constrained"
    )
    x = np.linspace(0.0, 180.0, 721)
    areas.plot(x, forms.value("sectional_area", x), color=ACCENT, label="curve of areas")
    areas.plot(VERSLUIS_X, VERSLUIS_AREAS, "o", color=INK, markersize=3.5, label="Versluis 1977")
    areas.set(ylabel="area (m2)", ylim=(0.0, 310.0))
    areas.legend(frameon=False, loc="lower center")
    heights.plot(*_centroids(), color=SHARED, label="sections of the net")
    known = VERSLUIS_MOMENTS[:-1] / VERSLUIS_AREAS[:-1]
    heights.plot(VERSLUIS_X[:-1], known, "o", color=INK, markersize=3.5, label="Versluis 1977")
    heights.fill_between(
        VERSLUIS_X[:-1],
        0.98 * known,
        1.02 * known,
        color=PALE,
        alpha=0.4,
        linewidth=0.0,
        label="2 per cent",
    )
    heights.set(xlabel="x from AP (m)", ylabel="centroid above base (m)", ylim=(5.0, 10.0))
    heights.legend(frameon=False, loc="upper center")
    return figure


def _centroids() -> tuple[list[float], list[float]]:
    """Give x and the height of the centroid of the sections between AP and FP."""
    places, found = [], []
    draught = _ship().particulars.draught
    for line in _ship()["sections"].lines.values():
        x, y, z = np.array(line.curves[0].polyline(32)).T
        if 0.0 <= x[0] < 180.0:
            top = np.interp(draught, z, y)
            y, z = np.append(y[z < draught], top), np.append(z[z < draught], draught)
            places.append(float(x[0]))
            found.append(float(np.trapezoid(y * z, z) / np.trapezoid(y, z)))
    order = np.argsort(places)
    return [places[i] for i in order], [found[i] for i in order]
