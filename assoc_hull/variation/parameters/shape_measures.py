"""Measures of the shape between midship and ends: how high the area of frames lies.

Each function takes the drawn curves and gives a `MeasuredParameter`; its name is the name of the
parameter. Lengths in m, x from AP forward, z from the base line up.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from assoc_hull.variation.parameters.measurement import DrawnCurves, MeasuredParameter
from assoc_hull.variation.parameters.section_frames import frames_beside

__all__ = ["FRAMES", "aft_frame_height", "fore_frame_height"]

FRAMES: Mapping[str, float] = MappingProxyType(
    {"fore_frame_height": 0.925, "aft_frame_height": 0.1}
)
"""Where the character of frames is measured, in parts of Lpp."""


def fore_frame_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the centre of area up to the draught at .925 Lpp; `area`: of both sides."""
    return _frame_height(hull, "fore_frame_height")


def aft_frame_height(hull: DrawnCurves) -> MeasuredParameter:
    """Give the height of the centre of area up to the draught at .1 Lpp; `area`: of both sides."""
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
