"""Tunnels of a hull that cannot be: their mouths leave the shell, or two of them meet."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import combinations

from assoc_hull.analysis.hydrostatics.tunnel import kept_mouths
from assoc_hull.errors import BadInputError
from assoc_hull.model.tables import HullState
from assoc_hull.model.tunnel_definition import TunnelDefinition

__all__ = ["tunnel_findings", "tunnels_that_meet"]


def tunnel_findings(state: HullState) -> tuple[str, ...]:
    """Say which tunnels leave the hull as it has become, and which meet."""
    if not state.tunnels:
        return ()
    left = [each for each in kept_mouths(state) if isinstance(each, BadInputError)]
    told = [
        f"the tunnel {each.what}; move it with set_tunnel, or remove it before" for each in left
    ]
    return (*told, *tunnels_that_meet(state.tunnels))


def tunnels_that_meet(tunnels: Sequence[TunnelDefinition]) -> tuple[str, ...]:
    """Say of which tunnels the walls meet."""
    found = []
    for one, other in combinations(tunnels, 2):
        apart, need = math.hypot(one.x - other.x, one.z - other.z), one.radius + other.radius
        if apart <= need:
            found.append(
                f"the tunnels {one.name!r} and {other.name!r} meet: their axes are {apart:.4g} m "
                f"apart, and their radii are {need:.4g} m together"
            )
    return tuple(found)
