"""The lines of a ship of main types (PRELIKON): sections, profile, deck edge, knuckle lines.

Sections and boundaries are chains of lines and circular arcs (`ArcCurve`). Stations are cut off at
the upper deck; stern, keel and stem are one profile; `prelikon_lines` gives all lines for the net.
x forward from AP, y outward, z up from the base line, m.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from enum import IntEnum

import attrs
import numpy as np
from scipy.interpolate import PchipInterpolator

from assoc_hull.creation.classical.line_outline import (
    OutlinePiece,
    PlaneOutline,
    circular_piece,
    point_kinds_along,
    smooth_piece,
    straight_piece,
)
from assoc_hull.errors import GeometryError
from assoc_hull.geometry.classical.arc_curve import ArcBoundary, ArcCurve
from assoc_hull.geometry.classical.boundary_lines import SpaceCurve
from assoc_hull.geometry.classical.checked_input import digits
from assoc_hull.geometry.classical.circular_arcs import PlaneArcs
from assoc_hull.geometry.classical.deck import Deck
from assoc_hull.geometry.curves import FloatArray, IntArray, PointKind
from assoc_hull.geometry.numeric.polynomials import brent_root
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource

__all__ = [
    "AFT",
    "CORNER",
    "ENDS",
    "FORE",
    "SAME_PLACE",
    "ArcJoint",
    "CentrelineProfile",
    "SectionContact",
    "Station",
    "arc_joints",
    "deck_edge",
    "deck_edge_at",
    "make_profile",
    "outline_pieces",
    "prelikon_lines",
    "section_contact",
    "sorted_stations",
    "station_name",
    "trim_station",
    "upper_deck",
]

# --------------------------------------------------------------------------------------
# From lines and arcs to the pieces of an outline. Lines stay straight. An arc that meets a line or
# another arc in one direction stays an arc, within 0.01 mm. Where arcs meet at small angles, as
# mean circles do, the kernel's own smooth curve runs through the given points; where a curve turns
# sharply, or a knuckle is given, it has a corner.

CORNER = np.radians(5.0)
"""A curve that turns by more (rad) from one piece to the next has a corner there."""

_ONE = 2e-5
"""Directions (rad) that differ by less are one: decimals of a text are no corners."""

_WITHIN = 5e-6
"""How far (m) the points of an arc are laid out for; joints take as much again."""

_NEAREST = 0.015
"""Toward a corner the points of an arc lie at half the distance each time, down to this (m)."""


class ArcJoint(IntEnum):
    """How two pieces go over into one another in the net."""

    TANGENT = 0
    SMOOTH = 1
    CORNER = 2


def arc_joints(curve: ArcCurve) -> tuple[ArcJoint, ...]:
    """Tell how the net passes the n - 1 joints between the n pieces of a curve."""
    turn, curved = np.abs(curve.turns()), curve.arcs.curvature != 0.0
    found = []
    for k, angle in enumerate(turn.tolist()):
        if k + 1 in curve.knuckles or angle > CORNER:
            found.append(ArcJoint.CORNER)
        elif angle <= _ONE or curved[k] != curved[k + 1]:
            found.append(ArcJoint.TANGENT)
        else:
            # Two lines at an angle make a corner, two arcs a smooth curve.
            found.append(ArcJoint.SMOOTH if curved[k] else ArcJoint.CORNER)
    return tuple(found)


def outline_pieces(curve: ArcCurve) -> list[OutlinePiece]:
    """Give the pieces of a section or boundary curve for an outline."""
    joints, arcs = arc_joints(curve), curve.arcs
    starts = [0, *(k + 1 for k, each in enumerate(joints) if each != ArcJoint.SMOOTH)]
    found = [
        _piece_of_run(curve, first, last, joints)
        for first, last in zip(starts, [*starts[1:], len(arcs)], strict=True)
    ]
    return _aligned_pieces(
        found, [joints[k - 1] for k in starts[1:]], arcs.curvature[starts] == 0.0
    )


def _piece_of_run(
    curve: ArcCurve, first: int, last: int, joints: tuple[ArcJoint, ...]
) -> OutlinePiece:
    """Give the outline's piece of the curve's pieces `first` to `last`, the latter excluded."""
    arcs, ends = curve.arcs, curve.joints()
    if last - first > 1:
        angles = float(arcs.angle[first]), float(arcs.end_angles()[last - 1])
        return smooth_piece(ends[first : last + 1], *angles)
    if arcs.curvature[first] == 0.0:
        return straight_piece(ends[first], ends[last])
    piece = circular_piece(arcs, first, _WITHIN)
    length = float(arcs.length[first])
    along = np.linspace(0.0, length, len(piece.points))
    sides = (
        first > 0 and joints[first - 1] == ArcJoint.CORNER,
        last < len(arcs) and joints[last - 1] == ArcJoint.CORNER,
    )
    near = _graded_steps(float(along[1]))
    more = [near if sides[0] else np.zeros(0), length - near if sides[1] else np.zeros(0)]
    along = np.unique(np.concatenate([along, *more]))
    points = arcs.at(np.full(len(along), first), along)
    return attrs.evolve(piece, points=points)


def _graded_steps(step: float) -> FloatArray:
    """Give places (m) that approach zero: a spline with a free end does not bend there."""
    count = max(int(np.floor(np.log2(max(step / _NEAREST, 1.0)))), 0)
    return np.asarray(step * 0.5 ** np.arange(1, count + 1))


def _aligned_pieces(
    pieces: list[OutlinePiece], joints: list[ArcJoint], is_line: np.typing.NDArray[np.bool_]
) -> list[OutlinePiece]:
    """Let directions agree where pieces are tangent; a line keeps its own, an arc follows it."""
    found = list(pieces)
    for k, joint in enumerate(joints):
        if joint != ArcJoint.TANGENT:
            continue
        if is_line[k + 1]:
            found[k] = attrs.evolve(found[k], finish=found[k + 1].start)
        else:
            found[k + 1] = attrs.evolve(found[k + 1], start=found[k].finish)
    return found


# --------------------------------------------------------------------------------------
# Transverse sections where they stand, cut off at a deck.

SAME_PLACE = 1e-3
"""Places nearer than this (m) are taken for one: a section that ends so near a deck reaches it."""

_SAMPLES = 33
"""Places of each piece of a section at which its intersection with a deck is looked for."""


@attrs.frozen(eq=False)
class Station:
    """A transverse section.

    Attributes
    ----------
    x : float, m
        Where it stands.
    curve : ArcCurve
        (y, z) from the keel upward, to the deck or beyond.
    """

    x: float
    curve: ArcCurve

    @property
    def keel(self) -> float:
        """Height of its lowest given point, m: where it begins."""
        return float(self.curve.arcs.start[0, 1])


def sorted_stations(stations: Sequence[Station]) -> tuple[Station, ...]:
    """Give stations from aft forward; raises GeometryError for two at one place.

    Each is checked to begin on the centre line.
    """
    found = sorted(stations, key=lambda each: each.x)
    for one, two in itertools.pairwise(found):
        if two.x - one.x <= SAME_PLACE:
            what = f"two sections at x={digits(two.x)}"
            raise GeometryError(what, "leave one of them out", {"x": two.x})
    for each in found:
        y = float(each.curve.arcs.start[0, 0])
        if abs(y) > SAME_PLACE:
            what = f"section at x={digits(each.x)}: begins at y={digits(y)}"
            raise GeometryError(what, "begin on the centre line", {"x": each.x, "y": y})
    return tuple(found)


def upper_deck(decks: Sequence[Deck]) -> Deck | None:
    """Give the highest of decks that do not meet, None if there is none."""
    least = max((each.sheer.range[0] for each in decks), default=0.0)
    return max(decks, key=lambda each: float(each.centre(least)), default=None)


def deck_edge_at(station: Station, deck: Deck) -> tuple[int, float]:
    """Find the first intersection of a section with a deck on its way up.

    Gives the number of the piece and the arc length (m) from its start. Raises GeometryError for a
    section that ends below the deck or begins above it, or lies beyond its sheer or camber.
    """
    arcs, centre = station.curve.arcs, float(deck.centre(station.x))
    camber = deck.camber

    # With a local scale the camber has its whole drop at the section's own edge, wherever it is.
    def above(points: FloatArray) -> FloatArray:
        y = np.abs(points[:, 0])
        if camber.scale == "local":
            return np.asarray(points[:, 1] - centre + camber.total)
        return np.asarray(points[:, 1] - centre + camber.drop(np.minimum(y, camber.half_breadth)))

    piece = np.repeat(np.arange(len(arcs)), _SAMPLES)
    along = (arcs.length[:, None] * np.linspace(0.0, 1.0, _SAMPLES)).ravel()
    over = above(arcs.at(piece, along))
    if over[0] >= 0.0 or over.max() < -SAME_PLACE:
        side = "begins above" if over[0] >= 0.0 else "does not reach"
        raise GeometryError(
            f"section at x={digits(station.x)}: {side} deck {deck.number}",
            f"the deck lies at z={digits(centre)} on the centre line",
            {"x": station.x, "deck": deck.number},
        )  # fmt: skip
    # A section that ends less than SAME_PLACE below the deck reaches it with its end.
    if over.max() < 0.0:
        number, t = len(arcs) - 1, float(arcs.length[-1])
    else:
        k = int(np.argmax(over >= 0.0))
        number = int(piece[k])
        t = float(along[k])
        if along[k] > 0.0 and over[k] > 0.0:
            t = brent_root(
                lambda s: float(above(arcs.at(np.array([number]), [s]))[0]),
                float(along[k - 1]), t, xtol=1e-12,
            )  # fmt: skip
    if camber.scale == "fixed":
        # `above` took places beyond the reference half-breadth as on it: refuse them here.
        camber.drop(arcs.at(np.array([number]), [t])[0, 0])
    return number, t


def trim_station(station: Station, deck: Deck | None) -> Station:
    """Give a section up to a deck; all of it where there is no deck."""
    if deck is None:
        return station
    return Station(station.x, station.curve.cut(*deck_edge_at(station, deck)))


# --------------------------------------------------------------------------------------
# The centre-line profile.

ENDS = ("stern", "stem")
"""Names of the boundary curves that are parts of the profile."""

_LEVEL = 1e-6
"""A keel whose points (m) lie so near a straight line is one."""


@attrs.frozen(eq=False)
class CentrelineProfile:
    """The profile, from aft forward.

    Attributes
    ----------
    stern, stem : ArcCurve or None
        (x, z), the stern downward, the stem upward; None where the hull ends at a section.
    keel : (n, 2), m
        Points between them.
    flat : (bool, bool)
        Whether the first and the last section are flat ends of the hull.
    """

    stern: ArcCurve | None
    stem: ArcCurve | None
    keel: FloatArray
    flat: tuple[bool, bool]

    @property
    def outline(self) -> PlaneOutline:
        """All of it as points for a line of the net."""
        found = [] if self.stern is None else outline_pieces(self.stern)
        found += _keel(self.keel)
        return PlaneOutline.of(found if self.stem is None else [*found, *outline_pieces(self.stem)])

    @property
    def ends(self) -> tuple[FloatArray, FloatArray]:
        """Its after and its fore end, (x, z) each, m."""
        after = self.keel[0] if self.stern is None else self.stern.arcs.start[0]
        fore = self.keel[-1] if self.stem is None else self.stem.arcs.ends()[-1]
        return after, fore

    def heights(self, x: FloatArray) -> list[FloatArray]:
        """Give at each place (m) all heights (m) at which the profile stands there."""
        found = []
        for at in x.tolist():
            here = [each.where(0, at)[:, 1] for each in (self.stern, self.stem) if each is not None]
            if self.keel[0, 0] - SAME_PLACE <= at <= self.keel[-1, 0] + SAME_PLACE:
                here.append(np.interp([at], self.keel[:, 0], self.keel[:, 1]))
            found.append(np.concatenate([*here, np.zeros(0)]))
        return found

    def foremost(self, draught: float) -> float:
        """Give the foremost x (m) of the profile below a height (m)."""
        return self._extreme(self.stem, draught, 1.0, float(self.keel[-1, 0]))

    def aftermost(self, draught: float) -> float:
        """Give the aftermost x (m) of the profile below a height (m)."""
        return self._extreme(self.stern, draught, -1.0, float(self.keel[0, 0]))

    def _extreme(self, curve: ArcCurve | None, draught: float, sign: float, other: float) -> float:
        if curve is None:
            return other
        points = np.vstack([curve.sampled(0.01 * curve.length), curve.where(1, draught)])
        below = points[points[:, 1] <= draught + SAME_PLACE, 0]
        return float(max([*(sign * below), sign * other])) * sign


def make_profile(
    stations: Sequence[Station], boundaries: Sequence[ArcBoundary], deck: Deck | None
) -> CentrelineProfile:
    """Put a profile together of the boundaries named ``"stern"`` and ``"stem"``, and the keel.

    They may be given in either direction and are cut off at the deck; between them the keel runs
    through the first points of `stations` (from aft forward). Raises GeometryError for a section
    that begins off the profile, and a stern or stem that ends below the deck or within sections.
    """
    named = {each.name: each.curve for each in boundaries if each.name in ENDS}
    curves, flat = _profile_ends(named, stations, deck)
    stern, stem = curves["stern"], curves["stem"]
    first = -np.inf if stern is None else float(stern.arcs.ends()[-1, 0])
    last = np.inf if stem is None else float(stem.arcs.start[0, 0])
    keel = [
        [each.x, each.keel] for each in stations if first + SAME_PLACE < each.x < last - SAME_PLACE
    ]
    if stern is not None:
        keel.insert(0, stern.arcs.ends()[-1].tolist())
    if stem is not None:
        keel.append(stem.arcs.start[0].tolist())
    made = CentrelineProfile(stern, stem, np.array(keel), flat)
    _require_on(made, stations)
    _require_between(made, stations)
    return made


def _profile_ends(
    named: Mapping[str, ArcCurve], stations: Sequence[Station], deck: Deck | None
) -> tuple[dict[str, ArcCurve | None], tuple[bool, bool]]:
    """Give stern and stem in their directions, cut off; whether the hull ends flat at either."""
    found: dict[str, ArcCurve | None] = {}
    flat = []
    for name, station in (("stern", stations[0]), ("stem", stations[-1])):
        curve = named.get(name)
        if curve is None:
            found[name] = None
            flat.append(True)
            continue
        upward = (
            curve if curve.arcs.start[0, 1] < curve.arcs.ends()[-1, 1] else _reversed_curve(curve)
        )
        top = upward.arcs.ends()[-1]
        ends_flat = bool(np.hypot(*(top - [station.x, station.keel])) <= SAME_PLACE)
        if not ends_flat and deck is not None:
            upward = _cut_at_deck(upward, deck, name)
        found[name] = upward if name == "stem" else _reversed_curve(upward)
        flat.append(ends_flat)
    return found, (flat[0], flat[1])


def _cut_at_deck(curve: ArcCurve, deck: Deck, name: str) -> ArcCurve:
    """Cut a curve (x, z) that runs upward where it meets the centre line of a deck."""
    arcs, least, most = curve.arcs, *deck.sheer.range

    def above(points: FloatArray) -> FloatArray:
        centre = deck.height + np.interp(points[:, 0], deck.sheer.x, deck.sheer.rise)
        return np.asarray(points[:, 1] - centre)

    piece: IntArray = np.repeat(np.arange(len(arcs)), 33)
    along = (arcs.length[:, None] * np.linspace(0.0, 1.0, 33)).ravel()
    points = arcs.at(piece, along)
    over = above(points)
    if over.max() < 0.0:
        if over[-1] > -SAME_PLACE:
            return curve
        what = f"boundary {name}: does not reach deck {deck.number}"
        raise GeometryError(what, "extend it", {"boundary": name, "deck": deck.number})
    k = int(np.argmax(over >= 0.0))
    number, t = int(piece[k]), float(along[k])
    if over[k] > 0.0 and t > 0.0:
        t = brent_root(
            lambda s: float(above(arcs.at(np.array([number]), [s]))[0]), float(along[k - 1]), t,
            xtol=1e-12,
        )  # fmt: skip
    end = arcs.at(np.array([number]), [t])[0]
    if not least - SAME_PLACE <= end[0] <= most + SAME_PLACE:
        # Beyond the sheer, which `above` continued level: this raises.
        deck.centre(end[0])
    return curve.cut(number, t)


def _reversed_curve(curve: ArcCurve) -> ArcCurve:
    """Give a curve in the other direction."""
    arcs = curve.arcs
    back = slice(None, None, -1)
    turned = PlaneArcs(
        arcs.ends()[back].copy(), (arcs.end_angles() + np.pi)[back].copy(),
        -arcs.curvature[back], arcs.length[back].copy(),
    )  # fmt: skip
    # A knuckle is numbered by the piece that begins there.
    knuckles = frozenset(len(arcs) - k for k in curve.knuckles)
    return ArcCurve(turned, curve.points[back].copy(), curve.name, knuckles)


def _require_on(profile: CentrelineProfile, stations: Sequence[Station]) -> None:
    x = np.array([each.x for each in stations])
    for each, heights in zip(stations, profile.heights(x), strict=True):
        off = np.abs(heights - each.keel).min(initial=np.inf)
        if off > SAME_PLACE:
            lies = ", ".join(digits(z) for z in heights) or "nowhere"
            raise GeometryError(
                f"section at x={digits(each.x)}: begins at z={digits(each.keel)}, off the profile",
                f"the profile lies at {lies} there: change one of them",
                {"x": each.x, "z": each.keel, "off": float(off)},
            )  # fmt: skip


def _require_between(profile: CentrelineProfile, stations: Sequence[Station]) -> None:
    """Check that stern and stem end beyond all sections, as the deck edge that joins them does."""
    for k, (name, other, way) in enumerate(
        (("stern", "stem", "aft"), ("stem", "stern", "forward"))
    ):
        end, x = float(profile.ends[k][0]), stations[-k].x
        if profile.flat[k] or (x - end if k == 0 else end - x) > SAME_PLACE:
            continue
        raise GeometryError(
            f"boundary {name}: ends at x={digits(end)}, not {way} of the section at x={digits(x)}",
            f"end it {way} of all sections, and give the {other} as a boundary of its own; or let "
            "it end where that section begins: the hull ends flat there",
            {"boundary": name, "end": end, "x": x},
        )


def _keel(points: FloatArray) -> list[OutlinePiece]:
    """Give the keel: one straight line if it is one, else smooth through its points."""
    if len(points) < 2 or np.hypot(*(points[-1] - points[0])) <= SAME_PLACE:
        return []
    step = points[-1] - points[0]
    away = points - points[0]
    off = np.abs(away[:, 0] * step[1] - away[:, 1] * step[0]) / np.hypot(*step)
    if off.max() <= _LEVEL:
        return [straight_piece(points[0], points[-1])]
    return [smooth_piece(points)]


# --------------------------------------------------------------------------------------
# Lines for the net.

AFT, FORE = "aft end", "fore end"
"""Lines that bound a hull where it ends flat."""

_CORNER = 30.0
"""A deck edge has a knuckle where its chords turn by more, degrees."""

_SHARP = 1e-3
"""A section has a corner where its tangent jumps by more, rad."""


@attrs.frozen
class SectionContact:
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
        return self.count >= 2 and self.distance <= SAME_PLACE and self.joints and self.corners > 0


def section_contact(curve: SpaceCurve, stations: Sequence[Station]) -> SectionContact:
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
    return SectionContact(worst, where, count, joints, corners)


def _turn_at(station: Station, yz: FloatArray) -> float | None:
    """Give the jump of the tangent (rad) of a section at a place, None where no pieces meet.

    The upper end counts as a place where they meet, without a jump.
    """
    curve = station.curve
    joints = curve.joints()[1:]
    away = np.hypot(*(joints - yz).T)
    k = int(np.argmin(away))
    return None if away[k] > SAME_PLACE else float(np.append(curve.turns(), 0.0)[k])


def deck_edge(
    stations: Sequence[Station], profile: CentrelineProfile, deck: Deck | None
) -> LineSource:
    """Join the upper ends of sections and of the profile; with a knuckle where the sheer has one.

    Stations are cut off at the deck; where the hull ends flat the profile adds no point.
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
    kind, direction = point_kinds_along(places, _CORNER)
    kind[forced] = int(PointKind.KNUCKLE)
    direction[forced] = 0.0
    kind[[0, -1]] = int(PointKind.SMOOTH)
    plane = ((0.0, 0.0, 1.0), float(places[0, 2])) if np.ptp(places[:, 2]) <= 1e-9 else None
    return LineSource.make(
        "boundary", "deck edge", places, plane=plane, boundary=BoundaryKind.END,
        kind=kind.tolist(), direction=direction, placed=True,
    )  # fmt: skip


def _with_sheer(places: FloatArray, deck: Deck) -> tuple[FloatArray, np.typing.NDArray[np.bool_]]:
    """Insert a point at each break of the sheer; tell which points are breaks."""
    slope = np.diff(deck.sheer.rise) / np.diff(deck.sheer.x)
    breaks = deck.sheer.x[1:-1][np.abs(np.diff(slope)) > 1e-9]
    breaks = breaks[(breaks > places[0, 0] + SAME_PLACE) & (breaks < places[-1, 0] - SAME_PLACE)]
    missing = breaks[
        np.abs(breaks[:, None] - places[:, 0]).min(axis=1, initial=np.inf) > SAME_PLACE
    ]
    y = PchipInterpolator(places[:, 0], places[:, 1])(missing)
    if len(missing):
        added = np.column_stack([missing, y, deck.at(missing, y, np.maximum(y, SAME_PLACE))])
        places = np.concatenate([places, added])
        places = places[np.argsort(places[:, 0], kind="stable")]
    is_break = np.abs(places[:, :1] - breaks).min(axis=1, initial=np.inf) <= SAME_PLACE
    return places, is_break


def station_name(stations: Sequence[Station], index: int, flat: tuple[bool, bool]) -> str:
    """Give the name of the line that a section becomes."""
    if index == 0 and flat[0]:
        return AFT
    if index == len(stations) - 1 and flat[1]:
        return FORE
    return f"ST {stations[index].x:g}"


def prelikon_lines(
    stations: Sequence[Station],
    profile: CentrelineProfile,
    deck: Deck | None,
    knuckles: Sequence[SpaceCurve],
) -> tuple[LineSource, ...]:
    """Give all lines of a hull.

    Stations are cut off at the upper deck and go from aft forward; `knuckles` are the space curves
    at which sections have corners.
    """
    found = [profile.outline.boundary("profile", 1, 0.0), deck_edge(stations, profile, deck)]
    found += [_knuckle(each, stations) for each in knuckles]
    for k, station in enumerate(stations):
        outline, name = (
            PlaneOutline.of(outline_pieces(station.curve)),
            station_name(stations, k, profile.flat),
        )
        if name in (AFT, FORE):
            found.append(outline.boundary(name, 0, station.x))
        else:
            found.append(outline.section(name, station.x))
    return tuple(found)


def _knuckle(curve: SpaceCurve, stations: Sequence[Station]) -> LineSource:
    """Draw a knuckle line through its own points and its places on the sections."""
    crossings = [curve.where(0, each.x) for each in stations]
    points = np.concatenate([curve.points, *crossings])
    points = points[np.argsort(points[:, 0], kind="stable")]
    apart = np.ones(len(points), bool)
    apart[1:] = np.linalg.norm(np.diff(points, axis=0), axis=1) > SAME_PLACE
    points = points[apart]
    kind, direction = point_kinds_along(points, _CORNER)
    if curve.kind == "spline":
        kind[:], direction[:] = int(PointKind.SMOOTH), 0.0
    return LineSource.make(
        "boundary", curve.name, points, boundary=BoundaryKind.KNUCKLE, kind=kind.tolist(),
        direction=direction, placed=True,
    )  # fmt: skip
