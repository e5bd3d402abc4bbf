"""Measures of the shape between midship and ends: character of frames, design waterline.

Each function takes the drawn curves and gives a `MeasuredParameter`; its name is the name of the
parameter. Lengths in m, x from AP forward, z from the base line up.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import numpy as np

from assoc_hull.geometry.curves import CurveData, FloatArray, SplineBatch
from assoc_hull.geometry.splines.evaluation import derivative, evaluate
from assoc_hull.geometry.splines.loft import loft
from assoc_hull.geometry.splines.plane_intersections import points_at_coordinate
from assoc_hull.variation.parameters.hull_and_end_measures import breadth
from assoc_hull.variation.parameters.measurement import DrawnCurves, MeasuredParameter
from assoc_hull.variation.parameters.section_frames import GAUSS, frames_beside

__all__ = [
    "ENTRANCE",
    "FRAMES",
    "RUN",
    "aft_frame_height",
    "design_waterline",
    "entrance_deg",
    "fore_frame_height",
    "run_deg",
    "waterline_ends",
    "waterline_fullness",
]

FRAMES: Mapping[str, float] = MappingProxyType(
    {"fore_frame_height": 0.925, "aft_frame_height": 0.1}
)
"""Where the character of frames is measured, in parts of Lpp."""


def fore_frame_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the centre of area up to the draught at .925 Lpp; `area`: of it all."""
    return _frame_height(hull, "fore_frame_height")


def aft_frame_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the centre of area up to the draught at .1 Lpp; `area`: of it all."""
    return _frame_height(hull, "aft_frame_height")


def _frame_height(hull: DrawnCurves, name: str) -> MeasuredParameter:
    """Measure between the two sections beside the place, in proportion."""
    x = FRAMES[name] * hull.length
    frames = frames_beside(hull, x)
    if frames is None or len(frames.x) < 2:
        why = f"no sections with area below the draught on both sides of x={x:.6g}"
        return MeasuredParameter(name, "m", None, reason=why)
    weights = frames.beside(x)
    z = float((weights * frames.heights).sum())
    return MeasuredParameter(
        name, "m", z, f"centre of area up to T of the section at {FRAMES[name]:g} Lpp",
        [[x, 0.0, z]], numbers={"area": 2.0 * float((weights * frames.areas).sum())},
    )  # fmt: skip


# --------------------------------------------------------------------------------------
# The design waterline.

ENTRANCE, RUN = 0.05, 0.05
"""Over these parts of Lpp from its ends the chord of the design waterline is taken."""

_SAME = 1e-6
"""m: a waterline as near as this to the draught is the design waterline."""

_FEW = 4
"""Places through which a waterline is lofted, at least."""


def design_waterline(hull: DrawnCurves) -> SplineBatch | str:
    """Give the waterline at the draught, or say why there is none.

    Without one that is drawn there it is lofted through the outermost places of sections and the
    ends of the profile.
    """
    t = hull.ship.draught
    drawn = [i for i in hull.waterlines.tolist() if abs(hull.one(i).xyz[0, 2] - t) <= _SAME]
    if drawn:
        return hull.some(drawn)
    across = np.flatnonzero(np.isfinite(hull.net.x)).tolist()
    xyz = np.concatenate([hull.across(across, 2, t).xyz, hull.across(hull.profile, 2, t).xyz])
    order = np.lexsort((-xyz[:, 1], xyz[:, 0]))
    xyz = xyz[order]
    outer = np.append(True, np.diff(xyz[:, 0]) > _SAME) if len(xyz) else np.zeros(0, bool)
    if outer.sum() < _FEW:
        return f"fewer than {_FEW} sections pass the draught, z={t:.3f}"
    return loft(CurveData.single(xyz[outer]))


def waterline_ends(waterline: SplineBatch) -> tuple[FloatArray, FloatArray]:
    """Give the aftmost and the foremost place of a waterline, (3,), m."""
    xyz = waterline.xyz
    return xyz[int(xyz[:, 0].argmin())].copy(), xyz[int(xyz[:, 0].argmax())].copy()


def entrance_deg(hull: DrawnCurves) -> MeasuredParameter:
    """Give the half angle of entrance of the design waterline, by its chord at the fore end."""
    return _chord(hull, "entrance_deg", 1, ENTRANCE)


def run_deg(hull: DrawnCurves) -> MeasuredParameter:
    """Give the half angle of run of the design waterline, by its chord at the after end."""
    return _chord(hull, "run_deg", 0, RUN)


def _chord(hull: DrawnCurves, name: str, end: int, part: float) -> MeasuredParameter:
    """Measure the angle of the chord from an end (0 aft, 1 fore) over a part of Lpp."""
    waterline = hull.take(design_waterline)
    if isinstance(waterline, str):
        return MeasuredParameter(name, "deg", None, reason=waterline)
    tip, reach = waterline_ends(waterline)[end], part * hull.length
    there = points_at_coordinate(waterline, 0, float(tip[0]) + (reach if end == 0 else -reach)).xyz
    if not len(there):
        why = f"the design waterline is shorter than {reach:.4g} m"
        return MeasuredParameter(name, "deg", None, reason=why)
    inner = there[int(there[:, 1].argmax())]
    angle = float(np.degrees(np.arctan2(inner[1] - tip[1], reach)))
    return MeasuredParameter(
        name, "deg", angle, f"chord of the design waterline over {part:g} Lpp", [inner, tip],
    )  # fmt: skip


def waterline_fullness(hull: DrawnCurves) -> MeasuredParameter:
    """Give the coefficient of the design waterline: its area by Lpp and greatest breadth."""
    waterline = hull.take(design_waterline)
    if isinstance(waterline, str):
        return MeasuredParameter("waterline_fullness", "-", None, reason=waterline)
    ends = waterline_ends(waterline)
    broad = hull.take(breadth).value or hull.ship.breadth
    value = 2.0 * abs(_area_over_x(waterline)) / (hull.length * broad)
    return MeasuredParameter(
        "waterline_fullness", "-", value, "area of the design waterline by Lpp and breadth",
        np.array(ends),
    )  # fmt: skip


def _area_over_x(batch: SplineBatch) -> float:
    """Give the integral of y over x of curves, m2, exactly."""
    owner = np.repeat(np.arange(batch.count), np.diff(batch.start))
    inside = owner[1:] == owner[:-1]
    begin, end = batch.knot[:-1][inside], batch.knot[1:][inside]
    half, nodes = 0.5 * (end - begin), GAUSS[0]
    t = (0.5 * (begin + end))[:, None] + half[:, None] * nodes
    curve = np.repeat(owner[:-1][inside], len(nodes))
    y = evaluate(batch, curve, t.ravel())[:, 1]
    slope = derivative(batch, curve, t.ravel())[:, 0]
    return float((y * slope * (half[:, None] * GAUSS[1]).ravel()).sum())
