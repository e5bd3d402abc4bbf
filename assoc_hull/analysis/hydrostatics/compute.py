"""Hydrostatics of a floating body: measured, with appendages, as a table."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from assoc_hull.analysis.hydrostatics.algebra import Setting, Values, propagate, values_of
from assoc_hull.analysis.hydrostatics.appendage import Appendage, require_volume, with_appendages
from assoc_hull.analysis.hydrostatics.floating import FloatingPosition, require_afloat
from assoc_hull.analysis.hydrostatics.floating_body import FloatingBody, Measurable, StationAreas
from assoc_hull.analysis.hydrostatics.freeboard import freeboard
from assoc_hull.analysis.hydrostatics.hydrostatic_header import HydrostaticHeader
from assoc_hull.analysis.hydrostatics.hydrostatic_table import AppendageShare, HydrostaticTable
from assoc_hull.analysis.hydrostatics.sums import Layout, Sums, change_of, sums_of
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.floating.immersed import Planes

__all__ = ["table_of", "values_at"]


def table_of(
    body: FloatingBody,
    positions: Sequence[FloatingPosition],
    header: HydrostaticHeader,
    *,
    shape: tuple[int, int] | None = None,
    estimate: bool = True,
    notes: Sequence[str] = (),
) -> HydrostaticTable:
    """Compute hydrostatics at floating positions, all in one go.

    Parameters
    ----------
    body : FloatingBody
        The hull.
    positions : sequence of d FloatingPosition
        Where it floats.
    header : HydrostaticHeader
        Dimensions, water, KG, appendages and what counts.
    shape : (int, int) or None
        How many draughts and trims the positions are; d draughts if None.
    estimate : bool
        Estimate how far each value may be off.
    notes : sequence of str
        For the table.

    Raises
    ------
    OutOfRangeError
        A position in which the hull does not float, with the range.
    BadInputError
        Appendages that leave nothing of its volume.
    """
    planes = require_afloat(positions, body.limits, header.length)
    setting, layout = _terms(header)
    stations, sums = _measured(body, planes, header)
    require_volume(sums.volume, header.appendages, planes, "in hydrostatics")
    errors: dict[str, FloatArray] = {}
    if estimate:
        changes = [change_of(each, stations, layout) for each in body.changes(planes)]
        errors = propagate(sums, changes, planes, setting)
    return HydrostaticTable(
        header,
        (len(positions), 1) if shape is None else shape,
        tuple(positions),
        values_of(sums, planes, setting),
        errors,
        tuple(freeboard(body.limits.deck, each, header.length) for each in positions),
        tuple(_share(each, planes, sums.volume) for each in header.appendages),
        tuple(notes),
    )


def values_at(body: Measurable, planes: Planes, header: HydrostaticHeader) -> Values:
    """Compute every value of the record below planes, (d,) each, in any arithmetic.

    Parameters
    ----------
    body : Measurable
        The hull.
    planes : Planes
        Where it floats, which is not checked.
    header : HydrostaticHeader
        Dimensions, water, KG, appendages and what counts.
    """
    return values_of(_measured(body, planes, header)[1], planes, _terms(header)[0])


def _terms(header: HydrostaticHeader) -> tuple[Setting, Layout]:
    setting = Setting(header.length, header.breadth, header.rho, header.shell_factor, header.kg)
    return setting, Layout(0.5 * header.length, header.transom)


def _measured(
    body: Measurable, planes: Planes, header: HydrostaticHeader
) -> tuple[StationAreas, Sums]:
    stations = body.stations(planes)
    measured = with_appendages(body.measure(planes), header.appendages, planes)
    return stations, sums_of(measured, stations, body.transom(planes), _terms(header)[1])


def _share(appendage: Appendage, planes: Planes, whole: FloatArray) -> AppendageShare:
    wet = appendage.immersed(planes)
    volume = np.where(wet, appendage.volume, 0.0)
    area = np.where(wet, appendage.area, 0.0)
    return AppendageShare(appendage, volume, area, 100.0 * volume / whole)
