"""Where a waterline runs straight along a flat of the definitions."""

from __future__ import annotations

import numpy as np

from assoc_hull.edit.followup.thread import thread
from assoc_hull.edit.transaction import Transaction
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.definition_part import GeneratedCurve
from assoc_hull.model.forms.forms import Forms
from assoc_hull.model.forms.generate import generated_points, marks_for
from assoc_hull.model.forms.layout import layout_at
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.regenerate import ends_of, place_of

__all__ = ["go_straight"]


def go_straight(edit: Transaction, forms: Forms, line: int) -> None:
    """Give a waterline the two points at which it comes onto its flat and leaves it.

    Between them it is straight: they are tangent points, which the definitions generate.

    Parameters
    ----------
    edit : Transaction
        The edit in which the line was cut.
    forms : Forms
        The definitions.
    line : int
        The waterline.
    """
    state = edit.state
    z = float(state.lines.offset.data[line])
    layout = layout_at(forms, "waterline", z)
    curves = [curve for curve in state.lines.curves.data[line] if state.curves.alive.data[curve]]
    if not layout or len(curves) != 1:
        return
    curve = curves[0]
    ends = ends_of(state, curves)[0]
    marks, kind, direction, _ = marks_for(forms, "waterline", layout, z, ends)
    made = GeneratedCurve(
        state.curves.key.data[curve], curve, "waterline", layout, (), tuple(marks)
    )
    places = generated_points(forms, [made], np.array([place_of(state, curve)]), ends[None])[0]
    specs = [
        PointSpec(curve, xyz, Sort.ADOPTED, int(each), way)
        for xyz, each, way in zip(places, kind, direction, strict=True)
    ]
    rows = edit.maker.points(specs)
    _make_room(edit, curve, places)
    for row in rows.tolist():
        thread(edit.maker, curve, row)
    edit.pending.curves.add(curve)
    edit.maker.generated([*state.generated, made.evolve(rows=tuple(rows.tolist()))])


def _make_room(edit: Transaction, curve: int, places: FloatArray) -> None:
    """Let no crossing define a waterline that lies nearly where a point of the flat does."""
    state = edit.state
    rows: IntArray = state.curves.rows.data[curve]
    step = state.rows.xyz.data[rows][:, None] - places[None]
    near = np.sqrt((step * step).sum(axis=2)).min(axis=1) < state.tolerances.adopted_spacing
    near[[0, -1]] = False
    crowded = rows[near]
    if not len(crowded):
        return
    edit.maker.define(curve, rows[~near])
    edit.maker.roles(crowded, np.full(len(crowded), int(Role.WATCHED)))
    edit.journal.put(state.rows.limit, crowded, 2.0 * state.tolerances.adoption)
