"""Swinging: breadth against draught at the same volume and block coefficient.

    L' B' T' = L B T        x' = x L'/L    y' = y B'/B    z' = z T'/T

An affine map: volume, CB, CP, CM, CW and LCB / L of the exact image are those of the parent. A
spline through mapped points is not the mapped spline, by 1e-6 of the volume; a small shift of
sections takes that away.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from assoc_hull.arguments import positive, text
from assoc_hull.edit.document import Document
from assoc_hull.errors import BadInputError
from assoc_hull.model.tables import HullState
from assoc_hull.variation.fields.space_map import VariationMap
from assoc_hull.variation.parameters.parameter_measures import measure_all
from assoc_hull.variation.shifts.shift_hull import ShiftReport, shift_document, values_of
from assoc_hull.variation.shifts.shift_request import ShiftRequest

__all__ = ["SWUNG", "swing_document", "swung_dimensions"]

SWUNG = ("length", "breadth", "draught")
"""The dimensions whose product is held."""

_WHERE = "in swing"


def swung_dimensions(
    now: Mapping[str, float], asked: Mapping[str, float | None]
) -> dict[str, float]:
    """Give all dimensions of a hull that is swung.

    Parameters
    ----------
    now : mapping of str to float
        Present ``length``, ``breadth``, ``draught`` and ``depth``, m.
    asked : mapping of str to float or None
        One or two of the first three, m. What is not asked for gives way: breadth to draught
        and draught to breadth; with a length alone, both in one ratio.

    Returns
    -------
    dict
        Dimensions that are to be had, m; the depth goes with the draught.

    Raises
    ------
    BadInputError
        None of them is asked for, or all three; one is no positive number.

    Examples
    --------
    >>> from assoc_hull.variation.shifts.swing_hull import swung_dimensions
    >>> now = {"length": 100.0, "breadth": 10.0, "draught": 6.0, "depth": 9.0}
    >>> swung_dimensions(now, {"breadth": 12.0})
    {'breadth': 12.0, 'draught': 5.0, 'depth': 7.5}
    """
    given = {
        name: positive(asked[name], name, _WHERE) for name in SWUNG if asked.get(name) is not None
    }
    if not given or len(given) == len(SWUNG):
        word = "all" if given else "none"
        raise BadInputError(
            f"{word} of {', '.join(SWUNG)} are given", _WHERE,
            "give one or two of them: the others hold the volume",
        )  # fmt: skip
    ratio = {name: value / now[name] for name, value in given.items()}
    free = _free(given)
    left = 1.0 / math.prod(ratio.values())
    for name in free:
        ratio[name] = left if len(free) == 1 else math.sqrt(left)
    found = {
        name: given.get(name, now[name] * ratio[name]) for name in SWUNG if name in ratio
    }  # fmt: skip
    found["depth"] = now["depth"] * (found["draught"] / now["draught"])
    return found


def _free(given: Mapping[str, float]) -> tuple[str, ...]:
    """Give what gives way."""
    if len(given) == 2:
        return tuple(name for name in SWUNG if name not in given)
    others = {"breadth": ("draught",), "draught": ("breadth",), "length": ("breadth", "draught")}
    return others[next(iter(given))]


_HELD = ("volume", "lcb_percent")


def swing_document(
    document: Document, asked: Mapping[str, float | None], name: str | None = None
) -> tuple[VariationMap, ShiftReport]:
    """Swing a hull in place, as one step that can be undone.

    Parameters
    ----------
    document : Document
        The hull.
    asked : mapping of str to float or None
        One or two of `SWUNG`, m.
    name : str or None
        Of the step in the history.

    Raises
    ------
    BadInputError, OutOfRangeError, FoldError, RefusedEditError
        What is asked for cannot be had; the hull is unchanged.
    """
    values = swung_dimensions(_dimensions(document.state), asked)
    words = ", ".join(f"{key}={values[key]:g}" for key in SWUNG if key in values)
    title = f"swing {words}" if name is None else text(name, "the name", _WHERE)
    held = dict(zip(_HELD, values_of(document.state, _HELD).tolist(), strict=True))
    return shift_document(document, ShiftRequest.of(held, name=title), values)


def _dimensions(state: HullState) -> dict[str, float]:
    """Give the dimensions as they are stored, but the depth as it is measured."""
    ship, measured = state.particulars, measure_all(state, ["depth"])
    return {
        "length": ship.length, "breadth": ship.breadth, "draught": ship.draught,
        "depth": measured.get("depth", ship.depth),
    }  # fmt: skip
