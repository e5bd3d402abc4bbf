"""Volume and centre of buoyancy from section areas, for the preview of an edit.

Section areas are exact for the splines (Green's theorem, Gauss rules); along the length
the cubic spline through them is integrated, from the after to the forward end of the
immersed profile, where the area is nil.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, SplineBatch
from assoc_hull.geometry.integrals import integrate_stations, section_area
from assoc_hull.geometry.spline import sample
from assoc_hull.model.family import BoundaryKind
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
        Fewer than two sections.

    Examples
    --------
    >>> from assoc_hull.analysis.volume import displaced
    >>> from assoc_hull.examples.wigley import wigley
    >>> round(displaced(wigley()).volume, 1)  # 4/9 L B T = 2777.8
    2777.7
    """
    level = state.particulars.draught if draught is None else draught
    curves = [
        curve
        for curve in state.live("curves").tolist()
        if state.family(line := state.line_of(curve)).name == "sections"
        and state.lines.planar.data[line]
    ]
    if len(curves) < 2:
        raise BadInputError(f"{len(curves)} section(s)", "in a volume", "give two sections or more")
    batch = SplineBatch.join([state.spline(curve) for curve in curves])
    half = section_area(batch, level)
    x = state.lines.offset.data[state.curves.line.data[np.array(curves)]]
    place, first = np.unique(x, return_inverse=True)
    area: FloatArray = np.array(2.0 * np.bincount(first, half), np.float64)
    place, area = _with_ends(state, place, area, level)
    volume = float(integrate_stations(place, area))
    moment = float(integrate_stations(place, area * place))
    return Displaced(volume, moment / volume if volume else float("nan"))


def _with_ends(
    state: HullState, place: FloatArray, area: FloatArray, level: float
) -> tuple[FloatArray, FloatArray]:
    """Add the ends of the immersed profile, where they lie beyond the sections."""
    lines = state.live("lines")
    ends = lines[state.lines.boundary.data[lines] == BoundaryKind.END]
    ends = ends[np.abs(state.lines.normal.data[ends, 1]) == 1.0]
    live = state.curves.alive.data
    curves = [c for line in ends.tolist() for c in state.lines.curves.data[line] if live[c]]
    if not curves:
        return place, area
    points = sample(SplineBatch.join([state.spline(curve) for curve in curves]), 16)[1]
    wet = points[points[:, 2] <= level + 1e-9, 0]
    for end in (float(wet.min()), float(wet.max())) if len(wet) else ():
        if end < place[0] - 1e-6:
            place, area = np.insert(place, 0, end), np.insert(area, 0, 0.0)
        elif end > place[-1] + 1e-6:
            place, area = np.append(place, end), np.append(area, 0.0)
    return place, area
