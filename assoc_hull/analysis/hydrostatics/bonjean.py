"""Areas of stations: at one floating position, and over the draught (Bonjean curves).

Source: E.V. Lewis, ed., Principles of Naval Architecture, vol. I, SNAME 1988, ch. I.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.floating import FloatingPosition, require_afloat
from assoc_hull.analysis.hydrostatics.floating_body import StationAreas
from assoc_hull.analysis.hydrostatics.flotation import flotation
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, body_of, state_of
from assoc_hull.arguments import integer
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.floating.immersed import Planes

__all__ = ["Bonjean", "bonjean", "sectional_areas"]

_WHERE = "in Bonjean curves"


@attrs.frozen(eq=False)
class Bonjean:
    """Areas of the stations up to level planes, and their moments.

    Attributes
    ----------
    z : (k,), m
        Heights of the planes above base.
    stations : StationAreas
        Below each of them.
    moment : (k, n), m3
        Of these areas about the base line: the integral of z dA.
    """

    z: FloatArray
    stations: StationAreas
    moment: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.z, self.moment)


def sectional_areas(hull: HasState, position: FloatingPosition) -> StationAreas:
    """Give the areas of the stations at a floating position, (1, n).

    Parameters
    ----------
    hull : Hull
        The hull.
    position : FloatingPosition
        Where it floats, moulded.

    Raises
    ------
    OutOfRangeError
        It does not float there.
    """
    body = body_of(hull)
    planes = require_afloat([position], body.limits, hull.state.particulars.length)
    return body.stations(planes)


def bonjean(hull: HasState, levels: int = 41) -> Bonjean:
    """Give the Bonjean curves of a hull, from the keel to the deck edge.

    Parameters
    ----------
    hull : Hull
        The hull.
    levels : int
        At so many heights: from the lowest place of the hull to the lowest of an open deck edge,
        or the highest of a closed one.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.bonjean import bonjean
    >>> from assoc_hull.sources import examples
    >>> curves = bonjean(examples.wigley(), 5)
    >>> curves.stations.area.shape == curves.moment.shape == (5, len(curves.stations.x))
    True
    """
    count = integer(levels, "levels", _WHERE, least=2, most=1000)
    body = flotation(state_of(hull))
    level = Planes(np.zeros(1), np.zeros(1), np.zeros(1))
    low, high = body.limits.mean_draughts(level, hull.state.particulars.length)
    z = np.linspace(float(low[0]), float(high[0]), count)
    planes = Planes(z.copy(), np.zeros(count), np.zeros(count))
    return Bonjean(z, *body.stations_and_moments(planes))
