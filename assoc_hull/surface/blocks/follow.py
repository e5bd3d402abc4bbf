"""Blocks made anew only where lines have moved: the others are taken from an earlier surface."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.folds import elements
from assoc_hull.geometry.fitting.samples import Samples
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.surface.blocks.block import Block
from assoc_hull.surface.blocks.fit_block import (
    Made,
    folded_places,
    joined_to_masters,
    made_without_folds,
)
from assoc_hull.surface.blocks.fit_options import FitOptions
from assoc_hull.surface.blocks.previous import near, settled, unmoved
from assoc_hull.surface.blocks.spans import ends_on

__all__ = ["Earlier", "Followed", "made_of"]


@attrs.frozen(eq=False)
class Earlier:
    """What is taken from an earlier surface.

    Attributes
    ----------
    made : mapping of str to Made
        Its blocks by name.
    names : tuple of str
        The lines that their points count by.
    """

    made: Mapping[str, Made]
    names: tuple[str, ...]


@attrs.frozen(eq=False)
class Followed:
    """The blocks of a surface, and which of them are new.

    Attributes
    ----------
    made : mapping of str to Made
        Blocks by name, masters first.
    refitted : tuple of str
        Those that were fitted.
    """

    made: Mapping[str, Made]
    refitted: tuple[str, ...]


def made_of(
    blocks: Sequence[Block],
    options: FitOptions,
    names: tuple[str, ...],
    earlier: Earlier | None = None,
) -> Followed:
    """Make all blocks, or take them from an earlier surface.

    Parameters
    ----------
    blocks : sequence of Block
        The blocks of a hull, masters first.
    options : FitOptions
        Penalty, tolerances, and the cut-off below which points count as unmoved.
    names : tuple of str
        The lines that points count by.
    earlier : Earlier, optional
        An earlier surface of the same options.

    Returns
    -------
    Followed
        A block of which no point has moved by more than the cut-off since its fit was made keeps
        its fit; and all of it, if its masters are what they were. Where these have changed it is
        joined to them again.
    """
    made: dict[str, Made] = {}
    refitted = []
    before: Mapping[str, Made] = {} if earlier is None else earlier.made
    old_blocks = [each.block for each in before.values()]
    for block in blocks:
        ends = ends_on(block, blocks)
        old = before.get(block.name)
        found = None
        if old is not None and earlier is not None:
            same = unmoved(block, names, old.block, earlier.names, options.cutoff)
            # A settled one is not, in every bit, the surface of its points.
            same = same and not (old.settled and options.cutoff == 0.0)
            same = same and _near(ends, ends_on(old.block, old_blocks), options.cutoff)
            if same and _same_breaks(block, made, before, options.cutoff):
                found = _taken(_renumbered(old, block), options, made, before)
        if found is None:
            found = made_without_folds(block, options, made, ends)
            refitted.append(block.name)
        if old is not None and found.part.surface is not old.part.surface:
            sides = [side for side, parts in block.sides.items() if any(p.master for p in parts)]
            part = settled(found.part, old.part.surface, options.cutoff, sides)
            if part is not found.part:
                found = attrs.evolve(found, part=part, settled=True)
        made[block.name] = found
    return Followed(made, tuple(refitted))


def _near(one: tuple[FloatArray, ...], other: tuple[FloatArray, ...], cutoff: float) -> bool:
    return all(near(a, b, cutoff) for a, b in zip(one, other, strict=True))


def _same_breaks(
    block: Block, made: Mapping[str, Made], before: Mapping[str, Made], cutoff: float
) -> bool:
    """Say whether masters have the knots that a fit was made for."""
    return all(
        name in before and _near(made[name].breaks, before[name].breaks, cutoff)
        for name in block.masters
    )


def _taken(
    old: Made, options: FitOptions, made: Mapping[str, Made], before: Mapping[str, Made]
) -> Made | None:
    """Give a block with the fit that it has; None if that is folded now, or was stiffer."""
    if all(_same(made[n].part.surface, before[n].part.surface) for n in old.block.masters):
        return old
    if old.fit.smoothing != options.smoothing_of(old.block.kind, old.block.area):
        return None
    found = joined_to_masters(old.block, old.fit, made)
    return None if len(folded_places(elements(found.part.surface))) else found


def _same(one: SplineSurface, other: SplineSurface) -> bool:
    """Say whether two surfaces are the same in every bit."""
    return one is other or all(
        near(a, b, 0.0)
        for a, b in (
            (one.net, other.net), (one.knots_u, other.knots_u), (one.knots_v, other.knots_v)
        )
    )  # fmt: skip


def _renumbered(old: Made, block: Block) -> Made:
    """Give an earlier block whose points count by the lines of now."""
    before, now = old.block.samples.line, block.samples.line
    if (before == now).all():
        return old
    number = np.zeros(int(before.max()) + 1, np.int64)
    number[before] = now

    def counted(samples: Samples) -> Samples:
        return attrs.evolve(samples, line=number[samples.line])

    fit, part = (attrs.evolve(each, samples=counted(each.samples)) for each in (old.fit, old.part))
    kept = attrs.evolve(old.block, samples=counted(old.block.samples))
    return attrs.evolve(old, block=kept, fit=fit, part=part)
