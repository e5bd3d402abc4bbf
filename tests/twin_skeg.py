"""A ship with twin skegs whose stern is known by construction.

Forward of the after body she is the 207k carrier. Abaft `FORE` her bottom rises straight to the
transom, as a tunnel's roof; from it hangs a skeg on either side, whose lower edge is an arc of a
circle that leaves the base line at `FORE` and meets the roof at `AFT`. Its sections are a bump
about a centre plane that is inclined, and that runs outward going forward.

Lengths in metres; x forward from AP, y to port, z up from the base line.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

import assoc_hull as ah
from assoc_hull.model.line_source import LineSource
from assoc_hull.shipped import bulk_carrier_207k_form as form
from assoc_hull.shipped.bulk_carrier_207k import station

__all__ = [
    "AFT", "BILGE", "DRAUGHT", "EDGE", "FORE", "LEAN", "LENGTH", "RISE", "RUN", "SCREW", "TRANSOM",
    "WIDTH", "breadth", "bump", "edge", "lower_skin", "middle", "roof", "twin_skeg_ship",
]  # fmt: skip

Floats = NDArray[np.float64]

LENGTH, HALF, DEPTH, DRAUGHT, BILGE = 300.0, 25.0, 27.0, 18.0, form.BILGE
FORE, TRANSOM = 54.0, -5.0
"""x where the tunnel's roof comes down to the base line, and of the transom."""

RISE, LEAN, RUN = (float(np.tan(np.radians(each))) for each in (13.5, 14.0, 2.5))
"""Slopes of the roof, of the skeg's centre plane in the section, and of that in plan."""

AFT = 2.0
"""x of the aft end of the skeg."""

EDGE = (FORE - AFT) * (1.0 + RISE * RISE) / (2.0 * RISE)
"""Radius of the lower edge."""

WIDTH, OFF, HEIGHT = 4.5, 9.0, 8.0
"""Half the breadth of a skeg at the roof; the distance of its centre plane from the centre line
at station 1, at this height."""

SCREW = ah.form.Screw(
    height=4.25, diameter=6.0, x=12.0, spacing=17.0, boss_diameter=1.2, boss_x=13.0
)

_SMOOTH, _TANGENT, _KNUCKLE = (int(kind) for kind in ah.PointKind)
_INSIDE, _ACROSS = 4, 33
"""Points of a section on the roof inside of the skeg, and on the skeg."""

_STATIONS = (14.0, 15.0, 15.5, 16.0, 16.5, 17.0, 17.5, 18.0, 18.25, 18.5, 18.75, 19.0,
             19.2, 19.4, 19.5, 19.6, 19.8, 20.04, 20.175, 20.3)  # fmt: skip
"""Stations of the carrier that are drawn."""


def roof(x: float | Floats) -> Floats:
    """Height of the tunnel's roof, which is the profile."""
    return np.asarray(RISE * np.maximum(FORE - np.asarray(x), 0.0))


def edge(x: float | Floats) -> Floats:
    """Height of the skeg's lower edge."""
    ahead = FORE - np.asarray(x)
    return np.asarray(EDGE - np.sqrt(EDGE * EDGE - ahead * ahead))


def middle(x: float | Floats, z: float | Floats) -> Floats:
    """Distance of the skeg's centre plane from the centre line."""
    return np.asarray(OFF + RUN * (np.asarray(x) - 15.0) + LEAN * (np.asarray(z) - HEIGHT))


def bump(t: Floats) -> Floats:
    """Depth of the skeg over its breadth, t from -1 to 1; 1 in the middle."""
    return np.asarray((1.0 - t * t) ** 2)


def breadth(x: float | Floats) -> Floats:
    """Half-breadth of the side, which is upright."""
    ahead = np.maximum(FORE - np.asarray(x), 0.0) / (FORE - TRANSOM)
    return np.asarray(HALF - 5.0 * ahead * ahead)


def lower_skin(x: float) -> Floats:
    """Places (n, 2) of y and z from the centre line over the skeg to the bilge."""
    top, side = float(roof(x)), float(breadth(x)) - BILGE
    depth = top - float(edge(x)) if AFT < x < FORE else 0.0
    across = np.linspace(-1.0, 1.0, _ACROSS)
    z = top - depth * bump(across)
    skeg = np.column_stack([middle(x, z) + WIDTH * across, z])
    inner = np.linspace(0.0, skeg[0, 0], _INSIDE + 1)[:-1]
    outer = np.linspace(skeg[-1, 0], side, 9)[1:]
    flat = [np.column_stack([y, np.full(len(y), top)]) for y in (inner, outer)]
    return np.concatenate([flat[0], skeg, flat[1]])


def _section(x: float) -> tuple[Floats, list[int], Floats]:
    """Half a section of the after body: points, kinds, directions."""
    below, top, side = lower_skin(x), float(roof(x)), float(breadth(x))
    angle = np.linspace(0.0, 0.5 * np.pi, 13)[1:]
    bilge = np.column_stack(
        [side - BILGE + BILGE * np.sin(angle), top + BILGE - BILGE * np.cos(angle)]
    )
    points = np.concatenate([below, bilge, [[side, DEPTH]]])
    kind = [_SMOOTH] * len(points)
    direction = np.zeros((len(points), 3))
    for i in (_INSIDE, _INSIDE + _ACROSS - 1, len(below) - 1):
        kind[i], direction[i] = _TANGENT, (0.0, 1.0, 0.0)
    kind[-2], direction[-2] = _TANGENT, (0.0, 0.0, 1.0)
    return np.column_stack([np.full(len(points), x), points]), kind, direction


def _after_stations() -> Floats:
    """Where the after body's sections stand: closest at the skeg."""
    return np.unique(
        np.concatenate(
            [
                [-2.5, 0.0, AFT],
                np.arange(3.0, FORE, 1.5),
                [FORE, 70.0, 85.0, 100.0, 115.0, 150.0, 180.0],
            ]
        )
    )


def _profile() -> LineSource:
    """From the transom down to the base line, forward, round the bulb and up the stem."""
    nose = form.NOSE[1] * (1.0 - np.cos(np.linspace(0.0, np.pi / 2.0, 41)[1:]))
    z = np.concatenate([nose, np.linspace(form.NOSE[1], DEPTH, 61)[1:]])
    stem = np.column_stack([form.fore_end(z), 0.0 * z, z])
    keel = [[TRANSOM, 0.0, float(roof(TRANSOM))], [FORE, 0, 0], [form.KEEL_FORE, 0, 0]]
    points = np.concatenate([keel, stem])
    kind = [_SMOOTH, _KNUCKLE, _TANGENT, *[_SMOOTH] * len(stem)]
    direction = np.zeros((len(points), 3))
    direction[2] = [1.0, 0.0, 0.0]
    return LineSource.make(
        "boundary", "profile", points, plane=((0, 1, 0), 0.0), boundary=ah.BoundaryKind.END,
        kind=kind, direction=direction,
    )  # fmt: skip


def _deck_edge() -> LineSource:
    run = np.linspace(TRANSOM, FORE, 30)
    fore, end = float(form.fore_shoulder(DEPTH)), float(form.fore_end(DEPTH))
    ahead = fore + (end - fore) * np.sin(np.linspace(0.0, np.pi / 2.0, 50))[1:]
    x = np.concatenate([run, [fore], ahead])
    y = np.concatenate([breadth(run), [HALF], form.carrier_half_breadth(ahead, DEPTH)])
    y[-1] = 0.0
    kind = [_SMOOTH] * len(x)
    direction = np.zeros((len(x), 3))
    for i in (len(run) - 1, len(run)):
        kind[i], direction[i] = _TANGENT, (1.0, 0.0, 0.0)
    return LineSource.make(
        "boundary", "deck edge", np.column_stack([x, y, np.full(len(x), DEPTH)]),
        plane=((0, 0, 1), DEPTH), boundary=ah.BoundaryKind.END, kind=kind, direction=direction,
    )  # fmt: skip


def _diagonal(t: float) -> LineSource:
    """Along the skeg, at a part of its breadth and parallel to its centre plane.

    For t = 0 it is the lower edge.
    """
    x = _after_stations()
    x = x[(x >= AFT) & (x <= FORE)]
    z = roof(x) - (roof(x) - edge(x)) * bump(np.array(t))
    points = np.column_stack([x, middle(x, z) + WIDTH * t, z])
    normal = np.array([-RUN, 1.0, -LEAN]) / np.sqrt(1.0 + RUN * RUN + LEAN * LEAN)
    return LineSource.make(
        "diagonals", f"DIA {t:g}", points, plane=(normal, float(points[0] @ normal)), placed=True
    )


def _lines() -> list[LineSource]:
    points, kind, direction = _section(TRANSOM)
    lines = [
        _profile(),
        _deck_edge(),
        LineSource.make(
            "boundary", "transom", points, plane=((1, 0, 0), TRANSOM), kind=kind,
            direction=direction, boundary=ah.BoundaryKind.END, placed=True,
        ),
    ]  # fmt: skip
    for x in _after_stations().tolist():
        points, kind, direction = _section(x)
        name = f"ST {x * 20.0 / LENGTH:.4g}"
        lines.append(
            LineSource.make("sections", name, points, kind=kind, direction=direction, placed=True)
        )
    lines += [_diagonal(t) for t in (-0.5, 0.0, 0.5)]
    z = np.array([1.0, 3.0, 6.0, 9.0, 12.0, 15.0, 18.0, 22.0])
    lines += [piece for number in _STATIONS for piece in station(number, z)]
    return lines


@cache
def twin_skeg_ship() -> ah.Hull:
    """Make the net; tests only read it."""
    ship = ah.Particulars("Twin skegs", LENGTH, 2.0 * HALF, DEPTH, DRAUGHT, "closed")
    links = [ah.Association("boundary", "sections"), ah.Association("sections", "diagonals")]
    return ah.Hull.from_lines(_lines(), particulars=ship, associations=links)
