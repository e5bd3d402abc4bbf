"""Other surfaces of the same hull, by which it is told what its net leaves open.

Examples
--------
>>> import assoc_hull as ah
>>> from assoc_hull.surface.plates.other_fits import every_second_waterline
>>> every_second_waterline(ah.examples.wigley().state)[:2]
('WL 0.625', 'WL 1.875')
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import gather
from assoc_hull.model.state import HullState
from assoc_hull.surface.blocks.fit_options import FitOptions
from assoc_hull.surface.blocks.fitting import surface_of_net
from assoc_hull.surface.blocks.net_surface import NetSurface

__all__ = ["every_second_waterline", "other_fits"]

_STIFFER = 2.0
"""Times the penalty."""


def every_second_waterline(state: HullState) -> tuple[str, ...]:
    """Give the names of every second waterline from below, but for those that end the hull."""
    net = gather(state)
    heights: dict[str, float] = {}
    for curve in np.flatnonzero((np.array(net.family) == "waterlines") & ~net.end).tolist():
        first = int(net.batch.start[curve])
        heights.setdefault(net.name[curve], float(net.batch.xyz[first, 2]))
    return tuple(sorted(heights, key=lambda name: (heights[name], name))[::2])


def other_fits(state: HullState, options: FitOptions) -> tuple[NetSurface, ...]:
    """Fit a hull twice more: with twice the penalty, and without every second waterline.

    Parameters
    ----------
    state : HullState
        The tables of the hull.
    options : FitOptions
        Those of the surface that is published.
    """
    stiffer = attrs.evolve(options, smoothing=_STIFFER * options.smoothing)
    found = [surface_of_net(state, stiffer)]
    thinned = every_second_waterline(state)
    if thinned:
        found.append(surface_of_net(state, options, thinned))
    return tuple(found)
