"""One hull of digitised lines that may be of several side by side: counted, refused or taken out.

Lines are in ship axes, m, the middle of the ship at y = 0. The hull that is meant is cut out and
its centre plane moved to y = 0; buttocks get the names of their new places. Lines of one hull stay
as they are.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.io.lines.raw_lines import RawPiece, boundary_name
from assoc_hull.io.lines.several_hulls import (
    FoundHulls,
    HullChoice,
    Section,
    find_hulls,
    refuse_asymmetric,
    refuse_missing,
    refuse_several,
    sections_within,
    tell_which,
    top_below_bridge,
    water_levels,
)
from assoc_hull.io.reports import Notebook

__all__ = ["take_one_hull"]

_WHERE = "the lines"

_FLAT = 0.02
"""A piece whose points scatter less than this (m) along an axis lies across it."""

_NOISE = 5e-3
"""Sides of a hull of 100 m that differ by less are alike; of a shorter one in proportion."""

_BESIDE = 0.02
"""A half hull that begins this part of the breadth off y = 0 lies beside it."""


def take_one_hull(
    raw: list[RawPiece], choice: HullChoice, factor: float, book: Notebook, sign: float = 1.0
) -> list[RawPiece]:
    """Give the pieces (m) of one hull about y = 0.

    `factor` is m over the unit of the file, `sign` -1 where its y points to starboard.

    Raises
    ------
    BadInputError
        Several hulls and none is chosen, or a half hull beside y = 0; a chosen one that is not
        symmetric about its centre plane.
    """
    sections = _sections(raw)
    every = np.concatenate([each.points for each in raw])
    low, high = float(every[:, 2].min()), float(every[:, 2].max())
    found = find_hulls(sections, water_levels(low, high, choice))
    given, unit = choice.place(factor), sign / factor
    if given is None:
        refuse_several(found, f"{unit * found.centre:.7g}", low, f"in {_WHERE}")
        _refuse_beside(sections, found, unit)
        return raw
    centre = sign * given
    if found.bridge is not None:
        _refuse_above(found.bridge - low, choice.depth)
    limits, top = found.limits(centre), top_below_bridge(found, low, choice, _WHERE, book)
    mine = sections_within(sections, limits)
    if not mine:
        refuse_missing(unit * centre, unit * found.centre, _WHERE)
    across = np.concatenate([part[..., 0].ravel() for _, part in mine]) - centre
    # Half a demihull has no mirror image to be compared with.
    if min(across.max(), -across.min()) > 0.1 * np.ptp(across):
        size = float(np.ptp(every[:, 0]))
        noise = max(_NOISE * min(1.0, size / 100.0), 0.5 * _sag(mine))
        refuse_asymmetric(mine, centre, top, noise, (unit, 0.0), f"in {_WHERE}")
    tell_which(found, unit * centre, centre, _WHERE, book)
    return [part for each in raw for part in _moved(each, (limits[0], limits[1], top), centre)]


def _sections(raw: list[RawPiece]) -> list[Section]:
    """Give the straight pieces of all sections, by x."""
    found: dict[float, list[FloatArray]] = {}
    for each in raw:
        points = each.points
        if boundary_name(each.line) is not None or len(points) < 2 or np.ptp(points[:, 0]) > _FLAT:
            continue
        x = round(float(np.median(points[:, 0])), 3)
        found.setdefault(x, []).append(np.stack([points[:-1, 1:], points[1:, 1:]], axis=1))
    return [(x, np.concatenate(found[x])) for x in sorted(found)]


def _sag(sections: list[Section]) -> float:
    """Give how far the lines may lie off their chords, m, at 19 points of 20."""
    found = []
    for _, part in sections:
        one, other = part[:-1], part[1:]
        joined = (one[:, 1] == other[:, 0]).all(axis=1)
        a, b, c = one[joined, 0], one[joined, 1], other[joined, 1]
        chord = np.maximum(np.sqrt(((c - a) ** 2).sum(axis=1)), 1e-12)
        cross = (c - a)[:, 0] * (b - a)[:, 1] - (c - a)[:, 1] * (b - a)[:, 0]
        found.append(np.abs(cross) / chord)
    every = np.concatenate(found) if found else np.zeros(0)
    return float(np.percentile(every, 95)) if len(every) else 0.0


def _refuse_beside(sections: list[Section], found: FoundHulls, unit: float) -> None:
    """Refuse half a hull whose centre plane is not y = 0: all its sections begin at one other y."""
    if found.count > 1 or len(sections) < 3:
        return
    breadth = max(float(np.abs(part[..., 0]).max()) for _, part in sections)
    begin = np.array([_lowest(part) for _, part in sections])
    middle = float(np.median(begin))
    if abs(middle) > _BESIDE * breadth and np.abs(begin - middle).max() < 1e-3 * breadth:
        raise BadInputError(
            f"all {len(sections)} sections begin {middle:.4g} m off the centre plane",
            f"in {_WHERE}", f"of half a hull that lies there give centre={unit * middle:.7g}",
        )  # fmt: skip


def _lowest(part: FloatArray) -> float:
    """Give the y nearest to the centre plane among the lowest points of a section."""
    points = part.reshape(-1, 2)
    low = points[points[:, 1] <= points[:, 1].min() + 1e-6]
    return float(low[np.abs(low[:, 0]).argmin(), 0])


def _refuse_above(bridge: float, depth: float | None) -> None:
    """Refuse a depth above that of the bridge deck, m: lines would be cut across it."""
    if depth is not None and depth > bridge + 1e-9:
        raise BadInputError(
            f"the bridge deck hangs down to {bridge:.4g} m, and depth is {depth:.4g} m",
            f"in {_WHERE}", f"give depth={bridge:.4g} or less",
        )  # fmt: skip


def _moved(piece: RawPiece, bounds: tuple[float, float, float], centre: float) -> list[RawPiece]:
    """Give what of a piece lies within bounds of y and below a height, about its centre plane."""
    runs = [piece.points]
    for axis, bound, side in ((1, bounds[0], 1.0), (1, bounds[1], -1.0), (2, bounds[2], -1.0)):
        if np.isfinite(bound):
            runs = [kept for run in runs for kept in _kept(run, axis, bound, side)]
    marks, shift = piece.knuckles, np.array([0.0, centre, 0.0])
    inside = (marks[:, 1] > bounds[0]) & (marks[:, 1] < bounds[1]) & (marks[:, 2] <= bounds[2])
    name = piece.line
    if boundary_name(name) is None and np.ptp(piece.points[:, 1]) < _FLAT:
        name = f"BTK {abs(float(np.median(piece.points[:, 1])) - centre):.6g}"
    return [RawPiece(name, run - shift, piece.where, marks[inside] - shift) for run in runs]


def _kept(points: FloatArray, axis: int, bound: float, side: float) -> list[FloatArray]:
    """Give the parts of a polyline on one side of a plane, cut at it."""
    off = side * (points[:, axis] - bound)
    out: list[list[FloatArray]] = [[]]
    for i in range(len(points)):
        if i and (off[i] > 0.0) != (off[i - 1] > 0.0) and off[i] * off[i - 1] != 0.0:
            place = points[i - 1] + off[i - 1] / (off[i - 1] - off[i]) * (points[i] - points[i - 1])
            place[axis] = bound
            out[-1].append(place)
            if off[i] < 0.0:
                out.append([])
        if off[i] >= 0.0:
            out[-1].append(points[i])
        elif out[-1] and off[i - 1] == 0.0:
            out.append([])
    # What only touches the plane has no point within.
    runs = [np.array(each) for each in out if len(each) > 1]
    return [run for run in runs if (side * (run[:, axis] - bound) > 0.0).any()]
