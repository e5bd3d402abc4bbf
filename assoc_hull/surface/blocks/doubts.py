"""What is doubtful of a fitted block, each in a sentence, with its place and by how much."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.folds import Elements
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.blocks.fit_options import FitOptions
from assoc_hull.surface.blocks.net_records import Border, Residuals

__all__ = [
    "doubts_of_border", "doubts_of_fit", "doubts_of_half", "doubts_of_penalty",
    "doubts_of_shape", "shown_place",
]  # fmt: skip

_KNUCKLE = 5.0
"""So many times as large as p95 the p99 is where a bend was smoothed that is a knuckle."""

_LEAST = 0.02
_ROUNDING = 1e-10
"""Borders that agree to this, m, have control points that agree to the last bits."""

_STEM = 4.0
"""A largest residual over so many limits, beside the centre plane, tells of too sharp a stem."""

_BESIDE = 0.002
"""So near to the centre plane, as a part of the length, is beside it."""

_ACROSS = 0.0001
"""By so much, m on a hull of 300 m, a half may wave across the centre plane."""


def shown_place(place: FloatArray) -> str:
    """Write a place, m."""
    return "({:.2f}, {:.2f}, {:.2f})".format(*np.asarray(place).tolist())


def doubts_of_fit(kind: str, found: Residuals, options: FitOptions) -> Iterator[str]:
    """Say where a surface leaves its lines.

    Parameters
    ----------
    kind : {"body", "bow", "stern"}
        What block it is of.
    found : Residuals
        Of the lines that it was fitted to.
    options : FitOptions
        What they should keep.
    """
    limit, where = options.limit(kind), f"at {shown_place(found.place)} on {found.line}"
    largest = f"the largest is {1e3 * found.largest:.1f} mm {where}"
    if found.p95 > limit:
        yield (
            f"95 % of the residuals are up to {1e3 * found.p95:.1f} mm, over the limit of "
            f"{1e3 * limit:.1f} mm; {largest}"
        )
    if found.median > options.median_limit:
        yield (
            f"the median residual is {1e3 * found.median:.2f} mm, over the limit of "
            f"{1e3 * options.median_limit:.2f} mm"
        )
    if found.largest > _STEM * limit and _beside_centre(found, options) and kind != "body":
        yield f"stem not resolved: {largest}"
    elif found.p99 > max(_KNUCKLE * found.p95, limit):
        p99 = 1e3 * found.p99
        yield f"missing knuckle? 99 % of the residuals are up to {p99:.1f} mm; {largest}"


def _beside_centre(found: Residuals, options: FitOptions) -> bool:
    return bool(abs(found.place[1]) < _BESIDE * options.length)


def doubts_of_penalty(used: float, usual: float) -> Iterator[str]:
    """Say that a surface was made stiffer than asked for, as it was folded.

    Parameters
    ----------
    used, usual : float, m3
        The factors of the penalty.
    """
    if used > usual:
        yield f"stiffened: the penalty is {used / usual:g} times as large, as it was folded without"


def doubts_of_shape(surface: SplineSurface, shape: Elements, folded: FloatArray) -> Iterator[str]:
    """Say where a surface is folded, or almost has no normal.

    Parameters
    ----------
    surface : SplineSurface
        The surface.
    shape : Elements
        Its normals.
    folded : (f, 2), m
        Places of the grid at which it is folded.
    """
    if len(folded):
        where = shown_place(surface.at(*folded[0]))
        yield f"folded: the normal turns over at {len(folded)} place(s) of the grid, as at {where}"
    for corner in shape.singular:
        yield f"singular corner: the sides are tangent at {shown_place(surface.at(*corner))}"
    if shape.least < _LEAST and shape.place not in shape.singular:
        place = surface.at(*shape.place)
        yield f"the element of area is {shape.least:.3f} of the median at {shown_place(place)}"


def doubts_of_half(surface: SplineSurface, shape: Elements, options: FitOptions) -> Iterator[str]:
    """Say where the half y >= 0 waves across the centre plane, so that the two halves intersect.

    Parameters
    ----------
    surface : SplineSurface
        The surface.
    shape : Elements
        Its grid of places.
    options : FitOptions
        They tell the length of the ship.
    """
    least = -_ACROSS * options.scale
    if surface.net[..., 1].min() >= least:
        return
    place = surface.at(shape.u[:, None], shape.v[None, :]).reshape(-1, 3)
    worst = place[int(place[:, 1].argmin())]
    if worst[1] < least:
        yield (
            f"waves across the centre plane by {-1e3 * worst[1]:.2f} mm at {shown_place(worst)}: "
            "the two halves intersect there"
        )


def doubts_of_border(border: Border) -> Iterator[str]:
    """Say where two blocks meet at an angle, or do not meet.

    Parameters
    ----------
    border : Border
        Where they meet.
    """
    name = " | ".join(border.names)
    if border.joined_gap > _ROUNDING:
        yield f"{name}: a gap of {1e3 * border.joined_gap:.2g} mm is left"
    if border.angle[2] > border.limit:
        yield (
            f"{name}: the normals differ by up to {border.angle[2]:.2f} degrees, over the limit "
            f"of {border.limit:g}, at {shown_place(border.place)}"
        )
