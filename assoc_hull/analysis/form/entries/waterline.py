"""Entries of the waterline: how it runs at the bow and in the run, and its second moments."""

from __future__ import annotations

import numpy as np

from assoc_hull.analysis.form.entries.particulars import of_waterplane
from assoc_hull.analysis.form.floating_shape import FloatingShape
from assoc_hull.analysis.form.longitudinal_parts import parallel_body, ship_slices
from assoc_hull.analysis.form.parameter import (
    ITTC,
    TABLE_3,
    TABLE_4,
    Absent,
    MeasuredValue,
    Warned,
    entries_in,
    parameter,
)
from assoc_hull.geometry.floating.immersion import FloatingPlanes
from assoc_hull.geometry.floating.waterlines import OuterLine, outer_line, waterline_arcs

__all__ = ["WATERLINE"]

_NOSE = 0.1
"""Of B: a stem is round if its radius is less, within so much of the centre plane."""

_STEP = 0.01
"""Of B: over so much of its length it is told how fast a waterline turns."""

_BESIDE, _MUCH = 0.02, 3.0
"""Of B: if there, beside the stem, the angle is another by more than so many degrees, it is no
property of the bow but of the place where it is read."""

_CENTRE = 1e-3
"""m: so near to the centre plane a waterline ends on it."""

_NONE = "no waterline"


@parameter(
    "b_st5", name="half breadth of the waterline at station 5", unit="m", table="measures",
    definition="outermost place of the waterline at 0.25 Lpp", source=TABLE_3,
)  # fmt: skip
def half_breadth_at_5(shape: FloatingShape) -> MeasuredValue:
    found = shape.take(ship_slices).half_breadth(shape.x_of(5.0), shape.planes)
    return Absent(f"{_NONE} at station 5") if found is None else found


@parameter(
    "Eangle", name="half angle of entrance", unit="deg", table="hydrostatic", ittc="i_E",
    definition="between centre plane and waterline at the stem; where the waterline is rounded "
    "there (within 0.1 B of the centre plane it turns by 0.1 rad or more over 0.01 B of its "
    "length), at the end of the first 0.01 B over which it turns by half of the most or less: "
    "the tangent where it leaves the radius",
    source=TABLE_3,
)  # fmt: skip
def angle_of_entrance(shape: FloatingShape) -> MeasuredValue:
    line = shape.take(_bow_line)
    if line is None:
        return Absent(_NONE)
    if line.end[1] > _CENTRE:
        return Absent("the waterline ends in a flat face")
    stem = float(np.degrees(line.entrance(_NOSE * shape.breadth, _STEP * shape.breadth)))
    beside = float(np.degrees(line.angle_beside(_BESIDE * shape.breadth)))
    if abs(stem - beside) > _MUCH:
        return Warned(
            stem,
            f"a blunt bow, where the angle hangs on the place: at {_BESIDE:g} B from the centre "
            f"plane it is {beside:.1f} deg",
        )
    return stem


@parameter(
    "Bluntness", name="bluntness of the bow", unit="-", table="hydrostatic",
    definition="2/B times the integral of sin^2(beta) dy along the waterline from its greatest "
    "breadth to the stem, beta from the centre plane: 1 for a flat face, 0 for a needle",
    source=f"{TABLE_3}; Fujii and Takahashi, added resistance in head seas",
)  # fmt: skip
def bluntness(shape: FloatingShape) -> MeasuredValue:
    line = shape.take(_bow_line)
    return Absent(_NONE) if line is None else 2.0 / shape.breadth * line.bluntness()


@parameter(
    "Rangle", name="angle of run", unit="deg", table="hull form",
    definition="between centre plane and the chord of the waterline at half the draughts, from "
    "the aftmost place of its main piece to PMBs; without a parallel middle body, to the "
    "largest section",
    source=TABLE_4,
)  # fmt: skip
def angle_of_run(shape: FloatingShape) -> MeasuredValue:
    planes = shape.planes
    half = FloatingPlanes(0.5 * planes.height, 0.5 * planes.tan_trim, planes.tan_heel.copy())
    line = outer_line(waterline_arcs(shape.body.spans, half), forward=False)
    curve = shape.take(parallel_body)
    broad = shape.take(ship_slices).half_breadth(curve.run, half)
    if line is None or broad is None:
        return Absent(f"{_NONE} at half the draught")
    x, y = line.aftmost
    if curve.run <= x:
        return Absent("no run")
    angle = float(np.degrees(np.arctan2(broad - y, curve.run - x)))
    if curve.level is None:
        return Warned(angle, "no parallel middle body: to the largest section")
    return angle


@parameter(
    "I_T", name="transverse second moment of the waterplane", unit="m4", table="measures",
    ittc="I_T", definition="integral of y^2 dA in the floating plane, about its centroid",
    source=ITTC, digits=1,
)  # fmt: skip
def transverse_moment(shape: FloatingShape) -> MeasuredValue:
    return of_waterplane(shape.record.i_t)


@parameter(
    "I_L", name="longitudinal second moment of the waterplane", unit="m4", table="measures",
    ittc="I_L", definition="integral of x^2 dA in the floating plane, about its centroid",
    source=ITTC, digits=1,
)  # fmt: skip
def longitudinal_moment(shape: FloatingShape) -> MeasuredValue:
    return of_waterplane(shape.record.i_l)


def _bow_line(shape: FloatingShape) -> OuterLine | None:
    return outer_line(waterline_arcs(shape.body.spans, shape.planes), forward=True)


WATERLINE = entries_in(vars())
"""The entries of this module, in order."""
