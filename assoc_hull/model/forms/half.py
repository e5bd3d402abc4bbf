"""One half of a curve of two: made, or refused with what can be had.

Examples
--------
>>> import math
>>> from assoc_hull.model.forms.half import Half, fault_of, vertices_of
>>> start = (-1.0, 0.0, math.radians(60.0), -2.0, 0.1525819451966713)
>>> finish = (-0.3, 1.0, 0.0, 0.0, 0.1525819451966713)
>>> run = Half("run", "in an example", start, finish, 0.55, -0.59)
>>> vertices_of(run)[3].round(9).tolist()
[-0.92217359, 0.787861836]
>>> fault_of(Half("run", "in an example", start, finish, 0.8, -0.59))
'asks for an area outside the box between the ends'
"""

from __future__ import annotations

import attrs
import numpy as np

from assoc_hull.errors import BadInputError, OutOfRangeError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.form_curves.curve import FormEnd, form_vertices
from assoc_hull.geometry.form_curves.extremes import least_coordinate, least_rate
from assoc_hull.model.forms.reachable import reachable

__all__ = ["Half", "fault_of", "vertices_of"]

_SLACK = 1e-12
"""Of the size of an interval: so far outside a value may lie."""


@attrs.frozen
class Half:
    """What a half is made of.

    Attributes
    ----------
    name, where : str
        ``"run"`` or ``"entrance"``; what errors say.
    start, finish : (5,)
        Point (x, y), angle (rad), curvature and tangent at its ends, in the frame of the ship.
    area, centroid : float or None
        None where they come out fairest.
    """

    name: str
    where: str
    start: tuple[float, ...]
    finish: tuple[float, ...]
    area: float | None
    centroid: float | None


def vertices_of(half: Half) -> FloatArray:
    """Give the vertices of a half, (7, 2).

    Raises
    ------
    OutOfRangeError
        A centroid or an area that the half cannot have, with those that it can have.
    BadInputError
        No centroid and no area would do.
    """
    why = fault_of(half)
    if not why:
        return _made(half)
    x0, x1 = half.start[0], half.finish[0]
    most = max(half.start[1], half.finish[1]) * (x1 - x0)
    for name, asked, low, high, unit in (
        ("centroid", half.centroid, x0, x1, "of half the length"),
        ("area", half.area, 0.0, most, ""),
    ):
        found = None if asked is None else _had(half, name, low, high, asked)
        if asked is not None and found is not None:
            whole = f"{half.name}_{name}"
            raise OutOfRangeError(whole, asked, half.where, why, *found, unit)
    what = f"the {half.name}" if half.area is None else f"{half.name}_area of {half.area:.8g}"
    raise BadInputError(
        f"{what} {why}", half.where,
        f"give other tangents than {half.start[4]:.6g} and {half.finish[4]:.6g} at its ends, or "
        "another area and centroid",
    )  # fmt: skip


def _had(
    half: Half, name: str, low: float, high: float, asked: float
) -> tuple[float, float] | None:
    """Give the areas, or the centroids, with which the half can be made and stays in its box."""

    def other(value: float) -> Half:
        if name == "area":
            return attrs.evolve(half, area=value)
        return attrs.evolve(half, centroid=value)

    def keeps(value: float) -> bool:
        return made(value) and not _over(other(value))

    def made(value: float) -> bool:
        return not fault_of(other(value))

    return reachable(keeps, low, high, asked) or reachable(made, low, high, asked)


def _over(half: Half) -> bool:
    """Tell whether a half rises above the higher of its ends: no section has that area."""
    mirrored = _made(half)[None] * np.array([1.0, -1.0])
    top = max(half.start[1], half.finish[1])
    return bool(-least_coordinate(mirrored, 1)[0] > top + 1e-6)


def _made(half: Half) -> FloatArray:
    """Give the vertices, whatever they are worth; nan where there are none."""
    area = None if half.area is None else np.array([half.area])
    centroid = None if half.centroid is None else np.array([half.centroid])
    return np.asarray(
        form_vertices(FormEnd.of(*half.start), FormEnd.of(*half.finish), area, centroid)[0]
    )


def fault_of(half: Half) -> str:
    """Tell why a half cannot be made, in words that follow a value; empty if it can."""
    length = half.finish[0] - half.start[0]
    low, high = sorted((half.start[1], half.finish[1]))
    if half.area is not None:
        if not (low * length - _SLACK <= half.area <= high * length + _SLACK and half.area > 0.0):
            return "asks for an area outside the box between the ends"
        if half.centroid is not None and not _in_box(half, low, high):
            return "asks for a moment outside the box between the ends"
    vertices = _made(half)
    if not np.isfinite(vertices).all():
        return "cannot be met: no curve has this area and centroid"
    if least_rate(vertices[None], 0)[0] < -_SLACK * length:
        return "makes the curve fold back, with two ordinates at one abscissa"
    return ""


def _in_box(half: Half, low: float, high: float) -> bool:
    """Tell whether the moment about the lower end lies between those of the lowest and highest."""
    assert half.area is not None
    assert half.centroid is not None
    falls = half.finish[1] < half.start[1]
    arm = half.finish[0] - half.centroid if falls else half.centroid - half.start[0]
    square = 0.5 * (half.finish[0] - half.start[0]) ** 2
    return low * square - _SLACK <= half.area * arm <= high * square + _SLACK
