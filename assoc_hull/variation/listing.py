"""What may be asked of a parent: present values, admissible intervals, conflicts."""

from __future__ import annotations

import math

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState
from assoc_hull.variation.anchor import Measures
from assoc_hull.variation.anchors import measure_all
from assoc_hull.variation.catalogue import CATALOGUE
from assoc_hull.variation.compose import conflicts
from assoc_hull.variation.layout import Layout
from assoc_hull.variation.limits import hull_box, interval
from assoc_hull.variation.parent import Parent
from assoc_hull.variation.parent_of import parent_of

__all__ = ["Listed", "listing"]


@attrs.frozen
class Listed:
    """A named parameter of one hull.

    Attributes
    ----------
    name, unit, meaning : str
    value : float or None
        Present value; None where the hull has none, for the `reason`.
    low, high : float or None
        Between these (m or degrees) it may be asked for alone, with the usual layout; None
        where nothing ends it.
    conflicts : tuple of str
        Parameters that cannot be asked for beside it.
    reason : str or None
    """

    name: str
    unit: str
    meaning: str
    value: float | None
    low: float | None
    high: float | None
    conflicts: tuple[str, ...]
    reason: str | None

    def __str__(self) -> str:
        if self.value is None:
            return f"{self.name:22} -          {self.reason}"
        low, high = ("" if each is None else f"{each:.4g}" for each in (self.low, self.high))
        between = f"  {low:>6} .. {high:6}"
        apart = f"  not with {', '.join(self.conflicts)}" if self.conflicts else ""
        return f"{self.name:22} {self.value:10.4f} {self.unit:3}{between}  {self.meaning}{apart}"


def listing(state: HullState) -> tuple[Listed, ...]:
    """List all named parameters of a hull.

    Examples
    --------
    >>> from assoc_hull.examples.wigley import wigley
    >>> from assoc_hull.variation.listing import listing
    >>> found = {each.name: each for each in listing(wigley())}
    >>> found["breadth"].value, found["bulb_length"].reason
    (10.0, 'no profile forward of FP below z=6.250')
    """
    found = measure_all(state)
    parent, box = parent_of(state, found), hull_box(state, 0.0)
    return tuple(_listed(name, found, parent, box) for name in CATALOGUE)


def _listed(name: str, found: Measures, parent: Parent, box: FloatArray) -> Listed:
    entry, value, reason = CATALOGUE[name], found.get(name), found.absent.get(name)
    low = high = None
    if value is not None:
        try:
            low, high = (
                each if math.isfinite(each) else None
                for each in interval(parent, name, value, Layout(), box)
            )
        except BadInputError as error:
            value, reason = None, error.what
    return Listed(name, entry.unit, entry.meaning, value, low, high, conflicts(name), reason)
