"""A fast ship with a flat run and a raked transom, by formula: its lines, and its true shell.

The half-breadth is y(x, z) between keel and deck; sections of the after body are nearly square, so
that waterlines leave the bottom of the run almost athwartships. The transom is the plane
x = -rake (z - FOOT). The shell is triangulated from the formula, without any net.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from scipy.optimize import brentq

import assoc_hull as ah
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, Particulars
from tests.shell_area import area_below

__all__ = ["BREADTH", "DEPTH", "DRAUGHT", "FOOT", "LENGTH", "half_breadth", "raked_ship", "shell"]

LENGTH, BREADTH, DRAUGHT, DEPTH, FOOT = 140.0, 18.0, 6.0, 12.0, 5.0
_RUN, _MIDDLE, _FLARE = 55.0, 70.0, 4.0
_END = BoundaryKind.END


def keel(x: FloatArray | float) -> FloatArray:
    """z of the keel, m: level, then a parabola up to the transom."""
    return np.asarray(FOOT * np.clip((_RUN - np.asarray(x)) / _RUN, 0.0, None) ** 2)


def stem(z: FloatArray | float) -> FloatArray:
    """x of the stem, m."""
    return np.asarray(LENGTH + _FLARE * np.asarray(z) / DEPTH)


def half_breadth(x: FloatArray, z: FloatArray) -> FloatArray:
    """y of the shell, m."""
    fore = np.clip((x - _MIDDLE) / (stem(z) - _MIDDLE), 0.0, 1.0)
    aft = np.clip((_MIDDLE - x) / _MIDDLE, 0.0, 1.0)
    side = 0.5 * BREADTH * (1.0 - fore**2.2) * (1.0 - 0.25 * aft**2)
    power = 2.2 + 1.8 * aft
    up = np.clip((DEPTH - z) / (DEPTH - keel(x)), 0.0, 1.0)
    return np.asarray(side * (1.0 - up**power) ** (1.0 / power))


def shell(rake: float, draught: float, count: int = 500) -> float:
    """Area (m2) of both sides below a draught, transom to stem, by half a million triangles."""
    along = np.linspace(0.0, 1.0, count + 1)[:, None]
    up = np.linspace(0.0, 1.0, count + 1) ** 2.5
    x = along * LENGTH + 0.0 * up
    for _ in range(30):
        z = keel(x) + (DEPTH - keel(x)) * up
        aft = -rake * (z - FOOT)
        x = aft + along * (stem(z) - aft)
    z = keel(x) + (DEPTH - keel(x)) * up
    return 2.0 * area_below(np.stack([x, half_breadth(x, z), z], axis=-1), draught)


def _section(x: float, low: float, high: float, cut: bool) -> FloatArray:
    foot = float(keel(x))
    part = np.concatenate([[0.0, 1e-5, 1e-4, 3e-4, 1e-3, 3e-3], np.linspace(0.0, 1.0, 60) ** 2.5])
    z = np.unique(foot + (DEPTH - foot) * part)
    z = np.linspace(low, high, 30) if cut and low > foot else z[z <= high]
    if z[-1] < high:
        z = np.append(z, high)
    x_all = np.full(len(z), x)
    return np.column_stack([x_all, half_breadth(x_all, z), z])


def _boundaries(rake: float, low: float) -> list[LineSource]:
    """Profile, deck edge and transom, whose foot is at z = low."""
    x_low, x_top = -rake * (low - FOOT), -rake * (DEPTH - FOOT)
    bottom = np.append(x_low, np.linspace(max(x_low, 0.0) + 1.0, LENGTH, 140))
    rise = np.linspace(0.0, DEPTH, 30)[1:]
    profile = np.concatenate(
        [np.column_stack([bottom, 0.0 * bottom, keel(bottom)]),
         np.column_stack([stem(rise), 0.0 * rise, rise])]
    )  # fmt: skip
    kind = [0] * len(profile)
    kind[len(bottom) - 1] = 2
    x = np.append(np.append(x_top, np.linspace(max(x_top, 0.0) + 1.0, LENGTH, 60)),
                  LENGTH + _FLARE * np.array([0.25, 0.5, 0.75, 1.0]))  # fmt: skip
    deck = np.column_stack([x, half_breadth(x, np.full(len(x), DEPTH)), np.full(len(x), DEPTH)])
    part = np.concatenate([[0.0, 1e-5, 1e-4, 3e-4, 1e-3, 3e-3], np.linspace(0.0, 1.0, 60) ** 2.5])
    z = np.unique(low + (DEPTH - low) * part)
    edge = np.column_stack([-rake * (z - FOOT), half_breadth(-rake * (z - FOOT), z), z])
    edge[0, 1] = 0.0
    normal = np.array([1.0, 0.0, rake]) / np.hypot(1.0, rake)
    return [
        LineSource.make("boundary", "profile", profile, plane=((0, 1, 0), 0.0), boundary=_END,
                        kind=kind),
        LineSource.make("boundary", "deck edge", deck, plane=((0, 0, 1), DEPTH), boundary=_END),
        LineSource.make("boundary", "transom", edge, plane=(normal, float(normal @ edge[0])),
                        boundary=_END),
    ]  # fmt: skip


@cache
def raked_ship(rake: float, *, across: float | None = None, deck: str = "closed") -> ah.Hull:
    """The ship as a net: 20 stations, 11 waterlines, profile, deck edge, transom.

    `rake` is what the transom goes aft per m up; `across` (m): a station that the transom cuts.
    """
    low = float(brentq(lambda z: float(keel(-rake * (z - FOOT))) - z, 3.0, 8.0))
    lines = _boundaries(rake, low)
    stations = np.linspace(0.0, LENGTH, 21)[:-1].tolist()
    for x in sorted(stations if across is None else [*stations, across]):
        height = FOOT - x / rake if rake else FOOT
        if not -rake * (DEPTH - FOOT) <= x <= 0.0 and rake > 0.0 and x <= 0.0:
            continue
        cut = across is not None and x == across
        if x == 0.0:
            continue  # the transom passes there
        first = max(float(keel(x)), height) if cut and rake > 0.0 else float(keel(x))
        last = height if cut and rake < 0.0 else DEPTH
        lines.append(LineSource.make("sections", f"ST {x:g}", _section(x, first, last, cut)))
    for z in np.arange(1.0, 12.0).tolist():
        aft = _RUN - _RUN * np.sqrt(z / FOOT) if z < low else -rake * (z - FOOT)
        x = np.append(aft + (_MIDDLE - aft) * np.linspace(0.0, 1.0, 60) ** 2.5,
                      _MIDDLE + (stem(z) - _MIDDLE) * np.linspace(0.0, 1.0, 60)[1:])  # fmt: skip
        y = half_breadth(x, np.full(len(x), z))
        y[-1] = 0.0
        if z < low:
            y[0] = 0.0
        points = np.column_stack([x, y, np.full(len(x), z)])
        lines.append(LineSource.make("waterlines", f"WL {z:g}", points))
    links = [Association("boundary", "sections"), Association("boundary", "waterlines")]
    links.append(Association("sections", "waterlines"))
    ship = Particulars("fast ship", LENGTH, BREADTH, DEPTH, DRAUGHT, deck)
    return ah.Hull.from_lines(lines, particulars=ship, associations=links)
