"""Features under a mapping of space: centres, radii, planes and tangents as it sends them.

A circle keeps to a circle only where the mapping is a similarity on it; a run stays straight only
where the mapping does not bend it. The images of their points decide.

Examples
--------
>>> from assoc_hull.edit.mapped_features import carry_features
>>> from assoc_hull.edit.space_map import space_map
>>> from assoc_hull.shipped.wigley import wigley
>>> twice = space_map(None, None, [2, 2, 2], None)
>>> len(carry_features(wigley(stations=5, waterlines=4), twice, 1e-3).features)
3
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import attrs
import numpy as np

from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.polylines.fitted_circle import fit_circle_in_plane
from assoc_hull.model.feature_geometry import places_off, rounded_gap, rounding_of
from assoc_hull.model.features import Feature
from assoc_hull.model.tables import HullState

__all__ = ["CarriedFeatures", "carry_features"]


@attrs.frozen(eq=False)
class CarriedFeatures:
    """Features with the parameters that a mapping gives them.

    Attributes
    ----------
    features : tuple of Feature
        With the points they had. A circle is the one on which the images of its points lie;
        where they lie on none, centre and radius are those of the image of the centre and of
        the mean distance from it. A gap grows as the radius or as the run of the points does.
    bent : frozenset of str
        Keys of those whose points are not on them after the mapping.
    within : float, m
        How far the points of the others may come to lie off them when lines are cut again. Inf:
        all features stay, for who makes them anew right after.
    places : mapping of int to (3,), m
        Where the mapping sends the points that they own.
    """

    features: tuple[Feature, ...]
    bent: frozenset[str]
    within: float
    places: Mapping[int, FloatArray] = attrs.field(factory=dict)

    def anew(self, features: Iterable[Feature]) -> CarriedFeatures:
        """Let features that were made anew take the place of those of their keys."""
        made = {each.key: each for each in features}
        return CarriedFeatures(
            tuple(made.get(each.key, each) for each in self.features),
            self.bent - made.keys(), self.within, self.places,
        )  # fmt: skip


def carry_features(state: HullState, space: SpaceMap, within: float) -> CarriedFeatures:
    """Give the features of a hull with the parameters that a mapping gives them.

    Parameters
    ----------
    state : HullState
        The tables, before anything is mapped.
    space : SpaceMap
        The mapping.
    within : float, m
        See `CarriedFeatures`.
    """
    features = state.features
    if not features:
        return CarriedFeatures((), frozenset(), within)
    start = np.cumsum([0, *(len(each.points) for each in features)])
    rows = [row for each in features for row in each.points]
    old = state.rows.xyz[rows]
    new = space.places(old)
    middle = np.array([each.centre or old[at] for each, at in zip(features, start, strict=False)])
    image, slope = space.places(middle), space.jacobians(middle)
    found, bent = list[Feature](), set[str]()
    for i, each in enumerate(features):
        mine = slice(start[i], start[i + 1])
        found.append(_carried(state, each, (old[mine], new[mine]), image[i], slope[i]))
        if places_off(found[i], new[mine]).max() > found[i].gap + rounding_of(state):
            bent.add(each.key)
    places = dict(zip(rows, new, strict=True))
    return CarriedFeatures(tuple(found), frozenset(bent), within, places)


def _carried(
    state: HullState,
    feature: Feature,
    places: tuple[FloatArray, FloatArray],
    centre: FloatArray,
    slope: FloatArray,
) -> Feature:
    """Carry one feature; `centre` and `slope` are image and Jacobian at its centre or begin."""
    new = places[1]
    grown = _ratio(*(float(np.sqrt(((xyz - xyz[0]) ** 2).sum(axis=1).max())) for xyz in places))
    found: dict[str, object] = {}
    if feature.normal is not None:
        normal = _unit(np.linalg.solve(slope.T, np.array(feature.normal)))
        found["normal"] = normal
        if feature.offset is not None:
            found["offset"] = float((normal * centre).sum())
        if feature.radius is not None:
            found["centre"], radius = _circle(state, feature, new, centre, normal)
            found["radius"], grown = radius, radius / feature.radius
    if feature.direction is not None:
        found["direction"] = _unit((slope * np.array(feature.direction)).sum(axis=1))
    gap = rounded_gap(state, feature.gap * grown)
    return attrs.evolve(feature, gap=gap, **found)  # type: ignore[arg-type]


def _circle(
    state: HullState, feature: Feature, xyz: FloatArray, centre: FloatArray, normal: FloatArray
) -> tuple[FloatArray, float]:
    """Give centre and radius of the circle on which the images of points lie, or nearly do."""
    closed, factor = feature.kind == "circle", state.tolerances.factor
    found = fit_circle_in_plane(xyz, normal, closed=closed, factor=factor)
    if found.off <= rounding_of(state) + feature.gap * found.radius / (
        feature.radius or found.radius
    ):
        return found.centre, found.radius
    away = xyz - centre
    return centre, float(np.sqrt(dot(away, away)).mean())


def _ratio(old: float, new: float) -> float:
    return new / old if old > 0.0 else 1.0


def _unit(vector: FloatArray) -> FloatArray:
    found: FloatArray = vector / np.sqrt((vector * vector).sum())
    return found
