"""End conditions of curves."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from assoc_hull.arguments import choice
from assoc_hull.edit.arguments import direction_in
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import EndKind
from assoc_hull.model.address import AddressBook
from assoc_hull.model.kinds import State
from assoc_hull.model.tables import Ends

__all__ = ["set_end"]


def set_end(
    edit: Transaction,
    curve: int,
    end: str,
    *,
    tangent: ArrayLike | None = None,
    curvature: ArrayLike | None = None,
) -> None:
    """Give a curve a direction or a curvature at an end, or leave that end free.

    What is so already is not done again, but for a curve that has failed.

    Parameters
    ----------
    edit : Transaction
        The edit.
    curve : int
        The curve.
    end : {"start", "finish"}
        Which end.
    tangent : (3,) or None
        Direction along the sense of the curve, any length.
    curvature : (3,) or None, 1/m
        Second derivative with respect to chord length.

    Raises
    ------
    BadInputError
        An unknown end, both conditions, or a vector that is not three finite numbers.
    """
    where = f"in set_end of {AddressBook(edit.state).curve_name(curve)}"
    choice(end, "end", ("start", "finish"), where)
    if tangent is not None and curvature is not None:
        raise BadInputError("both a tangent and a curvature", where, "give one of the two")
    kind, vector = EndKind.FREE, np.zeros(3)
    if tangent is not None:
        kind, vector = EndKind.TANGENT, direction_in(edit.state, curve, tangent, "tangent")
    elif curvature is not None:
        kind, vector = EndKind.CURVATURE, direction_in(edit.state, curve, curvature, "curvature")
    old: Ends = edit.state.curves.ends[curve]
    at = 0 if end == "start" else 1
    x, y, z = vector.tolist()
    given = (int(kind), (x, y, z))
    kept = (old.kind[1 - at], old.vector[1 - at])
    first, last = (given, kept) if at == 0 else (kept, given)
    new = Ends((first[0], last[0]), (first[1], last[1]))
    if new == old and edit.state.curves.state[curve] == State.CLEAN:
        return
    edit.journal.set(edit.state.curves.ends, [curve], [new])
    edit.pending.by_hand.add((int(edit.state.curves.rows[curve][-at]), curve))
    edit.pending.curves.add(curve)
    edit.pending.moved_curves.add(curve)
