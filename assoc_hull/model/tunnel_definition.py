"""Tunnels that a hull holds: cylinders athwartships, told by axis and radius alone.

Where a tunnel meets the shell lies in no table. It is computed of the lines as they are, so it
follows every edit: `assoc_hull.analysis.hydrostatics.tunnel` measures it.
"""

from __future__ import annotations

from collections.abc import Iterable

import attrs

from assoc_hull.arguments import checked, number, plain, positive, word

__all__ = ["TunnelDefinition", "tunnels_in_order"]

_WHERE = "in a tunnel"


@attrs.frozen
class TunnelDefinition:
    """A tunnel athwartships, from shell to shell.

    Attributes
    ----------
    name : str
        What it is called.
    x, z : float, m
        Of its axis, from AP and from the base line.
    radius : float, m
        Of its inside.

    Examples
    --------
    >>> from assoc_hull.model.tunnel_definition import TunnelDefinition
    >>> TunnelDefinition("bow thruster", 88.0, 3.0, 0.8).radius
    0.8
    """

    name: str = attrs.field(validator=checked(word, _WHERE))
    x: float = attrs.field(converter=plain, validator=checked(number, _WHERE))
    z: float = attrs.field(converter=plain, validator=checked(number, _WHERE))
    radius: float = attrs.field(converter=plain, validator=checked(positive, _WHERE))


def tunnels_in_order(tunnels: Iterable[TunnelDefinition]) -> tuple[TunnelDefinition, ...]:
    """Give tunnels by name: the order in which they were made plays no part in a hull."""
    return tuple(sorted(tunnels, key=lambda each: each.name))
