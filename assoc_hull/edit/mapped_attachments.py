"""Tunnels and bodies beside the net that a mapping of space carries.

The axis of a tunnel goes with the mapping, its radius stays; a body goes point by point.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.edit.space_map import SpaceMap
from assoc_hull.graph.journal import Journal
from assoc_hull.model.attachments import ATTACHMENTS, Attachment
from assoc_hull.model.tables import HullState
from assoc_hull.model.tunnel_definition import TunnelDefinition

__all__ = ["carry_attachments"]


def carry_attachments(state: HullState, journal: Journal, space: SpaceMap) -> list[str]:
    """Carry what a hull holds beside its net; give notes of what moved.

    A mapping is of the port side: what stands to starboard goes as its mirror image does.
    """
    notes = list[str]()
    for kind in ATTACHMENTS:
        was = kind.of(state)[0]
        if not was:
            continue
        points = np.concatenate([each.carriers for each in was])
        side = np.where(points[:, 1] < 0.0, -1.0, 1.0)
        points[:, 1] *= side
        moved = space.places(points)
        moved[:, 1] *= side
        cuts = np.cumsum([len(each.carriers) for each in was])[:-1]
        parts = np.split(moved, cuts)
        found = tuple(each.carried(part) for each, part in zip(was, parts, strict=True))
        if found != was:
            journal.set(kind.of(state), [0], [found])
            pairs = zip(was, found, strict=True)
            notes += _told([(old, new) for old, new in pairs if new != old])
    return notes


def _told(pairs: Sequence[tuple[Attachment, Attachment]]) -> list[str]:
    """Say what moved: each axis of a tunnel with its numbers, bodies by name."""
    notes, bodies = list[str](), list[str]()
    for old, new in pairs:
        if isinstance(old, TunnelDefinition) and isinstance(new, TunnelDefinition):
            notes.append(
                f"the tunnel {new.name!r} went along: x {old.x:.6g} -> {new.x:.6g}, "
                f"z {old.z:.6g} -> {new.z:.6g} m; its radius stays"
            )
        else:
            bodies.append(new.name)
    return notes + ([f"bodies beside the net went along: {', '.join(bodies)}"] if bodies else [])
