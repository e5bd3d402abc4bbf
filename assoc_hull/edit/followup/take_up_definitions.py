"""What an edit asks of definitions is taken up before its update runs.

New values go into the tables; curves that were edited by hand are detached; lines that are to
come from definitions again are made so; and curves whose pieces become others get other points.
What remains is done by the update: each point that a definition gives is evaluated.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.detach_curves import detach, edited, tidy
from assoc_hull.edit.followup.generated_curves import (
    attachable_curves,
    layout_now,
    recipe_for,
    remake_points,
)
from assoc_hull.edit.pending_changes import Pending
from assoc_hull.edit.report import FormChange
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.form_definition import GeneratedCurve
from assoc_hull.model.forms.line_layout import layout_at
from assoc_hull.model.generated_curves import forms_of, line_offset
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["form_changes", "take_up_forms"]


def take_up_forms(state: HullState, journal: Journal, pending: Pending) -> IntArray:
    """Carry out what is asked of definitions, but for the evaluation.

    Parameters
    ----------
    state : HullState
        The tables; places that are asked for are not in them yet.
    journal : Journal
        Takes every write.
    pending : Pending
        What is asked for; curves that were detached or made anew are noted in it.

    Returns
    -------
    (k,) int
        Nodes of the definitions with other values.

    Raises
    ------
    AssocHullError
        A line cannot be made of the definitions.
    """
    maker = Maker(state, journal)
    if not state.definitions and not state.generated:
        return np.zeros(0, np.int64)
    left = edited(state, journal, pending)
    _refuse_both(state, pending, left)
    detach(maker, pending, left)
    nodes = _write(maker, pending)
    made = [each for line in sorted(pending.attach) for each in attachable_curves(state, line)]
    _remake(maker, pending, [*made, *(_other_pieces(state) if pending.forms else ())])
    if pending.structural:
        tidy(maker)
    return nodes


def _refuse_both(state: HullState, pending: Pending, left: set[int]) -> None:
    asked = {int(state.rows.curve[row, 0]) for row in pending.values}
    for curve in sorted(left | asked | {each for _, each in pending.by_hand if each >= 0}):
        line = state.line_of(curve)
        if line in pending.attach:
            raise BadInputError(
                "a line is edited by hand and returned to its definitions in one edit",
                f"at {state.lines.name[line]}", "use two edits",
            )  # fmt: skip


def _write(maker: Maker, pending: Pending) -> IntArray:
    """Write definitions with other values; give their nodes."""
    state, table = maker.state, maker.state.formed
    maker.definitions([pending.forms.get(each.use, each) for each in state.definitions])
    numbers = [n for n in state.live("formed").tolist()
               if table.definition[n].use in pending.forms]  # fmt: skip
    return Node.form(np.array(numbers, np.int64))


def _other_pieces(state: HullState) -> list[GeneratedCurve]:
    """Give attached curves that come of other pieces now; no section may come in more or fewer."""
    for made in state.generated:
        if made.attached and made.what == "section":
            _refuse_other_number(state, made)
    return [
        made for made in state.generated if made.attached and layout_now(state, made) != made.layout
    ]


def _refuse_other_number(state: HullState, made: GeneratedCurve) -> None:
    """Refuse where a bulb comes to close at a section, or closes there no more."""
    line = state.line_of(made.curve)
    curves = [each for each in state.lines.curves[line] if state.curves.alive[each]]
    if curves.index(made.curve) + 1 < len(curves):
        return
    try:
        layout_at(forms_of(state), made.what, line_offset(state, made.curve), 1)
    except BadInputError:
        number = 1
    else:
        number = 2
    if number != len(curves):
        raise BadInputError(
            f"{state.lines.name[line]} would come in {number} curves instead of {len(curves)}",
            "in set_form", "remove the line first, and cut it again afterwards",
        )  # fmt: skip


def _remake(maker: Maker, pending: Pending, curves: list[GeneratedCurve]) -> None:
    """Give curves the points of their pieces."""
    state = maker.state
    done: dict[str, GeneratedCurve] = {}
    for made in curves:
        if made.key not in done:
            done[made.key] = remake_points(
                maker, made, recipe_for(state, made, layout_now(state, made))
            )
    if done:
        known = {each.key: each for each in state.generated}
        maker.generated((known | done).values())
        pending.curves |= {each.curve for each in done.values()}
        pending.structural = True


def form_changes(state: HullState, journal: Journal) -> tuple[FormChange, ...]:
    """Tell which values of definitions an edit changed, by definition and value."""
    column = state.formed.definition
    if not any(column is each for each in journal.columns()):
        return ()
    net, (before, _) = journal.net(column), journal.sizes(state.formed)
    found = [
        (new.name, name, old.values.get(name), value)
        for row, old, new in zip(net.rows.tolist(), net.old, net.new, strict=True)
        if row < before  # a new row held nothing before
        for name, value in new.values.items()
        if value != old.values.get(name)
    ]
    return tuple(sorted(found, key=lambda each: each[:2]))
