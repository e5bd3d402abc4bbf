"""The wet surface as pieces without holes: bands of strips, cut at levels, followed as sheets.

A *band* is a run of strips without a branch, with a parameter q along it: strip number and v, from
0 to the number of strips. *Levels* are the curves across a band between which panels are put: those
wanted, and those at which the wet part of the section changes its kind. A *sheet* is a run of
levels whose wet part is one arc each, from keel or waterline to waterline or deck.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.flotation import Flotation
from assoc_hull.analysis.net.curve_net import CurvePart
from assoc_hull.analysis.net.strip_boundaries import StripBoundary
from assoc_hull.geometry.curves import FloatArray, IntArray, IsoCurves, Strips, freeze
from assoc_hull.geometry.floating.wetted_curves import WetRuns, wet_runs
from assoc_hull.geometry.splines.arc_length import CubicChains

__all__ = [
    "Band",
    "BandLevels",
    "Waterplane",
    "WetSheet",
    "band_levels",
    "bands",
    "bands_of_strips",
    "wet_sheets",
]

# --------------------------------------------------------------------------------------
# Bands. Between two stations of a net the surface has one strip, or several where the hull has come
# apart (bulb and stem, bossing and counter). Where the rail of one strip is that of the next the
# two are one band; a band ends where the hull ends, branches or joins.

_SAME = 1e-6
"""Parameters of one curve this near to one another (m) are one."""


@attrs.frozen
class Waterplane:
    """A floating plane ``z = height + tan_trim x - tan_heel y``, m."""

    height: float
    tan_trim: float = 0.0
    tan_heel: float = 0.0

    def over(self, places: FloatArray) -> FloatArray:
        """Give the heights of places (k, 3) over the plane, in z, (k,), m."""
        x, y, z = places.T
        found: FloatArray = z - self.height - self.tan_trim * x + self.tan_heel * y
        return found

    def on_starboard(self) -> Waterplane:
        """Give the same plane as the starboard half sees it, y to starboard."""
        return attrs.evolve(self, tan_heel=-self.tan_heel)


@attrs.frozen(eq=False)
class Band:
    """A run of strips.

    Attributes
    ----------
    surface : Strips
        One half of the hull.
    strips : (n,) int
        Their numbers, from aft forward.
    x : (n + 1,), m
        Where they begin and end; at a raked end the outermost place that is wet.
    """

    surface: Strips
    strips: IntArray
    x: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.strips, self.x)

    @property
    def count(self) -> int:
        """Number of strips, and the last q."""
        return len(self.strips)

    def curves(self, q: FloatArray) -> IsoCurves:
        """Give the curves across the band at (k,) parameters."""
        number = np.minimum(np.floor(q).astype(np.int64), self.count - 1)
        return self.surface.curves(self.strips[number], q - number)

    def wet(self, q: FloatArray, plane: Waterplane) -> WetRuns:
        """Give what of those curves lies below a plane."""
        return wet_runs(self.curves(q), plane.height, plane.tan_trim, plane.tan_heel)

    def q_at(self, x: FloatArray) -> FloatArray:
        """Give the parameters at places along the ship (k,), m, that lie inside the band."""
        inside = x[(x > self.x[0]) & (x < self.x[-1])]
        found: FloatArray = np.interp(inside, self.x, np.arange(self.count + 1.0))
        return found


def bands(body: Flotation, plane: Waterplane) -> list[Band]:
    """Join the strips of a hull, from aft forward."""
    frames = body.layout.frames
    deck = body.layout.edge & body.closed
    after = _followers(frames, [bool(each) for each in deck])
    followed = set(after.values())
    found = []
    for first in range(len(frames)):
        if first in followed:
            continue
        run = [first]
        while run[-1] in after:
            run.append(after[run[-1]])
        found.append(_band(body.strips, run, plane))
    return found


def bands_of_strips(surface: Strips, plane: Waterplane) -> list[Band]:
    """Take all strips of a surface without branches as one band."""
    return [_band(surface, list(range(surface.count)), plane)]


def _followers(frames: Sequence[StripBoundary], deck: list[bool]) -> dict[int, int]:
    """Give the strip that follows each along its whole rail, by number."""
    after: dict[int, int] = {}
    for i, aft in enumerate(frames):
        for j, fore in enumerate(frames):
            if fore.slab == aft.slab + 1 and deck[i] == deck[j] and _same(aft.fore, fore.aft):
                after[i] = j
    return after


def _same(one: tuple[CurvePart, ...], other: tuple[CurvePart, ...]) -> bool:
    return len(one) == len(other) and all(
        a[0] == b[0] and abs(a[1] - b[1]) <= _SAME and abs(a[2] - b[2]) <= _SAME
        for a, b in zip(one, other, strict=True)
    )


def _band(surface: Strips, run: list[int], plane: Waterplane) -> Band:
    """Make a band; where its strips begin and end is read off their curves, of both sides."""
    bare = Band(surface, np.array(run, np.int64), np.zeros(len(run) + 1))
    q = np.arange(len(run) + 1.0)
    reach = [_extents(bare, q, plane), _extents(bare, q, plane.on_starboard())]
    low = np.minimum(reach[0][0], reach[1][0])
    high = np.maximum(reach[0][1], reach[1][1])
    x = np.concatenate([low[:1], 0.5 * (low + high)[1:-1], high[-1:]])
    return attrs.evolve(bare, x=np.maximum.accumulate(x))


def _extents(band: Band, q: FloatArray, plane: Waterplane) -> tuple[FloatArray, FloatArray]:
    """Give the least and the most x of what is wet of curves, of all of them if nothing is."""
    curves = band.curves(q)
    part = np.linspace(0.0, 1.0, 5)[:, None, None]
    wet = band.wet(q, plane)
    low, high = np.full(len(q), np.inf), np.full(len(q), -np.inf)
    for cubic, start, curve in (
        (wet.chains.cubic, wet.chains.start, wet.curve),
        (curves.point, curves.start, np.arange(len(q))),
    ):
        c = cubic[:, :, 0]
        x = ((c[:, 3] * part[:, 0] + c[:, 2]) * part[:, 0] + c[:, 1]) * part[:, 0] + c[:, 0]
        for run, number in enumerate(curve.tolist()):
            # In the second round whole curves count, where nothing of them was wet.
            if cubic is curves.point and np.isfinite(low[number]):
                continue
            piece = x[:, start[run] : start[run + 1]]
            low[number] = min(low[number], float(piece.min()))
            high[number] = max(high[number], float(piece.max()))
    return low, high


# --------------------------------------------------------------------------------------
# Levels. To the places that are wanted come those at which the wet part of the section changes its
# kind: it appears or vanishes, splits or joins, reaches the end of the curve or leaves it. Such a
# place is found by halving; its level has two sides, the last curve before and the first behind it,
# which differ by rounding only.

_ROUNDS = 12
"""At most this many changes are found between two levels."""

_HALVINGS = 70
_ONE = 1e-6
"""Changes this near to one another in q are one."""

_CROWDED = 0.3
"""A level that was not asked for is left out this near (in steps) to a change or end."""

WetKind = tuple[tuple[bool, bool], ...]
"""Of each run of a curve: it begins where the curve does, it ends where the curve does."""


@attrs.frozen(eq=False)
class BandLevels:
    """Where a band is cut.

    Attributes
    ----------
    aft, fore : (k,)
        The parameter q of each level as seen from aft and from forward.
    """

    aft: FloatArray
    fore: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.aft, self.fore)

    @property
    def count(self) -> int:
        """Number of levels."""
        return len(self.aft)


def band_levels(band: Band, planes: list[Waterplane], x: FloatArray, fixed: bool) -> BandLevels:
    """Choose the levels of a band: at its ends, at x (n,), m, and at changes between these.

    `planes` are as the halves see the water; both get the same levels, so that they join. `fixed`
    keeps all x, however near to a change or an end they lie; those off the band do not matter.
    """
    q = np.concatenate([[0.0], band.q_at(x), [float(band.count)]])
    q = q[np.append(True, np.diff(q) > 1e-9)]
    aft, fore = q.tolist(), q.tolist()
    for _ in range(_ROUNDS):
        gaps = _changing(band, planes, np.array(fore[:-1]), np.array(aft[1:]))
        if not gaps:
            break
        for gap in reversed(gaps):
            low, high = _change(band, planes, fore[gap], aft[gap + 1])
            aft.insert(gap + 1, low)
            fore.insert(gap + 1, high)
    found = _merged(np.array(aft), np.array(fore))
    return found if fixed else _thinned(band, found, x)


def _merged(aft: FloatArray, fore: FloatArray) -> BandLevels:
    """Make one level of changes that follow one another at once."""
    first = np.append(True, aft[1:] - fore[:-1] > _ONE)
    last = np.append(first[1:], True)
    return BandLevels(aft[first], fore[last])


def _kinds(wet: WetRuns, count: int) -> list[WetKind]:
    """Give the kind of the wet part of each of `count` curves."""
    found: list[list[tuple[bool, bool]]] = [[] for _ in range(count)]
    ends = zip(wet.curve.tolist(), wet.bottom.tolist(), wet.top.tolist(), strict=True)
    for curve, bottom, top in ends:
        found[curve].append((bottom, top))
    return [tuple(each) for each in found]


def _changing(band: Band, planes: list[Waterplane], low: FloatArray, high: FloatArray) -> list[int]:
    """Find the gaps whose two ends are of different kinds, on one side at least."""
    found = set()
    for plane in planes:
        kinds = _kinds(band.wet(np.concatenate([low, high]), plane), 2 * len(low))
        found |= {i for i in range(len(low)) if kinds[i] != kinds[i + len(low)]}
    return sorted(found)


def _change(band: Band, planes: list[Waterplane], low: float, high: float) -> tuple[float, float]:
    """Find the first change of kind after `low`: the last q before it and the first behind."""
    first = [_kinds(band.wet(np.array([low]), plane), 1)[0] for plane in planes]
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if not low < middle < high:
            break
        now = [_kinds(band.wet(np.array([middle]), plane), 1)[0] for plane in planes]
        low, high = (middle, high) if now == first else (low, middle)
    return low, high


def _thinned(band: Band, found: BandLevels, x: FloatArray) -> BandLevels:
    """Leave out levels that crowd where a change was found, and at the ends of the band."""
    kept = found.aft != found.fore
    kept[[0, -1]] = True
    place = np.interp(found.aft, np.arange(band.count + 1.0), band.x)
    step = np.interp(place, x, np.gradient(x)) if len(x) > 1 else 0.0
    kept |= np.abs(place[:, None] - place[kept]).min(axis=1) >= _CROWDED * step
    return BandLevels(found.aft[kept], found.fore[kept])


# --------------------------------------------------------------------------------------
# Sheets. One ends where the band does, and where arcs appear, vanish, split or join.


@attrs.frozen(eq=False)
class WetSheet:
    """A piece of the wet surface of one side.

    Attributes
    ----------
    band : int
        Number of its band.
    port : bool
        It lies on the port side; what lies to starboard has its own y, below 0.
    chains : CubicChains
        One arc per level, k, from aft forward, each from keel to deck.
    afloat : (k, 2) bool
        The first, the last place of the arc lies on the waterplane.
    turn : (s,)
        By how much the arcs turn where a cubic begins, degrees.
    open_aft, open_fore : bool
        The sheet ends at the end of its band, where another band, a stem or a transom is.
    """

    band: int
    port: bool
    chains: CubicChains
    afloat: NDArray[np.bool_]
    turn: FloatArray
    open_aft: bool
    open_fore: bool

    def __attrs_post_init__(self) -> None:
        freeze(self.afloat, self.turn)


def wet_sheets(
    band: Band, found: BandLevels, plane: Waterplane, who: tuple[int, bool], length: float
) -> list[WetSheet]:
    """Follow what is wet of one half of a band, cut at the levels `found`.

    `plane` is as this half sees it, y away from the centre plane; `who` the number of the band, and
    whether this is its port half; `length` (m) that of the ship.
    """
    gaps = found.count - 1
    wet = band.wet(np.concatenate([found.fore[:-1], found.aft[1:]]), plane)
    # The arcs behind each level, then those before the next: the same number in each gap.
    begins = [np.flatnonzero(wet.curve == g) for g in range(gaps)]
    finishes = [np.flatnonzero(wet.curve == gaps + g) for g in range(gaps)]
    runs = _followed(wet, begins, finishes, _SAME * length)
    return [_sheet(wet, run, who, gaps) for run in runs]


def _followed(
    wet: WetRuns, begins: list[IntArray], finishes: list[IntArray], near: float
) -> list[tuple[int, list[int]]]:
    """Give for each sheet its first level and its arcs, level by level."""
    alive: list[tuple[int, list[int]]] = []
    done: list[tuple[int, list[int]]] = []
    for gap, (begin, finish) in enumerate(zip(begins, finishes, strict=True)):
        going = []
        left = list(alive)
        for first, last in zip(begin.tolist(), finish.tolist(), strict=False):
            same = [each for each in left if _have_same_ends(wet, each[1][-1], first, near)]
            if same:
                left.remove(same[0])
                same[0][1].append(last)
                going.append(same[0])
            else:
                going.append((gap, [first, last]))
        done += left
        alive = going
    return done + alive


def _have_same_ends(wet: WetRuns, one: int, other: int, near: float) -> bool:
    """Tell whether two arcs have the same ends."""
    return all(float(np.abs(end[one] - end[other]).max()) <= near for end in wet.chains.ends)


def _sheet(wet: WetRuns, run: tuple[int, list[int]], who: tuple[int, bool], gaps: int) -> WetSheet:
    """Make a sheet of arcs; those to starboard are mirrored here, and only here."""
    first, arcs = run
    chosen = np.array(arcs, np.int64)
    chains = wet.chains.take(chosen)
    if not who[1]:
        chains = CubicChains(chains.start, chains.cubic * np.array([1.0, -1.0, 1.0]))
    member = [
        np.arange(wet.chains.start[each], wet.chains.start[each + 1]) for each in chosen.tolist()
    ]
    afloat = ~np.column_stack([wet.bottom[chosen], wet.top[chosen]])
    last = first + len(arcs) - 1
    turn = wet.knuckle[np.concatenate(member)]
    return WetSheet(*who, chains, afloat, turn, first == 0, last == gaps)
