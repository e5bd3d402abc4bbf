"""Tunnels athwartships: kept in the hull, changed, taken away. No line moves."""

from __future__ import annotations

import attrs

from assoc_hull.analysis.hydrostatics.tunnel import mouth_of
from assoc_hull.arguments import number, plain_name, positive, shown_name
from assoc_hull.edit.checks.tunnel_findings import tunnels_that_meet
from assoc_hull.edit.modifications.names import taken_names
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, NameTakenError, OutOfRangeError, UnknownNameError
from assoc_hull.model.tables import HullState
from assoc_hull.model.tunnel_definition import TunnelDefinition, tunnels_in_order

__all__ = ["add_tunnel", "is_tunnel", "remove_tunnel", "rename_tunnel", "set_tunnel"]


def add_tunnel(edit: Transaction, name: str, x: float, z: float, radius: float) -> None:
    """Keep a tunnel through the hull.

    Raises
    ------
    NameTakenError
        A group, a line, a point or a tunnel has the name.
    BadInputError, OutOfRangeError
        It leaves the hull as that is now, or meets another tunnel.
    """
    _refuse_taken(edit.state, name)
    _put(edit, None, _checked(edit, TunnelDefinition(name, x, z, radius), "in tunnel"))


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
    where, old = "in set_tunnel", _found(edit.state, name)
    if x is None and z is None and radius is None:
        raise BadInputError(f"nothing is given for {old.name!r}", where, "give x, z or radius")
    new = TunnelDefinition(
        old.name, old.x if x is None else x, old.z if z is None else z,
        old.radius if radius is None else radius,
    )  # fmt: skip
    _put(edit, old, _checked(edit, new, where, old))


def remove_tunnel(edit: Transaction, name: str) -> None:
    """Take a tunnel away.

    Raises
    ------
    UnknownNameError
        There is none of that name.
    """
    _put(edit, _found(edit.state, name), None)


def rename_tunnel(edit: Transaction, name: str, new: str) -> None:
    """Give a tunnel another name.

    Raises
    ------
    UnknownNameError
        There is none of that name.
    NameTakenError
        Something else has the new one.
    """
    old = _found(edit.state, name)
    if new != old.name:
        _refuse_taken(edit.state, new, but=old)
        _put(edit, old, attrs.evolve(old, name=new))


def is_tunnel(state: HullState, name: object) -> bool:
    """Tell whether a tunnel is called so."""
    return isinstance(name, str) and _named(state, name) is not None


def _named(state: HullState, name: str) -> TunnelDefinition | None:
    """Give the tunnel of a name, however a person writes it."""
    exact = [each for each in state.tunnels if each.name == name]
    alike = exact or [each for each in state.tunnels if plain_name(each.name) == plain_name(name)]
    return alike[0] if alike else None


def _found(state: HullState, name: object) -> TunnelDefinition:
    found = _named(state, name) if isinstance(name, str) else None
    if found is None:
        raise UnknownNameError("tunnel", shown_name(name), tuple(t.name for t in state.tunnels))
    return found


def _refuse_taken(state: HullState, name: str, but: TunnelDefinition | None = None) -> None:
    plain = plain_name(name)
    taken = taken_names(state) - ({but.name} if but else set())
    if any(plain_name(each) == plain for each in taken):
        raise NameTakenError("group, line, point or tunnel", name)


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


def _put(edit: Transaction, old: TunnelDefinition | None, new: TunnelDefinition | None) -> None:
    kept = [each for each in edit.state.tunnels if each is not old]
    found = tunnels_in_order([*kept, *(() if new is None else (new,))])
    edit.journal.set(edit.state.settings.tunnels, [0], [found])
