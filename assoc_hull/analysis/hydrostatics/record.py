"""The record of a hull's hydrostatics at one floating position."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.record_fields import FIELDS
from assoc_hull.model.named_mapping import Named

__all__ = ["Hydrostatics", "record"]

_MAY_LACK = frozenset({"kmt", "kml", "gmt", "gml"})
"""Values that some positions do not have."""


def _frozen(values: Mapping[str, float | None]) -> Mapping[str, float | None]:
    return Named("value", values)


@attrs.frozen(eq=False)
class Hydrostatics:
    """Hydrostatics at one floating position, both sides, in ship axes.

    x is from AP, + forward; y + to port; z from the base line, up; m, t, m3. `FIELDS` in
    `assoc_hull.analysis.hydrostatics.record_fields` tells of each value its symbol, unit, datum,
    sign and
    formula, in the order of this record. Lpp and moulded breadth stand in every coefficient
    unless it says `_lwl`; the draught in them is the mean one, moulded.

    Attributes
    ----------
    volume, displacement : m3, t
        Moulded, with appendages; displacement is rho V shell_factor.
    lcb, lcb_percent, tcb, kb : m, % of Lpp, m, m
        Centre of buoyancy: from AP, from midship (both + forward), to port, above base. `kb`
        is its z also when heeled.
    waterplane_area, i_t, i_l, i_lt, bmt, bml : m2, m4, m
        Of the true, inclined waterplane about its own centroid; the longitudinal axis is the
        direction of the ship's x-axis in it, the transverse one perpendicular to that.
    lcf, tcf : m
        Centroid of the waterplane, from AP and to port.
    kmt, kml : m, or None when heeled
        Metacentres above the base line.
    gmt, gml : m, or None without KG
        Metacentric heights; None also when heeled.
    tpc, mtc : t/cm, t m/cm
        Immersion and trimming moment; `mtc` is of `gml` where there is one, else of `bml`.
    wetted_surface, wetted_surface_girth, transom_area : m2
        By the true surface element, with appendages and a closed deck that is under water,
        without the transom unless asked for; girths of the bare hull integrated over the length;
        the transom.
    lwl, bwl : m
        Extent of the waterplane along x and y.
    a_max, x_a_max, a_midship : m2, m, m2
        Largest station, where it is, section at Lpp / 2.
    cb, cm, cx, cp, cvp, cw, cb_lwl, cp_lwl
        Coefficients; `cm` is of the section at Lpp / 2, `cx` and `cp` of the largest one.
    draught_mean, trim_by_stern : m
        Moulded.
    waterplane_area_proj, i_t_proj, i_l_proj, i_lt_proj : m2, m4
        In plan, about the centroid.
    error : mapping of str to float or None
        How far each value may be off, by its name; None where that is not known, or not asked.
    notes : tuple of str
        What makes the numbers doubtful, where that is to be reported; of all positions of the
        table that a record is taken from.
    """

    volume: float
    displacement: float
    lcb: float
    lcb_percent: float
    tcb: float
    kb: float
    waterplane_area: float
    lcf: float
    tcf: float
    i_t: float
    i_l: float
    i_lt: float
    bmt: float
    bml: float
    kmt: float | None
    kml: float | None
    gmt: float | None
    gml: float | None
    tpc: float
    mtc: float
    wetted_surface: float
    wetted_surface_girth: float
    transom_area: float
    lwl: float
    bwl: float
    a_max: float
    x_a_max: float
    a_midship: float
    cb: float
    cm: float
    cx: float
    cp: float
    cvp: float
    cw: float
    cb_lwl: float
    cp_lwl: float
    draught_mean: float
    trim_by_stern: float
    waterplane_area_proj: float
    i_t_proj: float
    i_l_proj: float
    i_lt_proj: float
    error: Mapping[str, float | None] = attrs.field(converter=_frozen)
    notes: tuple[str, ...] = ()


def record(
    columns: Mapping[str, NDArray[np.float64]],
    errors: Mapping[str, NDArray[np.float64]],
    i: int,
    notes: Sequence[str] = (),
) -> Hydrostatics:
    """Give the record of one position.

    Parameters
    ----------
    columns, errors : mapping of str to (d,)
        All values, and how far they may be off; nan where there is none.
    i : int
        The position.
    notes : sequence of str
        For the record.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.record import record
    >>> from assoc_hull.analysis.hydrostatics.record_fields import FIELDS
    >>> found = record({name: np.array([1.0]) for name in FIELDS}, {}, 0)
    >>> found.volume, found.error["volume"]
    (1.0, None)
    """
    values: dict[str, Any] = {name: float(columns[name][i]) for name in FIELDS}
    for name in _MAY_LACK:
        values[name] = _number(values[name])
    error = {name: _number(float(errors[name][i])) if name in errors else None for name in FIELDS}
    return Hydrostatics(**values, error=error, notes=tuple(notes))


def _number(value: float) -> float | None:
    return None if np.isnan(value) else value
