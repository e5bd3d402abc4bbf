"""From divided sheets to a mesh of panels in the axes of seakeeping codes.

Panels are put between the points of neighbouring arcs (`panels_between`), and over what the surface
leaves open at its ends: transoms, ends of bossings (`cap_open_ends`). Then vertices are welded,
moved exactly onto water surface and centre plane, and panels within the hull are dropped. Until
`MeshAxes` turns them, points are in ship axes, m; panels face into the water.
"""

from __future__ import annotations

import itertools

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.panels.arc_division import DividedSheets, SheetArc, divide_sheets
from assoc_hull.analysis.panels.wet_sheets import (
    Band,
    Waterplane,
    WetSheet,
    band_levels,
    wet_sheets,
)
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.surfaces.panel_mesh import weld_vertices

__all__ = [
    "DivisionChoices",
    "EndCap",
    "MeshAxes",
    "assemble_mesh",
    "axes_of",
    "cap_open_ends",
    "coons_grid",
    "grid_panels",
    "panels_between",
]

# --------------------------------------------------------------------------------------
# Panels between the points of neighbouring arcs.

_LEVEL = 0.25
"""Points of two arcs face one another where they differ by less than this part of a step."""


def panels_between(aft: IntArray, fore: IntArray) -> IntArray:
    """Join two rows of vertices by panels, (p, 4), that face to port if the rows run up.

    Rows of equal length are joined by quadrilaterals, a row and a single vertex by triangles;
    others by quadrilaterals where their points face one another and triangles between.

    Parameters
    ----------
    aft, fore : (m,) and (n,) int
        Vertices, from keel to deck.

    Returns
    -------
    (p, 4) int
        Vertices of each panel; those of a triangle end with the third one twice.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.panels.assemble_mesh import panels_between
    >>> panels_between(np.array([0, 1]), np.array([2, 3])).tolist()
    [[0, 1, 3, 2]]
    >>> panels_between(np.array([0, 1]), np.array([2])).tolist()
    [[0, 1, 2, 2]]
    """
    m, n = len(aft) - 1, len(fore) - 1
    if m == n:
        return np.stack([aft[:-1], aft[1:], fore[1:], fore[:-1]], axis=1)
    if n == 0:
        return np.stack([aft[:-1], aft[1:], *[np.full(m, fore[0])] * 2], axis=1)
    if m == 0:
        return np.stack([np.full(n, aft[0]), fore[1:], fore[:-1], fore[:-1]], axis=1)
    return _zipped(aft, fore)


def _zipped(aft: IntArray, fore: IntArray) -> IntArray:
    """Join rows of different lengths (m + 1,), (n + 1,), always at the point that is lower."""
    m, n = len(aft) - 1, len(fore) - 1
    near = _LEVEL / max(m, n)
    i = j = 0
    found = []
    while i < m or j < n:
        up, across = (i + 1) / m, (j + 1) / n
        if i < m and j < n and abs(up - across) <= near:
            found.append((aft[i], aft[i + 1], fore[j + 1], fore[j]))
            i, j = i + 1, j + 1
        elif j >= n or (i < m and up < across):
            found.append((aft[i], aft[i + 1], fore[j], fore[j]))
            i += 1
        else:
            found.append((aft[i], fore[j + 1], fore[j], fore[j]))
            j += 1
    return np.array(found, np.int64)


def grid_panels(grid: IntArray) -> IntArray:
    """Make panels of a grid of vertices, (m, n), that face along first times second direction."""
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    return np.stack([a, b, c, d], axis=2).reshape(-1, 4)


def coons_grid(
    low: FloatArray, right: FloatArray, high: FloatArray, left: FloatArray
) -> FloatArray:
    """Fill four sides with a grid of points, (m, n, 3): Coons's bilinear patch.

    `low` and `high` (m, 3) run to the right, `left` and `right` (n, 3) up.
    """
    u = np.linspace(0.0, 1.0, len(low))[:, None, None]
    v = np.linspace(0.0, 1.0, len(left))[None, :, None]
    across = (1.0 - v) * low[:, None] + v * high[:, None]
    along = (1.0 - u) * left[None] + u * right[None]
    corners = (1.0 - v) * ((1.0 - u) * low[0] + u * low[-1]) + v * (
        (1.0 - u) * high[0] + u * high[-1]
    )
    found: FloatArray = across + along - corners
    # The sides themselves, without the rounding of the blend.
    found[:, 0], found[:, -1], found[0], found[-1] = low, high, left, right
    return found


# --------------------------------------------------------------------------------------
# Open ends. The half face between an arc and the centre plane is a patch of four sides: the arc is
# cut at the point that lies farthest off its chord, into bottom and side; the waterline and the
# centre line face them. An arc that does not begin on the centre plane is closed with itself.


@attrs.frozen(eq=False)
class EndCap:
    """A face as a grid of places.

    Attributes
    ----------
    grid : (m, n, 3), m
        First direction outward along bottom and waterline, second upward.
    turned : bool
        Its panels face against the cross product of these directions.
    water : (m, n) bool
        Places on the waterplane.
    """

    grid: FloatArray
    turned: bool
    water: NDArray[np.bool_]


@attrs.frozen(eq=False)
class _Open:
    """A run of points at the end of a band beyond which nothing is.

    `where` is the band, its end and whether this is port; `begins` and `water` say whether the
    first and the last point lie on the waterplane.
    """

    places: FloatArray
    where: tuple[int, int, bool]
    begins: bool
    water: bool

    @property
    def end(self) -> int:
        return self.where[1]

    @property
    def port(self) -> bool:
        return self.where[2]


def cap_open_ends(
    every: list[WetSheet], divided: DividedSheets, plane: Waterplane, centre: float
) -> list[EndCap]:
    """Close all open ends; points within `centre` (m) of the centre plane lie on it.

    `plane` is the water as port sees it.
    """
    found = []
    left = _open(every, divided, centre)
    while left:
        each = left.pop(0)
        if abs(each.places[0, 1]) > centre:
            found.append(_with_itself(each))
            continue
        partner = next((other for other in left if _faces(other, each, centre)), None)
        halves = [each] if partner is None else [each, partner]
        if partner is not None:
            left.remove(partner)
        top = _top(each, partner, plane)
        # Both halves of a face share the centre line, and with it the number of points there.
        side = len(each.places) - 1 - _corner(each.places)
        side = min(side, *(len(half.places) - 2 for half in halves))
        found += [_half(half, len(half.places) - 1 - side, top) for half in halves]
    return found


def _open(every: list[WetSheet], divided: DividedSheets, centre: float) -> list[_Open]:
    """Find what is open at the ends of bands, runs of one face joined."""
    found: list[_Open] = []
    for arc in divided.arcs:
        sheet = every[arc.sheet]
        if not (sheet.open_fore if arc.end else sheet.open_aft):
            continue
        for each in _alone(sheet, arc, divided, centre):
            before = found[-1] if found else None
            if before is not None and _goes_on(before, each):
                places = np.concatenate([before.places, each.places])
                found[-1] = attrs.evolve(each, places=places, begins=before.begins)
            else:
                found.append(each)
    return found


def _alone(sheet: WetSheet, arc: SheetArc, divided: DividedSheets, centre: float) -> list[_Open]:
    """Find the runs of pieces off the centre plane that no other sheet has at that end."""
    pieces = [divided.pieces[each] for each in arc.pieces]
    alone = [
        len(piece.users) == 1 and bool((np.abs(piece.places[:, 1]) > centre).any())
        for piece in pieces
    ]
    edge = np.diff(np.array([False, *alone, False]).astype(int))
    afloat = sheet.afloat[arc.chain]
    found = []
    for first, last in zip(
        np.flatnonzero(edge > 0).tolist(), np.flatnonzero(edge < 0).tolist(), strict=True
    ):
        run = [each.points for each in pieces[first:last]]
        places = np.concatenate([*(each[:-1] for each in run), run[-1][-1:]])
        begins = first == 0 and bool(afloat[0])
        ends = last == len(pieces) and bool(afloat[1])
        found.append(_Open(places, (sheet.band, arc.end, sheet.port), begins, ends))
    return found


def _goes_on(one: _Open, other: _Open) -> bool:
    """Tell whether an arc comes back into the water inboard of where it left it: one face."""
    if one.where != other.where or not (one.water and other.begins):
        return False
    return abs(float(other.places[0, 1])) < abs(float(one.places[-1, 1]))


def _faces(one: _Open, other: _Open, near: float) -> bool:
    """Tell whether two runs are halves of one face."""
    apart = float(np.abs(one.places[0] - other.places[0]).max())
    return one.end == other.end and one.port != other.port and apart <= 10.0 * near


def _corner(places: FloatArray) -> int:
    """Give the number of the point farthest off the chord, between bottom and side; no end."""
    chord = places[-1] - places[0]
    way = places - places[0]
    size = float((chord**2).sum())
    off = way - ((way @ chord) / (size if size > 0.0 else 1.0))[:, None] * chord
    far = (off**2).sum(axis=1)
    corner = int(far.argmax()) if far.max() > 1e-6 * size else len(places) // 2
    return min(max(corner, 1), len(places) - 2)


def _top(each: _Open, partner: _Open | None, plane: Waterplane) -> FloatArray:
    """Give the upper end of the centre line of a face: where the waterline crosses y = 0."""
    last: FloatArray = each.places[-1]
    if not each.water:
        return last
    if partner is not None and partner.water and partner.places[-1, 1] != last[1]:
        other = partner.places[-1]
        # In the same order whichever half asks, so that both get the same place.
        a, b = (last, other) if each.port else (other, last)
        part = a[1] / (a[1] - b[1])
        found: FloatArray = a + part * (b - a)
        found[1] = 0.0
        return found
    x = float(last[0])
    return np.array([x, 0.0, plane.height + plane.tan_trim * x])


def _half(each: _Open, corner: int, top: FloatArray) -> EndCap:
    """Fill the half face between an arc and the centre line."""
    places = each.places
    bottom, side = places[: corner + 1], places[corner:]
    left = _line(places[0], top, len(side))
    grid = coons_grid(bottom, side, _line(top, places[-1], len(bottom)), left)
    water = np.zeros(grid.shape[:2], np.bool_)
    water[:, -1] = each.water
    return EndCap(grid, _turned(each), water)


def _with_itself(each: _Open) -> EndCap:
    """Fill what an arc cuts off between its two ends."""
    places = each.places
    count = len(places)
    half = (count + 1) // 2
    grid = np.stack([places[:half], places[::-1][:half]], axis=1)
    water = np.zeros(grid.shape[:2], np.bool_)
    water[0] = each.water
    return EndCap(grid[:, ::1], _turned(each), water)


def _turned(each: _Open) -> bool:
    """Tell whether the face runs against its grid: bottom to port times up looks forward."""
    return bool((each.end == 0) == each.port)


def _line(first: FloatArray, last: FloatArray, count: int) -> FloatArray:
    part = np.linspace(0.0, 1.0, count)[:, None]
    found: FloatArray = first + part * (last - first)
    found[-1] = last
    return found


# --------------------------------------------------------------------------------------
# From bands to a mesh.

_WELD = 1e-7
"""Vertices this near to one another, in lengths of the ship, are one."""

_CENTRE = 1e-5
"""Vertices this near to the centre plane, in lengths of the ship, lie on it: a millimetre or so, by
which ends of drawn lines may miss it."""


@attrs.frozen
class DivisionChoices:
    """How a hull is to be divided.

    Attributes
    ----------
    rows : int
        Panels along a whole half section.
    fixed : bool
        The stations were given one by one: none is left out.
    half : bool
        Port only.
    ends : bool
        Transoms and other flat ends are closed.
    knuckle_deg : float or None
        Points are put on knuckles that turn by more.
    """

    rows: int
    fixed: bool
    half: bool
    ends: bool
    knuckle_deg: float | None


@attrs.frozen(eq=False)
class MeshAxes:
    """Axes with the water surface at z = 0.

    Attributes
    ----------
    origin : (3,), m
        In the axes of the ship.
    turn : (3, 3)
        Unit vectors forward, to port and up, one per row, in the axes of the ship.
    """

    origin: FloatArray
    turn: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.origin, self.turn)

    def of_ship(self, places: FloatArray) -> FloatArray:
        """Give places (k, 3) of the ship in these axes."""
        found: FloatArray = (places - self.origin) @ self.turn.T
        return found


def axes_of(plane: Waterplane, x: float) -> MeshAxes:
    """Give axes whose origin lies in the water surface at x, on the centre plane of the ship."""
    up = np.array([-plane.tan_trim, plane.tan_heel, 1.0])
    up /= np.sqrt(up @ up)
    forward = np.array([1.0, 0.0, plane.tan_trim])
    forward /= np.sqrt(forward @ forward)
    origin = np.array([x, 0.0, plane.height + plane.tan_trim * x])
    return MeshAxes(origin, np.array([forward, np.cross(up, forward), up]))


@attrs.define(eq=False)
class _Vertices:
    """Vertices in the making; those of `water` lie in the water surface."""

    places: list[FloatArray] = attrs.field(factory=list)
    water: list[NDArray[np.bool_]] = attrs.field(factory=list)
    count: int = 0

    def add(self, places: FloatArray, water: NDArray[np.bool_]) -> IntArray:
        """Add vertices; give their numbers."""
        self.places.append(places)
        self.water.append(water)
        self.count += len(places)
        return np.arange(self.count - len(places), self.count)


def assemble_mesh(
    every: list[Band],
    plane: Waterplane,
    x: FloatArray,
    choices: DivisionChoices,
    length: float,
    axes: MeshAxes,
) -> tuple[FloatArray, IntArray]:
    """Divide a hull, and give vertices (v, 3), m, and panels (p, 4) in the given axes."""
    found = _sheets(every, plane, x, choices, length)
    divided = divide_sheets(found, choices.rows, length, choices.knuckle_deg)
    vertices, panel = _Vertices(), list[IntArray]()
    for sheet, points in zip(found, divided.points, strict=True):
        panel += _fill(sheet, points, vertices)
    if choices.ends:
        panel += _close(found, divided, plane, _CENTRE * length, vertices)
    if not panel:
        return np.zeros((0, 3)), np.zeros((0, 4), np.int64)
    return _finished(vertices, np.concatenate(panel), axes, length, choices.half)


def _sheets(
    every: list[Band], plane: Waterplane, x: FloatArray, choices: DivisionChoices, length: float
) -> list[WetSheet]:
    """Follow what is wet of all bands, port and, unless half will do, starboard."""
    planes = [plane] if choices.half or plane.tan_heel == 0.0 else [plane, plane.on_starboard()]
    found: list[WetSheet] = []
    for i, band in enumerate(every):
        cut = band_levels(band, planes, x, choices.fixed)
        found += wet_sheets(band, cut, plane, (i, True), length)
        if not choices.half:
            found += wet_sheets(band, cut, plane.on_starboard(), (i, False), length)
    return found


def _fill(sheet: WetSheet, points: list[FloatArray], vertices: _Vertices) -> list[IntArray]:
    """Put panels between the levels of a sheet."""
    rows = []
    for places, afloat in zip(points, sheet.afloat, strict=True):
        water = np.zeros(len(places), np.bool_)
        water[[0, -1]] = afloat if len(places) > 1 else afloat.any()
        rows.append(vertices.add(places, water))
    found = [panels_between(aft, fore) for aft, fore in itertools.pairwise(rows)]
    return found if sheet.port else [each[:, ::-1] for each in found]


def _close(
    found: list[WetSheet],
    divided: DividedSheets,
    plane: Waterplane,
    centre: float,
    vertices: _Vertices,
) -> list[IntArray]:
    """Put panels over open ends."""
    closed = []
    for cap in cap_open_ends(found, divided, plane, centre):
        shape = cap.water.shape
        number = vertices.add(cap.grid.reshape(-1, 3), cap.water.ravel())
        panel = grid_panels(number.reshape(shape))
        closed.append(panel[:, ::-1] if cap.turned else panel)
    return closed


def _finished(
    vertices: _Vertices, panel: IntArray, axes: MeshAxes, length: float, half: bool
) -> tuple[FloatArray, IntArray]:
    """Weld vertices, move them onto water surface and centre plane, drop panels within the hull."""
    places, near = np.concatenate(vertices.places), _WELD * length
    places[np.abs(places[:, 1]) <= _CENTRE * length, 1] = 0.0
    xyz, corners, number = weld_vertices(places, panel, near)
    water, middle = _marked(number, np.concatenate(vertices.water), len(xyz)), xyz[:, 1] == 0.0
    turned = axes.of_ship(xyz)
    # A section that has just dipped into the water is broad and not deep: it lies in the surface.
    water |= np.abs(turned[:, 2]) <= near
    left_out = _within(corners, middle, half) | water[corners].all(axis=1)
    turned[water, 2] = 0.0
    if axes.turn[1, 2] == 0.0:  # upright: y is what it was
        turned[middle, 1] = 0.0
    return _used(turned, corners[~left_out])


def _within(corners: IntArray, middle: NDArray[np.bool_], half: bool) -> NDArray[np.bool_]:
    """Tell which panels lie in the centre plane with the hull on both sides, or its mirror image.

    There the hull has no thickness: panels of port and starboard would lie on one another.
    """
    inside = np.asarray(middle[corners].all(axis=1))
    if half or not inside.any():
        return inside
    found = inside.copy()
    key = np.sort(corners[inside], axis=1)
    which, count = np.unique(key, axis=0, return_inverse=True, return_counts=True)[1:]
    found[inside] = count[which.ravel()] == 2
    return found


def _marked(number: IntArray, flag: NDArray[np.bool_], count: int) -> NDArray[np.bool_]:
    """Tell which welded vertices, (count,), came from any with a flag; negative: it is gone."""
    found = np.zeros(count, np.bool_)
    found[number[flag & (number >= 0)]] = True
    return found


def _used(xyz: FloatArray, panel: IntArray) -> tuple[FloatArray, IntArray]:
    """Leave out vertices that no panel has."""
    used = np.unique(panel)
    number = np.zeros(len(xyz), np.int64)
    number[used] = np.arange(len(used))
    return xyz[used] + 0.0, number[panel]
