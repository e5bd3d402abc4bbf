"""One block: its points become a surface, which is cut at its borders and joined to its masters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.fit import Fit
from assoc_hull.geometry.fitting.folds import Elements, elements
from assoc_hull.geometry.fitting.foot_points import foot_points
from assoc_hull.geometry.fitting.held_controls import HeldControls
from assoc_hull.geometry.fitting.joints import joined, joint_at
from assoc_hull.geometry.fitting.refining import fit_refined
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.geometry.fitting.strips import Strip, strip_of
from assoc_hull.surface.blocks.block import Block, Stretch
from assoc_hull.surface.blocks.fit_options import FitOptions, angle_limit
from assoc_hull.surface.blocks.net_records import Border
from assoc_hull.surface.blocks.spans import Breaks, breaks_of

__all__ = ["Made", "folded_places", "made_without_folds"]

_PASSES = 4
_STEPS = 8
_STIFFER = (1.0, 3.0, 9.0, 27.0)
"""Penalties that are tried while a surface is folded, over the one asked for."""

_CORNER = 0.05
"""So far from a singular corner, as a part of the sides, is beside it."""

_ENOUGH, _TO_BE_JOINED = 0.95, 0.8
"""With 95 % of the residuals below this part of the limit a fit has knots enough: more of them
would follow the lines more closely, and what is between less. The latter for blocks that follow
others, which costs some of it."""

_Y = 1


@attrs.frozen(eq=False)
class Made:
    """A block and its surface.

    Attributes
    ----------
    block : Block
        What it was made from.
    fit : Fit
        Over all of its reach, before it was cut and joined.
    part : Fit
        As published: cut at its borders and joined to its masters; with the points of its own
        lines, and how far these lie from it.
    borders : tuple of Border
        Where it meets its masters.
    settled : bool
        Control points of `part` were left where an earlier surface had them.
    """

    block: Block
    fit: Fit
    part: Fit
    borders: tuple[Border, ...]
    settled: bool = False

    @property
    def breaks(self) -> Breaks:
        """Where spans of the published surface meet, ends included."""
        surface = self.part.surface
        return surface.knots_u[3:-3], surface.knots_v[3:-3]


def made_without_folds(
    block: Block,
    options: FitOptions,
    made: Mapping[str, Made],
    ends: tuple[FloatArray, FloatArray],
) -> Made:
    """Fit and join a block; one that is folded is made stiffer until it is not.

    Parameters
    ----------
    block : Block
        The block.
    options : FitOptions
        Penalty and tolerances.
    made : mapping of str to Made
        Its masters.
    ends : (n,), (n,), m
        Where borders of other blocks end on its sides, in u and in v.

    Returns
    -------
    Made
        The first that is not folded; as asked for, if all are.
    """
    known = {name: made[name].breaks for name in block.masters}
    first = None
    for stiffer in _STIFFER:
        fit = fitted(block, options, known, ends, stiffer)
        found = joined_to_masters(block, fit, made)
        if not len(folded_places(elements(found.part.surface))):
            return found
        first = first or found
    assert first is not None
    return first


def folded_places(shape: Elements) -> FloatArray:
    """Give the places at which a surface is folded, those beside singular corners left out.

    There the normal itself goes to nil, and its direction on a grid tells nothing.
    """
    found = shape.folded
    for corner in shape.singular:
        beside = [
            np.abs(found[:, axis] - corner[axis]) <= _CORNER * np.ptp(each)
            for axis, each in enumerate((shape.u, shape.v))
        ]
        found = found[~(beside[0] & beside[1])]
    return found


def fitted(
    block: Block,
    options: FitOptions,
    known: Mapping[str, Breaks],
    ends: tuple[FloatArray, FloatArray],
    stiffer: float = 1.0,
) -> Fit:
    """Fit a surface to the points of a block, with its overlap.

    Parameters
    ----------
    block : Block
        The block.
    options : FitOptions
        Penalty and tolerances.
    known : mapping of str to (breaks in u, breaks in v)
        Where spans of its masters meet.
    ends : (n,), (n,), m
        Where borders of other blocks end on its sides, in u and in v.
    stiffer : float
        How many times the penalty is that of the options.
    """
    breaks = breaks_of(block, options.girth_span, options.length, known, ends)
    limit = options.limit(block.kind)
    share = _TO_BE_JOINED if block.masters else _ENOUGH
    return fit_refined(
        block.name,
        block.samples,
        *breaks,
        stiffer * options.smoothing_of(block.kind, block.area),
        limit,
        held=lambda u, v: held_on_centre(block, u, v),
        passes=_PASSES,
        enough=lambda fit: bool(np.percentile(fit.residual, 95.0) <= share * limit),
    )


def held_on_centre(block: Block, breaks_u: FloatArray, breaks_v: FloatArray) -> HeldControls:
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
    inside = (knots[4:] > low + 1e-9) & (knots[:-4] < high - 1e-9)
    mask = held.mask.copy()
    rows = np.flatnonzero(inside)
    if side[0] == "u":
        mask[0 if side == "u0" else -1, rows, _Y] = True
    else:
        mask[rows, 0 if side == "v0" else -1, _Y] = True
    return HeldControls(mask, held.value)


def joined_to_masters(block: Block, fit: Fit, made: Mapping[str, Made]) -> Made:
    """Cut a fit at its borders, and let it follow its masters there.

    Parameters
    ----------
    block : Block
        The block.
    fit : Fit
        Its fit, with its overlap.
    made : mapping of str to Made
        Its masters.
    """
    strips = dict(_strips(block, made))
    (u0, u1), (v0, v1) = block.extent.tolist()
    part = joined(fit, ((u0, u1), (v0, v1)), strips, lambda u, v: held_on_centre(block, u, v))
    part = _measured(block, fit, part)
    borders = []
    for stretch, side in _with_masters(block):
        master = made[stretch.master].block
        joint = joint_at(side, strips[side], fit.surface, part.surface)
        names, kinds = (master.name, block.name), (master.kind, block.kind)
        borders.append(
            Border(names, joint.gap, joint.joined_gap, joint.angle, joint.place, angle_limit(kinds))
        )
    return Made(block, fit, part, tuple(borders))


def _measured(block: Block, fit: Fit, part: Fit) -> Fit:
    """Give the published surface with the points of the block itself, and their distances from it.

    Parameters that the fit has held are free here: a distance is that to the nearest place.
    """
    own = Samples(*(each[block.inside] for each in attrs.astuple(fit.samples, recurse=False)))
    uv, away = foot_points(part.surface, own.point, own.uv, steps=_STEPS)
    return Fit(part.surface, attrs.evolve(own, uv=uv), away, part.smoothing)


def _with_masters(block: Block) -> Iterator[tuple[Stretch, str]]:
    """Give the parts of the border that follow another block, and their sides."""
    for side, stretches in block.sides.items():
        yield from ((stretch, side) for stretch in stretches if stretch.master)


def _strips(block: Block, made: Mapping[str, Made]) -> Iterator[tuple[str, Strip]]:
    """Give what the masters of a block hand over to it, side by side."""
    for stretch, side in _with_masters(block):
        surface = made[stretch.master].part.surface
        whole = surface.domain[stretch.master_side[0] == "u"]
        part = stretch.master_low, stretch.master_high
        strip = strip_of(surface, stretch.master_side, None if part == whole else part)
        yield side, strip.over(stretch.low, stretch.high)
