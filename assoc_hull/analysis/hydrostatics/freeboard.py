"""Freeboard, and the heel at which the deck edge goes under."""

from __future__ import annotations

import attrs
import numpy as np
from scipy.optimize import brentq

from assoc_hull.analysis.hydrostatics.appendage import Appendage, with_appendages
from assoc_hull.analysis.hydrostatics.floating import FloatingPosition, Limits, planes_of
from assoc_hull.analysis.hydrostatics.floating_body import Floats
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Planes

__all__ = ["Freeboard", "deck_edge_angle", "freeboard"]

_STEEPEST = 89.0  # degrees
_STEP = 10.0
_FINE = 1e-8


@attrs.frozen
class Freeboard:
    """Where the deck edge is nearest to the water.

    Attributes
    ----------
    least : float, m
        Height of the deck edge above the water, at right angles to the water; below 0 if it is
        under water.
    place : (float, float, float), m
        Of that point of the deck edge; y below 0 to starboard.
    """

    least: float
    place: tuple[float, float, float]


def freeboard(deck: FloatArray, position: FloatingPosition, length: float) -> Freeboard:
    """Give the least freeboard.

    Parameters
    ----------
    deck : (n, 3), m
        The deck edge, port side.
    position : FloatingPosition
        Where the hull floats.
    length : float, m
        Between perpendiculars.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.floating import FloatingPosition
    >>> from assoc_hull.analysis.hydrostatics.freeboard import freeboard
    >>> edge = np.array([[0.0, 10, 12], [100, 10, 12]])
    >>> freeboard(edge, FloatingPosition(6.0, 5.0), 100.0)
    Freeboard(least=5.99970002249813, place=(0.0, 10.0, 12.0))
    """
    plane = planes_of([position], length)
    both = np.concatenate([deck, deck * [1.0, -1.0, 1.0]])
    x, y, z = both.T
    above = z - plane.height - plane.tan_trim * x + plane.tan_heel * y
    above = above / np.sqrt(1.0 + plane.tan_trim**2 + plane.tan_heel**2)
    near = int(np.argmin(above))
    x0, y0, z0 = both[near].tolist()
    return Freeboard(float(above[near]), (x0, y0, z0))


def deck_edge_angle(
    body: Floats,
    position: FloatingPosition,
    length: float,
    appendages: tuple[Appendage, ...] = (),
) -> float | None:
    """Give the heel (degrees, to starboard) at which the deck edge goes under.

    Displacement and trim stay as they are. At each heel there is one plane that touches the
    deck edge; the edge is dry as long as the hull displaces more below that plane than it has to.

    Parameters
    ----------
    body : Floats
        The hull.
    position : FloatingPosition
        Where it floats upright; its own heel does not count.
    length : float, m
        Between perpendiculars.
    appendages : tuple of Appendage
        That carry as well.

    Returns
    -------
    float or None
        0 if it is under water upright; None if it stays dry to 89 degrees.
    """
    upright = attrs.evolve(position, heel_deg=0.0)
    planes = planes_of([upright], length)
    slope = float(planes.tan_trim[0])
    want = float(with_appendages(body.measure(planes), appendages, planes).volume[0])

    def spare(heel: float) -> float:
        """Give what the hull displaces below the plane that touches its deck edge, less that."""
        return _touching_volume(body, heel, slope, length, appendages) - want

    if spare(0.0) <= 0.0:
        return 0.0
    deck = body.limits.deck
    turn = np.arctan2(freeboard(deck, upright, length).least, np.abs(deck[:, 1]).max() + 1e-9)
    low, high = 0.0, min(1.2 * float(np.degrees(turn)), _STEEPEST)
    while spare(high) > 0.0:
        if high >= _STEEPEST:
            return None
        low, high = high, min(high + _STEP, _STEEPEST)
    return float(brentq(spare, low, high, xtol=_FINE))


def _touching_volume(
    body: Floats,
    heel: float,
    slope: float,
    length: float,
    appendages: tuple[Appendage, ...],
) -> float:
    """Give the volume below the plane that touches the deck edge from below at a heel."""
    turned = np.array([slope]), np.array([np.tan(np.radians(heel))])
    limits = body.limits
    edge = Limits(limits.bottom, limits.deck, closed=False)
    least, most = edge.mean_draughts(Planes(np.zeros(1), *turned), length)
    if most[0] <= least[0]:
        return 0.0
    touching = Planes(most - 0.5 * length * slope, *turned)
    return float(with_appendages(body.measure(touching), appendages, touching).volume[0])
