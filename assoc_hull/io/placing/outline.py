"""Outline of a hull that is not placed yet: base line, perpendiculars, bottom, stem.

A hull is known here by straight edges in space (of triangles, or along lines), by the segments of
its contour in the centre plane, and by its deck edge. All is in m, x forward, y across the ship and
z up, with the origin of the file.

The bottom of a hull on the centre line: its lowest place, its rake, and what hangs below it.

The base line goes by the bottom between .3 and .7 of the waterline's length: domes and bulbs lie
before that stretch, skegs and bossings behind it, and a fin on it is told by its steep ends.

Where the stem meets a waterline: behind a bulb that pierces it, and above one that it cuts.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.surfaces.triangles import Triangles, boundary_edges
from assoc_hull.io.lines.slices import HullSlices, SliceLine

__all__ = [
    "HullOutline",
    "Keel",
    "Level",
    "StemPlace",
    "find_stem",
    "measure_keel",
    "outline_of_mesh",
    "outline_of_sections",
    "outline_of_slices",
    "station_doubt",
]

_BESIDE = 1e-6
"""The contour is cut this part of the size of the hull beside y = 0, where triangles lie."""

_OPEN = 1e-4
"""An open edge this part of the size near y = 0 belongs to the contour of half a hull."""

_SAME = 1e-4
"""Crossings of the contour this part of the size apart are one."""

_END = 0.2
"""Pieces of sections over a bulb are looked for in this part of the length from either end."""

_SIDE = 0.9
"""Points amidships this part of the greatest half-breadth off and more are on the side."""


@attrs.frozen
class Level:
    """A hull at one height: where its waterline ends, and how broad it is there; m."""

    aft: float
    fore: float
    half_breadth: float


_RIM = 1e-9
"""Of the height of a hull: what is nearer to its top lies at it."""


@attrs.frozen(eq=False)
class HullOutline:
    """Edges of a hull and its contour in the centre plane.

    Attributes
    ----------
    xyz : (n, 3), m
        Places.
    edge : (m, 2) int
        Straight edges between them.
    centre : (k, 2, 2), m
        Segments of the centre-line contour, (x, z) at both ends, in no order.
    deck : (d, 2) or None, m
        Deck edge as (x, z), from aft, where it is known.
    stations : (s,) or None, m
        Where sections stand, of a hull that is known by lines.
    doubt : float, m
        How far the stem may be off where sections alone tell it.
    """

    xyz: FloatArray
    edge: IntArray
    centre: FloatArray
    deck: FloatArray | None = None
    stations: FloatArray | None = None
    doubt: float = 0.0

    def __attrs_post_init__(self) -> None:
        freeze(self.xyz, self.edge, self.centre)

    @property
    def low(self) -> FloatArray:
        """Least coordinates, (3,), m."""
        return np.asarray(self.xyz.min(axis=0))

    @property
    def high(self) -> FloatArray:
        """Greatest coordinates, (3,), m."""
        return np.asarray(self.xyz.max(axis=0))

    @property
    def size(self) -> float:
        """Length over all, m."""
        return float(np.ptp(self.xyz[:, 0]))

    def inside(self, z: float) -> float:
        """Give a height, m; at the very top of the hull that right below it.

        A hull may end at its waterline: rounding must not tell what is left above.
        """
        low, high = float(self.low[2]), float(self.high[2])
        rim = _RIM * (high - low)
        return high - rim if abs(z - high) < rim else z

    def cut(self, axis: int, value: float) -> FloatArray:
        """Give the places where edges pass a plane across an axis, (k, 3); edges in it count."""
        a, b = self.xyz[self.edge[:, 0]], self.xyz[self.edge[:, 1]]
        first, last = a[:, axis] - value, b[:, axis] - value
        through = first * last <= 0.0
        a, b, first, last = a[through], b[through], first[through], last[through]
        level = first == last
        part = first / np.where(level, 1.0, first - last)
        places = a + np.where(level, 0.0, part)[:, None] * (b - a)
        # A place at the end of an edge is that of its vertex, to the bit.
        places[last == 0.0] = b[last == 0.0]
        return np.concatenate([places, b[level]])

    def level(self, z: float) -> Level | None:
        """Measure the hull at a height; None where it has no waterline there."""
        places = self.cut(2, z)
        contour = self.contour(z)
        x = np.concatenate([places[:, 0], contour])
        if not len(x):
            return None
        half = float(np.abs(places[:, 1]).max(initial=0.0))
        return Level(float(x.min()), float(x.max()), half)

    def contour(self, z: float) -> FloatArray:
        """Give x of the centre-line contour at a height, (k,), ascending, each once."""
        first, last = self.centre[:, 0], self.centre[:, 1]
        low, high = first[:, 1] - z, last[:, 1] - z
        through = low * high <= 0.0
        first, last, low, high = first[through], last[through], low[through], high[through]
        level = low == high
        part = np.where(level, 0.0, low / np.where(level, 1.0, low - high))
        x = first[:, 0] + part * (last[:, 0] - first[:, 0])
        x = np.sort(np.concatenate([x, last[level, 0]]))
        apart = np.diff(x, prepend=-np.inf) > _SAME * self.size
        return np.asarray(x[apart])

    def bottom(self, x: FloatArray) -> FloatArray:
        """Give the lowest height of the contour at each x, (k,); nan where there is none."""
        found = np.full(len(x), np.nan)
        first, last = self.centre[:, 0], self.centre[:, 1]
        swap = (first[:, 0] > last[:, 0])[:, None]
        first, last = np.where(swap, last, first), np.where(swap, first, last)
        long = np.maximum(last[:, 0] - first[:, 0], 1e-300)
        for i, place in enumerate(x.tolist()):
            on = (first[:, 0] <= place) & (place <= last[:, 0])
            if on.any():
                part = (place - first[on, 0]) / long[on]
                z = first[on, 1] + np.clip(part, 0.0, 1.0) * (last[on, 1] - first[on, 1])
                found[i] = z.min()
        return found

    def deck_height(self, x: float) -> float:
        """Give the height of the deck edge at x: as drawn, else the top of the side there."""
        if self.deck is not None and self.deck[0, 0] <= x <= self.deck[-1, 0]:
            return float(np.interp(x, self.deck[:, 0], self.deck[:, 1]))
        if self.stations is not None and len(self.stations):
            x = float(self.stations[int(np.abs(self.stations - x).argmin())])
        places = self.cut(0, x)
        if not len(places):
            return float(self.xyz[:, 2].max())
        half = np.abs(places[:, 1])
        return float(places[half >= _SIDE * half.max(), 2].max())


# --------------------------------------------------------------------------------------
# From what readers have.


def outline_of_mesh(mesh: Triangles) -> HullOutline:
    """Outline a mesh (m) whose centre plane is y = 0, whole or half."""
    xyz, face = mesh.xyz, mesh.face
    size = float(np.ptp(xyz[:, 0]))
    rim = boundary_edges(mesh)
    near = (np.abs(xyz[rim][:, :, 1]) <= _OPEN * size).all(axis=1)
    centre = [_cut_beside(mesh, _BESIDE * size), xyz[rim[near]][:, :, [0, 2]]]
    return HullOutline(xyz, mesh.edges() if len(face) else rim, np.concatenate(centre))


def _cut_beside(mesh: Triangles, y: float) -> FloatArray:
    """Cut triangles just beside the centre plane; segments (k, 2, 2) of x and z."""
    above = mesh.xyz[:, 1] >= y
    side = above[mesh.face]
    face = mesh.face[side.any(axis=1) & ~side.all(axis=1)]
    if not len(face):
        return np.zeros((0, 2, 2))
    side = above[face]
    lone = np.argmax(side != (side.sum(axis=1) > 1)[:, None], axis=1)
    a, b, c = (mesh.xyz[face[np.arange(len(face)), (lone + i) % 3]] for i in range(3))
    ends = []
    for other in (b, c):
        part = (a[:, 1] - y) / (a[:, 1] - other[:, 1])
        ends.append((a + part[:, None] * (other - a))[:, [0, 2]])
    return np.stack(ends, axis=1)


def outline_of_slices(slices: HullSlices) -> HullOutline:
    """Outline digitised lines; without a profile, the ends of other lines tell the contour."""
    pieces = [piece for line in (*slices.lines, *slices.boundaries) for piece in line.pieces]
    xyz, edge = _joined([piece.points for piece in pieces])
    profile, deck = slices.boundary("profile"), slices.boundary("deck edge")
    centre = _segments(profile) if profile is not None else _contour_of_ends(slices)
    stations = np.array([line.offset for line in slices.group("sections")])
    edges = None if deck is None else np.concatenate([p.points[:, [0, 2]] for p in deck.pieces])
    if edges is not None:
        edges = edges[np.argsort(edges[:, 0], kind="stable")]
    bare = profile is None and not slices.group("waterlines")
    return HullOutline(xyz, edge, centre, edges, stations, station_doubt(stations) if bare else 0.0)


def station_doubt(stations: FloatArray) -> float:
    """Give half of the widest spacing of stations in the fore part: m."""
    if len(stations) < 2:
        return 0.0
    fore = np.sort(stations)
    fore = fore[fore >= fore[-1] - _END * float(np.ptp(fore))]
    return 0.5 * float(np.diff(fore).max(initial=0.0))


def outline_of_sections(
    sections: list[FloatArray],
    contour: list[FloatArray],
    deck: FloatArray | None,
    *,
    bare: bool,
) -> HullOutline:
    """Outline sections (n, 3), m, with polylines (x, z) of the contour and the deck edge if any.

    `bare`: the ends of the contour were guessed from the sections.
    """
    xyz, edge = _joined(sections)
    stations = np.array([section[0, 0] for section in sections])
    doubt = station_doubt(stations) if bare else 0.0
    return HullOutline(xyz, edge, _chained(contour), deck, stations, doubt)


def _joined(polylines: list[FloatArray]) -> tuple[FloatArray, IntArray]:
    """Put polylines together: places, and the edges along each."""
    count = [len(each) for each in polylines]
    start = np.cumsum([0, *count[:-1]])
    first = [np.arange(at, at + n - 1) for at, n in zip(start.tolist(), count, strict=True)]
    edge = np.concatenate(first) if first else np.zeros(0, np.int64)
    return np.concatenate(polylines), np.stack([edge, edge + 1], axis=1)


def _chained(polylines: list[FloatArray]) -> FloatArray:
    """Give the segments (k, 2, 2) of polylines (n, 2)."""
    parts = [np.stack([each[:-1], each[1:]], axis=1) for each in polylines if len(each) > 1]
    return np.concatenate(parts) if parts else np.zeros((0, 2, 2))


def _segments(line: SliceLine) -> FloatArray:
    return _chained([piece.points[:, [0, 2]] for piece in line.pieces])


def _contour_of_ends(slices: HullSlices) -> FloatArray:
    """Make a contour of the lowest points of sections and of the ends of waterlines.

    Where a section comes in pieces the keel goes by the lowest, stem and stern over a bulb by the
    highest.
    """
    feet = [
        sorted((_foot(piece.points) for piece in line.pieces), key=lambda at: float(at[1]))
        for line in slices.group("sections")
    ]
    low = slices.low[0]
    long = slices.high[0] - low
    if not long > 0.0:
        what = f"all lines lie at x = {low:.6g} m"
        raise BadInputError(what, "in the lines", "give sections at two places or more")
    ends = [
        [each[-1] for each in feet if lower <= (each[0][0] - low) / long <= upper]
        for lower, upper in ((0.0, _END), (1.0 - _END, 1.0))
    ]
    half = float(slices.high[1])
    tips: list[list[FloatArray]] = [[], []]
    for line in slices.group("waterlines"):
        every = np.concatenate([piece.points for piece in line.pieces])
        for kept, row in zip(tips, (every[:, 0].argmin(), every[:, 0].argmax()), strict=True):
            if every[row, 1] <= 0.02 * half:
                kept.append(every[int(row)][[0, 2]])
    keel = [each[0] for each in feet if _END <= (each[0][0] - low) / long <= 1.0 - _END]
    lines = (keel, *(tips if all(len(each) > 1 for each in tips) else ends))
    return _chained([np.array(each) for each in lines if len(each) > 1])


def _foot(points: FloatArray) -> FloatArray:
    """Give x and z of the lowest point."""
    return np.asarray(points[int(points[:, 2].argmin())][[0, 2]])


_STRETCH = (0.3, 0.7)
_KEEL_SAMPLES = 81

_FIN = 0.1
"""What hangs by more than this part of the depth below a bottom on both sides of it is a fin."""

_STEEP = 0.15
"""The ends of a fin rise by more than this; no bottom amidships does."""

_RAKE = 2e-3
"""A keel that rises by less than this part of Lpp is level."""

_STRAIGHT = 0.1
"""A raked keel leaves a straight line by at most this part of its rise; else it is curved."""


@attrs.frozen
class Keel:
    """The bottom of a hull amidships.

    Attributes
    ----------
    low : float, m
        Its lowest height.
    at : float, m
        Where that is.
    rise : float
        Rise forward in m per m of a straight keel; 0 of a level or a curved one.
    fin : float or None, m
        How deep a fin on the stretch hangs below it.
    """

    low: float
    at: float
    rise: float = 0.0
    fin: float | None = None


def measure_keel(outline: HullOutline, aft: float, fore: float) -> Keel:
    """Measure the bottom between .3 and .7 of a waterline from `aft` to `fore`, m."""
    first, last = (aft + part * (fore - aft) for part in _STRETCH)
    x = np.linspace(first, last, _KEEL_SAMPLES)
    z = outline.bottom(x)
    known = np.isfinite(z)
    if not known.any():
        return _without_contour(outline, first, last)
    x, z = x[known], z[known]
    depth = float(np.ptp(outline.xyz[:, 2]))
    fin = _fins(x, z, depth)
    deepest = float(z.min())
    hull_x, hull_z = _vertices(outline, first, last)
    if fin.any():
        x, z = x[~fin], z[~fin]
    elif len(hull_z):  # ends of segments are lower than what lies between samples
        x, z = np.append(x, hull_x), np.append(z, np.maximum(hull_z, deepest - 0.05 * depth))
    row = int(z.argmin())
    low = float(z[row])
    return Keel(low, float(x[row]), _rise(x, z, fore - aft), low - deepest if fin.any() else None)


def _without_contour(outline: HullOutline, first: float, last: float) -> Keel:
    """Take the lowest point there of a hull that does not reach its centre plane."""
    x = outline.xyz[:, 0]
    on = (first <= x) & (x <= last)
    places = outline.xyz[on] if on.any() else outline.xyz
    row = int(places[:, 2].argmin())
    return Keel(float(places[row, 2]), float(places[row, 0]))


def _vertices(outline: HullOutline, first: float, last: float) -> tuple[FloatArray, FloatArray]:
    """Give the lowest corner of the contour on the stretch, as arrays of one, or of none."""
    corner = outline.centre.reshape(-1, 2)
    on = corner[(first <= corner[:, 0]) & (corner[:, 0] <= last)]
    if not len(on):
        return np.zeros(0), np.zeros(0)
    lowest = on[int(on[:, 1].argmin())]
    return lowest[:1], lowest[1:]


def _fins(x: FloatArray, z: FloatArray, depth: float) -> NDArray[np.bool_]:
    """Mark samples that hang below the bottom before and behind them: of a fin, or a drop keel."""
    ahead = np.maximum.accumulate(z[::-1])[::-1]
    behind = np.maximum.accumulate(z)
    fin = z < np.minimum(ahead, behind) - _FIN * depth
    if not fin.any():
        return fin
    # Its ends go up to the bottom as long as they are steep: the bottom itself is not.
    steep = np.abs(np.diff(z)) > _STEEP * np.diff(x)
    last = len(z) - 1
    for i in range(1, last + 1):
        fin[i] |= fin[i - 1] and steep[i - 1]
    for i in range(last - 1, -1, -1):
        fin[i] |= fin[i + 1] and steep[i]
    dropped = float(np.abs(np.diff(z)).max()) > 0.5 * _FIN * depth
    # A deep belly fills the stretch and drops nowhere at once.
    return fin if dropped and fin.mean() < 0.5 else np.zeros(len(z), np.bool_)


def _rise(x: FloatArray, z: FloatArray, length: float) -> float:
    """Give the rise per length of a keel that is straight and not level."""
    middle = float(x.mean())
    off = x - middle
    slope = float((off * z).sum() / max(float((off * off).sum()), 1e-300))
    left = float(np.abs(z - z.mean() - slope * off).max())
    rise = abs(slope) * length
    straight = left <= _STRAIGHT * abs(slope) * float(np.ptp(x))
    return slope if rise > _RAKE * length and straight else 0.0


_BOW = 0.15
"""A bulb and the stem behind it lie in this part of the length from forward."""

_DROP = 3e-3
"""The contour steps back by more than this part of the length above a bulb."""

_SOON = 0.4
"""Above a bulb it steps back within this part of the height above the waterline."""

_STEM_SAMPLES = 60
_EXACT = 1e-3
"""A vertex of the waterline this part of the length near the contour's crossing is its end."""


@attrs.frozen
class StemPlace:
    """Where the stem meets the waterline.

    Attributes
    ----------
    x : float, m
        In coordinates of the file.
    note, doubt : str or None
        What is to be told of it, or doubted.
    """

    x: float
    note: str | None = None
    doubt: str | None = None


def find_stem(outline: HullOutline, z: float, level: Level) -> StemPlace:
    """Find where the stem meets the waterline at a height, m."""
    size, z = level.fore - level.aft, outline.inside(z)
    crossing = outline.contour(z)
    bow = crossing[crossing > level.fore - _BOW * size]
    if not len(bow):
        return StemPlace(level.fore)  # no contour forward: an open end, or half of two hulls
    if len(bow) == 3:
        x = _exact(outline, z, float(bow[0]), size)
        what = f"the waterline passes a bulb at x = {bow[2]:.6g} m; the stem is behind it"
        return StemPlace(x, f"{what}, at {x:.6g} m of the file")
    x = float(bow[-1])
    stepped = _step_above(outline, z, x, size)
    if stepped is not None:
        back, height = stepped
        what = (
            f"the design waterline ends on a bulb at x = {x:.6g} m of the file; the FP goes by the "
            f"stem above it, at x = {back:.6g} m, z = {height:.6g} m: check draught="
        )
        return StemPlace(back, doubt=what)
    return StemPlace(_exact(outline, z, x, size))


def _exact(outline: HullOutline, z: float, x: float, size: float) -> float:
    """Take the end of the waterline itself: the contour was cut a little beside y = 0."""
    places = outline.cut(2, z)
    near = places[np.abs(places[:, 0] - x) <= _EXACT * size]
    if not len(near):
        return x
    least = np.abs(near[:, 1]).min()
    on = near[np.abs(near[:, 1]) <= least + 1e-9 * size]
    return float(on[int(np.abs(on[:, 0] - x).argmin()), 0])


def _step_above(
    outline: HullOutline, z: float, x: float, size: float
) -> tuple[float, float] | None:
    """Give place and height of the stem's foot where the waterline ends on a bulb below it."""
    top = float(outline.high[2])
    heights = np.linspace(z, top, _STEM_SAMPLES + 1)[1:-1]
    # Only the bow: where sections end in the centre plane the contour has their keels too.
    bow = x - _BOW * size
    fore = np.array([_foremost(outline.contour(height), bow) for height in heights.tolist()])
    known = np.isfinite(fore)
    heights, fore = heights[known], fore[known]
    if not len(fore):
        return None
    # The foot of the stem is the first place from which the contour goes back no further.
    row = int(fore.argmin())
    drop = x - float(fore[row])
    if drop <= _DROP * size:
        return None
    soon = fore[heights <= z + _SOON * (top - z)]
    early = len(soon) > 0 and x - float(soon.min()) > 0.8 * drop
    rises = float(fore[row:].max()) - float(fore[row]) > _DROP * size
    return (float(fore[row]), float(heights[row])) if early or rises else None


def _foremost(crossing: FloatArray, least: float) -> float:
    """Give the foremost crossing forward of `least` (m), nan where there is none."""
    return float(crossing[-1]) if len(crossing) and crossing[-1] > least else float("nan")
