"""Volume and centre of buoyancy at even keel, for the preview of an edit."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.model.state import HullState

__all__ = ["Displaced", "displaced"]


@attrs.frozen
class Displaced:
    """What the hull displaces at even keel, both sides.

    Attributes
    ----------
    volume : float, m3
        Moulded.
    lcb : float, m
        Longitudinal centre of buoyancy from AP, + forward.
    """

    volume: float
    lcb: float


def displaced(state: HullState, draught: float | None = None) -> Displaced:
    """Measure volume and LCB at even keel.

    Parameters
    ----------
    state : HullState
        The tables.
    draught : float or None, m
        The design draught if None.

    Raises
    ------
    BadInputError
        Fewer than two sections, or no surface between them.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.volume import displaced
    >>> from assoc_hull.shipped.wigley import wigley
    >>> round(displaced(wigley()).volume, 1)  # 4/9 L B T = 2777.8
    2777.4
    """
    level = state.particulars.draught if draught is None else draught
    planes = Planes(np.array([level], np.float64), np.zeros(1), np.zeros(1))
    below = flotation(state).measure(planes)
    volume, moment = float(below.volume[0]), float(below.moment_x[0])
    return Displaced(volume, moment / volume if volume else float("nan"))
