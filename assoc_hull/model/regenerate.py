"""What the definitions of a hull give now: the points of generated curves, their layouts.

The curves of form parameters are made once for a set of definitions and kept with the hull.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from assoc_hull.errors import AssocHullError, BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.definition_part import FormDefinition, GeneratedCurve
from assoc_hull.model.forms.forms import Forms
from assoc_hull.model.forms.generate import generated_points
from assoc_hull.model.state import HullState

__all__ = ["ends_of", "forms_of", "forms_with", "part_of", "place_of", "points_given"]


def forms_of(state: HullState) -> Forms:
    """Give the curves of a hull's definitions; the same ones as long as these stay."""
    return forms_with(state, state.definitions)


def forms_with(state: HullState, definitions: Sequence[FormDefinition]) -> Forms:
    """Give the curves of some definitions of a hull; those of the last two sets are kept."""
    wanted = tuple(definitions), state.particulars
    known = state.kept.setdefault("forms", [])
    for number, (asked, found) in enumerate(known):
        if asked == wanted:
            known.insert(0, known.pop(number))
            made: Forms = found
            return made
    forms = Forms.of(wanted[0], wanted[1])
    known.insert(0, (wanted, forms))
    del known[2:]
    return forms


def place_of(state: HullState, curve: int) -> float:
    """Give where the plane of a curve's line stands, m along its axis; nan for a space curve."""
    return float(state.lines.offset.data[state.line_of(curve)])


def part_of(state: HullState, curve: int) -> int:
    """Tell as which curve of its line one stands, from 0."""
    mine: Sequence[int] = state.lines.curves.data[state.line_of(curve)]
    live = [each for each in mine if state.curves.alive.data[each]]
    return live.index(curve)


def ends_of(state: HullState, curves: Sequence[int]) -> FloatArray:
    """Give the first and the last defining point of curves, (m, 2, 3), m."""
    rows = [state.curves.rows.data[curve][[0, -1]] for curve in curves]
    found: FloatArray = state.rows.xyz.data[np.array(rows, np.int64).reshape(-1, 2)]
    return found


def points_given(
    state: HullState, made: Iterable[GeneratedCurve], forms: Forms | None = None
) -> tuple[IntArray, FloatArray]:
    """Give the points of generated curves as the definitions have them, ends as they lie now.

    Parameters
    ----------
    state : HullState
        The tables; only read.
    made : iterable of GeneratedCurve
        The curves. What comes of one does not depend on the others.
    forms : Forms or None
        Those of the hull if None.

    Returns
    -------
    (k,) int, (k, 3) float, m
        Rows, curve by curve, and their places.

    Raises
    ------
    AssocHullError
        A curve that cannot be made; the error names where it stands and what is wrong.
    """
    chosen = tuple(made)
    numbers = [each.curve for each in chosen]
    if not chosen:
        return np.zeros(0, np.int64), np.zeros((0, 3))
    places = np.array([place_of(state, curve) for curve in numbers])
    known = forms_of(state) if forms is None else forms
    try:
        found = generated_points(known, chosen, places, ends_of(state, numbers))
    except (LookupError, ValueError) as error:
        if isinstance(error, AssocHullError):
            raise
        keys = ", ".join(each.key for each in chosen[:3])
        what = f"pieces or marks that there are not ({type(error).__name__}: {error})"
        raise BadInputError(
            what, f"among {keys}", "take the hull from where it was kept"
        ) from error
    rows = np.array([row for each in chosen for row in each.rows], np.int64)
    return rows, np.ascontiguousarray(np.concatenate([np.zeros((0, 3)), *found])) + 0.0
