"""Whether particulars, extents and coefficients of an imported hull can be those of a ship.

What no ship can have is a fault, what few ships have a suspicion. Coefficients are measured of the
finished net at its draught, so that a wrong unit, scale, frame or draught shows here if it shows
nowhere else; they are compared with what the file itself says.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

import attrs
import numpy as np

from assoc_hull.analysis.hydrostatics.accuracy import MildDoubt
from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition, planes_of
from assoc_hull.analysis.hydrostatics.flotation import body_of, flotation
from assoc_hull.analysis.hydrostatics.hull_hydrostatics import hydrostatics
from assoc_hull.analysis.hydrostatics.record import Hydrostatics
from assoc_hull.edit.document import Document
from assoc_hull.errors import OutOfRangeError
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.io.importing.soundness import look, sampled_places
from assoc_hull.io.importing.verdict import Findings
from assoc_hull.model.tables import HullState, Particulars

__all__ = ["examine_certainty", "examine_particulars"]

_RATIOS = {
    "L/B": (2.0, 15.0), "B/T": (1.2, 12.0), "B/D": (0.8, 12.0),
}  # fmt: skip
"""Between these lie nearly all ships, from pontoons to racing shells' neighbours."""

_BROAD, _FLAT, _FINE, _SHIP = 4.2, 4.0, 0.8, 60.0
"""Of ships over 60 m only pontoons, which are full, are broader than L / 4.2 and than 4 T."""

_USUAL = {"cb": (0.25, 0.95), "cm": (0.3, math.inf)}
_COEFFICIENTS = ("cb", "cm", "cx", "cp", "cw")
_ONE = 1.0 + 1e-3
"""A coefficient may exceed 1 by what numbers are rounded to: a box has 1."""

_EXTENT = (0.75, 1.05)
"""Lpp as a part of the length over all."""

_WATERLINE = (0.95, 1.01)
"""Lpp as a part of the design waterline: load line rules take at least .96 of it for a length, and
neither perpendicular is put beyond it by more than a rudder stock abaft a cruiser stern."""

_AMIDSHIPS, _TOP = 0.1, 1.4
"""Within this part of the length of midship no bulwark or trunk rises to so many depths."""

_BREADTH, _DRAUGHT, _LCB = 0.02, 0.01, 10.0
_STATED = {"L/B": 0.01, "B/T": 0.01, "V": 0.02}
_STATED_COEFFICIENT = 0.03
_STATED_LCB = 1.0
"""How far (per cent of Lpp) LCB may lie off what the file says."""

_CERTAIN = {"V": ("volume", 3e-3), "S": ("wetted_surface", 1e-2)}
"""Numbers whose estimated error, as a part of them, is told above this: good imports have less."""

_TOLD = ("open end", "open bottom", "doubtful numbers")
"""Suspicions that tell of a part that is missing, whose doubt the estimates hold."""

_DESIGN = re.compile(r"(?:[DLC]\.?\s?W\.?\s?L\.?|(?:design|load) ?water ?line)", re.IGNORECASE)
_SYMBOL = {"cb": "CB", "cm": "CM", "cx": "CX", "cp": "CP", "cw": "CW"}
_CHECK = "check length, breadth, draught and the unit"


@attrs.frozen
class _Measured:
    """A hull as found: extents, top amidships (m); if it floats, hydrostatics at its draught."""

    low: FloatArray
    high: FloatArray
    top: float
    record: Hydrostatics | None


def examine_particulars(
    state: HullState,
    found: Findings,
    stated: Mapping[str, tuple[float, float]] | None = None,
    *,
    broad: bool = True,
) -> Hydrostatics | None:
    """Look at the particulars of a hull, and at its coefficients.

    `stated` is what the file says, as `assoc_hull.io.importing.stated.read_stated` gives it;
    `broad`: the breadth was given or stated, not found. Gives what was measured, if anything.
    """
    measured: list[_Measured] = []
    look(lambda: measured.append(_measure(state, found)), "the hull", found)
    for hull in measured:
        for each in (
            lambda hull=hull: _examine_sizes(state, hull, found),
            lambda hull=hull: _examine_breadth(state, hull, found) if broad else None,
            lambda: _examine_draught(state, found),
            lambda hull=hull: _examine_broad(state.particulars, hull.record, found),
            lambda hull=hull: _examine_coefficients(hull, found),
            lambda hull=hull: _examine_stated(state, hull, stated or {}, found),
        ):
            look(each, "the particulars", found)
    return measured[0].record if measured else None


def _measure(state: HullState, found: Findings) -> _Measured:
    places = sampled_places(state)[0]
    low, high = places.min(axis=0), places.max(axis=0)
    amidships = np.abs(places[:, 0] - 0.5 * (low[0] + high[0])) <= _AMIDSHIPS * (high[0] - low[0])
    top = float(places[amidships, 2].max(initial=low[2]))
    records: list[Hydrostatics | None] = []
    look(lambda: records.append(_floating(state, found)), "hydrostatics", found)
    return _Measured(low, high, top, records[0] if records else None)


def _floating(state: HullState, found: Findings) -> Hydrostatics | None:
    """Give hydrostatics at the draught; what they would be refused for is found.

    Lines that bound no hull are faults; numbers that disagree are suspicions, since lines that are
    few and far apart make them disagree too.
    """
    hull, ship = Document(state), state.particulars
    try:
        record = hydrostatics(hull, on_error="report")
    except OutOfRangeError as error:
        found.fault("draught", "the particulars", str(error), error.value)
        return None
    # Water at the very edge is measured right below it, which is no drowning.
    drowned = record.draught_mean < ship.draught * (1.0 - 1e-9)
    position = FloatingPosition(record.draught_mean, record.draught_mean)
    planes = planes_of([position], ship.length)
    lines, every = (body_of(hull).doubts(planes, numbers) for numbers in (False, True))
    for number, doubt in enumerate(record.notes):
        if number == 0 and drowned:
            found.fault("draught", "the particulars", doubt, ship.draught)
        elif doubt in lines:
            what = f"{doubt}: hydrostatics are refused; mend the line, or draw what is missing"
            found.fault("open net", "the net", what)
        elif doubt in every:  # other notes tell how the hull was taken, and refuse nothing
            what = doubt
            if not isinstance(doubt, MildDoubt):
                what += (
                    ": check these numbers; hydrostatics need on_error='report' (--on-error "
                    f"report){_bends_of_profile(state)}"
                )
            found.suspect("doubtful numbers", "the net", what)
    return record


def _bends_of_profile(state: HullState) -> str:
    """Name corners of the profile between the ends, which stations far apart round off."""
    body = flotation(state)
    xyz = body.net.batch.xyz
    curve = np.arange(body.net.batch.count).repeat(np.diff(body.net.batch.start))
    bends = xyz[(body.kinds == PointKind.KNUCKLE) & body.net.centre[curve], 0]
    low, high = float(xyz[:, 0].min()), float(xyz[:, 0].max())
    inside = (bends > low + _BEND * (high - low)) & (bends < high - _BEND * (high - low))
    places = [f"{x:.2f}" for x in np.unique(bends[inside].round(2)).tolist()]
    if not places:
        return ""
    return (
        f"; the profile has corners at x = {', '.join(places)} m: give stations close before and "
        "behind each, as the hull is drawn round between stations far apart"
    )


_BEND = 0.01
"""So near to an end, as a part of the length, a corner of the profile is that of the end."""

# --------------------------------------------------------------------------------------
# Particulars against one another and against the extents.


def _examine_sizes(state: HullState, hull: _Measured, found: Findings) -> None:
    ship, size = state.particulars, hull.high - hull.low
    where = "the particulars"
    for name, value in {
        "L/B": ship.length / ship.breadth, "B/T": ship.breadth / ship.draught,
        # A boat is broader at the deck than at the water, and D is to the deck.
        "B/D": max(ship.breadth, 2.0 * float(hull.high[1])) / ship.depth,
    }.items():  # fmt: skip
        low, high = _RATIOS[name]
        if not low <= value <= high:
            what = f"{name} is {value:.4g}, outside {low:g} to {high:g}: {_CHECK}"
            found.suspect("proportions", where, what, value)
    if ship.deck == "closed" and ship.draught > ship.depth * (1.0 + 1e-9):
        what = (
            f"the draught {ship.draught:.4g} m is above the depth {ship.depth:.4g} m of a decked "
            "hull: give draught= or depth="
        )
        found.fault("draught", where, what, ship.draught - ship.depth)
    elif ship.draught > ship.depth * (1.0 + 1e-9):
        what = (
            f"the draught {ship.draught:.4g} m is above the depth {ship.depth:.4g} m: give "
            "draught= or depth="
        )
        found.suspect("draught", where, what, ship.draught - ship.depth)
    part = ship.length / float(size[0])
    if not _EXTENT[0] <= part <= _EXTENT[1]:
        what = (
            f"the length {ship.length:.4g} m is {part:.3f} of the {size[0]:.4g} m from end to end, "
            f"outside {_EXTENT[0]:g} to {_EXTENT[1]:g}: give length=, or check unit and scale"
        )
        found.suspect("length", where, what, part)
    elif hull.record is not None:
        _examine_length(ship.length, hull.record, found)
    if ship.depth > 1.01 * max(float(hull.high[2]), 0.0):
        what = (
            f"the depth {ship.depth:.4g} m reaches above the hull, which ends at "
            f"{hull.high[2]:.4g} m: give depth=, or check the base line"
        )
        found.suspect("depth", where, what, ship.depth - float(hull.high[2]))
    elif hull.top > _TOP * ship.depth >= _TOP * ship.draught:  # else the depth is told above
        what = (
            f"the depth {ship.depth:.4g} m is {ship.depth / hull.top:.3g} of the {hull.top:.4g} m "
            "to which the hull rises amidships: give depth=, or check unit and scale"
        )
        found.suspect("depth", where, what, ship.depth - hull.top)


def _examine_length(length: float, record: Hydrostatics, found: Findings) -> None:
    """Suspect a length between perpendiculars that is hardly one of the design waterline."""
    part, (least, most) = length / record.lwl, _WATERLINE
    if not least <= part <= most:
        what = (
            f"the length {length:.4g} m is {part:.3f} of the waterline's {record.lwl:.4g} m at the "
            f"draught {record.draught_mean:.4g} m, outside {least:g} to {most:g}: check length= "
            "and draught="
        )
        found.suspect("length", "the particulars", what, part)


def _examine_breadth(state: HullState, hull: _Measured, found: Findings) -> None:
    """Refuse a breadth that is neither of the waterline nor of the hull, nor between the two."""
    most = 2.0 * float(hull.high[1])
    least = most if hull.record is None else min(most, hull.record.bwl)
    given = state.particulars.breadth
    if not (1.0 - _BREADTH) * least <= given <= (1.0 + _BREADTH) * most:
        same = abs(most - least) < 1e-3 * most
        lines = f"{most:.4g} m" if same else f"{least:.4g} m at the waterline, {most:.4g} m at most"
        what = (
            f"the breadth is given as {given:.4g} m and the lines are {lines}: give breadth=, or "
            "check unit and scale"
        )
        found.fault("breadth", "the particulars", what, given - most)


def _examine_draught(state: HullState, found: Findings) -> None:
    """Compare the draught with the line that is called the design waterline."""
    ship = state.particulars
    for line in state.live("lines").tolist():
        name, height = str(state.lines.name[line]), float(state.lines.offset[line])
        level = state.lines.planar[line] and state.lines.normal[line][2] == 1.0
        off = ship.draught - height
        if level and _DESIGN.fullmatch(name.strip()) and abs(off) > _DRAUGHT * ship.depth:
            what = (
                f"the draught is {ship.draught:.4g} m, and the line {name!r} lies {height:.4g} m "
                f"above the base line: give draught={height:.4f} if that is the design waterline"
            )
            found.suspect("draught", "the particulars", what, off)


# --------------------------------------------------------------------------------------
# Coefficients at the draught.


def _examine_coefficients(hull: _Measured, found: Findings) -> None:
    if hull.record is None:
        return
    record = hull.record
    where = f"the hull at draught {record.draught_mean:.4g} m"
    for name in _COEFFICIENTS:
        value, symbol = float(getattr(record, name)), _SYMBOL[name]
        low, high = _USUAL.get(name, (0.0, math.inf))
        if not 0.0 < value <= _ONE:
            what = f"{symbol} is {value:.4g}, and no hull has one outside 0 to 1: {_CHECK}"
            found.fault("coefficient", where, what, value)
        elif not low <= value <= high:
            span = f"above {high:g}" if value > high else f"below {low:g}"
            what = f"{symbol} is {value:.4g}, {span} as of few ships: {_CHECK}"
            found.suspect("coefficient", where, what, value)
    if not abs(record.lcb_percent) <= _LCB:
        what = (
            f"LCB lies {record.lcb_percent:+.2f} % of Lpp from midship, more than {_LCB:g} %: "
            "check where x = 0 and the perpendiculars are"
        )
        found.suspect("LCB", where, what, record.lcb_percent)


def examine_certainty(record: Hydrostatics | None, found: Findings) -> None:
    """Suspect lines so few that volume or surface hang on what is drawn between them.

    Where what is missing has been told already (ends that are open), its doubt is not told twice.
    """
    if record is None or any(each.kind in _TOLD for each in found.suspicions):
        return
    told, most = [], 0.0
    for symbol, (name, limit) in _CERTAIN.items():
        error, value = record.error[name], getattr(record, name)
        if error is not None and error > limit * value > 0.0:
            told.append(f"{symbol} is known to {100.0 * error / value:.2g} % only")
            most = max(most, error / value)
    if told:
        what = (
            f"{' and '.join(told)}, since lines are few or far apart: give more sections and "
            "waterlines where the hull bends, above all at its ends and the bilge"
        )
        found.suspect("few lines", "the net", what, most)


def _examine_broad(ship: Particulars, record: Hydrostatics | None, found: Findings) -> None:
    """Suspect a fine ship as broad as full breadths, or feet read as metres, make her."""
    if record is None or ship.length < _SHIP or not record.cb < _FINE:
        return
    slender, flat = ship.length / ship.breadth, ship.breadth / ship.draught
    if slender < _BROAD and flat > _FLAT and _within("L/B", slender) and _within("B/T", flat):
        what = (
            f"L/B is {slender:.3g}, B/T {flat:.3g} and CB {record.cb:.2g}, as of few ships over "
            f"{_SHIP:g} m: are the half-breadths full breadths, or in another unit (feet)? "
            "give half of each, or unit="
        )
        found.suspect("proportions", "the particulars", what, slender)


def _within(name: str, value: float) -> bool:
    low, high = _RATIOS[name]
    return low <= value <= high


def _examine_stated(
    state: HullState, hull: _Measured, stated: Mapping[str, tuple[float, float]], found: Findings
) -> None:
    ship = state.particulars
    broad = 2.0 * float(hull.high[1])
    own = {"L/B": ship.length / broad, "B/T": broad / ship.draught}
    if hull.record is not None:
        own |= {symbol: float(getattr(hull.record, name)) for name, symbol in _SYMBOL.items()}
        own |= {"LCB": hull.record.lcb_percent, "V": hull.record.volume}
    for name, (value, rounding) in stated.items():
        if name not in own or not np.isfinite(own[name]):
            continue
        allowed = rounding + (
            _STATED_LCB if name == "LCB" else _STATED.get(name, _STATED_COEFFICIENT) * abs(value)
        )
        if abs(own[name] - value) > allowed:
            unit = {"LCB": " % of Lpp", "V": " m3"}.get(name, "")
            what = (
                f"the file says {name} {value:g}{unit}, and the hull has {own[name]:.4g}{unit}: "
                f"{'check where x = 0 is and which way x runs' if name == 'LCB' else _CHECK}"
            )
            found.suspect("stated", "the comments", what, own[name] - value)
