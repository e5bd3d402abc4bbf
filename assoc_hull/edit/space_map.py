"""A map of space as a transformation uses it, and what it does to features, tunnels and bodies.

Whatever a designer's function does wrong becomes one error that says what, where and how
much; nothing of a hull is touched before all its points have been mapped.

Tunnels and bodies beside the net that a mapping of space carries.

The axis of a tunnel goes with the mapping, its radius stays; a body goes point by point.

Features under a mapping of space: centres, radii, planes and tangents as it sends them.

A circle keeps to a circle only where the mapping is a similarity on it; a run stays straight only
where the mapping does not bend it. The images of their points decide.

Examples
--------
>>> from assoc_hull.edit.space_map import carry_features
>>> from assoc_hull.edit.space_map import space_map
>>> from assoc_hull.shipped.wigley import wigley
>>> twice = space_map(None, None, [2, 2, 2], None)
>>> len(carry_features(wigley(stations=5, waterlines=4), twice, 1e-3).features)
3
"""

from __future__ import annotations

from collections.abc import (
    Callable,
    Iterable,
    Mapping,
    Sequence,
)

import attrs
import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import numbers, shown
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.numeric.vectors import dot
from assoc_hull.geometry.polylines.circular_arcs import fit_circle_in_plane
from assoc_hull.graph.journal import Journal
from assoc_hull.model.attachments import ATTACHMENTS, Attachment
from assoc_hull.model.feature_geometry import places_off, rounded_gap, rounding_of
from assoc_hull.model.features import Feature
from assoc_hull.model.tables import HullState
from assoc_hull.model.tunnel_definition import TunnelDefinition

__all__ = [
    "Affine",
    "CarriedFeatures",
    "Jacobian",
    "PointMapping",
    "SpaceMap",
    "affine",
    "carry_attachments",
    "carry_features",
    "space_map",
]

PointMapping = Callable[[FloatArray], ArrayLike]
"""Takes places (n, 3), m, and gives where they come to, (n, 3), m."""

Jacobian = Callable[[FloatArray], ArrayLike]
"""Takes places (n, 3), m, and gives d M_i / d x_j as (n, 3, 3)."""

_STEP = 1e-3
"""Half the span (m) of a central difference: a map bends over metres, and rounds at 1e-14."""

_LARGEST = 1e6


@attrs.frozen(eq=False)
class Affine:
    """Scaling along the axes about the origin (AP, centre plane, base line), then a shift.

    Attributes
    ----------
    scale : (3,)
        Factors along x, y and z, above 0.
    shift : (3,), m
        Added afterwards; along y zero, as the centre plane stays.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.edit.space_map import affine
    >>> affine([1, 1.1, 1], [0, 0, 0.5])(np.array([[7.0, 2.0, 3.0]])).tolist()
    [[7.0, 2.2, 3.5]]
    """

    scale: FloatArray
    shift: FloatArray

    def __call__(self, xyz: FloatArray) -> FloatArray:
        """Map places, (n, 3), m."""
        moved: FloatArray = xyz * self.scale + self.shift
        return moved

    def jacobian(self, xyz: FloatArray) -> FloatArray:
        """Give the derivatives, (n, 3, 3): the factors."""
        return np.tile(np.eye(3) * self.scale, (len(xyz), 1, 1))


def affine(scale: ArrayLike | None, shift: ArrayLike | None) -> Affine:
    """Take factors and a shift as data.

    Raises
    ------
    BadInputError
        Not one or three factors above 0, or not three lengths.
    """
    where = "in transform"
    factor = numbers(1.0 if scale is None else scale, "scale", where)
    if factor.shape not in ((), (1,), (3,)) or not (factor > 0.0).all():
        remedy = "give one factor above 0, or three along x, y and z"
        raise BadInputError(f"scale is {shown(scale)}", where, remedy)
    offset = numbers(np.zeros(3) if shift is None else shift, "shift", where)
    if offset.shape != (3,):
        raise BadInputError(f"shift is {shown(shift)}", where, "give three lengths, m: x, y and z")
    return Affine(np.broadcast_to(factor, (3,)) + 0.0, offset + 0.0)


@attrs.frozen(eq=False)
class SpaceMap:
    """A mapping with its derivatives.

    Attributes
    ----------
    call : callable
        The mapping.
    slope : callable or None
        Its Jacobian; central differences over +- 1 mm if None.
    moves : (bool, bool, bool)
        Whether it may change x, y and z of any place by a bit.
    """

    call: PointMapping
    slope: Jacobian | None = None
    moves: tuple[bool, bool, bool] = (True, True, True)

    def places(self, xyz: FloatArray) -> FloatArray:
        """Map places, (n, 3), m.

        Raises
        ------
        BadInputError
            The mapping fails, gives another shape, or numbers that are no lengths.
        """
        moved = _checked(self.call, xyz, (len(xyz), 3), "the mapping")
        bad = ~(np.abs(moved) <= _LARGEST).all(axis=1)
        if bad.any():
            raise _unusable("the mapping", xyz[bad][0], moved[bad][0].tolist())
        return moved

    def jacobians(self, xyz: FloatArray) -> FloatArray:
        """Give d M_i / d x_j at places, (n, 3, 3).

        Exactly the unit matrix where no place of the difference moves by a bit.

        Raises
        ------
        BadInputError
            As `places`.
        """
        if not len(xyz):
            return np.zeros((0, 3, 3))
        if self.slope is not None:
            slope = _checked(self.slope, xyz, (len(xyz), 3, 3), "the Jacobian")
            bad = ~np.isfinite(slope).all(axis=(1, 2))
            if bad.any():
                raise _unusable("the Jacobian", xyz[bad][0], slope[bad][0].tolist())
            return slope
        step = np.concatenate([_STEP * np.eye(3), -_STEP * np.eye(3)])
        stencil = (xyz[:, None, :] + step).reshape(-1, 3)
        image = self.places(stencil)
        still = (image == stencil).reshape(len(xyz), -1).all(axis=1)
        image = image.reshape(len(xyz), 2, 3, 3)
        found = np.swapaxes((image[:, 0] - image[:, 1]) / (2.0 * _STEP), 1, 2)
        return np.where(still[:, None, None], np.eye(3), found)

    def bends(self, xyz: FloatArray, along: FloatArray) -> FloatArray:
        """Give the second derivative at places along unit vectors, (n, 3), 1/m.

        Nil where it is lost in the rounding of the difference.
        """
        reach = 100.0 * _STEP
        middle = self.places(xyz)
        sides = self.places(np.concatenate([xyz + reach * along, xyz - reach * along]))
        bend = (sides[: len(xyz)] + sides[len(xyz) :] - 2.0 * middle) / (reach * reach)
        noise = 16.0 * np.finfo(np.float64).eps * (np.abs(xyz).max() + 1.0) / (reach * reach)
        return np.where(np.abs(bend) > noise, bend, 0.0)


def space_map(
    mapping: PointMapping | None,
    jacobian: Jacobian | None,
    scale: ArrayLike | None,
    shift: ArrayLike | None,
) -> SpaceMap:
    """Take a designer's mapping, or factors and a shift instead of one.

    Raises
    ------
    BadInputError
        Neither or both are given.
    """
    if (mapping is None) == (scale is None and shift is None):
        raise BadInputError(
            "neither or both of a mapping and factors", "in transform",
            "give mapping, or scale and shift",
        )  # fmt: skip
    if mapping is not None:
        return SpaceMap(mapping, jacobian)
    linear = affine(scale, shift)
    return SpaceMap(linear, linear.jacobian)


def _checked(
    call: PointMapping | Jacobian, xyz: FloatArray, shape: tuple[int, ...], what: str
) -> FloatArray:
    """Call a designer's function with a copy, and see to the shape of what it gives."""
    try:
        given = np.asarray(call(np.array(xyz)))
        if given.dtype.kind == "c":
            raise BadInputError(
                f"{what} gives numbers of type {given.dtype}", "in transform",
                "give real numbers, m",
            )  # fmt: skip
        found = given.astype(np.float64)
    except AssocHullError:
        raise
    except Exception as error:
        raise BadInputError(
            f"{what} fails: {type(error).__name__}: {error}", "in transform",
            "give a function of an array (n, 3) in m",
        ) from error  # fmt: skip
    if found.shape != shape:
        raise BadInputError(
            f"{what} gives an array {found.shape} for places {xyz.shape}", "in transform",
            f"give {shape}",
        )  # fmt: skip
    return found


def _unusable(what: str, place: FloatArray, found: object) -> BadInputError:
    x, y, z = place.tolist()
    return BadInputError(
        f"{what} gives {found}", f"at ({x:.3f}, {y:.3f}, {z:.3f}) m in transform",
        "give finite numbers of at most 1e6 m",
    )  # fmt: skip


def carry_attachments(state: HullState, journal: Journal, space: SpaceMap) -> list[str]:
    """Carry what a hull holds beside its net; give notes of what moved.

    A mapping is of the port side: what stands to starboard goes as its mirror image does.
    """
    notes = list[str]()
    for kind in ATTACHMENTS:
        was = kind.of(state)[0]
        if not was:
            continue
        points = np.concatenate([each.carriers for each in was])
        side = np.where(points[:, 1] < 0.0, -1.0, 1.0)
        points[:, 1] *= side
        moved = space.places(points)
        moved[:, 1] *= side
        cuts = np.cumsum([len(each.carriers) for each in was])[:-1]
        parts = np.split(moved, cuts)
        found = tuple(each.carried(part) for each, part in zip(was, parts, strict=True))
        if found != was:
            journal.set(kind.of(state), [0], [found])
            pairs = zip(was, found, strict=True)
            notes += _told([(old, new) for old, new in pairs if new != old])
    return notes


def _told(pairs: Sequence[tuple[Attachment, Attachment]]) -> list[str]:
    """Say what moved: each axis of a tunnel with its numbers, bodies by name."""
    notes, bodies = list[str](), list[str]()
    for old, new in pairs:
        if isinstance(old, TunnelDefinition) and isinstance(new, TunnelDefinition):
            notes.append(
                f"the tunnel {new.name!r} went along: x {old.x:.6g} -> {new.x:.6g}, "
                f"z {old.z:.6g} -> {new.z:.6g} m; its radius stays"
            )
        else:
            bodies.append(new.name)
    return notes + ([f"bodies beside the net went along: {', '.join(bodies)}"] if bodies else [])


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
