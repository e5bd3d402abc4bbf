"""Curves that come from definitions: which are attached, and where their points lie now.

An attached curve takes its points from the definitions of the hull; one that was edited by hand is
detached and no longer follows. The curves of form parameters are made once for a set of definitions
and kept with the hull. How points follow from a definition is the matter of
`assoc_hull.model.forms`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.graph.derived import Objects
from assoc_hull.model.address import AddressBook
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.generate_points import generated_points
from assoc_hull.model.tables import HullState

__all__ = [
    "attached_curves",
    "attached_rows",
    "end_points",
    "forms_of",
    "forms_with",
    "kept_rows",
    "line_offset",
    "part_in_line",
    "points_given",
    "unmade_rows",
]

_Known = tuple[Mapping[int, GeneratedCurve], IntArray, IntArray]


def attached_curves(state: HullState) -> Mapping[int, GeneratedCurve]:
    """Give the attached generated curves by the number of the curve, in that order."""
    return _known(state)[0]


def attached_rows(state: HullState) -> IntArray:
    """Give the points that are computed from definitions, ascending."""
    return _known(state)[1]


def kept_rows(state: HullState) -> IntArray:
    """Give the points that are computed from definitions, or were until their curve was edited.

    They ride with no other point: what was drawn by hand keeps its shape.
    """
    return _known(state)[2]


def unmade_rows(state: HullState, rows: IntArray) -> np.typing.NDArray[np.bool_]:
    """Tell for each of some points whether no definition computes it."""
    mine = attached_rows(state)
    if not len(mine):
        return np.ones(len(rows), np.bool_)
    found: np.typing.NDArray[np.bool_] = ~np.isin(rows, mine)
    return found


def _known(state: HullState) -> _Known:
    """Read the table of generated curves: attached curves by number, their points, those of all."""
    table = state.produced
    return state.derived(("attached",), (table.curve, table.alive), lambda: _read(state))


def _read(state: HullState) -> _Known:
    found = [state.produced.curve[number] for number in state.live("produced").tolist()]
    curves = {each.curve: each for each in found if each.attached}
    rows = np.array(sorted(row for each in curves.values() for row in each.rows), np.int64)
    kept = np.array(sorted(row for each in found for row in each.rows), np.int64)
    freeze(rows, kept)
    return dict(sorted(curves.items())), rows, kept


# --------------------------------------------------------------------------------------
# What the definitions of a hull give now.


def forms_of(state: HullState) -> Forms:
    """Give the curves of a hull's definitions; the same ones as long as these stay."""
    return forms_with(state, state.definitions)


def forms_with(state: HullState, definitions: Sequence[FormDefinition]) -> Forms:
    """Give the curves of some definitions of a hull; those of the last two sets are kept."""
    chosen, ship = tuple(definitions), state.particulars
    key = ("forms", Objects(chosen), ship)
    return state.derived(key, (), lambda: Forms.of(chosen, ship), most=2)


def line_offset(state: HullState, curve: int) -> float:
    """Give where the plane of a curve's line stands, m along its axis; nan for a space curve."""
    return float(state.lines.offset[state.line_of(curve)])


def part_in_line(state: HullState, curve: int) -> int:
    """Give the number of a curve among the live ones of its line, from 0."""
    mine: Sequence[int] = state.lines.curves[state.line_of(curve)]
    live = [each for each in mine if state.curves.alive[each]]
    return live.index(curve)


def end_points(state: HullState, curves: Sequence[int]) -> FloatArray:
    """Give the first and the last defining point of curves, (m, 2, 3), m."""
    rows = [state.curves.rows[curve][[0, -1]] for curve in curves]
    found: FloatArray = state.rows.xyz[np.array(rows, np.int64).reshape(-1, 2)]
    return found


def points_given(
    state: HullState, made: Iterable[GeneratedCurve], forms: Forms | None = None
) -> tuple[IntArray, FloatArray]:
    """Give the points of generated curves as the definitions have them, ends as they lie now.

    These are rows (k,), curve by curve, and places (k, 3), m; the tables are only read. What comes
    of one curve does not depend on the others. `forms` are those of the hull if None.

    Raises
    ------
    AssocHullError
        A curve that cannot be made; the error names where it stands and what is wrong.
    """
    chosen = tuple(made)
    numbers = [each.curve for each in chosen]
    if not chosen:
        return np.zeros(0, np.int64), np.zeros((0, 3))
    places = np.array([line_offset(state, curve) for curve in numbers])
    known = forms_of(state) if forms is None else forms
    try:
        found = generated_points(known, chosen, places, end_points(state, numbers))
    except (LookupError, ValueError) as error:
        if isinstance(error, AssocHullError):
            raise
        book = AddressBook(state)
        names = ", ".join(book.curve_name(each.curve) for each in chosen[:3])
        what = f"pieces or marks that there are not ({type(error).__name__}: {error})"
        raise BadInputError(
            what, f"among {names}", "take the hull from where it was kept"
        ) from error
    rows = np.array([row for each in chosen for row in each.rows], np.int64)
    # -0.0 becomes 0.0: places are compared and fingerprinted by their bits
    return rows, np.ascontiguousarray(np.concatenate([np.zeros((0, 3)), *found])) + 0.0
