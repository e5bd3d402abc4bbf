"""The features of a hull that a variation makes anew, and what touches them.

Circles are drawn anew about where the map sends their centres, bilge arcs between bottom and
side. What the map does to flats, straight runs and knuckle lines their points tell: they stay
features where it leaves them so.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cache, cached_property
from typing import TYPE_CHECKING

import attrs
import numpy as np

from assoc_hull.edit.crossings.adopted_points import PlaneTangency
from assoc_hull.edit.recut.carried_points import TransformationState
from assoc_hull.edit.space_map import CarriedFeatures, SpaceMap
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.feature_geometry import host_curve
from assoc_hull.model.features import Feature
from assoc_hull.model.program.engine import is_compiled
from assoc_hull.model.tables import HullState
from assoc_hull.variation.features.redrawn_bilges import (
    Bilge,
    BilgeArc,
    BilgeMap,
    bilges_of,
    redraw_bilges,
)
from assoc_hull.variation.features.redrawn_circles import (
    GAP,
    JOIN,
    FeatureMap,
    RedrawnCircle,
    SpaceCircle,
    changed_circles,
    redraw_circle,
    same_area,
    tangent_point,
)
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.field import FieldRegion, StackedField
from assoc_hull.variation.fields.layers import FieldLayer, Layer
from assoc_hull.variation.fields.space_map import SlopedMap, VariationMap, moved_coordinates

if TYPE_CHECKING:
    from assoc_hull.variation.features.compiled_map import CompiledMap

__all__ = ["HullFeatures", "RedrawnFeatures", "redraw_features"]

_ROUND = 1e-6
"""A curve that is a circle leaves it by no more (m)."""

_OBLATE = 1.2
"""A circle that is stretched by more one way than the other is meant to be an oval."""

_FEW = 54
"""At so many places a map is asked first whether it is affine."""

_END = 1e-3
"""A touch as near as this (m) to an end of the curve is that end."""


@attrs.frozen(eq=False)
class RedrawnFeatures:
    """A map that makes the circles of a hull anew.

    Attributes
    ----------
    map : FeatureMap
    keys : tuple of str
        The features that the circles are.
    hosts : tuple of int
        The curves that they are, one each.
    bilges : BilgeMap
        What `map` draws circles anew after.
    layers : tuple of Layer
        What `bilges` draws bilges anew after.
    plain : SlopedMap
        These alone as a map, compiled where that is at hand.
    """

    map: FeatureMap
    keys: tuple[str, ...]
    hosts: tuple[int, ...]
    bilges: BilgeMap
    layers: tuple[Layer, ...]
    plain: SlopedMap

    @cached_property
    def quick(self) -> SlopedMap:
        """What `map` is, compiled where that is at hand: the same bits, sooner."""
        if not self.drawn and not isinstance(self.plain, VariationMap) and is_compiled():
            return self.plain
        arcs = list(zip(self.bilges.arcs, self.bilges.shares(), strict=True))
        return _compiled(self.layers, arcs, self.map.circles, counts=True) or self.map

    @property
    def drawn(self) -> bool:
        """Whether anything is drawn anew."""
        return len(self.map.circles) + len(self.bilges.arcs) > 0

    @property
    def space(self) -> SpaceMap:
        """The map as a transformation uses it."""
        moves = (True, True, True) if self.drawn else moved_coordinates(self.layers)
        return SpaceMap(self.quick, self.quick.jacobian, moves)

    def regions(self) -> tuple[FieldRegion, ...]:
        """Give the boxes of the profile plane in which features change the map."""
        return self.map.regions() + self.bilges.regions()

    def settle(self, work: TransformationState) -> None:
        """Tell a transformation which curves are circles, and which planes touch them."""
        for curve, circle in zip(self.hosts, self.map.circles, strict=True):
            work.fine[curve] = _ROUND
            for found in _touches(work, curve, circle.after):
                work.touches[curve, found.line] = found

    def features(self, carried: CarriedFeatures) -> CarriedFeatures:
        """Give carried features the centres and radii that they are drawn with."""
        drawn = {
            key: (circle.after.centre.tolist(), circle.after.radius)
            for key, circle in zip(self.keys, self.map.circles, strict=True)
        }
        for arc in self.bilges.arcs:
            drawn[arc.key] = arc.centre.tolist(), arc.after.radius
        found = tuple(
            _as_drawn(each, *drawn[each.key]) if each.key in drawn else each
            for each in carried.features
        )
        return attrs.evolve(carried, features=found, bent=carried.bent - drawn.keys())


def _compiled(
    layers: Sequence[Layer], arcs: Sequence[tuple[BilgeArc, BlendChain]] = (),
    circles: Sequence[RedrawnCircle] = (), *, counts: bool = False,
) -> CompiledMap | None:  # fmt: skip
    """Give a map in compiled form; None where numpy serves.

    Intervals of values are sought by many maps that carry nothing: these do not count.
    """
    if not is_compiled(counts=counts):
        return None
    from assoc_hull.variation.features.compiled_map import CompiledMap
    from assoc_hull.variation.features.flat_map import FlatMap

    flat = FlatMap.of(layers, arcs, circles)
    return None if flat is None else CompiledMap(flat)


@attrs.frozen(eq=False)
class HullFeatures:
    """The circles and bilges of a hull before any map: looked up once for many maps.

    Attributes
    ----------
    circles : tuple of (Feature, SpaceCircle, int)
        With the curve that each is.
    bilges : tuple of (Feature, Bilge)
        Arcs between a straight bottom and an upright side.
    """

    circles: tuple[tuple[Feature, SpaceCircle, int], ...]
    bilges: tuple[tuple[Feature, Bilge], ...]

    @classmethod
    def of(cls, state: HullState) -> HullFeatures:
        """Look them up in tables."""
        circles = [
            (each, SpaceCircle.of(
                each.parameters["centre"], float(each.radius or 0.0), each.parameters["normal"]
            ), host_curve(state, each))
            for each in state.features if each.kind == "circle"
        ]  # fmt: skip
        return cls(tuple(circles), bilges_of(state))


def redraw_features(
    state: HullState, vmap: VariationMap, radii: Mapping[str, float] | None = None,
    had: HullFeatures | None = None,
) -> RedrawnFeatures:  # fmt: skip
    """Draw the circles and the bilge arcs of a hull anew for a map.

    Parameters
    ----------
    state : HullState
        The tables, before the map.
    vmap : VariationMap
        The map.
    radii : mapping of str to float, m, or None
        Radii that are asked for, by the keys of features.
    had : HullFeatures or None
        What is to be drawn anew, if it is at hand.

    Raises
    ------
    BadInputError
        The map leaves a circle too far from any.
    """
    had = HullFeatures.of(state) if had is None else had
    quick = _compiled(vmap.layers) or vmap
    before = {each.key: (each, circle) for each, circle, _ in had.circles}
    wanted = _of_cylinders(before, radii or {}, quick)
    drawn = {
        key: _redrawn(*each, quick, wanted.get(key))
        for key, each in before.items()
        if key in wanted or not _stretched(each[1], quick)
    }
    plain = _straight_across(vmap.layers)
    changed = changed_circles(list(drawn.values()))
    some = [each for each in changed if not _even(each, quick, plain=plain)]
    chosen = [(each.key, host) for each, _, host in had.circles if drawn.get(each.key) in some]
    bilges = redraw_bilges(had.bilges, quick)
    return RedrawnFeatures(
        FeatureMap(bilges, bilges.jacobian, tuple(drawn[key] for key, _ in chosen)),
        tuple(key for key, _ in chosen),
        tuple(host for _, host in chosen),
        bilges,
        vmap.layers,
        quick,
    )


def _of_cylinders(
    before: Mapping[str, tuple[Feature, SpaceCircle]], radii: Mapping[str, float],
    vmap: SlopedMap,
) -> dict[str, float]:  # fmt: skip
    """Let a cylinder stay one: circles that are one with an asked one get its radius to the bit.

    They are those on its axis of its radius which the map makes as large as that one. It need not
    be what is asked for: a map of ratios makes all of them too small alike.
    """
    found = dict(radii)
    for asked, round_asked in [each for each in before.values() if each[0].key in radii]:
        size = same_area(round_asked, vmap.jacobian)
        for each, circle in before.values():
            same = each.key not in found and _one_cylinder(asked, each)
            if same and abs(same_area(circle, vmap.jacobian) - size) <= _ROUND:
                found[each.key] = radii[asked.key]
    return found


def _one_cylinder(one: Feature, other: Feature) -> bool:
    """Tell whether two circles are of one cylinder: about one axis, and of one radius."""
    if one.radius != other.radius or one.normal != other.normal:
        return False
    normal = np.array(one.parameters["normal"])
    away = np.array(other.parameters["centre"]) - one.parameters["centre"]
    return not (away - float((away * normal).sum()) * normal).any()


def _straight_across(layers: Sequence[Layer]) -> bool:
    """Tell whether what layers do across the ship is linear: two breadths tell of all others."""
    return all(
        isinstance(layer, FieldLayer)
        and all(not isinstance(each, StackedField) or each.tube is None for each in layer.fields)
        for layer in layers
    )


@cache
def _around(*, plain: bool) -> FloatArray:
    """Give places of a cube about nought, (n, 3), from -1 to 1; of its two sides if `plain`."""
    part = np.linspace(-1.0, 1.0, 15)
    out = part[[0, -1]] if plain else part
    found = np.stack(np.meshgrid(part, out, part, indexing="ij"), axis=-1).reshape(-1, 3)
    freeze(found)
    return found


def _even(circle: RedrawnCircle, vmap: SlopedMap, *, plain: bool = False) -> bool:
    """Tell whether a circle is carried by a map that is affine in all its neighbourhood.

    Its curve is then the curve of before, scaled, as are those that meet it: put onto the circle
    to the bit, points would leave the planes of their lines. Of a map that is `plain` across the
    ship less has to be looked at.
    """
    if not circle.carried:
        return False
    grid = circle.before.centre + (JOIN + 1.0) * circle.before.radius * _around(plain=plain)
    # most maps that are not affine tell so at a few of these places already
    return all(
        bool((slope == slope[0]).all())
        for slope in (vmap.jacobian(grid[:: len(grid) // _FEW]), vmap.jacobian(grid))
    )


def _stretched(circle: SpaceCircle, vmap: SlopedMap) -> bool:
    """Tell whether a map stretches a circle so much, and evenly, that it is meant to be none."""
    slope = vmap.jacobian(circle.centre[None])[0]
    across = slope - np.outer(slope @ circle.normal, circle.normal)
    size = np.linalg.svd(across, compute_uv=False)
    return bool(size[0] > _OBLATE * size[1])


def _redrawn(
    feature: Feature, before: SpaceCircle, vmap: SlopedMap, radius: float | None
) -> RedrawnCircle:
    gap = max(GAP, 2.0 * feature.gap)
    return redraw_circle(feature.name, before, vmap, vmap.jacobian, radius=radius, gap=gap)


def _as_drawn(feature: Feature, centre: Sequence[float], radius: float) -> Feature:
    return attrs.evolve(feature, centre=centre, radius=radius)


def _touches(work: TransformationState, curve: int, circle: SpaceCircle) -> list[PlaneTangency]:
    """Give the touches of a circle with the planes of lines that are cut again."""
    state, planes = work.state, work.planes
    line = state.lines
    lines = state.live("lines")
    lines = lines[~work.driver[lines] & planes.planar[lines] & (line.boundary[lines] < 0)]
    found: list[PlaneTangency] = []
    for each in sorted(lines.tolist(), key=lambda number: str(line.key[number])):
        place = tangent_point(circle, planes.normal[each], float(planes.offset[each]))
        if place is not None and _within(work, curve, place):
            found.append(PlaneTangency(curve, each, place))
    return found


def _within(work: TransformationState, curve: int, place: FloatArray) -> bool:
    """Tell whether a place of a circle is one of the curve, and none of its ends."""
    rows = work.state.curves.rows[curve]
    image = work.image[rows]
    step = np.sqrt(((image - place) ** 2).sum(axis=1))
    if min(step[0], step[-1]) <= _END:
        return False
    chord = np.sqrt((np.diff(image, axis=0) ** 2).sum(axis=1))
    near = int(np.argmin(step))
    beside = chord[max(near - 1, 0) : near + 1]
    return bool(step[near] <= float(beside.max()))
