"""Hydrostatics of a hull: one floating position, or a table of many.

The hull is measured through `assoc_hull.analysis.hydrostatics.flotation`; what is here chooses
positions and options.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Literal

import attrs

from assoc_hull.analysis.hydrostatics.appendage import Appendage
from assoc_hull.analysis.hydrostatics.compute import table_of
from assoc_hull.analysis.hydrostatics.floating import (
    FloatingPosition,
    planes_of,
    require_numbers,
    rising,
)
from assoc_hull.analysis.hydrostatics.floating_body import FloatingBody
from assoc_hull.analysis.hydrostatics.hydrostatic_header import SALT, HydrostaticHeader
from assoc_hull.analysis.hydrostatics.hydrostatic_table import HydrostaticTable
from assoc_hull.analysis.hydrostatics.measured_hull import HasState, body_of, header_of
from assoc_hull.analysis.hydrostatics.record import Hydrostatics
from assoc_hull.arguments import choice, flag, number, numbers
from assoc_hull.errors import BadInputError

__all__ = ["hydrostatic_table", "hydrostatics", "position_of", "trusted_table"]

_WHERE = "in hydrostatics"

OnError = Literal["refuse", "report"]
DraughtTo = Literal["moulded", "keel"]


def hydrostatics(
    hull: HasState,
    *,
    draught: float | None = None,
    draughts: tuple[float, float] | None = None,
    heel_deg: float = 0.0,
    rho: float = SALT,
    shell_factor: float = 1.0,
    kg: float | None = None,
    transom: bool = False,
    on_error: OnError = "refuse",
    appendages: Iterable[Appendage] = (),
    keel_thickness: float = 0.0,
    draught_to: DraughtTo = "moulded",
    estimate: bool = True,
) -> Hydrostatics:
    """Compute the hydrostatics of a hull at one floating position.

    Parameters
    ----------
    hull : Hull
        The hull.
    draught : float, m
        At even keel; or `draughts`. The design draught if neither is given.
    draughts : (float, float), m
        T_A and T_F, on the centre line at the perpendiculars.
    heel_deg : float, degrees
        + starboard down.
    rho : float, t/m3
        Density of the water: 1.025 salt, 1.000 fresh.
    shell_factor : float
        Displacement over that of the moulded volume.
    kg : float or None, m
        Centre of gravity above the base line.
    transom : bool
        Count the immersed transom, and other flat ends, as wetted surface.
    on_error : "refuse" or "report"
        What to do if the integrals are doubtful: a section that is open or crosses itself, two
        routes that disagree. What is reported stands in the `notes` of the record.
    appendages : iterable of Appendage
        That are added to the moulded hull.
    keel_thickness : float, m
        From the base line down to the underside of keel.
    draught_to : "moulded" or "keel"
        Whether draughts are given to the base line, or to the underside of keel; the record is
        always of moulded ones.
    estimate : bool
        Estimate how far each value may be off by the integration of these lines. Without, numbers
        are not compared with those of other routes either: only the lines can make it doubtful.

    Returns
    -------
    Hydrostatics
        The record.

    Raises
    ------
    OutOfRangeError
        A position in which the hull does not float, with the range.
    BadInputError
        A number that cannot be used; a doubtful hull.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.hydrostatics import hydrostatics
    >>> from assoc_hull.sources import examples
    >>> hull = examples.wigley()
    >>> round(hydrostatics(hull, draught=6.25).cb, 3)  # 4/9
    0.444
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": kg, "transom": transom,
        "appendages": appendages, "keel_thickness": keel_thickness, "fingerprint": "",
    }  # fmt: skip
    body = body_of(hull)
    header = header_of(hull, body, terms)
    require_numbers(draughts if draught is None else draught, body.limits)
    position = position_of(header, draught, draughts, heel_deg, draught_to)
    return trusted_table(body, [position], header, (1, 1), on_error, estimate=estimate)[0]


def hydrostatic_table(
    hull: HasState,
    draughts: Sequence[float],
    trims: Sequence[float] = (0.0,),
    *,
    heel_deg: float = 0.0,
    rho: float = SALT,
    shell_factor: float = 1.0,
    kg: float | None = None,
    transom: bool = False,
    on_error: OnError = "refuse",
    appendages: Iterable[Appendage] = (),
    keel_thickness: float = 0.0,
    draught_to: DraughtTo = "moulded",
    estimate: bool = True,
    date: str | None = None,
) -> HydrostaticTable:
    """Compute a table of hydrostatics over draughts and trims, all in one go.

    Parameters
    ----------
    hull : Hull
        The hull.
    draughts : (n,), m
        Mean draughts, rising.
    trims : (k,), m
        T_A - T_F: + by the stern, rising.
    heel_deg, rho, shell_factor, kg, transom, on_error, appendages, keel_thickness
        As for `hydrostatics`.
    draught_to, estimate
        As for `hydrostatics`.
    date : str or None
        For the head of the table.

    Raises
    ------
    OutOfRangeError, BadInputError
        As `hydrostatics`; also draughts or trims that do not rise.

    Examples
    --------
    >>> from assoc_hull.analysis.hydrostatics.hydrostatics import hydrostatic_table
    >>> from assoc_hull.sources import examples
    >>> table = hydrostatic_table(examples.wigley(), [2.0, 4.0, 6.0], [0.0, 0.5])
    >>> table.shape, table[2, 1].trim_by_stern
    ((3, 2), 0.5)
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": kg, "transom": transom,
        "appendages": appendages, "keel_thickness": keel_thickness, "date": date,
    }  # fmt: skip
    slopes = rising(trims, "trims", _WHERE).tolist()
    body = body_of(hull)
    header = header_of(hull, body, terms)
    require_numbers(draughts, body.limits)
    levels = rising(draughts, "draughts", _WHERE).tolist()
    lift = -_keel(header, draught_to)
    positions = [
        FloatingPosition(lift + t + 0.5 * trim, lift + t - 0.5 * trim, heel_deg)
        for t in levels
        for trim in slopes
    ]
    shape = (len(levels), len(slopes))
    return trusted_table(body, positions, header, shape, on_error, estimate=estimate)


def _keel(header: HydrostaticHeader, draught_to: str) -> float:
    """Give what draughts hold more than moulded ones, m."""
    choice(draught_to, "draught_to", ("moulded", "keel"), _WHERE)
    return header.keel_thickness if draught_to == "keel" else 0.0


def position_of(
    header: HydrostaticHeader,
    draught: float | None,
    draughts: tuple[float, float] | None,
    heel_deg: float,
    draught_to: str,
) -> FloatingPosition:
    """Take a floating position, moulded."""
    if draught is not None and draughts is not None:
        raise BadInputError("draught and draughts are both given", _WHERE, "give one of them")
    keel = _keel(header, draught_to)
    if draughts is None:
        even = header.draught + keel if draught is None else number(draught, "draught", _WHERE)
        return FloatingPosition(even - keel, even - keel, heel_deg)
    both = numbers(draughts, "draughts", _WHERE)
    if both.shape != (2,):
        raise BadInputError(f"draughts are {draughts!r}", _WHERE, "give (T_A, T_F), m")
    aft, fore = both.tolist()
    return FloatingPosition(aft - keel, fore - keel, heel_deg)


def trusted_table(
    body: FloatingBody,
    positions: Sequence[FloatingPosition],
    header: HydrostaticHeader,
    shape: tuple[int, int],
    on_error: str,
    *,
    estimate: bool,
) -> HydrostaticTable:
    """Compute, unless the hull is doubtful and that is to be refused."""
    choice(on_error, "on_error", ("refuse", "report"), _WHERE)
    flag(estimate, "estimate", _WHERE)
    table = table_of(body, positions, header, shape=shape, estimate=estimate)
    doubts = tuple(body.doubts(planes_of(positions, header.length), estimate))
    if doubts and on_error == "refuse":
        more = f" (and {len(doubts) - 1} more)" if len(doubts) > 1 else ""
        remedy = "mend the hull, or take the numbers with on_error='report'"
        raise BadInputError(doubts[0] + more, _WHERE, remedy)
    return attrs.evolve(table, notes=doubts)
