"""Where a ship comes to rest: draughts, trim and heel for a weight and its centre.

She heels away from upright as long as GZ is negative, and stops where it rises through nought:
a list where G lies off the centre plane, an angle of loll where GM is negative.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.bracketed_roots import sign_changes
from assoc_hull.analysis.hydrostatics.draughts_from_weight import weight_in_tons
from assoc_hull.analysis.hydrostatics.floating_body import (
    Appendage,
    FloatingBody,
    FloatingPosition,
)
from assoc_hull.analysis.hydrostatics.flotation import body_of, header_of
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import doubts_of
from assoc_hull.analysis.hydrostatics.record import SALT, HydrostaticHeader
from assoc_hull.analysis.stability.condition import (
    Condition,
    ConditionRequest,
    OnError,
    case_of,
    checked_on_error,
    condition_of,
)
from assoc_hull.analysis.stability.flooding import open_deck_limit
from assoc_hull.analysis.stability.righting_lever import HeeledShip, StabilityCase, float_at_heels
from assoc_hull.arguments import number
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.tables import HasState

__all__ = ["Equilibrium", "equilibrium", "equilibrium_of"]

_WHERE = "in an equilibrium"
_STEPS = np.array([1.0, 2.0, 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 85.0])
"""Heels that are tried, degrees."""

_SOON = 6
"""So many of them first."""

_LEAST = 1e-3
"""Degrees: beyond this an unstable ship is past upright."""

_RIM = 1e-6
"""Degrees by which the edge of an open deck is not come nearer to."""

_NONE = 1e-12
"""A lever (m) that is rounding."""


@attrs.frozen
class Equilibrium:
    """Where a ship comes to rest.

    Attributes
    ----------
    position : FloatingPosition
        Draughts and heel.
    kind : "upright", "list" or "loll"
        Whether she is upright, or heels for a centre of gravity off the centre plane, or because
        she is unstable upright; then she may rest as well at the same heel to the other side.
    gm : float, m
        At rest: the growth of GZ per radian; above 0, for else she would not rest.
    gm_upright : float, m
        At no heel.
    condition : Condition
        Weight, its centre, and the equilibrium lengthwise at no heel.
    notes : tuple of str
        What else there is to say.
    """

    position: FloatingPosition
    kind: Literal["upright", "list", "loll"]
    gm: float
    gm_upright: float
    condition: Condition
    notes: tuple[str, ...]

    @property
    def stable_upright(self) -> bool:
        """GM is above 0 at no heel."""
        return self.gm_upright > 0.0


def equilibrium(
    hull: HasState,
    weight: float,
    *,
    lcg: float,
    kg: float,
    tcg: float = 0.0,
    rho: float = SALT,
    shell_factor: float = 1.0,
    appendages: Iterable[Appendage] = (),
    on_error: OnError = "refuse",
) -> Equilibrium:
    """Find the draughts and the heel at which a ship comes to rest from upright.

    The arguments and what is raised are those of `Hull.equilibrium`.
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": number(kg, "kg", _WHERE),
        "appendages": appendages, "fingerprint": "",
    }  # fmt: skip
    checked_on_error(on_error)
    body = body_of(hull)
    header = header_of(hull, body, terms)
    ahead, aside = number(lcg, "lcg", _WHERE), number(tcg, "tcg", _WHERE)
    found = equilibrium_of(
        body, header, ConditionRequest(weight_in_tons(weight), None, None, ahead, aside, header.kg)
    )
    doubts = doubts_of(body, header, [found.position], on_error, _WHERE)
    return attrs.evolve(found, notes=(*found.notes, *doubts))


def equilibrium_of(
    body: FloatingBody, header: HydrostaticHeader, asked: ConditionRequest
) -> Equilibrium:
    """Find where a floating body comes to rest; as `equilibrium`, of which it is the inner part."""
    condition = condition_of(body, header, asked)
    case = case_of(body, header, [condition], "free")
    upright = float_at_heels(case, np.zeros(1))
    gz, gm = float(upright.gz[0]), float(upright.growth[0])
    notes: tuple[str, ...] = (f"the deck is {header.deck}",)
    if abs(gz) <= _NONE and gm > 0.0:
        return Equilibrium(_position(case, upright), "upright", gm, gm, condition, notes)
    side = -1.0 if gz > _NONE else 1.0
    limit = None if body.limits.closed else open_deck_limit(case, condition, int(side))
    kind: Literal["list", "loll"] = "loll" if abs(gz) <= _NONE else "list"
    rest = _rest(case, side, limit, loll=kind == "loll")
    if kind == "loll":
        notes = (*notes, "unstable upright: she may rest as well at this heel to port")
    return Equilibrium(_position(case, rest), kind, float(rest.growth[0]), gm, condition, notes)


def _rest(case: StabilityCase, side: float, limit: float | None, *, loll: bool) -> HeeledShip:
    """Give the ship at the first heel at which her lever rises through nought."""
    at = np.append(_LEAST if loll else 0.0, _STEPS)
    if limit is not None:
        at = np.append(at[at < limit], max(limit - _RIM, at[0]))
    for some in (at[:_SOON], at):  # most ships are at rest soon
        tried = float_at_heels(case, side * some)
        levers = side * tried.gz
        levers[0] = -np.inf  # she goes on from upright
        rights = np.flatnonzero(levers >= 0.0)
        if len(rights):
            break
    if not len(rights):
        before = f"up to {at[-1]:g} deg"
        if limit is not None:
            before = f"before the edge of the open deck goes under at {limit:.2f} deg"
        raise BadInputError(
            f"she does not come to rest {before}", _WHERE, "lower KG, or bring TCG nearer to 0"
        )
    first = int(rights[0])

    def lever(heel: FloatArray, _: IntArray) -> FloatArray:
        return side * float_at_heels(case, side * heel, near=tried).gz

    heel = sign_changes(lever, at[[first - 1]], at[[first]])
    return float_at_heels(case, side * heel, near=tried)


def _position(case: StabilityCase, at: HeeledShip) -> FloatingPosition:
    lift = 0.5 * case.afloat.length * float(at.slope[0])
    mean = float(at.mean[0])
    return FloatingPosition(mean - lift, mean + lift, float(at.heel_deg[0]))
