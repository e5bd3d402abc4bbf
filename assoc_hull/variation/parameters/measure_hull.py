"""Measures of the whole hull: dimensions and deck."""

from __future__ import annotations

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.variation.parameters.anchor import Anchor
from assoc_hull.variation.parameters.drawn_curves import Drawn

__all__ = ["breadth", "deck_height", "depth", "draught", "fore_end_at_draught", "length"]

_NO_DECK = "parent has no deck edge amidships"


def fore_end_at_draught(hull: Drawn) -> FloatArray | None:
    """Give where the stem passes the design draught, (3,), m; None without a profile there.

    Of several places the aftmost: before it lies the bulb, where its top is above the draught.
    """
    xyz = hull.across(hull.profile, 2, hull.ship.draught).xyz
    fore = xyz[xyz[:, 0] > hull.middle]
    if not len(fore):
        return None
    found: FloatArray = fore[int(fore[:, 0].argmin())]
    return found


def length(hull: Drawn) -> Anchor:
    """Give Lpp as stored; `stem`: x at which the profile passes the design draught."""
    stem = fore_end_at_draught(hull)
    aft = [0.0, 0.0, hull.ship.draught]
    return Anchor(
        "length", "m", hull.length, "the stored particular",
        [aft, [hull.length, 0.0, hull.ship.draught]], hull.keys(hull.profile),
        {} if stem is None else {"stem": float(stem[0])},
    )  # fmt: skip


def breadth(hull: Drawn) -> Anchor:
    """Give twice the greatest y of all curves."""
    place = hull.extreme(range(hull.net.batch.count), 1)
    return Anchor(
        "breadth", "m", 2.0 * float(place[1]), "twice the greatest y of all curves", [place]
    )


def draught(hull: Drawn) -> Anchor:
    """Give the stored design draught."""
    place = [hull.middle, 0.0, hull.ship.draught]
    return Anchor("draught", "m", hull.ship.draught, "the stored particular", [place])


def depth(hull: Drawn) -> Anchor:
    """Give the height of the deck edge amidships."""
    place = _deck_at(hull, hull.middle)
    if place is None:
        return Anchor("depth", "m", None, reason=_NO_DECK)
    return Anchor(
        "depth", "m", float(place[2]), "deck edge amidships", [place], hull.keys(hull.deck_edge)
    )


def deck_height(hull: Drawn) -> Anchor:
    """Give the height of the deck edge amidships, from which the deck is raised as it is.

    `at_AP`, `at_midship`, `at_FP`: its heights there, where it reaches so far.
    """
    at = {"at_midship": hull.middle, "at_AP": 0.0, "at_FP": hull.length}
    found = {name: _deck_at(hull, x) for name, x in at.items()}
    there = {name: place for name, place in found.items() if place is not None}
    if "at_midship" not in there:
        return Anchor("deck_height", "m", None, reason=_NO_DECK)
    return Anchor(
        "deck_height", "m", float(there["at_midship"][2]), "deck edge amidships",
        np.array(list(there.values())), hull.keys(hull.deck_edge),
        {name: float(place[2]) for name, place in there.items()},
    )  # fmt: skip


def _deck_at(hull: Drawn, x: float) -> FloatArray | None:
    """Give the highest place of the deck edge at an x, (3,), m."""
    xyz = hull.across(hull.deck_edge, 0, x).xyz
    if not len(xyz):
        return None
    found: FloatArray = xyz[int(xyz[:, 2].argmax())]
    return found
