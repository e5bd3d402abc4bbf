"""What is to be said of a ship of portions beside its numbers."""

from __future__ import annotations

from collections.abc import Sequence

from assoc_hull.creation.classical.sfolds_portion import Portion
from assoc_hull.geometry.classical.checks import figure

__all__ = ["notes_of"]


def notes_of(portions: Sequence[Portion]) -> tuple[str, ...]:
    """Give what is odd about sections, once each, and what a net leaves out."""
    found, seen = [], set[int]()
    for portion in portions:
        for x, section in zip(portion.stations.tolist(), portion.sections, strict=False):
            if id(section) not in seen:
                seen.add(id(section))
                found += [
                    f"{n}, at x={figure(x)} of portion {portion.number}" for n in section.notes
                ]
    for portion in portions:
        if not portion.is_main:
            found.append(
                f"portion {portion.number} ({portion.kind}) is a body of its own: its volume is "
                "told here, it is not in a net"
            )
    return tuple(found)
