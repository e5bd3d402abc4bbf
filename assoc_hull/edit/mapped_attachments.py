"""Tunnels and bodies beside the net that a mapping of space carries.

The axis of a tunnel goes with the mapping, its radius stays; a body goes point by point.
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.graph.journal import Journal
from assoc_hull.model.tables import HullState

__all__ = ["carry_attachments"]


def carry_attachments(state: HullState, journal: Journal, space: SpaceMap) -> list[str]:
    """Carry what a hull holds beside its net; give notes of what moved."""
    return [*_carry_tunnels(state, journal, space), *_carry_bodies(state, journal, space)]


def _carry_tunnels(state: HullState, journal: Journal, space: SpaceMap) -> list[str]:
    """Set each tunnel where the mapping takes the middle of its axis; give notes of what moved.

    The middle lies in the centre plane, and stays there.
    """
    if not state.tunnels:
        return []
    middle = np.array([[each.x, 0.0, each.z] for each in state.tunnels])
    moved = space.places(middle)
    found = tuple(
        attrs.evolve(each, x=x + 0.0, z=z + 0.0)
        for each, (x, _, z) in zip(state.tunnels, moved.tolist(), strict=True)
    )
    was = state.tunnels
    if found != was:
        journal.set(state.settings.tunnels, [0], [found])
    return [
        f"the tunnel {new.name!r} went along: x {old.x:.6g} -> {new.x:.6g}, "
        f"z {old.z:.6g} -> {new.z:.6g} m; its radius stays"
        for old, new in zip(was, found, strict=True)
        if new != old
    ]


def _carry_bodies(state: HullState, journal: Journal, space: SpaceMap) -> list[str]:
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
