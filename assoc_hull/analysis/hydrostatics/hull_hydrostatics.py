"""Hydrostatics of a hull, at one floating position or as a table.

`hydrostatics` and `hydrostatic_table` choose positions and options; `table_of` measures any
floating body. The integrals of hull, appendages and stations (`HydrostaticIntegrals`) come first;
every published value is algebra on them (`values_of`), in any arithmetic, so that it carries
tangents and errors too. All of a record is computed for d planes at once: arrays are (d,), m, t.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Literal

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.accuracy import MildDoubt
from assoc_hull.analysis.hydrostatics.demihulls import checked_separation, ship_of
from assoc_hull.analysis.hydrostatics.floating_body import (
    Appendage,
    FloatingBody,
    FloatingPosition,
    IntegralChange,
    Measurable,
    StationAreas,
    kept_dry,
    least_freeboard,
    planes_of,
    require_afloat,
    require_numbers,
    require_volume,
    rising_numbers,
    with_appendages,
)
from assoc_hull.analysis.hydrostatics.flotation import Flotation, body_of, header_of
from assoc_hull.analysis.hydrostatics.record import (
    FIELDS,
    SALT,
    AppendageShare,
    HydrostaticHeader,
    Hydrostatics,
    HydrostaticTable,
)
from assoc_hull.analysis.hydrostatics.tunnel import TunnelledBody
from assoc_hull.arguments import choice, flag, number, numbers
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, IntArray, freeze
from assoc_hull.geometry.floating.immersion import FloatingPlanes, ImmersedIntegrals
from assoc_hull.geometry.numeric.dual import is_plain, real
from assoc_hull.model.tables import HasState, state_of

__all__ = [
    "CountingRule",
    "HydrostaticIntegrals",
    "RecordSetting",
    "Values",
    "doubts_of",
    "hydrostatic_table",
    "hydrostatics",
    "integral_changes",
    "integrals_of",
    "position_of",
    "propagate",
    "table_of",
    "table_without_doubts",
    "values_at",
    "values_of",
]


@attrs.frozen(eq=False)
class HydrostaticIntegrals:
    """Integrals and sections of both sides below each of d planes, all (d,).

    As `ImmersedIntegrals`, with the sections and the transom that a record needs.

    Attributes
    ----------
    volume, moment_x, moment_y, moment_z : m3, m4
        With appendages.
    area, area_x, area_y, area_xx, area_xy, area_yy : m2, m3, m4
        Of the waterplane in plan.
    shell : m2
        Wetted surface: shell, appendages, and the transom if it counts; no deck.
    girth : m2
        Integral of the girth over the length, of the shell alone.
    x_least, x_most, y_least, y_most : m
        Extent of the waterplane.
    transom : m2
        Immersed transom.
    a_max, x_a_max, a_midship : m2, m, m2
        The largest station, where it is, and the section at Lpp / 2.
    """

    volume: FloatArray
    moment_x: FloatArray
    moment_y: FloatArray
    moment_z: FloatArray
    area: FloatArray
    area_x: FloatArray
    area_y: FloatArray
    area_xx: FloatArray
    area_xy: FloatArray
    area_yy: FloatArray
    shell: FloatArray
    girth: FloatArray
    x_least: FloatArray
    x_most: FloatArray
    y_least: FloatArray
    y_most: FloatArray
    transom: FloatArray
    a_max: FloatArray
    x_a_max: FloatArray
    a_midship: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(*attrs.astuple(self, recurse=False))


@attrs.frozen
class CountingRule:
    """What of a hull counts as what.

    Attributes
    ----------
    middle : float, m
        x of Lpp / 2.
    transom : bool
        The transom is a part of the wetted surface.
    """

    middle: float
    transom: bool = False


def integrals_of(
    immersed: ImmersedIntegrals, stations: StationAreas, transom: FloatArray, layout: CountingRule
) -> HydrostaticIntegrals:
    """Bring together what is measured of a hull; `transom` is its immersed area, (d,), m2.

    The section at Lpp / 2 is the station there; if there is none, the cubic through the four
    stations next to it.
    """
    return _joined(immersed, stations, transom, layout, _largest(stations, layout.middle))


def integral_changes(
    change: IntegralChange, stations: StationAreas, layout: CountingRule
) -> HydrostaticIntegrals:
    """Bring together changes of what is measured, as `integrals_of`; nan where they are not known.

    `stations` are not changed: the largest of them stays the largest.
    """
    most = _largest(stations, layout.middle)
    areas = np.full_like(stations.area, np.nan) if change.areas is None else change.areas
    unknown = np.full(len(most), np.nan)
    transom = unknown if change.transom is None else change.transom
    changed = attrs.evolve(stations, area=areas)
    found = _joined(change.immersed, changed, transom, layout, most)
    return attrs.evolve(found, x_a_max=unknown)


def _joined(
    immersed: ImmersedIntegrals,
    stations: StationAreas,
    transom: FloatArray,
    layout: CountingRule,
    most: IntArray,
) -> HydrostaticIntegrals:
    found = {
        field.name: getattr(immersed, field.name)
        for field in attrs.fields(ImmersedIntegrals)
        if field.name != "wet_deck"
    }
    if layout.transom:
        found["shell"] = immersed.shell + transom
    return HydrostaticIntegrals(
        **found,
        transom=transom,
        a_max=stations.area[np.arange(len(most)), most],
        x_a_max=stations.x[most],
        a_midship=_section(stations, layout.middle),
    )


def _largest(stations: StationAreas, middle: float) -> IntArray:
    """Give which station is the largest, (d,): of equal ones that next to Lpp / 2."""
    area = real(stations.area)
    most = area.max(axis=1, keepdims=True)
    away = np.abs(real(stations.x) - real(middle))
    off = np.where(area >= most * (1.0 - 1e-12), away, np.inf)
    found: IntArray = off.argmin(axis=1)
    return found


def _section(stations: StationAreas, x: float) -> FloatArray:
    """Give the area of a section at x, (d,), m2, by Lagrange's cubic where no station is.

    A station at x may move away from it, to either side: then it is one of four stations or one
    of another four, and the derivative is the mean of both.
    """
    known, count, place = real(stations.x), min(4, len(stations.x)), float(real(x))
    near = int(np.argmin(np.abs(known - place)))
    there = abs(known[near] - place) <= 1e-9 * max(abs(place), 1.0)
    if there and is_plain(stations.x) and is_plain(x):
        found: FloatArray = stations.area[:, near]
        return found
    after = (near, near + 1) if there else (int(np.searchsorted(known, place)),)
    begin = [int(np.clip(each - 2, 0, len(known) - count)) for each in after]
    areas = [_cubic(stations, x, first, count) for first in begin]
    return sum(areas[1:], areas[0]) / len(areas)


def _cubic(stations: StationAreas, x: float, first: int, count: int) -> FloatArray:
    knots = [stations.x[i] for i in range(first, first + count)]
    areas = [stations.area[:, i] for i in range(first, first + count)]
    return lagrange(knots, areas, x)


def lagrange(knots: Sequence[FloatArray], values: Sequence[FloatArray], x: float) -> FloatArray:
    """Give at x Lagrange's polynomial through values (d,) at knots, in any arithmetic."""
    found = 0.0 * values[0]
    for i, (knot, value) in enumerate(zip(knots, values, strict=True)):
        weight = 1.0 + 0.0 * knot
        for j, other in enumerate(knots):
            if j != i:
                weight = weight * (x - other) / (knot - other)
        found = found + weight * value
    return found


# --------------------------------------------------------------------------------------
# From integrals to the values of a record. Nothing here takes an absolute value or a maximum, so a
# complex step through it gives exact derivatives: `propagate` turns changes of the integrals into
# changes of every value.

Values = dict[str, NDArray[Any]]

_STEP = 1e-100
"""Imaginary step: its square vanishes in double precision, so derivatives have no error of it."""


@attrs.frozen
class RecordSetting:
    """What else the values depend on.

    Attributes
    ----------
    length, breadth : float, m
        Lpp and moulded breadth.
    rho : float, t/m3
        Of the water.
    shell_factor : float
        Displacement over that of the moulded volume.
    kg : float or None, m
        Centre of gravity above the base line.
    separation : float, m
        Of the centre planes of two demihulls, which coefficients have the breadths of; 0: one hull.
    """

    length: float
    breadth: float
    rho: float
    shell_factor: float
    kg: float | None
    separation: float = 0.0


def values_of(sums: HydrostaticIntegrals, planes: FloatingPlanes, setting: RecordSetting) -> Values:
    """Give every value of the record, (d,) each, by name.

    A value that a position does not have (KM when heeled, GM without KG) is nan.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        found = _draughts(planes, setting) | _buoyancy(sums, setting) | _plan(sums)
        found |= _waterplane(found, planes)
        found |= _heights(found, planes, setting)
        found |= _extent(sums)
        found |= _coefficients(found, setting)
    return {name: found[name] for name in FIELDS}


def _draughts(planes: FloatingPlanes, setting: RecordSetting) -> Values:
    rise = planes.tan_trim * setting.length
    return {"draught_mean": planes.height + 0.5 * rise, "trim_by_stern": -rise + 0.0}


def _buoyancy(sums: HydrostaticIntegrals, setting: RecordSetting) -> Values:
    volume = sums.volume
    lcb = sums.moment_x / volume
    return {
        "volume": volume,
        "displacement": setting.rho * setting.shell_factor * volume,
        "lcb": lcb,
        "lcb_percent": 100.0 * (lcb - 0.5 * setting.length) / setting.length,
        "tcb": sums.moment_y / volume,
        "kb": sums.moment_z / volume,
    }


def _plan(sums: HydrostaticIntegrals) -> Values:
    area = sums.area
    lcf, tcf = sums.area_x / area, sums.area_y / area
    return {
        "waterplane_area_proj": area,
        "lcf": lcf,
        "tcf": tcf,
        "i_t_proj": sums.area_yy - tcf * sums.area_y,
        "i_l_proj": sums.area_xx - lcf * sums.area_x,
        "i_lt_proj": sums.area_xy - lcf * sums.area_y,
    }


def _waterplane(found: Values, planes: FloatingPlanes) -> Values:
    """Give area and second moments of the inclined waterplane from those of its plan (x, y).

    It lies over its plan by an affine map. With n the upward normal, its longitudinal axis is
    ``e1 = (1, 0, tt) / c``, the direction of the ship's x-axis in the plane; its transverse axis
    ``e2 = n x e1`` is perpendicular to it in the plane. From the centroid a point in plan (x, y)
    has in these axes the coordinates ``xi = c x - (tt th / c) y``, ``eta = (s / c) y``, and
    ``dA = s dx dy``, with tt, th the tangents of trim and heel, ``c^2 = 1 + tt^2``,
    ``s^2 = 1 + tt^2 + th^2``. For pure heel the transverse second moment is that in plan over the
    cube of the cosine.
    """
    c2 = 1.0 + planes.tan_trim**2
    s2 = c2 + planes.tan_heel**2
    s, skew = np.sqrt(s2), planes.tan_trim * planes.tan_heel
    yy, xx, xy = (found[f"i_{each}_proj"] for each in ("t", "l", "lt"))
    i_t = s * (s2 / c2) * yy
    i_l = s * (c2 * xx - 2.0 * skew * xy + skew**2 / c2 * yy)
    return {
        "waterplane_area": s * found["waterplane_area_proj"],
        "i_t": i_t,
        "i_l": i_l,
        "i_lt": s2 * (xy - skew / c2 * yy),
        "bmt": i_t / found["volume"],
        "bml": i_l / found["volume"],
    }


def _heights(found: Values, planes: FloatingPlanes, setting: RecordSetting) -> Values:
    upright = np.where(planes.tan_heel == 0.0, 0.0, np.nan)
    kmt, kml = (found["kb"] + found[each] + upright for each in ("bmt", "bml"))
    kg = np.nan if setting.kg is None else setting.kg
    gml = kml - kg
    # Without KG, or heeled, there is no GML: BML stands for it in the moment to change trim.
    lever = np.where(np.isnan(gml), found["bml"], gml)
    rho = setting.rho
    return {
        "kmt": kmt,
        "kml": kml,
        "gmt": kmt - kg,
        "gml": gml,
        "tpc": rho * found["waterplane_area"] / 100.0,
        "mtc": rho * found["volume"] * lever / (100.0 * setting.length),
    }


def _extent(sums: HydrostaticIntegrals) -> Values:
    return {
        "wetted_surface": sums.shell,
        "wetted_surface_girth": sums.girth,
        "transom_area": sums.transom,
        "lwl": sums.x_most - sums.x_least,
        "bwl": sums.y_most - sums.y_least,
        "a_max": sums.a_max,
        "x_a_max": sums.x_a_max,
        "a_midship": sums.a_midship,
    }


def _coefficients(found: Values, setting: RecordSetting) -> Values:
    length, breadth, volume = setting.length, setting.breadth, found["volume"]
    bwl = found["bwl"]
    if setting.separation:
        # The gap between demihulls is no breadth of theirs.
        breadth, bwl = 2.0 * breadth, 2.0 * (bwl - setting.separation)
    frame = breadth * found["draught_mean"]
    cb, cw = volume / (length * frame), found["waterplane_area"] / (length * breadth)
    return {
        "cb": cb,
        "cm": found["a_midship"] / frame,
        "cx": found["a_max"] / frame,
        "cp": volume / (found["a_max"] * length),
        "cvp": cb / cw,
        "cw": cw,
        "cb_lwl": volume / (found["lwl"] * bwl * found["draught_mean"]),
        "cp_lwl": volume / (found["a_max"] * found["lwl"]),
    }


def propagate(
    sums: HydrostaticIntegrals,
    changes: Iterable[HydrostaticIntegrals],
    planes: FloatingPlanes,
    setting: RecordSetting,
) -> dict[str, FloatArray]:
    """Give by how much every value may be off, to first order: (d,) by name, nan if not known.

    Each item of `changes` holds changes of all integrals that come together, with their signs:
    moments and volume are mostly off together, and the centroid is not. Amounts of several items
    add up, as if each could have either sign.
    """
    found: dict[str, FloatArray] = {}
    for change in changes:
        moved = {
            name: value + 1j * _STEP * getattr(change, name)
            for name, value in attrs.asdict(sums, recurse=False).items()
        }
        for name, value in values_of(HydrostaticIntegrals(**moved), planes, setting).items():
            amount = np.where(np.isnan(value.real), np.nan, np.abs(value.imag) / _STEP)
            found[name] = found[name] + amount if name in found else amount
    return found


# --------------------------------------------------------------------------------------
# Tables of a floating body.


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
        changes = [integral_changes(each, stations, layout) for each in body.changes(planes)]
        errors = propagate(sums, changes, planes, setting)
    return HydrostaticTable(
        header,
        (len(positions), 1) if shape is None else shape,
        tuple(positions),
        values_of(sums, planes, setting),
        errors,
        tuple(least_freeboard(body.limits.deck, each, header.length) for each in positions),
        tuple(_share(each, planes, sums.volume) for each in header.appendages),
        tuple(notes),
    )


def values_at(body: Measurable, planes: FloatingPlanes, header: HydrostaticHeader) -> Values:
    """Compute every value of the record below planes, (d,) each, in any arithmetic.

    Whether the hull floats there is not checked.
    """
    return values_of(_measured(body, planes, header)[1], planes, _terms(header)[0])


def _terms(header: HydrostaticHeader) -> tuple[RecordSetting, CountingRule]:
    setting = RecordSetting(
        header.length, header.breadth, header.rho, header.shell_factor, header.kg,
        header.separation or 0.0,
    )  # fmt: skip
    return setting, CountingRule(0.5 * header.length, header.transom)


def _measured(
    body: Measurable, planes: FloatingPlanes, header: HydrostaticHeader
) -> tuple[StationAreas, HydrostaticIntegrals]:
    stations = body.stations(planes)
    measured = with_appendages(body.measure(planes), header.appendages, planes)
    return stations, integrals_of(measured, stations, body.transom(planes), _terms(header)[1])


def _share(appendage: Appendage, planes: FloatingPlanes, whole: FloatArray) -> AppendageShare:
    wet = appendage.immersed(planes)
    volume = np.where(wet, appendage.volume, 0.0)
    area = np.where(wet, appendage.area, 0.0)
    return AppendageShare(appendage, volume, area, 100.0 * volume / whole)


# --------------------------------------------------------------------------------------
# A hull: one floating position, or a table of many. `flotation` measures it; positions and options
# are chosen here.

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
    demihulls: int = 1,
    separation: float | None = None,
) -> Hydrostatics:
    """Compute the hydrostatics of a hull at one floating position.

    The arguments and what is raised are those of `Hull.hydrostatics`.
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": kg, "transom": transom,
        "appendages": appendages, "keel_thickness": keel_thickness, "fingerprint": "",
    }  # fmt: skip
    body = _ship(hull, demihulls, separation, terms)
    header = header_of(hull, body, terms)
    require_numbers(draughts if draught is None else draught, body.limits)
    position = position_of(header, draught, draughts, heel_deg, draught_to)
    return table_without_doubts(body, [position], header, (1, 1), on_error, estimate=estimate)[0]


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
    demihulls: int = 1,
    separation: float | None = None,
    date: str | None = None,
) -> HydrostaticTable:
    """Compute a table of hydrostatics over draughts and trims, all in one go.

    The arguments and what is raised are those of `Hull.hydrostatic_table`.
    """
    terms: dict[str, object] = {
        "rho": rho, "shell_factor": shell_factor, "kg": kg, "transom": transom,
        "appendages": appendages, "keel_thickness": keel_thickness, "date": date,
    }  # fmt: skip
    slopes = rising_numbers(trims, "trims", _WHERE).tolist()
    body = _ship(hull, demihulls, separation, terms)
    header = header_of(hull, body, terms)
    require_numbers(draughts, body.limits)
    levels = rising_numbers(draughts, "draughts", _WHERE).tolist()
    lift = -_keel(header, draught_to)
    positions = [
        FloatingPosition(lift + t + 0.5 * trim, lift + t - 0.5 * trim, heel_deg)
        for t in levels
        for trim in slopes
    ]
    shape = (len(levels), len(slopes))
    return table_without_doubts(body, positions, header, shape, on_error, estimate=estimate)


def _ship(
    hull: HasState, demihulls: int, separation: float | None, terms: dict[str, object]
) -> FloatingBody:
    """Give what floats: the hull, or two of it; `terms` of the header tell of two."""
    apart = checked_separation(demihulls, separation, state_of(hull).particulars.breadth)
    terms |= {"demihulls": demihulls, "separation": apart or None}
    return ship_of(body_of(hull), apart)


def _keel(header: HydrostaticHeader, draught_to: str) -> float:
    """Give what has to be taken off draughts to make them moulded ones, m."""
    choice(draught_to, "draught_to", ("moulded", "keel"), _WHERE)
    return header.keel_thickness if draught_to == "keel" else 0.0


def position_of(
    header: HydrostaticHeader,
    draught: float | None,
    draughts: tuple[float, float] | None,
    heel_deg: float,
    draught_to: str,
) -> FloatingPosition:
    """Make a moulded floating position of what was given; the design draught if nothing was."""
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


def table_without_doubts(
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
    told: tuple[str, ...] = ()
    if on_error == "report":
        positions, told = kept_dry(positions, body.limits, header.length)
    table = table_of(body, positions, header, shape=shape, estimate=estimate)
    doubts = doubts_of(body, header, positions, on_error, _WHERE, by_numbers=estimate)
    assumed = body.assumed if isinstance(body, Flotation | TunnelledBody) else ()
    return attrs.evolve(table, notes=(*told, *assumed, *doubts, *_beyond_one(table)))


def doubts_of(
    body: FloatingBody,
    header: HydrostaticHeader,
    positions: Sequence[FloatingPosition],
    on_error: str,
    where: str,
    *,
    by_numbers: bool = True,
) -> tuple[str, ...]:
    """Give the doubts about a hull: one rule and one sentence for hydrostatics and stability.

    `by_numbers`: also where the same value, computed in two ways, differs.

    Raises
    ------
    BadInputError
        There are some that refuse numbers, and they are to be refused.
    """
    doubts = tuple(body.doubts(planes_of(positions, header.length), by_numbers))
    refused = _refused(doubts)
    if refused and on_error == "refuse":
        more = f" (and {len(refused) - 1} more)" if len(refused) > 1 else ""
        raise BadInputError(refused[0] + more, where, _remedy(body, header, positions))
    return (*doubts, *_unusual_centre(header))


def _unusual_centre(header: HydrostaticHeader) -> Iterator[str]:
    """Remark on a centre of gravity where that of no ship lies."""
    if header.kg is None or 0.0 <= header.kg <= header.breadth:
        return
    where = "below the base line" if header.kg < 0.0 else (
        f"higher above the base line than the ship is broad, {header.breadth:.5g} m"
    )  # fmt: skip
    yield f"KG of {header.kg:.5g} m lies {where}: check its unit, its sign and what it counts from"


def _refused(doubts: Iterable[str]) -> list[str]:
    """Give those that refuse numbers."""
    return [each for each in doubts if not isinstance(each, MildDoubt)]


def _remedy(
    body: FloatingBody, header: HydrostaticHeader, positions: Sequence[FloatingPosition]
) -> str:
    """Say what to do about a doubt: a hull that is sound as designed needs no mending."""
    design = FloatingPosition(header.draught, header.draught)
    at_design = planes_of([design], header.length)
    if design not in positions and not _refused(body.doubts(at_design, True)):
        return (
            "at its design draught the hull is sound, so it is the position: too little of the "
            "hull is wet for its lines to tell; take a larger draught, or the numbers with "
            "on_error='report' (--on-error report)"
        )
    return "mend the hull, or take the numbers with on_error='report' (--on-error report)"


_COEFFICIENTS = ("cb", "cm", "cx", "cp", "cvp", "cw", "cb_lwl", "cp_lwl")
_ROUNDING = 1e-6


def _beyond_one(table: HydrostaticTable) -> list[str]:
    """Note coefficients above 1: at trim or heel their box is not that of the wet hull."""
    found = list[str]()
    for i, at in enumerate(table.positions):
        if not (at.trim_by_stern or at.heel_deg):
            continue
        values = {name: float(table.columns[name][i]) for name in _COEFFICIENTS}
        above = [f"{FIELDS[name].symbol} {value:.4f}" for name, value in values.items()
                 if value > 1.0 + _ROUNDING]  # fmt: skip
        if above:
            found.append(
                f"{', '.join(above)} {at}: coefficients are on Lpp, breadth and mean draught as if "
                "she were upright at even keel, and may exceed 1 at trim or heel"
            )
    return found
