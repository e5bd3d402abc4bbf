"""Tunnels athwartships: kept in the hull, and changed. No line moves."""

from __future__ import annotations

import attrs

from assoc_hull.analysis.hydrostatics.tunnel import mouth_of
from assoc_hull.arguments import number, positive
from assoc_hull.edit.checks.tunnel_findings import tunnels_that_meet
from assoc_hull.edit.modifications.attachments import held_by_name, put, refuse_taken
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.model.tables import HullState
from assoc_hull.model.tunnel_definition import TunnelDefinition

__all__ = ["add_tunnel", "set_tunnel"]


def add_tunnel(edit: Transaction, name: str, x: float, z: float, radius: float) -> None:
    """Keep a tunnel through the hull.

    Raises
    ------
    NameTakenError
        Something else has the name.
    BadInputError, OutOfRangeError
        It leaves the hull as that is now, or meets another tunnel.
    """
    refuse_taken(edit.state, name)
    put(edit, None, _checked(edit, TunnelDefinition(name, x, z, radius), "in tunnel"))


def set_tunnel(
    edit: Transaction, name: str, x: float | None, z: float | None, radius: float | None
) -> None:
    """Give a tunnel another axis or radius.

    Raises
    ------
    UnknownNameError
        There is none of that name.
    BadInputError, OutOfRangeError
        As for `add_tunnel`; or nothing is given.
    """
    where, old = "in set_tunnel", held_by_name(edit.state, TunnelDefinition, name)
    if x is None and z is None and radius is None:
        raise BadInputError(f"nothing is given for {old.name!r}", where, "give x, z or radius")
    new = TunnelDefinition(
        old.name, old.x if x is None else x, old.z if z is None else z,
        old.radius if radius is None else radius,
    )  # fmt: skip
    put(edit, old, _checked(edit, new, where, old))


def _checked(
    edit: Transaction, made: TunnelDefinition, where: str, old: TunnelDefinition | None = None
) -> TunnelDefinition:
    """Take a tunnel that lies within the hull as it is now, and meets no other."""
    state = edit.state
    found = attrs.evolve(
        made, x=number(made.x, "x", where) + 0.0, z=number(made.z, "z", where) + 0.0,
        radius=positive(made.radius, "radius", where),
    )  # fmt: skip
    low, high = _ends(state)
    if not low < found.x < high:
        why = f"lies outside the ship, for {found.name!r}"
        raise OutOfRangeError("x", found.x, where, why, low, high, "m")
    mouth_of(state, found.name, found.x, found.z, found.radius)
    others = [each for each in state.tunnels if each is not old]
    if meeting := tunnels_that_meet([*others, found]):
        raise BadInputError(meeting[0], where, "set them farther apart, or give smaller radii")
    return found


def _ends(state: HullState) -> tuple[float, float]:
    """Give where the hull begins and ends, x, m, by the points of its lines."""
    x = state.rows.xyz[state.live("rows"), 0]
    return float(x.min()), float(x.max())
