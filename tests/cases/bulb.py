"""A hull with a bulb on a neck: waterlines in one piece or two, contours that turn back.

The half-breadth is one smooth function of x and z, y - breadth_at(x, z) = 0. Its stem
leans forward and a bulb stands before it, its axis rising forward. Between the two the
profile runs back into a notch, the neck. So a plane through it meets the hull at one place
or at several, and everything that can be known of that follows from the function.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

import assoc_hull as ah
from assoc_hull.geometry.curves import freeze
from assoc_hull.model.line_source import LineSource

__all__ = [
    "ALONG", "DEPTH", "UP", "breadth_at", "bulb_hull", "contour", "girth", "gradient", "onto",
    "outline", "pieces",
]  # fmt: skip

Floats = NDArray[np.float64]

LENGTH, BREADTH, DEPTH = 100.0, 20.0, 12.0
FORWARD = 101.0
"""No point of the hull lies before this x (m)."""

LEVELS = (0.5, 1.0, 2.0, 3.0, 4.0, 4.5, 5.75, 6.5, 8.0, 10.0)
ALONG = np.concatenate([np.arange(0.0, 78.0, 2.0), np.arange(78.0, FORWARD, 0.25), [FORWARD]])
UP = np.linspace(0.0, DEPTH, 61)
BUTTOCKS = (0.3, 0.6)


def fullness(x: Floats, z: Floats) -> Floats:
    """Give a function that is nil on the stem, the neck and the bulb, and positive abaft."""
    stem = (88.0 + 12.0 * (z / DEPTH) ** 2 - x) / 20.0
    axis, before = 3.6 + 0.25 * (x - 94.0), 0.5 * (x - 94.0 + np.sqrt((x - 94.0) ** 2 + 1.0))
    bulb = 0.3 * (1.0 - ((z - axis) / 2.0) ** 2 - (before / 5.0) ** 2)
    both: Floats = 0.5 * (stem + bulb + np.sqrt((stem - bulb) ** 2 + 0.16**2))
    return both


def breadth_at(x: Floats, z: Floats) -> Floats:
    """Give the half-breadth (m); it is nil at x = 0 and z = 0, negative off the hull."""
    full = fullness(x, z)
    up, aft = 1.0 - (1.0 - z / DEPTH) ** 2, x / np.sqrt(x * x + 400.0)
    breadth: Floats = 0.5 * BREADTH * up * aft * full / np.sqrt(1.0 + full * full)
    return breadth


def zeros(of: Callable[[Floats], Floats], low: float, high: float) -> list[float]:
    """Give the zeros of a function between two places, looked for every centimetre."""
    at = np.linspace(low, high, int(np.ceil((high - low) * 100.0)) + 1)
    up = of(at) > 0.0
    return [
        float(brentq(lambda s: float(of(np.array([s]))[0]), at[i], at[i + 1], xtol=1e-12))
        for i in np.flatnonzero(up[:-1] != up[1:]).tolist()
    ]


def onto(level: float, at: Floats) -> Floats:
    """Bring points (n, 2) of the centre plane to a line of equal half-breadth.

    The level nil is the stem with the bulb.
    """
    of = fullness if level == 0.0 else breadth_at
    for _ in range(3):
        value, slope = rates(of, at)
        off = value - level
        at = at - (off / (slope * slope).sum(axis=1))[:, None] * slope
    return at


def gradient(of: Callable[[Floats, Floats], Floats], at: Floats) -> Floats:
    """Give the derivatives of a function along x and z, (n, 2)."""
    return rates(of, at)[1]


def rates(of: Callable[[Floats, Floats], Floats], at: Floats) -> tuple[Floats, Floats]:
    """Give a function's values (n,) and its derivatives along x and z (n, 2)."""
    step = 1e-6 * np.array([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]])[:, None]
    x, z = (at + step).transpose(2, 0, 1)
    here, ahead, back, above, below = of(x, z)
    return here, np.stack([ahead - back, above - below], axis=1) / 2e-6


@cache
def contour(level: float, step: float = 0.1) -> Floats:
    """Follow the line of equal half-breadth from aft forward, (n, 2) of x and z, m.

    The level nil is the stem with the bulb, from the keel upward.
    """
    of = fullness if level == 0.0 else breadth_at
    if level == 0.0:
        start = np.array([zeros(lambda x: of(x, 0.0 * x), 60.0, FORWARD)[0], 0.0])
    else:
        start = np.array([zeros(lambda x: of(x, 0.0 * x + DEPTH) - level, 0.0, 50.0)[0], DEPTH])
    points = [start]
    while len(points) < 2 or (0.0 < points[-1][1] < DEPTH and points[-1][0] < FORWARD):
        slope = gradient(of, points[-1][None])[0]
        # The fuller side lies to the left.
        along = np.array([slope[1], -slope[0]]) / np.hypot(*slope)
        points.append(onto(level, (points[-1] + step * along)[None])[0])
    last = zeros(lambda x: of(x, 0.0 * x + DEPTH) - level, 60.0, FORWARD)[-1]
    found = np.array([*points[:-1], [last, DEPTH]])
    freeze(found)
    return found


def stations() -> Floats:
    """Give the places (m) of the sections, every metre at the bulb."""
    return np.concatenate([np.arange(8.0, 84.0, 8.0), np.arange(84.0, 99.0, 1.0)])


def pieces(of: Callable[[Floats], Floats], places: Floats) -> list[Floats]:
    """Cut the places at which a function is positive into pieces, with their exact ends."""
    ends = zeros(of, float(places[0]), float(places[-1]))
    ends += [float(places[-1])] if len(ends) % 2 else []
    found = []
    for first, last in zip(ends[::2], ends[1::2], strict=True):
        clear = 0.02 * (last - first)
        inner = places[(places > first + min(clear, 0.1)) & (places < last - min(clear, 0.1))]
        found.append(np.concatenate([[first], inner, [last]]))
    return found


def girth(x: float) -> Callable[[Floats], Floats]:
    """Give the half-breadth of a section (m) as a function of the height."""
    return lambda z: breadth_at(0.0 * z + x, z)


def outline(height: float) -> Callable[[Floats], Floats]:
    """Give the half-breadth of a waterline (m) as a function of the length."""
    return lambda x: breadth_at(x, 0.0 * x + height)


def _boundaries() -> list[LineSource]:
    """Make the profile, with knuckles at the keel's ends, and the deck edge."""
    end, knuckle = ah.BoundaryKind.END, ah.PointKind.KNUCKLE
    stem = contour(0.0)
    centre = np.vstack([[0.0, DEPTH], [0.0, 0.0], stem[:-1:4], stem[-1]])
    kind = np.zeros(len(centre), np.int64)
    kind[1:3] = knuckle
    profile = np.column_stack([centre[:, 0], np.zeros(len(centre)), centre[:, 1]])
    x = pieces(outline(DEPTH), ALONG)[0]
    deck = np.column_stack([x, breadth_at(x, 0.0 * x + DEPTH), np.full(len(x), DEPTH)])
    return [
        LineSource.make(
            "boundary", "profile", profile, plane=((0, 1, 0), 0.0), boundary=end,
            kind=kind.tolist(),
        ),
        LineSource.make("boundary", "deck edge", deck, plane=((0, 0, 1), DEPTH), boundary=end),
    ]  # fmt: skip


def bulb_hull() -> ah.Hull:
    """Make the net: profile, deck edge, sections, waterlines and buttocks."""
    lines = _boundaries()
    for i, x in enumerate(stations().tolist(), 1):
        for z in pieces(girth(x), UP):
            points = np.column_stack([np.full(len(z), x), girth(x)(z), z])
            lines.append(LineSource.make("sections", f"ST {i}", points))
    for height in LEVELS:
        for x in pieces(outline(height), ALONG):
            points = np.column_stack([x, outline(height)(x), np.full(len(x), height)])
            lines.append(LineSource.make("waterlines", f"WL {height:g}", points))
    for breadth in BUTTOCKS:
        at = contour(breadth)
        at = np.vstack([at[:-1:4], at[-1]])
        points = np.column_stack([at[:, 0], np.full(len(at), breadth), at[:, 1]])
        lines.append(LineSource.make("buttocks", f"BTK {breadth:g}", points))
    links = [ah.Association("boundary", each) for each in ("sections", "waterlines", "buttocks")]
    links += [
        ah.Association("sections", "waterlines"),
        ah.Association("sections", "buttocks"),
        ah.Association("waterlines", "buttocks"),
    ]
    ship = ah.Particulars("bulb", LENGTH, BREADTH, DEPTH, 0.7 * DEPTH)
    return ah.Hull.from_lines(lines, particulars=ship, associations=links)
