"""Giving a definition other values: whatever is generated from it follows.

Examples
--------
>>> from assoc_hull.edit.document import Document
>>> from assoc_hull.edit.session import Edit
>>> from assoc_hull.shipped.wigley import wigley
>>> with Edit(Document(wigley()), "fuller") as edit:
...     edit.set_form("sectional areas", run_area=0.52)
Traceback (most recent call last):
...
assoc_hull.errors.UnknownNameError: there is no definition named 'sectional areas'; list them first
"""

from __future__ import annotations

from collections.abc import Mapping

from assoc_hull.arguments import number, shown
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import AssocHullError, BadInputError, UnknownNameError, WrongTypeError
from assoc_hull.model.definition_part import FormDefinition
from assoc_hull.model.forms.chains import chain_of
from assoc_hull.model.handles import handle
from assoc_hull.model.state import HullState

__all__ = ["CLOSED", "definition_meant", "definition_named", "set_form"]

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
    """Give the definition that is asked for by itself, its key, name or use; None if none is.

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
    old = edit.pending.forms.get(found.use, found)
    new = _with(state, old, values)
    chain_of(new, state.particulars)
    if new == found:
        edit.pending.forms.pop(found.use, None)
    else:
        edit.pending.forms[found.use] = new


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
