"""The numbers of a map in two flat arrays: layers, bilge arcs and circles.

`compiled_map` reads them; how layers stand there is `variation.fields.flat_layers`. A map of which
a part has no flat form stays with numpy.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs

from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.variation.features.redrawn_bilges import CURVE, BilgeArc, BilgeFillet
from assoc_hull.variation.features.redrawn_circles import JOIN, RedrawnCircle
from assoc_hull.variation.fields.bounded_functions import BlendChain
from assoc_hull.variation.fields.flat_layers import FlatSheet, UnknownKindError
from assoc_hull.variation.fields.layers import Layer

__all__ = ["FlatMap"]


@attrs.frozen(eq=False)
class FlatMap:
    """A map in flat arrays.

    Attributes
    ----------
    code : (k,) int
        First the numbers of layers, of arcs and of circles, each followed by where the table
        begins that tells where they stand; then the largest number of boundaries of a field.
    number : (m,)
        Lengths (m), angles (radians) and factors.
    arcs, circles : bool
        Whether there are any.

    Examples
    --------
    >>> from assoc_hull.variation.features.flat_map import FlatMap
    >>> FlatMap.of(()).code.tolist()
    [0, 7, 0, 7, 0, 7, 0]
    """

    code: IntArray
    number: FloatArray
    arcs: bool = False
    circles: bool = False

    @classmethod
    def of(
        cls,
        layers: Sequence[Layer],
        arcs: Sequence[tuple[BilgeArc, BlendChain]] = (),
        circles: Sequence[RedrawnCircle] = (),
    ) -> FlatMap | None:
        """Lay out a map; None where something is of no known kind.

        Parameters
        ----------
        layers : sequence of Layer
            In the order in which they act.
        arcs : sequence of (BilgeArc, BlendChain)
            Bilges that are drawn again after them, and how much each counts along the ship.
        circles : sequence of RedrawnCircle
            Circles that are drawn again after that.
        """
        sheet = _Sheet()
        try:
            places = (
                [sheet.layer(each) for each in layers],
                [sheet.arc(arc, share) for arc, share in arcs],
                [sheet.circle(each) for each in circles],
            )
        except UnknownKindError:
            return None
        for k, table in enumerate(places):
            sheet.table(k, table)
        code, number = sheet.arrays()
        return cls(code, number, len(arcs) > 0, len(circles) > 0)


@attrs.frozen(eq=False)
class _Sheet(FlatSheet):
    """With what features need besides layers."""

    def arc(self, arc: BilgeArc, share: BlendChain) -> int:
        """Put a bilge arc: its share, and the numbers of both circles."""
        old, new = arc.before, arc.after
        down = (old.floor - [old.y, old.z]) / old.radius
        below, beside = down.tolist()
        return self.put(
            (self.function(share),),
            (arc.x, *_fillet(old), *_fillet(new), *arc.reach, below, beside, CURVE * old.radius),
        )

    def circle(self, circle: RedrawnCircle) -> int:
        """Put a circle: whether the map itself makes it, and its numbers before and after."""
        old, new = circle.before, circle.after
        numbers = (
            *old.centre.tolist(), *old.normal.tolist(), old.radius, *new.centre.tolist(),
            new.radius, circle.gap, JOIN * old.radius,
        )  # fmt: skip
        return self.put((int(circle.carried),), numbers)


def _fillet(arc: BilgeFillet) -> tuple[float, ...]:
    """Give centre, radius, angle at the floor, its product with the radius, and both ends."""
    first = arc.first
    ends = *arc.floor.tolist(), *arc.side.tolist()
    return (arc.y, arc.z, arc.radius, first, first * arc.radius, *ends)
