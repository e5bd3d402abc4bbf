"""Tunnels of a hull that cannot be: their mouths leave the shell, or two of them meet."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from itertools import combinations

from assoc_hull.analysis.hydrostatics.tunnel import kept_mouths
from assoc_hull.edit.checks.finding import Finding
from assoc_hull.errors import BadInputError
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState
from assoc_hull.model.tunnel_definition import TunnelDefinition

__all__ = ["find_lost_tunnels", "tunnel_findings", "tunnels_that_meet"]


def find_lost_tunnels(state: HullState, _: AddressBook) -> Iterator[Finding]:
    """Report tunnels that leave the hull, and those that meet: no edit makes such, a file may."""
    for each, mouth in zip(state.tunnels, kept_mouths(state) if state.tunnels else (), strict=True):
        if isinstance(mouth, BadInputError):
            clause = mouth.what.partition("' ")[2]
            remedy = "set it elsewhere with edit.set_tunnel, or remove it"
            yield Finding("tunnel", each.name, (each.x, 0.0, each.z), None, f"{clause}: {remedy}")
    for one, other, told in _meetings(state.tunnels):
        place = 0.5 * (one.x + other.x), 0.0, 0.5 * (one.z + other.z)
        yield Finding("tunnel", one.name, place, None, f"meets another: {told}")


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
    return tuple(told for _, _, told in _meetings(tunnels))


def _meetings(
    tunnels: Sequence[TunnelDefinition],
) -> Iterator[tuple[TunnelDefinition, TunnelDefinition, str]]:
    """Give each pair of tunnels whose walls meet, and how near they are in words."""
    for one, other in combinations(tunnels, 2):
        apart, need = math.hypot(one.x - other.x, one.z - other.z), one.radius + other.radius
        told = (
            f"the tunnels {one.name!r} and {other.name!r} meet: their axes are {apart:.4g} m "
            f"apart, and their radii are {need:.4g} m together"
        )
        if apart <= need:
            yield one, other, told
