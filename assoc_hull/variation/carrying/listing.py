"""What may be asked of a parent: present values, admissible intervals, conflicts."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import attrs

from assoc_hull.errors import BadInputError
from assoc_hull.model.state import HullState
from assoc_hull.variation.ask import TOLERANCE
from assoc_hull.variation.carrying.room import Room
from assoc_hull.variation.parameters.anchor import Measures
from assoc_hull.variation.parameters.catalogue import CATALOGUE
from assoc_hull.variation.parameters.compose_map import conflicts
from assoc_hull.variation.parameters.layout import Layout
from assoc_hull.variation.parameters.limits import hull_box, present
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.parameters.read_parent import parent_of

__all__ = ["Listed", "list_table", "listing"]

_DIGITS = 4
"""Of the ends of intervals, which are rounded inward."""

_HEAD = ("parameter", "present", "", "from", "to", "what it is")
_FOOT = """\
x from AP forward, z from the base line up. Each interval is that of the parameter asked for alone:
beyond it the map folds, a round end cannot be made anew, or what comes out is no ship. Towards its
ends a line of the net may still be refused, with its name and the place."""


@attrs.frozen
class Listed:
    """A named parameter of one hull.

    Attributes
    ----------
    name, unit, meaning : str
    value : float or None
        Present value; None where the hull has none, for the `reason`.
    low, high : float or None
        Between these (m or degrees) it may be asked for alone; None where nothing ends it.
    conflicts : tuple of str
        Parameters that cannot be asked for beside it.
    reason : str or None
        Why it has no value, or cannot be varied.
    """

    name: str
    unit: str
    meaning: str
    value: float | None
    low: float | None
    high: float | None
    conflicts: tuple[str, ...]
    reason: str | None

    @property
    def words(self) -> tuple[str, ...]:
        """What a table says of it, in columns."""
        if self.value is None:
            return self.name, "-", "", "", "", str(self.reason)
        now = f"{self.value:.4f}"
        if self.reason is not None:
            return self.name, now, self.unit, "", "", self.reason
        apart = f"; not with {' or '.join(self.conflicts)}" if self.conflicts else ""
        return (
            self.name, now, self.unit, self._low, _end(self.high, math.floor), self.meaning + apart
        )  # fmt: skip

    @property
    def _low(self) -> str:
        nil = self.low == 0.0 and CATALOGUE[self.name].positive
        return "> 0" if nil else _end(self.low, math.ceil)


def list_table(found: Sequence[Listed]) -> str:
    """Give parameters as a table in text, with a head and a word on how to read it.

    Examples
    --------
    >>> from assoc_hull.variation.carrying.listing import list_table, Listed
    >>> shaft = Listed("shaft_height", "m", "height", 5.0, 2.71649, 11.55896, (), None)
    >>> for row in list_table([shaft]).splitlines()[:2]:
    ...     print(row)
    parameter     present      from     to  what it is
    shaft_height   5.0000  m  2.717  11.55  height
    """
    rows = [_HEAD, *(each.words for each in found)]
    wide = [max(len(row[k]) for row in rows) for k in range(len(_HEAD) - 1)]
    lines = []
    for row in rows:
        name, *numbers, last = row
        cells = [name.ljust(wide[0])]
        cells += [each.rjust(room) for each, room in zip(numbers, wide[1:], strict=True)]
        lines.append("  ".join([*cells, last]))
    return "\n".join([*lines, _FOOT])


def _end(value: float | None, inward: Callable[[float], int]) -> str:
    """Give an end of an interval, rounded inward."""
    if value is None:
        return "any"
    whole = math.floor(math.log10(abs(value))) if value else 0
    scale = 10.0 ** (_DIGITS - 1 - whole)
    return f"{inward(value * scale) / scale:.{_DIGITS}g}"


def listing(state: HullState, layout: Layout | None = None) -> tuple[Listed, ...]:
    """List all named parameters of a hull.

    Parameters
    ----------
    state : HullState
        The tables.
    layout : Layout or None
        How far the fields reach, on which intervals depend; None for the usual reaches.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.carrying.listing import listing
    >>> found = {each.name: each for each in listing(wigley())}
    >>> found["breadth"].value, found["bulb_length"].reason
    (10.0, 'no profile forward of FP below z=6.250')
    """
    given = layout or Layout()
    found = measure_all(state)
    # the box in which a variation is certified
    parent, box = parent_of(state, found), hull_box(state, TOLERANCE)
    room = Room(state, parent, present(found, given), given, box)
    return tuple(_listed(name, found, room) for name in CATALOGUE)


def _listed(name: str, found: Measures, room: Room) -> Listed:
    entry, reason = CATALOGUE[name], found.absent.get(name)
    value = room.present.get(name)
    low = high = None
    if value is None:
        reason = reason or "the deck edge does not reach there"
    else:
        try:
            low, high = (each if math.isfinite(each) else None for each in room.interval(name))
        except BadInputError as error:
            reason = f"cannot be varied: {error.what.partition(': ')[2]}"
    return Listed(
        name, entry.unit, entry.meaning, value, low, high, conflicts(name, room.layout), reason
    )
