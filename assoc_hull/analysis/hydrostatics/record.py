"""The record of hydrostatics, the table of records, their header, and what each value is.

`FIELDS` holds symbol, unit, datum, sign and formula of each value, after the ITTC's list and
Principles of Naval Architecture (vol. I, 1988). A `HydrostaticTable` holds columns (d,) over
draughts and trims; a `Hydrostatics` is one row of it. The header says what the numbers hold good
for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from html import escape
from types import MappingProxyType
from typing import Any

import attrs
import numpy as np
from numpy.typing import NDArray

from assoc_hull.analysis.hydrostatics.floating_body import Appendage, FloatingPosition, Freeboard
from assoc_hull.arguments import all_of, checked, flag, not_negative, number, plain, positive, text
from assoc_hull.display import ShownAsText, html_table
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.model.named_mapping import NamedMapping
from assoc_hull.model.tunnel_definition import TunnelDefinition

__all__ = [
    "FIELDS",
    "FRESH",
    "SALT",
    "AppendageShare",
    "HydrostaticHeader",
    "HydrostaticTable",
    "Hydrostatics",
    "RecordField",
    "record_of_row",
]

# --------------------------------------------------------------------------------------
# Fields. Symbols are those of the ITTC's list (ITTC Symbols and Terminology List, version 2021,
# 2.2.1 and 2.2.3), where it has one. Formulas are those of E.V. Lewis, ed., Principles of Naval
# Architecture, vol. I, SNAME 1988, ch. I, for a floating plane that may be trimmed and heeled. L is
# Lpp, B the moulded breadth, T the mean draught; tt and th are the tangents of trim and heel and
# ``s = sqrt(1 + tt^2 + th^2)``, ``c = sqrt(1 + tt^2)``.


@attrs.frozen
class RecordField:
    """What a value is.

    Attributes
    ----------
    name, symbol, unit : str
        As in the record; as on paper; a dash where there is none.
    title : str
        In words, with datum and sign.
    formula : str
        How it follows from the integrals.
    digits : int
        After the point, in a table for people.
    """

    name: str
    symbol: str
    unit: str
    title: str
    formula: str
    digits: int


_FIELDS = (
    RecordField("volume", "∇", "m3", "displacement volume, moulded, with appendages",
          "integral of dV below the plane", 2),
    RecordField("displacement", "Δ", "t", "displacement mass", "rho V shell_factor", 2),
    RecordField("lcb", "LCB", "m", "centre of buoyancy, from AP, + forward",
                "integral of x dV / V", 4),
    RecordField("lcb_percent", "LCB%", "% L", "centre of buoyancy from midship, + forward",
          "100 (LCB - L/2) / L", 4),
    RecordField("tcb", "TCB", "m", "centre of buoyancy from the centre plane, + to port",
          "integral of y dV / V", 4),
    RecordField("kb", "KB", "m", "centre of buoyancy above the base line: its z, also when heeled",
          "integral of z dV / V", 4),
    RecordField("waterplane_area", "A_W", "m2", "area of the true, inclined waterplane",
                "s A_proj", 2),
    RecordField("lcf", "LCF", "m", "centre of flotation, from AP, + forward",
                "integral of x dA / A", 4),
    RecordField("tcf", "TCF", "m", "centre of flotation from the centre plane, + to port",
          "integral of y dA / A", 4),
    RecordField("i_t", "I_T", "m4", "transverse second moment of the true waterplane, about its "
          "longitudinal axis through its centroid", "(s^3 / c^2) I_T_proj", 1),
    RecordField("i_l", "I_L", "m4", "longitudinal second moment of the true waterplane, about its "
          "transverse axis through its centroid",
          "s (c^2 I_L_proj - 2 tt th I_LT_proj + (tt th / c)^2 I_T_proj)", 0),
    RecordField("i_lt", "I_LT", "m4", "product of inertia of the true waterplane about these axes",
          "s^2 (I_LT_proj - tt th I_T_proj / c^2)", 1),
    RecordField("bmt", "BM_T", "m", "transverse metacentric radius", "I_T / V", 4),
    RecordField("bml", "BM_L", "m", "longitudinal metacentric radius", "I_L / V", 3),
    RecordField("kmt", "KM_T", "m", "transverse metacentre above the base line; none when heeled",
          "KB + BM_T", 4),
    RecordField("kml", "KM_L", "m", "longitudinal metacentre above the base line; none when heeled",
          "KB + BM_L", 3),
    RecordField("gmt", "GM_T", "m", "transverse metacentric height; none without KG, or heeled",
          "KM_T - KG", 4),
    RecordField("gml", "GM_L", "m", "longitudinal metacentric height; none without KG, or heeled",
          "KM_L - KG", 3),
    RecordField("tpc", "TPC", "t/cm", "weight that immerses by 1 cm", "rho A_W / 100", 3),
    RecordField("mtc", "MTC", "t m/cm", "moment that trims by 1 cm between the perpendiculars",
          "rho V GM_L / (100 L); with BM_L for GM_L where GM_L is none", 3),
    RecordField("wetted_surface", "S", "m2", "wetted surface, by the true surface element, with "
          "appendages; the transom if asked for", "integral of dS", 2),
    RecordField("wetted_surface_girth", "S_G", "m2", "girths of the sections integrated over the "
          "length; bare hull; less than S, named for comparison with published values",
          "integral of girth dx", 2),
    RecordField("transom_area", "A_T", "m2", "immersed area of the transom", "in its own plane", 3),
    RecordField("lwl", "L_WL", "m", "length of the waterplane along x", "x_most - x_least", 3),
    RecordField("bwl", "B_WL", "m", "breadth of the waterplane along y", "y_most - y_least", 3),
    RecordField("a_max", "A_X", "m2", "area of the largest station", "largest A(x)", 3),
    RecordField("x_a_max", "x_X", "m", "where the largest station is, from AP, + forward",
                "x of A_X", 3),
    RecordField("a_midship", "A_M", "m2", "area of the section at L/2", "A(L/2)", 3),
    RecordField("cb", "C_B", "-", "block coefficient", "V / (L B T)", 5),
    RecordField("cm", "C_M", "-", "midship section coefficient", "A_M / (B T)", 5),
    RecordField("cx", "C_X", "-", "coefficient of the largest section", "A_X / (B T)", 5),
    RecordField("cp", "C_P", "-", "prismatic coefficient, on the largest section",
                "V / (A_X L)", 5),
    RecordField("cvp", "C_VP", "-", "vertical prismatic coefficient", "C_B / C_W", 5),
    RecordField("cw", "C_W", "-", "waterplane coefficient", "A_W / (L B)", 5),
    RecordField("cb_lwl", "C_B,WL", "-", "block coefficient on the waterplane's dimensions",
          "V / (L_WL B_WL T)", 5),
    RecordField("cp_lwl", "C_P,WL", "-", "prismatic coefficient on the waterplane's length",
          "V / (A_X L_WL)", 5),
    RecordField("draught_mean", "T", "m", "mean of the draughts at AP and FP, moulded",
          "(T_A + T_F) / 2", 4),
    RecordField("trim_by_stern", "t", "m", "trim, + by the stern", "T_A - T_F", 4),
    RecordField("waterplane_area_proj", "A_proj", "m2", "area of the waterplane in plan",
          "integral of dx dy", 2),
    RecordField("i_t_proj", "I_T_proj", "m4",
                "transverse second moment in plan, about the centroid",
          "integral of (y - TCF)^2 dx dy", 1),
    RecordField("i_l_proj", "I_L_proj", "m4",
                "longitudinal second moment in plan, about the centroid",
          "integral of (x - LCF)^2 dx dy", 0),
    RecordField("i_lt_proj", "I_LT_proj", "m4", "product of inertia in plan, about the centroid",
          "integral of (x - LCF)(y - TCF) dx dy", 1),
)  # fmt: skip

FIELDS: Mapping[str, RecordField] = MappingProxyType({each.name: each for each in _FIELDS})
"""The values of a record by name, in their order."""


# --------------------------------------------------------------------------------------
# The record.

_MAY_LACK = frozenset({"kmt", "kml", "gmt", "gml"})
"""Values that some positions do not have."""


def _frozen(values: Mapping[str, float | None]) -> Mapping[str, float | None]:
    return NamedMapping("value", values)


@attrs.frozen(eq=False, repr=False)
class Hydrostatics(ShownAsText):
    """Hydrostatics at one floating position, both sides, in ship axes.

    x is from AP, + forward; y + to port; z from the base line, up; m, t, m3. `FIELDS` in
    `assoc_hull.analysis.hydrostatics.record` tells of each value its symbol, unit, datum, sign
    and formula, in the order of this record. Lpp and moulded breadth stand in every coefficient
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
        By the true surface element, with appendages, without a closed deck that is under water
        and without the transom unless asked for; girths of the bare hull integrated over the
        length; the transom.
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

    def __str__(self) -> str:
        rows = self._shown()
        wide = [max(len(row[column]) for row in rows) for column in range(3)]
        lines = [
            f"{symbol:<{wide[0]}}  {value:>{wide[1]}}  {off:<{wide[2]}}  {title}".rstrip()
            for symbol, value, off, title in rows
        ]
        return "\n".join([*lines, *self.notes])

    def _repr_html_(self) -> str:
        head = ("", "value", "may be off by", "")
        notes = "".join(f"<p>{escape(each)}</p>" for each in self.notes)
        return html_table(head, self._shown(), right=(1,)) + notes

    def _shown(self) -> list[tuple[str, str, str, str]]:
        """Give symbol, value with unit, how far it may be off, and title, of what has a value."""
        found = list[tuple[str, str, str, str]]()
        for name, field in FIELDS.items():
            value, off = getattr(self, name), self.error.get(name)
            if value is None:
                continue
            unit = "" if field.unit == "-" else f" {field.unit}"
            may = "" if off is None else f"± {off:,.0f}" if off >= 1.0 else f"± {off:.1g}"
            symbol = name if field.symbol == "-" else field.symbol
            found.append((symbol, f"{value + 0.0:,.{field.digits}f}{unit}", may, field.title))
        return found


def record_of_row(
    columns: Mapping[str, NDArray[np.float64]],
    errors: Mapping[str, NDArray[np.float64]],
    i: int,
    notes: Sequence[str] = (),
) -> Hydrostatics:
    """Give the record of position i from columns (d,); nan, and a missing error, become None.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.analysis.hydrostatics.record import record_of_row
    >>> from assoc_hull.analysis.hydrostatics.record import FIELDS
    >>> found = record_of_row({name: np.array([1.0]) for name in FIELDS}, {}, 0)
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


# --------------------------------------------------------------------------------------
# The header.

SALT, FRESH = 1.025, 1.000
"""Densities of salt and fresh water, t/m3."""

_WHERE = "in hydrostatics"
_WATERS = {SALT: "salt water", FRESH: "fresh water"}


def _appendages(values: object) -> tuple[Appendage, ...]:
    return tuple(all_of(values, Appendage, "appendages", _WHERE))


@attrs.frozen
class HydrostaticHeader:
    """What a table of hydrostatics holds good for.

    Attributes
    ----------
    ship : str
        Name.
    length, breadth, draught : float, m
        Lpp, moulded breadth, moulded design draught.
    rho : float, t/m3
        Density of the water.
    shell_factor : float
        Displacement over that of the moulded volume.
    kg : float or None, m
        Centre of gravity above the base line, if one was given.
    keel_thickness : float, m
        From the base line down to the underside of keel.
    transom : bool
        The immersed transom is a part of the wetted surface.
    deck : str
        "open" or "closed".
    appendages : tuple of Appendage
        That are added to the moulded hull.
    fingerprint : str
        Of the hull.
    date : str or None
        As the caller gives it.
    demihulls : int
        2 where the numbers are those of a ship of two demihulls, each of them this hull.
    separation : float or None, m
        Between their centre planes.
    tunnels : tuple of TunnelDefinition
        Of the hull, which are taken off as far as each is immersed.
    """

    ship: str
    length: float
    breadth: float
    draught: float
    rho: float = attrs.field(converter=plain, validator=checked(positive, _WHERE))
    shell_factor: float = attrs.field(converter=plain, validator=checked(positive, _WHERE))
    kg: float | None = attrs.field(
        converter=attrs.converters.optional(plain),
        validator=attrs.validators.optional(checked(number, _WHERE)),
    )
    keel_thickness: float = attrs.field(converter=plain, validator=checked(not_negative, _WHERE))
    transom: bool = attrs.field(validator=checked(flag, _WHERE))
    deck: str
    appendages: tuple[Appendage, ...] = attrs.field(converter=_appendages)
    fingerprint: str
    date: str | None = attrs.field(
        default=None, validator=attrs.validators.optional(checked(text, _WHERE))
    )
    demihulls: int = 1
    separation: float | None = None
    tunnels: tuple[TunnelDefinition, ...] = ()

    def __attrs_post_init__(self) -> None:
        held = {each.name for each in self.tunnels}
        twice = [each.name for each in self.appendages if each.name in held]
        if twice:
            what = f"{twice[0]!r} is a tunnel that the hull holds: it is taken off already"
            raise BadInputError(what, _WHERE, "leave it out of the appendages")

    @property
    def water(self) -> str:
        """The water in words."""
        return f"{_WATERS.get(self.rho, 'water')}, {self.rho:.6g} t/m3"

    @property
    def datum(self) -> str:
        """Origin, axes and signs in words."""
        return (
            "x from AP, + forward; y from the centre plane, + to port; z from the base line, up; "
            "draughts moulded, on the centre line at the perpendiculars; trim + by the stern; "
            "heel + starboard down"
        )

    def lines(self) -> Iterator[tuple[str, str]]:
        """Give the head as pairs of a title and words."""
        yield "ship", self.ship
        yield "Lpp, B, T", f"{self.length:.3f} m, {self.breadth:.3f} m, {self.draught:.3f} m"
        if self.separation is not None:
            yield (
                "ship",
                f"of two demihulls, centre planes {self.separation:g} m apart: volumes, areas and "
                "moments are the ship's, y from her centre plane; B is that of a demihull, and "
                "coefficients are on twice it",
            )
        yield "datum", self.datum
        yield "water", self.water
        yield "shell factor", f"{self.shell_factor:g}"
        yield "KG", "not given" if self.kg is None else f"{self.kg:g} m"
        yield (
            "keel",
            (
                f"draught to the underside of keel is the moulded one + {self.keel_thickness:g} m"
                if self.keel_thickness
                else "no keel thickness given: draughts are moulded"
            ),
        )
        yield "wetted surface", "with the transom" if self.transom else "without the transom"
        yield "deck", self.deck
        yield from self._added()
        for tunnel in self.tunnels:
            yield (
                "tunnel",
                f"{tunnel.name}: {2.0 * tunnel.radius:g} m across at x {tunnel.x:g}, "
                f"z {tunnel.z:g} m, taken off as far as it is immersed",
            )
        if self.date is not None:
            yield "date", self.date
        yield "fingerprint", self.fingerprint

    def _added(self) -> Iterator[tuple[str, str]]:
        if not self.appendages:
            yield "appendages", "none" if self.tunnels else "none: bare hull"
        for each in self.appendages:
            x, y, z = each.centroid
            yield (
                "appendage",
                f"{each.name}: {each.volume:g} m3 at ({x:g}, {y:g}, {z:g}) m, {each.area:g} m2",
            )


# --------------------------------------------------------------------------------------
# The table.


def _columns(values: Mapping[str, FloatArray]) -> Mapping[str, FloatArray]:
    for each in values.values():
        freeze(each)
    return NamedMapping("value", values)


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


_SHORT = ("volume", "displacement", "lcb", "kb", "waterplane_area", "lcf", "kmt", "tpc", "mtc",
          "cb", "cw")  # fmt: skip
"""What a table prints; it fits a screen."""


@attrs.frozen(eq=False, repr=False)
class HydrostaticTable(ShownAsText):
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

    def __str__(self) -> str:
        head, rows = self._printed()
        wide = [max(map(len, column)) for column in zip(*head, *rows, strict=True)]
        lines = [
            "  ".join(f"{cell:>{size}}" for cell, size in zip(row, wide, strict=True))
            for row in (*head, *rows)
        ]
        more = (
            f"{len(self.columns) - len(_SHORT)} more values in columns, a whole record in rows[i]"
        )
        return "\n".join([*lines, more, *self.notes])

    def _repr_html_(self) -> str:
        (names, units), rows = self._printed()
        head = [
            f"{name}, {unit}" if unit else name for name, unit in zip(names, units, strict=True)
        ]
        notes = "".join(f"<p>{escape(each)}</p>" for each in self.notes)
        return html_table(head, rows, right=range(len(head))) + notes

    def _printed(self) -> tuple[tuple[list[str], list[str]], list[list[str]]]:
        """Give names and units, and rows, of draughts and of the values that are asked most."""
        names, units, columns = [], [], []
        titles = {"draught_aft": "T_A", "draught_fore": "T_F", "heel_deg": "heel"}
        for name, values in self.draughts.items():
            names.append(titles.get(name, name))
            units.append("deg" if name == "heel_deg" else "m")
            columns.append([f"{each + 0.0:.3f}" for each in values.tolist()])
        for name in _SHORT:
            field, values = FIELDS[name], self.columns[name]
            if np.isnan(values).all():
                continue
            digits = min(field.digits, 3)
            names.append(field.symbol)
            units.append("" if field.unit == "-" else field.unit)
            columns.append([
                "-" if np.isnan(each) else f"{each + 0.0:.{digits}f}" for each in values.tolist()
            ])  # fmt: skip
        return (names, units), [list(row) for row in zip(*columns, strict=True)]

    def __len__(self) -> int:
        return len(self.positions)

    def __getitem__(self, place: int | tuple[int, int]) -> Hydrostatics:
        if isinstance(place, tuple):
            place = int(np.arange(len(self)).reshape(self.shape)[place])
        return record_of_row(self.columns, self.errors, range(len(self))[place], self.notes)

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
