"""Hydrostatics at many floating positions: a table over draughts and trims."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.appendage import Appendage
from assoc_hull.analysis.hydrostatics.floating import FloatingPosition
from assoc_hull.analysis.hydrostatics.freeboard import Freeboard
from assoc_hull.analysis.hydrostatics.hydrostatic_header import HydrostaticHeader
from assoc_hull.analysis.hydrostatics.record import Hydrostatics, record
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.named_mapping import Named

__all__ = ["AppendageShare", "HydrostaticTable"]


def _columns(values: Mapping[str, FloatArray]) -> Mapping[str, FloatArray]:
    for each in values.values():
        freeze(each)
    return Named("value", values)


@attrs.frozen(eq=False)
class AppendageShare:
    """What an appendage adds at each position of a table, (d,).

    Attributes
    ----------
    appendage : Appendage
        Which.
    volume, area : m3, m2
        That it adds; 0 where its centroid is dry.
    percent : % of the volume with all appendages
        Its share.
    """

    appendage: Appendage
    volume: FloatArray
    area: FloatArray
    percent: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.volume, self.area, self.percent)


@attrs.frozen(eq=False)
class HydrostaticTable:
    """Hydrostatics over draughts and trims: ``table[i]``, or ``table[i, j]`` by draught and trim.

    Attributes
    ----------
    header : HydrostaticHeader
        What the numbers hold good for.
    shape : (int, int)
        How many mean draughts, and trims; the trims of one draught follow one another.
    positions : tuple of d FloatingPosition
        Draughts moulded.
    columns : mapping of str to (d,)
        The values of the records by name; nan where a position has none.
    errors : mapping of str to (d,)
        How far they may be off; empty if it was not asked.
    freeboards : tuple of d Freeboard
        Where the deck edge is nearest to the water.
    shares : tuple of AppendageShare
        The appendages, apart.
    notes : tuple of str
        What was found wrong and is reported.
    """

    header: HydrostaticHeader
    shape: tuple[int, int]
    positions: tuple[FloatingPosition, ...]
    columns: Mapping[str, FloatArray] = attrs.field(converter=_columns)
    errors: Mapping[str, FloatArray] = attrs.field(converter=_columns)
    freeboards: tuple[Freeboard, ...] = ()
    shares: tuple[AppendageShare, ...] = ()
    notes: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.positions)

    def __getitem__(self, place: int | tuple[int, int]) -> Hydrostatics:
        if isinstance(place, tuple):
            place = int(np.arange(len(self)).reshape(self.shape)[place])
        return record(self.columns, self.errors, range(len(self))[place], self.notes)

    def __iter__(self) -> Iterator[Hydrostatics]:
        return (self[i] for i in range(len(self)))

    @property
    def rows(self) -> tuple[Hydrostatics, ...]:
        """One record per position."""
        return tuple(self)

    @property
    def draughts(self) -> Mapping[str, FloatArray]:
        """Draughts at the perpendiculars, moulded and to the underside of keel, and heel, (d,)."""
        keel = self.header.keel_thickness
        aft = np.array([each.draught_aft for each in self.positions])
        fore = np.array([each.draught_fore for each in self.positions])
        found = {"draught_aft": aft, "draught_fore": fore}
        if keel:
            found |= {"draught_aft_extreme": aft + keel, "draught_fore_extreme": fore + keel}
        heel = np.array([each.heel_deg for each in self.positions])
        return _columns(found | ({"heel_deg": heel} if heel.any() else {}))
