"""A drawing of ours read as what it was: splines, and what its record tells of each by number."""

from __future__ import annotations

import attrs

from assoc_hull.geometry.patches.spline_curve import SplineCurve
from assoc_hull.io.dxf.document import IN_SPACE, NAMES
from assoc_hull.io.dxf.entities import DrawingEntity, drawing_entities, drawing_unit, drawn_spline
from assoc_hull.io.lines.own_lines import BETWEEN, OwnLines, TextedCurve, own_lines
from assoc_hull.io.units import METRES

__all__ = ["own_dxf_lines"]

_DRAWN = (
    "SPLINE", "LINE", "POLYLINE", "LWPOLYLINE", "ARC", "CIRCLE", "ELLIPSE", "HELIX", "MLINE",
    "INSERT",
)  # fmt: skip


def own_dxf_lines(text: str, source: str) -> OwnLines | None:
    """Give the lines of a drawing of ours in space; None if it is none.

    Raises
    ------
    BadInputError
        A group code or a spline that is none.
    """
    if NAMES not in text or IN_SPACE not in text:
        return None
    entities = drawing_entities(text, source)
    records = [told for each in entities if (told := _record(each))]
    if not records:
        return None
    if len(records) > 1:
        return OwnLines(fault=f"it has {len(records)} texts of a hull")
    unit = drawing_unit(entities)
    if unit is None:
        return OwnLines(fault="its header tells no unit any more")
    hull, *texts = records[0].split(BETWEEN)
    left = {str(number): told for number, told in enumerate(texts)}
    curves, others = list[TextedCurve](), list[str]()
    for entity in entities:
        # A copy of a curve has the number of the curve, whose text is taken already.
        told = left.pop(_number(entity), "") if entity.kind == "SPLINE" else ""
        if told and entity.number(73):
            curves.append(TextedCurve(told, _spline(entity, METRES[unit])))
        elif entity.kind in _DRAWN:
            others.append(f"{entity.kind} at {entity.where}")
    return attrs.evolve(own_lines(hull, curves, others), unit=unit)


def _record(entity: DrawingEntity) -> str:
    """Give the text of a record of ours, empty if it is another's."""
    words = [value for code, value, _ in entity.codes if code == 1]
    return "".join(words[1:]) if entity.kind == "XRECORD" and words[:1] == [NAMES] else ""


def _number(entity: DrawingEntity) -> str:
    """Give the number of a curve in space, empty if it has none."""
    ours = entity.extended(NAMES)
    words = [] if ours is None else [value for code, value, _ in ours.codes if code == 1000]
    return words[3] if words[2:3] == [IN_SPACE] and len(words) == 4 else ""


def _spline(entity: DrawingEntity, metres: float) -> SplineCurve:
    """Give a spline in m."""
    raw = drawn_spline(entity)
    points = raw.control[:, :3] * metres if metres != 1.0 else raw.control[:, :3].copy()
    weights = raw.control[:, 3].copy() if raw.control.shape[1] > 3 else None
    return SplineCurve(entity.where, raw.degree, raw.knots, points, weights)
