"""A body that floats: its position and its limits, what is measured of it, its freeboard.

A plane is ``z = T_A + (T_F - T_A) x / Lpp - y tan(heel)``: draughts are those of the centre line,
moulded (from the base line), heel is + with starboard down. Hydrostatics and stability ask a hull
for what the protocols here say, and for nothing else; `Flotation` and `MeshFlotation` answer.
Appendages are added by name to what is measured of the moulded hull.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Protocol

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.arguments import checked, not_negative, number, numbers, place, plain, text
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, SplineBatch, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.numeric.polynomials import brent_root
from assoc_hull.geometry.splines.segments import positions, sample

__all__ = [
    "CLOSE_DECK",
    "Appendage",
    "Floatable",
    "FloatingBody",
    "FloatingPosition",
    "Freeboard",
    "IntegralChange",
    "Measurable",
    "SampledCurves",
    "StationAreas",
    "WaterplaneLimits",
    "deck_edge_heel",
    "kept_dry",
    "least_freeboard",
    "planes_of",
    "require_afloat",
    "require_numbers",
    "require_volume",
    "rising_numbers",
    "with_appendages",
]

_IN_POSITION = "in a floating position"


def _heel(_: object, __: object, value: object) -> None:
    if not -90.0 < number(value, "heel_deg", _IN_POSITION) < 90.0:
        raise OutOfRangeError(
            "heel", float(str(value)), _IN_POSITION, "lays the ship on her side", -89.9, 89.9, "deg"
        )


@attrs.frozen
class FloatingPosition:
    """A floating position.

    Attributes
    ----------
    draught_aft, draught_fore : float, m
        T_A and T_F: on the centre line, at the perpendiculars, moulded.
    heel_deg : float, degrees
        + starboard down; between -90 and 90.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
    >>> FloatingPosition(6.0, 5.0).trim_by_stern
    1.0
    """

    draught_aft: float = attrs.field(converter=plain, validator=checked(number, _IN_POSITION))
    draught_fore: float = attrs.field(converter=plain, validator=checked(number, _IN_POSITION))
    heel_deg: float = attrs.field(default=0.0, converter=plain, validator=_heel)

    @property
    def draught_mean(self) -> float:
        """Mean of the two draughts, m."""
        return 0.5 * (self.draught_aft + self.draught_fore)

    @property
    def trim_by_stern(self) -> float:
        """T_A - T_F, m."""
        return self.draught_aft - self.draught_fore

    def __str__(self) -> str:
        return (
            f"at T_A {self.draught_aft:g} m, T_F {self.draught_fore:g} m, "
            f"heel {self.heel_deg:g} deg"
        )


def planes_of(positions: Sequence[FloatingPosition], length: float) -> FloatingPlanes:
    """Give the planes of floating positions.

    Parameters
    ----------
    positions : sequence of d FloatingPosition
        Where the hull floats.
    length : float, m
        Between perpendiculars.

    Returns
    -------
    FloatingPlanes
        One per position.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, planes_of
    >>> planes_of([FloatingPosition(6.0, 5.0)], 100.0).tan_trim.tolist()
    [-0.01]
    """
    aft = np.array([each.draught_aft for each in positions], np.float64)
    fore = np.array([each.draught_fore for each in positions], np.float64)
    heel = np.array([each.heel_deg for each in positions], np.float64)
    return FloatingPlanes(aft, (fore - aft) / length, np.tan(np.radians(heel)))


@attrs.frozen(eq=False)
class SampledCurves:
    """Curves of a hull, by points of which the lowest is looked for.

    Attributes
    ----------
    batch : SplineBatch
        The curves, port side, m.
    per_segment : int
        How many points of each segment are looked at.
    """

    batch: SplineBatch
    per_segment: int

    @cached_property
    def points(self) -> FloatArray:
        """All of them, (n, 3), m."""
        return sample(self.batch, self.per_segment)[1]

    def lowest(self, planes: FloatingPlanes) -> FloatArray:
        """Give the least height at x = y = 0 of planes through the points and their images, (d,).

        A segment lies above the lowest of its control points: few are looked at.
        """
        batch, heel = self.batch, np.abs(planes.tan_heel[:, None])
        least, lowest = _heights(batch.xyz, planes, up=-1.0).min(axis=1), np.inf
        third = np.diff(batch.knot) / 3.0
        # From the last knot of a curve to the first of the next there is no segment.
        third[batch.start[1:-1] - 1] = np.nan
        for side in (heel, -heel) if heel.any() else (heel,):
            at, leave, arrive = (
                z - planes.tan_trim[:, None] * x - side * y
                for x, y, z in (batch.xyz.T, batch.leave.T, batch.arrive.T)
            )
            inner = at[:, :-1] + leave[:, :-1] * third, at[:, 1:] - arrive[:, 1:] * third
            lowest = np.minimum(lowest, np.minimum(*inner).min(axis=0))
        some = np.flatnonzero(lowest <= least.max() + _NEARLY)
        part = np.arange(self.per_segment) / self.per_segment
        places = positions(self.batch, some.repeat(len(part)), np.tile(part, len(some))).T
        inside = _heights(places, planes, up=-1.0).min(axis=1, initial=np.inf)
        found: FloatArray = np.minimum(least, inside)
        return found


_NEARLY = 1e-6
"""m: by so much a control point may be off for rounding."""


@attrs.frozen(eq=False)
class WaterplaneLimits:
    """Between what a plane must lie to be a waterplane of a hull; port side, m.

    Attributes
    ----------
    bottom : (n, 3), or SampledCurves
        Points of the hull that include the lowest, at any trim and heel.
    deck : (k, 3)
        The deck edge.
    closed : bool
        The deck is closed: it may go under, as long as some of it is dry. An open deck is
        drowned as soon as its edge is.
    station_x : (n,), m
        Where the stations are, to say where the edge is lowest; none if they are not known.
    station_names : tuple of n str
        Their names.
    """

    _bottom: FloatArray | SampledCurves
    deck: FloatArray
    closed: bool
    station_x: FloatArray = attrs.field(factory=lambda: np.zeros(0))
    station_names: tuple[str, ...] = ()

    def __attrs_post_init__(self) -> None:
        freeze(self.deck, self.station_x)
        if not isinstance(self._bottom, SampledCurves):
            freeze(self._bottom)

    @property
    def bottom(self) -> FloatArray:
        """Points that include the lowest, (n, 3), m."""
        return self._bottom.points if isinstance(self._bottom, SampledCurves) else self._bottom

    def mean_draughts(self, planes: FloatingPlanes, length: float) -> tuple[FloatArray, FloatArray]:
        """Give the least and the most mean draught (m) at the trim and heel of each plane."""
        lift = 0.5 * length * planes.tan_trim
        if isinstance(self._bottom, SampledCurves):
            low = self._bottom.lowest(planes)
        else:
            low = _heights(self._bottom, planes, up=-1.0).min(axis=1)
        return low + lift, self._top(planes) + lift

    def _top(self, planes: FloatingPlanes) -> FloatArray:
        """Give the most height at x = y = 0 of planes, (d,), m."""
        top = _heights(self.deck, planes, up=1.0 if self.closed else -1.0)
        found: FloatArray = top.max(axis=1) if self.closed else top.min(axis=1)
        return found

    def surely_hold(self, values: FloatArray, planes: FloatingPlanes, length: float) -> bool:
        """Tell soon whether mean draughts (d,), m, lie above points of the hull, and below the top.

        False: `mean_draughts` tells.
        """
        lift = 0.5 * length * planes.tan_trim
        if isinstance(self._bottom, SampledCurves):
            low = _heights(self._bottom.batch.xyz, planes, up=-1.0).min(axis=1)
        else:
            low = _heights(self._bottom, planes, up=-1.0).min(axis=1)
        return bool(((low + lift < values) & (values <= self._top(planes) + lift)).all())

    def lowest_edge(self, planes: FloatingPlanes, k: int) -> str:
        """Say where the deck edge is lowest over the k-th plane: x, height, nearest station."""
        top = _heights(self.deck, planes, up=-1.0)[k]
        x, y, z = self.deck[int(top.argmin())].tolist()
        near = ""
        if len(self.station_names):
            near = f", near {self.station_names[int(np.abs(self.station_x - x).argmin())]}"
        return f"z {z:.3f} m at x {x:.2f} m, y {y:.2f} m{near}"


def _heights(points: FloatArray, planes: FloatingPlanes, up: float) -> FloatArray:
    """Give the heights at x = y = 0 of planes through points, (d, n), m.

    Of each point and its mirror image the one higher over the water counts (`up` 1), or deeper
    (-1).
    """
    x, y, z = points.T
    side = up * np.abs(planes.tan_heel[:, None]) * np.abs(y)
    found: FloatArray = z - planes.tan_trim[:, None] * x + side
    return found


def require_afloat(
    positions: Sequence[FloatingPosition], limits: WaterplaneLimits, length: float
) -> FloatingPlanes:
    """Give the planes of floating positions, or say which cannot be.

    Parameters
    ----------
    positions : sequence of d FloatingPosition
        Where the hull floats.
    limits : WaterplaneLimits
        Of the hull.
    length : float, m
        Between perpendiculars.

    Raises
    ------
    OutOfRangeError
        A plane misses the ship, below or above, or drowns an open deck; with the range of
        mean draughts at that trim and heel.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.floating_body import (
    ...     FloatingPosition,
    ...     require_afloat,
    ...     WaterplaneLimits,
    ... )
    >>> box = np.array([[0.0, 10, 0], [100, 10, 0]])
    >>> limits = WaterplaneLimits(box, box + [0, 0, 12.0], closed=False)
    >>> require_afloat([FloatingPosition(13.0, 13.0)], limits, 100.0)
    Traceback (most recent call last):
    ...
    assoc_hull.errors.OutOfRangeError: a mean draught of 13 m drowns the open deck, whose edge is \
lowest at z 12.000 m at x 0.00 m, y 10.00 m, at T_A 13 m, T_F 13 m, heel 0 deg; give one from 0 \
to 12 m
    """
    planes = planes_of(positions, length)
    values = np.array([each.draught_mean for each in positions])
    if not limits.surely_hold(values, planes, length):
        _refuse_outside(positions, limits, planes, length)
    return planes if limits.closed else _clear_of_edge(planes, limits)


def _refuse_outside(
    positions: Sequence[FloatingPosition], limits: WaterplaneLimits, planes: FloatingPlanes,
    length: float,
) -> None:  # fmt: skip
    """Refuse the first position that is none."""
    least, most = limits.mean_draughts(planes, length)
    for k, (each, low, high) in enumerate(
        zip(positions, least.tolist(), most.tolist(), strict=True)
    ):
        value = each.draught_mean
        if low >= high:
            what = f"no draught keeps the deck dry, {each}"
            raise BadInputError(what, "in hydrostatics", f"give less trim or heel, or {CLOSE_DECK}")
        if value <= low:
            why = "lies below the keel"
            raise OutOfRangeError("a mean draught", value, str(each), why, low, high, "m")
        if value > high and limits.closed:
            why = "lies above the deck"
            raise OutOfRangeError("a mean draught", value, str(each), why, low, high, "m")
        if value > high:
            why = f"drowns the open deck, whose edge is lowest at {limits.lowest_edge(planes, k)}"
            # Over the highest place of the deck a closed one is under water, too.
            top = float(attrs.evolve(limits, closed=True).mean_draughts(planes, length)[1][k])
            remedy = CLOSE_DECK if value <= top else ""
            raise OutOfRangeError("a mean draught", value, str(each), why, low, high, "m", remedy)


CLOSE_DECK = 'read or make the hull with deck="closed" (--deck closed) if it has a deck'
"""What to do where an open deck is in the way."""

_ROUNDING = 1e-13
"""Of a height: edge and water this near are one level, and rounding tells which is higher."""


def _clear_of_edge(planes: FloatingPlanes, limits: WaterplaneLimits) -> FloatingPlanes:
    """Give planes, those at the level of an open deck's edge right below it.

    Rounding leaves some of a level edge wet and some dry, and so cuts the waterplane to pieces.
    """
    lowest = _heights(limits.deck, planes, up=-1.0).min(axis=1)
    if not (np.abs(lowest - planes.height) < _NEARLY * (1.0 + np.abs(lowest))).any():
        return planes
    slack = _ROUNDING * np.maximum(np.abs(lowest), np.ptp(limits.bottom[:, 2]))
    at_edge = np.abs(lowest - planes.height) < slack
    if not at_edge.any():
        return planes
    return attrs.evolve(planes, height=np.where(at_edge, lowest - slack, planes.height))


def kept_dry(
    positions: Sequence[FloatingPosition], limits: WaterplaneLimits, length: float
) -> tuple[list[FloatingPosition], tuple[str, ...]]:
    """Bring positions that drown an open deck up to its edge, and say which, for `report`.

    Trim and heel stay; what lies below the keel, or at a trim that leaves no draught, is left
    for `require_afloat` to refuse.
    """
    if limits.closed:
        return list(positions), ()
    planes = planes_of(positions, length)
    least, most = limits.mean_draughts(planes, length)
    found, notes = list[FloatingPosition](), dict[str, None]()
    for k, each in enumerate(positions):
        over = each.draught_mean - float(most[k])
        if over <= 0.0 or not least[k] < most[k]:
            found.append(each)
            continue
        # A rounding of the two draughts must not lift their mean over the edge again.
        down = over + 1e-12 * max(abs(over), abs(float(most[k])))
        aft, fore = each.draught_aft - down, each.draught_fore - down
        found.append(attrs.evolve(each, draught_aft=aft, draught_fore=fore))
        notes[
            f"a mean draught of {each.draught_mean:.8g} m drowns the open deck: measured up to "
            f"{float(most[k]):.8g} m, where its edge is lowest ({limits.lowest_edge(planes, k)}); "
            f"{CLOSE_DECK}"
        ] = None
    return found, tuple(notes)


def require_numbers(draughts: object, limits: WaterplaneLimits) -> None:
    """Refuse draughts with one that is no finite number; the error has the range at even keel.

    Parameters
    ----------
    draughts : float, or (k,), m
        What was given; what is no number at all is left to others.
    limits : WaterplaneLimits
        Of the hull.

    Raises
    ------
    OutOfRangeError
        One that is nan or infinite.
    """
    try:
        given = np.ravel(np.array(draughts, np.float64)) if draughts is not None else np.zeros(0)
    except (TypeError, ValueError, OverflowError):
        return
    odd = given[~np.isfinite(given)]
    if len(odd):
        level = FloatingPlanes(np.zeros(1), np.zeros(1), np.zeros(1))
        least, most = (float(each[0]) for each in limits.mean_draughts(level, 0.0))
        why = "is no finite number"
        raise OutOfRangeError("a draught", float(odd[0]), _IN_POSITION, why, least, most, "m")


def rising_numbers(values: object, name: str, where: str) -> FloatArray:
    """Take numbers (k,), m, that rise; one number will do.

    Raises
    ------
    BadInputError
        No number, one that is not finite, or one that is not above the one before.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.floating_body import rising_numbers
    >>> rising_numbers([4, 5, 6.5], "draughts", "in a table").tolist()
    [4.0, 5.0, 6.5]
    """
    found = np.atleast_1d(numbers(values, name, where))
    if not len(found):
        raise BadInputError(f"{name} is empty", where, "give one number or more")
    step = np.diff(found)
    if (step <= 0.0).any():
        k = int(np.argmax(step <= 0.0))
        pair = f"{found[k + 1]:g} stands after {found[k]:g}"
        raise BadInputError(
            f"{name} does not rise: {pair}", where, "give rising numbers, each once"
        )
    return found


# --------------------------------------------------------------------------------------
# Appendages: added to a moulded hull by name, or taken from it.

_IN_APPENDAGE = "in an appendage"


def _three(value: object) -> tuple[float, float, float]:
    """Take a place as three numbers."""
    x, y, z = place(value, "centroid", _IN_APPENDAGE).tolist()
    return x, y, z


@attrs.frozen
class Appendage:
    """A rudder, a bilge keel, a bow thruster's tunnel: listed apart in every table.

    It counts whole where the place of its centroid is under water, and else not at all.

    Attributes
    ----------
    name : str
        Of the appendage.
    volume : float, m3
        Of all of it, both sides; negative for a recess that the moulded hull encloses, such as a
        `Tunnel`.
    centroid : (float, float, float), m
        x from AP, y + to port, z from the base line.
    area : float, m2
        That it adds to the wetted surface; negative where a recess opens more of the shell than
        it has walls.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.floating_body import Appendage
    >>> Appendage("bow thruster tunnel", -12.5, (140.0, 0.0, 3.2), 31.0).volume
    -12.5
    """

    name: str = attrs.field(validator=checked(text, _IN_APPENDAGE))
    volume: float = attrs.field(validator=checked(number, _IN_APPENDAGE))
    centroid: tuple[float, float, float] = attrs.field(converter=_three)
    area: float = attrs.field(default=0.0, validator=checked(number, _IN_APPENDAGE))

    def __attrs_post_init__(self) -> None:
        if self.volume >= 0.0:
            not_negative(self.area, "area", _IN_APPENDAGE)

    def immersed(self, planes: FloatingPlanes) -> NDArray[np.bool_]:
        """Tell below which planes its centroid lies, (d,)."""
        x, y, z = self.centroid
        wet: NDArray[np.bool_] = z < planes.height + planes.tan_trim * x - planes.tan_heel * y
        return wet


def with_appendages(
    immersed: ImmersedIntegrals, appendages: Sequence[Appendage], planes: FloatingPlanes
) -> ImmersedIntegrals:
    """Add appendages to what is measured of a bare hull: to volume, moments and shell.

    Each counts below those of the d planes under which its centroid lies.
    """
    for each in appendages:
        x, y, z = each.centroid
        wet = each.immersed(planes)
        volume = np.where(wet, each.volume, 0.0)
        immersed = attrs.evolve(
            immersed,
            volume=immersed.volume + volume,
            moment_x=immersed.moment_x + volume * x,
            moment_y=immersed.moment_y + volume * y,
            moment_z=immersed.moment_z + volume * z,
            shell=immersed.shell + np.where(wet, each.area, 0.0),
        )
    return immersed


def require_volume(
    volume: FloatArray, appendages: Sequence[Appendage], planes: FloatingPlanes, where: str
) -> None:
    """Refuse appendages that take away all of the hull; `volume` (d,), m3, is of both together.

    Raises
    ------
    BadInputError
        Nothing is left below a plane.
    """
    if not appendages or (volume > 0.0).all():
        return
    k = int(np.argmin(volume))
    added = sum(each.volume * float(each.immersed(planes)[k]) for each in appendages)
    bare = float(volume[k]) - added
    what = f"appendages of {added:g} m3 leave nothing of the {bare:g} m3 of the bare hull"
    at = f"below z {float(planes.height[k]):g} m at AP"
    raise BadInputError(what, f"{where}, {at}", "give volumes that are a part of the hull's")


# --------------------------------------------------------------------------------------
# What hydrostatics and stability ask of a hull.


@attrs.frozen(eq=False)
class StationAreas:
    """Immersed areas of the stations of a hull.

    Attributes
    ----------
    x : (n,), m
        Where the stations are, rising.
    area : (d, n), m2
        Of both sides, below each of d planes.
    names : tuple of n str
        Of the stations.
    """

    x: FloatArray
    area: FloatArray
    names: tuple[str, ...]

    def __attrs_post_init__(self) -> None:
        freeze(self.x, self.area)


@attrs.frozen(eq=False)
class IntegralChange:
    """By how much what is measured may be off: changes that come together, with their signs.

    Attributes
    ----------
    immersed : ImmersedIntegrals
        Changes of the integrals: what a second rule or route gives, less what is published.
    areas : (d, n), m2, or None
        Changes of the areas of the stations; None: not known.
    transom : (d,), m2, or None
        Change of the transom's area.
    """

    immersed: ImmersedIntegrals
    areas: FloatArray | None = None
    transom: FloatArray | None = None


class Measurable(Protocol):
    """A hull that can be cut by planes; both sides of it, m."""

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Give the integrals below each plane."""
        ...

    def stations(self, planes: FloatingPlanes) -> StationAreas:
        """Give the areas of the stations below each plane."""
        ...

    def transom(self, planes: FloatingPlanes) -> FloatArray:
        """Give the area of transoms below each plane, (d,), m2; no end of a bossing is one."""
        ...


class Floatable(Protocol):
    """What can be floated: integrals below planes, and what planes must lie between."""

    @property
    def limits(self) -> WaterplaneLimits:
        """What a waterplane must lie between, and the deck edge."""
        ...

    def measure(self, planes: FloatingPlanes) -> ImmersedIntegrals:
        """Give the integrals below each plane."""
        ...


class FloatingBody(Measurable, Protocol):
    """One that also knows where it floats, and how far its numbers can be trusted."""

    @property
    def limits(self) -> WaterplaneLimits:
        """What a waterplane must lie between, and the deck edge."""
        ...

    def changes(self, planes: FloatingPlanes) -> Sequence[IntegralChange]:
        """Give by how much the integrals may be off; the amounts of several items add up."""
        ...

    def doubts(self, planes: FloatingPlanes, numbers: bool = True) -> Sequence[str]:
        """Name what makes the integrals doubtful; `numbers` compares them by other routes too."""
        ...


# --------------------------------------------------------------------------------------
# Freeboard, and the heel at which the deck edge goes under.

_STEEPEST = 89.0
"""Largest heel that is looked at, degrees: at 90 no plane of the form above is left."""

_STEP = 10.0
"""By how much (degrees) the upper bound of that heel is raised at a time."""

_FINE = 1e-8
"""To how much (degrees) it is found."""


@attrs.frozen
class Freeboard:
    """Where the deck edge is nearest to the water.

    Attributes
    ----------
    least : float, m
        Height of the deck edge above the water, at right angles to the water; below 0 if it is
        under water.
    place : (float, float, float), m
        Of that point of the deck edge; y below 0 to starboard.
    """

    least: float
    place: tuple[float, float, float]


def least_freeboard(deck: FloatArray, position: FloatingPosition, length: float) -> Freeboard:
    """Give the least freeboard.

    Parameters
    ----------
    deck : (n, 3), m
        The deck edge, port side.
    position : FloatingPosition
        Where the hull floats.
    length : float, m
        Between perpendiculars.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
    >>> from assoc_hull.analysis.hydrostatics.floating_body import least_freeboard
    >>> edge = np.array([[0.0, 10, 12], [100, 10, 12]])
    >>> least_freeboard(edge, FloatingPosition(6.0, 5.0), 100.0)
    Freeboard(least=5.99970002249813, place=(0.0, 10.0, 12.0))
    """
    plane = planes_of([position], length)
    both = np.concatenate([deck, deck * [1.0, -1.0, 1.0]])
    x, y, z = both.T
    above = z - plane.height - plane.tan_trim * x + plane.tan_heel * y
    above = above / np.sqrt(1.0 + plane.tan_trim**2 + plane.tan_heel**2)
    near = int(np.argmin(above))
    x0, y0, z0 = both[near].tolist()
    return Freeboard(float(above[near]), (x0, y0, z0))


def deck_edge_heel(
    body: Floatable,
    position: FloatingPosition,
    length: float,
    appendages: tuple[Appendage, ...] = (),
) -> float | None:
    """Give the heel (degrees, to starboard) at which the deck edge goes under.

    Displacement and trim stay as they are. At each heel there is one plane that touches the
    deck edge; the edge is dry as long as the hull displaces more below that plane than it has to.

    Parameters
    ----------
    body : Floatable
        The hull.
    position : FloatingPosition
        Where it floats upright; its own heel does not count.
    length : float, m
        Between perpendiculars.
    appendages : tuple of Appendage
        That carry as well.

    Returns
    -------
    float or None
        0 if it is under water upright; None if it stays dry to 89 degrees.
    """
    upright = attrs.evolve(position, heel_deg=0.0)
    planes = planes_of([upright], length)
    slope = float(planes.tan_trim[0])
    want = float(with_appendages(body.measure(planes), appendages, planes).volume[0])

    def spare(heel: float) -> float:
        """Give what the hull displaces below the plane that touches its deck edge, less that."""
        return _touching_volume(body, heel, slope, length, appendages) - want

    if spare(0.0) <= 0.0:
        return 0.0
    deck = body.limits.deck
    # A box would submerge its deck edge at this angle: the first upper bound of the search.
    turn = np.arctan2(least_freeboard(deck, upright, length).least, np.abs(deck[:, 1]).max() + 1e-9)
    low, high = 0.0, min(1.2 * float(np.degrees(turn)), _STEEPEST)
    while spare(high) > 0.0:
        if high >= _STEEPEST:
            return None
        low, high = high, min(high + _STEP, _STEEPEST)
    return brent_root(spare, low, high, xtol=_FINE)


def _touching_volume(
    body: Floatable,
    heel: float,
    slope: float,
    length: float,
    appendages: tuple[Appendage, ...],
) -> float:
    """Give the volume below the plane that touches the deck edge from below at a heel."""
    turned = np.array([slope]), np.array([np.tan(np.radians(heel))])
    limits = body.limits
    edge = WaterplaneLimits(limits.bottom, limits.deck, closed=False)
    least, most = edge.mean_draughts(FloatingPlanes(np.zeros(1), *turned), length)
    if most[0] <= least[0]:
        return 0.0
    touching = FloatingPlanes(most - 0.5 * length * slope, *turned)
    return float(with_appendages(body.measure(touching), appendages, touching).volume[0])
