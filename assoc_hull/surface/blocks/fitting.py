"""From the lines of a hull to its surface: blocks are laid out, fitted, joined and measured."""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.analysis.net.gather import Net, gather
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.geometry.fitting.folds import elements
from assoc_hull.model.state import HullState
from assoc_hull.surface.blocks.doubts import (
    doubts_of_border,
    doubts_of_fit,
    doubts_of_half,
    doubts_of_penalty,
    doubts_of_shape,
)
from assoc_hull.surface.blocks.fit_block import Made, folded_places
from assoc_hull.surface.blocks.fit_options import FitOptions
from assoc_hull.surface.blocks.follow import Earlier, Followed, made_of
from assoc_hull.surface.blocks.layout import lay_out
from assoc_hull.surface.blocks.net_records import Residuals
from assoc_hull.surface.blocks.net_surface import FittedBlock, NetSurface
from assoc_hull.surface.blocks.residuals import Misses, misses_of, residuals_of

__all__ = ["earlier_of", "surface_of_net"]

_WHERE = "in surface"


def surface_of_net(
    state: HullState,
    options: FitOptions,
    leave_out: Sequence[str] = (),
    previous: NetSurface | None = None,
) -> NetSurface:
    """Fit a surface to the lines of a hull.

    Parameters
    ----------
    state : HullState
        The tables of the hull.
    options : FitOptions
        Penalty and tolerances.
    leave_out : sequence of str
        Names of lines that are not used at all, but measured.
    previous : NetSurface, optional
        An earlier surface; of use if it was made with the same options and lines left out.

    Raises
    ------
    BadInputError, UnknownNameError
        A curve of the hull has failed; no such line; lines that no blocks were found between.
    """
    if state.failed:
        raise BadInputError("a curve has failed", _WHERE, "mend it, or take back the edit")
    net = gather(state)
    omitted = _left_out(net, leave_out)
    blocks = lay_out(net, options.length, omitted)
    followed = made_of(blocks, options, net.name, earlier_of(previous, options, leave_out))
    made = _forward(followed)
    surfaces = [each.part.surface for each in made]
    misses = misses_of(surfaces, net, omitted, options.point_step)
    found = tuple(
        _published(each, net, options, misses, number) for number, each in enumerate(made)
    )
    borders = tuple(border for each in made for border in each.borders)
    told = (note for border in borders for note in doubts_of_border(border))
    notes = tuple(dict.fromkeys((*_of_length(state, options), *told)))
    refitted = tuple(block.name for block in found if block.name in followed.refitted)
    return NetSurface(
        state.particulars, options, net, found, borders, tuple(leave_out), refitted, notes,
        _of_all(made, misses, net),
    )  # fmt: skip


def _of_length(state: HullState, options: FitOptions) -> tuple[str, ...]:
    """Say that tolerances go by another length than that of the particulars."""
    stated = state.particulars.length
    if options.length == stated:
        return ()
    return (f"tolerances go by {options.length:.4g} m, the length of the lines: the particulars "
            f"have {stated:.4g} m",)  # fmt: skip


def earlier_of(
    previous: NetSurface | None, options: FitOptions, leave_out: Sequence[str]
) -> Earlier | None:
    """Give what may be taken from an earlier surface: nothing if other things were asked of it."""
    if previous is None or previous.left_out != tuple(leave_out):
        return None
    if attrs.evolve(previous.options, cutoff=options.cutoff) != options:
        return None
    return Earlier({block.name: block.made for block in previous.blocks}, previous.net.name)


def _left_out(net: Net, names: Sequence[str]) -> np.typing.NDArray[np.bool_]:
    """Say which curves are left out."""
    for name in names:
        if name not in net.name:
            raise UnknownNameError("line", name, tuple(dict.fromkeys(net.name)))
    found = np.isin(np.array(net.name), list(names))
    bad = found & net.end
    if bad.any():
        name = net.name[int(np.flatnonzero(bad)[0])]
        raise BadInputError(
            f"{name} is to be left out", _WHERE, "leave out lines that the hull does not end at"
        )
    return found


def _forward(followed: Followed) -> tuple[Made, ...]:
    """Give blocks from aft forward."""
    return tuple(
        sorted(
            followed.made.values(),
            key=lambda each: (float(each.block.corners[:, 0].mean()), each.block.name),
        )
    )


def _published(
    made: Made, net: Net, options: FitOptions, misses: Misses, number: int
) -> FittedBlock:
    """Give a block with what was measured of it."""
    block, part = made.block, made.part
    surface, samples = part.surface, part.samples
    shape = elements(surface)
    folded = folded_places(shape)
    on_lines = residuals_of("fitted", part.residual, samples.point, samples.line, net.name)
    others = _left_out_of(misses, number, net)
    notes = (
        *block.notes,
        *doubts_of_penalty(part.smoothing, options.smoothing_of(block.kind, block.area)),
        *doubts_of_fit(block.kind, on_lines, options),
        *doubts_of_shape(surface, shape, folded),
        *doubts_of_half(surface, shape, options),
    )
    limit = options.limit(block.kind)
    residuals = (on_lines, *others)
    return FittedBlock(made, residuals, shape.least, shape.singular, limit, notes)


def _of_all(made: Sequence[Made], misses: Misses, net: Net) -> tuple[Residuals, ...]:
    """Sum up all blocks together."""
    parts = [each.part for each in made]
    distance = np.concatenate([part.residual for part in parts])
    point = np.concatenate([part.samples.point for part in parts])
    line = np.concatenate([part.samples.line for part in parts])
    fitted = residuals_of("fitted", distance, point, line, net.name)
    if not len(misses.distance):
        return (fitted,)
    others = misses.distance, misses.point, misses.line
    return fitted, residuals_of("left out", *others, net.name)


def _left_out_of(misses: Misses, number: int, net: Net) -> tuple[Residuals, ...]:
    """Sum up the lines left out that lie on a block."""
    mine = misses.surface == number
    if not mine.any():
        return ()
    distance, point, line = misses.distance[mine], misses.point[mine], misses.line[mine]
    return (residuals_of("left out", distance, point, line, net.name),)
