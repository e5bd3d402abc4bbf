"""A small net whose sections and deck edge come from definitions by form parameters."""

import numpy as np

from assoc_hull.edit.adopt import adopt
from assoc_hull.geometry.curves import PointKind
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition import definition
from assoc_hull.model.family import BoundaryKind, Role, Sort
from assoc_hull.model.forms.definition import FormDefinition, GeneratedCurve
from assoc_hull.model.forms.forms import Forms
from assoc_hull.model.forms.generate import generated_points, layout_at, marks_for
from assoc_hull.model.make import Maker
from assoc_hull.model.restore import from_definition
from assoc_hull.model.source import LineSource
from assoc_hull.model.state import Association, HullState, Particulars

__all__ = ["formed"]

SHIP = Particulars("Formed", 100.0, 16.0, 10.0, 6.0)


CONTOUR = {
    "top_x": 0.0, "top_y": 10.0, "AP_x": 0.0, "AP_y": 0.0, "FP_x": 100.0, "FP_y": 0.0,
    "bow_x": 100.0, "bow_y": 10.0,
}  # fmt: skip


def definitions() -> tuple[FormDefinition, ...]:
    """Give the definitions."""
    areas = {
        "full": 94.0, "run_start": -1.0, "run_start_ordinate": 0.0207799,
        "run_start_angle_deg": 25.0, "run_start_curvature": 0.0, "run_start_tangent": 0.067,
        "run_end": -0.208, "run_end_angle_deg": 0.0, "run_end_curvature": 0.0,
        "run_end_tangent": 0.298, "run_area": 0.511, "run_centroid": -0.488, "top": 1.0,
        "entrance_start": 0.34, "entrance_start_angle_deg": 0.0, "entrance_start_curvature": 0.0,
        "entrance_start_tangent": 0.222, "entrance_end": 1.0, "entrance_end_ordinate": 0.0,
        "entrance_end_angle_deg": -54.0, "entrance_end_curvature": 0.0,
        "entrance_end_tangent": 0.053, "entrance_area": 0.448, "entrance_centroid": 0.584,
    }  # fmt: skip
    bare = {name: None if "area" in name or "centroid" in name else v for name, v in areas.items()}
    bare |= {name: None for name in bare if "tangent" in name}
    water = {**bare, "full": 8.0, "run_start_angle_deg": 70.0, "run_end": -0.4,
             "entrance_start": 0.5, "entrance_end_angle_deg": -65.0}  # fmt: skip
    return (
        FormDefinition("areas", "sectional_area", "halves", areas),
        FormDefinition("waterline", "design_waterline", "halves", water),
        FormDefinition("contour", "profile", "course", CONTOUR, "straight", ("top", "AP", "FP", "bow")),
        _course("deck side", "deck_side", {"AP": (0, 3), "aft": (20, 8), "fore": (80, 8), "FP": (100, 0)}, "monotone"),
        _course("sheer", "deck_height", {"AP": (0, 10), "FP": (100, 10)}, "straight"),
        _course("flare", "waterline_angle", {"AP": (0, 25), "aft": (40, 0), "fore": (60, 0), "FP": (100, 15)}, "straight"),
        _course("rise", "keel_angle", {"AP": (0, 20), "aft": (40, 89), "fore": (60, 89), "FP": (100, 20)}, "straight"),
    )  # fmt: skip


def _course(
    name: str, use: str, nodes: dict[str, tuple[float, float]], rule: str
) -> FormDefinition:
    values = {f"{n}_{axis}": float(v) for n, p in nodes.items() for axis, v in zip("xy", p, strict=True)}
    return FormDefinition(name, use, "course", values, rule, tuple(nodes))


def formed(stations: tuple[float, ...] = (15, 25, 35, 45, 55, 65, 75, 85)) -> HullState:
    """Give the net: one-way from boundary to sections, from these to waterlines."""
    forms = Forms.of(definitions(), SHIP)
    corners = np.array([[0, 0, 10], [0, 0, 0], [100, 0, 0], [100, 0, 10]], np.float64)
    sources = [
        LineSource.make(
            "boundary", "profile", corners, plane=((0, 1, 0), 0.0), boundary=BoundaryKind.END,
            kind=[0, PointKind.KNUCKLE, PointKind.KNUCKLE, 0], placed=True,
        )
    ]  # fmt: skip
    layouts = {"deck edge": _made(forms, "deck edge", np.nan, np.zeros((2, 3)))}
    edge = layouts["deck edge"][2]
    sources.append(LineSource.make("boundary", "deck edge", edge, boundary=BoundaryKind.END, placed=True))
    for x in stations:
        breadth = float(forms.value("deck_side", [x])[0])
        ends = np.array([[x, 0, 0], [x, breadth, 10]], np.float64)
        layouts[f"ST {x:g}"] = made = _made(forms, "section", x, ends)
        points = np.concatenate([ends[:1], made[2], ends[1:]])
        sources.append(LineSource.make("sections", f"ST {x:g}", points, placed=True))
    for z in (1.0, 3.0, 6.0, 8.0):
        y = [0.0, *(_at(layouts[f"ST {x:g}"][2], z) for x in stations), 0.0]
        points = np.column_stack([[0.0, *stations, 100.0], y, np.full(len(y), z)])
        sources.append(LineSource.make("waterlines", f"WL {z:g}", points, tolerance=0.3))
    links = [Association("boundary", "sections", False), Association("boundary", "waterlines", False),
             Association("sections", "waterlines", False)]  # fmt: skip
    state = adopt(sources, SHIP, links)[0]
    _register(state, layouts)
    return from_definition(definition(state))


def _made(forms, what, place, ends):
    layout = layout_at(forms, what, place, 0)
    marks = marks_for(forms, what, layout, place, ends)[0]
    curve = GeneratedCurve("", 0, what, layout, (), marks)
    return layout, marks, generated_points(forms, [curve], np.array([place]), ends[None])[0]


def _at(points, z):  # noqa
    return float(np.interp(z, points[:, 2], points[:, 1]))


def _register(state, layouts) -> None:
    journal = Journal()
    maker, curves = Maker(state, journal), []
    for line in state.live("lines").tolist():
        name = state.lines.name.data[line]
        if name not in layouts:
            continue
        curve = state.lines.curves.data[line][0]
        rows = state.curves.rows.data[curve]
        mine = rows[state.rows.sort.data[rows] == Sort.PLACED]
        journal.put(state.rows.sort, mine, int(Sort.ADOPTED))
        layout, marks, _ = layouts[name]
        what = "section" if name.startswith("ST") else name
        curves.append(GeneratedCurve(state.curves.key.data[curve], curve, what, layout, tuple(mine.tolist()), marks))
    maker.definitions(definitions())
    maker.generated(curves)
    _one_way(state, maker)


def _one_way(state: HullState, maker: Maker) -> None:
    """Let boundary curves drive what ends on them."""
    table = state.rows
    contacts = np.flatnonzero(table.alive.data & table.contact.data)
    maker.roles(contacts, np.full(len(contacts), int(Role.DRIVES_B)))
    for curve in state.live("curves").tolist():
        rows = state.curves.rows.data[curve]
        gone = np.isin(rows, contacts) & (table.curve.data[rows, 0] == curve)
        if gone.any():
            maker.define(curve, rows[~gone])
