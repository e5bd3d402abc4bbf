"""The Wigley hull: an exact polynomial form, the first thing every hull program is tried on."""

from __future__ import annotations

import numpy as np

from assoc_hull.arguments import integer, positive
from assoc_hull.edit.adoption.adopt_lines import adopt
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, HullState, Particulars

__all__ = ["wigley", "wigley_half_breadth"]

_MOST = 1000
"""More stations or waterlines than this are a mistake."""

_FREEBOARD = 0.5
"""Height of the wall-sided part above the design waterline, as a part of the draught."""


def wigley_half_breadth(
    x: FloatArray, z: FloatArray, length: float, breadth: float, draught: float
) -> FloatArray:
    """Give y = B/2 (1 - xi^2)(1 - zeta^2), m.

    Parameters
    ----------
    x, z : array, m
        From the after end, and from the base line; above the draught the hull is wall-sided.
    length, breadth, draught : float, m
        L, B and T.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.shipped.wigley import wigley_half_breadth
    >>> wigley_half_breadth(np.array([50.0, 25.0]), np.array([6.25, 9.0]), 100, 10, 6.25)
    array([5.  , 3.75])
    """
    along = 2.0 * np.asarray(x) / length - 1.0
    down = np.maximum(draught - np.asarray(z), 0.0) / draught
    y: FloatArray = 0.5 * breadth * (1.0 - along * along) * (1.0 - down * down)
    return y


def wigley(
    length: float = 100.0,
    breadth: float = 10.0,
    draught: float = 6.25,
    *,
    stations: int = 21,
    waterlines: int = 11,
) -> HullState:
    """Make the Wigley hull as a net whose points lie exactly on the polynomial.

    Completed beyond the formula: upright stem and stern post and a level keel (the formula's
    own ends), and wall sides from the design waterline to a level deck edge at 1.5 T.

    Parameters
    ----------
    length, breadth, draught : float, m
        L, B and T.
    stations : int
        Including the two ends, where the breadth is nil and no section is drawn.
    waterlines : int
        Equally spaced over the draught, including the base line (nil) and z = T.

    Returns
    -------
    HullState
        Volume to T: 4/9 L B T.

    Raises
    ------
    BadInputError
        Dimensions that are not positive, fewer than 5 stations or 3 waterlines.
    """
    for name, value in (("length", length), ("breadth", breadth), ("draught", draught)):
        positive(value, name, "in wigley")
    integer(stations, "stations", "in wigley", least=5, most=_MOST)
    integer(waterlines, "waterlines", "in wigley", least=3, most=_MOST)
    hull = (length, breadth, draught)
    x, z = np.linspace(0.0, length, stations), np.linspace(0.0, draught, waterlines)
    sources = _boundaries(x, hull)
    sources += [_section(f"ST {i}", float(x[i]), z, hull) for i in range(1, stations - 1)]
    sources += [
        LineSource.make("waterlines", f"WL {height:g}", _level(x, float(height), hull))
        for height in z[1:]
    ]
    ship = Particulars("Wigley", length, breadth, (1.0 + _FREEBOARD) * draught, draught, "closed")
    links = [Association("boundary", "sections"), Association("boundary", "waterlines")]
    links += [Association("sections", "waterlines")]
    for group in ("boundary", "sections", "waterlines"):
        links.append(Association(group, "buttocks"))
    return adopt(sources, ship, links)[0]


def _level(x: FloatArray, z: float, hull: tuple[float, float, float]) -> FloatArray:
    return np.column_stack(
        [x, wigley_half_breadth(x, np.full(len(x), z), *hull), np.full(len(x), z)]
    )


def _boundaries(x: FloatArray, hull: tuple[float, float, float]) -> list[LineSource]:
    length, _, draught = hull
    deck = (1.0 + _FREEBOARD) * draught
    corners = np.array([[0, 0, deck], [0, 0, 0], [length, 0, 0], [length, 0, deck]], np.float64)
    corner = int(PointKind.KNUCKLE)
    return [
        LineSource.make(
            "boundary", "profile", corners, plane=((0, 1, 0), 0.0),
            boundary=BoundaryKind.END, kind=[0, corner, corner, 0],
        ),
        LineSource.make(
            "boundary", "deck edge", _level(x, deck, hull), plane=((0, 0, 1), deck),
            boundary=BoundaryKind.END,
        ),
    ]  # fmt: skip


def _section(name: str, x: float, z: FloatArray, hull: tuple[float, float, float]) -> LineSource:
    """From the keel up; a tangent point where the wall side begins."""
    height = np.append(z, (1.0 + _FREEBOARD) * hull[2])
    y = wigley_half_breadth(np.full(len(height), x), height, *hull)
    kind = np.zeros(len(height), int)
    kind[-2] = PointKind.TANGENT
    upward = np.where((kind == PointKind.TANGENT)[:, None], [0.0, 0.0, 1.0], 0.0)
    points = np.column_stack([np.full(len(height), x), y, height])
    return LineSource.make(
        "sections", name, points, kind=[int(each) for each in kind], direction=upward
    )
