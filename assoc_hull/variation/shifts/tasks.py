"""What a shift is to do: two changes that are asked for, and the sizes that give them."""

from __future__ import annotations

from typing import Protocol

import attrs

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.shifts.elements import Elements
from assoc_hull.variation.shifts.sums import Sums

__all__ = ["Bodies", "Task", "Whole"]


class Task(Protocol):
    """Two changes that are to be had together.

    `changes` are what is asked for, `words` says of each what it is a change of, with its unit.
    """

    @property
    def changes(self) -> tuple[float, float]:
        """What is asked for."""
        ...

    @property
    def words(self) -> tuple[str, str]:
        """Unit and quantity of each, as in "a change of 0.02 in CB"."""
        ...

    def sizes(self, changes: tuple[float, float]) -> FloatArray | None:
        """Give c_f and c_a, (2,), m, for changes; None where there are none."""
        ...


@attrs.frozen(eq=False)
class Whole:
    """A change of the volume of the whole hull, and of its centre.

    Attributes
    ----------
    elements, sums
        Of the curve of areas.
    block : float, m3
        L B T.
    length : float, m
        L.
    cb : float
        By how much the block coefficient is to change.
    lcb : float, % of L
        By how much the centre is to move, + forward.

    Examples
    --------
    >>> from assoc_hull.variation.shifts.elements import Elements
    >>> from assoc_hull.variation.shifts.sums import Sums
    >>> from assoc_hull.variation.shifts.tasks import Whole
    >>> from assoc_hull.variation.shifts.shift_terms import ShiftTerms, Terminals
    >>> terms = ShiftTerms(Terminals(0.0, 5.0, 5.0, 10.0), "lackenby")
    >>> curve = Elements.of(lambda x: x * (10.0 - x), terms.nodes, 5.0)
    >>> task = Whole(curve, Sums.of(curve, terms), 250.0, 10.0, cb=0.02, lcb=0.0)
    >>> task.sizes(task.changes).round(9).tolist()
    [0.6, -0.6]
    """

    elements: Elements
    sums: Sums
    block: float
    length: float
    cb: float
    lcb: float

    @property
    def changes(self) -> tuple[float, float]:
        """Of CB, and of LCB in % of L."""
        return self.cb, self.lcb

    @property
    def words(self) -> tuple[str, str]:
        """What they change."""
        return "in CB", "% Lpp in LCB"

    def sizes(self, changes: tuple[float, float]) -> FloatArray | None:
        """Give c_f and c_a, (2,), m."""
        volume = self.elements.total + changes[0] * self.block
        centre = self.elements.moment / self.elements.total + 0.01 * changes[1] * self.length
        return self.sums.whole(volume, centre * volume)


@attrs.frozen(eq=False)
class Bodies:
    """Changes of the volumes of fore and after body, each on its own.

    Attributes
    ----------
    elements, sums
        Of the curve of areas.
    prism : float, m3
        Area of the largest section times L / 2.
    fore, aft : float
        By how much the prismatic coefficients of the bodies are to change.
    """

    elements: Elements
    sums: Sums
    prism: float
    fore: float
    aft: float

    @property
    def changes(self) -> tuple[float, float]:
        """Of the prismatic coefficients of fore and after body."""
        return self.fore, self.aft

    @property
    def words(self) -> tuple[str, str]:
        """What they change."""
        return "in CP of the fore body", "in CP of the after body"

    def sizes(self, changes: tuple[float, float]) -> FloatArray | None:
        """Give c_f and c_a, (2,), m."""
        fore, aft = changes
        bodies = self.elements.bodies.copy()
        bodies[0] += fore * self.prism
        bodies[1] += aft * self.prism
        return self.sums.each(bodies)
