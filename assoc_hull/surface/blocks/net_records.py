"""What is measured of a surface: how far lines lie from it, and how its blocks meet."""

from __future__ import annotations

import attrs

from assoc_hull.geometry.curves import FloatArray, freeze

__all__ = ["Border", "Residuals"]


@attrs.frozen(eq=False)
class Residuals:
    """How far points of lines lie from the surface.

    Attributes
    ----------
    kind : str
        ``"fitted"``, or ``"left out"`` of the fit.
    count : int
        Points.
    median, p95, p99, largest : float, m
        Of the distances.
    place : (3,), m
        Where the largest is; nan without points.
    line : str
        The line it is on.
    """

    kind: str
    count: int
    median: float
    p95: float
    p99: float
    largest: float
    place: FloatArray
    line: str

    def __attrs_post_init__(self) -> None:
        freeze(self.place)


@attrs.frozen(eq=False)
class Border:
    """Where two blocks meet.

    Attributes
    ----------
    names : (str, str)
        The blocks.
    gap : (3,), m
        Median, 95 % and largest distance of the two surfaces, before they were joined.
    joined_gap : float, m
        The largest after it.
    angle : (3,), degrees
        Median, 95 % and largest angle between the normals as published.
    place : (3,), m
        Where the largest angle is.
    limit : float, degrees
        What the angle should keep.
    """

    names: tuple[str, str]
    gap: FloatArray
    joined_gap: float
    angle: FloatArray
    place: FloatArray
    limit: float

    def __attrs_post_init__(self) -> None:
        freeze(self.gap, self.angle, self.place)
