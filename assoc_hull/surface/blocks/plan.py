"""Which blocks a half hull is parted into, and the bays in which their surfaces overlap.

The body is master of the ends; of an end that is parted along, what lies above is master of what
lies below. A master knows nothing of what follows it: so what changes in a bow changes nothing
abaft of it.
"""

from __future__ import annotations

from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.surface.blocks.bays import bays_of_parts, bays_of_whole
from assoc_hull.surface.blocks.bridges import bridged
from assoc_hull.surface.blocks.corners import four_corners
from assoc_hull.surface.blocks.cuts import LEAST, EndCut, end_cut, passes
from assoc_hull.surface.blocks.outline import Bend, bends_inward, course
from assoc_hull.surface.blocks.quad import Quad
from assoc_hull.surface.blocks.region import Chord, Region
from assoc_hull.surface.cells.faces import Cells

__all__ = ["BlockPlan", "Seam", "block_plans"]

_PASSES = 0.002
"""A border passes a place that it misses by less than this part of the ship's length."""


@attrs.frozen(eq=False)
class Seam:
    """A side of a block, or a part of one, that follows another block.

    Attributes
    ----------
    side : str
        The side of the block.
    master : str
        The name of the other block.
    half : tuple of int
        The half-edges along it.
    """

    side: str
    master: str
    half: tuple[int, ...]


@attrs.frozen(eq=False)
class BlockPlan:
    """One block: four corners, and bays beyond its sides.

    Attributes
    ----------
    name : str
        ``"body"``, ``"bow stem"`` ...
    kind : {"body", "bow", "stern"}
        Where it lies.
    core : Quad
        The block itself.
    bays : dict of str to Quad
        Beyond ``"u0"``, ``"u1"``, ``"v0"``; and beyond a corner, ``"u0 v0"`` or ``"u1 v0"``.
    seams : tuple of Seam
        Where it follows another block.
    rails : tuple of Chord
        Sections from deck to keel by which a body is laid out.
    turns : tuple of float, degrees
        By how much the border turns at the corners.
    notes : tuple of str
        What is to be known.
    """

    name: str
    kind: str
    core: Quad
    bays: dict[str, Quad]
    seams: tuple[Seam, ...]
    rails: tuple[Chord, ...]
    turns: tuple[float, ...]
    notes: tuple[str, ...]


def block_plans(cells: Cells, length: float) -> tuple[BlockPlan, ...]:
    """Part a half hull into blocks, masters first.

    Parameters
    ----------
    cells : Cells
        The cells of its net.
    length : float, m
        Of the ship.

    Raises
    ------
    BadInputError
        The half hull, or a part of it, is no disc with four corners.
    """
    whole = Region.whole(cells)
    _require_disc(whole, "the half hull")
    ends = tuple(end_cut(whole, length, kind) for kind in ("stern", "bow"))
    found = bridged(cells, ends, length)
    if found is not cells:
        whole = Region.whole(found)
        ends = tuple(end_cut(whole, length, kind) for kind in ("stern", "bow"))
    stern, bow = ends
    plans = [_body(whole, length, stern, bow)]
    for end in ends:
        if end is not None:
            plans += _end(whole, length, end)
    cut = [end.bend.place for end in ends if end is not None]
    bends = bends_inward(course(whole), length, LEAST)
    left = [bend for bend in bends if bend.place not in cut]
    return tuple(attrs.evolve(plan, notes=plan.notes + _hard(plan, left, length)) for plan in plans)


def _hard(plan: BlockPlan, bends: Sequence[Bend], length: float) -> tuple[str, ...]:
    """Name the bends of the profile that stay in the border of a block."""
    return tuple(
        f"the profile bends into the ship by {bend.turn:.0f} degrees "
        f"at ({bend.place[0]:.2f}, {bend.place[2]:.2f}), within a side"
        for bend in bends
        if passes(plan.core.region, bend, _PASSES * length)
    )


def _require_disc(region: Region, name: str) -> None:
    if not region.is_disc:
        raise BadInputError(
            f"{name} is no disc: its border has {len(region.loops)} loops",
            "in the blocks of a surface",
            "look for lines that end nowhere, or that lie on one another",
        )


def _body(whole: Region, length: float, stern: EndCut | None, bow: EndCut | None) -> BlockPlan:
    cuts = [each.section.half for each in (stern, bow) if each is not None]
    region = whole
    if stern is not None:
        region = _part(whole, cuts, int(stern.section.half[0]) ^ 1, "the body")
    elif bow is not None:
        region = _part(whole, cuts, int(bow.section.half[0]), "the body")
    first, never = list[int](), list[int]()
    for end in (stern, bow):
        if end is not None:
            first.append(end.section.first)
            (never if end.beside is None else first).append(end.section.last)
    quad, turn = _quad(region, length, first, (), "body", never=never)
    nodes = [set(quad.nodes(side).tolist()) for side in ("v0", "v1")]
    curves = np.unique(whole.graph.curve[region.edges])
    rails = [
        run
        for curve in curves.tolist()
        if whole.graph.net.family[curve] == "sections"
        for chord in region.chords(curve)
        for run in (chord, chord.reversed())
        if run.first in nodes[0] and run.last in nodes[1]
    ]
    x = whole.graph.net.x
    rails.sort(key=lambda run: float(x[run.curve]))
    return BlockPlan("body", "body", quad, {}, (), tuple(rails), turn, ())


def _end(whole: Region, length: float, end: EndCut) -> list[BlockPlan]:
    """Plan the blocks of an end."""
    aft = end.kind == "stern"
    section = end.section
    region = _part(whole, [section.half], int(section.half[0]) ^ (not aft), end.kind)
    side = "u1" if aft else "u0"
    if not end.along:
        name = "stern counter" if aft and end.beside is None else end.kind
        quad, turn = _quad(region, length, [section.first, section.last], [], name, aft)
        bays = bays_of_whole(whole, end)
        seam = Seam(side, "body", tuple(quad.side(side).tolist()))
        return [BlockPlan(name, end.kind, quad, bays, (seam,), (), turn, end.notes)]
    return _parted_end(whole, length, end, region)


def _parted_end(whole: Region, length: float, end: EndCut, region: Region) -> list[BlockPlan]:
    """Plan the two blocks of an end that is cut along a waterline."""
    aft = end.kind == "stern"
    side = "u1" if aft else "u0"
    section, line = end.section, end.along[0]
    names = ("stern counter", "stern boss") if aft else ("bow stem", "bow bulb")
    high = int(line.half[0]) ^ (not aft)
    parts = [
        _part(region, [line.half], half, name)
        for half, name in zip((high, high ^ 1), names, strict=True)
    ]
    within = region.begin(line.half[1:]).tolist()
    upper, turn_upper = _quad(
        parts[0], length, [section.first, line.first], [line.last], names[0], aft, within
    )
    lower, turn_lower = _quad(
        parts[1], length, [line.first, section.last, line.last], (), names[1], aft, within
    )
    bays = bays_of_parts(whole, end, parts[0], high)
    seam = [Seam(side, "body", tuple(quad.side(side).tolist())) for quad in (upper, lower)]
    below = tuple(line.half.tolist())
    return [
        BlockPlan(names[0], end.kind, upper, bays[0], (seam[0],), (), turn_upper, end.notes),
        BlockPlan(
            names[1], end.kind, lower, bays[1], (seam[1], Seam("v0", names[0], below)), (),
            turn_lower, end.notes,
        ),
    ]  # fmt: skip


def _part(whole: Region, cuts: Sequence[np.ndarray], half: int, name: str) -> Region:
    found = whole.with_half(cuts, half)
    if found is None:
        raise BadInputError(
            f"{name} has no cells", "in the blocks of a surface", "look at the lines at the ends"
        )
    _require_disc(found, name)
    return found


def _quad(
    region: Region,
    length: float,
    first: Sequence[int],
    second: Sequence[int],
    name: str,
    aft: bool | None = None,
    never: Sequence[int] = (),
) -> tuple[Quad, tuple[float, ...]]:
    """Find the four corners of a region, beginning aft at the deck."""
    node, turn = four_corners(region, length, first, second, never)
    if len(node) < 4:
        raise BadInputError(
            f"{name} has {len(node)} corners", "in the blocks of a surface",
            "its border has to turn at four places",
        )  # fmt: skip
    i = _first_corner(region, node, first, aft)
    order = [(i + k) % 4 for k in range(4)]
    return Quad(region, tuple(node[k] for k in order)), tuple(turn[k] for k in order)  # type: ignore[arg-type]


def _first_corner(
    region: Region, node: tuple[int, ...], first: Sequence[int], aft: bool | None
) -> int:
    """Tell which of four corners is the upper one aft."""
    if aft is not None:
        at = node.index(first[0])
        return (at - 1) % 4 if aft else at
    quads = [Quad(region, tuple(node[(i + k) % 4] for k in range(4))) for i in range(4)]  # type: ignore[arg-type]
    high = [float(region.graph.place[quad.nodes("v0"), 2].mean()) for quad in quads]
    return int(np.argmax(high))
