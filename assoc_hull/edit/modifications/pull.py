"""The soft pull: one point is drawn along the hull's normal, its surroundings follow.

A driven crossing goes where its driver goes, and a driver is often made through no point near
by: the field then moved the neighbours of the crossing and hardly the crossing. So the driver is
given an adopted point at the place that is pulled, and what the point lacks after a sub-step is
made good by the next ones.
"""

from __future__ import annotations

import numpy as np

from assoc_hull.arguments import pair
from assoc_hull.edit.crossings.adopted_points import insert_defining_point
from assoc_hull.edit.displacement_field import (
    FieldContext,
    PullField,
    on_flat,
    on_profile,
    row_spacing,
    spacing_along,
)
from assoc_hull.edit.field_moves import FieldMoves
from assoc_hull.edit.published_program import known_numbers
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, PointRoleError
from assoc_hull.geometry.curves import FloatArray, IntArray
from assoc_hull.model.address import address
from assoc_hull.model.kinds import Role, Sort
from assoc_hull.model.make_objects import PointSpec
from assoc_hull.model.program.structure import Program, Values
from assoc_hull.model.tables import HullState

__all__ = ["curves_to_hold", "pull", "pull_field", "usual_radius"]

_NEAR = 0.15
"""Times `Tolerances.factor`: a curve with a point as near as this (m) is given no other to
be pulled at."""

_STATIONS = 2.0
"""Spacings along the length that a fair answer reaches at least."""

_PLAIN = ", without fair"


def pull(
    edit: Transaction,
    row: int,
    amount: float,
    radius: tuple[float, float] | None = None,
    *,
    across_flats: bool = False,
    fair: bool = False,
) -> None:
    """Ask for a soft pull.

    Parameters
    ----------
    edit : Transaction
        The edit.
    row : int
        The point; it may also be a driven or watched one.
    amount : float, m
        Along the outward normal.
    radius : (float, float) or None, m
        Along the length and the girth; three spacings of the points there if None.
    across_flats : bool
        Whether the field may move flats.
    fair : bool
        Whether the hull around answers fairly, in place of the bell; the radius is where the search
        for the answer begins.

    Raises
    ------
    BadInputError
        A radius that is not positive, an amount that is not finite; fair and across flats at once.
    PointRoleError
        The point lies on a flat, or on the profile.
    """
    if fair and across_flats:
        what = "a fair answer keeps flats as they are"
        raise BadInputError(what, "in pull", "leave fair or across_flats out")
    # What was written by now the published numbers do not know of.
    numbers = None if edit.journal.entries else known_numbers(edit.document)
    field = pull_field(
        edit.state, row, amount, radius, across_flats=across_flats, fair=fair, numbers=numbers
    )
    if fair and amount != 0.0:
        # What solves sparse systems is imported by whoever asks for it.
        from assoc_hull.edit.modifications.fair_answer import FairAnswer, PullAsked

        name = address(edit.state, row)
        stations = 0.0 if radius is not None else spacing_along(edit.state, field.place)
        asked = PullAsked(name, _points_held(edit, row), field, amount, _STATIONS * stations)
        FairAnswer.of(edit).asked.append(asked)
    elif amount != 0.0:
        edit.pending.ask(FieldMoves).fields.append(field)
        for curve, place in curves_to_hold(edit.state, row):
            _hold(edit, row, curve, place)


def pull_field(
    state: HullState,
    row: int,
    amount: float,
    radius: tuple[float, float] | None,
    *,
    across_flats: bool,
    fair: bool = False,
    numbers: tuple[Program, Values] | None = None,
) -> PullField:
    """Give the field of a pull; it raises as `pull`. `numbers` are as `FieldContext` takes them."""
    place = state.rows.xyz[row].copy()
    reach = usual_radius(state, row) if radius is None else pair(radius, "radius", positive=True)
    ground = FieldContext(state, across_flats, numbers)
    border = _border_distance(ground, row, reach[1])
    if border is None:
        remedy = "move the border curve, or pull a point beside it"
        if (on_flat(state) & ~on_profile(state))[row] and not across_flats:
            remedy = f"move the border curve, or pull with across_flats=True{_PLAIN * fair}"
        kind = "on a flat or on the profile, or its normal is not known"
        raise PointRoleError(address(state, row), kind, None, remedy)
    fade, normal = min(reach[1], border), ground.normals(np.array([row]))[0].copy()
    return PullField(row, place, amount, normal, reach, fade, across_flats)


def usual_radius(state: HullState, row: int) -> tuple[float, float]:
    """Give how far (m) a pull at a point reaches where nobody says it: three points each way."""
    reach = 3.0 * row_spacing(state, state.rows.xyz[row])
    return reach, reach


def curves_to_hold(state: HullState, row: int) -> list[tuple[int, FloatArray]]:
    """Give the curves that carry a driven or watched crossing and have no point of their own there.

    With each comes the place on it, (3,), m, where it needs one to be pulled at.
    """
    found: list[tuple[int, FloatArray]] = []
    if state.rows.sort[row] != Sort.CROSSING:
        return found
    for side, curve in enumerate(state.rows.curve[row].tolist()):
        if state.rows.role[row] != Role.WATCHED and state.rows.driver[row] != curve:
            continue
        place = state.rows.spot[row, side].copy()
        rows: IntArray = state.curves.rows[curve]
        step = state.rows.xyz[rows] - place
        near = float(np.sqrt((step * step).sum(axis=1)).min())
        if near >= state.tolerances.factor * _NEAR:
            found.append((curve, place))
    return found


def _points_held(edit: Transaction, row: int) -> IntArray:
    """Give the points that a fair pull takes hold of: those of the curves that carry a crossing."""
    state, table = edit.state, edit.state.rows
    watched = table.sort[row] == Sort.CROSSING and table.role[row] == Role.WATCHED
    driver = int(table.driver[row])
    if not watched and driver < 0:
        return np.array([row])
    carrying = table.curve[row].tolist() if watched else [driver]
    fresh = dict(curves_to_hold(state, row))
    made = {curve: _hold(edit, row, curve, place) for curve, place in fresh.items()}
    found = [
        made[curve] if curve in made else _nearest(state, curve, table.spot[row, side])
        for side, curve in enumerate(table.curve[row].tolist())
        if curve in carrying
    ]
    return np.array(sorted(set(found)), np.int64)


def _nearest(state: HullState, curve: int, place: FloatArray) -> int:
    """Give the point of a curve that lies nearest to a place."""
    rows: IntArray = state.curves.rows[curve]
    step = state.rows.xyz[rows] - place
    return int(rows[(step * step).sum(axis=1).argmin()])


def _hold(edit: Transaction, row: int, curve: int, place: FloatArray) -> int:
    """Give a curve that carries a crossing a point of its own there."""
    state = edit.state
    point = int(edit.maker.points([PointSpec(curve, place, Sort.ADOPTED)])[0])
    insert_defining_point(edit.maker, curve, point)
    edit.pending.structural = True
    edit.pending.curves.add(curve)
    edit.pending.notes.append(
        f"{address(state, row)}: {address(state, point)} was adopted, to be pulled there"
    )
    return point


def _border_distance(ground: FieldContext, row: int, within: float) -> float | None:
    """Give the distance of a point from the next flat; None if it cannot be pulled.

    One beyond `within`, m, counts as none.
    """
    if not (ground.normals(np.array([row])) != 0.0).any():
        return None
    state = ground.state
    computed = state.rows.driver[row] >= 0 or np.isfinite(state.rows.gap[row])
    if not computed and not ground.may_move(row):
        return None
    return ground.flat_distance(row, within)
