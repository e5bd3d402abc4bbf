"""The part of a graph that one edit changed."""

from __future__ import annotations

from assoc_hull.edit.document import Document
from assoc_hull.errors import BadInputError
from assoc_hull.model.state import HullState
from assoc_hull.model.view import point_id

__all__ = ["changed_by"]


def changed_by(document: Document, number: int) -> frozenset[str]:
    """Name what an edit changed, as nodes of the graphs of `assoc_hull.model.view`.

    Parameters
    ----------
    document : Document
        The hull with its history.
    number : int
        Number of the edit, from 1; -1 is the last one.

    Returns
    -------
    frozenset of str
        Keys of curves, and of points with and without the curve they lie on.

    Raises
    ------
    BadInputError
        No such edit.

    Examples
    --------
    >>> from assoc_hull.edit.document import Document
    >>> from assoc_hull.edit.view import changed_by
    >>> from assoc_hull.examples.wigley import wigley
    >>> changed_by(Document(wigley()), 1)
    Traceback (most recent call last):
    ...
    assoc_hull.errors.BadInputError: edit 1 was asked, in a history of 0; give a number from 1
    """
    count = len(document.history)
    if not (1 <= number <= count or -count <= number <= -1):
        raise BadInputError(
            f"edit {number} was asked", f"in a history of {count}", "give a number from 1"
        )
    step = document.history[number - 1 if number > 0 else number]
    state = document.state
    curves = {str(state.curves.key.data[curve]) for curve in step.curves.tolist()}
    return frozenset(curves.union(*(_names(state, row) for row in step.rows.tolist())))


def _names(state: HullState, row: int) -> set[str]:
    sides = [side for side in (0, 1) if state.rows.curve.data[row, side] >= 0]
    return {str(state.rows.key.data[row])} | {point_id(state, row, side) for side in sides}
