"""Of which pieces a generated line is made where it stands.

A layout is a text of pieces, joined by ``+`` in order along the line. It depends on the definitions
and the place only, never on how the net was edited. The pieces of sections:

==========  ==========================================================================
level       flat of bottom, from the contour outward
siding      half siding, from the contour outward to a corner
curve       from there to the flat of side, or to the draught
arc         the bilge of the parallel middle body
upright     flat of side up to the draught
bulb        the bulb up to its neck
upper       from the neck to the draught
round       a bulb that closes, ahead of the stem
topside     to the flat of side, or to the deck edge
wall        along the flat of side to the deck edge
==========  ==========================================================================

Examples
--------
>>> from assoc_hull.model.forms.layout import joints_of
>>> [kind.name for kind, _ in joints_of("level+curve+topside")]
['TANGENT', 'SMOOTH']
"""

from __future__ import annotations

import itertools

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import EndKind, PointKind
from assoc_hull.model.forms.course_layout import course_layout, deck_layout
from assoc_hull.model.forms.forms import Forms
from assoc_hull.model.forms.middle_body import in_middle_body
from assoc_hull.model.forms.section_bulb import bulb_layout
from assoc_hull.model.forms.waterline_flats import water_layout
from assoc_hull.model.state import Ends

__all__ = ["COURSES", "ends_for", "joints_of", "layout_at"]

COURSES = {
    "profile": "profile",
    "deck centre": "deck_centre",
    "flat of side": "flat_of_side",
    "flat of bottom": "flat_of_bottom",
}
"""Lines that are one course in a plane, and its use."""

_LEAST = 0.01
"""Shorter pieces (m) are left out."""

_ACROSS, _UP, _AHEAD = (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0)
_NONE = (0.0, 0.0, 0.0)

Vector = tuple[float, float, float]

_ROUND = {"bulb": (_ACROSS, None), "round": (_ACROSS, (0.0, -1.0, 0.0))}
"""The directions in which pieces start and end square to the centre plane."""

_STRAIGHT = {"level": _ACROSS, "upright": _UP, "up": _UP, "down": (0.0, 0.0, -1.0), "ahead": _AHEAD}
"""The direction in which pieces that are straight by their nature run."""


def layout_at(forms: Forms, what: str, place: float, part: int = 0) -> str:
    """Give the layout of a line.

    Parameters
    ----------
    forms : Forms
        The definitions.
    what : str
        What is generated.
    place : float, m
        x of a section, z of a waterline; without meaning for others.
    part : int
        The number of the curve, from below, of a section in several.

    Returns
    -------
    str
        Empty where nothing is generated on a waterline.

    Raises
    ------
    BadInputError
        A definition that is needed is missing, or does not reach so far.
    """
    if what in ("section", "transom"):
        return _section(forms, place, part)
    if what == "waterline":
        return water_layout(forms, place)
    if what == "deck edge":
        return deck_layout(forms)
    if what in COURSES:
        return course_layout(forms.needed(COURSES[what], f"for the {what}"))
    raise BadInputError(f"{what!r} cannot be generated", "in a net", "generate a section")


def _section(forms: Forms, x: float, part: int) -> str:
    where = f"at the section x = {x:g} m"
    heights = forms.contour(x)
    if not heights:
        raise BadInputError("the profile does not reach so far", where, "extend it")
    below = bulb_layout(forms, x, part, heights)
    if below == "round":
        return below
    deck = float(forms.value("deck_height", x)[0])
    draught = forms.particulars.draught
    if not deck > max(draught, heights[-1]) + _LEAST:
        raise BadInputError(
            f"the deck edge at z = {deck:g} m is not above the draught and the contour", where,
            "raise deck_height, or let it reach so far",
        )  # fmt: skip
    if heights[0] > draught - _LEAST or below == "":
        return "topside"
    if forms.has("bilge_radius") and in_middle_body(forms, x):
        return "level+arc+upright+topside"
    side = float(forms.value("flat_of_side", x)[0])
    if below:
        return f"{below}+topside" + ("+wall" if draught + _LEAST < side < deck - _LEAST else "")
    first = _first(forms, x)
    if side < draught - _LEAST:
        return f"{first}curve+upright+topside"
    if draught + _LEAST < side < deck - _LEAST:
        return f"{first}curve+topside+wall"
    return f"{first}curve+topside"


def _first(forms: Forms, x: float) -> str:
    """Give what lies level beside the contour."""
    if float(forms.value("flat_of_bottom", x, 0.0)[0]) > _LEAST:
        return "level+"
    if float(forms.value("half_siding", x, 0.0)[0]) > _LEAST:
        return "siding+"
    return ""


def joints_of(layout: str) -> list[tuple[PointKind, Vector]]:
    """Give kind and direction at the joints between the pieces of a layout.

    Parameters
    ----------
    layout : str
        From `layout_at`.

    Returns
    -------
    list of (PointKind, (float, float, float))
        One fewer than there are pieces.
    """
    tokens = layout.split("+")
    found = []
    for before, after in itertools.pairwise(tokens):
        old, new = before.partition(":")[0].rstrip("^"), after.partition(":")[0].rstrip("^")
        if old == "siding" or after.endswith("^"):
            found.append((PointKind.KNUCKLE, _NONE))
        elif old in _STRAIGHT or new in _STRAIGHT:
            found.append((PointKind.TANGENT, _STRAIGHT.get(old) or _STRAIGHT[new]))
        elif new == "wall":
            found.append((PointKind.TANGENT, _UP))
        else:
            found.append((PointKind.SMOOTH, _NONE))
    return found


def ends_for(layout: str) -> Ends:
    """Give the end conditions of a line of a layout: tangent where a straight piece ends it."""
    tokens = [each.partition(":")[0].rstrip("^") for each in layout.split("+")]
    given = [_STRAIGHT.get(token) for token in (tokens[0], tokens[-1])]
    first, last = _ROUND.get(tokens[0], (None, None))
    given = [first or given[0], last or given[1]]
    kinds = [EndKind.FREE if each is None else EndKind.TANGENT for each in given]
    return Ends((kinds[0], kinds[1]), (given[0] or _NONE, given[1] or _NONE))
