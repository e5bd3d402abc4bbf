"""The numbers of a ship of portions, and those of a net of it beside them."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.creation.classical.report import (
    ClassicalReport,
    Figure,
    Section,
    beside_net,
    departures,
    measure_net,
)
from assoc_hull.creation.classical.sfolds_lines import Frame, frames_of, name_of
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.model.state import HullState

if TYPE_CHECKING:
    from assoc_hull.creation.classical.sfolds import Sfolds

__all__ = ["report_of"]

_SAMPLES = 16
"""Places on each step of a section that are sought in the net."""


def report_of(ship: Sfolds, state: HullState | None) -> ClassicalReport:
    """Tell the volumes and centres of a ship of portions.

    Parameters
    ----------
    ship : Sfolds
        The ship.
    state : HullState or None
        A net of it.
    """
    figures = [*_of_portions(ship), *_of_whole(ship)]
    notes: tuple[str, ...] = ()
    if any(each.is_main and each.sections for each in ship.portions):
        below, notes = beside_net(partial(_below, ship), state)
        figures += below
    away = () if state is None else departures(state, _sections(ship))
    return ClassicalReport(
        ship.kind, ship.particulars.name, tuple(figures), (*ship.notes, *notes), away
    )


def _of_portions(ship: Sfolds) -> list[Figure]:
    found = []
    for number, each in enumerate(ship.portions, start=1):
        title = f"{number}. {each.kind}"
        found.append(Figure(f"{title}: volume", each.volume, "m3"))
        if each.volume:
            found.append(Figure(f"{title}: centre x", each.centre_x, "m"))
        if each.volume and each.sections:
            found.append(Figure(f"{title}: centre z", each.centre_z, "m"))
    return found


def _of_whole(ship: Sfolds) -> list[Figure]:
    main = sum(each.volume for each in ship.portions if each.is_main)
    rest = [each.volume for each in ship.portions if not each.is_main]
    found = [Figure("main body: volume, with camber", float(main), "m3")]
    if rest:
        found.append(Figure("other bodies: volume", float(sum(rest)), "m3"))
    x, z = ship.centre if ship.volume else (np.nan, np.nan)
    found.append(Figure("whole: volume, with camber", ship.volume, "m3"))
    named = (("x", x), ("z", z))
    found += [Figure(f"whole: centre {axis}", at, "m") for axis, at in named if np.isfinite(at)]
    return found


def _below(ship: Sfolds, state: HullState | None) -> list[Figure]:
    """Tell the volume of the main body below draught and deck, and of the net."""
    main = [each for each in ship.portions if each.is_main]
    if not all(each.sections for each in main):
        return []
    deck = min(section.hd for each in main for section in each.sections)
    heights = {"the lowest deck side": deck}
    if ship.particulars.draught < deck:
        heights = {"the draught": ship.particulars.draught} | heights
    found = []
    for name, height in heights.items():
        # At the deck itself a closed deck would lie in the plane.
        net = None if state is None else measure_net(state, height - 1e-9)
        title = f"main body below {name} {height:g} m"
        volume = ship.volume_below(height)
        found.append(Figure(f"{title}: volume", volume, "m3", None if net is None else net.volume))
        if volume:
            x = sum(each.moment_x_below(height) for each in main) / volume
            found.append(Figure(f"{title}: centre x", x, "m", None if net is None else net.x))
    return found


def _sections(ship: Sfolds) -> list[Section]:
    frames = frames_of(ship.portions)
    return [
        Section(name_of(frames, k), _places(frame), frame.section.area_below(frame.section.hd) / 2)
        for k, frame in enumerate(frames)
        if not frame.is_point
    ]


def _places(frame: Frame) -> FloatArray:
    """Give places on the curve of a section, (n, 3), m."""
    c0, c1, c2 = frame.section.steps().transpose(1, 0, 2)
    u = (np.arange(_SAMPLES + 1) / _SAMPLES)[:, None, None]
    yz = (c0 + u * (c1 + u * c2)).transpose(1, 0, 2).reshape(-1, 2)
    return np.column_stack([np.full(len(yz), frame.x), yz])
