"""Returning lines to the definitions: what was drawn by hand gives way, at the designer's wish.

Examples
--------
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.edit.session import Edit
>>> from assoc_hull.shipped.wigley import wigley
>>> with Edit(Document(wigley()), "back") as edit:
...     edit.reattach("ST 7")
Traceback (most recent call last):
...
assoc_hull.errors.BadInputError: the hull has no definitions, in reattach; ...
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.attachable import attachable
from assoc_hull.edit.modifications.drive_others import drive_others
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.address import address
from assoc_hull.model.definition_part import GeneratedCurve
from assoc_hull.model.kinds import Sort
from assoc_hull.model.state import HullState

__all__ = ["reattach"]


def reattach(edit: Transaction, line: int) -> None:
    """Let the points of a line come from the definitions again when the edit ends.

    Parameters
    ----------
    edit : Transaction
        The edit.
    line : int
        A line that was detached, or a section that was cut by hand.

    Raises
    ------
    BadInputError
        The hull has no definitions, none makes such a line, or a point was placed on it that
        the definitions know nothing of.
    """
    state = edit.state
    name = str(state.lines.name.data[line])
    if not state.definitions:
        what = "the hull has no definitions"
        raise BadInputError(what, "in reattach", "make it of definitions: see ah.create")
    found = attachable(state, line)
    if not found:
        raise BadInputError(
            f"no definition makes {name}", "in reattach",
            "sections, and the lines that came from definitions, can return to them",
        )  # fmt: skip
    if all(made.attached for made in found):
        edit.pending.notes.append(f"{name} comes from the definitions already")
        return
    for made in found:
        _refuse_others(state, made)
        edit.refuse_moved(np.array(made.rows, np.int64))
    for made in found:
        drive_others(edit, made.curve)
    edit.pending.attach.add(line)
    edit.pending.structural = True


def _refuse_others(state: HullState, made: GeneratedCurve) -> None:
    """Refuse where a point defines the curve that the definitions know nothing of."""
    rows: IntArray = state.curves.rows.data[made.curve]
    if made.what == "waterline":
        return
    for row in rows[1:-1].tolist():
        if row in made.rows:
            continue
        sort = Sort(int(state.rows.sort.data[row]))
        if sort is Sort.PLACED:
            raise BadInputError(
                f"{address(state, row)} was placed there", "in reattach",
                "delete it or unpin it first: a definition never writes over a placed point",
            )  # fmt: skip
        if sort is Sort.CROSSING and made.rows:
            raise BadInputError(
                f"{address(state, row)} defines the line", "in reattach",
                "give the crossing another role first",
            )  # fmt: skip
