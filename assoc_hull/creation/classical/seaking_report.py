"""The own numbers of a ship by boundary data, beside those of its net."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.creation.classical.report import (
    ClassicalReport,
    Figure,
    departures,
    measure_net,
)
from assoc_hull.creation.classical.report import Section as Drawn
from assoc_hull.creation.classical.seaking_lines import frame_name
from assoc_hull.creation.classical.seaking_sections import drawn_of, half_area
from assoc_hull.creation.classical.seaking_sums import sums
from assoc_hull.model.state import HullState

if TYPE_CHECKING:
    from assoc_hull.creation.classical.seaking import Seaking

__all__ = ["report_of"]


def report_of(ship: Seaking, state: HullState | None) -> ClassicalReport:
    """Measure a definition, and a net of it if one is handed in.

    Volumes and centres are without appendages; theirs stand below, with their sign.
    """
    draught = ship.particulars.draught
    wet, whole = sums(ship, [draught, None])
    net = None if state is None else measure_net(state, draught)
    built = ship.sections(ship.frames)
    areas = np.array([each.area(draught) for each in built])
    largest = int(areas.argmax())
    worst = max(built, key=lambda each: each.largest_jump)
    at = f"below {draught:g} m"
    own = (wet.volume, wet.x, wet.z, wet.waterplane)
    nets = (None,) * 4 if net is None else (net.volume, net.x, net.z, net.area)
    names = (
        (f"volume {at}", "m3", wet.error), (f"centre of volume {at}, x", "m", None),
        (f"centre of volume {at}, z", "m", None), (f"waterplane area at {draught:g} m", "m2", None),
    )  # fmt: skip
    figures = [
        Figure(name, value, unit, beside, error)
        for (name, unit, error), value, beside in zip(names, own, nets, strict=True)
    ]
    figures += [
        Figure(f"largest frame area {at}", float(areas[largest]), "m2"),
        Figure(f"largest frame area {at}, x", float(ship.frames[largest]), "m"),
        Figure("volume with its decks", whole.volume, "m3", None, whole.error),
        Figure("largest tangent jump of a frame", worst.largest_jump, "rad"),
        Figure("largest tangent jump of a frame, x", worst.x, "m"),
    ]
    for each in ship.appendages:
        figures.append(Figure(f"volume of {each.name}", each.volume, "m3"))
        if each.volume:
            x, _, z = (part / each.body.volume for part in each.body.moment)
            figures += [
                Figure(f"centre of {each.name}, x", x, "m"),
                Figure(f"centre of {each.name}, z", z, "m"),
            ]
    away = () if state is None else departures(state, _drawn(ship))
    return ClassicalReport(
        ship.kind, ship.particulars.name, tuple(figures), ship.notes, away
    )  # fmt: skip


def _drawn(ship: Seaking) -> list[Drawn]:
    """Give the frames between the ends as the definition has them."""
    first, last = ship.ends
    inner = ship.frames[(ship.frames > first) & (ship.frames < last)]
    return [
        Drawn(frame_name(each.x), np.insert(drawn_of(each), 0, each.x, axis=1), half_area(each))
        for each in ship.sections(inner)
    ]
