"""Give a definition other values, and return lines to their definitions.

Both only note what is asked; the update takes it up, and all that is generated follows. A line that
is returned must hold no point that the definitions know nothing of. It then drives the lines that
it crosses, and points which those had adopted close by, in its place, go.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from assoc_hull.arguments import number, shown
from assoc_hull.edit.followup.take_up_definitions import DefinitionValues, attachable_curves
from assoc_hull.edit.modifications.roles import change_role
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import AssocHullError, BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.geometry.curves import IntArray
from assoc_hull.model.address import address
from assoc_hull.model.form_definition import ON_FLATS, FormDefinition, GeneratedCurve
from assoc_hull.model.forms.form_values import chain_of
from assoc_hull.model.generated_curves import kept_rows
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.links import crossing_ways
from assoc_hull.model.objects import handle
from assoc_hull.model.tables import HullState

__all__ = [
    "CLOSED",
    "definition_meant",
    "definition_named",
    "drive_others",
    "reattach",
    "set_form",
]

CLOSED: Mapping[str, tuple[str, ...]] = {
    "sectional_area": ("cb", "cp", "lcb"), "design_waterline": ("cw", "lcf"),
}  # fmt: skip
"""By use, what may be given besides values: area and centroid of the entrance come from it."""


def definition_named(state: HullState, name: FormDefinition | str) -> FormDefinition:
    """Give a definition of a hull by its name, its use or its key, or one of the same use.

    Raises
    ------
    UnknownNameError
        The hull has none of that name.
    WrongTypeError
        It is neither a name nor a definition.
    """
    known = state.definitions
    wanted = name.use if isinstance(name, FormDefinition) else name
    if not isinstance(wanted, str):
        remedy = "give its name or its use"
        raise WrongTypeError(f"the definition is {shown(name)}", "in set_form", remedy)
    for each in known:
        if wanted in (each.name, each.use, each.key):
            return each
    raise UnknownNameError("definition", wanted, tuple(each.name for each in known))


def definition_meant(state: HullState, thing: object) -> FormDefinition | None:
    """Give the definition that a key, name, use or definition asks for; None if none is.

    A line, curve or point of that name comes first.
    """
    if isinstance(thing, FormDefinition):
        return definition_named(state, thing)
    if not isinstance(thing, str):
        return None
    for each in state.definitions:
        if thing == each.key:
            return each
        if thing in (each.name, each.use):
            try:
                handle(state, thing)
            except AssocHullError:
                return each
    return None


def set_form(
    edit: Transaction, name: FormDefinition | str, values: Mapping[str, float | None]
) -> None:
    """Give a definition other values when the edit ends.

    Parameters
    ----------
    edit : Transaction
        The edit.
    name : FormDefinition or str
        The definition, its name or its use.
    values : mapping of str to float or None
        As the definition names them; of a curve of areas also ``cb``, ``cp`` and ``lcb`` (m
        from midship, forward positive), of the design waterline ``cw`` and ``lcf``: these
        give area and centroid of the entrance.

    Raises
    ------
    UnknownNameError
        The hull has no such definition, or this no such value.
    BadInputError, OutOfRangeError
        A number that is not finite, or a curve that cannot be made; the error names the
        definition, the value and what is admissible.
    """
    state = edit.state
    found = definition_named(state, name)
    forms = edit.pending.ask(DefinitionValues).forms
    old = forms.get(found.use, found)
    new = _with(state, old, values)
    chain_of(new, state.particulars)
    if new == found:
        forms.pop(found.use, None)
    else:
        forms[found.use] = new


def _with(
    state: HullState, old: FormDefinition, values: Mapping[str, float | None]
) -> FormDefinition:
    where = f"in the definition {old.name!r}"
    closing = CLOSED.get(old.use, ())
    plain = {
        each: None if value is None else number(value, each, where)
        for each, value in values.items()
        if each not in closing
    }
    new = old.having(plain)
    asked = {each: values[each] for each in closing if values.get(each) is not None}
    if not asked:
        return new
    twice = {"entrance_area", "entrance_centroid"} & plain.keys()
    if twice:
        raise BadInputError(
            f"{', '.join(sorted(twice))} and {', '.join(sorted(asked))} are given", where,
            "leave one of them out: the closure gives area and centroid of the entrance",
        )  # fmt: skip
    from assoc_hull.model.forms.closure import close_halves

    return close_halves(new, state.particulars, **asked)


# --------------------------------------------------------------------------------------
# Driving other lines. A line that was cut, or shifted, passes the others where these lie: it may be
# watched there, or even driven. Once it comes from definitions it gives the value.


def drive_others(edit: Transaction, curve: int) -> None:
    """Let a curve drive those on which its group alone generates points.

    Crossings whose role was set by hand keep it; those with a point close by that the other curve
    cannot do without are watched.
    """
    state, table = edit.state, edit.state.rows
    mine = table.alive.data & (table.sort.data == Sort.CROSSING) & ~table.contact.data
    mine &= (table.curve[:, 0] == curve) & (table.override.data < 0)
    for row in np.flatnonzero(mine).tolist():
        other = int(table.curve[row, 1])
        one_way = crossing_ways(state, np.array([row]))[0].tolist() == [True, False]
        if one_way and table.role[row] != Role.DRIVES_B:
            room = _make_room(edit, other, row)
            change_role(edit, row, Role.DRIVES_B if room else Role.WATCHED)


def _make_room(edit: Transaction, curve: int, row: int) -> bool:
    """Take out what a curve adopted beside a crossing; tell whether nothing else is too close."""
    state = edit.state
    rows: IntArray = state.curves.rows[curve]
    if row in rows.tolist():
        return True
    step = np.diff(state.rows.xyz[rows], axis=0)
    least = state.tolerances.spacing * float(np.median(np.sqrt((step * step).sum(axis=1))))
    away = state.rows.xyz[rows] - state.rows.spot[row, 0]
    near = np.sqrt((away * away).sum(axis=1)) < least
    adopted = (state.rows.sort[rows] == Sort.ADOPTED) & ~np.isin(rows, kept_rows(state))
    gone = rows[near & adopted]
    if len(gone):
        edit.maker.define(curve, rows[~np.isin(rows, gone)])
        edit.maker.remove_rows(gone)
        edit.pending.curves.add(curve)
    return not (near & ~adopted).any()


# --------------------------------------------------------------------------------------
# Returning lines to the definitions.


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
    name = str(state.lines.name[line])
    if not state.definitions:
        what = "the hull has no definitions"
        raise BadInputError(what, "in reattach", "make it of definitions: see ah.create")
    found = attachable_curves(state, line)
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
    edit.pending.ask(DefinitionValues).attach.add(line)
    edit.pending.structural = True


def _refuse_others(state: HullState, made: GeneratedCurve) -> None:
    """Refuse where a point defines the curve that the definitions know nothing of."""
    rows: IntArray = state.curves.rows[made.curve]
    if made.what in ON_FLATS:
        return  # definitions give only the ends of its flat: other points may stand beside them
    for row in rows[1:-1].tolist():
        if row in made.rows:
            continue
        sort = Sort(int(state.rows.sort[row]))
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
