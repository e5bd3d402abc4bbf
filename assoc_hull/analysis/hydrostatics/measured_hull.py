"""A hull as hydrostatics measures it, and the head of what comes of it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from assoc_hull.analysis.hydrostatics.floating_body import FloatingBody
from assoc_hull.analysis.hydrostatics.hydrostatic_header import HydrostaticHeader
from assoc_hull.errors import WrongTypeError
from assoc_hull.model.definition.definition import fingerprint
from assoc_hull.model.state import HullState

__all__ = ["HasState", "body_of", "header_of", "state_of"]


class HasState(Protocol):
    """A hull."""

    @property
    def state(self) -> HullState:
        """Its tables."""
        ...


def state_of(hull: HasState, where: str = "in hydrostatics") -> HullState:
    """Take a hull, and give its tables; `where` is for the message.

    Raises
    ------
    WrongTypeError
        No hull was given; tables alone are none.
    """
    state: object = getattr(hull, "state", None)
    if not isinstance(state, HullState):
        # The value itself is not shown: tables are long.
        what = f"the hull is a {type(hull).__name__}"
        raise WrongTypeError(what, where, "give a Hull")
    return state


def body_of(hull: HasState) -> FloatingBody:
    """Make what can be measured of a hull."""
    # The one place where hydrostatics meets the integrals of a net.
    from assoc_hull.analysis.hydrostatics.flotation import flotation

    body: FloatingBody = flotation(state_of(hull))
    return body


def header_of(hull: HasState, body: FloatingBody, terms: Mapping[str, object]) -> HydrostaticHeader:
    """Head the numbers: dimensions of the hull, and what the caller chose.

    Parameters
    ----------
    hull : Hull
        The hull.
    body : FloatingBody
        What is measured of it.
    terms : mapping
        Fields of the header that the caller chose. The fingerprint takes longer than the algebra
        of one position: who shows none gives an empty one.
    """
    state = state_of(hull)
    ship = state.particulars
    chosen: dict[str, object] = {
        "kg": None, "keel_thickness": 0.0, "transom": False, "date": None, **terms
    }  # fmt: skip
    if "fingerprint" not in chosen:
        chosen["fingerprint"] = fingerprint(state)
    return HydrostaticHeader(
        ship=ship.name, length=ship.length, breadth=ship.breadth, draught=ship.draught,
        deck="closed" if body.limits.closed else "open", **chosen,  # type: ignore[arg-type]
    )  # fmt: skip
