"""Make the net of a ship from six numbers: what does not fit is mended in a stated order, and told.

CB and LCB never give way. Where a section has more area than its waterline can hold, the waterline
becomes fuller, in steps; where a line cannot be cut fairly, it is shifted, and at last left out.
"""

from __future__ import annotations

from collections.abc import Callable

import attrs
import numpy as np

from assoc_hull.creation.area_swing import half_sums
from assoc_hull.creation.design import Design
from assoc_hull.creation.design_net import build_net, straighten_on_flat
from assoc_hull.creation.fair_courses import fair_courses
from assoc_hull.creation.six_numbers import DesignNote, TypedDesign
from assoc_hull.edit.adoption.adopt_lines import AdoptionReport
from assoc_hull.edit.document import Document
from assoc_hull.edit.lines.add_line import add_line
from assoc_hull.edit.transaction import Transaction
from assoc_hull.errors import BadInputError, OutOfRangeError, RefusedEditError
from assoc_hull.geometry.splines.segments import sample
from assoc_hull.model.forms.form_values import Forms
from assoc_hull.model.forms.two_halves import half_fault, half_number
from assoc_hull.model.tables import HullState

__all__ = ["build_typed", "dips_below_base", "passes_side", "with_room"]

_FULLER = 0.015
"""Of the area of a half of the waterline: one step."""

_STEPS = 4

_LEVEL, _LOWEST, _PLACES = 1e-3, 5e-3, 32
"""m: what dips below the base line by less is told of by nobody; by more than this part of the
draught, it is refused. Places that are looked at between two points."""

_WIDEST = 1e-2
"""What goes farther beyond the side than this part of half the breadth is refused."""

_DIP = 8e-4
"""A buttock that dips by more (m) is shifted; closing CB and LCB moves it a little after that."""

_SHIFTS = (0.0, 0.03, -0.03, 0.06, -0.06)
"""Of the draught or of half the breadth: where else a line is tried."""


def build_typed(
    typed: TypedDesign, *, solve: bool = True
) -> tuple[HullState, AdoptionReport, TypedDesign]:
    """Make the net; also give the report of adoption, and the design with what was mended.

    `solve` says whether courses of sections are solved before, so that these are fair.

    Raises BadInputError or OutOfRangeError where a section cannot be made after all that.
    """
    design, notes, state, report = (_fair if solve and not typed.drawn else with_room)(typed)
    forms = Forms.of(design.definitions, design.particulars)
    document = Document(state)

    def waterlines(heights: tuple[float, ...]) -> None:
        with Transaction(document, "cut waterlines") as edit:
            for z in heights:
                straighten_on_flat(edit, forms, add_line(edit, "waterlines", z), "waterline")

    def buttocks(places: tuple[float, ...]) -> None:
        with Transaction(document, "cut buttocks") as edit:
            lines = [add_line(edit, "buttocks", y) for y in places]
            for line in lines:
                straighten_on_flat(edit, forms, line, "buttock")
        # Shortly outside the flat of bottom a buttock is nearly level.
        low = min(_lowest(state, curve) for line in lines for curve in state.lines.curves[line])
        if low < -_DIP:
            document.undo()
            raise BadInputError(f"it dips {-low:.2g} m below the base line", "", "shift it")

    ship = design.particulars
    heights = _cut(waterlines, design.waterlines, ship.draught, "waterline", notes)
    places = _cut(buttocks, design.buttocks, 0.5 * ship.breadth, "buttock", notes)
    design = attrs.evolve(design, waterlines=heights, buttocks=places)
    return state, report, attrs.evolve(typed, design=design, notes=(*typed.notes, *notes))


def dips_below_base(state: HullState) -> list[DesignNote]:
    """Tell how far a net goes below its base line.

    Raises BadInputError where it is no ship for that.
    """
    lowest, name = 0.0, ""
    for curve in state.live("curves").tolist():
        low = _lowest(state, curve)
        if low < lowest:
            lowest, name = low, str(state.lines.name[state.line_of(curve)])
    if lowest < -_LOWEST * state.particulars.draught:
        what = f"{name} would go {-lowest:.2g} m below the base line"
        raise BadInputError(what, "in a ship from six numbers", "ask for less hollow ends")
    if lowest > -_LEVEL:
        return []
    why = f"{name} dips below the base line: lead it or fair it there"
    return [DesignNote("lowest place of the net", lowest, "m", "measured", remark=why)]


def passes_side(state: HullState) -> list[DesignNote]:
    """Tell how far a net goes beyond half the breadth that was asked for.

    Raises BadInputError where it is another ship for that.
    """
    half, widest, name = 0.5 * state.particulars.breadth, 0.0, ""
    for curve in state.live("curves").tolist():
        spline = state.spline(curve)
        length, y = np.diff(spline.knot) / 3.0, spline.xyz[:, 1]
        corners = y[:-1] + length * spline.leave[:-1, 1], y[1:] - length * spline.arrive[1:, 1]
        if max(float(each.max()) for each in (*corners, y)) <= half + _LEVEL:
            continue
        beyond = float(sample(spline, _PLACES)[1][:, 1].max()) - half
        if beyond > widest:
            widest, name = beyond, str(state.lines.name[state.line_of(curve)])
    if widest > _WIDEST * half:
        what = f"{name} would go {widest:.2g} m beyond half the breadth"
        raise BadInputError(what, "in a ship from six numbers", "ask for fuller ends")
    if widest < _LEVEL:
        return []
    why = f"{name} passes the side: fair it there"
    return [DesignNote("beyond half the breadth", widest, "m", "measured", remark=why)]


def _lowest(state: HullState, curve: int) -> float:
    """Give the lowest height (m) of a curve if that is below the base line, else 0."""
    spline = state.spline(curve)
    # Between two points a curve stays within the corners of its Bezier polygon.
    length = np.diff(spline.knot) / 3.0
    z = spline.xyz[:, 2]
    corners = np.minimum(
        z[:-1] + length * spline.leave[:-1, 2], z[1:] - length * spline.arrive[1:, 2]
    )
    if corners.min() >= -_LEVEL:
        return 0.0
    return min(float(sample(spline, _PLACES)[1][:, 2].min()), 0.0)


def _fair(typed: TypedDesign) -> tuple[Design, list[DesignNote], HullState, AdoptionReport]:
    """Make boundary and sections, of courses that are solved for this ship."""
    for rounds in _ROUNDS:
        try:
            return with_room(typed, rounds)
        except (BadInputError, OutOfRangeError) as error:
            why = str(error)
    # Courses as they were carried are less fair, and may be what can be made.
    design, notes, state, report = with_room(typed)
    note = DesignNote("courses of sections", 0.0, "", "as carried, not solved", remark=why)
    return design, [*notes, note], state, report


_ROUNDS = (10, 25)
"""Of the solution of courses; more where sections cannot be made after the first."""


def with_room(
    typed: TypedDesign, rounds: int = 0
) -> tuple[Design, list[DesignNote], HullState, AdoptionReport]:
    """Make boundary and sections; the waterline is made fuller until they have room.

    Raises as `build_typed`. It takes a quarter of the time of that.
    """
    design = typed.design
    for step in range(_STEPS + 1):
        try:
            solved = fair_courses(design, rounds) if rounds else design
            state, report = build_net(attrs.evolve(solved, waterlines=(), buttocks=()))
        except OutOfRangeError as error:
            if step == _STEPS or typed.held or "sectional_area" not in error.name:
                raise
            design = _fuller(design, error)
            continue
        break
    notes = []
    if step:
        value = half_sums(design.definition("design_waterline"), "entrance")[0]
        notes.append(DesignNote(
            "area of the entrance of the waterline", value, "", "made fuller in steps",
            remark=f"{step} steps of {100 * _FULLER:g} %: sections had no room for their areas",
        ))  # fmt: skip
    return solved, notes, state, report


def _fuller(design: Design, error: OutOfRangeError) -> Design:
    """Make the half of the waterline fuller in which a section has too little room."""
    line = design.definition("design_waterline")
    # The error names the section by its place.
    where = error.where.rpartition("x = ")[2].partition(" m")[0]
    frame = 2.0 * float(where) / design.particulars.length - 1.0
    half = "run" if frame < half_number(line, "run_end") else "entrance"
    area = half_sums(line, half)[0] * (1.0 + _FULLER)
    fuller = line.having({f"{half}_area": area, f"{half}_centroid": None})
    if half_fault(fuller, half):
        raise error
    return design.having(fuller)


def _cut(
    cut: Callable[[tuple[float, ...]], None], places: tuple[float, ...], size: float, what: str,
    notes: list[DesignNote],
) -> tuple[float, ...]:  # fmt: skip
    """Cut lines of a family; one that cannot be cut is shifted, or left out."""
    try:
        # One edit for all takes a third of the time; who is at fault shows one by one.
        cut(places)
    except _UNFAIR:
        pass
    else:
        return places
    found: list[float] = []
    for place in places:
        for shift in _SHIFTS:
            at = round(place + shift * size, 3)
            # Below the base line, or beyond the centre plane, is no place for a line.
            if at <= 0.0:
                continue
            if any(abs(at - other) < 0.02 * size for other in (*found, *places) if other != place):
                continue
            try:
                cut((at if shift else place,))
            except _UNFAIR as error:
                why = str(error)
                continue
            found.append(at if shift else place)
            if shift:
                source = f"shifted from {place:g} m: it could not be cut there"
                notes.append(DesignNote(what, at, "m", source))
            break
        else:
            notes.append(DesignNote(what, place, "m", "left out", remark=why))
    return tuple(found)


_UNFAIR = (BadInputError, OutOfRangeError, RefusedEditError)
"""Why a line cannot be cut."""
