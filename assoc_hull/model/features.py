"""Features: circles, arcs, flats, straight runs, knuckle lines and tangent joins of a hull.

A feature is what a designer draws on purpose and a smooth mapping would blur: the round end of
a bossing, the bilge circle, the flat of side. It owns points of its host line, in order, and
knows the exact shape they lie on. The points stay what defines the curves; the feature says
what they are together, so that whoever varies a hull can make it anew.

Examples
--------
>>> from assoc_hull.model.features import Feature
>>> boss = Feature(
...     key="boundary:bossing end circle", kind="circle", name="bossing end",
...     lines=("boundary:bossing end",), points=(4, 7, 9), centre=(6, 0, 5), radius=0.725,
...     normal=(1, 0, 0), side=1,
... )
>>> boss.parameters["radius"], boss.parameters["centre"]
(0.725, (6.0, 0.0, 5.0))
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import attrs
import numpy as np

from assoc_hull.arguments import choice, integer, not_negative, number, place, positive, text
from assoc_hull.errors import BadInputError

__all__ = ["FEATURE_KINDS", "FEATURE_LEAST", "PARAMETERS", "Feature", "Place"]

Place = tuple[float, float, float]

_WHERE = "in a feature"

PARAMETERS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "circle": ("centre", "radius", "normal"),
        "arc": ("centre", "radius", "normal"),
        "flat": ("normal", "offset"),
        "straight": (),
        "knuckle": (),
        "tangent": ("direction",),
    }
)
"""By kind: what a feature of it has besides its points."""

FEATURE_KINDS = tuple(PARAMETERS)
"""The kinds: a circle about the centre plane, an arc between two places, a plane region with its
edge, a straight run between two ends, a knuckle line, a join along a given tangent."""

FEATURE_LEAST: Mapping[str, int] = MappingProxyType(
    {"circle": 3, "arc": 3, "flat": 2, "straight": 2, "knuckle": 1, "tangent": 1}
)
"""By kind: so many points a feature has at least."""


def _place(value: Sequence[float] | None) -> Place | None:
    """Take a place or a vector as plain floats; 0.0 stands for -0.0."""
    if value is None:
        return None
    x, y, z = (place(value, "a vector", _WHERE) + 0.0).tolist()
    return x, y, z


def _real(value: float | None) -> float | None:
    return None if value is None else number(value, "a number", _WHERE) + 0.0


def _words(values: Sequence[str]) -> tuple[str, ...]:
    return tuple(values)


def _rows(values: Sequence[int]) -> tuple[int, ...]:
    return tuple(np.asarray(values, np.int64).ravel().tolist())


@attrs.frozen
class Feature:
    """A feature of a hull.

    Attributes
    ----------
    key : str
        Identity, made of the host line, the kind and the first place; it outlives renaming.
    kind : str
        One of `FEATURE_KINDS`.
    name : str
        What it is called; no two features of one line have one name.
    lines : tuple of str
        Keys of the lines that it lies on.
    points : tuple of int
        Row numbers of the points that it owns, in order along the line. Keys stand for them in
        a definition. The first and the last are the ends.
    centre : (3,), m, or None
        Of a circle or an arc.
    radius : float, m, or None
        Of a circle or an arc.
    normal : (3,) or None
        Unit normal of the plane in which a circle, an arc or a flat lies.
    offset : float, m, or None
        normal . place on the plane of a flat.
    direction : (3,) or None
        Unit tangent at a tangent join, along the curve.
    side : int
        On which side of its points, followed in their order and seen against the normal, the
        centre of a circle or the region of a flat lies: 1 to the left, -1 to the right; 0 where
        there is none.
    gap : float, m
        How far the farthest of its points lies off it where it was found; 0 for one that is met
        to rounding.
    """

    key: str
    kind: str
    name: str
    lines: tuple[str, ...] = attrs.field(converter=_words)
    points: tuple[int, ...] = attrs.field(converter=_rows)
    centre: Place | None = attrs.field(default=None, converter=_place)
    radius: float | None = attrs.field(default=None, converter=_real)
    normal: Place | None = attrs.field(default=None, converter=_place)
    offset: float | None = attrs.field(default=None, converter=_real)
    direction: Place | None = attrs.field(default=None, converter=_place)
    side: int = 0
    gap: float = 0.0

    def __attrs_post_init__(self) -> None:
        for name in ("key", "name"):
            text(getattr(self, name), name, _WHERE)
        where = f"in the feature {self.name!r}"
        choice(self.kind, "kind", FEATURE_KINDS, where)
        integer(self.side, "side", where, least=-1, most=1)
        not_negative(self.gap, "gap", where)
        if self.radius is not None:
            positive(self.radius, "radius", where)
        wanted, given = set(PARAMETERS[self.kind]), set(self.parameters)
        if wanted != given:
            what = f"{', '.join(sorted(wanted ^ given))} missing or not of a {self.kind}"
            raise BadInputError(what, where, f"give {', '.join(sorted(wanted)) or 'none'}")
        if len(self.points) < FEATURE_LEAST[self.kind]:
            what = f"{len(self.points)} points of a {self.kind}"
            raise BadInputError(what, where, f"give {FEATURE_LEAST[self.kind]} or more")
        if not self.lines:
            raise BadInputError("no line", where, "name the line that it lies on")

    @property
    def parameters(self) -> Mapping[str, float | Place]:
        """What its kind has besides points, by name; lengths in m."""
        found = {
            name: getattr(self, name)
            for name in ("centre", "radius", "normal", "offset", "direction")
        }
        return MappingProxyType({name: v for name, v in found.items() if v is not None})
