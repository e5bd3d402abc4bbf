"""A 207,000 TDW bulk carrier as a net: single screw, transom stern, bulbous bow.

The form is given by formulas (`assoc_hull.shipped.bulk_carrier_207k_form`). Here they are read
at stations, waterlines and buttocks, with the boundary curves, as lines of points; these are
adopted, and more lines are added to the net.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.edit.adoption.adopt_lines import AdoptionReport, adopt
from assoc_hull.edit.document import Document
from assoc_hull.edit.lines.add_line import add_line
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import EndKind, FloatArray, PointKind
from assoc_hull.model.kinds import BoundaryKind
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.tables import Association, Ends, HullState, Particulars
from assoc_hull.shipped import bulk_carrier_207k_form as form
from assoc_hull.tolerance import Tolerances

__all__ = [
    "boundary_lines",
    "bulk_carrier_207k",
    "bulk_carrier_207k_adopted",
    "bulk_carrier_207k_net",
    "buttock",
    "station",
    "waterline",
]

# --------------------------------------------------------------------------------------
# The given lines of the 207,000 TDW bulk carrier: boundary curves, stations, waterlines.
#
# Each is an exact curve of the form, handed in as points on it that are dense enough to hold it:
# closest where it turns most. Stations and waterlines share the places where they cross.

_SMOOTH, _TANGENT, _KNUCKLE = (int(kind) for kind in PointKind)
_NONE, _AHEAD, _OUT, _UP = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_ASTERN, _IN = (-1.0, 0.0, 0.0), (0.0, -1.0, 0.0)
_ROUND = Ends((int(EndKind.TANGENT),) * 2, (_OUT, _IN))
"""Ends of a circle about the centre plane."""

_HALF = form.BREADTH / 2.0
_FLAT_AFT = 21.0
"""Abaft this x the flat of bottom would be narrower than the keel plate: a station rises
from the centre line."""

_CIRCLE, _BILGE, _EVEN, _LOOSE = 1e-6, 1e-4, 5e-4, 5e-3
"""Tolerances (m) of the bossing's circles, of bilge circles, of waterlines, whose tails are
straight to a few millimetres so that small waves would show, and of buttocks, which stations
and waterlines hold."""


class _Course:
    """The points of a curve with their kinds and directions, in order along it."""

    def __init__(self) -> None:
        self.xyz: list[FloatArray] = []
        self.kind: list[int] = []
        self.direction: list[tuple[float, float, float]] = []

    def add(
        self,
        x: ArrayLike,
        y: ArrayLike,
        z: ArrayLike,
        kind: int = _SMOOTH,
        direction: tuple[float, float, float] = _NONE,
    ) -> None:
        """Append points; single coordinates count for all of them."""
        places = np.column_stack([np.ravel(part) for part in np.broadcast_arrays(x, y, z)])
        self.xyz += list(places)
        self.kind += [kind] * len(places)
        self.direction += [direction] * len(places)

    def source(
        self,
        group: str,
        name: str,
        *,
        plane: tuple[ArrayLike, float] | None = None,
        boundary: BoundaryKind | None = None,
        ends: Ends | None = None,
        tolerance: float = 1e-3,
    ) -> LineSource:
        """Give the curve as it is handed in."""
        return LineSource.make(
            group, name, np.array(self.xyz), plane=plane, boundary=boundary, kind=self.kind,
            direction=np.array(self.direction), ends=ends, tolerance=tolerance,
        )  # fmt: skip


def _quarter(count: int) -> FloatArray:
    """Give places from above 0 to 1, closest at 0, as on a quarter of a circle."""
    return np.asarray(1.0 - np.cos(np.linspace(0.0, np.pi / 2.0, count + 1)[1:]))


# Stations.


def station(number: float, shared: FloatArray) -> list[LineSource]:
    """Give the pieces of a station.

    Parameters
    ----------
    number : float
        AP = 0, FP = 20.
    shared : (k,), m
        Heights of the waterlines: the station has points there.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.shipped.bulk_carrier_207k import station
    >>> boss, counter = station(0.5, np.array([5.0]))
    >>> boss.name, boss.points[[0, -1], 2].tolist()
    ('ST 0.5', [4.275, 5.725])
    """
    x, name = number * form.LENGTH / 20.0, f"ST {number:g}"
    return [_section(name, x, low, high, shared) for low, high in form.height_ranges(x)]


def _section(name: str, x: float, low: float, high: float, shared: FloatArray) -> LineSource:
    side = form.side_height(x)
    closed = high < form.DEPTH
    z = _closed_heights(x, low, high) if closed else _heights(low, side or high)
    z = _with(z, shared)
    course = _Course()
    course.add(x, 0.0, low)
    if low == 0.0 and _FLAT_AFT < x < form.KEEL_FORE:
        course.add(x, form.carrier_half_breadth(x, 0.0), 0.0, _TANGENT, _OUT)
    elif low == 0.0 and x < _FLAT_AFT:
        z = z[z > 0.4]
    course.add(x, form.carrier_half_breadth(x, z[:-1]), z[:-1])
    if side is not None:
        course.add(x, _HALF, side, _TANGENT, _UP)
    course.add(x, 0.0 if closed else form.carrier_half_breadth(x, high), high)
    if closed and form.BOSS_AFT <= x <= form.BOSS_FORE:
        return course.source("sections", name, ends=_ROUND, tolerance=_CIRCLE)
    return course.source("sections", name, tolerance=_BILGE if side == form.BILGE else 1e-3)


def _heights(low: float, high: float) -> FloatArray:
    """Give heights above the foot of a station, up to `high`."""
    if high == form.BILGE:
        return high * _quarter(12)
    turned = low + min(8.0, high - low) * _quarter(16)
    rest = np.arange(low + 8.0, high - 0.3, 0.75)[1:]
    return np.concatenate([turned[turned < high - 0.1], rest, [high]])


def _closed_heights(x: float, low: float, high: float) -> FloatArray:
    """Give heights above the foot of a piece that closes on the contour again."""
    centre = form.SHAFT if x < form.LENGTH / 2.0 else form.NOSE[1]
    upper = high - (high - centre) * np.append(_quarter(12)[-2::-1], 0.0)
    return np.concatenate([low + (centre - low) * _quarter(12), upper])


def _with(z: FloatArray, shared: FloatArray) -> FloatArray:
    """Let heights that are shared take the place of those close by; the last one stays."""
    inner = shared[(shared > z[0]) & (shared < z[-1] - 0.02)]
    own = z[:-1]
    if len(inner):
        own = own[np.abs(own[:, None] - inner).min(axis=1) > 0.04]
    return np.concatenate([np.sort(np.concatenate([own, inner])), z[-1:]])


# Waterlines.

_NEAR_ENDS = np.array([0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0])


def waterline(z: float, shared: FloatArray) -> LineSource:
    """Give a waterline.

    Parameters
    ----------
    z : float, m
        Its height.
    shared : (k,), m
        Places of the stations: the waterline has points there, half-way between, and near its
        ends.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.shipped.bulk_carrier_207k import waterline
    >>> waterline(18.0, np.linspace(0.0, 300.0, 41)).points[-1].tolist()
    [300.0, 0.0, 18.0]
    """
    (aft, breadth), fore = form.aft_end(z), float(form.fore_end(z))
    between = 0.5 * (shared[1:] + shared[:-1])[np.diff(shared) < 16.0]
    own = np.concatenate([between, aft + _NEAR_ENDS, fore - _NEAR_ENDS])
    own = own[np.abs(own[:, None] - shared).min(axis=1) > 0.2]
    x = np.sort(np.concatenate([shared, own]))
    x = x[np.append(True, np.diff(x) > 0.05)]
    x = x[(x > aft + 0.05) & (x < fore - 0.05)]
    shoulder, end = float(form.aft_shoulder(z)), float(form.fore_shoulder(z))
    course, full = _Course(), form.midship(z)
    course.add(aft, breadth, z)
    before, after = x[x < shoulder - 0.5], x[x > end + 0.5]
    course.add(before, form.carrier_half_breadth(before, z), z)
    course.add([shoulder, end], full, z, _TANGENT, _AHEAD)
    course.add(after, form.carrier_half_breadth(after, z), z)
    course.add(fore, 0.0, z)
    return course.source("waterlines", f"WL {z:g}", tolerance=_EVEN)


# Buttocks.

_NEAR_BOTTOM = np.array([0.03, 0.12, 0.25])


def buttock(y: float, shared: FloatArray) -> list[LineSource]:
    """Give the pieces of a buttock near the centre plane.

    Parameters
    ----------
    y : float, m
        Its half-breadth, less than that of the deck at the transom.
    shared : (k,), m
        Heights of the waterlines: the buttock has points there, and half-way between.

    Returns
    -------
    list of LineSource
        One piece, or two where it runs into the bossing end: from the transom down to it, and
        from it down to the bottom, forward, and up to the deck.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.shipped.bulk_carrier_207k import buttock
    >>> over, under = buttock(0.5, np.array([1.0, 18.0]))
    >>> over.points[-1].round(3).tolist(), under.points[0].round(3).tolist()
    ([6.0, 0.5, 5.525], [6.0, 0.5, 4.475])
    """
    z = np.unique(np.concatenate([shared, 0.5 * (shared[1:] + shared[:-1]), _NEAR_BOTTOM]))
    name, course, found = f"BTK {y:g}", _Course(), list[LineSource]()
    top = form.transom_height(y)
    course.add(form.TRANSOM, y, top)
    down = z[z < top - 0.1][::-1]
    if y < form.BOSS:
        reach = float(np.sqrt(form.BOSS * form.BOSS - y * y))
        _climb(course, y, down[down > form.SHAFT + reach + 0.05], aft=True)
        course.add(form.BOSS_FORE, y, form.SHAFT + reach, _TANGENT, _ASTERN)
        course.add(form.BOSS_AFT, y, form.SHAFT + reach)
        found.append(course.source("buttocks", name, tolerance=_LOOSE))
        course = _Course()
        course.add(form.BOSS_AFT, y, form.SHAFT - reach)
        course.add(form.BOSS_FORE, y, form.SHAFT - reach, _TANGENT, _AHEAD)
        down = down[down < form.SHAFT - reach - 0.05]
    _climb(course, y, down, aft=True)
    ends = [form.reaches(y, 0.0, aft=True), form.reaches(y, 0.0, aft=False)]
    course.add(ends, y, 0.0, _TANGENT, _AHEAD)
    _climb(course, y, np.append(z, form.DEPTH), aft=False)
    return [*found, course.source("buttocks", name, tolerance=_LOOSE)]


def _climb(course: _Course, y: float, z: FloatArray, *, aft: bool) -> None:
    """Append the places of a buttock at heights."""
    course.add([form.reaches(y, height, aft=aft) for height in z.tolist()], y, z)


# Boundary curves.


def boundary_lines() -> list[LineSource]:
    """Give profile, bossing end, transom, deck edge, flat of side and flat of bottom.

    Examples
    --------
    >>> from assoc_hull.shipped.bulk_carrier_207k import boundary_lines
    >>> sorted({line.name for line in boundary_lines()})[:3]
    ['bossing end', 'deck edge', 'flat of bottom']
    """
    return [
        _profile_over(), _profile_under(), _bossing_end(), _transom(), _deck_edge(),
        _flat_of_side(), _flat_of_bottom(),
    ]  # fmt: skip


def _profile_over() -> LineSource:
    """From the transom down to the aperture, round its corner and aft along the cylinder."""
    course, top = _Course(), form.SHAFT + form.BOSS
    down, on = np.linspace(form.TRANSOM_LOW, form.CORNER, 50), np.linspace(form.CORNER, top, 15)
    course.add(form.contour_over_bossing(down[:-1]), 0.0, down[:-1])
    course.add(form.contour_over_bossing(form.CORNER), 0.0, form.CORNER, _KNUCKLE)
    course.add(form.contour_over_bossing(on[1:-1]), 0.0, on[1:-1])
    course.add(form.BOSS_FORE, 0.0, top, _KNUCKLE)
    course.add(form.BOSS_AFT, 0.0, top)
    return _profile(course)


def _profile_under() -> LineSource:
    """From the cylinder down to the keel, forward, round the bulb and up the stem."""
    course = _Course()
    skeg = np.linspace(form.BOSS_FORE, form.KEEL_AFT, 27)
    course.add(form.BOSS_AFT, 0.0, form.SHAFT - form.BOSS)
    course.add(form.BOSS_FORE, 0.0, form.SHAFT - form.BOSS, _TANGENT, _AHEAD)
    course.add(skeg[1:-1], 0.0, form.contour_under_bossing(skeg[1:-1]))
    course.add([form.KEEL_AFT, form.KEEL_FORE], 0.0, 0.0, _TANGENT, _AHEAD)
    nose = form.NOSE[1] * _quarter(40)
    stem = np.linspace(form.NOSE[1], form.DEPTH, 61)[1:]
    z = np.concatenate([nose, stem])
    course.add(form.fore_end(z), 0.0, z)
    return _profile(course)


def _profile(course: _Course) -> LineSource:
    plane = (0.0, 1.0, 0.0), 0.0
    return course.source("boundary", "profile", plane=plane, boundary=BoundaryKind.END)


def _bossing_end() -> LineSource:
    """From the lower to the upper side of the cylinder, across its end."""
    angle = np.linspace(-np.pi / 2.0, np.pi / 2.0, 25)
    y = form.BOSS * np.cos(angle)
    y[[0, -1]] = 0.0
    course = _Course()
    course.add(form.BOSS_AFT, y, form.SHAFT + form.BOSS * np.sin(angle))
    return course.source(
        "boundary", "bossing end", plane=(_AHEAD, form.BOSS_AFT), boundary=BoundaryKind.END,
        ends=_ROUND, tolerance=_CIRCLE,
    )  # fmt: skip


def _transom() -> LineSource:
    """From its lowest point up to the deck."""
    z = form.TRANSOM_LOW + (form.DEPTH - form.TRANSOM_LOW) * np.linspace(0.0, 1.0, 25) ** 1.5
    course = _Course()
    course.add(form.TRANSOM, 0.0, z[0])
    course.add(form.TRANSOM, form.carrier_half_breadth(form.TRANSOM, z[1:]), z[1:])
    plane = _AHEAD, form.TRANSOM
    return course.source("boundary", "transom", plane=plane, boundary=BoundaryKind.END)


def _deck_edge() -> LineSource:
    z = form.DEPTH
    aft, fore = float(form.aft_shoulder(z)), float(form.fore_shoulder(z))
    run = np.linspace(form.TRANSOM, aft, 40)[:-1]
    entrance = fore + (float(form.fore_end(z)) - fore) * np.sin(np.linspace(0.0, np.pi / 2.0, 50))
    course = _Course()
    course.add(run, form.carrier_half_breadth(run, z), z)
    course.add([aft, fore], _HALF, z, _TANGENT, _AHEAD)
    course.add(entrance[1:-1], form.carrier_half_breadth(entrance[1:-1], z), z)
    course.add(entrance[-1], 0.0, z)
    return course.source("boundary", "deck edge", plane=(_UP, z), boundary=BoundaryKind.END)


def _flat_of_side() -> LineSource:
    """From the deck aft down to the bilge, forward along it and up to the deck again."""
    z = form.DEPTH - (form.DEPTH - form.BILGE) * np.sin(np.linspace(0.0, np.pi / 2.0, 40))[:-1]
    course = _Course()
    course.add(form.aft_shoulder(z), _HALF, z)
    corners = [float(form.aft_shoulder(form.BILGE)), float(form.fore_shoulder(form.BILGE))]
    course.add(corners, _HALF, form.BILGE, _KNUCKLE)
    course.add(form.fore_shoulder(z[::-1]), _HALF, z[::-1])
    return course.source(
        "boundary", "flat of side", plane=(_OUT, _HALF), boundary=BoundaryKind.FLAT
    )


def _flat_of_bottom() -> LineSource:
    aft, fore = float(form.aft_shoulder(0.0)), float(form.fore_shoulder(0.0))
    run = np.linspace(_FLAT_AFT, aft, 60)[:-1]
    entrance = np.linspace(fore, form.KEEL_FORE, 60)[1:-1]
    course = _Course()
    course.add(run, form.carrier_half_breadth(run, 0.0), 0.0)
    course.add([aft, fore], form.midship(0.0), 0.0, _TANGENT, _AHEAD)
    course.add(entrance, form.carrier_half_breadth(entrance, 0.0), 0.0)
    course.add(form.KEEL_FORE, 0.0, 0.0)
    return course.source("boundary", "flat of bottom", plane=(_UP, 0.0), boundary=BoundaryKind.FLAT)


# --------------------------------------------------------------------------------------
# A 207,000 TDW bulk carrier as a net: single screw, transom stern, bulbous bow.
#
# Principal dimensions, bilge radius and bossing are those of the example of Choi & Lee, "A Study on
# the Hull Form Design System on the Basis of the Associative Geometry Objects", J. SNAK 36(4),
# 1999. The form is our own; stations stand clear of where the stem meets a waterline.

_STATIONS = (
    -0.25, 0.0, 0.28, 0.45, 0.5, 0.62, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5,
    5.0, 6.0, 8.0, 10.0, 12.0, 14.0, 15.0, 15.5, 16.0, 16.5, 17.0, 17.5, 18.0, 18.25, 18.5, 18.75,
    19.0, 19.2, 19.4, 19.6, 19.8, 20.04, 20.175, 20.3,
)  # fmt: skip
_WATERLINES = (
    0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.5, 15.0, 16.5, 18.0,
    20.0, 22.0, 24.5,
)  # fmt: skip
_GIVEN = (0.5, 1.0)
"""The buttocks near the centre plane are drawn: they shape the stern above the propeller."""

_BUTTOCKS = (2.0, 4.0, 6.0, 8.5, 11.0, 13.5, 16.0, 18.5, 21.0, 23.5)

_ASSOCIATIONS = (
    Association("boundary", "sections"),
    Association("boundary", "waterlines"),
    Association("boundary", "buttocks"),
    Association("sections", "waterlines"),
    Association("sections", "buttocks"),
    Association("waterlines", "buttocks"),
)

_TOLERANCES = Tolerances(spacing=0.12, turn_spacing=0.3, adopted_spacing=0.01)
"""At the stern the lines stand closer than elsewhere, and waterlines, stations and buttocks are
to shape it alike: the least spacing is a smaller part of the median than by default. The bossing
end, a circle of 0.725 m radius, is drawn by points closer than one adopts elsewhere."""

_KEEP = 0.6e-3
"""How far (m) one crossing of a buttock that is cut may move a line that was there."""


def bulk_carrier_207k_adopted() -> tuple[HullState, AdoptionReport]:
    """Adopt boundary curves, 41 stations, 20 waterlines and two buttocks.

    Returns
    -------
    HullState, AdoptionReport
    """
    x, z = np.array(_STATIONS) * form.LENGTH / 20.0, np.array(_WATERLINES)
    sources = boundary_lines()
    sources += [piece for number in _STATIONS for piece in station(number, z)]
    sources += [waterline(height, x) for height in _WATERLINES]
    sources += [piece for y in _GIVEN for piece in buttock(y, z)]
    ship = Particulars(
        "Bulk carrier 207,000 TDW", form.LENGTH, form.BREADTH, form.DEPTH, form.DRAUGHT, "closed"
    )
    return adopt(sources, ship, _ASSOCIATIONS, _TOLERANCES)


def bulk_carrier_207k() -> HullState:
    """Make the net of 41 stations, 20 waterlines and 12 buttocks.

    Lpp 300 m, B 50 m, T 18 m, depth 27 m, block coefficient 0.84, bilge radius 2.4 m; the
    bossing ends as a cylinder of 0.725 m radius about the shaft at 5.0 m. Sections are named
    by station (AP = 0, FP = 20), waterlines by height and buttocks by half-breadth in metres.

    Returns
    -------
    HullState
    """
    return bulk_carrier_207k_net()[0]


def bulk_carrier_207k_net() -> tuple[HullState, AdoptionReport]:
    """Make the net of `bulk_carrier_207k`, with the report of how its lines were adopted.

    Returns
    -------
    HullState, AdoptionReport
    """
    state, report = bulk_carrier_207k_adopted()
    with Transaction(Document(state), "cut buttocks") as edit:
        for y in _BUTTOCKS:
            add_line(edit, "buttocks", y, f"BTK {y:g}", _KEEP)
    return state, report
