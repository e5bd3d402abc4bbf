"""One block fitted: spans of its knots, the surface through its points, its borders.

Along a border a block takes the breaks of its master, so both have the same border to the bit.
The surface is fitted with its overlap, cut at its borders and joined to its masters.
A surface that is folded is made stiffer until it is not, and the result says so.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.fit_input import HeldControls, Samples
from assoc_hull.geometry.fitting.fit_surface import SurfaceFit, fit_refined, subdivide_bays
from assoc_hull.geometry.fitting.folds import SurfaceElements, surface_elements
from assoc_hull.geometry.fitting.foot_points import foot_points
from assoc_hull.geometry.fitting.surface_joints import (
    Strip,
    join_to_masters,
    measure_joint,
    strip_of,
)
from assoc_hull.surface.blocks.block_layout import HullBlock, SideStretch
from assoc_hull.surface.blocks.fit_options import CREASE, FitOptions, angle_limit
from assoc_hull.surface.blocks.fit_quality import BlockBorder

__all__ = [
    "Breaks",
    "MadeBlock",
    "block_breaks",
    "border_ends",
    "folded_places",
    "make_without_folds",
    "master_part",
]


Breaks = tuple[FloatArray, FloatArray]

_EACH_BAY = 2
"""Spans between two stations, or other places worth a knot, along the ship."""

_LONGEST = 0.05
"""The longest span along the ship, as a part of its length."""

_NEAR = 0.2
"""Places so near to a neighbour, as a part of the spans that are wanted, are not worth a knot."""

_FEWEST = 20
"""Spans along a side that has no stations, at least."""

_END_SPAN = 0.6
"""How much shorter spans of bow and stern are."""

_CLEAR = 0.4
"""Breaks nearer than this part of a span give way."""

_FINER = np.array([0.25, 0.5])
"""Breaks beside the place where a side leaves the centre plane, as parts of the span there.
Shorter ones hold no points of their own: beside a singular corner of the DTC they folded."""

_GRID = 2.0**-15
"""Breaks are rounded to about this part of the length of the ship."""

_SAME = 1e-9
_ALONG = {"u0": 1, "u1": 1, "v0": 0, "v1": 0}
"""The parameter that runs along each side: 0 for u, 1 for v."""


def block_breaks(
    block: HullBlock,
    girth_span: float,
    length: float,
    known: Mapping[str, Breaks],
    ends: tuple[FloatArray, FloatArray],
) -> Breaks:
    """Give where spans of a block meet, over all of its reach, in u and in v, m.

    Spans along the girth are `girth_span` long, m; `known` are the breaks of its masters, by name,
    `ends` the places on its sides, in u and in v, m, where borders of other blocks end.
    """
    (u0, u1), (v0, v1) = block.reach.tolist()
    if block.kind == "body":
        inner = block.stations[(block.stations > u0) & (block.stations < u1)]
        places = np.unique(np.concatenate([[u0], inner, block.extent[0], [u1]]))
        along = _along_ship(places, length, girth_span)
    else:
        along = _evenly(u0, u1, _END_SPAN * girth_span)
        girth_span *= _END_SPAN
    own = along, _evenly(v0, v1, girth_span)
    grid = 2.0 ** round(math.log2(_GRID * length))
    first, second = (
        _leaving_centre(block, axis, _with_places(_on_grid(own[axis], grid), ends[axis]))
        for axis in (0, 1)
    )
    return _with_masters(block, 0, first, known), _with_masters(block, 1, second, known)


def border_ends(block: HullBlock, others: Iterable[HullBlock]) -> tuple[FloatArray, FloatArray]:
    """Give where borders of other blocks end within the sides of a block, in u and in v, m."""
    found: tuple[set[float], set[float]] = set(), set()
    for other in others:
        for stretches in other.sides.values():
            for each in stretches:
                if each.master == block.name:
                    found[_ALONG[each.master_side]].update((each.master_low, each.master_high))
    inner = [
        sorted(at for at in places if low + _SAME < at < high - _SAME)
        for places, (low, high) in zip(found, block.extent.tolist(), strict=True)
    ]
    return np.array(inner[0]), np.array(inner[1])


def _on_grid(places: FloatArray, grid: float) -> FloatArray:
    """Round places within to a grid: small changes of lengths shall not move all knots."""
    found = np.round(places[1:-1] / grid) * grid
    return np.concatenate([places[:1], found, places[-1:]])


def _with_places(places: FloatArray, wanted: FloatArray) -> FloatArray:
    """Put breaks in at wanted places; others near there give way."""
    for place in wanted.tolist():
        span = float(np.diff(places)[np.clip(np.searchsorted(places, place) - 1, 0, None)])
        kept = places[1:-1][np.abs(places[1:-1] - place) > _CLEAR * span]
        places = np.unique(np.concatenate([places[:1], kept, [place], places[-1:]]))
    return places


def _leaving_centre(block: HullBlock, axis: int, places: FloatArray) -> FloatArray:
    """Put finer spans where a side leaves the centre plane: it stays in it smoothly, and turns."""
    for side, stretches in block.sides.items():
        if _ALONG[side] != axis:
            continue
        low, high = block.extent[axis].tolist()
        for each in stretches:
            if not each.centre:
                continue
            for end, way in ((each.low, -1.0), (each.high, 1.0)):
                if low + _SAME < end < high - _SAME:
                    near = int(np.searchsorted(places, end - _SAME))
                    span = float(np.diff(places)[near if way > 0.0 else near - 1])
                    places = _merged(np.concatenate([places, end + way * span * _FINER]))
    return places


def _along_ship(places: FloatArray, length: float, least: float) -> FloatArray:
    """Part the bays between stations."""
    kept = _thinned(places, _NEAR * least)
    parts = np.maximum(np.ceil(np.diff(kept) / (_LONGEST * length)).astype(np.int64), _EACH_BAY)
    short = np.diff(kept) < least
    return subdivide_bays(kept, np.where(short, 1, parts))


def _evenly(low: float, high: float, span: float) -> FloatArray:
    """Part a side evenly."""
    return np.linspace(low, high, max(round((high - low) / span), _FEWEST) + 1)


def _thinned(places: FloatArray, least: float) -> FloatArray:
    """Leave out places within that are too near to the one before, or to the end."""
    kept = [float(places[0])]
    for place in places[1:-1].tolist():
        if place - kept[-1] > least and places[-1] - place > least:
            kept.append(place)
    return np.array([*kept, float(places[-1])])


def master_part(breaks: FloatArray, stretch: SideStretch) -> FloatArray:
    """Give the breaks (b,), m, of a master along a stretch, in parameters of its follower."""
    low, high = stretch.master_low, stretch.master_high
    inner = breaks[(breaks > low + _SAME) & (breaks < high - _SAME)]
    ratio = (stretch.high - stretch.low) / (high - low)
    moved = stretch.low + (inner - low) * ratio
    return np.concatenate([[stretch.low], moved, [stretch.high]])


def _with_masters(
    block: HullBlock, axis: int, own: FloatArray, known: Mapping[str, Breaks]
) -> FloatArray:
    """Let breaks of masters take the place of the block's own where the block meets these."""
    forced = []
    for side, stretches in block.sides.items():
        if _ALONG[side] != axis:
            continue
        for stretch in stretches:
            if stretch.master:
                breaks = known[stretch.master][_ALONG[stretch.master_side]]
                forced.append(master_part(breaks, stretch))
    for each in forced:
        inside = (own > each[0] - _SAME) & (own < each[-1] + _SAME)
        keep = own[~inside] if each is forced[0] else own
        own = _merged(np.concatenate([keep, each]))
    return own


def _merged(places: FloatArray) -> FloatArray:
    """Sort places, each once."""
    found = np.sort(places)
    return np.asarray(found[np.concatenate([[True], np.diff(found) > _SAME])])


# --------------------------------------------------------------------------------------
# The fit of a block: over its reach, then cut at its borders and joined to its masters.

_PASSES = 4
"""How often spans are halved at most."""

_STEPS = 8
"""Steps of the search for the foot of a point on the published surface."""

_STIFFER = (1.0, 1.5, 3.0, 9.0, 27.0)
"""Penalties that are tried while a surface is folded, over the one asked for. The first step is the
least: the stern boss of the DTC is folded no more at 1.5, and at 3 it is a third further off."""

_CORNER = 0.05
"""So far from a singular corner, as a part of the sides, is beside it."""

_ENOUGH, _TO_BE_JOINED = 0.95, 0.8
"""With 95 % of the residuals below this part of the limit a fit has knots enough: more of them
would follow the lines more closely, and what is between less. The latter for blocks that follow
others, which costs some of it."""

_Y = 1


@attrs.frozen(eq=False)
class MadeBlock:
    """A block and its surface.

    Attributes
    ----------
    block : HullBlock
        What it was made from.
    fit : SurfaceFit
        Over all of its reach, before it was cut and joined.
    part : SurfaceFit
        As published: cut at its borders and joined to its masters; with the points of its own
        lines, and how far these lie from it.
    borders : tuple of BlockBorder
        Where it meets its masters.
    settled : bool
        Control points of `part` were left where an earlier surface had them.
    """

    block: HullBlock
    fit: SurfaceFit
    part: SurfaceFit
    borders: tuple[BlockBorder, ...]
    settled: bool = False

    @property
    def breaks(self) -> Breaks:
        """Where spans of the published surface meet, ends included."""
        surface = self.part.surface
        return surface.knots_u[3:-3], surface.knots_v[3:-3]


def make_without_folds(
    block: HullBlock,
    options: FitOptions,
    made: Mapping[str, MadeBlock],
    ends: tuple[FloatArray, FloatArray],
) -> MadeBlock:
    """Fit and join a block; one that is folded is made stiffer until it is not.

    `made` are its masters by name, `ends` as of `block_breaks`. If all are folded, the one with the
    penalty asked for is given.
    """
    known = {name: made[name].breaks for name in block.masters}
    first = None
    for stiffer in _STIFFER:
        fit = fit_with_overlap(block, options, known, ends, stiffer)
        found = join_block_to_masters(block, fit, made)
        if not len(folded_places(surface_elements(found.part.surface))):
            return found
        first = first or found
    assert first is not None
    return first


def folded_places(shape: SurfaceElements) -> FloatArray:
    """Give the places at which a surface is folded, those beside singular corners left out.

    There the normal itself goes to zero, and its direction on a grid tells nothing.
    """
    found = shape.folded
    for corner in shape.singular:
        beside = [
            np.abs(found[:, axis] - corner[axis]) <= _CORNER * np.ptp(each)
            for axis, each in enumerate((shape.u, shape.v))
        ]
        found = found[~(beside[0] & beside[1])]
    return found


def fit_with_overlap(
    block: HullBlock,
    options: FitOptions,
    known: Mapping[str, Breaks],
    ends: tuple[FloatArray, FloatArray],
    stiffer: float = 1.0,
) -> SurfaceFit:
    """Fit a surface to the points of a block, with its overlap.

    `known` and `ends` as of `block_breaks`; the penalty is `stiffer` times that of the options.
    """
    breaks = block_breaks(block, options.girth_span, options.length, known, ends)
    limit = options.limit(block.kind)
    share = _TO_BE_JOINED if block.masters else _ENOUGH
    return fit_refined(
        block.name,
        block.samples,
        *breaks,
        stiffer * options.smoothing_of(block.kind, block.area),
        limit,
        held=lambda u, v: hold_centre_controls(block, u, v),
        passes=_PASSES,
        enough=lambda fit: bool(np.percentile(fit.residual, 95.0) <= share * limit),
    )


def hold_centre_controls(
    block: HullBlock, breaks_u: FloatArray, breaks_v: FloatArray
) -> HeldControls:
    """Hold control points of borders on the centre plane at y = 0.

    A border that is on the centre plane for a part only has all control points held that have a
    share in that part: then it lies there without error, also at its end, where both halves and a
    neighbour meet. Beside that, where a span ends too, it leaves the plane with the cube of the
    distance.
    """
    held = HeldControls.none((len(breaks_u) + 2, len(breaks_v) + 2))
    for side, stretches in block.sides.items():
        breaks = breaks_v if side[0] == "u" else breaks_u
        for stretch in stretches:
            if stretch.centre:
                held = _on_part(held, side, breaks, stretch.low, stretch.high)
    return held


def _on_part(
    held: HeldControls, side: str, breaks: FloatArray, low: float, high: float
) -> HeldControls:
    """Hold y of the control points of a side that matter between two places."""
    knots = np.concatenate([np.repeat(breaks[:1], 3), breaks, np.repeat(breaks[-1:], 3)])
    # Spline i has a share between the knots i and i + 4.
    inside = (knots[4:] > low + 1e-9) & (knots[:-4] < high - 1e-9)
    mask = held.mask.copy()
    rows = np.flatnonzero(inside)
    if side[0] == "u":
        mask[0 if side == "u0" else -1, rows, _Y] = True
    else:
        mask[rows, 0 if side == "v0" else -1, _Y] = True
    return HeldControls(mask, held.value)


def join_block_to_masters(
    block: HullBlock, fit: SurfaceFit, made: Mapping[str, MadeBlock]
) -> MadeBlock:
    """Cut a fit with its overlap at the borders of its block, and join it to its masters there."""
    strips = dict(_strips(block, made))
    (u0, u1), (v0, v1) = block.extent.tolist()
    creases = {side for stretch, side in _following_stretches(block) if stretch.crease}
    part = join_to_masters(
        fit, ((u0, u1), (v0, v1)), strips, lambda u, v: hold_centre_controls(block, u, v), creases
    )
    part = _measured(block, fit, part)
    borders = []
    for stretch, side in _following_stretches(block):
        master = made[stretch.master].block
        joint = measure_joint(side, strips[side], fit.surface, part.surface)
        names, kinds = (master.name, block.name), (master.kind, block.kind)
        limit = CREASE if stretch.crease else angle_limit(kinds)
        borders.append(
            BlockBorder(names, joint.gap, joint.joined_gap, joint.angle, joint.place, limit)
        )
    return MadeBlock(block, fit, part, tuple(borders))


def _measured(block: HullBlock, fit: SurfaceFit, part: SurfaceFit) -> SurfaceFit:
    """Give the published surface with the points of the block itself, and their distances from it.

    Parameters that the fit has held are free here: a distance is that to the nearest place.
    """
    own = Samples(*(each[block.inside] for each in attrs.astuple(fit.samples, recurse=False)))
    uv, away = foot_points(part.surface, own.point, own.uv, steps=_STEPS)
    return SurfaceFit(part.surface, attrs.evolve(own, uv=uv), away, part.smoothing)


def _following_stretches(block: HullBlock) -> Iterator[tuple[SideStretch, str]]:
    """Give the parts of the border that follow another block, and their sides."""
    for side, stretches in block.sides.items():
        yield from ((stretch, side) for stretch in stretches if stretch.master)


def _strips(block: HullBlock, made: Mapping[str, MadeBlock]) -> Iterator[tuple[str, Strip]]:
    """Give what the masters of a block hand over to it, side by side."""
    for stretch, side in _following_stretches(block):
        surface = made[stretch.master].part.surface
        whole = surface.domain[stretch.master_side[0] == "u"]
        part = stretch.master_low, stretch.master_high
        strip = strip_of(surface, stretch.master_side, None if part == whole else part)
        yield side, strip.over(stretch.low, stretch.high)
