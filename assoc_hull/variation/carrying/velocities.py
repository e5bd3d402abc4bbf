"""How fast everything of a varied hull moves with each parameter, points kept in their planes.

A hull Q was carried from its parent P by the map M at some amplitudes. By amplitude j its places
move as the map does at what they come from,

    v_j(Q) = d M(P) / d lambda_j        P = M^-1(Q)

Planes of lines go as a transformation sends them, and points stay in these.

Points that a map moves are kept in the planes of their lines, to first order.

A station stays plane where the map bends it, a buttock stays a buttock. A point in which two lines
cross then slides over the hull: along the line that the map carries exactly, or, where it carries
neither, by the shortest way within the tangent plane.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.edit.carried_net import Nudge, nudged
from assoc_hull.edit.hull_normals import curve_tangents, hull_normals
from assoc_hull.edit.mapped_planes import flat_borders
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import (
    EndKind,
    FloatArray,
    IntArray,
    SplineBatch,
    freeze,
)
from assoc_hull.geometry.splines.segments import curvature
from assoc_hull.model.tables import Ends, HullState, Particulars
from assoc_hull.variation.carrying.hull_maps import HullMaps, LaidMap

__all__ = ["SIZES", "SlideSurface", "Velocities", "curve_bending", "velocities"]

_STEEP = 0.02
"""A line as level as this to a plane (sine of the angle) is no way into it."""

_FLAT = 1e-3
"""Planes and tangent plane that turn no more than this from one another leave no way."""

_KEPT = 1e-9
"""A point leaves its plane by no more than this part of the largest movement."""


def curve_bending(state: HullState) -> FloatArray:
    """Give the larger curvature of the curves through every point, (rows,), 1/m."""
    found, curves = np.zeros(state.rows.count), state.live("curves").tolist()
    batch = SplineBatch.join([state.spline(curve) for curve in curves])
    bend = np.sqrt((curvature(batch) ** 2).sum(axis=1))
    rows = np.concatenate([state.curves.rows[curve] for curve in curves])
    np.maximum.at(found, rows, np.nan_to_num(bend))
    return found


@attrs.frozen(eq=False)
class SlideSurface:
    """What points of a hull slide over.

    Attributes
    ----------
    line : (r, 2) int
        Lines of both sides of every point, -1 where there is none.
    held : (r, 2) bool
        Whether a side's line lies in a plane.
    plane : (r, 2, 3)
        Normals of these planes; nil where there are none.
    tangent : (r, 2, 3)
        Unit tangents of the curves.
    drives : (r, 2) bool
        Whether a side's line is carried exactly.
    normal : (r, 3)
        Unit normals of the hull.
    """

    line: IntArray
    held: NDArray[np.bool_]
    plane: FloatArray
    tangent: FloatArray
    drives: NDArray[np.bool_]
    normal: FloatArray

    @classmethod
    def of(cls, state: HullState, lines: IntArray) -> SlideSurface:
        """Take it from the tables of a hull; `lines` (d,) are carried exactly."""
        curve = state.rows.curve.data
        line = np.where(curve >= 0, state.curves.line[curve], -1)
        held = (line >= 0) & state.lines.planar[line]
        plane = np.where(held[..., None], state.lines.normal[line], 0.0)
        drives = (line >= 0) & np.isin(line, lines)
        return cls(line, held, plane, curve_tangents(state), drives, np.array(hull_normals(state)))

    def kept(self, move: FloatArray, level: FloatArray) -> FloatArray:
        """Give displacements that keep points in the planes of their lines.

        Parameters
        ----------
        move : (r, 3), m
            Where a map moves the points.
        level : (l,), m
            How far the planes of lines move along their normals.

        Returns
        -------
        (r, 3), m
        """
        rate = np.where(self.held, level[self.line], 0.0)
        off = np.where(self.held, rate - (self.plane * move[:, None]).sum(axis=2), 0.0)
        least = _KEPT * (1.0 + float(np.abs(move).max(initial=0.0)))
        left = np.abs(off) > least
        found = move.copy()
        for side in (0, 1):
            done = self._along(found, off, left, side)
            left[done] = False
        rest = np.flatnonzero(left.any(axis=1))
        found[rest] += self._shortest(rest, np.where(left, off, 0.0)[rest])
        return self._exactly(found, rate)

    def _along(
        self, found: FloatArray, off: FloatArray, left: NDArray[np.bool_], side: int
    ) -> NDArray[np.bool_]:
        """Slide along the curves of one side, which are carried, into the planes of the other."""
        along, other = self.tangent[:, side], 1 - side
        steep = (along * self.plane[:, other]).sum(axis=1)
        slides = self.drives[:, side] & ~left[:, side] & left[:, other] & (np.abs(steep) > _STEEP)
        found[slides] += along[slides] * (off[slides, other] / steep[slides])[:, None]
        return np.asarray(slides)

    def _shortest(self, rows: IntArray, off: FloatArray) -> FloatArray:
        """Give the shortest ways within tangent planes into the planes of the lines, (n, 3)."""
        demands = np.concatenate([self.normal[rows, None], self.plane[rows]], axis=1)
        amount = np.concatenate([np.zeros((len(rows), 1)), off], axis=1)
        return np.asarray(np.einsum("nij,nj->ni", np.linalg.pinv(demands, rcond=_FLAT), amount))

    def _exactly(self, found: FloatArray, rate: FloatArray) -> FloatArray:
        """Let points go with planes across an axis to the bit."""
        for side in (0, 1):
            for axis in range(3):
                exact = np.abs(self.plane[:, side, axis]) == 1.0
                found[exact, axis] = rate[exact, side] * self.plane[exact, side, axis]
        return found


# --------------------------------------------------------------------------------------
# How directions that are given at points and ends turn with a map, to first order.

_ALIKE = 1e-3
"""Directions at one point that differ by no more (of their size) turn alike."""


def turn_rates(
    state: HullState,
    ground: SlideSurface,
    here: LaidMap,
    pair: Sequence[LaidMap],
    source: FloatArray,
    span: float,
) -> FloatArray:
    """Give how given directions turn with one amplitude.

    Parameters
    ----------
    state : HullState
        The tables of the carried hull.
    ground : SlideSurface
        Planes that directions stay in.
    here : LaidMap
        The map by which the hull was carried.
    pair : sequence of LaidMap
        Maps on both sides of it.
    source : (rows, 3), m
        Where points come from.
    span : float
        How far the pair is apart in the amplitude.

    Returns
    -------
    (rows, 3, 3)
        A direction t at a point changes by turn t per unit: its length stays, and it stays in
        the plane of its line, and in the flat that this borders.
    """
    found, given = np.zeros((state.rows.count, 3, 3)), _given(state)
    rows = np.array(sorted(given), np.int64)
    if not len(rows):
        return found
    slopes = [each.map.jacobian(source[rows]) for each in pair]
    rate = (slopes[0] - slopes[1]) / span @ np.linalg.inv(here.map.jacobian(source[rows]))
    flats = flat_borders(state, pair[0].planes)
    moving = rate.any(axis=(1, 2))
    for row, each in zip(rows[moving].tolist(), rate[moving], strict=True):
        new = [_turned(ground, flats, row, one, each) for one in given[row]]
        old = np.array([vector for _, vector in given[row]])
        found[row] = np.array(new).T @ np.linalg.pinv(old.T, rcond=_ALIKE)
    return found


def _turned(
    ground: SlideSurface, flats: IntArray, row: int, given: tuple[int, FloatArray], rate: FloatArray
) -> FloatArray:
    """Give how one direction changes: across itself, in its plane and in the flat it borders."""
    side, vector = given
    new: FloatArray = rate @ vector
    new = new - vector * ((vector * new).sum() / (vector * vector).sum())
    own, other = ground.plane[row, side], ground.plane[row, 1 - side]
    new = new - own * (own * new).sum()
    if ground.line[row, 1 - side] in flats:
        new = new - other * (other * new).sum()
    return new


def _given(state: HullState) -> dict[int, list[tuple[int, FloatArray]]]:
    """Give the directions that are given at points and ends of curves, each with its side."""
    table, found = state.rows, dict[int, list[tuple[int, FloatArray]]]()
    for side in (0, 1):
        there = table.alive.data & table.direction[:, side].any(axis=1)
        for row in np.flatnonzero(there).tolist():
            found.setdefault(row, []).append((side, table.direction[row, side]))
    for curve in state.live("curves").tolist():
        ends: Ends = state.curves.ends[curve]
        for at in (0, 1):
            if ends.kind[at] == EndKind.TANGENT:
                row = int(state.curves.rows[curve][-at])
                side = int(table.curve[row, 0] != curve)
                found.setdefault(row, []).append((side, np.array(ends.vector[at])))
    return found


SIZES = ("length", "breadth", "depth", "draught")
"""Particulars that change, in the order of their rates."""

_STEP = 1e-3
"""Half the span of central differences, in usual changes."""

_SAME = 1e-9
"""m: a point of the parent whose image is so near to where it came to went there."""

_ROUNDS = 8
_NEAR = 1e-4
"""m: a map that draws circles anew lays all that is near one onto it, which cannot be undone."""

_NUMBERS = ("centre", "radius", "offset")


@attrs.frozen(eq=False)
class Velocities:
    """Rates of everything of a hull by k amplitudes.

    Attributes
    ----------
    move : (k, rows, 3), m per unit
        Displacements of all points of the tables.
    carried : (k, rows, 3), m per unit
        Those of the map itself, from which points slide to stay in their planes.
    turn : (k, rows, 3, 3)
        How given directions turn.
    level : (k, lines), m per unit
        Of planes, along their normals.
    sizes : (k, 4), m per unit
        Of length, breadth, depth and draught.
    beside : tuple of k (two LaidMap, float)
        The maps by which differences are taken, and the span between them.
    rows : (n,) int
        The points that move by themselves; the others are computed.
    bend : (n,), 1/m
        How much the curves through these bend.
    source, place : (n, 3), m
        Where they come from in the parent, and where they are.
    """

    move: FloatArray
    carried: FloatArray
    turn: FloatArray
    level: FloatArray
    sizes: FloatArray
    beside: tuple[tuple[Sequence[LaidMap], float], ...]
    rows: IntArray
    bend: FloatArray
    source: FloatArray
    place: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.move, self.carried, self.turn, self.level, self.sizes, self.rows, self.bend)

    @cached_property
    def features(self) -> tuple[Mapping[str, Mapping[str, FloatArray]], ...]:
        """Rates of centres, radii and offsets of features, by key; only nudges ask for them."""
        return tuple(_feature_rates(pair, span) for pair, span in self.beside)

    def nudge(self, by: FloatArray, size: Particulars, within: float) -> Nudge:
        """Give the nudge that changes of the amplitudes make.

        Parameters
        ----------
        by : (k,)
            The changes.
        size : Particulars
            Those of the hull before.
        within : float, m
            How far points of features may come to lie off them.
        """
        rates = _sum(by, self.sizes).tolist()
        sizes = {name: getattr(size, name) + rates[i] for i, name in enumerate(SIZES)}
        features = dict[str, dict[str, FloatArray]]()
        for amount, each in zip(by.tolist(), self.features, strict=True):
            for key, numbers in each.items():
                mine = features.setdefault(key, {})
                for name, rate in numbers.items():
                    mine[name] = mine.get(name, np.zeros(np.shape(rate))) + amount * rate
        return Nudge(
            _sum(by, self.move), _sum(by, self.turn), _sum(by, self.level), features,
            attrs.evolve(size, **sizes), within,
        )  # fmt: skip

    def farthest(self, by: FloatArray) -> float:
        """Give how far the map moves points at most, m."""
        gone = _sum(by, self.carried[:, self.rows])
        return float(np.sqrt((gone * gone).sum(axis=1)).max(initial=0.0))

    def slides_off(self, by: FloatArray) -> float:
        """Give how far points that slide leave the hull at most, m.

        A point that slides by s along a curve of curvature k leaves it by k s^2 / 2.
        """
        slid = _sum(by, self.move[:, self.rows] - self.carried[:, self.rows])
        return float((0.5 * self.bend * (slid * slid).sum(axis=1)).max(initial=0.0))

    def strays(self, by: FloatArray, maps: HullMaps, amplitudes: FloatArray) -> float:
        """Give how far points come to lie at most from where the map itself sends them, m."""
        gone = self.place + _sum(by, self.carried[:, self.rows])
        away = gone - maps.places(amplitudes, self.source)
        return float(np.sqrt((away * away).sum(axis=1)).max(initial=0.0))

    def turning(self, by: FloatArray) -> FloatArray:
        """Give how directions turn that were turned already by a nudge, (k, rows, 3, 3)."""
        if not self.turn.any():
            return self.turn
        turned = np.eye(3) + _sum(by, self.turn)
        found: FloatArray = self.turn @ np.linalg.inv(turned)
        return found


def _sum(by: FloatArray, rates: FloatArray) -> FloatArray:
    """Sum rates times amounts, in order."""
    found = np.zeros(rates.shape[1:])
    for amount, rate in zip(by.tolist(), rates, strict=True):
        found += amount * rate
    return found


def velocities(
    state: HullState, maps: HullMaps, amplitudes: FloatArray, lines: IntArray, *, follow: bool
) -> Velocities:
    """Find how fast a carried hull moves with each free parameter.

    Parameters
    ----------
    state : HullState
        The tables of the carried hull; those of the parent where nothing has moved yet.
    maps : HullMaps
        The maps of the parent.
    amplitudes : (k,)
        Those that it was carried by.
    lines : (d,) int
        Lines that drove, boundary curves among them.
    follow : bool
        Whether planes of followers went along.

    Raises
    ------
    BadInputError
        The map cannot be undone at a point; parameters have no neighbouring values.
    """
    here = maps.laid(amplitudes, lines, follow=follow)
    source = _sources(state, maps.state, here)
    ground, found = SlideSurface.of(state, lines), list[tuple[FloatArray, ...]]()
    spans = list[tuple[Sequence[LaidMap], float]]()
    for j, each in enumerate(maps.free):
        beside = list[LaidMap | AssocHullError]()
        for by in (_STEP * each.usual, -_STEP * each.usual):
            there = amplitudes.copy()
            there[j] += by
            beside.append(_laid(maps, there, lines, follow=follow))
        pair, span = _spanned(beside, here, _STEP * each.usual)
        found.append(_rates(state, ground, here, pair, source, span))
        spans.append((pair, span))
    move, carried, turn, level, sizes = (np.stack(part) for part in zip(*found, strict=True))
    rows = nudged(state)
    return Velocities(
        move, carried, turn, level, sizes, tuple(spans), rows, curve_bending(state)[rows],
        source[rows], state.rows.xyz[rows].copy(),
    )  # fmt: skip


def _laid(
    maps: HullMaps, amplitudes: FloatArray, lines: IntArray, *, follow: bool
) -> LaidMap | AssocHullError:
    """Lay out a map beside, or give why there is none."""
    try:
        return maps.laid(amplitudes, lines, follow=follow)
    except AssocHullError as error:
        return error


def _spanned(
    beside: Sequence[LaidMap | AssocHullError], here: LaidMap, step: float
) -> tuple[list[LaidMap], float]:
    """Give the maps of a difference, and its span: at the end of a range it is to one side."""
    pair = [each if isinstance(each, LaidMap) else here for each in beside]
    missing = [each for each in beside if not isinstance(each, LaidMap)]
    if len(missing) == len(beside):
        raise missing[0]
    return pair, step * (len(beside) - len(missing))


def _rates(
    state: HullState,
    ground: SlideSurface,
    here: LaidMap,
    pair: Sequence[LaidMap],
    source: FloatArray,
    span: float,
) -> tuple[FloatArray, ...]:
    """Give displacements, those of the map, turns, levels and sizes by one amplitude."""
    live = state.live("rows")
    carried = np.zeros((state.rows.count, 3))
    carried[live] = (pair[0].map(source[live]) - pair[1].map(source[live])) / span
    level = _levels(state, pair, carried, ground, span)
    move = ground.kept(carried, level)
    move[~state.rows.alive.data] = 0.0
    turn = turn_rates(state, ground, here, pair, source, span)
    size = [np.array([getattr(each.particulars, name) for name in SIZES]) for each in pair]
    return move, carried, turn, level, (size[0] - size[1]) / span


def _sources(state: HullState, parent: HullState, here: LaidMap) -> FloatArray:
    """Give where the points of a carried hull come from, (rows, 3), m.

    Points of the parent that went where the map sends them come from where they were, to the bit.
    """
    live = state.live("rows")
    old = live[live < parent.rows.count]
    places: FloatArray = state.rows.xyz.data
    found = places.copy()
    source = parent.rows.xyz[old]
    went = np.abs(here.map(source) - places[old]).max(axis=1) <= _SAME
    found[old[went]] = source[went]
    rest = np.setdiff1d(live, old[went])
    found[rest] = _undone(here, places[rest])
    return found


def _undone(here: LaidMap, places: FloatArray) -> FloatArray:
    """Undo a map at places, by Newton's rule: to rounding, but beside circles drawn anew."""
    guess, mapped = np.array(here.vmap.inverse(places)), here.map
    found, best, left = guess.copy(), np.full(len(places), np.inf), np.arange(len(places))
    for _ in range(_ROUNDS):
        off = mapped(guess[left]) - places[left]
        away = np.abs(off).max(axis=1, initial=0.0)
        better = away < best[left]
        found[left[better]], best[left[better]] = guess[left[better]], away[better]
        left, off = left[away > _SAME], off[away > _SAME]
        if not len(left):
            break
        slope = mapped.jacobian(guess[left])
        guess[left] -= np.linalg.solve(slope, off[:, :, None])[:, :, 0]
    worst = int(best.argmax()) if len(best) else 0
    if len(best) and best[worst] > _NEAR:
        x, y, z = places[worst].tolist()
        raise BadInputError(
            f"the map cannot be undone to {best[worst]:.2g} m",
            f"at ({x:.3f}, {y:.3f}, {z:.3f}) m in vary", "ask for less",
        )  # fmt: skip
    return found


def _levels(
    state: HullState,
    pair: Sequence[LaidMap],
    carried: FloatArray,
    ground: SlideSurface,
    span: float,
) -> FloatArray:
    """Give how fast the planes of lines move along their normals, (l,), m per unit.

    A plane that turns, or bends into none, moves as most of the points do that lie in it.
    """
    table, plus, minus = state.lines, pair[0].planes, pair[1].planes
    parallel = plus.planar & minus.planar & (plus.normal == minus.normal).all(axis=1)
    found = np.where(parallel, plus.offset - minus.offset, 0.0) / span
    found[~(table.alive.data & table.planar.data)] = 0.0
    for line in np.flatnonzero(table.alive.data & table.planar.data & ~parallel).tolist():
        mine = carried[(ground.line == line).any(axis=1)]
        found[line] = np.median((mine * table.normal[line]).sum(axis=1))
    return found


def _feature_rates(pair: Sequence[LaidMap], span: float) -> dict[str, dict[str, FloatArray]]:
    """Give how fast the numbers of features change, by key."""
    other = {each.key: each for each in pair[1].features}
    found = dict[str, dict[str, FloatArray]]()
    for each in pair[0].features:
        for name in _NUMBERS:
            high, low = getattr(each, name), getattr(other[each.key], name)
            if high is not None and high != low:
                rate = (np.asarray(high) - np.asarray(low)) / span
                found.setdefault(each.key, {})[name] = rate
    return found
