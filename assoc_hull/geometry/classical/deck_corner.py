"""The rounded corner between the side of a frame and the camber of its deck.

The centre of the arc lies by the radius below the camber and by the radius inside the side.
Source: Kim & Chang, "Some Representations of Ship Hulls by Mathematical Method for Design and
Production", J. SNAK.

Examples
--------
>>> import math
>>> from assoc_hull.geometry.classical.deck_corner import deck_corner
>>> corner = deck_corner(15.0, 14.0, 0.4, 1.0)
>>> [round(each, 8) for each in (*corner.deck_point, corner.centre[1])]
[14.04989296, 14.04906757, 13.050313]
"""

from __future__ import annotations

import math

import attrs
import numpy as np
from scipy.optimize import brentq

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arcs import Arcs
from assoc_hull.geometry.classical.camber import KINDS
from assoc_hull.geometry.classical.checks import figure, finite
from assoc_hull.geometry.classical.choices import one_of
from assoc_hull.geometry.classical.quadratics import Quadratics
from assoc_hull.geometry.curves import FloatArray

__all__ = ["DeckCorner", "deck_corner", "deck_pieces"]


@attrs.frozen
class DeckCorner:
    """A rounded corner; points (y, z), m.

    Attributes
    ----------
    side_point, deck_point : (float, float), m
        Where it leaves the side, and where it comes onto the deck.
    centre : (float, float), m
        Of the arc.
    radius : float, m
        Of the arc.
    """

    side_point: tuple[float, float]
    deck_point: tuple[float, float]
    centre: tuple[float, float]
    radius: float

    def arc(self) -> Arcs:
        """Give it as an arc from the side to the deck; it turns left."""
        (y, z), (v, w), (c, d) = self.side_point, self.deck_point, self.centre
        first, last = math.atan2(z - d, y - c), math.atan2(w - d, v - c)
        return Arcs.make(
            [self.side_point], [first + 0.5 * math.pi], [1.0 / self.radius],
            [self.radius * (last - first)],
        )  # fmt: skip


def deck_corner(
    half_breadth: float, side_height: float, rise: float, radius: float, *,
    side_angle: float = 0.5 * math.pi, kind: str = "parabola", name: str = "frame",
) -> DeckCorner:  # fmt: skip
    """Round the corner of deck and side.

    Parameters
    ----------
    half_breadth, side_height : float, m
        The corner (y, z) as it is without the arc.
    rise : float, m
        Of the camber, from the side to the centre line.
    radius : float, m
        Of the arc, above 0.
    side_angle : float, rad
        Direction of the side there, upward, from the outward horizontal; the side is taken
        as straight.
    kind : {"line", "parabola"}
        Of the camber.
    name : str
        What the frame is called in messages.

    Raises
    ------
    GeometryError
        ``"frame x={x}: corner radius {r} does not fit"``.
    """
    one_of(kind, KINDS, f"{name}: camber kind is")
    numbers = (half_breadth, side_height, rise, radius, side_angle)
    b, zs, c, r, lean = (float(finite(each, name, ())) for each in numbers)
    if not r > 0.0 or not b > 0.0:
        what = f"{name}: corner radius {figure(r)} does not fit"
        raise GeometryError(what, "give a radius and a half-breadth above 0", {"r": r})
    inward = np.array([-math.sin(lean), math.cos(lean)])

    def centre(y: float) -> np.typing.NDArray[np.float64]:
        part = y / b
        if kind == "parabola":
            z, slope = zs + c * (1.0 - part * part), -2.0 * c * part / b
        else:
            z, slope = zs + c * (1.0 - part), -c / b
        normal = np.array([-slope, 1.0]) / math.hypot(1.0, slope)
        return np.array([y, z]) - r * normal

    def over(y: float) -> float:
        """How much farther than the radius the centre lies inside the side."""
        return float((centre(y) - (b, zs)) @ inward) - r

    if over(0.0) * over(b) > 0.0:
        what = f"{name}: corner radius {figure(r)} does not fit"
        raise GeometryError(what, "give a smaller radius", {"r": r})
    y = float(brentq(over, 0.0, b, xtol=1e-14, rtol=1e-15))
    middle = centre(y)
    part = y / b
    top = zs + c * (1.0 - (part * part if kind == "parabola" else part))
    side = middle - r * inward
    return DeckCorner((float(side[0]), float(side[1])), (y, top), tuple(middle.tolist()), r)


def deck_pieces(
    top: FloatArray, rise: float, kind: str = "parabola", corner: DeckCorner | None = None
) -> Quadratics:
    """Give the camber from the side, or from the corner, to the centre line.

    Parameters
    ----------
    top : (2,), m
        (y, z) of the side.
    rise : float, m
        From there to the centre line.
    kind : {"line", "parabola"}
        Its curve.
    corner : DeckCorner or None
        Where it begins.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.classical.deck_corner import deck_pieces
    >>> round(2 * deck_pieces(np.array([15.0, 18.0]), 0.45).area(), 9)
    9.0
    """
    half, side = np.asarray(top, np.float64).tolist()
    start = half if corner is None else corner.deck_point[0]
    bend = rise / half**2 if kind == "parabola" and half else 0.0
    slope = 2.0 * bend * start if kind == "parabola" or not half else rise / half
    level = side + rise - (bend * start**2 if kind == "parabola" else slope * start)
    return Quadratics(
        np.array([[start, -1.0, 0.0]]), np.array([[level, slope, -bend]]), np.array([start])
    )
