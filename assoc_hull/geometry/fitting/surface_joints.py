"""Surfaces joined to those beside them: one row shared, the next one in its tangent planes.

A master hands on its border row and the derivative across it, as a `Strip`.
`join_to_masters` lets a fit follow it; `measure_joint` says how far off and at what angle they are.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from typing import Self

import attrs
import numpy as np

from assoc_hull.arguments import choice
from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray, freeze
from assoc_hull.geometry.fitting.basis import DEGREE, basis_rows, clamped_knots
from assoc_hull.geometry.fitting.fit_input import SIDES, HeldControls, Samples, row_of
from assoc_hull.geometry.fitting.fit_surface import SurfaceFit, solve_once
from assoc_hull.geometry.fitting.foot_points import derivatives, foot_points
from assoc_hull.geometry.patches.knots import cut_spline, insert_knot
from assoc_hull.geometry.patches.spline_surface import SplineSurface

__all__ = [
    "Strip",
    "SurfaceJoint",
    "cut_out_part",
    "join_to_masters",
    "measure_joint",
    "strip_of",
]


_SAME = 1e-9
"""Knots nearer than this part of the border are the same."""


@attrs.frozen(eq=False)
class Strip:
    """A border curve of a bicubic surface and the derivative across it, on the same knots.

    Attributes
    ----------
    knots : (n + 4,), m
        Clamped knots along the border.
    row : (n, 3), m
        Control points of the border.
    across : (n, 3)
        Those of the derivative by the parameter across it.
    """

    knots: FloatArray
    row: FloatArray
    across: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.knots, self.row, self.across)

    @property
    def breaks(self) -> FloatArray:
        """Knots along the border, its ends once, (n - 2,), m."""
        return self.knots[DEGREE:-DEGREE]

    def over(self, low: float, high: float) -> Self:
        """Give the same curves with another parameter along them, an affine function of theirs."""
        old = self.breaks
        share = (self.knots - old[0]) / (old[-1] - old[0])
        knots = low + share * (high - low)
        # To the bit, whatever the rounding of the product.
        knots[-DEGREE - 1 :] = high
        return type(self)(knots, self.row, self.across)

    def on(self, breaks: FloatArray) -> Self:
        """Give the same curves on more breaks (b,), m, by knot insertion.

        Knots of the strip are among them; raises BadInputError where one is missing.
        """
        both, knots = np.concatenate([self.row, self.across], axis=1), self.knots
        room = _SAME * (breaks[-1] - breaks[0])
        near = breaks[np.abs(breaks[:, None] - knots[None, :]).argmin(axis=0)]
        if (np.abs(near - knots) > room).any():
            worst = int(np.abs(near - knots).argmax())
            raise BadInputError(
                f"the border has a knot at {knots[worst]:g} m and the surface beside it has none",
                "where two surfaces are joined", "give both the same knots along the border",
            )  # fmt: skip
        knots = near
        for t in breaks[1:-1]:
            # Those given twice are inserted twice.
            if np.count_nonzero(knots == t) < np.count_nonzero(breaks == t):
                both, knots = insert_knot(both, knots, DEGREE, float(t))
        return type(self)(knots, both[:, :3].copy(), both[:, 3:].copy())

    def at(self, t: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Give points of the border (k, 3), m, its tangents, and derivatives across it."""
        first, (value, slope) = basis_rows(self.knots, t, 1)
        number = first[:, None] + np.arange(DEGREE + 1)
        point = (value[..., None] * self.row[number]).sum(axis=1)
        tangent = (slope[..., None] * self.row[number]).sum(axis=1)
        return point, tangent, (value[..., None] * self.across[number]).sum(axis=1)


def strip_of(surface: SplineSurface, side: str, part: tuple[float, float] | None = None) -> Strip:
    """Give what a bicubic surface hands to a neighbour at one of its sides.

    Parameters
    ----------
    surface : SplineSurface
        A bicubic B-spline with clamped knots.
    side : {"u0", "u1", "v0", "v1"}
        The side.
    part : (float, float), m, optional
        The part of the side, in parameters along it; the whole side without it. A part is cut out
        by knot insertion: its curves are those of the surface.

    Examples
    --------
    >>> import numpy as np
    >>> from assoc_hull.geometry.fitting.surface_joints import strip_of
    >>> from assoc_hull.geometry.patches.spline_surface import SplineSurface
    >>> net = np.zeros((4, 4, 3))
    >>> net[..., 0], net[..., 1] = np.mgrid[0:4, 0:4]
    >>> knots = [0, 0, 0, 0, 3, 3, 3, 3]
    >>> strip = strip_of(SplineSurface("plane", (3, 3), knots, knots, net), "v0", (1.0, 2.0))
    >>> strip.breaks.tolist(), strip.row[:, 0].round(9).tolist()
    ([1.0, 2.0], [1.0, 1.333333333, 1.666666667, 2.0])
    """
    choice(side, "side", SIDES, surface.where)
    across, along = (
        (surface.knots_u, surface.knots_v) if side[0] == "u" else (surface.knots_v, surface.knots_u)
    )
    row, behind = (surface.net[row_of(side, depth)] for depth in (0, 1))
    if side[1] == "0":
        slope = DEGREE / (across[DEGREE + 1] - across[1]) * (behind - row)
    else:
        slope = DEGREE / (across[-2] - across[-2 - DEGREE]) * (row - behind)
    if part is None:
        return Strip(along.copy(), row.copy(), slope)
    both, knots = cut_spline(np.concatenate([row, slope], axis=1), along, DEGREE, *part)
    return Strip(knots, both[:, :3].copy(), both[:, 3:].copy())


# --------------------------------------------------------------------------------------
# At a border one surface is master. The other takes its row of control points on the same knots, so
# that there is no gap, and keeps its own derivative across the border, turned into the tangent
# planes of the master, so that normals agree. The rest is solved for once more, with the parameters
# of its own fit: a master that changes asks for no new fit of its neighbours.

_NEAR = 0.3
"""Own knots nearer to a knot of the master than this part of their spans give way to it."""

_PER_SPAN = 8
"""Places a span at which a border is measured."""

_PLANES = 1e4
"""How much more a tangent plane of the master counts than the direction in it."""

_NO_NORMAL = 0.02
"""Normals shorter than this part of their median have no direction to speak of: near a singular
corner, at which sides are tangent, a normal of no length turns any way."""

Extent = tuple[tuple[float, float], tuple[float, float]]


@attrs.frozen(eq=False)
class SurfaceJoint:
    """How two surfaces meet at a border.

    Attributes
    ----------
    gap : (3,), m
        Median, 95 % and largest distance of the master's border from the other surface as it
        was fitted.
    joined_gap : float, m
        The largest distance of the borders as they are joined.
    angle : (3,), degrees
        Median, 95 % and largest angle of the normals as they are joined, singular corners left out.
    place : (3,), m
        Where the largest angle is.
    """

    gap: FloatArray
    joined_gap: float
    angle: FloatArray
    place: FloatArray

    def __attrs_post_init__(self) -> None:
        freeze(self.gap, self.angle, self.place)


def cut_out_part(fit: SurfaceFit, extent: Extent) -> SurfaceFit:
    """Give the part ((u0, u1), (v0, v1)), m, of a fit: surface by knot insertion, and points."""
    if fit.surface.domain == extent:
        return fit
    inside = _inside(fit.samples, extent)
    surface = fit.surface.restricted(*extent)
    return SurfaceFit(surface, _chosen(fit.samples, inside), fit.residual[inside], fit.smoothing)


def _inside(samples: Samples, extent: Extent) -> np.typing.NDArray[np.bool_]:
    """Say which points lie in a part."""
    low, high = np.array(extent).T
    return np.asarray(((samples.uv >= low) & (samples.uv <= high)).all(axis=1))


def _chosen(samples: Samples, rows: np.typing.NDArray[np.bool_]) -> Samples:
    """Give some of the points."""
    return Samples(*(each[rows] for each in attrs.astuple(samples, recurse=False)))


def join_to_masters(
    fit: SurfaceFit,
    extent: Extent,
    strips: Mapping[str, Strip],
    held: Callable[[FloatArray, FloatArray], HeldControls] | None = None,
    creases: Collection[str] = (),
) -> SurfaceFit:
    """Cut a fit and join it to its masters.

    At a corner where two masters meet, both have one tangent plane if they are joined themselves;
    what the row of one gives there, the derivative across the other keeps.

    Parameters
    ----------
    fit : SurfaceFit
        The fit, with some overlap over its masters.
    extent : ((u0, u1), (v0, v1)), m
        The part of it that is kept.
    strips : mapping of sides to strips
        What masters hand over, each with the parameter along it that the fit has there.
    held : callable, optional
        What else is held, for breaks in u and in v.
    creases : collection of sides
        Where only the border is taken over: tangent planes there are the surface's own.

    Returns
    -------
    SurfaceFit
        The joined surface, with the points of that part.

    Raises
    ------
    BadInputError
        A strip that does not end where the part does.
    """
    name = fit.surface.name
    part = cut_out_part(fit, extent)
    if not strips:
        return part
    strips = {side: _ending(each, side, extent, name) for side, each in strips.items()}
    breaks = _breaks(part.surface, strips)
    on = {side: strips[side].on(breaks[side[0] == "u"]) for side in SIDES if side in strips}
    holds = HeldControls.none((len(breaks[0]) + 2, len(breaks[1]) + 2))
    for side, strip in on.items():
        holds = holds.on(side, strip.row)
    if held is not None:
        holds = holds.and_(held(*breaks))
    for side, strip in on.items():
        if side in creases:
            continue
        holds = _behind(holds, side, strip, part.surface, clamped_knots(breaks[side[0] == "v"]))
    return solve_once(name, part.samples, breaks, part.smoothing, holds)


def _ending(strip: Strip, side: str, extent: Extent, name: str) -> Strip:
    """Give a strip with the very ends of its side, or refuse one that ends elsewhere."""
    low, high = extent[side[0] == "u"]
    first, last = strip.breaks[[0, -1]]
    if max(abs(first - low), abs(last - high)) > _SAME * (high - low):
        raise BadInputError(
            f"the border {side} runs from {low:g} to {high:g} m, that of its master "
            f"from {first:g} to {last:g} m",
            f"in surface {name!r}", "give the master's border over the parameter of the other",
        )  # fmt: skip
    return strip.over(low, high)


def _breaks(surface: SplineSurface, strips: Mapping[str, Strip]) -> tuple[FloatArray, FloatArray]:
    """Give the breaks of a joined surface: those of strips along them, and its own."""
    own = [each[DEGREE:-DEGREE] for each in (surface.knots_u, surface.knots_v)]
    for axis, sides in enumerate((("v0", "v1"), ("u0", "u1"))):
        for side in sides:
            if side in strips:
                own[axis] = _united(own[axis], strips[side].breaks)
    return own[0], own[1]


def _united(own: FloatArray, given: FloatArray) -> FloatArray:
    """Give all breaks that are given, and own ones that are not near one of them."""
    span = np.minimum(np.diff(own, prepend=-np.inf), np.diff(own, append=np.inf))
    away = np.abs(own[:, None] - given[None, :]).min(axis=1)
    return np.sort(np.concatenate([given, own[away > _NEAR * span]]), kind="stable")


def _behind(
    holds: HeldControls, side: str, strip: Strip, surface: SplineSurface, knots: FloatArray
) -> HeldControls:
    """Hold the row behind a border: the surface's own, turned into the planes of the master.

    Sought is the spline D along the border that is nearest to the derivative which the surface
    has across it, and lies in the tangent planes of the master; coordinates of control points
    that are held already are met. Only planes are taken over: how fast and in what direction
    parameters run across the border is left to each surface, laid out on a rectangle of its own.
    """
    at = _places_along(strip)
    uv = _on_side(surface, side, at)
    _, tangent, slope = strip.at(at)
    own = derivatives(surface, uv)[1 if side[0] == "u" else 2]
    normal = np.cross(slope, tangent)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), np.finfo(float).tiny)[:, None]
    step = (knots[DEGREE + 1] if side[1] == "0" else knots[-DEGREE - 2]) - _end(knots, side)
    mask, value = (each[row_of(side, 1)] for each in (holds.mask, holds.value))
    given = (value - strip.row) * (DEGREE / step)
    across = _in_planes(strip, at, own, normal, np.where(mask, given, np.nan))
    return holds.on(side, strip.row + step / DEGREE * across, depth=1)


def _in_planes(
    strip: Strip, at: FloatArray, own: FloatArray, normal: FloatArray, given: FloatArray
) -> FloatArray:
    """Give control points (n, 3) of the spline nearest to vectors, normal to others; or given."""
    first, (value,) = basis_rows(strip.knots, at)
    basis = np.zeros((len(at), len(strip.row)))
    np.put_along_axis(basis, first[:, None] + np.arange(DEGREE + 1), value, axis=1)
    planes = _PLANES * (basis[:, :, None] * normal[:, None, :]).reshape(len(at), -1)
    rows = np.concatenate([np.kron(basis, np.eye(3)), planes])
    right = np.concatenate([own.ravel(), np.zeros(len(at))])
    known = np.isfinite(given.ravel())
    found = np.where(known, given.ravel(), 0.0)
    right = right - rows @ found
    found[~known] = np.linalg.lstsq(rows[:, ~known], right, rcond=None)[0]
    return found.reshape(-1, 3)


def _end(knots: FloatArray, side: str) -> float:
    """Give the parameter across a side at which it lies."""
    return float(knots[0] if side[1] == "0" else knots[-1])


def _places_along(strip: Strip) -> FloatArray:
    """Give places along a border, some to a span."""
    ends = np.unique(strip.breaks)
    share = np.arange(_PER_SPAN) / _PER_SPAN
    return np.append((ends[:-1, None] + share * np.diff(ends)[:, None]).ravel(), ends[-1])


def _on_side(surface: SplineSurface, side: str, at: FloatArray) -> FloatArray:
    """Give the parameters (k, 2) of places along a side."""
    across = np.full(len(at), surface.domain[side[0] == "v"][int(side[1])])
    return np.stack((across, at) if side[0] == "u" else (at, across), axis=1)


def measure_joint(
    side: str, strip: Strip, before: SplineSurface, after: SplineSurface
) -> SurfaceJoint:
    """Measure a border of two surfaces, on a side of the one that is joined.

    `strip` is what its master has handed over; `before` the surface as it was fitted, with its
    overlap, `after` as it is joined.
    """
    t = _places_along(strip)
    uv = _on_side(after, side, t)
    point, tangent, slope = strip.at(t)
    # In the sense of S_u x S_v, whichever parameter runs across the border.
    normal = np.cross(slope, tangent) if side[0] == "u" else np.cross(tangent, slope)
    place, along, down = derivatives(after, uv)
    gap = foot_points(before, point, uv)[1]
    angle = _angles(normal, np.cross(along, down))
    worst = point[int(np.nanargmax(angle))] if np.isfinite(angle).any() else np.full(3, np.nan)
    return SurfaceJoint(
        _three(gap), float(np.linalg.norm(place - point, axis=1).max()), _three(angle), worst
    )


def _angles(first: FloatArray, second: FloatArray) -> FloatArray:
    """Give angles of normals, degrees; nan where there is none to speak of."""
    sizes = [np.linalg.norm(each, axis=1) for each in (first, second)]
    fine = np.all([size > _NO_NORMAL * np.median(size) for size in sizes], axis=0)
    turn = np.linalg.norm(np.cross(first, second), axis=1)
    found = np.degrees(np.arctan2(turn, (first * second).sum(axis=1)))
    return np.where(fine, found, np.nan)


def _three(values: FloatArray) -> FloatArray:
    """Give the median, what 95 % stay below, and the largest; nan of none."""
    known = values[np.isfinite(values)]
    return np.percentile(known, [50.0, 95.0, 100.0]) if len(known) else np.full(3, np.nan)
