"""Which curves of a line may come from definitions."""

from __future__ import annotations

from assoc_hull.model.definition_part import GeneratedCurve
from assoc_hull.model.state import HullState

__all__ = ["attachable"]


def attachable(state: HullState, line: int) -> list[GeneratedCurve]:
    """Give what comes, came or may come from definitions on a line.

    Examples
    --------
    >>> from assoc_hull.edit.followup.attachable import attachable
    >>> from assoc_hull.shipped.wigley import wigley
    >>> attachable(wigley(stations=5, waterlines=4), 0)
    []
    """
    curves = [c for c in state.lines.curves.data[line] if state.curves.alive.data[c]]
    known = {each.curve: each for each in state.generated}
    found = [known[curve] for curve in curves if curve in known]
    if found or not _is_section(state, line):
        return found
    keys = state.curves.key.data
    return [GeneratedCurve(str(keys[c]), c, "section", "", (), (), attached=False) for c in curves]


def _is_section(state: HullState, line: int) -> bool:
    """Tell whether a line is a section like those that are generated."""
    groups = {
        int(state.lines.group.data[state.line_of(each.curve)])
        for each in state.generated
        if each.what == "section"
    }
    return int(state.lines.group.data[line]) in groups
