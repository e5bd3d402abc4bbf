"""Which blocks a half hull is parted into, with four corners each and bays beyond their sides.

The body is master of the ends; of an end parted along, the upper part is master of the lower.
A master knows nothing of what follows it, so a change in a bow changes nothing abaft of it.
A surface is fitted over the bays too and cut at the border, so its end is not its worst place.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import attrs
import numpy as np

from assoc_hull.errors import BadInputError
from assoc_hull.geometry.curves import FloatArray
from assoc_hull.surface.blocks.cell_regions import (
    BorderCourse,
    CellRegion,
    ProfileBend,
    Quad,
    RegionChord,
    border_course,
    border_turns,
    find_inward_bends,
)
from assoc_hull.surface.blocks.end_cuts import LEAST, EndCut, add_bridges, end_cut, passes_bend
from assoc_hull.surface.cells.net_faces import NetCells

__all__ = [
    "BlockPlan",
    "BlockSeam",
    "bays_of_parts",
    "bays_of_whole",
    "block_plans",
    "four_corners",
]


_WINDOW = 0.02
"""Over this part of the ship's length the turn of a border is taken."""

_TIP, _SHARP = 0.002, 40.0
"""A border that turns by so many degrees over so small a part of the ship has a corner."""

_EASED = 10.0
"""Over a larger part it may turn by so many degrees less."""

_ROUND = 1.0
"""A smooth border has none where it turns by fewer degrees over the window."""

_APART, _BESIDE = 0.02, 0.003
"""Corners lie no nearer to one another than this part of the border, nor, than the other, to where
the hull runs on."""


def four_corners(
    region: CellRegion,
    length: float,
    first: Sequence[int],
    second: Sequence[int] = (),
    never: Sequence[int] = (),
) -> tuple[tuple[int, ...], tuple[float, ...]]:
    """Choose four nodes round a region, counter-clockwise; also give the turns there, degrees.

    The turns are those over a short way: little at round borders. Nodes `first` are corners
    whatever the border does: those at the ends of a section that bounds it. Then come sharp corners
    of the hull, then nodes `second`, then where a smooth border turns most. Nodes `never` are none,
    nor any near them: the hull runs on there. `length`, m, is that of the ship.
    """
    found = border_course(region)
    node = found.node.tolist()
    normal = region.graph.normal[found.node]
    window = min(_WINDOW * length, 0.1 * found.length)
    turn = border_turns(found, found.start[:-1], window, normal)
    sharp = border_turns(found, found.start[:-1], _TIP * length, normal)
    rank = np.where((sharp >= _SHARP) & (turn >= _SHARP - _EASED), 2, 0)
    rank[[not _apart(found, i, _at(node, never), _BESIDE) for i in range(len(node))]] = -1
    rank[np.isin(node, second)] = 1
    rank[np.isin(node, first)] = 3
    chosen = np.flatnonzero(rank == 3).tolist()
    for level in (2, 1, 0):
        chosen += _best(found, turn, np.flatnonzero(rank == level).tolist(), chosen)
    chosen.sort()
    return tuple(node[i] for i in chosen), tuple(float(sharp[i]) for i in chosen)


def _at(node: Sequence[int], which: Sequence[int]) -> list[int]:
    return [i for i, each in enumerate(node) if each in which]


def _apart(found: BorderCourse, i: int, chosen: Sequence[int], part: float = _APART) -> bool:
    """Tell whether a node is a part of the border away from others."""
    gaps = [abs(float(found.start[i] - found.start[j])) for j in chosen]
    return all(min(gap, found.length - gap) >= part * found.length for gap in gaps)


def _best(
    found: BorderCourse, turn: FloatArray, of: Sequence[int], chosen: Sequence[int]
) -> list[int]:
    """Choose from nodes the corners that lack: they turn most, and sides stay in proportion."""
    lack = 4 - len(chosen)
    good = [i for i in of if turn[i] >= _ROUND and _apart(found, i, chosen)]
    if len(good) <= lack:
        return good
    best, value = tuple[int, ...](), 0.0
    for extra in itertools.combinations(good, lack):
        apart = (_apart(found, i, extra[:k]) for k, i in enumerate(extra))
        worth = float(np.prod(turn[list(extra)])) * _shape(found, [*chosen, *extra])
        if worth > value and all(apart):
            best, value = extra, worth
    return list(best)


def _shape(found: BorderCourse, corner: Sequence[int]) -> float:
    """Give how alike opposite sides are, 1 for a rectangle."""
    where = np.sort(found.start[list(corner)])
    side = np.diff(np.append(where, where[0] + found.length))
    pairs = ((side[0], side[2]), (side[1], side[3]))
    return float(np.prod([min(pair) / max(pair) for pair in pairs]))


# --------------------------------------------------------------------------------------
# Bays beyond the borders of a block: as far as the next line, on its master's side.

Bays = dict[str, Quad]


def bays_of_whole(whole: CellRegion, end: EndCut) -> Bays:
    """Give the bay beside an end that is one block, by its side."""
    strip = _strip(whole, end)
    found = None if strip is None else _bay(strip, end, end.section.first, end.section.last)
    return {} if found is None else {_side(end): found}


def bays_of_parts(
    whole: CellRegion, end: EndCut, upper: CellRegion, high: int
) -> tuple[Bays, Bays]:
    """Give the bays beside the upper and the lower block of an end that is cut along a waterline.

    `upper` is the part above it, `high` a half-edge of the waterline that has this on its left. The
    bays of the lower block reach beyond the waterline as well.
    """
    strip, side, line = _strip(whole, end), _side(end), end.along[0]
    carried = [None if strip is None else _carried(strip, each) for each in end.along]
    above, below = Bays(), Bays()
    base = carried[0]
    if strip is not None and base is not None:
        # Towards midship it runs aft from a bow, its upper side on the left; from a stern, forward.
        upward = int(base.half[0]) ^ (end.kind == "stern")
        for bays, half, top, bottom in (
            (above, upward, end.section.first, line.first),
            (below, upward ^ 1, line.first, end.section.last),
        ):
            found = _bay(strip.with_half([base.half], half), end, top, bottom)
            if found is not None:
                bays[side] = found
    if len(end.along) == 1:
        return above, below
    next_line = end.along[1]
    part = upper.with_half([next_line.half], high)
    # Only a disc has four corners.
    if part is not None and part.is_disc:
        below["v0"] = _across(end, part)
    over = carried[1]
    # Beyond a corner there is a bay only if there is one beyond the side next to it.
    if strip is not None and base is not None and over is not None and "v0" in below:
        between = strip.with_half([base.half, over.half], upward)
        found = _bay(between, end, next_line.first, line.first)
        if found is not None:
            below[f"{side} v0"] = found
    return above, below


def _side(end: EndCut) -> str:
    """Tell on which side of the blocks of an end the body lies."""
    return "u1" if end.kind == "stern" else "u0"


def _strip(whole: CellRegion, end: EndCut) -> CellRegion | None:
    """Give the bay of the body beside an end."""
    if end.beside is None:
        return None
    cuts = [end.section.half, end.beside.half]
    found = whole.with_half(cuts, int(end.section.half[0]) ^ (end.kind == "stern"))
    return found if found is not None and found.is_disc else None


def _bay(region: CellRegion | None, end: EndCut, top: int, bottom: int) -> Quad | None:
    """Give a bay beside a part of a section as a quad, if it has corners."""
    other = end.beside
    if region is None or other is None or not region.is_disc:
        return None
    node = set(region.begin(region.loop).tolist())
    far = [
        each for each in np.append(region.begin(other.half), other.last).tolist() if each in node
    ]
    if top not in node or bottom not in node or len(far) < 2:
        return None
    aft = end.kind == "stern"
    corner = (top, far[0], far[-1], bottom) if aft else (far[0], top, bottom, far[-1])
    return Quad(region, corner)


def _across(end: EndCut, region: CellRegion) -> Quad:
    """Give the strip between the two waterlines of an end as a quad."""
    line, above = end.along
    if end.kind == "stern":
        return Quad(region, (above.last, above.first, line.first, line.last))
    return Quad(region, (above.first, above.last, line.last, line.first))


def _carried(strip: CellRegion, line: RegionChord) -> RegionChord | None:
    """Give the same line through the bay beside it, from the section on."""
    for chord in strip.chords(line.curve):
        for run in (chord, chord.reversed()):
            if run.first == line.first:
                return run
    return None


# --------------------------------------------------------------------------------------
# Plans of all blocks, masters first.

_PASSES = 0.002
"""A border passes a place that it misses by less than this part of the ship's length."""


@attrs.frozen(eq=False)
class BlockSeam:
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
    seams : tuple of BlockSeam
        Where it follows another block.
    rails : tuple of RegionChord
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
    seams: tuple[BlockSeam, ...]
    rails: tuple[RegionChord, ...]
    turns: tuple[float, ...]
    notes: tuple[str, ...]


def block_plans(cells: NetCells, length: float) -> tuple[BlockPlan, ...]:
    """Part a half hull into blocks, masters first; `length`, m, is that of the ship.

    Raises BadInputError where the half hull, or a part of it, is no disc with four corners.
    """
    whole = CellRegion.whole(cells)
    _require_disc(whole, "the half hull")
    ends = tuple(end_cut(whole, length, kind) for kind in ("stern", "bow"))
    found = add_bridges(cells, ends, length)
    if found is not cells:
        whole = CellRegion.whole(found)
        ends = tuple(end_cut(whole, length, kind) for kind in ("stern", "bow"))
    stern, bow = ends
    plans = [_body(whole, length, stern, bow)]
    for end in ends:
        if end is not None:
            plans += _end(whole, length, end)
    cut = [end.bend.place for end in ends if end is not None]
    bends = find_inward_bends(border_course(whole), length, LEAST)
    left = [bend for bend in bends if bend.place not in cut]
    return tuple(attrs.evolve(plan, notes=plan.notes + _hard(plan, left, length)) for plan in plans)


def _hard(plan: BlockPlan, bends: Sequence[ProfileBend], length: float) -> tuple[str, ...]:
    """Name the bends of the profile that stay in the border of a block."""
    return tuple(
        f"the profile bends into the ship by {bend.turn:.0f} degrees "
        f"at ({bend.place[0]:.2f}, {bend.place[2]:.2f}), within a side"
        for bend in bends
        if passes_bend(plan.core.region, bend, _PASSES * length)
    )


def _require_disc(region: CellRegion, name: str) -> None:
    if not region.is_disc:
        raise BadInputError(
            f"{name} is no disc: its border has {len(region.loops)} loops",
            "in the blocks of a surface",
            "look for lines that end nowhere, or that lie on one another",
        )


def _body(whole: CellRegion, length: float, stern: EndCut | None, bow: EndCut | None) -> BlockPlan:
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


def _end(whole: CellRegion, length: float, end: EndCut) -> list[BlockPlan]:
    """Plan the blocks of an end."""
    aft = end.kind == "stern"
    section = end.section
    region = _part(whole, [section.half], int(section.half[0]) ^ (not aft), end.kind)
    side = "u1" if aft else "u0"
    if not end.along:
        name = "stern counter" if aft and end.beside is None else end.kind
        quad, turn = _quad(region, length, [section.first, section.last], [], name, aft)
        bays = bays_of_whole(whole, end)
        seam = BlockSeam(side, "body", tuple(quad.side(side).tolist()))
        return [BlockPlan(name, end.kind, quad, bays, (seam,), (), turn, end.notes)]
    return _parted_end(whole, length, end, region)


def _parted_end(
    whole: CellRegion, length: float, end: EndCut, region: CellRegion
) -> list[BlockPlan]:
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
    seam = [BlockSeam(side, "body", tuple(quad.side(side).tolist())) for quad in (upper, lower)]
    below = tuple(line.half.tolist())
    return [
        BlockPlan(names[0], end.kind, upper, bays[0], (seam[0],), (), turn_upper, end.notes),
        BlockPlan(
            names[1], end.kind, lower, bays[1], (seam[1], BlockSeam("v0", names[0], below)), (),
            turn_lower, end.notes,
        ),
    ]  # fmt: skip


def _part(whole: CellRegion, cuts: Sequence[np.ndarray], half: int, name: str) -> CellRegion:
    found = whole.with_half(cuts, half)
    if found is None:
        raise BadInputError(
            f"{name} has no cells", "in the blocks of a surface", "look at the lines at the ends"
        )
    _require_disc(found, name)
    return found


def _quad(
    region: CellRegion,
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
    region: CellRegion, node: tuple[int, ...], first: Sequence[int], aft: bool | None
) -> int:
    """Tell which of four corners is the upper one aft."""
    if aft is not None:
        at = node.index(first[0])
        return (at - 1) % 4 if aft else at
    quads = [Quad(region, tuple(node[(i + k) % 4] for k in range(4))) for i in range(4)]  # type: ignore[arg-type]
    high = [float(region.graph.place[quad.nodes("v0"), 2].mean()) for quad in quads]
    return int(np.argmax(high))
