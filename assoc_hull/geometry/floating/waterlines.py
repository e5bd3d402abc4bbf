"""The waterline of a body: where a floating plane cuts its surface, arc by arc.

Each curve across a strip meets the plane at some places. As far as their number stays the same
along the strip they form arcs, which end where two of them run together or one leaves the strip.
An arc is known at so many places that the polynomial through these has it, with its slopes.
"""

from __future__ import annotations

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersed import Planes
from assoc_hull.geometry.floating.immersion_extents import slopes
from assoc_hull.geometry.floating.immersion_roots import candidates, cuts, tilt
from assoc_hull.geometry.floating.strip_spans import Spans
from assoc_hull.geometry.floating.tiles import from_curves, powers
from assoc_hull.geometry.numeric.interpolation import differences
from assoc_hull.geometry.numeric.quadrature import lobatto, root_walk

__all__ = ["Arcs", "waterline_arcs"]

_NODES = 8
_PIECES = 12  # of each part of a raked strip: lines bend there
_PER_PIECE = 4  # Gauss points of a strip of sections
_LOOKS = 9  # at each strip, for where the number of places changes
_HALVINGS = 46
_SEVERAL = 6  # changes between two looks, at most
_BESIDE = 1e-4  # of a strip: so far from a place at which the number changes it is looked again
_STEEP = 10.0  # where two places run together, lines stand that many times steeper than beside
_LEVEL = 1e-9  # m along a tile: what rises less is level
_SLIVER = 1e-10  # parts of a strip that are shorter are left out
_CHUNK = 256  # curves at a time


@attrs.frozen(eq=False)
class Arcs:
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


def waterline_arcs(body: Spans, plane: Planes) -> Arcs:
    """Cut strips by a floating plane.

    Parameters
    ----------
    body : Spans
        The strips.
    plane : Planes
        One plane, upright.

    Returns
    -------
    Arcs
        In the order of the strips.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.flotation import flotation
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.geometry.floating.immersed import Planes
    >>> from assoc_hull.geometry.floating.strip_spans import spans
    >>> from assoc_hull.geometry.floating.waterlines import waterline_arcs
    >>> plane = Planes(np.array([6.25]), np.zeros(1), np.zeros(1))
    >>> arcs = waterline_arcs(spans(flotation(wigley()).prepared), plane)
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
    # Where an arc begins or ends inside a strip the waterline stands across it.
    told = np.isfinite(slope) & (rate[own[:, 0]] > 0.0)[..., None]
    point = both[..., :2].copy()
    slope = np.where(told, slope, np.einsum("ij,kjc->kic", differences(t), point))
    return Arcs(point, slope, weight.copy())


@attrs.frozen(eq=False)
class _Parts:
    """Parts of strips along which curves meet the plane equally often, (p,) each.

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


def _pieces(parts: _Parts, body: Spans) -> _Parts:
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


def _parts(body: Spans, plane: Planes) -> _Parts:
    """Part strips where the number of places changes."""
    strips = body.prepared.strips
    look = np.linspace(0.0, 1.0, _LOOKS)
    strip = np.repeat(np.arange(strips.count), _LOOKS)
    seen = _count(body, plane, strip, np.tile(look, strips.count)).reshape(-1, _LOOKS)
    own, before, behind = _changes(body, plane, look, seen)
    every = np.arange(strips.count)
    nil, one = np.zeros(strips.count), np.ones(strips.count)
    low, high = np.concatenate([nil, behind]), np.concatenate([one, before])
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
    body: Spans, plane: Planes, strip: IntArray, v: FloatArray, inner: FloatArray
) -> NDArray[np.bool_]:
    """Tell whether lines stand across the strip at one end v of its parts."""
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
    body: Spans, plane: Planes, look: FloatArray, seen: IntArray
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


def _count(body: Spans, plane: Planes, strip: IntArray, v: FloatArray) -> IntArray:
    """Tell how often curves meet the plane."""
    found: IntArray = np.bincount(_cut(body, plane, strip, v)[0], minlength=len(v))
    return found


def _cut(body: Spans, plane: Planes, strip: IntArray, v: FloatArray) -> tuple[IntArray, FloatArray]:
    """Give where curves meet the plane: of which curve, and x, y, dx/dv, dy/dv there, (k, 4).

    In the order of the curves, and along each from keel to deck.
    """
    strips = body.prepared.strips
    owner, place = [], []
    for begin in range(0, len(v), _CHUNK):
        some = slice(begin, begin + _CHUNK)
        tiles = from_curves(strips.curves(strip[some], v[some]))
        tilted = tilt(tiles, plane.tan_trim, np.zeros(1))
        tile, _ = candidates(tilted, plane.height)
        met = cuts(tilted, tile, np.repeat(plane.height, len(tile)))
        at = tile[met.pair]
        order = np.argsort(at + np.minimum(met.u, 1.0), kind="stable")
        owner.append(begin + tiles.curve[at[order]])
        place.append(_along(tiles.coefficients[:, :, at[order]], met.u[order], plane.tan_trim))
    if not owner:
        return np.zeros(0, np.int64), np.zeros((0, 4))
    return np.concatenate(owner), np.concatenate(place)


def _along(coefficients: FloatArray, u: FloatArray, trim: FloatArray) -> FloatArray:
    """Give x, y, dx/dv and dy/dv (k, 4) of the waterline at places of tiles (6, 4, k)."""
    both = (coefficients * powers(u)).sum(axis=1)
    up = slopes(coefficients[:3], u)
    rise = up[2] - trim * up[0]
    # No way along the waterline can be told where a curve is but a point, or level.
    rise = np.where(np.abs(rise) > _LEVEL, rise, np.nan)
    rate = both[3:5] - up[:2] * ((both[5] - trim * both[3]) / rise)
    return np.concatenate([both[:2], rate]).T
