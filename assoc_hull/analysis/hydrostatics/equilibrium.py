"""Of a hull: draughts from weights, freeboard, the heel at which the deck edge goes under."""

from __future__ import annotations

import math
from collections.abc import Iterable

from assoc_hull.analysis.hydrostatics.appendage import Appendage
from assoc_hull.analysis.hydrostatics.floating import FloatingPosition, require_afloat
from assoc_hull.analysis.hydrostatics.freeboard import Freeboard
from assoc_hull.analysis.hydrostatics.freeboard import deck_edge_angle as angle_at
from assoc_hull.analysis.hydrostatics.freeboard import freeboard as freeboard_at
from assoc_hull.analysis.hydrostatics.hydrostatic_header import SALT
from assoc_hull.analysis.hydrostatics.loading import Load
from assoc_hull.analysis.hydrostatics.loading import immersion as float_at
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, body_of, header_of
from assoc_hull.arguments import number, plain, shown
from assoc_hull.errors import BadInputError

__all__ = ["deck_edge_angle", "freeboard", "immersion", "tons"]

_WHERE = "in hydrostatics"


def immersion(
    hull: HasState,
    weight: float,
    *,
    lcg: float | None = None,
    kg: float | None = None,
    trim_by_stern: float = 0.0,
    heel_deg: float = 0.0,
    rho: float = SALT,
    shell_factor: float = 1.0,
    appendages: Iterable[Appendage] = (),
) -> FloatingPosition:
    """Find the draughts at which a hull carries a weight (`loading`).

    Parameters
    ----------
    hull : Hull
        The hull.
    weight : float, t
        All of it.
    lcg, kg : float or None, m
        Centre of gravity from AP and above base; without `lcg` the trim is as given.
    trim_by_stern, heel_deg : m, degrees
        Of the ship; with `lcg` the trim is found, and none may be given.
    rho, shell_factor, appendages
        As for `hydrostatics`.

    Raises
    ------
    OutOfRangeError
        A weight that the hull does not carry, with the range.
    BadInputError
        A number that cannot be used; trim and `lcg` both; no trim at which the hull would float.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.equilibrium import immersion
    >>> from assoc_hull.sources import examples
    >>> round(immersion(examples.wigley(), 2777.8 * 1.025).draught_aft, 2)
    6.25
    """
    body = body_of(hull)
    terms: dict[str, object] = {
        "rho": rho,
        "shell_factor": shell_factor,
        "kg": kg,
        "appendages": appendages,
    }
    header = header_of(hull, body, terms)
    trim = number(trim_by_stern, "trim_by_stern", _WHERE)
    if lcg is not None and trim != 0.0:
        what = f"lcg and a trim_by_stern of {trim:g} m are both given"
        raise BadInputError(what, _WHERE, "give one of them: with lcg the trim is found")
    load = Load(
        # What is no finite number is refused with the range, which needs the hull.
        tons(weight),
        header.rho,
        header.shell_factor,
        None if lcg is None else number(lcg, "lcg", _WHERE),
        header.kg,
        trim,
        FloatingPosition(0.0, 0.0, heel_deg).heel_deg,
        header.appendages,
    )
    return float_at(body, load, header.length)


def tons(weight: object) -> float:
    """Take a weight, t; any number will do: the hull tells what is in its range."""
    found: object = plain(weight)  # type: ignore[arg-type]
    if isinstance(found, int) and not isinstance(found, bool):
        return math.inf if found > 0 else -math.inf  # beyond what a float can be
    if not isinstance(found, float):
        raise BadInputError(f"weight is {shown(weight)}", _WHERE, "give a number, t")
    return found


def freeboard(hull: HasState, position: FloatingPosition) -> Freeboard:
    """Give the least height of the deck edge above the water, and where.

    Parameters
    ----------
    hull : Hull
        The hull.
    position : FloatingPosition
        Where it floats, moulded.

    Raises
    ------
    OutOfRangeError
        It does not float there.
    """
    body, length = body_of(hull), hull.state.particulars.length
    require_afloat([position], body.limits, length)
    return freeboard_at(body.limits.deck, position, length)


def deck_edge_angle(
    hull: HasState, position: FloatingPosition, appendages: Iterable[Appendage] = ()
) -> float | None:
    """Give the heel (degrees) at which the deck edge goes under, at this displacement and trim.

    Parameters
    ----------
    hull : Hull
        The hull.
    position : FloatingPosition
        Where it floats upright, moulded.
    appendages : iterable of Appendage
        That carry as well.

    Raises
    ------
    OutOfRangeError
        It does not float there.
    """
    body, length = body_of(hull), hull.state.particulars.length
    upright = FloatingPosition(position.draught_aft, position.draught_fore)
    require_afloat([upright], body.limits, length)
    return angle_at(body, upright, length, tuple(appendages))
