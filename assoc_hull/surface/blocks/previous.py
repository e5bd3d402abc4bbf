"""What of an earlier surface still holds: blocks whose points stayed, control points that did.

A block is fitted again when a point of its lines has moved by more than the cut-off from where it
was *when the published fit was made*: so moves add up, and nothing drifts. Of a block that is
fitted again, control points that come to lie within the cut-off of their published place keep it,
to the last bit: so Bezier patches that only such points share keep their nets, and what was found
for them, and the surface is a spline of the same smoothness still. With a cut-off of 0 nothing is
kept that is not the same in every bit; as a fit is a function of the points, the surface then is
that which comes without an earlier one.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.fit import Fit
from assoc_hull.geometry.fitting.held_controls import row_of
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.blocks.block import Block

__all__ = ["near", "settled", "share_kept", "unmoved"]


def near(one: FloatArray, other: FloatArray, cutoff: float) -> bool:
    """Say whether two arrays are alike: within the cut-off, or in every bit if that is 0."""
    if one.shape != other.shape:
        return False
    if cutoff == 0.0:
        return one.tobytes() == other.tobytes()
    return bool((np.abs(one - other) <= cutoff).all())


def unmoved(
    block: Block, names: Sequence[str], old: Block, old_names: Sequence[str], cutoff: float
) -> bool:
    """Say whether the fit of an earlier block holds for a block.

    Parameters
    ----------
    block, old : Block
        The block, and the one that the published fit was made from.
    names, old_names : sequences of str
        The lines that their points count by.
    cutoff : float, m
        What points may have moved by; with 0, all that a fit depends on has to be the same.

    Returns
    -------
    bool
        False too where there are other points, sides, or lines.
    """
    mine, theirs = block.samples, old.samples
    same = (
        len(mine) == len(theirs)
        and [names[i] for i in mine.line] == [old_names[i] for i in theirs.line]
        and (mine.held == theirs.held).all()
        and (block.inside == old.inside).all()
        and _sides(block) == _sides(old)
    )
    if not same or not near(mine.point, theirs.point, cutoff):
        return False
    if cutoff > 0.0:
        return True
    return block.sides == old.sides and all(
        near(one, other, 0.0)
        for one, other in (
            (mine.uv, theirs.uv), (mine.weight, theirs.weight), (block.extent, old.extent),
            (block.reach, old.reach), (block.stations, old.stations), (block.levels, old.levels),
        )
    )  # fmt: skip


def _sides(block: Block) -> list[tuple[object, ...]]:
    """Give what sides are made of, without numbers."""
    return [
        (side, stretch.centre, stretch.master, stretch.master_side)
        for side, stretches in sorted(block.sides.items())
        for stretch in stretches
    ]


def settled(fit: Fit, old: SplineSurface, cutoff: float, borders: Sequence[str] = ()) -> Fit:
    """Let control points that hardly moved keep their place.

    Parameters
    ----------
    fit : Fit
        A surface as it was fitted, or joined, anew.
    old : SplineSurface
        As it is published.
    cutoff : float, m
        Control points less far from there, and knots, keep their values.
    borders : sequence of {"u0", "u1", "v0", "v1"}
        Sides at masters: the row there and the one behind it stay as they are, for they have to
        fit what the masters hand over.

    Returns
    -------
    Fit
        With residuals as they were found, which is within the cut-off of what they are.
    """
    new = fit.surface
    alike = cutoff > 0.0 and all(
        near(one, other, cutoff)
        for one, other in ((new.knots_u, old.knots_u), (new.knots_v, old.knots_v))
    )
    if not alike or new.net.shape != old.net.shape:
        return fit
    keep = np.linalg.norm(new.net - old.net, axis=-1) < cutoff
    for side in borders:
        for depth in (0, 1):
            keep[row_of(side, depth)] = False
    net = np.where(keep[..., None], old.net, new.net)
    return attrs.evolve(
        fit, surface=SplineSurface(new.name, new.degrees, old.knots_u, old.knots_v, net)
    )


def share_kept(new: Sequence[SplineSurface], old: Sequence[SplineSurface]) -> float:
    """Give the share of Bezier patches whose nets are those of earlier ones, to the last bit."""
    known = {net.tobytes() for surface in old for net in surface.patches().net}
    nets = [net.tobytes() for surface in new for net in surface.patches().net]
    return sum(net in known for net in nets) / max(len(nets), 1)
