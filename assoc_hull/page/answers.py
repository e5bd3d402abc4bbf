"""What panels ask about the hull in numbers and words.

Hydrostatics and sectional areas, why something moved, where lines are wavy, which parameters there
are.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from typing import Any

import numpy as np

from assoc_hull.analysis.hydrostatics.floating_body import FloatingPosition
from assoc_hull.analysis.hydrostatics.record import FIELDS, Hydrostatics, RecordField
from assoc_hull.analysis.hydrostatics.section_areas import (
    sectional_area_course,
    sectional_areas,
)
from assoc_hull.edit.explain.causes import Why
from assoc_hull.geometry.curves import SplineBatch
from assoc_hull.geometry.fairness.inflections import inflections
from assoc_hull.hull.hull import Hull
from assoc_hull.model.address import AddressBook
from assoc_hull.model.tables import HullState
from assoc_hull.variation.carrying.admissible_values import list_parameters

__all__ = ["describe_fairness", "describe_hydrostatics", "describe_parameters", "describe_why"]

_SHOWN = ("volume", "displacement", "lcb", "kb", "bmt", "bml", "kmt", "lcf", "waterplane_area",
          "wetted_surface", "lwl", "bwl", "cb", "cp", "cm", "cw")  # fmt: skip
_MOST = 5
"""Causes below one thing that are told; the others are counted."""

_ALL = 24
"""So many causes are told at most."""

_SLIGHT = 5e-5
"""Causes that moved less (m) are counted, but for the first."""

_STOPS = 3
_LINES, _POINTS = 15, 10


def describe_hydrostatics(now: Hull, then: Hull) -> dict[str, Any]:
    """Measure two copies at their design draught: values and sectional areas of now and then.

    What cannot be measured is None. Areas are m2, of both sides, at x in m from AP.
    """
    after, before = (each.hydrostatics(on_error="report") for each in (now, then))
    return {
        "draught": now.particulars.draught,
        "values": [_value(FIELDS[name], before, after) for name in _SHOWN],
        "notes": list(after.notes),
        "areas": _areas(now), "areas_before": _areas(then),
    }  # fmt: skip


def _value(field: RecordField, before: Hydrostatics, after: Hydrostatics) -> dict[str, Any]:
    value, old = getattr(after, field.name), getattr(before, field.name)
    return {
        "name": field.symbol, "unit": field.unit, "meaning": field.title, "digits": field.digits,
        "value": value,
        "change": None if value is None or old is None else value - old,
        "error": after.error.get(field.name),
    }  # fmt: skip


def _areas(hull: Hull) -> list[list[float]]:
    draught = hull.particulars.draught
    position = FloatingPosition(draught, draught)
    # The water line goes on beyond the perpendiculars, where no station may stand.
    if (course := sectional_area_course(hull, position)) is not None:
        return [course[:, 0].tolist(), course[:, 1].tolist()]
    found = sectional_areas(hull, position)
    return [found.x.tolist(), found.area[0].tolist()]


def describe_why(why: Why, moves: Mapping[str, tuple[float, float]]) -> dict[str, Any]:
    """Give the causes of a change as a tree: each with its name, and what happened to it.

    ``moved`` and ``slid`` are the movement off the hull and along it (m), of `moves` by key.
    """

    def far(each: Why) -> float:
        return moves.get(each.object, (0.0, 0.0))[0]

    tree = _cause(why, moves)
    waiting, opened, room = deque([(why, tree)]), set[str](), _ALL
    while waiting:  # the nearest causes first, so that the farthest are those that are counted
        each, told = waiting.popleft()
        if each.object in opened:
            continue
        opened.add(each.object)
        largest = sorted(each.causes, key=lambda cause: -far(cause))[: min(_MOST, room)]
        shown = [
            cause for number, cause in enumerate(largest)
            if number == 0 or cause.moved is None or far(cause) >= _SLIGHT
        ]  # fmt: skip
        room -= len(shown)
        told["left"] = each.left + len(each.causes) - len(shown)
        told["causes"] = [_cause(cause, moves) for cause in shown]
        waiting.extend(zip(shown, told["causes"], strict=True))
    return {"edit": why.edit, "step": why.step, "because": why.because, "tree": tree}


def _cause(why: Why, moves: Mapping[str, tuple[float, float]]) -> dict[str, Any]:
    moved, slid = moves.get(why.object, (why.moved, 0.0))
    return {"name": why.name, "what": why.what, "moved": moved, "left": 0,
            "slid": slid if slid >= _SLIGHT else None,
            "stopped": list(why.stopped[:_STOPS]), "causes": []}  # fmt: skip


def _bends(state: HullState, names: list[str]) -> list[int]:
    """Count inflections of curves as the picture marks them: between bends that can be seen."""
    if not names:
        return []
    book = AddressBook(state)
    known = {book.curve_name(curve): curve for curve in state.live("curves").tolist()}
    curves = np.array([known[name] for name in names])
    line = state.curves.line[curves]
    normals = np.where(state.lines.planar[line][:, None], state.lines.normal[line], np.nan)
    batch = SplineBatch.join([state.spline(curve) for curve in curves.tolist()])
    return [int(count) for count in inflections(batch, normals)[0]]


def describe_fairness(hull: Hull) -> dict[str, Any]:
    """Give the waviest lines first, how far (m) battens spring there, and points out of line."""
    found = hull.fairness()
    wavy = [
        (record, batten) for record, batten in zip(found.records, found.battens, strict=True)
        if batten is not None
    ]  # fmt: skip
    wavy.sort(key=lambda each: (-each[1].ratio, -each[1].largest, each[0].name))
    shown = wavy[:_LINES]
    bends = _bends(hull.state, [record.name for record, _ in shown])
    lines = [
        {"line": record.name, "springs": batten.there, "ratio": batten.ratio, "at": batten.at,
         "inflections": None if record.inflections is None else count}
        for (record, batten), count in zip(shown, bends, strict=True)
    ]  # fmt: skip
    doctor = hull.doctor(top=_POINTS)
    return {
        "lines": lines,
        "unfair": [
            {"line": each.line, "point": each.point, "residual": each.residual,
             "expected": each.expected, "ratio": each.ratio} for each in found.unfair[:_POINTS]
        ],
        "points": [
            {"point": each.point, "off": each.off, "score": each.score, "alarm": each.alarm}
            for each in doctor.findings[:_POINTS]
        ],
    }  # fmt: skip


def describe_parameters(hull: Hull, of: str | None = None) -> list[dict[str, Any]]:
    """Give the named parameters of a hull: value, unit, or the reason for none; limits of one."""
    return [
        {"name": each.name, "unit": each.unit, "meaning": each.meaning, "value": each.value,
         "low": each.fair_low, "high": each.fair_high,
         "least": each.low, "most": each.high, "reason": each.reason}
        for each in list_parameters(hull.state, limits=() if of is None else (of,))
    ]  # fmt: skip
