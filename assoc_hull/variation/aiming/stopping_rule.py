"""When aiming is done."""

from __future__ import annotations

import attrs

from assoc_hull.variation.aiming.kkt_conditions import unbalanced
from assoc_hull.variation.aiming.scaled_problem import Iterate

__all__ = ["StoppingRule"]

_SPARE = 0.1
"""Rules are kept with this part of what they allow, unless rounding is in the way."""


@attrs.frozen
class StoppingRule:
    """When a walk ends.

    Attributes
    ----------
    residual : float
        Targets are met where no scaled miss is larger.
    kkt : float
        The change is the least where it is out of balance by no more, times itself where
        that is below 1.
    steps : int
        So many at most.
    least : bool
        Whether the change is to be the least; else steps are as short as they can be.
    """

    residual: float = 1e-10
    kkt: float = 1e-6
    steps: int = 40
    least: bool = True

    def met(self, place: Iterate) -> bool:
        """Tell whether targets are met."""
        return place.worst <= self.residual

    def left(self, place: Iterate) -> tuple[bool, bool]:
        """Tell what is left to do: targets, which are met with something to spare; the change."""
        limit = max(self.kkt * min(1.0, place.change), _SPARE * self.kkt)
        far = place.worst > _SPARE * self.residual
        return far, self.least and (far or unbalanced(place) > limit)
