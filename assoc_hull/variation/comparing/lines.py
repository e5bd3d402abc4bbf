"""The lines of a parent and of a variant, line by line: shift, fairness, points.

Lines are the same if they have one name; of those left over, if they have one key: then the
variant's has been renamed.
"""

from __future__ import annotations

from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.model.address import AddressBook
from assoc_hull.model.state import HullState
from assoc_hull.variation.comparing.line_fairness import (
    FairnessChange,
    LineFairness,
    measure_fairness,
)
from assoc_hull.variation.comparing.line_shift import LineShift, line_shifts

__all__ = ["LineComparison", "compare_lines"]


@attrs.frozen(eq=False)
class LineComparison:
    """A line of a parent, of a variant, or of both.

    Attributes
    ----------
    name : str
        In the variant; of a line that went, in the parent.
    was : str or None
        Its name in the parent; None if it came.
    group : str
        The group it belongs to.
    what : {"same", "moved", "came", "went"}
        Whether it lies where it did (to 1e-6 m), elsewhere, or is in one of both only. A line
        that has no shape in one of them is not there.
    shift : LineShift or None
        Its largest shift; None for a line that is in one only.
    before, after : LineFairness or None
        Changes of sign of its curvature, and comb integral, seen in the parent's planes.
    points : (int, int)
        How many points define it, in parent and variant.
    """

    name: str
    was: str | None
    group: str
    what: str
    shift: LineShift | None
    before: LineFairness | None
    after: LineFairness | None
    points: tuple[int, int]

    @property
    def fairness(self) -> FairnessChange | None:
        """Fairness before and after; None for a line that is in one of both only."""
        if self.before is None or self.after is None:
            return None
        return FairnessChange(self.before, self.after)

    @property
    def length(self) -> float:
        """Its largest shift, m; 0 for a line that is in one of both only."""
        return 0.0 if self.shift is None else self.shift.length

    @property
    def course(self) -> float:
        """Its largest shift beside that of its plane, m; 0 if it is in one of both only."""
        return 0.0 if self.shift is None else self.shift.course

    @property
    def added(self) -> int:
        """Changes of sign of curvature that were added; 0 if it is in one of both only."""
        return 0 if self.fairness is None else self.fairness.added

    @property
    def comb_ratio(self) -> float | None:
        """Comb integral after / before; None without one, or where both are straight."""
        if self.fairness is None or np.isnan(self.fairness.comb_ratio):
            return None
        return self.fairness.comb_ratio


def compare_lines(parent: HullState, variant: HullState) -> tuple[LineComparison, ...]:
    """Compare all lines of two hulls, in the order of the variant; those that went come last.

    Parameters
    ----------
    parent, variant : HullState
        The tables.

    Examples
    --------
    >>> from assoc_hull.shipped.wigley import wigley
    >>> from assoc_hull.variation.comparing.lines import compare_lines
    >>> found = compare_lines(wigley(waterlines=3), wigley(waterlines=5))
    >>> [(each.name, each.what) for each in found if each.was is None]
    [('WL 1.5625', 'came'), ('WL 4.6875', 'came')]
    """
    old, new = _by_name(parent), _by_name(variant)
    both = _pairs(parent, old, variant, new)
    fair_old = measure_fairness(parent, old.values())
    views = {
        _key(variant, new[name]): fair_old[_key(parent, old[was])] for name, was in both.items()
    }
    fair_new = measure_fairness(variant, new.values(), like=views)
    shifts = line_shifts(parent, variant, [(old[was], new[name]) for name, was in both.items()])
    shift = dict(zip(both, shifts, strict=True))
    there = _Side(parent, old, fair_old)
    here = _Side(variant, new, fair_new)
    gone = [was for was in old if was not in set(both.values())]
    return (
        *(_line(name, both.get(name), shift.get(name), there, here) for name in new),
        *(_line(None, was, None, there, here) for was in gone),
    )


@attrs.frozen(eq=False)
class _Side:
    """One of two hulls: its tables, the numbers of its lines by name, their fairness by key."""

    state: HullState
    lines: Mapping[str, int]
    fairness: Mapping[str, LineFairness]

    def points(self, name: str | None) -> int:
        """Count the points that define a line."""
        if name is None:
            return 0
        rows = [self.state.curves.rows.data[c] for c in self.state.curves_of(self.lines[name])]
        return len(np.unique(np.concatenate(rows)))

    def fair(self, name: str | None) -> LineFairness | None:
        return None if name is None else self.fairness[_key(self.state, self.lines[name])]

    def group(self, name: str) -> str:
        group = int(self.state.lines.group.data[self.lines[name]])
        return str(self.state.groups.name.data[group])


def _line(
    name: str | None, was: str | None, shift: LineShift | None, there: _Side, here: _Side
) -> LineComparison:
    """Put together what is known of a line; at least one of its names is given."""
    title, side = (str(was), there) if name is None else (name, here)
    if shift is None:
        what = "went" if name is None else "came"
    else:
        what = "moved" if shift.moved else "same"
    return LineComparison(
        title, was, side.group(title), what, shift, there.fair(was), here.fair(name),
        (there.points(was), here.points(name)),
    )  # fmt: skip


def _by_name(state: HullState) -> dict[str, int]:
    """Give the lines that have a shape, by name."""
    book = AddressBook(state)
    live = state.live("lines").tolist()
    return {book.line_name(line): line for line in live if state.curves_of(line)}


def _key(state: HullState, line: int) -> str:
    return str(state.lines.key.data[line])


def _pairs(
    parent: HullState, old: Mapping[str, int], variant: HullState, new: Mapping[str, int]
) -> dict[str, str]:
    """Give for lines of the variant the name that they have in the parent."""
    left = {_key(parent, line): name for name, line in old.items() if name not in new}
    found = {}
    for name, line in new.items():
        was = name if name in old else left.get(_key(variant, line))
        if was is not None:
            found[name] = was
    return found
