"""What an edit asks of definitions: most of it is taken up before its update runs.

New values go into the tables; curves that were edited by hand are detached; lines that are to
come from definitions again are made so; and curves whose pieces become others get other points.
What remains is done by the update: each point that a definition gives is evaluated. Then lines are
put in order on which crossings have passed one another, and generated curves get the points that
they have come to need.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import WideGaps
from assoc_hull.edit.followup.detach_curves import (
    detach,
    detached_note,
    edited,
    off_definitions,
    tidy,
)
from assoc_hull.edit.followup.generated_curves import (
    attachable_curves,
    layout_now,
    recipe_for,
    remake_points,
)
from assoc_hull.edit.followup.reorder_crossings import limit_watched, renew_followers, widen_limits
from assoc_hull.edit.modification import ROUNDS, Modification, Pending, Work
from assoc_hull.edit.report import FormChange
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.forms.generate_points import marks_suffice
from assoc_hull.model.forms.line_layout import layout_at
from assoc_hull.model.generated_curves import attached_curves, end_points, forms_of, line_offset
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.node import Node
from assoc_hull.model.tables import HullState

__all__ = ["DefinitionValues", "form_changes"]

# --------------------------------------------------------------------------------------
# Generated curves that have come to need more points get them, in a second pass.
#
# A definition that bends a section more sharply leaves the spline through the old points too far
# off, or its area. Marks are only added: what reads a point never loses it so.


def refine_forms(work: Work, curves: IntArray) -> list[int]:
    """Give more points to those of some curves whose marks do not hold them.

    Parameters
    ----------
    work : Work
        The update, whose main pass has run.
    curves : (k,) int
        Curves that it has evaluated.

    Returns
    -------
    list of int
        The curves that were made anew, to be evaluated once more.

    Raises
    ------
    AssocHullError
        A curve that cannot be held by any points.
    """
    state, maker = work.state, Maker(work.state, work.journal)
    known = attached_curves(state)
    done = {}
    chosen = [known[curve] for curve in curves.tolist() if curve in known]
    for made in _not_held(work, chosen):
        recipe = recipe_for(state, made, made.layout)
        if recipe.marks != made.marks:
            done[made.key] = remake_points(maker, made, recipe)
    if done:
        maker.generated(({each.key: each for each in state.generated} | done).values())
        work.renew()
    return sorted(made.curve for made in done.values())


def _not_held(work: Work, made: list[GeneratedCurve]) -> list[GeneratedCurve]:
    """Give those that their marks do not hold."""
    state, numbers = work.state, [each.curve for each in made]
    if not made:
        return []
    places = np.array([line_offset(state, curve) for curve in numbers])
    held = marks_suffice(forms_of(state), made, places, end_points(state, numbers))
    return [each for each, enough in zip(made, held.tolist(), strict=True) if not enough]


@attrs.define(eq=False)
class DefinitionValues(Modification):
    """What an edit asks of definitions by form parameters, and what it does to them by the way.

    Attributes
    ----------
    forms : dict of str to FormDefinition
        By use, definitions with other values.
    attach : set of int
        Lines whose points are to come from definitions again.
    watched : set of int
        Crossings that define no line any more, as others have passed them.
    """

    forms: dict[str, FormDefinition] = attrs.field(factory=dict)
    attach: set[int] = attrs.field(factory=set)
    watched: set[int] = attrs.field(factory=set)

    @classmethod
    def concerns(cls, state: HullState) -> bool:
        """Tell whether a hull has definitions: any edit may bend a curve off them."""
        return bool(state.definitions or state.generated)

    @property
    def idle(self) -> bool:
        """Whether nothing is asked of definitions."""
        return not (self.forms or self.attach)

    @property
    def asked_for(self) -> int:
        """How many definitions have other values, and how many lines return to theirs."""
        return len(self.forms) + len(self.attach)

    def reached(self, state: HullState) -> Sequence[IntArray]:
        """Give the definitions, and the curves of the lines."""
        live = state.live("formed").tolist()
        number = {state.formed.definition[each].use: each for each in live}
        found = [Node.form(np.array([number[use]], np.int64)) for use in self.forms]
        lines = [np.array(state.curves_of(line), np.int64) for line in sorted(self.attach)]
        return [*found, *map(Node.curve, lines)]

    def plan(self, work: Work) -> None:
        """Carry out what is asked, but for the evaluation."""
        state, pending = work.state, work.pending
        maker = Maker(state, work.journal)
        left = edited(state, work.journal, pending)
        _refuse_both(state, pending, left, self.attach)
        detach(maker, pending, left)
        work.forms = _write(maker, self.forms)
        made = [each for line in sorted(self.attach) for each in attachable_curves(state, line)]
        _remake(maker, pending, [*made, *(_other_pieces(state) if self.forms else ())])
        if pending.structural:
            tidy(maker)

    def arrange(self, work: Work) -> None:
        """Choose anew what defines lines on which crossings have passed one another."""
        if self.idle:
            return
        for _ in range(ROUNDS):
            curves, watched = renew_followers(work)
            self.watched |= set(watched)
            if not curves:
                return
            work.go(np.zeros(0, np.int64), np.array(curves, np.int64))

    def refine(self, work: Work) -> None:
        """Give generated curves the points that they have come to need, and let others follow."""
        if attached_curves(work.state) and not work.pending.alone:
            curves = refine_forms(work, work.touched())
            if curves:
                work.go(np.zeros(0, np.int64), np.array(curves, np.int64))
                self.arrange(work)
                work.settle()
        limit_watched(work, self.watched)

    def allow(self, work: Work, wide: WideGaps) -> bool:
        """Set limits anew as of a net that is made of the new definitions."""
        return bool(self.forms) and widen_limits(work, wide)

    def finish(self, work: Work) -> bool:
        """Detach what this update has bent off its definitions, and tell what was detached."""
        pending, state = work.pending, work.state
        maker = Maker(state, work.journal)
        if attached_curves(state) and (pending.structural or pending.displaces):
            off = off_definitions(state, work.touched().tolist())
            detach(maker, pending, off)
            if off:
                work.renew()
        if pending.structural and state.generated:
            tidy(maker)
        pending.notes += detached_note(state, pending.detached)
        return False


def _refuse_both(state: HullState, pending: Pending, left: set[int], attach: set[int]) -> None:
    asked = {int(state.rows.curve[row, 0]) for row in pending.values}
    for curve in sorted(left | asked | {each for _, each in pending.by_hand if each >= 0}):
        line = state.line_of(curve)
        if line in attach:
            raise BadInputError(
                "a line is edited by hand and returned to its definitions in one edit",
                f"at {state.lines.name[line]}", "use two edits",
            )  # fmt: skip


def _write(maker: Maker, forms: Mapping[str, FormDefinition]) -> IntArray:
    """Write definitions with other values; give their nodes."""
    state, table = maker.state, maker.state.formed
    maker.definitions([forms.get(each.use, each) for each in state.definitions])
    numbers = [n for n in state.live("formed").tolist()
               if table.definition[n].use in forms]  # fmt: skip
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
