"""The lines of a hull of sections: profile, deck edge, flat ends, sections, knuckle lines."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from scipy.interpolate import PchipInterpolator

from assoc_hull.creation.classical.outline import Outline
from assoc_hull.creation.classical.prelikon_pieces import pieces_of
from assoc_hull.creation.classical.prelikon_profile import Profile
from assoc_hull.creation.classical.prelikon_stations import AT, Station
from assoc_hull.creation.classical.runs import kinds_along
from assoc_hull.geometry.classical.deck_surface import Deck
from assoc_hull.geometry.classical.space_curve import SpaceCurve
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

__all__ = ["AFT", "FORE", "Lying", "deck_edge", "lies_on", "lines_of", "name_of"]

AFT, FORE = "aft end", "fore end"
"""Lines that bound a hull where it ends flat."""

_CORNER = 30.0
"""A deck edge has a knuckle where its chords turn by more, degrees."""

_SHARP = 1e-3
"""A section has a corner where its tangent jumps by more, rad."""


@attrs.frozen
class Lying:
    """How a space curve lies to the sections.

    Attributes
    ----------
    distance : float, m
        Largest, of its places in the planes of sections.
    where : float, m
        x of that section.
    count : int
        Sections that it passes.
    joints : bool
        Whether two pieces of each of these sections meet there.
    corners : int
        How many of these sections have a corner there.
    """

    distance: float
    where: float
    count: int
    joints: bool
    corners: int

    @property
    def is_knuckle(self) -> bool:
        """Whether it is a line of the hull along which sections have a corner, or may have one."""
        return self.count >= 2 and self.distance <= AT and self.joints and self.corners > 0


def lies_on(curve: SpaceCurve, stations: Sequence[Station]) -> Lying:
    """Tell how a space curve lies to sections (cut off at the deck)."""
    worst, where, count, joints, corners = 0.0, np.nan, 0, True, 0
    for station in stations:
        for point in curve.where(0, station.x):
            arcs = station.curve.arcs
            every = np.arange(len(arcs))
            off = float(arcs.distance(every, np.tile(point[1:], (len(arcs), 1))).min())
            count += 1
            turn = _turn_at(station, point[1:])
            joints &= turn is not None
            corners += turn is not None and abs(turn) > _SHARP
            if off >= worst:
                worst, where = off, station.x
    return Lying(worst, where, count, joints, corners)


def _turn_at(station: Station, yz: FloatArray) -> float | None:
    """Give the jump of the tangent (rad) of a section at a place, None where no pieces meet.

    The upper end counts as a place where they meet, without a jump.
    """
    curve = station.curve
    joints = curve.joints()[1:]
    away = np.hypot(*(joints - yz).T)
    k = int(np.argmin(away))
    return None if away[k] > AT else float(np.append(curve.turns(), 0.0)[k])


def deck_edge(stations: Sequence[Station], profile: Profile, deck: Deck | None) -> LineSource:
    """Join the upper ends of sections; with a knuckle where the sheer has one.

    Parameters
    ----------
    stations : sequence of Station
        Cut off at the deck.
    profile : Profile
        Its ends are those of the deck edge where the hull does not end flat.
    deck : Deck or None
        The deck.
    """
    points = [[each.x, *each.curve.arcs.ends()[-1].tolist()] for each in stations]
    after, fore = profile.ends
    if not profile.flat[0]:
        points.insert(0, [after[0], 0.0, after[1]])
    if not profile.flat[1]:
        points.append([fore[0], 0.0, fore[1]])
    places = np.array(points)
    forced = np.zeros(len(places), bool)
    if deck is not None:
        places, forced = _with_sheer(places, deck)
    kind, direction = kinds_along(places, _CORNER)
    kind[forced] = int(PointKind.KNUCKLE)
    direction[forced] = 0.0
    kind[[0, -1]] = int(PointKind.SMOOTH)
    plane = ((0.0, 0.0, 1.0), float(places[0, 2])) if np.ptp(places[:, 2]) <= 1e-9 else None
    return LineSource.make(
        "boundary", "deck edge", places, plane=plane, boundary=BoundaryKind.END,
        kind=kind.tolist(), direction=direction, placed=True,
    )  # fmt: skip


def _with_sheer(places: FloatArray, deck: Deck) -> tuple[FloatArray, np.typing.NDArray[np.bool_]]:
    """Add a point at each break of the sheer; tell which points are breaks."""
    slope = np.diff(deck.sheer.rise) / np.diff(deck.sheer.x)
    breaks = deck.sheer.x[1:-1][np.abs(np.diff(slope)) > 1e-9]
    breaks = breaks[(breaks > places[0, 0] + AT) & (breaks < places[-1, 0] - AT)]
    missing = breaks[np.abs(breaks[:, None] - places[:, 0]).min(axis=1, initial=np.inf) > AT]
    y = PchipInterpolator(places[:, 0], places[:, 1])(missing)
    if len(missing):
        added = np.column_stack([missing, y, deck.at(missing, y, np.maximum(y, AT))])
        places = np.concatenate([places, added])
        places = places[np.argsort(places[:, 0], kind="stable")]
    is_break = np.abs(places[:, :1] - breaks).min(axis=1, initial=np.inf) <= AT
    return places, is_break


def name_of(stations: Sequence[Station], index: int, flat: tuple[bool, bool]) -> str:
    """Give the name of the line that a section becomes."""
    if index == 0 and flat[0]:
        return AFT
    if index == len(stations) - 1 and flat[1]:
        return FORE
    return f"ST {stations[index].x:g}"


def lines_of(
    stations: Sequence[Station],
    profile: Profile,
    deck: Deck | None,
    knuckles: Sequence[SpaceCurve],
) -> tuple[LineSource, ...]:
    """Give all lines of a hull.

    Parameters
    ----------
    stations : sequence of Station
        Cut off at the deck, from aft forward.
    profile : Profile
        Centre line.
    deck : Deck or None
        The upper deck.
    knuckles : sequence of SpaceCurve
        Those at which the sections have corners.
    """
    found = [profile.outline.boundary("profile", 1, 0.0), deck_edge(stations, profile, deck)]
    found += [_knuckle(each, stations) for each in knuckles]
    for k, station in enumerate(stations):
        outline, name = Outline.of(pieces_of(station.curve)), name_of(stations, k, profile.flat)
        if name in (AFT, FORE):
            found.append(outline.boundary(name, 0, station.x))
        else:
            found.append(outline.section(name, station.x))
    return tuple(found)


def _knuckle(curve: SpaceCurve, stations: Sequence[Station]) -> LineSource:
    """Draw a knuckle line through its own points and its places on the sections."""
    met = [curve.where(0, each.x) for each in stations]
    points = np.concatenate([curve.points, *met])
    points = points[np.argsort(points[:, 0], kind="stable")]
    apart = np.ones(len(points), bool)
    apart[1:] = np.linalg.norm(np.diff(points, axis=0), axis=1) > AT
    points = points[apart]
    kind, direction = kinds_along(points, _CORNER)
    if curve.kind == "spline":
        kind[:], direction[:] = int(PointKind.SMOOTH), 0.0
    return LineSource.make(
        "boundary", curve.name, points, boundary=BoundaryKind.KNUCKLE, kind=kind.tolist(),
        direction=direction, placed=True,
    )  # fmt: skip
