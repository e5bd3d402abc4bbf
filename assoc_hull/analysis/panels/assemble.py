"""From bands to a mesh in the axes of seakeeping codes."""

from __future__ import annotations

import itertools

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.panels.arc_division import Divided, divide
from assoc_hull.analysis.panels.bands import Band, Waterplane
from assoc_hull.analysis.panels.caps import caps
from assoc_hull.analysis.panels.fill import between, grid_panels
from assoc_hull.analysis.panels.levels import levels
from assoc_hull.analysis.panels.sheets import Sheet, sheets
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.surfaces.panel_mesh import welded

__all__ = ["Axes", "Choices", "assemble", "axes_of"]

_WELD = 1e-7
"""Vertices so near to one another, in lengths of the ship, are one."""

_CENTRE = 1e-5
"""Vertices so near to the centre plane, in lengths of the ship, lie on it: a millimetre or so, by
which ends of drawn lines may miss it."""


@attrs.frozen
class Choices:
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
class Axes:
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


def axes_of(plane: Waterplane, x: float) -> Axes:
    """Give axes whose origin lies in the water surface at x, on the centre plane of the ship."""
    up = np.array([-plane.tan_trim, plane.tan_heel, 1.0])
    up /= np.sqrt(up @ up)
    forward = np.array([1.0, 0.0, plane.tan_trim])
    forward /= np.sqrt(forward @ forward)
    origin = np.array([x, 0.0, plane.height + plane.tan_trim * x])
    return Axes(origin, np.array([forward, np.cross(up, forward), up]))


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


def assemble(
    every: list[Band], plane: Waterplane, x: FloatArray, choices: Choices, length: float, axes: Axes
) -> tuple[FloatArray, IntArray]:
    """Divide a hull, and give vertices (v, 3), m, and panels (p, 4) in the given axes."""
    found = _sheets(every, plane, x, choices, length)
    divided = divide(found, choices.rows, length, choices.knuckle_deg)
    vertices, panel = _Vertices(), list[IntArray]()
    for sheet, points in zip(found, divided.points, strict=True):
        panel += _fill(sheet, points, vertices)
    if choices.ends:
        panel += _close(found, divided, plane, _CENTRE * length, vertices)
    if not panel:
        return np.zeros((0, 3)), np.zeros((0, 4), np.int64)
    return _finished(vertices, np.concatenate(panel), axes, length, choices.half)


def _sheets(
    every: list[Band], plane: Waterplane, x: FloatArray, choices: Choices, length: float
) -> list[Sheet]:
    """Follow what is wet of all bands, port and, unless half will do, starboard."""
    planes = [plane] if choices.half or plane.tan_heel == 0.0 else [plane, plane.on_starboard()]
    found: list[Sheet] = []
    for i, band in enumerate(every):
        cut = levels(band, planes, x, choices.fixed)
        found += sheets(band, cut, plane, (i, True), length)
        if not choices.half:
            found += sheets(band, cut, plane.on_starboard(), (i, False), length)
    return found


def _fill(sheet: Sheet, points: list[FloatArray], vertices: _Vertices) -> list[IntArray]:
    """Put panels between the levels of a sheet."""
    rows = []
    for places, afloat in zip(points, sheet.afloat, strict=True):
        water = np.zeros(len(places), np.bool_)
        water[[0, -1]] = afloat if len(places) > 1 else afloat.any()
        rows.append(vertices.add(places, water))
    found = [between(aft, fore) for aft, fore in itertools.pairwise(rows)]
    return found if sheet.port else [each[:, ::-1] for each in found]


def _close(
    found: list[Sheet], divided: Divided, plane: Waterplane, centre: float, vertices: _Vertices
) -> list[IntArray]:
    """Put panels over open ends."""
    closed = []
    for cap in caps(found, divided, plane, centre):
        shape = cap.water.shape
        number = vertices.add(cap.grid.reshape(-1, 3), cap.water.ravel())
        panel = grid_panels(number.reshape(shape))
        closed.append(panel[:, ::-1] if cap.turned else panel)
    return closed


def _finished(
    vertices: _Vertices, panel: IntArray, axes: Axes, length: float, half: bool
) -> tuple[FloatArray, IntArray]:
    """Weld the vertices, put them on water surface and centre plane, drop panels within it."""
    places, near = np.concatenate(vertices.places), _WELD * length
    places[np.abs(places[:, 1]) <= _CENTRE * length, 1] = 0.0
    xyz, corners, number = welded(places, panel, near)
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
    """Tell which vertices any of those with a flag has become."""
    found = np.zeros(count, np.bool_)
    found[number[flag & (number >= 0)]] = True
    return found


def _used(xyz: FloatArray, panel: IntArray) -> tuple[FloatArray, IntArray]:
    """Leave out vertices that no panel has."""
    used = np.unique(panel)
    number = np.zeros(len(xyz), np.int64)
    number[used] = np.arange(len(used))
    return xyz[used] + 0.0, number[panel]
