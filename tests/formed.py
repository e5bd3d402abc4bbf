"""A small net whose sections and deck edge come from definitions by form parameters."""

import attrs
import numpy as np

from assoc_hull.edit.adoption.adopt_lines import adopt
from assoc_hull.geometry.curves import FloatArray, PointKind
from assoc_hull.graph.journal import Journal
from assoc_hull.model.definition.records import definition
from assoc_hull.model.definition.restore import from_definition
from assoc_hull.model.form_definition import FormDefinition, GeneratedCurve
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.generate_points import generated_points, marks_for
from assoc_hull.model.forms.line_layout import layout_at
from assoc_hull.model.kinds import BoundaryKind, Role, Sort
from assoc_hull.model.line_source import LineSource
from assoc_hull.model.make_objects import Maker
from assoc_hull.model.tables import Association, Ends, HullState, Particulars

__all__ = ["SHIP", "STATIONS", "formed", "formed_definitions"]

SHIP = Particulars("Formed", 100.0, 16.0, 10.0, 6.0)
STATIONS = (15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 85.0)

_AREAS = {
    "full": 94.0, "run_start": -1.0, "run_start_ordinate": 0.0207799,
    "run_start_angle_deg": 25.0, "run_start_curvature": 0.0, "run_start_tangent": 0.067,
    "run_end": -0.208, "run_end_angle_deg": 0.0, "run_end_curvature": 0.0,
    "run_end_tangent": 0.298, "run_area": 0.511, "run_centroid": -0.488, "top": 1.0,
    "entrance_start": 0.34, "entrance_start_angle_deg": 0.0, "entrance_start_curvature": 0.0,
    "entrance_start_tangent": 0.222, "entrance_end": 1.0, "entrance_end_ordinate": 0.0,
    "entrance_end_angle_deg": -54.0, "entrance_end_curvature": 0.0,
    "entrance_end_tangent": 0.053, "entrance_area": 0.448, "entrance_centroid": 0.584,
}  # fmt: skip
_FREE = ("run_area", "run_centroid", "entrance_area", "entrance_centroid", "run_start_tangent",
         "run_end_tangent", "entrance_start_tangent", "entrance_end_tangent")  # fmt: skip
_WATER = {
    **{name: value for name, value in _AREAS.items() if name not in _FREE},
    "full": 8.0, "run_start_angle_deg": 70.0, "run_end": -0.4, "entrance_start": 0.5,
    "entrance_end_angle_deg": -65.0,
}  # fmt: skip

Nodes = dict[str, tuple[float, float]]


def formed_definitions() -> tuple[FormDefinition, ...]:
    """Give the definitions."""
    slow: Nodes = {"AP": (0, 25), "aft": (40, 0), "fore": (60, 0), "FP": (100, 15)}
    rise: Nodes = {"AP": (0, 20), "aft": (40, 89), "fore": (60, 89), "FP": (100, 20)}
    side: Nodes = {"AP": (0, 3), "aft": (20, 8), "fore": (80, 8), "FP": (100, 0)}
    keel: Nodes = {"top": (0, 10), "AP": (0, 0), "FP": (100, 0), "bow": (100, 10)}
    return (
        FormDefinition("areas", "sectional_area", "halves", _AREAS),
        FormDefinition("waterline", "design_waterline", "halves", _WATER),
        _course("contour", "profile", keel, "straight"),
        _course("deck side", "deck_side", side, "monotone"),
        _course("sheer", "deck_height", {"AP": (0, 10), "FP": (100, 10)}, "straight"),
        _course("flare", "waterline_angle", slow, "straight"),
        _course("rise", "keel_angle", rise, "straight"),
    )


def _course(name: str, use: str, nodes: Nodes, rule: str) -> FormDefinition:
    values = {f"{node}_x": float(place[0]) for node, place in nodes.items()}
    values |= {f"{node}_y": float(place[1]) for node, place in nodes.items()}
    return FormDefinition(name, use, "course", values, rule, tuple(nodes))


@attrs.frozen(eq=False)
class _Made:
    """A generated line before it is in a net."""

    curve: GeneratedCurve
    points: FloatArray
    kinds: tuple[int, ...]
    directions: FloatArray
    ends: Ends


def formed(stations: tuple[float, ...] = STATIONS) -> HullState:
    """Give the net: one-way from boundary to sections, from these to waterlines; no buttock."""
    forms = Forms.of(formed_definitions(), SHIP)
    made = {"deck edge": _made(forms, "deck edge", np.nan, np.zeros((2, 3)))}
    for x in stations:
        breadth = float(forms.value("deck_side", x)[0])
        made[f"ST {x:g}"] = _made(
            forms, "section", x, np.array([[x, 0.0, 0.0], [x, breadth, 10.0]])
        )
    pairs = [("boundary", "sections"), ("boundary", "waterlines"), ("sections", "waterlines")]
    pairs += [(giver, "buttocks") for giver in ("boundary", "sections", "waterlines")]
    links = [Association(giver, taker, two_way=False) for giver, taker in pairs]
    state = adopt([_profile(), *_sources(made, stations)], SHIP, links)[0]
    _register(state, made)
    return from_definition(definition(state))


def _made(forms: Forms, what: str, place: float, ends: FloatArray) -> _Made:
    layout = layout_at(forms, what, place, 0)
    marks, kinds, directions, conditions = marks_for(forms, what, layout, place, ends)
    curve = GeneratedCurve("", 0, what, layout, (), marks)
    points = generated_points(forms, [curve], np.array([place]), ends[None])[0]
    if what == "section":
        points = np.concatenate([ends[:1], points, ends[1:]])
        kinds = (0, *kinds, 0)
        directions = np.concatenate([np.zeros((1, 3)), directions, np.zeros((1, 3))])
    return _Made(curve, points, kinds, directions, conditions)


def _profile() -> LineSource:
    corners = np.array([[0, 0, 10], [0, 0, 0], [100, 0, 0], [100, 0, 10]], np.float64)
    kinds = [0, PointKind.KNUCKLE, PointKind.KNUCKLE, 0]
    return LineSource.make(
        "boundary", "profile", corners, plane=((0, 1, 0), 0.0), boundary=BoundaryKind.END,
        kind=kinds, placed=True,
    )  # fmt: skip


def _sources(made: dict[str, _Made], stations: tuple[float, ...]) -> list[LineSource]:
    found = []
    for name, each in made.items():
        edge = name == "deck edge"
        found.append(
            LineSource.make(
                "boundary" if edge else "sections", name, each.points, kind=each.kinds,
                direction=each.directions, ends=each.ends, placed=True,
                boundary=BoundaryKind.END if edge else None,
            )
        )  # fmt: skip
    for z in (1.0, 3.0, 6.0, 8.0):
        y = [_breadth(made[f"ST {x:g}"].points, z) for x in stations]
        x = np.array([0.0, *stations, 100.0])
        points = np.column_stack([x, [0.0, *y, 0.0], np.full(len(x), z)])
        found.append(LineSource.make("waterlines", f"WL {z:g}", points, tolerance=0.3))
    return found


def _breadth(points: FloatArray, z: float) -> float:
    return float(np.interp(z, points[:, 2], points[:, 1]))


def _register(state: HullState, made: dict[str, _Made]) -> None:
    """Turn the points of generated lines into generated ones, and contacts into driven ones."""
    journal = Journal()
    maker, curves, table = Maker(state, journal), [], state.rows
    contacts = np.flatnonzero(table.alive.data & table.contact.data)
    maker.roles(contacts, np.full(len(contacts), int(Role.DRIVES_B)))
    for line in state.live("lines").tolist():
        curve, name = state.lines.curves[line][0], state.lines.name[line]
        rows = state.curves.rows[curve]
        gone = np.isin(rows, contacts) & (table.curve[rows, 0] == curve)
        maker.define(curve, rows[~gone])
        if name in made:
            mine = rows[table.sort[rows] == Sort.PLACED]
            journal.put(table.sort, mine, int(Sort.ADOPTED))
            key = str(state.curves.key[curve])
            curves.append(made[name].curve.evolve(key=key, curve=curve, rows=tuple(mine.tolist())))
    maker.definitions(formed_definitions())
    maker.generated(curves)
