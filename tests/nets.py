"""Nets of hulls with a formula, with the directions of their ends as the formula has them."""

import numpy as np

import assoc_hull as ah
from assoc_hull.edit.adopt import adopt
from assoc_hull.examples.wigley import half_breadth
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.model.family import BoundaryKind
from assoc_hull.model.source import LineSource
from assoc_hull.model.state import Association, Ends, HullState, Particulars

__all__ = ["ellipsoid_net", "wigley_net"]

_LINKS = [
    Association("boundary", "sections"),
    Association("boundary", "waterlines"),
    Association("sections", "waterlines"),
]

A, B, C = 50.0, 8.0, 6.0
"""Semi-axes of the ellipsoid, m; its centre lies at x = A, z = C."""

_DECK = 9.0
"""The ellipsoid is cut off at this height, m."""


def ellipsoid_net(stations: int, waterlines: int) -> HullState:
    """Give the ellipsoid up to a deck: stations equally spaced, waterlines by equal angles.

    Stations count the two tips, waterlines the base line and z = 6 m; they go on above at the
    same angles.
    """
    x = np.linspace(0.0, 2.0 * A, stations)
    step = 0.5 * np.pi / (waterlines - 1)
    level = C - C * np.cos(np.arange(1, int(np.arccos(1 - _DECK / C) / step) + 1) * step)
    level = level[level < _DECK - 0.05]
    sources = [_stem(x, level), _edge(x)]
    sources += [_ring(f"ST {i}", float(x[i]), level) for i in range(1, stations - 1)]
    sources += [_level(f"WL {z:.4f}", x, float(z)) for z in level]
    ship = Particulars("Ellipsoid", 2.0 * A, 2.0 * B, _DECK, C)
    return adopt(sources, ship, _LINKS)[0]


def _scale(x: FloatArray | float) -> FloatArray:
    """Give the scale of the section at x against that at the middle."""
    return np.sqrt(np.maximum(1.0 - ((np.asarray(x) - A) / A) ** 2, 0.0))


def _ring(name: str, x: float, level: FloatArray) -> LineSource:
    k = float(_scale(x))
    least, most = C - C * k, min(C + C * k, _DECK)
    inside = level[(level > least + 0.02 * k) & (level < most - 0.02 * k)]
    z = np.concatenate([[least], inside, [most]])
    y = B * np.sqrt(np.maximum(k**2 - ((z - C) / C) ** 2, 0.0))
    closed = most < _DECK
    y[0] = 0.0
    y[-1] = 0.0 if closed else y[-1]
    up = (0.0, -1.0, 0.0) if closed else (0.0, -(B**2) * (most - C), C**2 * y[-1])
    return LineSource.make(
        "sections", name, np.column_stack([np.full(len(z), x), y, z]),
        ends=Ends((1, 1), ((0.0, 1.0, 0.0), up)),
    )  # fmt: skip


def _level(name: str, x: FloatArray, z: float) -> LineSource:
    k = float(np.sqrt(1.0 - ((z - C) / C) ** 2))
    inside = x[np.abs(x - A) < A * k - 1e-3]
    at = np.concatenate([[A - A * k], inside, [A + A * k]])
    y = B * np.sqrt(np.maximum(k**2 - ((at - A) / A) ** 2, 0.0))
    y[[0, -1]] = 0.0
    return LineSource.make(
        "waterlines", name, np.column_stack([at, y, np.full(len(at), z)]),
        ends=Ends((1, 1), ((0.0, 1.0, 0.0), (0.0, -1.0, 0.0))),
    )  # fmt: skip


def _stem(x: FloatArray, level: FloatArray) -> LineSource:
    """Give the profile from the deck aft round the keel to the deck forward."""
    inside = x[1:-1]
    angle = np.concatenate(
        [
            np.arccos((inside - A) / A),
            np.arcsin((level - C) / C) % (2.0 * np.pi),
            np.pi - np.arcsin((level - C) / C),
            np.arccos((inside - A) / A) * -1.0 % (2.0 * np.pi),
        ]
    )
    top = np.arcsin((_DECK - C) / C)
    # From the deck aft (angle pi - top) over the keel (3/2 pi) to the deck forward (2 pi + top).
    angle = np.where(angle < np.pi - top - 1e-9, angle + 2.0 * np.pi, angle)
    angle = np.unique(angle[(angle > np.pi - top + 1e-9) & (angle < 2.0 * np.pi + top - 1e-9)])
    angle = np.concatenate([[np.pi - top], angle, [2.0 * np.pi + top]])
    angle = angle[np.diff(angle, prepend=-1.0) > 1e-6]
    points = np.column_stack([A + A * np.cos(angle), 0.0 * angle, C + C * np.sin(angle)])
    turn = [(-A * np.sin(a), 0.0, C * np.cos(a)) for a in angle[[0, -1]].tolist()]
    return LineSource.make(
        "boundary", "profile", points, plane=((0, 1, 0), 0.0), boundary=BoundaryKind.END,
        ends=Ends((1, 1), (turn[0], turn[1])),
    )  # fmt: skip


def _edge(x: FloatArray) -> LineSource:
    source = _level("deck edge", x, _DECK)
    return LineSource.make(
        "boundary", "deck edge", source.points, plane=((0, 0, 1), _DECK),
        boundary=BoundaryKind.END, ends=source.ends,
    )  # fmt: skip
