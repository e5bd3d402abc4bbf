"""The lines of a ship by boundary data, as the net takes them up.

Points of the definition are points of lines. Frames are smooth from knuckle to knuckle; contour and
straight intervals of knuckle lines keep their corners; waterlines follow the definition's splines
closely, their parallel part is straight. Flat ends are transoms.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.creation.classical.outline import Outline, Piece, smooth, straight
from assoc_hull.creation.classical.seaking_sections import outline_of
from assoc_hull.geometry.classical.knuckle_codes import KnuckleLine
from assoc_hull.geometry.classical.parallel_waterline import ParallelWaterline
from assoc_hull.geometry.classical.waterline_piece import Level
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.model.family import BoundaryKind
from assoc_hull.model.source import LineSource

if TYPE_CHECKING:
    from assoc_hull.creation.classical.seaking import Seaking

__all__ = ["frame_name", "lines_of"]

_SAME = 1e-6
_DENSE = 4
"""Chords between two points of a waterline."""

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
        outline_of(each).section(frame_name(each.x), each.x, tolerance=_EVEN)
        for each in ship.sections(inner)
    ]
    transoms = [
        outline_of(ship.section(x)).boundary("transom" if x == first else "fore end", 0, x)
        for x in ends
    ]
    waterlines = [_waterline(each) for each in ship.waterlines]
    along = [_profile(ship), _deck_edge(ship.deck), *_flat_of_bottom(ship)]
    along += [_space_line(each.name, each.line, BoundaryKind.KNUCKLE) for each in ship.knuckles]
    return (*along, *transoms, *sections, *waterlines)


def _profile(ship: Seaking) -> LineSource:
    """From the transom, or the deck, along the keel to the stem head."""
    rows = np.concatenate([ship.keel.aft, ship.keel.forward])
    (half, top), (breadth, head) = ship.deck.at(ship.ends).tolist()
    if half <= _SAME and top > rows[0, 1] + _SAME:
        rows = np.concatenate([[(ship.ends[0], top)], rows])
    if breadth <= _SAME and head > rows[-1, 1] + _SAME:
        rows = np.concatenate([rows, [(ship.ends[1], head)]])
    pieces = [straight(a, b) for a, b in zip(rows[:-1], rows[1:], strict=True)]
    return Outline.of(pieces).boundary("profile", 1, 0.0)


def _deck_edge(deck: KnuckleLine) -> LineSource:
    return _space_line("deck edge", deck, BoundaryKind.END)


def _space_line(name: str, line: KnuckleLine, kind: BoundaryKind) -> LineSource:
    """Give a line over x: corners at steps and at the ends of straight intervals."""
    hard = line.code <= 1
    corner = np.zeros(len(line.x), bool)
    corner[1:-1] = hard[1:] | hard[:-1]
    # Straight intervals in one line need no corner between them.
    points = np.column_stack([line.x, line.v])
    step = np.diff(points, axis=0)
    step /= np.linalg.norm(step, axis=1)[:, None]
    even = np.einsum("ij,ij->i", step[1:], step[:-1]) > 1.0 - 1e-14
    corner[1:-1] &= ~even
    tread = np.flatnonzero((line.code == 0) & (np.diff(line.x) > 0.0))
    for row in tread[::-1].tolist():
        points = np.insert(points, row + 1, [line.x[row + 1], *line.v[row]], axis=0)
        corner = np.insert(corner, row + 1, True)
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
    pieces = [straight(a, b) for a, b in zip(rows[:-1], rows[1:], strict=True)]
    kind = BoundaryKind.FLAT
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
