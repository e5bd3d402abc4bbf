"""The numbers of a ship of main types, and those of a net of it beside them."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.creation.classical.prelikon_lines import name_of
from assoc_hull.creation.classical.prelikon_sums import Sum
from assoc_hull.creation.classical.report import (
    ClassicalReport,
    Figure,
    Section,
    beside_net,
    departures,
    measure_net,
)
from assoc_hull.model.state import HullState

if TYPE_CHECKING:
    from assoc_hull.creation.classical.prelikon import Prelikon

__all__ = ["report_of"]

_STEP = 0.1
"""Distance (m) of the places of a section that are sought in the net."""


def report_of(ship: Prelikon, state: HullState | None) -> ClassicalReport:
    """Tell volumes and centres of hull, boxes and houses.

    Parameters
    ----------
    ship : Prelikon
        The ship.
    state : HullState or None
        A net of it.
    """
    hull, notes = beside_net(partial(_of_hull, ship), state)
    figures = (*hull, *_of_boxes(ship), *_of_houses(ship))
    away = () if state is None else departures(state, _sections(ship))
    return ClassicalReport(ship.kind, ship.particulars.name, figures, (*ship.notes, *notes), away)


def _of_hull(ship: Prelikon, state: HullState | None) -> list[Figure]:
    draught = ship.particulars.draught
    side = min(float(each.curve.arcs.ends()[-1, 1]) for each in ship.stations)
    found = []
    for name, height in (("the draught", draught), ("the lowest deck side", side)):
        if height > side:
            continue
        # At the deck itself a closed deck would lie in the plane.
        net = None if state is None else measure_net(state, height - 1e-9)
        own = ship.volume_below(height)
        title = f"hull below {name} {height:g} m"
        found += _volume(title, own, None if net is None else (net.volume, net.x, net.z))
    return [*found, *_volume("hull to the deck, with camber", ship.volume_to_deck(), None)]


def _volume(title: str, own: Sum, net: tuple[float, float, float] | None) -> list[Figure]:
    beside = (None, None, None) if net is None else net
    return [
        Figure(f"{title}: volume", own.volume, "m3", beside[0], own.error),
        Figure(f"{title}: centre x", own.x, "m", beside[1]),
        Figure(f"{title}: centre z", own.z, "m", beside[2]),
    ]


def _of_boxes(ship: Prelikon) -> list[Figure]:
    found = []
    for each in ship.boxes:
        found.append(Figure(f"{each.name}: volume", each.volume, "m3"))
        for axis, at in zip("xyz", each.centroid, strict=True):
            found.append(Figure(f"{each.name}: centre {axis}", at, "m"))
    return found


def _of_houses(ship: Prelikon) -> list[Figure]:
    found = []
    for each in ship.houses:
        found.append(Figure(f"{each.name}: volume", each.volume, "m3"))
        found.append(Figure(f"{each.name}: profile area", each.profile_area, "m2"))
        found.append(Figure(f"{each.name}: centre x", each.centroid[0], "m"))
        found.append(Figure(f"{each.name}: centre z", each.centroid[2], "m"))
    return found


def _sections(ship: Prelikon) -> list[Section]:
    found = []
    for k, each in enumerate(ship.stations):
        yz = each.curve.sampled(_STEP)
        area = each.curve.moments_below(np.inf)[0]
        name = name_of(ship.stations, k, ship.profile.flat)
        found.append(Section(name, np.column_stack([np.full(len(yz), each.x), yz]), area))
    return found
