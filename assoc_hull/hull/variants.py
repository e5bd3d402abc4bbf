"""A hull that a variation, a section shift or a jumboising has made, with its report.

All are generic in the class of the hulls that they hold, as they stand below it; users meet them
with `assoc_hull.Hull` only. They stand alone: a variation needs none of what `results` loads.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, TypeVar

import attrs

from assoc_hull.display import ShownAsText

if TYPE_CHECKING:
    from assoc_hull.variation.fields.space_map import VariationMap
    from assoc_hull.variation.jumboise_hull import JumboiseReport
    from assoc_hull.variation.shifts.shift_hull import ShiftReport
    from assoc_hull.variation.vary import VariationReport

__all__ = ["Jumboised", "Shifted", "Variation"]

HullType = TypeVar("HullType")


@attrs.frozen(eq=False, repr=False)
class Jumboised(ShownAsText, Generic[HullType]):
    """A hull with a longer or shorter parallel body.

    Attributes
    ----------
    hull : Hull
        The variant; undo gives the parent back.
    report : JumboiseReport
        What was inserted or taken out.
    """

    hull: HullType
    report: JumboiseReport

    def __str__(self) -> str:
        return str(self.report)


@attrs.frozen(eq=False, repr=False)
class Variation(ShownAsText, Generic[HullType]):
    """A varied hull.

    Attributes
    ----------
    hull : Hull
        The variant; undo gives the parent back.
    report : VariationReport
        What was asked, reached and changed.
    map : VariationMap
        The map that carries places of the parent to those of the variant, m.
    """

    hull: HullType
    report: VariationReport
    map: VariationMap

    def __str__(self) -> str:
        return str(self.report)


@attrs.frozen(eq=False, repr=False)
class Shifted(ShownAsText, Generic[HullType]):
    """A hull whose sections were shifted, or that was swung.

    Attributes
    ----------
    hull : Hull
        The variant; undo gives the parent back.
    report : ShiftReport
        What was asked, reached and moved.
    map : VariationMap
        The map that carries places of the parent to those of the variant, m.
    """

    hull: HullType
    report: ShiftReport
    map: VariationMap

    def __str__(self) -> str:
        return str(self.report)
