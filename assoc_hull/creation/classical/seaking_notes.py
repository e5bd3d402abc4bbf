"""What is to be said of a ship by boundary data: odd data, and what its net leaves out."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from assoc_hull.geometry.classical.checks import figure
from assoc_hull.geometry.classical.frame import Frame

if TYPE_CHECKING:
    from assoc_hull.creation.classical.seaking import Seaking
    from assoc_hull.creation.classical.seaking_sections import Section

__all__ = ["corrugation", "notes_of"]

_APART = 1e-3
"""A waterline that lies farther (m) than this from the midship section is told."""


def notes_of(ship: Seaking) -> tuple[str, ...]:
    """Give all notes of a definition, a sentence each."""
    built = ship.sections(ship.frames)
    of_frames = [each for section in built for each in section.notes]
    return (
        *ship.told, *ship.keel.notes, *_beside_midship(ship), *_gathered(of_frames),
        *corrugation(built), *_left_out(ship),
    )  # fmt: skip


def corrugation(sections: list[Section]) -> tuple[str, ...]:
    """Tell the largest tangent jump of frames that are built of parabolas, if there are any."""
    built = [each for each in sections if isinstance(each, Frame)]
    if not built:
        return ()
    worst = max(built, key=lambda each: each.largest_jump)
    return (
        f"frames are continuous only: their direction jumps by up to "
        f"{figure(round(worst.largest_jump, 4))} rad at given points (frame x={figure(worst.x)})",
    )


def _gathered(notes: list[str]) -> list[str]:
    """Let notes that differ in the frame only stand once, with their number."""
    parted: dict[str, list[str]] = {}
    for each in notes:
        what = each.partition(": ")[2].partition(" at z=")[0].partition(" (")[0]
        parted.setdefault(what, []).append(each)
    return [
        several[0] if len(several) == 1 else f"{several[0]} (and {len(several) - 1} more like it)"
        for several in parted.values()
    ]


def _beside_midship(ship: Seaking) -> list[str]:
    """Tell of waterlines that miss the midship section, and of the jump of area at its ends."""
    if ship.parallel is None:
        return []
    first, last = ship.parallel.first, ship.parallel.last
    found = []
    for line in ship.waterlines:
        x = np.clip([first, 0.5 * (first + last), last], *line.ends)
        wanted = float(ship.parallel.section.half_breadths(line.z))
        away = float(np.abs(line.at(x) - wanted).max())
        if away > _APART:
            found.append(
                f"{line.name}: lies up to {1e3 * away:.1f} mm off the midship section over its "
                "parallel part"
            )
    inner = np.append(ship.keel.tangent[:, 0], [first, last])
    inner = inner[(inner >= first) & (inner <= last)]
    section = ship.parallel.section
    flat = section.flat if section.rise else section.floor_point[0]
    away = float(np.abs(ship.keel.flat(inner) - flat).max())
    if away > _APART:
        found.append(
            f"bottom tangent line: lies up to {1e3 * away:.1f} mm off the edge of the flat of "
            "the midship section"
        )
    found += [
        f"knuckle line {each.name!r}: is not looked at between x={figure(first)} and "
        f"{figure(last)}, where the midship section stands"
        for each in ship.knuckles
        if each.line.ends[0] < last and each.line.ends[1] > first
    ]
    return found


def _left_out(ship: Seaking) -> list[str]:
    """Tell what the net does not hold."""
    found = []
    if len(ship.camber.rise) or len(ship.camber.corner):
        found.append(
            "camber and rounded corners of the deck are not in the net: it ends at the deck side"
        )
    steps = ship.deck.x[1:][ship.deck.code == 0].tolist()
    if steps:
        found.append(
            f"deck side: it steps at x={', '.join(map(figure, steps))}; near there the net is "
            "rough above the lower deck"
        )
    if ship.appendages:
        names = ", ".join(each.name for each in ship.appendages)
        found.append(f"appendages are not in the net: {names}")
    return found
