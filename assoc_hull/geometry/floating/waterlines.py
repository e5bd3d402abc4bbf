"""The waterline of a body: where a floating plane cuts its surface, and its main piece.

Each curve across a strip intersects the plane at some places; as far as their number stays the
same they form arcs, which end where two of them run together or one leaves the strip. An arc is
the polynomial through `_NODES` places. `outer_line` joins arcs end to end from the greatest half
breadth to an end of the waterline: of several pieces (a bulb's top, skegs) it takes that one.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.raked_strips import StripSpans
from assoc_hull.geometry.floating.tiles import (
    candidate_pairs,
    cubic_powers,
    cut_tiles,
    tiles_of_curves,
    tilt_tiles,
)
from assoc_hull.geometry.floating.waterplane_cuts import tile_slopes
from assoc_hull.geometry.numeric.interpolation import differentiation_matrix
from assoc_hull.geometry.numeric.quadrature import lobatto, root_walk

__all__ = [
    "OuterLine",
    "WaterlineArcs",
    "outer_line",
    "waterline_arcs",
]

_NODES = 8
_PIECES = 12  # of each part of a raked strip: lines bend there
_PER_PIECE = 4  # Gauss points of a strip of sections
_LOOKS = 9  # at each strip, for where the number of places changes
_HALVINGS = 46
_SEVERAL = 6  # changes between two looks, at most
_BESIDE = 1e-4  # of a strip: slopes are compared with those so far from where the number changes
_STEEP = 10.0  # where two places run together, lines stand that many times steeper than beside
_LEVEL = 1e-9  # m along a tile: what rises less is level
_SLIVER = 1e-10  # parts of a strip that are shorter are left out
_CHUNK = 256  # curves at a time


@attrs.frozen(eq=False)
class WaterlineArcs:
    """Arcs of a waterline, port side, each from aft along its strip.

    Attributes
    ----------
    point : (k, n, 2), m
        x and y at n places of each arc, its ends included.
    slope : (k, n, 2), m
        Their derivatives by t, which goes from 0 to 1 along the arc.
    weight : (n,)
        Shares of the places in integrals over t.
    """

    point: FloatArray
    slope: FloatArray
    weight: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.point, self.slope, self.weight)

    @property
    def count(self) -> int:
        """Number of arcs."""
        return len(self.point)


def waterline_arcs(body: StripSpans, plane: FloatingPlanes) -> WaterlineArcs:
    """Cut strips by one upright floating plane; arcs come in the order of the strips, port side.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.immersion import FloatingPlanes
    >>> from assoc_hull.geometry.floating.raked_strips import strip_spans
    >>> from assoc_hull.geometry.floating.waterlines import waterline_arcs
    >>> plane = FloatingPlanes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> arcs = waterline_arcs(strip_spans(flotation(wigley()).prepared), plane)
    >>> area = 2.0 * (arcs.point[:, :, 1] * arcs.slope[:, :, 0]) @ arcs.weight
    >>> round(float(area.sum()))  # 2/3 L B
    667
    """
    parts = _pieces(_parts(body, plane), body)
    t, weight = lobatto(_NODES)
    walked, rate = root_walk(t, parts.starts, parts.ends)
    low, length = parts.low[:, None], (parts.high - parts.low)[:, None]
    v = np.clip(low + length * walked, low, parts.high[:, None])
    owner, place = _cut(body, plane, np.repeat(parts.strip, _NODES), v.ravel())
    count = np.bincount(owner, minlength=v.size).reshape(v.shape)
    same = (count == count[:, :1]).all(axis=1)
    keep = same[owner // _NODES]
    owner, place = owner[keep], place[keep]
    rank = np.arange(len(owner)) - np.searchsorted(owner, owner)
    order = np.lexsort((owner, rank, owner // _NODES))
    both = place[order].reshape(-1, _NODES, 4)
    own = owner[order].reshape(-1, _NODES)[:, :1] // _NODES
    with np.errstate(invalid="ignore"):  # endless where the waterline stands across the strip
        slope = both[..., 2:] * (length * rate)[own[:, 0], :, None]
    # Where an arc begins or ends inside a strip the waterline stands across it: no slope by v.
    known = np.isfinite(slope) & (rate[own[:, 0]] > 0.0)[..., None]
    point = both[..., :2].copy()
    slope = np.where(known, slope, np.einsum("ij,kjc->kic", differentiation_matrix(t), point))
    return WaterlineArcs(point, slope, weight.copy())


@attrs.frozen(eq=False)
class _Parts:
    """Parts of strips along which curves intersect the plane equally often, (p,) each.

    Attributes
    ----------
    strip : int
    low, high : from 0 to 1, along the strip
    starts, ends : bool
        There lines stand across the strip, as where two places run together.
    """

    strip: IntArray
    low: FloatArray
    high: FloatArray
    starts: NDArray[np.bool_]
    ends: NDArray[np.bool_]


def _pieces(parts: _Parts, body: StripSpans) -> _Parts:
    """Cut parts of strips into pieces, more of those that are raked or want a higher order."""
    wanted = -(-np.asarray(body.prepared.strips.order) // _PER_PIECE)
    count = np.where(body.flat, wanted, np.maximum(wanted, _PIECES))[parts.strip]
    row = np.repeat(np.arange(len(count)), count)
    piece = np.arange(len(row)) - (np.cumsum(count) - count)[row]
    size = ((parts.high - parts.low) / count)[row]
    low = parts.low[row] + piece * size
    last = piece == count[row] - 1
    high = np.where(last, parts.high[row], low + size)
    return _Parts(
        parts.strip[row], low, high, parts.starts[row] & (piece == 0), parts.ends[row] & last
    )


def _parts(body: StripSpans, plane: FloatingPlanes) -> _Parts:
    """Part strips where the number of places changes."""
    strips = body.prepared.strips
    look = np.linspace(0.0, 1.0, _LOOKS)
    strip = np.repeat(np.arange(strips.count), _LOOKS)
    seen = _count(body, plane, strip, np.tile(look, strips.count)).reshape(-1, _LOOKS)
    own, before, behind = _changes(body, plane, look, seen)
    every = np.arange(strips.count)
    zero, one = np.zeros(strips.count), np.ones(strips.count)
    low, high = np.concatenate([zero, behind]), np.concatenate([one, before])
    from_low, from_high = (np.concatenate([every, own]) for _ in range(2))
    rise, fall = np.lexsort((low, from_low)), np.lexsort((high, from_high))
    low, high = low[rise], high[fall]
    wide = np.flatnonzero(high - low > _SLIVER)
    strip, low, high = from_low[rise][wide], low[wide], high[wide]
    some = np.flatnonzero(_count(body, plane, strip, 0.5 * (low + high)) > 0)
    strip, low, high = strip[some], low[some], high[some]
    inner = 0.5 * (low + high)
    starts = (low > 0.0) & _across(body, plane, strip, low, inner)
    ends = (high < 1.0) & _across(body, plane, strip, high, inner)
    return _Parts(strip, low, high, starts, ends)


def _across(
    body: StripSpans, plane: FloatingPlanes, strip: IntArray, v: FloatArray, inner: FloatArray
) -> NDArray[np.bool_]:
    """Say whether lines stand across the strip at one end v of its parts."""
    beside = v + np.clip(inner - v, -_BESIDE, _BESIDE)
    fast = []
    for at in (v, beside):
        owner, place = _cut(body, plane, strip, at)
        rate, most = np.abs(place[:, 2:]).max(axis=1, initial=0.0), np.zeros(len(v))
        np.maximum.at(most, owner, np.where(np.isfinite(rate), rate, np.inf))
        fast.append(most)
    steep: NDArray[np.bool_] = fast[0] > _STEEP * fast[1]
    return steep


def _changes(
    body: StripSpans, plane: FloatingPlanes, look: FloatArray, seen: IntArray
) -> tuple[IntArray, FloatArray, FloatArray]:
    """Find where the number changes between looks: the strip, and v right before and behind."""
    strip, step = np.nonzero(seen[:, 1:] != seen[:, :-1])
    low, high = look[step], look[step + 1]
    below, above = seen[strip, step], seen[strip, step + 1]
    found = [(strip[:0], low[:0], low[:0])]
    for _ in range(_SEVERAL):
        if not len(strip):
            break
        first, end = low, high
        for _ in range(_HALVINGS):
            middle = 0.5 * (first + end)
            same = _count(body, plane, strip, middle) == below
            first, end = np.where(same, middle, first), np.where(same, end, middle)
        found.append((strip, first, end))
        beyond = _count(body, plane, strip, end)
        more = (beyond != above) & (end < high)
        strip, low, high, below, above = (each[more] for each in (strip, end, high, beyond, above))
    own, before, behind = (np.concatenate(each) for each in zip(*found, strict=True))
    return own, before, behind


def _count(body: StripSpans, plane: FloatingPlanes, strip: IntArray, v: FloatArray) -> IntArray:
    """Count how often curves intersect the plane."""
    found: IntArray = np.bincount(_cut(body, plane, strip, v)[0], minlength=len(v))
    return found


def _cut(
    body: StripSpans, plane: FloatingPlanes, strip: IntArray, v: FloatArray
) -> tuple[IntArray, FloatArray]:
    """Give where curves intersect the plane: of which curve, and x, y, dx/dv, dy/dv there, (k, 4).

    In the order of the curves, and along each from keel to deck.
    """
    strips = body.prepared.strips
    owner, place = [], []
    for begin in range(0, len(v), _CHUNK):
        some = slice(begin, begin + _CHUNK)
        tiles = tiles_of_curves(strips.curves(strip[some], v[some]))
        tilted = tilt_tiles(tiles, plane.tan_trim, np.zeros(1))
        tile, _ = candidate_pairs(tilted, plane.height)
        cuts = cut_tiles(tilted, tile, np.repeat(plane.height, len(tile)))
        at = tile[cuts.pair]
        order = np.argsort(at + np.minimum(cuts.u, 1.0), kind="stable")
        owner.append(begin + tiles.curve[at[order]])
        place.append(_along(tiles.coefficients[:, :, at[order]], cuts.u[order], plane.tan_trim))
    if not owner:
        return np.zeros(0, np.int64), np.zeros((0, 4))
    return np.concatenate(owner), np.concatenate(place)


def _along(coefficients: FloatArray, u: FloatArray, trim: FloatArray) -> FloatArray:
    """Give x, y, dx/dv and dy/dv (k, 4) of the waterline at places of tiles (6, 4, k)."""
    both = (coefficients * cubic_powers(u)).sum(axis=1)
    up = tile_slopes(coefficients[:3], u)
    rise = up[2] - trim * up[0]
    # Where a curve is but a point, or level, the waterline has no direction that could be given.
    rise = np.where(np.abs(rise) > _LEVEL, rise, np.nan)
    rate = both[3:5] - up[:2] * ((both[5] - trim * both[3]) / rise)
    return np.concatenate([both[:2], rate]).T


# --------------------------------------------------------------------------------------
# The main piece of a waterline: from where it is broadest to its end, forward or aft.

_SAME = 1e-9
"""Half breadths that differ by a smaller part are both the greatest."""

_SPECK = 1e-3
"""m: arcs that are no longer are left out, and ends that lie no farther apart are one."""


@attrs.frozen(eq=False)
class OuterLine:
    """A line in plan from where it is broadest to its end, as m arcs of n places.

    Attributes
    ----------
    point : (m, n, 2), m
        x and y; the line runs along the first axis, then along the second.
    slope : (m, n, 2), m
        Their derivatives along each arc, from 0 to 1, in the direction in which the line runs.
    weight : (n,)
        Shares of the places in integrals along an arc.
    """

    point: FloatArray
    slope: FloatArray
    weight: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.point, self.slope, self.weight)

    @property
    def end(self) -> tuple[float, float]:
        """Where the line ends: x and y, m."""
        x, y = self.point[-1, -1].tolist()
        return x, y

    @property
    def aftmost(self) -> tuple[float, float]:
        """Where the line is farthest aft: x and y, m; of several places the first along it."""
        places = self.point.reshape(-1, 2)
        x, y = places[int((places[:, 0] <= places[:, 0].min() + _SPECK).argmax())].tolist()
        return x, y

    @property
    def angle(self) -> FloatArray:
        """By how much the line runs inward, (m, n), radians: pi / 2 where it runs across."""
        inward: FloatArray = np.arctan2(-self.slope[..., 1], np.abs(self.slope[..., 0]))
        return inward

    def entrance(self, near: float, step: float) -> float:
        """Give the angle at the end of the line, or where it leaves the radius there; radians.

        The line is rounded there if, within `near` (m) of y = 0, it turns over a length of `step`
        (m) as much as a circle of radius `near` or more. It has left the radius at the end of the
        first such length, seen from the end of the line, over which it turns by no more than half
        of the most. So short waves of the curvature do not count, and behind a circle the angle is
        that of the tangent there.
        """
        angle = np.unwrap(self.angle.ravel()[::-1])
        place = self.point.reshape(-1, 2)[::-1]
        along = np.append(0.0, np.cumsum(np.hypot(*np.diff(place, axis=0).T)))
        behind = np.interp(along + step, along, angle)
        turn = np.where(along + step <= along[-1], angle - behind, 0.0)
        most = int(np.where(place[:, 1] <= near, turn, -np.inf).argmax())
        slack = np.flatnonzero(turn[most:] <= 0.5 * turn[most])
        if turn[most] * near < step or not len(slack):
            return float(angle[0])
        k = most + int(slack[0])
        share = (turn[k - 1] - 0.5 * turn[most]) / (turn[k - 1] - turn[k])
        return float(behind[k - 1] + share * (behind[k] - behind[k - 1]))

    def angle_beside(self, half_breadth: float) -> float:
        """Give the angle where the line, seen from its end, is first so far out (m); radians."""
        angle = np.unwrap(self.angle.ravel()[::-1])
        y = self.point[..., 1].ravel()[::-1]
        k = int((y >= half_breadth).argmax())
        if k == 0:
            return float(angle[0])
        share = (half_breadth - y[k - 1]) / (y[k] - y[k - 1])
        return float(angle[k - 1] + share * (angle[k] - angle[k - 1]))

    def bluntness(self) -> float:
        """Integral of the square of the sine of `angle` over -y, m; a flat end has sine 1."""
        dx, dy = self.slope[..., 0], self.slope[..., 1]
        square = dx * dx + dy * dy
        each = -dy * dy * dy / np.where(square > 0.0, square, 1.0)
        return float((each @ self.weight).sum()) + self.end[1]


def outer_line(arcs: WaterlineArcs, *, forward: bool) -> OuterLine | None:
    """Follow a waterline from where it is broadest to its forward end, or to its after end.

    Of places equally broad it begins at that next to the end. None without a waterline.
    """
    size = np.ptp(arcs.point, axis=1).max(axis=1, initial=0.0)
    some = np.flatnonzero(size > _SPECK)
    if not len(some):
        return None
    point, slope = arcs.point[some], arcs.slope[some]
    if not forward:
        point, slope = point[:, ::-1], -slope[:, ::-1]
    way = [(_broadest(point, 1.0 if forward else -1.0), False)]
    left = set(range(len(some))) - {way[0][0]}
    while left:
        last, turned = way[-1]
        end = point[last, 0 if turned else -1]
        chosen = np.array(sorted(left))
        away = np.abs(point[chosen][:, [0, -1]] - end).max(axis=2)
        row, side = np.unravel_index(int(away.argmin()), away.shape)
        if not away[row, side] <= 2.0 * _SPECK:
            break
        way.append((int(chosen[row]), bool(side == 1)))
        left.remove(way[-1][0])
    return _joined(point, slope, way, arcs.weight)


def _broadest(point: FloatArray, sense: float) -> int:
    """Give the arc to begin with: of those that reach the greatest breadth the farthest."""
    most = point[..., 1].max()
    held = point[..., 1] >= most * (1.0 - _SAME)
    ahead = sense * point[..., 0]
    place = np.where(held, ahead, -np.inf).max(axis=1)
    return int(np.lexsort((ahead.mean(axis=1), np.round(place / _SPECK)))[-1])


def _joined(
    point: FloatArray, slope: FloatArray, way: list[tuple[int, bool]], weight: FloatArray
) -> OuterLine:
    places = [point[arc, ::-1] if turned else point[arc] for arc, turned in way]
    slopes = [-slope[arc, ::-1] if turned else slope[arc] for arc, turned in way]
    return OuterLine(np.stack(places), np.stack(slopes), weight.copy())
