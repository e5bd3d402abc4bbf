"""Tunnels that a mapping of space carries: the axis goes with it, the radius stays."""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.graph.journal import Journal
from assoc_hull.model.tables import HullState

__all__ = ["carry_tunnels"]


def carry_tunnels(state: HullState, journal: Journal, space: SpaceMap) -> list[str]:
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
