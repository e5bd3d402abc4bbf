"""Which arcs of a hull are bilges, and what a map leaves to be drawn anew of them."""

from __future__ import annotations

import math

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.feature_geometry import host_curve
from assoc_hull.model.features import Feature
from assoc_hull.model.state import HullState
from assoc_hull.variation.features.bilge import Bilge, bilge
from assoc_hull.variation.features.bilge_arc import Arc, BilgeMap
from assoc_hull.variation.features.map import JOIN
from assoc_hull.variation.fields.space_map import VMap

__all__ = ["bilge_map"]

_ON = 1e-6
"""Points as near (m) to a straight line are on it."""

_LARGEST = 0.1
"""An arc may lie off the image by so many of its radii."""


@attrs.frozen(eq=False)
class _Between:
    """A bilge and the straight lines it lies between, before a map.

    Attributes
    ----------
    x : float, m
        Of the section.
    bilge : Bilge
    inner, upper : (2,), m
        y and z at which the straight bottom begins, and the straight side ends.
    """

    x: float
    bilge: Bilge
    inner: FloatArray
    upper: FloatArray

    def at(self, yz: FloatArray) -> FloatArray:
        """Give places (n, 3), m, of the section."""
        return np.column_stack([np.full(len(yz), self.x), yz])

    def reach(self) -> tuple[float, float]:
        """Give how far along bottom and side a correction may go, m."""
        most = JOIN * self.bilge.radius
        floor = math.dist(self.inner.tolist(), self.bilge.floor.tolist())
        return min(most, floor), min(most, float(self.upper[1] - self.bilge.side[1]))


def bilge_map(state: HullState, vmap: VMap) -> BilgeMap:
    """Draw the bilge arcs of a hull anew for a map.

    Where it scales all about a bilge alike, nothing is drawn: a similarity makes an arc of it,
    other ratios of the whole hull an oval. An image is left as it is, too, that lies farther from
    any arc than a tenth of the radius.

    Parameters
    ----------
    state : HullState
        The tables, before the map.
    vmap : VMap
        The map.
    """
    arcs = [_drawn(state, each, vmap) for each in state.features if each.kind == "arc"]
    found = sorted((each for each in arcs if each is not None), key=lambda arc: arc.x)
    alone = [arc for i, arc in enumerate(found) if i == 0 or arc.x != found[i - 1].x]
    return BilgeMap(vmap, vmap.jacobian, tuple(alone))


def _drawn(state: HullState, feature: Feature, vmap: VMap) -> Arc | None:
    """Draw one arc anew; None if it is no bilge, or need not be, or cannot."""
    found = _between(state, feature)
    if found is None or _even(found, vmap):
        return None
    new = _filleted(found, vmap)
    if new is None:
        return None
    arc = Arc(
        feature.key, feature.name, found.x, found.bilge, new, found.reach(), vmap, vmap.jacobian
    )
    return arc if arc.most() <= _LARGEST * new.radius else None


def _between(state: HullState, feature: Feature) -> _Between | None:
    """Take an arc as a bilge between a straight bottom and an upright straight side."""
    curve, normal = host_curve(state, feature), feature.normal
    if curve < 0 or normal is None or feature.centre is None or feature.radius is None:
        return None
    rows = state.curves.rows.data[curve].tolist()
    xyz = state.rows.xyz.data[rows]
    first, last = (rows.index(feature.points[i]) for i in (0, -1))
    if xyz[first, 2] > xyz[last, 2]:
        xyz = xyz[::-1]
        first, last = len(rows) - 1 - first, len(rows) - 1 - last
    (x, y, z), r = feature.centre, feature.radius
    low, high = xyz[first, 1:], xyz[last, 1:]
    if abs(normal[0]) != 1.0 or not first < last or np.abs(high - [y + r, z]).max() > _ON:
        return None
    ahead = np.array([z - low[1], low[0] - y]) / r
    inner, upper = _run(xyz[first::-1, 1:], -ahead), _run(xyz[last:, 1:], np.array([0.0, 1.0]))
    if inner is None or upper is None or ahead[0] <= 0.0 or inner[0] < 0.0:
        return None
    return _Between(x, Bilge(y, z, r, low.copy(), high.copy()), inner, upper)


def _run(yz: FloatArray, ahead: FloatArray) -> FloatArray | None:
    """Give how far points run straight on from the first, (2,), m; None if they do not."""
    away = yz - yz[0]
    off = np.abs(away[:, 0] * ahead[1] - away[:, 1] * ahead[0])
    on = (off <= _ON) & (away @ ahead >= 0.0)
    last = len(yz) - 1 if on.all() else int(on.argmin()) - 1
    return yz[last].copy() if last > 0 else None


def _even(found: _Between, vmap: VMap) -> bool:
    """Tell whether a map scales all around a bilge alike: pure ratios of the hull do."""
    old, part = found.bilge, np.linspace(0.0, 1.0, 6)
    low, high = old.floor - old.radius, old.side + np.array([0.0, old.radius])
    grid = np.meshgrid(low[0] + part * (high[0] - low[0]), low[1] + part * (high[1] - low[1]))
    slope = vmap.jacobian(found.at(np.column_stack([each.ravel() for each in grid])))[:, 1:, 1:]
    return bool((slope == slope[0]).all())


def _filleted(found: _Between, vmap: VMap) -> Bilge | None:
    """Round off the corner of the images of bottom and side; None if these are not straight."""
    old, half = found.bilge, 0.5 * (found.inner + found.bilge.floor)
    ends = np.array([found.inner, half, old.floor, old.side, found.upper])
    foot, middle, low, high, upper = vmap(found.at(ends))[:, 1:]
    chord = low - foot
    half_way = middle - foot
    bend = float(chord[0] * half_way[1] - chord[1] * half_way[0]) / math.hypot(*chord.tolist())
    if max(abs(bend), abs(float(upper[0] - high[0]))) > _ON:
        return None
    rise = math.degrees(math.atan2(float(chord[1]), float(chord[0])))
    size = old.radius * _grown(found, vmap)
    try:
        return bilge(float(high[0]), size, rise, float(foot[0]), float(foot[1]))
    except BadInputError:
        return None


def _grown(found: _Between, vmap: VMap) -> float:
    """Give by what a map multiplies the radius: the root of what it does to areas."""
    slope = vmap.jacobian(np.array([[found.x, found.bilge.y, found.bilge.z]]))[0, 1:, 1:]
    return math.sqrt(float(slope[0, 0] * slope[1, 1] - slope[0, 1] * slope[1, 0]))
