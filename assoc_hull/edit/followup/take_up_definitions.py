"""Definitions and what is generated from them: taken up by an edit, let go of, made anew.

New values go into the tables; curves that were edited by hand are detached; lines that are to
come from definitions again are made so; and curves whose pieces become others get other points.
What remains is done by the update: each point that a definition gives is evaluated. Then lines are
put in order on which crossings have passed one another, and generated curves get the points that
they have come to need.

Generated curves that are edited by hand leave their definitions, and keep their shape.

A curve is detached by whatever changes its points, their kinds, its end conditions or its plane,
but its definitions: before the update runs, so that no definition writes over what was asked for;
and after it, where the update itself has changed the curve.

Points of a curve that comes from definitions, made anew from a recipe.

That happens when the pieces of the curve are others than before, when it needs more points, or
when a line is returned to its definitions. Points whose mark stays keep their identity, so that
nothing that reads them loses them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeVar

import attrs
import numpy as np

from assoc_hull.edit.checks.update_findings import WideGaps
from assoc_hull.edit.followup.reorder_crossings import limit_watched, renew_followers, widen_limits
from assoc_hull.edit.modification import (
    ROUNDS,
    Modification,
    Pending,
    Work,
)
from assoc_hull.edit.step import FormChange
from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.graph.journal import Journal
from assoc_hull.graph.table import Column, ValueColumn
from assoc_hull.model.form_definition import (
    ON_FLATS,
    FormDefinition,
    GeneratedCurve,
    Mark,
)
from assoc_hull.model.forms.generate_points import marks_for, marks_suffice
from assoc_hull.model.forms.line_layout import layout_at
from assoc_hull.model.generated_curves import (
    attached_curves,
    end_points,
    forms_of,
    line_offset,
    part_in_line,
    points_given,
)
from assoc_hull.model.kinds import Sort
from assoc_hull.model.make_objects import Maker, PointSpec
from assoc_hull.model.network import bits_differ
from assoc_hull.model.node import Node
from assoc_hull.model.tables import Ends, HullState

__all__ = [
    "CurveRecipe",
    "DefinitionValues",
    "attachable_curves",
    "detach",
    "detach_rows",
    "detached_note",
    "edited",
    "form_changes",
    "layout_now",
    "off_definitions",
    "recipe_for",
    "remake_points",
    "tidy",
    "whole",
]

V = TypeVar("V")

_TOLD = 3
"""So many curves a note names."""


def edited(state: HullState, journal: Journal, pending: Pending) -> set[int]:
    """Give the attached curves that the modifications of a transaction have edited by hand.

    Those that it has made, or made anew, of definitions are not among them.

    Parameters
    ----------
    state : HullState
        The tables, in which structure is changed already and places are not.
    journal : Journal
        What was written so far.
    pending : Pending
        What is asked for.
    """
    fresh = _changed(journal, state.produced.curve)
    made_so = {state.produced.curve[number].curve for number in fresh}
    known = {c: made for c, made in attached_curves(state).items() if c not in made_so}
    if not known:
        return set()
    moved = _moved(state, journal, pending)
    table = state.rows
    marked = moved.union(*(_changed(journal, each) for each in (
        table.kind, table.direction, table.sort, table.alive, table.reader, table.curve,
    )))  # fmt: skip
    found = {curve for curve, made in known.items() if marked.intersection(made.rows)}
    if pending.alone:
        found |= {c for c in known if moved.intersection(state.curves.rows[c].tolist())}
    recipes = _changed(journal, state.curves.ends) | _changed(journal, state.curves.alive)
    planes = _changed(journal, state.lines.offset) | _changed(journal, state.lines.normal)
    found |= {c for c in known if c in recipes or state.line_of(c) in planes}
    return found | {curve for curve, made in known.items() if not whole(state, made)}


def _moved(state: HullState, journal: Journal, pending: Pending) -> set[int]:
    """Give the points that lie, or are to lie, elsewhere by a bit."""
    rows = np.array(sorted(pending.values), np.int64)
    asked = np.array([pending.values[row] for row in rows.tolist()]).reshape(-1, 3) + 0.0
    there = state.rows.xyz.data
    found = set(rows[bits_differ(there[rows], asked)].tolist()) if len(rows) else set[int]()
    return found | _changed(journal, state.rows.xyz)


def _changed(journal: Journal, column: Column[np.generic] | ValueColumn[V]) -> set[int]:
    """Give the rows of a column that differ from what they were before the transaction."""
    if not any(column is each for each in journal.columns()):
        return set()
    if isinstance(column, ValueColumn):
        held = journal.net(column)
        pairs = zip(held.rows.tolist(), held.old, held.new, strict=True)
        return {row for row, old, new in pairs if old != new}
    net = journal.net(column)
    old, new = (part.reshape(len(net.rows), -1) for part in (net.old, net.new))
    differs = (old != new) & ~(_nan(old) & _nan(new))
    return set(net.rows[differs.any(axis=1)].tolist())


def _nan(values: np.typing.NDArray[np.generic]) -> np.typing.NDArray[np.bool_]:
    return np.isnan(values) if values.dtype.kind == "f" else np.zeros(values.shape, np.bool_)


def whole(state: HullState, made: GeneratedCurve) -> bool:
    """Tell whether just the points of a generated curve define it, in order, but for its ends."""
    rows: IntArray = state.curves.rows[made.curve]
    if not state.curves.alive[made.curve]:
        return False
    own = np.array(made.rows, np.int64)
    if (state.rows.sort[own] != Sort.ADOPTED).any():
        return False
    mine = np.isin(rows, own)
    if not np.array_equal(rows[mine], own):
        return False
    return made.what in ON_FLATS or bool(mine[1:-1].all())


def off_definitions(state: HullState, curves: Iterable[int]) -> set[int]:
    """Give those of some attached curves that are not as the definitions have them, to the bit."""
    known = attached_curves(state)
    chosen = [known[curve] for curve in curves if curve in known]
    broken = {made.curve for made in chosen if not whole(state, made)}
    return broken | _off(state, [made for made in chosen if made.curve not in broken])


def _off(state: HullState, chosen: Sequence[GeneratedCurve]) -> set[int]:
    """Compare all at once; one by one where some cannot be made at all."""
    try:
        rows, places = points_given(state, chosen)
    except AssocHullError:
        if len(chosen) == 1:
            return {chosen[0].curve}
        return set[int]().union(*(_off(state, [made]) for made in chosen))
    odd = rows[bits_differ(state.rows.xyz[rows], places)]
    return set(state.rows.curve[odd, 0].tolist())


def detach(maker: Maker, pending: Pending, curves: Iterable[int]) -> None:
    """Let curves keep their shape whatever the definitions say; those that have gone are dropped.

    The structure changes: look-ups have to be derived anew.
    """
    state, left = maker.state, set(curves)
    if not left:
        return
    found = []
    for made in state.generated:
        if made.curve not in left:
            found.append(made)
        elif state.curves.alive[made.curve]:
            found.append(_pruned(state, made.evolve(attached=False)))
    maker.generated(found)
    pending.detached += sorted(each for each in left if state.curves.alive[each])
    pending.structural = True


def _pruned(state: HullState, made: GeneratedCurve) -> GeneratedCurve:
    """Give a detached curve without the points that have gone."""
    alive = [
        bool(state.rows.alive[row]) and int(state.rows.curve[row, 0]) == made.curve
        for row in made.rows
    ]
    if all(alive):
        return made
    rows = tuple(row for row, here in zip(made.rows, alive, strict=True) if here)
    marks = tuple(mark for mark, here in zip(made.marks, alive, strict=True) if here)
    return made.evolve(rows=rows, marks=marks)


def tidy(maker: Maker) -> None:
    """Drop generated curves that have gone, and points that detached ones have lost."""
    state = maker.state
    there = [each for each in state.generated if state.curves.alive[each.curve]]
    maker.generated(each if each.attached else _pruned(state, each) for each in there)


def detach_rows(maker: Maker, pending: Pending, rows: IntArray) -> bool:
    """Detach the curves that some points are generated on; tell whether there are any."""
    known: Mapping[int, GeneratedCurve] = attached_curves(maker.state)
    moved = set(rows.tolist())
    left = {curve for curve, made in known.items() if moved.intersection(made.rows)}
    detach(maker, pending, left)
    return bool(left)


def detached_note(state: HullState, curves: Iterable[int]) -> list[str]:
    """Say in one note which lines were detached."""
    lines = sorted({state.line_of(curve) for curve in curves if state.curves.alive[curve]})
    names = [str(state.lines.name[line]) for line in lines]
    if not names:
        return []
    if len(names) == 1:
        return [f"{names[0]} is detached from the definitions; edit.reattach returns it"]
    told = ", ".join(names[:_TOLD])
    more = f" and {len(names) - _TOLD} more" if len(names) > _TOLD else ""
    return [
        f"{len(names)} lines are detached from the definitions, {told}{more}; edit.reattach "
        "returns one"
    ]


def attachable_curves(state: HullState, line: int) -> list[GeneratedCurve]:
    """Give what comes, came or may come from definitions on a line.

    Examples
    --------
    >>> from assoc_hull.edit.followup.take_up_definitions import attachable_curves
    >>> from assoc_hull.shipped.wigley import wigley
    >>> attachable_curves(wigley(stations=5, waterlines=4), 0)
    []
    """
    curves = [c for c in state.lines.curves[line] if state.curves.alive[c]]
    known = {each.curve: each for each in state.generated}
    found = [known[curve] for curve in curves if curve in known]
    if found or not _is_section(state, line):
        return found
    keys = state.curves.key.data
    return [GeneratedCurve(str(keys[c]), c, "section", "", (), (), attached=False) for c in curves]


def _is_section(state: HullState, line: int) -> bool:
    """Tell whether a line is a section like those that are generated."""
    groups = {
        int(state.lines.group[state.line_of(each.curve)])
        for each in state.generated
        if each.what == "section"
    }
    return int(state.lines.group[line]) in groups


# --------------------------------------------------------------------------------------
# Recipes.

Vector = tuple[float, float, float]


@attrs.frozen
class CurveRecipe:
    """What a generated curve is to be made of.

    Attributes
    ----------
    layout : str
        Its pieces.
    marks : tuple of Mark
        Where its points lie on them.
    kinds : tuple of int
        A `PointKind` each.
    directions : tuple of (3,)
        Directions of tangent points.
    ends : Ends
        End conditions.
    """

    layout: str
    marks: tuple[Mark, ...]
    kinds: tuple[int, ...]
    directions: tuple[Vector, ...]
    ends: Ends = attrs.field(factory=Ends)


def layout_now(state: HullState, made: GeneratedCurve) -> str:
    """Give the layout that the definitions ask for where a curve stands.

    Raises
    ------
    BadInputError
        A definition is missing, or the curve is not there any more.
    """
    place = line_offset(state, made.curve)
    return layout_at(forms_of(state), made.what, place, part_in_line(state, made.curve))


def recipe_for(state: HullState, made: GeneratedCurve, layout: str) -> CurveRecipe:
    """Give the recipe of a curve by its layout, with its ends as they lie now.

    Raises
    ------
    AssocHullError
        The curve cannot be made.
    """
    if not layout:
        return CurveRecipe(layout, (), (), ())
    place, ends = line_offset(state, made.curve), end_points(state, [made.curve])[0]
    marks, kinds, directions, conditions = marks_for(
        forms_of(state), made.what, layout, place, ends,
        made.marks if layout == made.layout and made.attached else (),
    )  # fmt: skip
    vectors = [(x, y, z) for x, y, z in np.asarray(directions, np.float64).reshape(-1, 3).tolist()]
    chosen = tuple((int(piece), float(t)) for piece, t in marks)
    numbers = tuple(np.asarray(kinds, np.int64).tolist())
    return CurveRecipe(layout, chosen, numbers, tuple(vectors), conditions)


def remake_points(maker: Maker, made: GeneratedCurve, recipe: CurveRecipe) -> GeneratedCurve:
    """Give a curve the points of a recipe, its own ends before and behind them.

    The result is attached; the caller puts it into the table.
    """
    state, journal = maker.state, maker.journal
    rows, fresh = _rows(maker, made, recipe)
    new = made.evolve(
        layout=recipe.layout, marks=recipe.marks, rows=tuple(rows.tolist()), attached=True
    )
    _thread(maker, made, new)
    kinds = state.rows.kind[rows].copy()
    kinds[:, 0] = recipe.kinds
    directions = state.rows.direction[rows].copy()
    directions[:, 0] = np.array(recipe.directions, np.float64).reshape(-1, 3)
    journal.put(state.rows.kind, rows, kinds)
    journal.put(state.rows.direction, rows, directions)
    journal.put(state.rows.sort, rows, int(Sort.ADOPTED))
    journal.put(state.rows.anchor, rows, -1)
    if state.curves.ends[made.curve] != recipe.ends:
        journal.set(state.curves.ends, [made.curve], [recipe.ends])
    _place(maker, new, fresh)
    return new


def _rows(maker: Maker, made: GeneratedCurve, recipe: CurveRecipe) -> tuple[IntArray, IntArray]:
    """Give the points of a recipe, and those of them that are new; others are taken out."""
    state = maker.state
    same = made.layout == recipe.layout
    known = {
        mark: row
        for mark, row in zip(made.marks, made.rows, strict=True)
        if same and state.rows.alive[row]
    }
    missing = [mark for mark in recipe.marks if mark not in known]
    # a key is of the place where its point first lay: that must be known before the point is made
    bare = made.evolve(layout=recipe.layout, marks=tuple(missing), rows=(-1,) * len(missing))
    places = points_given(state, [bare])[1]
    specs = [PointSpec(made.curve, place, Sort.ADOPTED) for place in places]
    fresh = maker.points(specs)
    known |= dict(zip(missing, fresh.tolist(), strict=True))
    rows = np.array([known[mark] for mark in recipe.marks], np.int64)
    lost = np.setdiff1d(np.array(made.rows, np.int64), rows)
    maker.remove_rows(lost[state.rows.alive[lost]])
    return rows, fresh


def _thread(maker: Maker, made: GeneratedCurve, new: GeneratedCurve) -> None:
    """Let the new points define the curve; only lines on a flat have others than their ends."""
    state = maker.state
    old: IntArray = state.curves.rows[made.curve]
    rows = np.array(new.rows, np.int64)
    rest = old[~np.isin(old, np.union1d(np.array(made.rows, np.int64), rows))]
    if made.what in ON_FLATS:
        every = np.concatenate([rest, rows])
        maker.define(made.curve, every[np.argsort(state.rows.xyz[every, 0], kind="stable")])
        return
    # ends that are no generated points stay: there a section meets profile and deck edge
    first, last = rest[rest == old[0]], rest[rest == old[-1]]
    left = rest[(rest != old[0]) & (rest != old[-1])]
    maker.define(made.curve, np.concatenate([first, rows, last]))
    maker.remove_rows(left[state.rows.sort[left] == Sort.ADOPTED])


def _place(maker: Maker, new: GeneratedCurve, fresh: IntArray) -> None:
    """Put points that stay where the definitions have them; new ones lie there already."""
    rows, places = points_given(maker.state, [new])
    old = ~np.isin(rows, fresh)
    maker.journal.put(maker.state.rows.xyz, rows[old], places[old])


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
