"""Checking what is handed to an edit: what any call checks, names of lines, directions."""

from __future__ import annotations

import numpy as np

from assoc_hull.arguments import flag, number, pair, place, places, shown, shown_name, word
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState

__all__ = [
    "direction_in",
    "flag",
    "line_name",
    "number",
    "pair",
    "place",
    "places",
    "shown",
    "shown_name",
    "word",
]


def line_name(name: object) -> str:
    """Take a name for a line: text that no address could be read from.

    Raises
    ------
    BadInputError
        No text, blanks at its ends, or what addresses are made with: `` x ``, `` @ ``, ``#``,
        ``/``, ``[``.
    """
    taken = (" x ", " @ ", "#", "/", "[", "]", ":")
    if not isinstance(name, str) or name != name.strip() or not name.isprintable() or not name:
        raise BadInputError(
            f"the name {shown(name)}", "in an edit", "give printable text without outer blanks"
        )
    if any(part in name for part in taken):
        raise BadInputError(
            f"the name {name!r} could be read as an address", "in an edit",
            "leave out ' x ', ' @ ', '#', '/', '[' and ']'",
        )  # fmt: skip
    return name


def direction_in(state: HullState, curve: int, value: object, name: str) -> FloatArray:
    """Take a vector in the plane of a curve, (3,); any length but nil.

    Raises
    ------
    BadInputError
        No vector, one without length, or one that leaves the plane.
    """
    found = place(value, name)
    length = float(np.sqrt((found * found).sum()))
    if length == 0.0:
        raise BadInputError(f"{name} has no length", "in an edit", "give a direction")
    line = state.line_of(curve)
    if state.lines.planar.data[line]:
        off = float((found * state.lines.normal.data[line]).sum()) / length
        if abs(off) > 1e-9:
            raise BadInputError(
                f"{name} leaves the plane of {state.lines.name.data[line]} (sine {off:.3g})",
                "in an edit",
                "give a vector in that plane",
            )
    return found
