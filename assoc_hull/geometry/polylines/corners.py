"""Corners of plane polylines, and the knuckle lines that corners of neighbouring lines make.

Over a corner a line turns by the same angle however short the stretch looked at; over a bend by
half of it on half the stretch. So corners are found at two scales. `join_corners` follows them
from line to line.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.polylines.operations import (
    cumulative_lengths,
    project_on_polyline,
    resample,
)

__all__ = [
    "ChainRule",
    "Corner",
    "CornerRule",
    "find_corners",
    "join_corners",
    "marked_corners",
    "with_marked",
]


@attrs.frozen
class CornerRule:
    """What counts as a corner.

    Attributes
    ----------
    least_deg : float
        Least turn over `stretch`.
    stretch : float, m
        The longer stretch; where the points lie wide apart it is doubled until each half of it
        holds two or more.
    share : float
        Part of the turn that half the stretch must show.
    window : float, m
        The sides of a corner are fitted over at most this.
    """

    least_deg: float = 4.0
    stretch: float = 0.6
    share: float = 0.8
    window: float = 2.0


@attrs.frozen(eq=False)
class Corner:
    """A corner of a polyline.

    Attributes
    ----------
    at : float, m
        Length along the polyline.
    place : (2,), m
        Intersection of the fitted sides.
    turn_deg : float
        Angle between them.
    share : float
        Part of the turn over the stretch that half of it shows.
    stretch : float, m
        The stretch it was found on.
    uncertainty : float, m
        Standard deviation of its place along the polyline.
    """

    at: float
    place: FloatArray
    turn_deg: float
    share: float
    stretch: float
    uncertainty: float = 0.0

    def __attrs_post_init__(self) -> None:
        freeze(self.place)


def find_corners(points: FloatArray, noise: float, rule: CornerRule | None = None) -> list[Corner]:
    """Find the corners of a polyline (n, 2), m, in order along it; `noise` (m) is its scatter."""
    wanted = rule or CornerRule()
    length = cumulative_lengths(points)
    seen: list[_Scale] = []
    found: list[tuple[float, float, float]] = []
    for level in range(5):
        half = 0.5 * wanted.stretch * 2.0**level
        if length[-1] < 2.5 * half:
            break
        seen.append(_look(points, length, half, level, noise))
        if seen[-1].fits.any():
            found = _add(found, _peaks(seen, wanted, noise), half)
    found.sort()
    places = [each[0] for each in found]
    refined = [
        _refine(points, length, at, share, half, places, noise, wanted) for at, share, half in found
    ]
    lone = [
        each for each in _lone_turns(points, length, seen, noise)
        if all(abs(each.at - other.at) > 0.5 * other.stretch for other in refined)
    ]  # fmt: skip
    return sorted(refined + lone, key=lambda each: each.at)


_LONE_DEG, _LONE = 30.0, 0.8
"""A point that turns by so much, and by this part of all that it and two on either side turn."""

_SHARP_DEG = 75.0
"""Nobody draws a bend by one point that turns by so much: a plumb stem on a level keel."""

_BESIDE = 7
"""A scale sees a turn that it may look at throughout so many samples, half of half its stretch."""


def _lone_turns(
    points: FloatArray, length: FloatArray, seen: list[_Scale], noise: float
) -> list[Corner]:
    """Give corners where points lie too wide apart for any scale: straight sides and one turn."""
    from scipy.ndimage import minimum_filter1d

    step, inner = np.diff(points, axis=0), length[1:-1]
    before, after = step[:-1], step[1:]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turn = np.abs(np.arctan2(cross, (before * after).sum(axis=1)))
    whole = np.convolve(turn, np.ones(5))[2:-2]
    lone = (turn >= np.deg2rad(_LONE_DEG)) & (turn >= _LONE * whole)
    lone |= turn >= np.deg2rad(_SHARP_DEG)
    # Beside a short step the scatter of the points alone makes a turn.
    size = np.diff(length)
    lone &= turn * np.minimum(size[:-1], size[1:]) > 4.0 * np.sqrt(6.0) * noise
    for scale in seen:
        nearest = np.searchsorted(scale.at, inner).clip(max=len(scale.at) - 1)
        # Points that lie near on one side only let a scale look beside the turn, not at it.
        looks = minimum_filter1d(scale.fits, _BESIDE)[nearest]
        # Nearer to an end it sees one side only.
        lone &= ~(looks & (inner > scale.half) & (inner < length[-1] - scale.half))
    return [
        Corner(float(inner[i]), points[i + 1].copy(), float(np.rad2deg(turn[i])), 1.0, 0.0, noise)
        for i in np.flatnonzero(lone).tolist()
    ]


@attrs.frozen(eq=False)
class _Scale:
    """What is seen at one scale: turns over both stretches, and where it may be looked at."""

    half: float
    at: FloatArray
    wide: FloatArray
    narrow: FloatArray
    share: FloatArray
    fits: np.typing.NDArray[np.bool_]


def _look(points: FloatArray, length: FloatArray, half: float, level: int, noise: float) -> _Scale:
    from scipy.ndimage import maximum_filter1d

    at = np.arange(0.0, length[-1], half / 12.0)
    line = resample(points, at)
    wide, narrow = _turn(line, 12), _turn(line, 6)
    facet = np.clip(np.searchsorted(length, at, "right") - 1, 0, len(length) - 2)
    widest = maximum_filter1d(np.diff(length)[facet], 25)
    share = maximum_filter1d(narrow, 13) / np.maximum(wide, 1e-12)
    fits = widest <= 0.75 * half
    # Coarser than needed only where the scatter of the points asks for it.
    fits &= (widest > 0.36 * half) | (level == 0) | (_doubt(noise, 0.5 * half) > np.deg2rad(0.25))
    return _Scale(half, at, wide, narrow, share, fits)


def _doubt(noise: float, half: float) -> float:
    """Give the standard deviation (rad) of the turn over half the stretch."""
    return float(np.sqrt(6.0) * noise / (0.5 * half))


def _peaks(seen: list[_Scale], rule: CornerRule, noise: float) -> list[tuple[float, float, float]]:
    """Give (place, share, half stretch) of the corners seen at the last scale.

    A finer scale at which the place is plainly a bend speaks against it.
    """
    from scipy.ndimage import maximum_filter1d

    now = seen[-1]
    least = float(np.deg2rad(rule.least_deg))
    peak = (now.wide >= maximum_filter1d(now.wide, 25)) & (now.wide > least)
    # A bend shows half of its turn: what is more must be more than scatter makes of it.
    peak &= (now.share - 0.5) * now.wide > 4.0 * _doubt(noise, now.half)
    peak &= (now.share > rule.share) & now.fits
    for finer in seen[:-1]:
        nearest = np.searchsorted(finer.at, now.at).clip(max=len(finer.at) - 1)
        wide = maximum_filter1d(finer.wide, 25)[nearest]
        share = maximum_filter1d(finer.narrow, 25)[nearest] / np.maximum(wide, 1e-12)
        margin = 3.0 * _doubt(noise, finer.half) / np.maximum(wide, 1e-12)
        peak &= ~(finer.fits[nearest] & (share < rule.share - margin))
    number = np.flatnonzero(peak)
    keep = np.append(True, np.diff(number) > 12)[: len(number)]
    found = [
        (float(now.at[_top(now.narrow, i)]), float(now.share[i]), now.half)
        for i in number[keep].tolist()
    ]
    # Nearer to an end both sides cannot be seen.
    end = float(now.at[-1])
    return [each for each in found if 0.9 * now.half < each[0] < end - 0.9 * now.half]


def _add(
    found: list[tuple[float, float, float]], more: list[tuple[float, float, float]], half: float
) -> list[tuple[float, float, float]]:
    """Add corners that no finer scale has shown."""
    return found + [e for e in more if all(abs(e[0] - old[0]) > half for old in found)]


def _top(narrow: FloatArray, i: int) -> int:
    """Give the middle of the highest stretch of the narrow turn near a place."""
    low = max(0, i - 6)
    part = narrow[low : i + 7]
    high = np.flatnonzero(part > 0.95 * part.max())
    return low + int(high[len(high) // 2])


def _turn(line: FloatArray, many: int) -> FloatArray:
    """Give the angle between straight lines fitted to the `many` steps before and after."""
    weight = np.arange(many + 1) - 0.5 * many
    slope = np.column_stack([np.convolve(column, weight[::-1], "valid") for column in line.T])
    turn = np.zeros(len(line))
    if len(slope) <= many:
        return turn
    before, after = slope[:-many], slope[many:]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turn[many : many + len(cross)] = np.abs(np.arctan2(cross, (before * after).sum(axis=1)))
    return turn


def _refine(
    points: FloatArray,
    length: FloatArray,
    at: float,
    share: float,
    half: float,
    others: list[float],
    noise: float,
    rule: CornerRule,
) -> Corner:
    """Take the point that turns nearly all by itself, else intersect curves fitted to the sides."""
    sharp = _sharpest(points, length, at, half)
    if sharp is not None:
        number, turned = sharp
        place, doubt = points[number].copy(), 0.0 if turned >= _PLAIN_DEG else noise
        return Corner(float(length[number]), place, turned, share, 2.0 * half, doubt)
    near = min([abs(other - at) for other in others if abs(other - at) > half], default=np.inf)
    best: tuple[float, float, FloatArray, float, float] | None = None
    for window in (rule.window, 0.5 * rule.window, 0.25 * rule.window):
        reach = min(max(window, 3.0 * half), 0.8 * near)
        fitted = _intersect_sides(points, length, at, reach, 0.2 * half)
        if fitted is None:
            continue
        if best is None or fitted[0] < 0.7 * best[0]:
            best = fitted
        if best[0] <= 1.5 * max(noise, 1e-4):
            break
    foot, off = (at, np.inf) if best is None else project_on_polyline(points, length, best[2])
    if best is None or off > max(6.0 * noise, 0.02):
        place = resample(points, np.array([at]))[0]
        turn = float(
            np.rad2deg(_turn(resample(points, at + half * np.linspace(-1, 1, 25)), 12)[12])
        )
        return Corner(at, place, turn, share, 2.0 * half, 0.5 * half)
    doubt = best[4] * max(noise, best[0])
    return Corner(foot, best[2], best[3], share, 2.0 * half, doubt)


_PLAIN_DEG, _SLIGHT_DEG = 30.0, 8.0
"""A point that turns by so much, of the second at least where it lies between others, is taken for
the corner where it has ..."""

_ALONE = 0.8
"""... this part of all that points around turn: facets of a bend turn alike."""


def _sharpest(
    points: FloatArray, length: FloatArray, at: float, half: float
) -> tuple[int, float] | None:
    """Give the point near a place that turns nearly all by itself, and its turn in degrees."""
    away = np.abs(length[1:-1] - at)
    if not (away < half).any():
        return None
    step = np.diff(points, axis=0)
    before, after = step[:-1], step[1:]
    cross = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turn = np.abs(np.arctan2(cross, (before * after).sum(axis=1)))
    best = int(np.where(away < half, turn, -1.0).argmax())
    turned = float(np.rad2deg(turn[best]))
    if turned >= _PLAIN_DEG and turn[best] >= _ALONE * turn[away < half].sum():
        return best + 1, turned
    # Points on either side that hardly turn show that a slight turn is no bend.
    around = np.flatnonzero(away < 2.0 * half)
    between = around[0] < best < around[-1] and turned >= _SLIGHT_DEG
    return (best + 1, turned) if between and turn[best] >= _ALONE * turn[around].sum() else None


def _intersect_sides(
    points: FloatArray, length: FloatArray, at: float, reach: float, skip: float
) -> tuple[float, float, FloatArray, float, float] | None:
    """Give (residual, shift along, place, turn in degrees, doubt) of two fitted sides.

    The doubt is the standard deviation of the place along, per scatter of the points: a parabola
    is known at its end to 3 times the scatter over the root of the number of points.
    """
    ends = resample(points, np.array([at - reach, at, at + reach]).clip(0.0, length[-1]))
    ahead = (ends[2] - ends[0]) / max(float(np.linalg.norm(ends[2] - ends[0])), 1e-12)
    frame = np.array([ahead, [-ahead[1], ahead[0]]])
    local = (points - ends[1]) @ frame.T
    shift = 0.0
    for _ in range(3):
        sides = []
        for sign in (-1.0, 1.0):
            away = sign * (length - at - shift)
            mine = (away > skip) & (away < reach)
            if mine.sum() < 2:
                return None
            t, u = local[mine].T
            order = 2 if mine.sum() >= 4 else 1
            sides.append((np.polyfit(t, u, order), t, u))
        roots = np.roots(np.polysub(sides[1][0], sides[0][0]))
        real = roots[np.abs(roots.imag) < 1e-9].real
        if not len(real):
            return None
        shift = float(real[np.argmin(np.abs(real - shift))])
        if abs(shift) > reach:
            return None
    t0 = shift
    slopes = [float(np.polyval(np.polyder(side[0]), t0)) for side in sides]
    turn = abs(np.arctan(slopes[1]) - np.arctan(slopes[0]))
    off = np.concatenate([np.polyval(c, t) - u for c, t, u in sides])
    spread = 3.0 * np.sqrt(sum(1.0 / len(t) for _, t, _ in sides))
    doubt = float(spread / max(abs(slopes[1] - slopes[0]), 1e-6))
    place = ends[1] + np.array([t0, float(np.polyval(sides[0][0], t0))]) @ frame
    return float(np.sqrt((off * off).mean())), t0, place, float(np.rad2deg(turn)), doubt


_MARKED = 1e-3
"""A mark this close (m) to a point of a polyline means the point."""

_SAME_CORNER = 0.3
"""A corner that was found this close (m) along the line to a marked one is the marked one."""


def marked_corners(points: FloatArray, marks: FloatArray) -> list[Corner]:
    """Give the points of a polyline (n, 2), m, that are marked as corners, whatever they turn by.

    Marks (k, 2), m, at its ends or beside it mean none of its points.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.polylines.corners import marked_corners
    >>> bent = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 1.0]])
    >>> [round(each.turn_deg) for each in marked_corners(bent, np.array([[1.0, 0.0], [0.0, 0.0]]))]
    [45]
    """
    if not len(marks) or len(points) < 3:
        return []
    away = np.linalg.norm(points[:, None] - marks, axis=2)
    at = np.unique(away.argmin(axis=0)[away.min(axis=0) < _MARKED])
    length, step = cumulative_lengths(points), np.diff(points, axis=0)
    found = []
    for i in at[(at > 0) & (at < len(points) - 1)].tolist():
        (a, b), (c, d) = step[i - 1], step[i]
        turn = float(np.degrees(np.abs(np.arctan2(a * d - b * c, a * c + b * d))))
        found.append(Corner(float(length[i]), points[i].copy(), turn, 1.0, 0.0))
    return found


def with_marked(found: list[Corner], marked: list[Corner]) -> list[Corner]:
    """Put marked corners before those that were found elsewhere."""
    others = [
        each for each in found if all(abs(each.at - mark.at) > _SAME_CORNER for mark in marked)
    ]
    return [*marked, *others]


# --------------------------------------------------------------------------------------
# Corners of neighbouring lines joined to knuckle lines.


@attrs.frozen
class ChainRule:
    """What counts as a knuckle line.

    Attributes
    ----------
    lines : int
        Neighbouring lines that must agree.
    drift : float
        How far a knuckle may move from line to line, as a part of their distance ...
    slack : float, m
        ... plus this; beyond three lines it is measured from where the last two lead.
    ratio : float
        By which factor its turn may change.
    """

    lines: int = 3
    drift: float = 0.5
    slack: float = 0.3
    ratio: float = 1.6


def join_corners(
    offsets: FloatArray, corners: list[list[Corner]], rule: ChainRule | None = None
) -> list[tuple[tuple[int, int], ...]]:
    """Join corners of neighbouring lines, which stand at `offsets` (n,), m, ascending.

    For each knuckle line its corners, as (line, number on it); each corner is in one at most.
    """
    wanted = rule or ChainRule()
    chains: list[list[tuple[int, int]]] = []
    for line in range(len(offsets)):
        open_ends = [chain for chain in chains if chain[-1][0] == line - 1]
        pairs = [
            (away, i, j)
            for i, chain in enumerate(open_ends)
            for j, corner in enumerate(corners[line])
            if (away := _misfit(chain, corner, line, offsets, corners, wanted)) < 1.0
        ]
        taken: set[int] = set()
        grown: set[int] = set()
        for _, i, j in sorted(pairs):
            if i not in grown and j not in taken:
                open_ends[i].append((line, j))
                grown.add(i)
                taken.add(j)
        chains += [[(line, j)] for j in range(len(corners[line])) if j not in taken]
    return [tuple(chain) for chain in chains if len(chain) >= wanted.lines]


def _misfit(
    chain: list[tuple[int, int]],
    corner: Corner,
    line: int,
    offsets: FloatArray,
    corners: list[list[Corner]],
    rule: ChainRule,
) -> float:
    """Give the distance from where a chain leads, as a part of what is allowed."""
    last = corners[chain[-1][0]][chain[-1][1]]
    low, high = sorted((last.turn_deg, corner.turn_deg))
    if high > rule.ratio * low + 1.0:
        return np.inf
    gap = float(offsets[line] - offsets[line - 1])
    guess = last.place
    if len(chain) > 1:
        before = corners[chain[-2][0]][chain[-2][1]]
        step = float(offsets[line - 1] - offsets[chain[-2][0]])
        guess = last.place + (last.place - before.place) * min(gap / step, 2.0)
    away = min(float(np.linalg.norm(corner.place - guess)),
               float(np.linalg.norm(corner.place - last.place)))  # fmt: skip
    return away / (rule.drift * gap + rule.slack)
