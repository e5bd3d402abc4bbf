"""The bulk carrier's surface with light on it, and the map of its curvature with its plates."""

import numpy as np
from matplotlib.figure import Figure

import assoc_hull as ah
from assoc_hull.plot.plates.hull_map import hull_map
from assoc_hull.plot.plates.lit_surface import surface_figure

__all__ = ["hull_plates", "hull_surface"]


def hull_plates() -> Figure:
    """Draw the shell expansion, the views and the ends, with butts and seams."""
    hull = ah.examples.bulk_carrier_207k()
    seams = ah.surface.HullSeams(x=np.arange(24.0, 300.0, 12.0), girth=np.arange(5.0, 45.0, 5.0))
    found = ah.surface.plates(hull.surface(), seams)
    return hull_map(found, title="Plates of the bulk carrier")


def hull_surface() -> Figure:
    """Draw the hull from ahead and from astern."""
    return surface_figure(ah.examples.bulk_carrier_207k().surface())
