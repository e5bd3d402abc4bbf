"""Features as a designer sees them: name, kind, numbers, and the points and lines as handles.

Examples
--------
>>> from assoc_hull.shipped.wigley import wigley
>>> from assoc_hull.model.feature_handle import features_by_name
>>> features_by_name(wigley(stations=5, waterlines=4))["ST 2 straight"]
<straight ST 2 straight, 2 points>
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping

import attrs

from assoc_hull.model.feature_geometry import line_numbers
from assoc_hull.model.features import Feature, Place
from assoc_hull.model.line import Line
from assoc_hull.model.named_mapping import Named
from assoc_hull.model.point import Point
from assoc_hull.model.state import HullState

__all__ = ["FeatureHandle", "features_by_name"]


@attrs.frozen(repr=False)
class FeatureHandle:
    """A feature as it was when it was asked for.

    Attributes
    ----------
    tables : HullState
        The tables of the hull.
    feature : Feature
        What the tables hold.
    """

    tables: HullState
    feature: Feature

    @property
    def id(self) -> str:
        """Its key, which outlives renaming."""
        return self.feature.key

    @property
    def name(self) -> str:
        """What it is called."""
        return self.feature.name

    @property
    def kind(self) -> str:
        """``"circle"``, ``"arc"``, ``"flat"``, ``"straight"``, ``"knuckle"`` or ``"tangent"``."""
        return self.feature.kind

    @property
    def parameters(self) -> Mapping[str, float | Place]:
        """What its kind has, lengths in m: `assoc_hull.model.features.PARAMETERS` lists it."""
        return self.feature.parameters

    @property
    def side(self) -> int:
        """Where centre or region lie, seen against the normal: 1 left of its points, -1 right."""
        return self.feature.side

    @property
    def gap(self) -> float:
        """How far the farthest of its points lay off it when it was found, m."""
        return self.feature.gap

    @property
    def lines(self) -> tuple[Line, ...]:
        """The lines that it lies on."""
        numbers = line_numbers(self.tables)
        return tuple(Line.of(self.tables, numbers[key]) for key in self.feature.lines)

    @property
    def points(self) -> tuple[Point, ...]:
        """The points that it owns, in order along its line, on the curve that they lie on there."""
        table, mine = self.tables.rows, set(self.feature.lines)
        found = []
        for row in self.feature.points:
            first = int(table.curve.data[row, 0])
            side = 0 if self.tables.lines.key.data[self.tables.line_of(first)] in mine else 1
            found.append(Point(self.tables, row, str(table.key.data[row]), side))
        return tuple(found)

    def __repr__(self) -> str:
        return f"<{self.kind} {self.name}, {len(self.feature.points)} points>"


def features_by_name(state: HullState) -> Named[FeatureHandle]:
    """Give the features of a hull by name, in the order of their keys.

    One whose name features of two lines have is found by group and name, as such lines are.
    """
    features = state.features
    count = Counter(each.name for each in features)
    title = {
        state.lines.key.data[line]: state.groups.name.data[int(state.lines.group.data[line])]
        for line in state.live("lines").tolist()
    }
    return Named(
        "feature",
        {
            each.name if count[each.name] < 2 else f"{title[each.lines[0]]}/{each.name}":
            FeatureHandle(state, each)
            for each in features
        },
    )  # fmt: skip
