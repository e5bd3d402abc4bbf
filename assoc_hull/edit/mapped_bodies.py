"""Bodies beside the net that a mapping of space carries, point by point."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.graph.journal import Journal
from assoc_hull.model.tables import HullState

__all__ = ["carry_bodies"]


def carry_bodies(state: HullState, journal: Journal, space: SpaceMap) -> list[str]:
    """Set each body where the mapping takes its points; give a note if any moved.

    A mapping is of the port side: what stands to starboard goes as its mirror image does.
    """
    if not state.bodies:
        return []
    was = state.bodies
    points = np.concatenate([each.points.reshape(-1, 3) for each in was])
    side = np.where(points[:, 1] < 0.0, -1.0, 1.0)
    points[:, 1] *= side
    moved = space.places(points)
    moved[:, 1] *= side
    cuts = np.cumsum([each.points.size // 3 for each in was])[:-1]
    found = tuple(
        attrs.evolve(each, sections=part.reshape(each.points.shape))
        for each, part in zip(was, np.split(moved, cuts), strict=True)
    )
    went = [new.name for new, old in zip(found, was, strict=True) if new != old]
    if not went:
        return []
    journal.set(state.settings.bodies, [0], [found])
    return [f"bodies beside the net went along: {', '.join(went)}"]
