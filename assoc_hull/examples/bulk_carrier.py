"""A 207,000 TDW bulk carrier as a net."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.adopt import AdoptionReport, adopt
from assoc_hull.edit.cut import add_line
from assoc_hull.edit.document import Document
from assoc_hull.edit.transaction import Transaction
from assoc_hull.examples import carrier_form as form
from assoc_hull.geometry.curves import EndKind, FloatArray, PointKind
from assoc_hull.model.family import BoundaryKind
from assoc_hull.model.source import LineSource
from assoc_hull.model.state import Association, Ends, HullState, Particulars
from assoc_hull.tolerance import Tolerances

__all__ = ["bulk_carrier_207k"]

STATIONS = (
    -0.25, 0.0, 0.25, 0.45, 0.5, 0.65, 0.75, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0,
    6.0, 8.0, 10.0, 12.0, 14.0,
    15.0, 15.5, 16.0, 16.5, 17.0, 17.5, 18.0, 18.25, 18.5, 18.75, 19.0, 19.2, 19.4, 19.6, 19.8,
    20.0, 20.15, 20.3,
)  # fmt: skip
WATERLINES = (
    0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0, 13.5, 15.0, 16.5, 18.0,
    20.0, 22.0, 24.5,
)  # fmt: skip
BUTTOCKS = (0.5, 1.0, 2.0, 4.0, 6.0, 8.5, 11.0, 13.5, 16.0, 18.5, 21.0, 23.5)

_SMOOTH, _TANGENT, _KNUCKLE = int(PointKind.SMOOTH), int(PointKind.TANGENT), int(PointKind.KNUCKLE)
FLAT_AFT = 21.0
_UP, _OUT, _AHEAD = (0.0, 0.0, 1.0), (0.0, 1.0, 0.0), (1.0, 0.0, 0.0)
_HALF = form.BREADTH / 2.0


class _Points:
    """Points of one curve with their kinds and directions, in order."""

    def __init__(self) -> None:
        self.xyz: list[tuple[float, float, float]] = []
        self.kind: list[int] = []
        self.direction: list[tuple[float, float, float]] = []

    def add(self, xyz, kind=_SMOOTH, direction=(0.0, 0.0, 0.0)) -> None:
        for place in np.atleast_2d(np.asarray(xyz, np.float64)).tolist():
            self.xyz.append(tuple(place))
            self.kind.append(kind)
            self.direction.append(direction)

    def source(self, group, name, **more) -> LineSource:
        return LineSource.make(
            group, name, np.array(self.xyz), kind=self.kind, direction=np.array(self.direction), **more
        )


def _section(x: float, low: float, high: float) -> LineSource:
    points = _Points()
    foot = float(form.half_breadth(np.array(x), np.array(0.0))) if low < 1e-9 and (x > FLAT_AFT) else 0.0
    side = _side_height(x)
    points.add((x, 0.0, low))
    if foot > 1e-6:
        points.add((x, foot, 0.0), _TANGENT, _OUT)
    top = side if side is not None else high
    z = _heights(x, low, top)
    if top > form.BILGE + 1e-6:
        wl = np.array(WATERLINES)
        wl = wl[(wl > low + 0.02) & (wl < top - 0.02)]
        z = np.concatenate([z[:-1][np.abs(z[:-1, None] - wl).min(axis=1) > 0.04] if len(wl) else z[:-1], wl, z[-1:]])
        z = np.sort(z)
    y = form.half_breadth(np.full(len(z), x), z)
    inner = slice(0, -1)
    if low < 1e-9 and x < FLAT_AFT:
        z = z[z > 0.4]; y = form.half_breadth(np.full(len(z), x), z)
    points.add(np.column_stack([np.full(len(z), x), y, z])[inner])
    if side is not None:
        points.add((x, _HALF, side), _TANGENT, _UP)
        points.add((x, _HALF, form.DEPTH))
    else:
        last = float(form.half_breadth(np.array(x), np.array(high)))
        points.add((x, 0.0 if high < form.DEPTH else last, high))
    ends = Ends()
    return points.source("sections", f"ST {20.0 * x / form.LENGTH:g}", ends=ends)


def _side_height(x: float) -> float | None:
    """Give where a station comes onto the flat of side (m)."""
    z = np.array(form.BILGE), np.array(form.DEPTH)
    if float(form.aft_shoulder(z[0])) <= x <= float(form.fore_shoulder(z[0])):
        return form.BILGE
    for shoulder, sense in ((form.aft_shoulder, 1.0), (form.fore_shoulder, -1.0)):
        a, b = float(shoulder(z[1])), float(shoulder(z[0]))
        if min(a, b) < x < max(a, b):
            return float(form.invert(shoulder, form.BILGE, form.DEPTH, np.array(x)))
    return None


def _heights(x: float, low: float, high: float) -> FloatArray:
    """Heights at which a section is given; close where it turns, the foot left out."""
    if low < 1e-9 and high == form.BILGE:
        return form.BILGE * (1.0 - np.cos(np.linspace(0.0, np.pi / 2.0, 13)[1:]))
    if high < form.DEPTH and _side_height(x) is None:  # a lobe
        centre = form.SHAFT if x < 150 else form.NOSE[1]
        th = np.linspace(0, np.pi, 25)[1:]
        return np.where(th < np.pi / 2, centre - (centre - low) * np.cos(th), centre - (high - centre) * np.cos(th))
    first = low + min(8.0, high - low) * (1.0 - np.cos(np.linspace(0.0, np.pi / 2.0, 17)[1:]))
    rest = high - first[-1]
    n = int(np.ceil(rest / 0.75 - 1e-9))
    return np.concatenate([first, first[-1] + rest * np.arange(1, n + 1) / n]) if n else first


def _aft_end(z: float) -> tuple[float, float]:
    h = np.array(z)
    if z < form.SHAFT - form.BOSS:
        return float(form.invert(form.skeg_bottom, form.BOSS_FORE, form.KEEL_AFT, h)), 0.0
    if z < form.SHAFT + form.BOSS:
        return form.BOSS_AFT, float(np.sqrt(form.BOSS**2 - (z - form.SHAFT) ** 2))
    if z < form.TRANSOM[1]:
        return float(form.contour_aft(h)), 0.0
    return form.TRANSOM[0], float(form.half_breadth(np.array(form.TRANSOM[0]), h))


def _fore_end(z: float) -> float:
    h = np.array(z)
    if z < form.NOSE[1]:
        return float(form.bottom_end(h))
    return float(form.contour_forward(h))


def _waterline(z: float) -> LineSource:
    (aft, y), fore = _aft_end(z), _fore_end(z)
    x = np.array(STATIONS) * form.LENGTH / 20.0
    x = np.concatenate([x, 0.5 * (x[1:] + x[:-1])[np.diff(x) < 16.0]])
    st = x[:len(STATIONS)]
    x = np.concatenate([x, aft + np.array([.1, .25, .5, .75, 1.0, 1.5, 2.0, 3.0, 4.0]), fore - np.array([.25, .5, 1.0, 2.0])])
    x = np.unique(x[(x > aft + 0.05) & (x < fore - 0.05)])
    near = np.abs(x[:, None] - st).min(axis=1); x = x[(near == 0) | (near > 0.2)]
    p = _Points()
    p.add((aft, y, z))
    a, b = float(form.aft_shoulder(np.array(z))), float(form.fore_shoulder(np.array(z)))
    def put(x):
        p.add(np.column_stack([x, form.half_breadth(x, np.full(len(x), z)), np.full(len(x), z)]))
    if z > form.BILGE:
        put(x[x < a - 0.5])
        p.add([(a, _HALF, z)], _TANGENT, _AHEAD)
        p.add([(b, _HALF, z)], _TANGENT, _AHEAD)
        put(x[x > b + 0.5])
    else:
        y0 = float(form.midship(np.array(z)))
        put(x[x < a - 0.5])
        p.add([(a, y0, z)], _TANGENT, _AHEAD)
        p.add([(b, y0, z)], _TANGENT, _AHEAD)
        put(x[x > b + 0.5])
    p.add((fore, 0.0, z))
    return p.source("waterlines", f"WL {z:g}", tolerance=WLTOL)

WLTOL = 0.5e-3

def _boundaries() -> list[LineSource]:
    found = []
    p = _Points()
    z = np.linspace(form.TRANSOM[1], form.CORNER, 50)
    p.add(np.column_stack([form.contour_aft(z), 0 * z, z])[:-1])
    p.add((form.contour_aft(z[-1]), 0, z[-1]), _KNUCKLE)
    z = np.linspace(form.CORNER, form.SHAFT + form.BOSS, 15)
    p.add(np.column_stack([form.contour_aft(z), 0 * z, z])[1:-1])
    p.add((form.BOSS_FORE, 0, z[-1]), _KNUCKLE)
    p.add((form.BOSS_AFT, 0, z[-1]))
    centre = dict(plane=((0, 1, 0), 0.0), boundary=BoundaryKind.END)
    found.append(p.source("boundary", "profile", **centre))
    p = _Points()
    p.add((form.BOSS_AFT, 0, form.SHAFT - form.BOSS))
    x = np.linspace(form.BOSS_FORE, form.KEEL_AFT, 27)
    h = form.skeg_bottom(x)
    p.add((x[0], 0, h[0]), _TANGENT, _AHEAD)
    p.add(np.column_stack([x, 0 * x, h])[1:-1])
    p.add((x[-1], 0, 0), _TANGENT, _AHEAD)
    p.add((form.KEEL_FORE, 0, 0), _TANGENT, _AHEAD)
    s = np.sin(np.linspace(0, np.pi / 2, 33))
    x = form.KEEL_FORE + (form.NOSE[0] - form.KEEL_FORE) * s
    p.add(np.column_stack([x, 0 * x, form.bulb_bottom(x)])[1:])
    z = form.NOSE[1] + (form.DEPTH - form.NOSE[1]) * np.linspace(0, 1, 61)[1:]
    p.add(np.column_stack([form.contour_forward(z), 0 * z, z]))
    found.append(p.source("boundary", "profile", **centre))
    # bossing end
    th = np.linspace(-np.pi / 2, np.pi / 2, 25)
    circle = np.column_stack([np.full(25, form.BOSS_AFT), form.BOSS * np.cos(th), form.SHAFT + form.BOSS * np.sin(th)])
    circle[[0, -1], 1] = 0.0
    found.append(LineSource.make("boundary", "bossing end", circle, plane=((1, 0, 0), form.BOSS_AFT),
        boundary=BoundaryKind.END, ends=Ends((1, 1), (_OUT, (0.0, -1.0, 0.0)))))
    x0 = form.TRANSOM[0]
    z = form.TRANSOM[1] + (form.DEPTH - form.TRANSOM[1]) * np.linspace(0, 1, 25) ** 1.5
    y = form.half_breadth(np.full(25, x0), z); y[0] = 0.0
    found.append(LineSource.make("boundary", "transom", np.column_stack([np.full(25, x0), y, z]), plane=((1, 0, 0), x0),
        boundary=BoundaryKind.END))
    # deck edge
    d = np.array(form.DEPTH)
    a, b, stem = float(form.aft_shoulder(d)), float(form.fore_shoulder(d)), float(form.contour_forward(d))
    p = _Points()
    x = np.linspace(x0, a, 40)
    p.add(np.column_stack([x, form.half_breadth(x, np.full(40, form.DEPTH)), np.full(40, form.DEPTH)])[:-1])
    p.add((a, _HALF, d), _TANGENT, _AHEAD); p.add((b, _HALF, d), _TANGENT, _AHEAD)
    x = b + (stem - b) * np.sin(np.linspace(0, np.pi / 2, 50))
    yy = form.half_breadth(x, np.full(50, form.DEPTH)); yy[-1] = 0
    p.add(np.column_stack([x, yy, np.full(50, form.DEPTH)])[1:])
    found.append(p.source("boundary", "deck edge", plane=((0, 0, 1), form.DEPTH), boundary=BoundaryKind.END))
    # flat of side
    p = _Points()
    z = form.DEPTH + (form.BILGE - form.DEPTH) * np.sin(np.linspace(0, np.pi / 2, 40))
    p.add(np.column_stack([form.aft_shoulder(z), np.full(40, _HALF), z])[:-1])
    p.add((float(form.aft_shoulder(z[-1])), _HALF, form.BILGE), _KNUCKLE)
    p.add((float(form.fore_shoulder(z[-1])), _HALF, form.BILGE), _KNUCKLE)
    p.add(np.column_stack([form.fore_shoulder(z), np.full(40, _HALF), z])[::-1][1:])
    found.append(p.source("boundary", "flat of side", plane=((0, 1, 0), _HALF), boundary=BoundaryKind.FLAT))
    # flat of bottom
    zero = np.array(0.0)
    p = _Points()
    x = np.linspace(FLAT_AFT, float(form.aft_shoulder(zero)), 60)
    p.add(np.column_stack([x, form.half_breadth(x, zero), 0 * x])[:-1])
    p.add((x[-1], _HALF - form.BILGE, 0), _TANGENT, _AHEAD)
    x = np.linspace(float(form.fore_shoulder(zero)), form.KEEL_FORE, 60)
    p.add((x[0], _HALF - form.BILGE, 0), _TANGENT, _AHEAD)
    yy = form.half_breadth(x, zero); yy[-1] = 0
    p.add(np.column_stack([x, yy, 0 * x])[1:])
    found.append(p.source("boundary", "flat of bottom", plane=((0, 0, 1), 0.0), boundary=BoundaryKind.FLAT))
    return found


_ASSOCIATIONS = (
    Association("boundary", "sections"),
    Association("boundary", "waterlines"),
    Association("boundary", "buttocks"),
    Association("sections", "waterlines"),
    Association("sections", "buttocks"),
    Association("waterlines", "buttocks"),
)


def adopted() -> tuple[HullState, AdoptionReport]:
    sources = _boundaries()
    for station in STATIONS:
        x = station * form.LENGTH / 20.0
        sources += [_section(x, *part) for part in form.intervals(x)]
    sources += [_waterline(z) for z in WATERLINES]
    ship = Particulars("bulk carrier 207,000 TDW", form.LENGTH, form.BREADTH, form.DEPTH, form.DRAUGHT)
    return adopt(sources, ship, _ASSOCIATIONS, _TOL)

_TOL = Tolerances(spacing=0.35, turn_spacing=0.3)


def bulk_carrier_207k() -> tuple[HullState, AdoptionReport]:
    state, report = adopted()
    document = Document(state)
    for group, prefix, places in (("buttocks", "BTK", BUTTOCKS),):
        with Transaction(document, f"cut {group}") as edit:
            for place in places:
                add_line(edit, group, place, f"{prefix} {place:g}", 0.6e-3)
    return state, report
