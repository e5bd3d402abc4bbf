"""What a chord spline asks of its points: apart, in no sharp turn, near their chords."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.checked_input import bearable
from assoc_hull.geometry.classical.checks import figure, finite, wrap
from assoc_hull.geometry.classical.chord_spline_solve import Chords
from assoc_hull.geometry.curves import FloatArray

__all__ = [
    "check_clamps",
    "check_slopes",
    "check_turns",
    "checked_points",
    "chords_of",
    "clamped",
    "place_of",
]

_STEEP = 0.35
"""Slope to a chord beyond which a batten is no longer bent but little."""

_SAME = 1e-9
"""Of the extent of the points: what lies closer is one point."""


def place_of(number: int, count: int) -> str:
    """Name a curve among many; a single one needs no name."""
    return f"curve {number}" if count > 1 else ""


def checked_points(points: ArrayLike, where: str) -> FloatArray:
    """Take points (n, 2), m: two or more, neighbours apart."""
    try:
        found = bearable(finite(points, "spline", (None, 2)), "spline")
    except GeometryError as error:
        raise error.at(where) from None
    if len(found) < 2:
        raise GeometryError("spline: at least 2 points", "give more", {"points": len(found)}, where)
    step = np.hypot(*np.diff(found, axis=0).T)
    close = step <= _SAME * float(np.hypot(*np.ptp(found, axis=0)))
    if close.any():
        first = int(np.argmax(close))
        raise GeometryError(
            f"spline: coincident points {first}", "leave one of the two out", {"index": first},
            where,
        )  # fmt: skip
    return found


def clamped(angle: float | None) -> float:
    """Take the direction of an end, rad; nan stands for a free one."""
    return np.nan if angle is None else float(finite(angle, "spline", ()))


def chords_of(points: Sequence[FloatArray], clamp: FloatArray) -> Chords:
    """Take the chords of splines; clamped directions are turned next to their chord."""
    sizes = np.array([len(each) for each in points])
    start = np.concatenate([[0], np.cumsum(sizes)])
    owner = np.repeat(np.arange(len(points)), sizes)
    steps = [np.diff(each, axis=0) for each in points]
    length = np.concatenate([np.hypot(*each.T) for each in steps])
    angle = np.concatenate([_unwrapped(each) for each in steps])
    begin = np.delete(np.arange(start[-1]), start[1:] - 1)
    number = np.arange(len(points))
    beside = angle[np.stack([start[:-1] - number, start[1:] - number - 2], axis=1)]
    return Chords(start, owner, begin, length, angle, beside + wrap(clamp - beside))


def _unwrapped(steps: FloatArray) -> FloatArray:
    angle = np.arctan2(steps[:, 1], steps[:, 0])
    turns = wrap(np.diff(angle))
    return np.asarray(angle[0] + np.concatenate([[0.0], np.cumsum(turns)]))


def check_turns(chords: Chords) -> None:
    """Refuse turns of more than 90 degrees between neighbouring chords."""
    turn = np.degrees(np.abs(np.diff(chords.angle)))
    # The next chord of the same spline begins where this one ends.
    turn[np.diff(chords.begin) > 1] = 0.0
    if (turn > 90.0 + 1e-9).any():
        at = int(np.argmax(turn > 90.0 + 1e-9))
        spline = int(chords.owner[chords.begin[at]])
        own = at - int(chords.start[spline]) + spline
        raise GeometryError(
            f"spline: turn of {figure(turn[at])} deg between chords {own},{own + 1}; limit 90 "
            "(insert a knuckle or points)", "cut the curve in two there, or give more points",
            {"turn_deg": float(turn[at]), "chord": own, "limit_deg": 90.0},
            place_of(spline, len(chords.start) - 1),
        )  # fmt: skip


def check_clamps(chords: Chords) -> None:
    """Refuse ends clamped at more than 45 degrees to their chord, before anything is solved."""
    number = np.arange(len(chords.start) - 1)
    first, last = chords.start[:-1], chords.start[1:] - 1
    phi = np.full(len(chords.owner), np.nan)
    phi[first], phi[last] = chords.clamp.T
    size = np.zeros(len(phi))
    for node, chord in ((first, first - number), (last, last - number - 1)):
        size[node] = _steepness(phi[node] - chords.angle[chord])
    _refuse_steep(chords, size)


def check_slopes(chords: Chords, phi: FloatArray) -> list[tuple[str, ...]]:
    """Refuse slopes above 1, and tell of those above .35, spline by spline."""
    size = np.zeros(len(phi))
    for node in (chords.begin, chords.begin + 1):
        np.maximum.at(size, node, _steepness(phi[node] - chords.angle))
    _refuse_steep(chords, size)
    notes: list[tuple[str, ...]] = [()] * (len(chords.start) - 1)
    own = np.arange(len(phi)) - chords.start[chords.owner]
    for at in np.flatnonzero(size > _STEEP).tolist():
        said = (
            f"spline: slope {figure(size[at])} to the chord at node {own[at]} exceeds 0.35, up to "
            "which a batten is bent but little"
        )
        notes[chords.owner[at]] = (*notes[chords.owner[at]], said)
    return notes


def _steepness(away: FloatArray) -> FloatArray:
    """Give amounts of slopes: infinite where a direction runs back, 0 where none is given."""
    steep = np.where(np.abs(away) < 0.5 * np.pi, np.abs(np.tan(away)), np.inf)
    return np.asarray(np.where(np.isnan(away), 0.0, steep))


def _refuse_steep(chords: Chords, size: FloatArray) -> None:
    if not (size > 1.0 + 1e-9).any():
        return
    at = int(np.argmax(size > 1.0 + 1e-9))
    own = at - int(chords.start[chords.owner[at]])
    raise GeometryError(
        f"spline: slope {figure(size[at])} to the chord at node {own} exceeds 1",
        "give points closer together there", {"slope": float(size[at]), "node": own},
        place_of(int(chords.owner[at]), len(chords.start) - 1),
    )  # fmt: skip
