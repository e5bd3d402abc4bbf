"""From the lines of a hull to its surface: blocks laid out, fitted or kept, joined, measured.

`surface_of_net` is what is called. Blocks whose lines have not moved are taken from an earlier
surface; within the cut-off single control points keep their place too, to the bit.
With a cut-off of 0 the result is that without an earlier surface, bit for bit.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import attrs
import numpy as np

from assoc_hull.analysis.net.curve_net import CurveNet, gather_net
from assoc_hull.errors import BadInputError, UnknownNameError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.geometry.fitting.fit_input import Samples, row_of
from assoc_hull.geometry.fitting.fit_surface import SurfaceFit
from assoc_hull.geometry.fitting.folds import surface_elements
from assoc_hull.geometry.patches.spline_surface import SplineSurface
from assoc_hull.model.tables import HullState
from assoc_hull.surface.blocks.block_layout import HullBlock, lay_out
from assoc_hull.surface.blocks.fit_block import (
    MadeBlock,
    border_ends,
    folded_places,
    join_block_to_masters,
    make_without_folds,
)
from assoc_hull.surface.blocks.fit_options import FitOptions
from assoc_hull.surface.blocks.fit_quality import (
    LEFT_OUT,
    LineDistances,
    Residuals,
    doubts_of_border,
    doubts_of_fit,
    doubts_of_half,
    doubts_of_penalty,
    doubts_of_shape,
    line_distances,
    sum_residuals,
)
from assoc_hull.surface.blocks.fitted_surface import FittedBlock, FittedSurface
from assoc_hull.surface.volume_check import displaced_of

__all__ = [
    "EarlierBlocks",
    "KeptBlocks",
    "arrays_near",
    "block_unmoved",
    "earlier_of",
    "make_blocks",
    "settle_controls",
    "share_kept",
    "surface_of_net",
]

# A block is fitted again when a point of its lines has moved by more than the cut-off from where it
# was when the published fit was made: so moves add up, and nothing drifts. Control points that come
# to lie within the cut-off of their published place keep it to the bit: so Bezier patches that only
# such points share keep their nets, and what was found for them; the surface stays as smooth.


def arrays_near(one: FloatArray, other: FloatArray, cutoff: float) -> bool:
    """Say whether two arrays are alike: within the cut-off, or in every bit if that is 0."""
    if one.shape != other.shape:
        return False
    if cutoff == 0.0:
        return one.tobytes() == other.tobytes()
    return bool((np.abs(one - other) <= cutoff).all())


def block_unmoved(
    block: HullBlock, names: Sequence[str], old: HullBlock, old_names: Sequence[str], cutoff: float
) -> bool:
    """Say whether the fit of an earlier block holds for a block.

    Not if points, sides or lines differ; `names`, `old_names` are the lines that points count by.
    Points may have moved by the cut-off, m; with 0 all that a fit depends on has to be the same in
    every bit.
    """
    mine, theirs = block.samples, old.samples
    same = (
        len(mine) == len(theirs)
        and [names[i] for i in mine.line] == [old_names[i] for i in theirs.line]
        and (mine.held == theirs.held).all()
        and (block.inside == old.inside).all()
        and _sides(block) == _sides(old)
    )
    if not same or not arrays_near(mine.point, theirs.point, cutoff):
        return False
    if cutoff > 0.0:
        return True
    return block.sides == old.sides and all(
        arrays_near(one, other, 0.0)
        for one, other in (
            (mine.uv, theirs.uv), (mine.weight, theirs.weight), (block.extent, old.extent),
            (block.reach, old.reach), (block.stations, old.stations), (block.levels, old.levels),
        )
    )  # fmt: skip


def _sides(block: HullBlock) -> list[tuple[object, ...]]:
    """Give what sides are made of, without numbers."""
    return [
        (side, stretch.centre, stretch.master, stretch.master_side, stretch.crease)
        for side, stretches in sorted(block.sides.items())
        for stretch in stretches
    ]


def settle_controls(
    fit: SurfaceFit, old: SplineSurface, cutoff: float, borders: Sequence[str] = ()
) -> SurfaceFit:
    """Let control points less than the cut-off, m, from their place in the published `old` keep it.

    So do knots. At `borders`, the sides at masters, the row there and the one behind it stay as
    they are: they have to fit what the masters hand over. Residuals stay as found, within the
    cut-off of what they are.
    """
    new = fit.surface
    alike = cutoff > 0.0 and all(
        arrays_near(one, other, cutoff)
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


# --------------------------------------------------------------------------------------
# Blocks made or kept.


@attrs.frozen(eq=False)
class EarlierBlocks:
    """What is taken from an earlier surface.

    Attributes
    ----------
    made : mapping of str to MadeBlock
        Its blocks by name.
    names : tuple of str
        The lines that their points count by.
    """

    made: Mapping[str, MadeBlock]
    names: tuple[str, ...]


@attrs.frozen(eq=False)
class KeptBlocks:
    """The blocks of a surface, and which of them are new.

    Attributes
    ----------
    made : mapping of str to MadeBlock
        Blocks by name, masters first.
    refitted : tuple of str
        Those that were fitted.
    """

    made: Mapping[str, MadeBlock]
    refitted: tuple[str, ...]


def make_blocks(
    blocks: Sequence[HullBlock],
    options: FitOptions,
    names: tuple[str, ...],
    earlier: EarlierBlocks | None = None,
) -> KeptBlocks:
    """Make all blocks, masters first, or take them from an earlier surface of the same options.

    A block of which no point has moved by more than the cut-off since its fit was made keeps its
    fit; and all of it, if its masters are what they were. Where these have changed it is joined to
    them again. `names` are the lines that points count by.
    """
    made: dict[str, MadeBlock] = {}
    refitted = []
    before: Mapping[str, MadeBlock] = {} if earlier is None else earlier.made
    old_blocks = [each.block for each in before.values()]
    for block in blocks:
        ends = border_ends(block, blocks)
        old = before.get(block.name)
        found = None
        if old is not None and earlier is not None:
            same = block_unmoved(block, names, old.block, earlier.names, options.cutoff)
            # A settled one is not, in every bit, the surface of its points.
            same = same and not (old.settled and options.cutoff == 0.0)
            # Spans end where borders of other blocks do: with other ends the fit is another.
            same = same and _near(ends, border_ends(old.block, old_blocks), options.cutoff)
            if same and _same_breaks(block, made, before, options.cutoff):
                found = _taken(_renumbered(old, block), options, made, before)
        if found is None:
            found = make_without_folds(block, options, made, ends)
            refitted.append(block.name)
        # After a new fit too: patches that only unmoved control points share keep their nets.
        if old is not None and found.part.surface is not old.part.surface:
            sides = [side for side, parts in block.sides.items() if any(p.master for p in parts)]
            part = settle_controls(found.part, old.part.surface, options.cutoff, sides)
            if part is not found.part:
                found = attrs.evolve(found, part=part, settled=True)
        made[block.name] = found
    return KeptBlocks(made, tuple(refitted))


def _near(one: tuple[FloatArray, ...], other: tuple[FloatArray, ...], cutoff: float) -> bool:
    return all(arrays_near(a, b, cutoff) for a, b in zip(one, other, strict=True))


def _same_breaks(
    block: HullBlock, made: Mapping[str, MadeBlock], before: Mapping[str, MadeBlock], cutoff: float
) -> bool:
    """Say whether masters have the knots that a fit was made for."""
    return all(
        name in before and _near(made[name].breaks, before[name].breaks, cutoff)
        for name in block.masters
    )


def _taken(
    old: MadeBlock,
    options: FitOptions,
    made: Mapping[str, MadeBlock],
    before: Mapping[str, MadeBlock],
) -> MadeBlock | None:
    """Give a block with the fit that it has; None if that is folded now, or was stiffer."""
    if all(_same(made[n].part.surface, before[n].part.surface) for n in old.block.masters):
        return old
    if old.fit.smoothing != options.smoothing_of(old.block.kind, old.block.area):
        return None
    found = join_block_to_masters(old.block, old.fit, made)
    return None if len(folded_places(surface_elements(found.part.surface))) else found


def _same(one: SplineSurface, other: SplineSurface) -> bool:
    """Say whether two surfaces are the same in every bit."""
    return one is other or all(
        arrays_near(a, b, 0.0)
        for a, b in (
            (one.net, other.net), (one.knots_u, other.knots_u), (one.knots_v, other.knots_v)
        )
    )  # fmt: skip


def _renumbered(old: MadeBlock, block: HullBlock) -> MadeBlock:
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


# --------------------------------------------------------------------------------------
# The surface of a net.

_WHERE = "in surface"


def surface_of_net(
    state: HullState,
    options: FitOptions,
    leave_out: Sequence[str] = (),
    previous: FittedSurface | None = None,
) -> FittedSurface:
    """Fit a surface to the lines of a hull.

    Parameters
    ----------
    state : HullState
        The tables of the hull.
    options : FitOptions
        Penalty and tolerances.
    leave_out : sequence of str
        Names of lines that are not used at all, but measured.
    previous : FittedSurface, optional
        An earlier surface; of use if it was made with the same options and lines left out.

    Raises
    ------
    BadInputError, UnknownNameError
        A curve of the hull has failed; no such line; lines that no blocks were found between.
    """
    if state.failed:
        raise BadInputError("a curve has failed", _WHERE, "mend it, or take back the edit")
    net = gather_net(state)
    omitted = _left_out(net, leave_out)
    blocks = lay_out(net, options.length, omitted)
    followed = make_blocks(blocks, options, net.name, earlier_of(previous, options, leave_out))
    made = _forward(followed)
    surfaces = [each.part.surface for each in made]
    misses = line_distances(surfaces, net, omitted, options.point_step)
    found = tuple(
        _published(each, net, options, misses, number) for number, each in enumerate(made)
    )
    borders = tuple(border for each in made for border in each.borders)
    told = (note for border in borders for note in doubts_of_border(border))
    notes = tuple(dict.fromkeys((*_of_length(state, options), *_beside(state), *told)))
    refitted = tuple(block.name for block in found if block.name in followed.refitted)
    return FittedSurface(
        state.particulars, options, net, found, borders, tuple(leave_out), refitted, notes,
        _of_all(made, misses, net), displaced_of(state, tunnels=False),
    )  # fmt: skip


def _beside(state: HullState) -> Iterator[str]:
    """Name what the hull has beside its lines: no surface is made of it."""
    bodies, tunnels = ([each.name for each in held] for held in (state.bodies, state.tunnels))
    for one, several, names in (("body", "bodies", bodies), ("tunnel", "tunnels", tunnels)):
        if names:
            yield f"{LEFT_OUT}{one if len(names) == 1 else several} {', '.join(names)}"


def _of_length(state: HullState, options: FitOptions) -> tuple[str, ...]:
    """Say that tolerances go by another length than that of the particulars."""
    stated = state.particulars.length
    if options.length == stated:
        return ()
    return (f"tolerances go by {options.length:.4g} m, the length of the lines: the particulars "
            f"have {stated:.4g} m",)  # fmt: skip


def earlier_of(
    previous: FittedSurface | None, options: FitOptions, leave_out: Sequence[str]
) -> EarlierBlocks | None:
    """Give what may be taken from an earlier surface: nothing if other things were asked of it."""
    if previous is None or previous.left_out != tuple(leave_out):
        return None
    if attrs.evolve(previous.options, cutoff=options.cutoff) != options:
        return None
    return EarlierBlocks({block.name: block.made for block in previous.blocks}, previous.net.name)


def _left_out(net: CurveNet, names: Sequence[str]) -> np.typing.NDArray[np.bool_]:
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


def _forward(followed: KeptBlocks) -> tuple[MadeBlock, ...]:
    """Give blocks from aft forward."""
    return tuple(
        sorted(
            followed.made.values(),
            key=lambda each: (float(each.block.corners[:, 0].mean()), each.block.name),
        )
    )


def _published(
    made: MadeBlock, net: CurveNet, options: FitOptions, misses: LineDistances, number: int
) -> FittedBlock:
    """Give a block with what was measured of it."""
    block, part = made.block, made.part
    surface, samples = part.surface, part.samples
    shape = surface_elements(surface)
    folded = folded_places(shape)
    on_lines = sum_residuals("fitted", part.residual, samples.point, samples.line, net.name)
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


def _of_all(
    made: Sequence[MadeBlock], misses: LineDistances, net: CurveNet
) -> tuple[Residuals, ...]:
    """Sum up all blocks together."""
    parts = [each.part for each in made]
    distance = np.concatenate([part.residual for part in parts])
    point = np.concatenate([part.samples.point for part in parts])
    line = np.concatenate([part.samples.line for part in parts])
    fitted = sum_residuals("fitted", distance, point, line, net.name)
    if not len(misses.distance):
        return (fitted,)
    others = misses.distance, misses.point, misses.line
    return fitted, sum_residuals("left out", *others, net.name)


def _left_out_of(misses: LineDistances, number: int, net: CurveNet) -> tuple[Residuals, ...]:
    """Sum up the lines left out that lie on a block."""
    mine = misses.surface == number
    if not mine.any():
        return ()
    distance, point, line = misses.distance[mine], misses.point[mine], misses.line[mine]
    return (sum_residuals("left out", distance, point, line, net.name),)
