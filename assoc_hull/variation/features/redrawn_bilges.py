"""Bilge arcs of sections that are drawn again after a map that bends the corner they lie in.

A bilge is a fillet between a straight bottom and an upright side. After a map both are straight
again, but the image of the arc is no arc: it is drawn again between the two, with the radius that
the map gives it. Its ends lie elsewhere on bottom and side than the images of the old ones; that
is spread along both, where it moves nothing off them, and fades fore and aft. Lengths in m, y, z
of the port half. `bilge_map` at the end finds the bilges of a net.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import number, positive
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.feature_geometry import host_curve
from assoc_hull.model.features import Feature
from assoc_hull.model.tables import HullState
from assoc_hull.variation.features.redrawn_circles import JOIN
from assoc_hull.variation.fields.bounded_functions import QUINTIC, BlendChain
from assoc_hull.variation.fields.field import FieldRegion
from assoc_hull.variation.fields.space_map import SlopedMap

__all__ = [
    "CURVE",
    "Bilge",
    "BilgeArc",
    "BilgeFillet",
    "BilgeMap",
    "bilge_map",
    "bilges_of",
    "fillet_bilge",
    "redraw_bilges",
]


@attrs.frozen(eq=False)
class BilgeFillet:
    """A bilge circle between a floor and a flat side.

    Attributes
    ----------
    y, z : float, m
        The centre.
    radius : float, m
    floor : (2,), m
        y and z at which it leaves the floor.
    side : (2,), m
        y and z at which it comes onto the side.
    """

    y: float
    z: float
    radius: float
    floor: FloatArray
    side: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.floor, self.side)

    @property
    def first(self) -> float:
        """The angle (radians) at which it leaves the floor; it comes onto the side at 0."""
        return math.atan2(float(self.floor[1]) - self.z, float(self.floor[0]) - self.y)

    def at(self, part: ArrayLike) -> FloatArray:
        """Give places y, z (n, 2), m, at parts of the arc, 0 on the floor and 1 on the side.

        The ends are exactly the tangent points.
        """
        t = np.asarray(part, np.float64)
        angle = self.first * (1.0 - t)
        inner = np.column_stack([np.cos(angle), np.sin(angle)]) * self.radius
        inner = inner + np.array([self.y, self.z])
        inner = np.where((t == 0.0)[:, None], self.floor, inner)
        return np.where((t == 1.0)[:, None], self.side, inner)

    def ahead(self, part: ArrayLike) -> FloatArray:
        """Give the derivatives of `at` by the part, (n, 2), m."""
        angle = self.first * (1.0 - np.asarray(part, np.float64))
        turn = np.column_stack([np.sin(angle), -np.cos(angle)])
        return np.asarray(self.first * self.radius * turn)


def fillet_bilge(
    half_breadth: float, radius: float, deadrise_deg: float = 0.0, keel: float = 0.0,
    base: float = 0.0,
) -> BilgeFillet:  # fmt: skip
    """Draw a bilge circle that is tangent to the floor and to the side.

    Parameters
    ----------
    half_breadth : float, m
        y of the flat side.
    radius : float, m
    deadrise_deg : float
        By how much the floor rises outward, degrees; negative if it falls.
    keel : float, m
        Half-width of the keel, from where the floor rises.
    base : float, m
        z of the keel.

    Raises
    ------
    BadInputError
        Not finite, or an arc that begins within the keel's half-width.

    Examples
    --------
    >>> from assoc_hull.variation.features.redrawn_bilges import fillet_bilge
    >>> arc = fillet_bilge(25.0, 2.4, deadrise_deg=2.0, keel=1.0)
    >>> round(arc.z, 10), arc.floor.round(10).tolist()
    (3.1557515273, [22.6837587921, 0.7572135425])
    """
    where = "in the bilge"
    side, foot = positive(half_breadth, "half_breadth", where), number(keel, "keel", where)
    r, low = positive(radius, "radius", where), number(base, "base", where)
    beta = math.radians(number(deadrise_deg, "deadrise_deg", where))
    if not abs(beta) < math.pi / 2.0:
        raise BadInputError(f"deadrise_deg is {deadrise_deg:g}", where, "give less than 90 degrees")
    y = side - r
    z = low + math.tan(beta) * (y - foot) + r / math.cos(beta)
    floor = np.array([y + r * math.sin(beta), z - r * math.cos(beta)])
    if beta == 0.0:
        floor[1] = low
    if float(floor[0]) < foot:
        raise BadInputError(
            f"bilge: radius {r:.1f} m leaves no bottom (keel half-width {foot:.1f})", "in vary",
            "make the radius smaller",
        )  # fmt: skip
    return BilgeFillet(y, z, r, floor, np.array([side, z]))


_Map = Callable[[FloatArray], FloatArray]

CURVE = 1e-4
"""The curve through the points of an arc lies as near to it, in radii; places as near as this are
put on the new arc."""


@attrs.frozen(eq=False)
class BilgeArc:
    """The bilge of a section before a map, and what is drawn for it afterwards.

    Attributes
    ----------
    key, name : str
        Of the feature.
    x : float, m
        Of the section, before.
    before, after : BilgeFillet
    reach : (float, float), m
        How far along the bottom and up the side the correction fades, before the map.
    image, slope : callable
        The map and its Jacobian.
    """

    key: str
    name: str
    x: float
    before: BilgeFillet
    after: BilgeFillet
    reach: tuple[float, float]
    image: _Map
    slope: _Map

    @property
    def centre(self) -> FloatArray:
        """The centre afterwards, (3,), m."""
        x = self.image(self._places(np.ones(1)))[0, 0]
        return np.array([x, self.after.y, self.after.z])

    def step(self, part: FloatArray) -> FloatArray:
        """Give y and z (n, 2), m, from the image to the new arc, at parts of the arc."""
        return np.asarray(self.after.at(part) - self.image(self._places(part))[:, 1:])

    def turning(self, part: FloatArray) -> FloatArray:
        """Give the derivatives of `step` by the part, (n, 2)."""
        slope = self.slope(self._places(part))[:, 1:, 1:]
        old, new = self.before.ahead(part), self.after.ahead(part)
        return np.asarray(new - (slope * old[:, None, :]).sum(axis=2))

    def _places(self, part: FloatArray) -> FloatArray:
        """Give places (n, 3), m, of the section at parts of the old arc."""
        return np.column_stack([np.full(len(part), self.x), self.before.at(part)])

    def most(self) -> float:
        """Give how far the new arc lies off the image at most, m."""
        step = self.step(np.linspace(0.0, 1.0, 33))
        return float(np.sqrt((step * step).sum(axis=1)).max())

    def correction(self, y: FloatArray, z: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Give the correction (n, 2), m, at places of the section, and its slopes (n, 2, 2).

        It is whole on the arc, fades along bottom and side, and as it leaves them; the centre
        and what lies farther in it leaves alone.
        """
        old = self.before
        away = np.column_stack([y - old.y, z - old.z])
        size = np.sqrt((away * away).sum(axis=1))
        unit = away / np.where(size > 0.0, size, 1.0)[:, None]
        down = (old.floor - [old.y, old.z]) / old.radius
        keelward = np.array([down[1], -down[0]])
        inward, upward = (away * keelward).sum(axis=1), away[:, 1]
        # three zones: inward of the tangent point on the floor, above that on the side, and the
        # arc
        floor = inward > 0.0
        side = ~floor & (upward > 0.0)
        past = np.where(floor, inward, np.where(side, upward, 0.0))
        reach = np.where(floor, self.reach[0], self.reach[1])
        angle = np.arctan2(away[:, 1], away[:, 0])
        part = np.clip(1.0 - angle / old.first, 0.0, 1.0)
        part = np.where(floor, 0.0, np.where(side, 1.0, part))
        across = np.where(floor[:, None], down, np.where(side[:, None], [1.0, 0.0], unit))
        off = (away * across).sum(axis=1) - old.radius
        near, sink = _fade(np.abs(off), np.full(len(off), old.radius))
        left, fall = _fade(past, reach)
        step, turn = self.step(part), self.turning(part)
        on = ~floor & ~side & (np.abs(off) <= CURVE * old.radius)
        if on.any():
            own = np.column_stack([np.full(int(on.sum()), self.x), y[on], z[on]])
            step[on] = self.after.at(part[on]) - self.image(own)[:, 1:]
        spin = np.column_stack([-unit[:, 1], unit[:, 0]])
        spin = spin / np.where(size > 0.0, size, np.inf)[:, None] / -old.first
        spin[floor | side] = 0.0
        along = np.where(floor[:, None], keelward, np.where(side[:, None], [0.0, 1.0], 0.0))
        weight = (near * left)[:, None]
        grow = (near * fall)[:, None] * along + (left * sink * np.sign(off))[:, None] * across
        slope = weight[:, :, None] * turn[:, :, None] * spin[:, None, :]
        return weight * step, slope + step[:, :, None] * grow[:, None, :]


def _fade(away: FloatArray, reach: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give what is left at a distance, and its slope."""
    t = away / reach
    return 1.0 - QUINTIC.value(t), -QUINTIC.slope(t) / reach


@attrs.frozen(eq=False)
class BilgeMap:
    """A map after which the bilge arcs of sections are arcs again.

    Attributes
    ----------
    image, slope : callable
        The map of places (n, 3), m, and its Jacobian, (n, 3, 3).
    arcs : tuple of BilgeArc
        From aft forward; without any it is the map.
    """

    image: _Map
    slope: _Map
    arcs: tuple[BilgeArc, ...] = ()

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places (n, 3), m; those that no arc reaches keep the bits of the map."""
        found = self.image(xyz)
        for arc, share in zip(self.arcs, self.shares(), strict=True):
            some = np.flatnonzero(share.at(xyz[:, 0]) != 0.0)
            if len(some):
                x, y, z = xyz[some].T
                step = share.at(x)[:, None] * arc.correction(np.abs(y), z)[0]
                # starboard is the mirror of port
                step[:, 0] = np.where(y < 0.0, -step[:, 0], step[:, 0])
                # what has no step keeps its bits, a negative zero as well
                found[some, 1:] = np.where(step != 0.0, found[some, 1:] + step, found[some, 1:])
        return found

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives of the places after by those before, (n, 3, 3)."""
        found = self.slope(xyz)
        for arc, share in zip(self.arcs, self.shares(), strict=True):
            some = np.flatnonzero(share.at(xyz[:, 0]) != 0.0)
            if len(some):
                x, y, z = xyz[some].T
                step, slope = arc.correction(np.abs(y), z)
                more = np.zeros((len(some), 3, 3))
                more[:, 1:, 0] = share.slope(x)[:, None] * step
                more[:, 1:, 1:] = share.at(x)[:, None, None] * slope
                mirror = np.where((y < 0.0)[:, None], [1.0, -1.0, 1.0], 1.0)
                found[some] += mirror[:, :, None] * more * mirror[:, None, :]
        return found

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the boxes of the profile plane in which arcs change the map."""
        return tuple(
            FieldRegion(arc.name, (float(share.nodes[0]), float(share.nodes[-1])), _heights(arc))
            for arc, share in zip(self.arcs, self.shares(), strict=True)
        )

    def shares(self) -> list[BlendChain]:
        """Give how much each arc counts along the ship: those of two neighbours add up to one."""
        x = [arc.x for arc in self.arcs]
        low = [arc.x - JOIN * arc.before.radius for arc in self.arcs[:1]] + x[:-1]
        high = x[1:] + [arc.x + JOIN * arc.before.radius for arc in self.arcs[-1:]]
        return [
            BlendChain.through(nodes, [0.0, 1.0, 0.0], QUINTIC, "bilge")
            for nodes in zip(low, x, high, strict=True)
        ]


def _heights(arc: BilgeArc) -> tuple[float, float]:
    """Give between which heights, m, an arc changes the map."""
    old = arc.before
    low = min(float(old.floor[1]), float(old.floor[1]) - arc.reach[0]) - old.radius
    return low, float(old.side[1]) + arc.reach[1]


# --------------------------------------------------------------------------------------
# Which arcs of a hull are bilges, and which of them a map leaves to be drawn again.

_ON = 1e-6
"""Points as near as this (m) to a straight line are on it."""

_LARGEST = 0.1
"""An arc may lie off the image by this part of its radius."""


@attrs.frozen(eq=False)
class Bilge:
    """A bilge and the straight lines it lies between, before a map.

    Attributes
    ----------
    x : float, m
        Of the section.
    bilge : BilgeFillet
    inner, upper : (2,), m
        y and z at which the straight bottom begins, and the straight side ends.
    """

    x: float
    bilge: BilgeFillet
    inner: FloatArray
    upper: FloatArray

    def at(self, yz: FloatArray) -> FloatArray:
        """Give places (n, 3), m, of the section."""
        return np.column_stack([np.full(len(yz), self.x), yz])

    @cached_property
    def around(self) -> FloatArray:
        """Places all around it, (n, 3), m."""
        old, part = self.bilge, np.linspace(0.0, 1.0, 6)
        low, high = old.floor - old.radius, old.side + np.array([0.0, old.radius])
        grid = np.meshgrid(low[0] + part * (high[0] - low[0]), low[1] + part * (high[1] - low[1]))
        found = self.at(np.column_stack([each.ravel() for each in grid]))
        freeze(found)
        return found

    def reach(self) -> tuple[float, float]:
        """Give how far along bottom and side a correction may go, m."""
        most = JOIN * self.bilge.radius
        floor = math.dist(self.inner.tolist(), self.bilge.floor.tolist())
        return min(most, floor), min(most, float(self.upper[1] - self.bilge.side[1]))


def bilge_map(state: HullState, vmap: SlopedMap) -> BilgeMap:
    """Draw the bilge arcs of a hull again for a map, as `redraw_bilges`."""
    return redraw_bilges(bilges_of(state), vmap)


def bilges_of(state: HullState) -> tuple[tuple[Feature, Bilge], ...]:
    """Give the arcs of a hull that are bilges, by their keys."""
    found = [(each, _between(state, each)) for each in state.features if each.kind == "arc"]
    return tuple((each, bilge) for each, bilge in found if bilge is not None)


def redraw_bilges(bilges: Sequence[tuple[Feature, Bilge]], vmap: SlopedMap) -> BilgeMap:
    """Draw bilge arcs again for a map.

    Where the map scales all about a bilge alike, nothing is drawn: a similarity makes an arc of it,
    other ratios of the whole hull an oval. An image that lies farther from the new arc than a tenth
    of the radius is left as it is, too.

    Parameters
    ----------
    bilges : sequence of (Feature, Bilge)
        Of the hull, before the map.
    vmap : SlopedMap
        The map.
    """
    arcs = [_drawn(feature, bilge, vmap) for feature, bilge in bilges]
    found = sorted((each for each in arcs if each is not None), key=lambda arc: arc.x)
    # one arc a station: the shares along the ship need rising nodes
    alone = [arc for i, arc in enumerate(found) if i == 0 or arc.x != found[i - 1].x]
    return BilgeMap(vmap, vmap.jacobian, tuple(alone))


def _drawn(feature: Feature, found: Bilge, vmap: SlopedMap) -> BilgeArc | None:
    """Draw one arc again; None if it need not be drawn again, or cannot."""
    if _even(found, vmap):
        return None
    new = _filleted(found, vmap)
    if new is None:
        return None
    arc = BilgeArc(
        feature.key, feature.name, found.x, found.bilge, new, found.reach(), vmap, vmap.jacobian
    )
    return arc if arc.most() <= _LARGEST * new.radius else None


def _between(state: HullState, feature: Feature) -> Bilge | None:
    """Take an arc as a bilge between a straight bottom and an upright straight side."""
    curve, normal = host_curve(state, feature), feature.normal
    if curve < 0 or normal is None or feature.centre is None or feature.radius is None:
        return None
    rows = state.curves.rows[curve].tolist()
    xyz = state.rows.xyz[rows]
    first, last = (rows.index(feature.points[i]) for i in (0, -1))
    # from the bottom up, whichever way the curve runs
    if xyz[first, 2] > xyz[last, 2]:
        xyz = xyz[::-1]
        first, last = len(rows) - 1 - first, len(rows) - 1 - last
    (x, y, z), r = feature.centre, feature.radius
    low, high = xyz[first, 1:], xyz[last, 1:]
    if abs(normal[0]) != 1.0 or not first < last or np.abs(high - [y + r, z]).max() > _ON:
        return None
    # the tangent of the arc at its foot, outward: the bottom must run on straight from there
    ahead = np.array([z - low[1], low[0] - y]) / r
    inner, upper = _run(xyz[first::-1, 1:], -ahead), _run(xyz[last:, 1:], np.array([0.0, 1.0]))
    if inner is None or upper is None or ahead[0] <= 0.0 or inner[0] < 0.0:
        return None
    return Bilge(x, BilgeFillet(y, z, r, low.copy(), high.copy()), inner, upper)


def _run(yz: FloatArray, ahead: FloatArray) -> FloatArray | None:
    """Give how far points run straight on from the first, (2,), m; None if they do not."""
    away = yz - yz[0]
    off = np.abs(away[:, 0] * ahead[1] - away[:, 1] * ahead[0])
    on = (off <= _ON) & (away @ ahead >= 0.0)
    last = len(yz) - 1 if on.all() else int(on.argmin()) - 1
    return yz[last].copy() if last > 0 else None


def _even(found: Bilge, vmap: SlopedMap) -> bool:
    """Tell whether a map scales all around a bilge alike: pure ratios of the hull do."""
    slope = vmap.jacobian(found.around)[:, 1:, 1:]
    return bool((slope == slope[0]).all())


def _filleted(found: Bilge, vmap: SlopedMap) -> BilgeFillet | None:
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
        return fillet_bilge(float(high[0]), size, rise, float(foot[0]), float(foot[1]))
    except BadInputError:
        return None


def _grown(found: Bilge, vmap: SlopedMap) -> float:
    """Give by what a map multiplies the radius: the root of what it does to areas."""
    slope = vmap.jacobian(np.array([[found.x, found.bilge.y, found.bilge.z]]))[0, 1:, 1:]
    return math.sqrt(float(slope[0, 0] * slope[1, 1] - slope[0, 1] * slope[1, 0]))
