"""The lines of a ship by boundary data, as the net takes them up.

Points of the definition are points of lines. Frames are smooth from knuckle to knuckle; contour and
straight intervals of knuckle lines keep their corners; waterlines follow the definition's splines
closely, their parallel part is straight. Flat ends are transoms.
"""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.creation.classical.outline import CLOSE, Outline, Piece, smooth, straight
from assoc_hull.creation.classical.seaking_sections import MidshipSection, outline_of
from assoc_hull.geometry.classical.knuckle_codes import KnuckleLine
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
from assoc_hull.geometry.classical.waterline_piece import Level
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

if TYPE_CHECKING:
    from assoc_hull.creation.classical.seaking import Seaking

__all__ = ["frame_name", "lines_of"]

_SAME = 1e-6
_DENSE = 4
"""Chords between two points of a waterline."""

_CLEAR = 0.05
"""Points of a line over x that are closer (m) to given ones are left out."""

_EVEN = 1e-3
"""Tolerance (m) of lines that are smooth through points."""


def frame_name(x: float) -> str:
    """Give the name of the section at x (m).

    Examples
    --------
    >>> from assoc_hull.creation.classical.seaking_lines import frame_name
    >>> frame_name(12.5)
    'FR 12.5'
    """
    return f"FR {x:g}"


def lines_of(ship: Seaking) -> tuple[LineSource, ...]:
    """Give all lines of a definition.

    Raises
    ------
    GeometryError
        A frame that cannot be built.
    """
    first, last = ship.ends
    ends = [x for x in (first, last) if float(ship.deck.at(x)[0]) > _SAME]
    inner = ship.frames[(ship.frames > first + _SAME) & (ship.frames < last - _SAME)]
    sections = [
        outline_of(each).section(
            frame_name(each.x),
            each.x,
            tolerance=CLOSE if isinstance(each, MidshipSection) else _EVEN,
        )
        for each in ship.sections(inner)
    ]
    transoms = [
        outline_of(ship.section(x)).boundary("transom" if x == first else "fore end", 0, x)
        for x in ends
    ]
    waterlines = [_waterline(each) for each in ship.waterlines]
    along = [_profile(ship), *_flat_of_bottom(ship)]
    along.append(_space_line("deck edge", ship.deck, BoundaryKind.END, ship.frames))
    along += [
        _space_line(each.name, each.line, BoundaryKind.KNUCKLE, ship.frames)
        for each in ship.knuckles
    ]
    return (*along, *transoms, *sections, *waterlines)


def _profile(ship: Seaking) -> LineSource:
    """From the transom, or the deck, along the keel to the stem head."""
    rows = np.concatenate([ship.keel.aft, ship.keel.forward])
    (half, top), (breadth, head) = ship.deck.at(ship.ends).tolist()
    # Below a flat end the contour has nothing to draw: that is the middle of the transom.
    rows = rows[_lowest(rows, ship.ends[0]) if half > _SAME else 0 :]
    rows = rows[: _lowest(rows, ship.ends[1]) + 1 if breadth > _SAME else len(rows)]
    if half <= _SAME and top > rows[0, 1] + _SAME:
        rows = np.concatenate([[(ship.ends[0], top)], rows])
    if breadth <= _SAME and head > rows[-1, 1] + _SAME:
        rows = np.concatenate([rows, [(ship.ends[1], head)]])
    pieces = [straight(a, b) for a, b in itertools.pairwise(rows)]
    return Outline.of(pieces).boundary("profile", 1, 0.0)


def _lowest(rows: FloatArray, x: float) -> int:
    """Give the row of a contour that stands lowest at an end."""
    there = np.flatnonzero(np.abs(rows[:, 0] - x) <= _SAME)
    return int(there[rows[there, 1].argmin()])


def _space_line(name: str, line: KnuckleLine, kind: BoundaryKind, frames: FloatArray) -> LineSource:
    """Give a line over x: corners at steps and at the ends of straight intervals.

    On parabolas it has a point at each frame as well: frames end there.
    """
    rows: list[tuple[float, FloatArray, bool]] = []
    hard = np.concatenate([[True], line.code <= 1, [True]])
    for i, x in enumerate(line.x.tolist()):
        if i and line.code[i - 1] == 0 and x > line.x[i - 1]:
            rows.append((x, line.v[i - 1], True))
        rows.append((x, line.v[i], bool(hard[i] or hard[i + 1])))
        if i < len(line.code) and line.code[i] > 1:
            inner = frames[(frames > x + _CLEAR) & (frames < line.x[i + 1] - _CLEAR)]
            rows += [(each, line.at(each), False) for each in inner.tolist()]
    points = np.array([[x, *v] for x, v, _ in rows])
    corner = np.array([each for *_, each in rows])
    step = np.diff(points, axis=0)
    step /= np.linalg.norm(step, axis=1)[:, None]
    # Straight intervals in one line need no corner between them.
    corner[1:-1] &= np.einsum("ij,ij->i", step[1:], step[:-1]) <= 1.0 - 1e-14
    corner[[0, -1]] = False
    kinds = np.where(corner, int(PointKind.KNUCKLE), 0).tolist()
    return LineSource.make("boundary", name, points, boundary=kind, kind=kinds, tolerance=_EVEN)


def _flat_of_bottom(ship: Seaking) -> list[LineSource]:
    """Give the edge of the flat of bottom, if there is one."""
    keel = ship.keel
    inner = keel.tangent[(keel.tangent[:, 0] > keel.x_a) & (keel.tangent[:, 0] < keel.x_b)]
    ends = [(x, float(keel.flat(x))) for x in (keel.x_a, keel.x_b)]
    rows = np.concatenate([ends[:1], inner, ends[1:]])
    if not (rows[:, 1] > _SAME).any():
        return []
    pieces = [straight(a, b) for a, b in itertools.pairwise(rows)]
    parallel = ship.parallel
    # A rise of floor makes the edge of the flat a corner.
    risen = parallel is not None and parallel.section.rise > 0.0
    kind = BoundaryKind.KNUCKLE if risen else BoundaryKind.FLAT
    return [Outline.of(pieces).boundary("flat of bottom", 2, 0.0, kind=kind)]


def _waterline(line: ParallelWaterline) -> LineSource:
    """Give a waterline by points between those given, straight where it is parallel."""
    pieces: list[Piece] = []
    for each in line.pieces:
        if isinstance(each, Level):
            level = each.half_breadth
            pieces.append(straight((each.first, level), (each.last, level)))
            continue
        given = line.points[
            (line.points[:, 0] >= each.first - _SAME) & (line.points[:, 0] <= each.last + _SAME), 0
        ]
        x = _between(given)
        points = np.column_stack([x, line.at(x)])
        angles = np.arctan(each.of(x[[0, -1]], 1))
        pieces.append(smooth(points, float(angles[0]), float(angles[1])))
    return Outline.of(pieces).waterline(f"WL {line.z:g}", line.z, tolerance=_EVEN)


def _between(x: FloatArray) -> FloatArray:
    part = np.arange(_DENSE) / _DENSE
    return np.append((x[:-1, None] + np.diff(x)[:, None] * part).ravel(), x[-1])
